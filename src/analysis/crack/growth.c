/* A crack that grows under passing contacts by Paris's law, pass after pass (C10). */
#include "analysis/crack/crack.h"
#include "analysis/crack/crack_case.h"
#include "rolling/case/words.h"

#include <gsl/gsl_math.h>

/* Elements that each new straight piece brings: the others stay as fine as they were. */
enum { PIECE_ELEMENTS = 4 };

rb_status rb_case_check_growth(const rb_case_crack *k, rb_message *why)
{
    const rb_case_crack none = rb_case_crack_defaults();

    if (isnan(k->paris))
        return isnan(k->grow_to) && k->threshold == none.threshold && k->tension == none.tension &&
                       k->paris_range == none.paris_range && k->grow_steps == none.grow_steps
                   ? RB_OK
                   : rb_refuse(why, "grow-to,threshold,growth,paris-range,grow-steps",
                               "of a crack that grows; "
                               "give --paris C,m");
    if (k->paris_law.n != 2 || !(k->paris_law.value[1] > 0.0))
        return rb_refuse(why, "paris", "expected two numbers C,m > 0");
    if (k->unloaded && !rb_case_crack_cycles(k))
        return rb_refuse(why, "paris",
                         "cracks grow under loads that pass; --unloaded needs a cycle, "
                         "--remote-stress low,high");
    return RB_OK;
}

/* Direction of the last piece, to the surface [degrees]. */
static double last_angle(const rb_crack_path *path)
{
    const int k = path->pieces;
    return atan2(path->y[k - 1] - path->y[k], path->x[k] - path->x[k - 1]) * (180.0 / M_PI);
}

/* Straight on, or as a new piece in another direction. */
static int extend(double by, double angle, rb_crack_path *path)
{
    const rb_crack_path next = rb_crack_straight(0.0, 0.0, by, angle);
    const double turn = fabs(angle - last_angle(path));
    const int from = path->pieces, to = turn > 1e-9 ? from + 1 : from;

    if (to > RB_CRACK_PIECES)
        return 0;
    path->x[to] = path->x[from] + next.x[1];
    path->y[to] = path->y[from] + next.y[1];
    path->pieces = to;
    return path->y[to] < 0.0;
}

/* dK and da/dN, whose law is written in the units of the case. */
static void add_length(const rb_resolved_case *c, const rb_case_crack *k,
                       const rb_crack_shape *shape, double length, const rb_case_crack_summary *s,
                       rb_case_crack_growth *g)
{
    const rb_crack_path *path = &shape->path;
    /* what rounding leaves of a K that does not change */
    const double nothing = 1e-15 * shape->shear * sqrt(length);
    const int i = g->n++;
    const double opens = fmax(s->K_I_max, 0.0) - fmax(s->K_I_min, 0.0);

    g->length[i] = length;
    g->tip_x[i] = path->x[path->pieces];
    g->tip_y[i] = path->y[path->pieces];
    g->angle[i] = last_angle(path);
    g->K_I_max[i] = s->K_I_max;
    g->delta_K_II[i] = s->delta_K_II;
    g->delta_K[i] = k->paris_range == RB_CRACK_MODE_II
                        ? s->delta_K_II
                        : pow(gsl_pow_4(opens) + 8.0 * gsl_pow_4(s->delta_K_II), 0.25);
    g->rests = g->delta_K[i] <= fmax(k->threshold, nothing);
    g->rate[i] = g->rests
                     ? 0.0
                     : rb_unit_stored(c->units, "mm",
                                      k->paris_law.value[0] *
                                          pow(rb_unit_shown(c->units, "MPa.mm^0.5", g->delta_K[i]),
                                              k->paris_law.value[1]));
    if (i > 0) /* the law's 1/rate over the length, by trapezia */
        g->cycles[i] =
            g->cycles[i - 1] +
            0.5 * (length - g->length[i - 1]) *
                (1.0 / g->rate[i - 1] + (g->rests ? 1.0 / g->rate[i - 1] : 1.0 / g->rate[i]));
}

rb_status rb_case_grow_crack(const rb_resolved_case *c, const rb_case_crack *k,
                             const rb_case_crack_track *track, const rb_crack_observer *observer,
                             rb_case_crack_result *r, rb_message *why)
{
    rb_case_crack_growth *g = &r->growth;
    rb_crack_shape shape = r->shape;
    const rb_case_crack lengths = rb_case_crack_lengths(c, k, r->half_width);
    const double first = lengths.length, last = lengths.grow_to;
    rb_case_crack_summary summary = r->summary;
    double **const column[] = {&g->length,     &g->tip_x,   &g->tip_y, &g->angle, &g->K_I_max,
                               &g->delta_K_II, &g->delta_K, &g->rate,  &g->cycles};
    enum { COLUMNS = sizeof column / sizeof *column };
    const size_t rows = (size_t)k->grow_steps + 1;
    double *all = rb_alloc(rows, COLUMNS);
    rb_status s = all ? RB_OK : RB_ENOMEM;

    *g = (rb_case_crack_growth){.n = 0};
    for (size_t j = 0; all && j < COLUMNS; j++)
        *column[j] = all + j * rows;
    if (s == RB_OK)
        add_length(c, k, &shape, first, &summary, g);
    for (int i = 1; i <= k->grow_steps && s == RB_OK && !g->rests; i++) {
        rb_crack *crack = NULL;
        rb_case_crack_result longer = {.half_width = r->half_width};
        rb_case_crack l = lengths;
        const double angle = last_angle(&shape.path) - (k->tension ? summary.kink_angle : 0.0);
        if (!extend((last - first) / k->grow_steps, angle, &shape.path)) {
            g->surfaced = 1;
            break;
        }
        shape.elements = k->elements + PIECE_ELEMENTS * (shape.path.pieces - 1);
        l.length = first + (last - first) * i / k->grow_steps;
        if (!k->unloaded)
            s = rb_case_crack_check_elements(&shape.path, shape.elements, r->half_width, why);
        if (s == RB_OK)
            s = rb_crack_create(&shape, &crack, why);
        if (s == RB_OK)
            s = rb_case_crack_pass(c, &l, track, NULL, observer, crack, &longer, why);
        if (s == RB_OK) {
            summary = rb_case_crack_summarise(&longer.history, k->passes);
            g->path = shape.path;
            add_length(c, k, &shape, l.length, &summary, g);
        } else if (s == RB_INTERRUPTED)
            rb_fail(why, s, "interrupted after length %d of %d", g->n, k->grow_steps + 1);
        rb_case_crack_free(&longer);
        rb_crack_free(crack);
    }
    return s;
}
