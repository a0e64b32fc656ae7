/* Where the numbers of contour lines stand: on the lines, inside the panel, apart from each
 * other.  gnuplot would put them at a given point of each line, which may be at its border. */
#include "program/report/internal.h"

#include <math.h>

/* The part of an axis, 0 to 1. */
static double part(const rb_report_contours *c, int direction, double x)
{
    const double from = c->from[direction], to = c->to[direction];
    return c->logarithmic[direction] ? log(x / from) / log(to / from) : (x - from) / (to - from);
}

typedef struct {
    double at[3]; /* x, y, level, in units of the axes */
} number;

static const double EQUAL = 1e-3; /* of mirrored places the first one, at any rounding */
enum { NUMBERS = 60, OF_A_LEVEL = 2, APART = 8 }; /* those of one level, in letters */

/* Letters from this number to the border, twice, and to the n others, of which the last `same`
 * are those of its level; below 0: it is cut off or covers one. */
static double room_at(const rb_report_contours *c, const number *p, int n, const number *others,
                      int same)
{
    const double width[2] = {0.62 * snprintf(NULL, 0, "%g", p->at[2]) + 1.0, 1.6};
    double of[2], room = INFINITY;
    for (int d = 0; d < 2; d++) {
        of[d] = part(c, d, p->at[d]);
        const double edge = fmin(of[d], 1.0 - of[d]) / c->letter[d] - 0.5 * width[d] - 0.3;
        room = fmin(room, 2.0 * edge);
    }
    for (int k = 0; k < n; k++) {
        double apart = 0.0;
        for (int d = 0; d < 2; d++)
            apart = fmax(apart,
                         fabs(of[d] - part(c, d, others[k].at[d])) / c->letter[d] - width[d] - 0.3);
        room = fmin(room, k >= n - same ? apart - APART : apart);
    }
    return room;
}

/* The middle of the line of this level in a triangle; 0: there is none. */
static int cross(const rb_report_contours *c, const int corners[3], double level, number *middle)
{
    double at[2][2];
    int n = 0;
    for (int k = 0; k < 3 && n < 2; k++) {
        double a[3], b[3];
        c->point(c->of, corners[k], a);
        c->point(c->of, corners[(k + 1) % 3], b);
        const double t = (level - a[2]) / (b[2] - a[2]);
        if (t >= 0.0 && t < 1.0) { /* not NAN */
            for (int d = 0; d < 2; d++)
                at[n][d] = a[d] + t * (b[d] - a[d]);
            n++;
        }
    }
    if (n < 2)
        return 0;
    for (int d = 0; d < 2; d++)
        middle->at[d] = c->logarithmic[d] ? sqrt(at[0][d] * at[1][d]) : 0.5 * (at[0][d] + at[1][d]);
    middle->at[2] = level;
    return 1;
}

/* The place on lines of this level with the most room, among the middles of their pieces in the
 * triangles into which gnuplot divides the cells; 0: none has any. */
static int find_number(const rb_report_contours *c, double level, int n, const number *others,
                       int same, number *best)
{
    double most = 0.0;
    for (int j = 0; j + 1 < c->ny; j++)
        for (int i = 0; i + 1 < c->nx; i++)
            for (int half = 0; half < 2; half++) {
                const int first = i + c->nx * j, last = first + c->nx + 1;
                number p;
                if (!cross(c, (int[]){first, half ? first + 1 : last - 1, last}, level, &p))
                    continue;
                const double room = room_at(c, &p, n, others, same);
                if (room > most + EQUAL) {
                    most = room;
                    *best = p;
                }
            }
    return most > 0.0;
}

void rb_report_contour_numbers(FILE *script, const char *name, const rb_report_contours *c)
{
    number found[NUMBERS + 1];
    int n = 0;
    if (c->mark)
        found[n++] = (number){{c->mark[0], c->mark[1], 0.0}};
    fprintf(script, "$%s << EOD\nx y level\n", name);
    for (int k = 0; c->first + k * c->step <= c->last; k++) {
        const double level = rb_report_tidy(c->first + k * c->step, c->step);
        for (int same = 0;
             n < NUMBERS && same < OF_A_LEVEL && find_number(c, level, n, found, same, &found[n]);
             same++, n++)
            fprintf(script, "%.9g %.9g %.9g\n", found[n].at[0], found[n].at[1], level);
    }
    fputs("EOD\n", script);
}
