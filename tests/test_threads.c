/* Cases, LCPs and friction problems solved in four threads at once give the bytes that
 * they give one after another (docs/library.md). */
#include "check.h"
#include "base/blas.h"
#include "rolling/case/case.h"
#include "lcp/friction/friction.h"

#include <pthread.h>

enum { THREADS = 4, CASES = 8, NUMBERS = 8 };

/* What a thread solves, and the numbers it found. */
typedef struct {
    int k;
    rb_status status;
    double number[NUMBERS];
} job;

/* Wheels, half-planes, fitted meshes, Lemke, Newton, transforms, layers, a cone solver. */
static const char *const words[CASES][16] = {
    {"contact-elements", "20", NULL},
    {"support", "halfplane", "formulation", "steady", "load", "300", "creep-ratio", "0.4", NULL},
    {"support", "hub", "formulation", "steady", "load", "300", "creep-ratio", "0.4",
     "contact-elements", "24", NULL},
    {"support", "halfplane", "formulation", "steady", "load", "300", "force-ratio", "-0.5", "mesh",
     "uniform", "contact-elements", "1600", NULL},
    {"support", "halfplane", "formulation", "transient", "load", "300", "creep-ratio", "0.4",
     "distance", "1", "contact-elements", "30", NULL},
    {"support", "halfplane", "formulation", "steady", "load", "300", "layer-thickness", "5",
     "creep", "1e-4", "contact-elements", "30", NULL},
    {"support", "halfplane", "load", "300", "force-ratio", "0.5", "solver", "nsn-ac",
     "contact-elements", "30", NULL},
    {"support", "halfplane", "formulation", "steady", "load", "300", "creep-ratio", "0.4", "solver",
     "newton", "contact-elements", "150", NULL}};

static void solve_job(job *j)
{
    held_case *c = rb_case_create(RB_CASE_SINGLE);
    OWNED(rb_case_result) r = {0};

    rb_case_use_cone_solvers(c, rb_friction_cone_solver);
    j->status = RB_OK;
    for (const char *const *w = words[j->k]; *w && j->status == RB_OK; w += 2)
        j->status = rb_case_set(c, w[0], w[1], 0, &message);
    if (j->status == RB_OK)
        j->status = rb_case_resolve(c, &message);
    if (j->status == RB_OK)
        j->status = rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message);
    if (j->status != RB_OK)
        print_error("case %d: %s\n", j->k, message.text);
    const rb_rolling_solution *s = &r.solution;
    const double number[NUMBERS] = {s->normal_load,  s->tangential_load,   s->max_pressure,
                                    s->half_width,   s->creepage,          s->approach,
                                    s->stick_length, (double)s->iterations};
    memcpy(j->number, number, sizeof number);
}

/* Transforms round as their buffers lie in memory, which no two calls share. */
static double tolerance(int k)
{
    return k == 3 ? 1e-9 : 0.0;
}

/* Every thread solves all cases, each beginning with another one. */
typedef struct {
    int first;
    job jobs[CASES];
} worker;

static void *work(void *context)
{
    worker *w = context;
    for (int i = 0; i < CASES; i++) {
        const int k = (w->first + i) % CASES;
        w->jobs[k].k = k;
        solve_job(&w->jobs[k]);
    }
    return NULL;
}

TEST(threads_give_the_same_bytes)
{
    static worker alone, together[THREADS];
    pthread_t thread[THREADS];

    work(&alone);
    for (int t = 0; t < THREADS; t++) {
        together[t].first = 2 * t;
        assert_int_equal(pthread_create(&thread[t], NULL, work, &together[t]), 0);
    }
    for (int t = 0; t < THREADS; t++)
        assert_int_equal(pthread_join(thread[t], NULL), 0);
    for (int k = 0; k < CASES; k++) {
        CHECK_OK(alone.jobs[k].status);
        for (int t = 0; t < THREADS; t++)
            for (int i = 0; i < NUMBERS; i++)
                CHECK_REL(together[t].jobs[k].number[i], alone.jobs[k].number[i], tolerance(k),
                          "case %d, thread %d, number %d", k, t, i);
    }
}

int main(void)
{
    rb_blas_threads(1);
    return run_all_tests(NULL, NULL);
}
