/* Peak memory of every path against its formula (docs/performance.md, Memory).  Each case
 * runs in a process of its own, after a small one of its kind: the growth of the largest
 * resident set is what the case takes. */
#include "carter.h"
#include "fast_blas.h"
#include "rows.h"
#include "rolling/rolling.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct {
    double bytes, formula;
} result;

static void stop(const char *what)
{
    fprintf(stderr, "bench_memory: %s\n", what);
    exit(70);
}

/* Of this process or the largest that it has started, bytes. */
static double peak(void)
{
    struct rusage own, children;
    getrusage(RUSAGE_SELF, &own);
    getrusage(RUSAGE_CHILDREN, &children);
    return 1024.0 * fmax((double)own.ru_maxrss, (double)children.ru_maxrss);
}

/* ---- Cases ------------------------------------------------------------------------- */

static rb_rolling_case halfplanes(int n)
{
    rb_rolling_case rc = carter(n);
    rc.b.young = 70000.0; /* coupled: Newton's largest systems */
    return rc;
}

static rb_rolling_case lemke(int n, rb_contact_lcp_form form)
{
    rb_rolling_case rc = halfplanes(n);
    rc.contact.solver = RB_SOLVER_LEMKE;
    rc.contact.lcp_form = form;
    return rc;
}

static rb_rolling_case pivoted(int n)
{
    return lemke(n, RB_LCP_PIVOTED);
}

static rb_rolling_case kwak(int n)
{
    return lemke(n, RB_LCP_KWAK);
}

static rb_rolling_case newton(int n)
{
    rb_rolling_case rc = halfplanes(n);
    rc.contact.solver = RB_SOLVER_NEWTON;
    return rc;
}

/* Two steps on elements of several lengths, which keep the matrix at any size: Newton's method. */
static rb_rolling_case with_matrix(int n)
{
    rb_rolling_case rc = newton(n);
    rc.formulation = RB_TRANSIENT;
    rc.mesh = RB_MESH_FITTED;
    rc.steps = 2;
    return rc;
}

static rb_rolling_case similar(int n)
{
    rb_rolling_case rc = newton(n);
    rc.b.young = rc.a.young;
    return rc;
}

static rb_rolling_case wheel(int n)
{
    rb_rolling_case rc = newton(n);
    rc.elastic_b = 0;
    rc.a.support = RB_BEM_HUB;
    rc.a.hub_ratio = 0.3;
    rc.half_width = 5.0;
    return rc;
}

/* ---- What runs in the process ------------------------------------------------------ */

static int boundary_of(const rb_rolling_model *model)
{
    return model->bodies.system_a ? rb_bem_system_mesh(model->bodies.system_a)->n : 0;
}

/* Formula of a case that was solved. */
static double solve_case(const rb_rolling_case *rc)
{
    rb_rolling_model model;
    rb_message why;
    int unknowns = 0;

    if (rb_rolling_model_create(rc, &model, &why) != RB_OK)
        stop(why.text);
    for (int i = 0; i < model.state.n; i++)
        unknowns +=
            (model.state.zone[i] != RB_ZONE_SEPARATED) + (model.state.zone[i] == RB_ZONE_STICK);
    const double formula = rb_rolling_bytes(rc, model.mesh.n, boundary_of(&model), unknowns);
    rb_rolling_model_free(&model);
    return formula;
}

static double curve(const rb_rolling_case *rc)
{
    rb_rolling_curve c;
    rb_message why;

    if (rb_rolling_curve_solve(rc, &(rb_rolling_range){0, 0.1, 1.2, 4, RB_UNITS_MM}, &c, &why) !=
        RB_OK)
        stop(why.text);
    rb_rolling_curve_free(&c);
    return rb_rolling_bytes(rc, rc->contact_elements, 0, 2 * rc->contact_elements);
}

/* After its first case the allocator keeps blocks of less than 32 MB for the next one. */
static const double KEPT = 1.4;

typedef struct {
    const rb_rolling_case *rc; /* NULL: cases that fail at once */
    double formula;
} study;

static rb_status make_case(int k, rb_rolling_case *rc, void *context)
{
    const study *st = context;
    (void)k;
    if (!st->rc)
        return RB_EINVAL;
    *rc = *st->rc;
    return RB_OK;
}

