/* The mesh that the program chooses: who asks for more elements gets no larger error, whatever the
 * bodies are. */
#include "case_words.h"
#include "rollbem/case.h"

#include <math.h>

/* Differences of a solution from a finer one: Q/(mu P), or the creepage of a given force in units
 * of itself; p0 and the half-width in units of themselves. */
enum { FORCE, PRESSURE, WIDTH, MEASURES };
static const char *const measure_name[MEASURES] = {"Q/(mu P)", "p0", "half-width"};

static rb_rolling_solution solved(const words *w, int elements)
{
    OWNED(rb_case_result) r;
    held_case *c = case_of(RB_CASE_SINGLE, w, "contact-elements", elements);
    if (rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &heard) != RB_OK)
        fail_msg("%s %s, %d elements: %s", w->word[1], w->word[2], elements, heard.text);
    return rb_rolling_scalars_of(&r.solution);
}

static void add_error(const rb_rolling_solution *s, const rb_rolling_solution *fine, int by_force,
                      double error[MEASURES])
{
    error[FORCE] += by_force ? fabs(s->creepage / fine->creepage - 1.0)
                             : fabs(s->force_ratio - fine->force_ratio);
    error[PRESSURE] += fabs(s->max_pressure / fine->max_pressure - 1.0);
    error[WIDTH] += fabs(s->half_width / fine->half_width - 1.0);
}

/* An error that passes through zero is small by chance: errors are added over several motions. */
TEST(more_elements_never_give_a_larger_error)
{
    static const char base[] = "support halfplane gap parabola radius 50 half-width 0.1 "
                               "formulation steady mu 0.3";
    static const char *const motions[] = {"creep-ratio 0.3", "creep-ratio -0.5",
                                          "force-ratio -0.5"};
    enum { MOTIONS = sizeof motions / sizeof *motions, FINE = 400 };
    static const struct {
        const char *bodies;
        int from; /* the first of the sizes */
    } rows[] = {{"similar yes young 210000 poisson 0.3", 0},
                {"young 70000 poisson 0.33 young-b 210000 poisson-b 0.28", 0},
                {"young 210000 poisson 0.3", 0},
                {"young 210000 poisson 0.3 layer-thickness 0.1", 1},
                {"similar yes young 210000 poisson 0.3 layer-thickness 0.05 base-young 70000 "
                 "base-poisson 0.3",
                 0}};
    static const int sizes[] = {37, 75, 150};
    enum { SIZES = sizeof sizes / sizeof *sizes };

    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        double error[SIZES][MEASURES] = {{0.0}};
        for (int m = 0; m < MOTIONS; m++) {
            const words w = {{base, rows[k].bodies, motions[m]}};
            const words graded = {{base, rows[k].bodies, motions[m], "mesh fitted"}};
            const rb_rolling_solution fine = solved(&graded, FINE);
            for (int n = rows[k].from; n < SIZES; n++) {
                const rb_rolling_solution s = solved(&w, sizes[n]);
                add_error(&s, &fine, m + 1 == MOTIONS, error[n]);
            }
        }
        for (int n = rows[k].from + 1; n < SIZES; n++)
            for (int e = 0; e < MEASURES; e++)
                if (!(error[n][e] <= 1.1 * error[n - 1][e]))
                    fail_msg("%s: error of %s: %.2g with %d elements, %.2g with %d", rows[k].bodies,
                             measure_name[e], error[n - 1][e], sizes[n - 1], error[n][e], sizes[n]);
    }
}

RUN_TESTS(NULL, NULL)