static int see_row(int k, const rb_rolling_row *found, void *context)
{
    study *st = context;
    const rb_rolling_solution *row = &found->solution;
    (void)k;
    if (st->rc && row->status != RB_OK)
        stop("a case of the study is not solved");
    if (st->rc)
        st->formula =
            KEPT * rb_rolling_bytes(st->rc, st->rc->contact_elements, 0, row->contact + row->stick);
    return 0;
}

/* Rows that may wait, src/rolling/study/sweep.c. */
enum { WINDOW = 1 << 14 };

static double sweep(const rb_rolling_case *rc, int count)
{
    study st = {.rc = rc, .formula = (sizeof(rb_rolling_row) + 1.0) * fmin(count, WINDOW)};
    const rb_rolling_sweep run = {
        .count = count, .workers = 1, .make = make_case, .see = see_row, .context = &st};

    if (rb_rolling_sweep_run(&run, NULL) != RB_OK)
        stop("no study");
    return st.formula;
}

static double worker(const rb_rolling_case *rc)
{
    return sweep(rc, 2);
}

static double rows(const rb_rolling_case *rc)
{
    return sweep(NULL, rc->contact_elements);
}

typedef struct {
    const char *name;
    rb_rolling_case (*make)(int n);
    double (*run)(const rb_rolling_case *rc);
    int small, n[2];
} path;

static const path paths[] = {
    {"wheel on a hub, Newton", wheel, solve_case, 100, {500, 1000}},
    {"half-planes, Lemke (K5)", pivoted, solve_case, 100, {400, 800}},
    {"half-planes, Lemke (K4)", kwak, solve_case, 100, {300, 600}},
    /* with 100 the buffers of BLAS, 7 MB whatever n is, would be counted */
    {"half-planes, Newton", with_matrix, solve_case, 200, {700, 1400}},
    {"similar, no matrix", similar, solve_case, 1600, {50000, 200000}},
    {"dissimilar, no matrix", newton, solve_case, 1600, {50000, 200000}},
    /* without a matrix; so many that what does not grow with n, 2 MB, counts little */
    {"creep curve", newton, curve, 1600, {20000, 50000}},
    {"study, a solver", newton, worker, 1600, {20000, 50000}},
    {"study, rows", newton, rows, 1, {5000, 60000}},
};

static result measure(const path *p, int n)
{
    rb_rolling_case rc = p->make(p->small);
    result r;

    p->run(&rc);
    const double before = peak();
    rc = p->make(n);
    r.formula = p->run(&rc);
    r.bytes = peak() - before;
    return r;
}

static result in_a_process(const path *p, int n)
{
    int end[2];
    result r;

    if (pipe(end) != 0)
        stop("no pipe");
    fflush(stdout);
    const pid_t child = fork();
    if (child < 0)
        stop("no process");
    if (child == 0) {
        r = measure(p, n);
        _exit(write(end[1], &r, sizeof r) != sizeof r);
    }
    close(end[1]);
    if (read(end[0], &r, sizeof r) != sizeof r)
        stop(p->name);
    close(end[0]);
    waitpid(child, NULL, 0);
    return r;
}

int main(int argc, char **argv)
{
    (void)argc;
    fast_blas(argv);
    double least = INFINITY, most = 0.0;
    printf("| path | elements | measured / formula |\n|---|---|---|\n");
    for (size_t k = 0; k < sizeof paths / sizeof *paths; k++) {
        double ratio[2];
        for (int size = 0; size < 2; size++) {
            const result r = in_a_process(&paths[k], paths[k].n[size]);
            ratio[size] = r.bytes / r.formula;
            least = fmin(least, ratio[size]);
            most = fmax(most, ratio[size]);
        }
        printf("| %s | %s, %s | %.2f, %.2f |\n", paths[k].name, row_count(paths[k].n[0]).text,
               row_count(paths[k].n[1]).text, ratio[0], ratio[1]);
        fflush(stdout);
    }
    printf("ratios from %.2f to %.2f (wanted: 0.8 to 1.2)\n", least, most);
    return 0;
}
