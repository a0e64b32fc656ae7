/* The portfolio: methods that run in turns until one satisfies the tolerance.
 *
 * The first member runs first, and what it has spent is the first allowance L.  Then the members
 * continue in turns, each from its last iterate, until what it has spent itself reaches its share
 * of L; L grows by the factor GROWTH from round to round.  When a member succeeds after it has
 * spent T, L < GROWTH T / share, and the other members have spent at most their shares of this L,
 * which bounds the total: shares of 1, 0.75, 1 and 0.05 give 2.8 T for a member of share 1
 * (docs/friction.md).
 * Sweeps that stall early leave a first allowance which is less than what Newton's method needs
 * from there.  It may then spend more than its share once, before the others begin.
 * What is spent are operations, and those that the sparse LUs could make in the rest of their
 * time.  Both are counted by formulas, so that the same problem always takes the same path. */
#include "lcp/friction/internal.h"
#include "base/sizes.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GROWTH 1.05
/* Nobody goes on beyond this. */
#define MOST_OPERATIONS 1e11
/* Where the norm over all contacts is met but a contact that carries little is not, other functions
 * of Newton's method lead from there to the solution within some steps, while the one that came
 * there goes on for hundreds: so often in a stage, and for so many steps of each.  The natural map
 * costs half of Fischer and Burmeister's function, which cycles least. */
enum { POLISHES = 3 };
static const struct {
    int variant, steps;
} polishing[] = {{RB_FRICTION_NATURAL_MAP, 3}, {RB_FRICTION_FISCHER_BURMEISTER, 15}};

typedef enum { FROM_START, FROM_BEST } stage_origin;

/* What a member does: one stage after the other. */
typedef struct {
    const rb_friction_method *method; /* NULL: the end */
    int variant, limit;               /* limit: iterations; 0: the solver's own */
    stage_origin from;
} stage;

#define AC RB_FRICTION_ALART_CURNIER
#define JM RB_FRICTION_JEAN_MOREAU
#define NM RB_FRICTION_NATURAL_MAP
#define FB RB_FRICTION_FISCHER_BURMEISTER
#define SEARCH RB_FRICTION_LINE_SEARCH

static const stage sweeps[] = {{&rb_friction_sweeps, RB_FRICTION_SWEEP_ANDERSON, 0, FROM_START},
                               {&rb_friction_projections, RB_FRICTION_EXTRAGRADIENT, 0, FROM_BEST},
                               {NULL, 0, 0, FROM_START}};
static const stage alternating[] = {{&rb_friction_admm, 0, 0, FROM_START},
                                    {NULL, 0, 0, FROM_START}};
static const stage plain_sweeps[] = {
    {&rb_friction_sweeps, 0, 300000, FROM_START},
    {&rb_friction_sweeps, RB_FRICTION_SWEEP_PROJECTION, 5000, FROM_START},
    {NULL, 0, 0, FROM_START}};
/* From sweeps Jean and Moreau's function and Fischer and Burmeister's are those that cycle least;
 * the first has the smaller systems, without the contacts that are open.  Where they converge from
 * there at all, they do so within some ten steps. */
static const stage newton_after_sweeps[] = {{&rb_friction_newton, JM, 12, FROM_BEST},
                                            {&rb_friction_newton, FB, 15, FROM_BEST},
                                            {&rb_friction_newton, AC, 12, FROM_BEST},
                                            {&rb_friction_newton, FB | SEARCH, 15, FROM_START},
                                            {&rb_friction_newton, AC | SEARCH, 25, FROM_START},
                                            {&rb_friction_newton, NM | SEARCH, 60, FROM_START},
                                            {&rb_friction_newton, FB | SEARCH, 60, FROM_BEST},
                                            {&rb_friction_newton, JM | SEARCH, 100, FROM_START},
                                            {&rb_friction_smoothing_method, 0, 150, FROM_START},
                                            {&rb_friction_lemke_method, 0, 0, FROM_START},
                                            {&rb_friction_newton, AC | SEARCH, 60, FROM_BEST},
                                            {&rb_friction_newton, NM | SEARCH, 60, FROM_BEST},
                                            {&rb_friction_newton, JM | SEARCH, 60, FROM_BEST},
                                            {&rb_friction_newton, AC | SEARCH, 400, FROM_START},
                                            {&rb_friction_newton, NM | SEARCH, 500, FROM_BEST},
                                            {NULL, 0, 0, FROM_START}};
/* Where Newton from zero converges at all, it takes some ten steps; smoothing takes about
 * twenty, also where Newton cycles. */
static const stage newton_first[] = {{&rb_friction_newton, AC | SEARCH, 15, FROM_START},
                                     {&rb_friction_smoothing_method, 0, 60, FROM_START},
                                     {&rb_friction_newton, FB | SEARCH, 60, FROM_START},
                                     {&rb_friction_newton, AC, 30, FROM_BEST},
                                     {&rb_friction_newton, NM | SEARCH, 60, FROM_START},
                                     {&rb_friction_newton, JM | SEARCH, 100, FROM_START},
                                     {&rb_friction_lemke_method, 0, 0, FROM_START},
                                     {&rb_friction_newton, AC | SEARCH, 60, FROM_BEST},
                                     {&rb_friction_newton, FB | SEARCH, 60, FROM_BEST},
                                     {&rb_friction_newton, NM | SEARCH, 60, FROM_BEST},
                                     {&rb_friction_newton, AC | SEARCH, 400, FROM_START},
                                     {&rb_friction_newton, NM | SEARCH, 500, FROM_BEST},
                                     {NULL, 0, 0, FROM_START}};

/* The first member's turn alone: so many of its stages, of so many iterations (0: their
 * own). */
typedef struct {
    int stages, iterations;
} first_turn;

typedef struct {
    const stage *stages;
    double share;
    first_turn first; /* 0: it is not the first */
    double on_stall; /* share of the first allowance where the first member has stalled; 0: share */
    double on_stall_near; /* the same where it has stalled at an error below NEAR */
} plan;

enum { MEMBERS = 4 };

/* Newton's methods converge from an error below this one more often than not: heaps and walls, on
 * which they fail, leave the sweeps at errors of 1e-3 to 1e-1, those on which they do not, at 1e-6
 * to 1e-5. */
#define NEAR 1e-4

/* Some sweeps are cheap where W is there and solve most problems.  The global form has to
 * be condensed for them, which costs little for rigid bodies and for few contacts on a
 * large structure. */
static const plan local_plan[MEMBERS] = {{sweeps, 1.0, {1, 100}, 0.0, 0.0},
                                         {newton_after_sweeps, 0.75, {0, 0}, 3.0, 30.0},
                                         {alternating, 1.0, {0, 0}, 0.0, 0.0},
                                         {plain_sweeps, 0.05, {0, 0}, 0.0, 0.0}};
static const plan global_plan[MEMBERS] = {{newton_first, 1.0, {2, 0}, 0.0, 0.0},
                                          {sweeps, 0.7, {0, 0}, 0.0, 0.0},
                                          {alternating, 1.0, {0, 0}, 0.0, 0.0},
                                          {plain_sweeps, 0.1, {0, 0}, 0.0, 0.0}};

typedef struct {
    const plan *plan;
    int stage;
    const rb_friction_solver *solver; /* of the stage; NULL: not begun */
    void *state;                      /* of its method, where that goes in parts */
    int stage_end;                    /* iterations of the member; 0: no limit */
    int over;                         /* no stage is left */
    rb_friction_task task;
    rb_friction_info info; /* the member's own */
} member;

/* Most calls end in the first turn, before there is more than one member. */
typedef struct {
    const rb_friction_task *task; /* the call's, on whose r, u, v the first one works */
    int members;
    member member[MEMBERS];
    double *memory; /* r, u, v of the others */
} portfolio;

/* Condensing takes no more operations than this many factorisations of K, of which a step
 * of Newton on the global form takes several, or so many per entry of the problem. */
#define CHEAP_FACTORS 3.0
#define CHEAP_ENTRY 30.0

static rb_status choose_plan(const rb_friction_task *task, const plan **plans)
{
    const rb_friction_problem *g = task->problem;
    double flops;
    *plans = task->n ? global_plan : local_plan;
    if (!task->n || task->measure->spring > 0.0)
        return RB_OK;
    const double factor = rb_sparse_cholesky_flops(task->measure->factor);
    const rb_status s = rb_friction_condense_estimate(g, task->measure->factor, &flops);
    if (s == RB_OK &&
        flops <= CHEAP_FACTORS * factor + CHEAP_ENTRY * (g->K.p[g->dofs] + g->H.p[task->m]))
        *plans = local_plan;
    return s;
}

static member *add_member(portfolio *p, const plan *its)
{
    member *a = &p->member[p->members++];
    a->plan = its;
    a->stage = a->stage_end = a->over = 0;
    a->solver = NULL;
    a->state = NULL;
    a->task = *p->task;
    a->task.info = &a->info;
    rb_friction_info_clear(&a->info, NULL);
    return a;
}

static void end_stage(member *a)
{
    if (a->state)
        a->solver->run->finish(a->state);
    free(a->state);
    a->state = NULL;
    a->solver = NULL;
    a->stage++;
}

/* ---- Stages ------------------------------------------------------------------------ */

/* The next stage that fits the problem, ready to go on; none is left: over.  W is
 * condensed when the first stage asks for it. */
static rb_status begin_stage(member *a)
{
    rb_friction_task *t = &a->task;
    for (const stage *s; (s = &a->plan->stages[a->stage])->method; a->stage++) {
        const rb_friction_solver *solver = rb_friction_solver_of(s->method, s->variant);
        const int flat = solver->needs & RB_FRICTION_ONLY_2D;
        const int condensed = !(solver->needs & RB_FRICTION_NEEDS_W) || t->shared->local;
        if (!(flat && (t->d != 2 || t->contacts > RB_FRICTION_LEMKE_UP_TO)) &&
            (condensed || (t->measure->spring == 0.0 && rb_friction_task_condense(t) == RB_OK))) {
            a->solver = solver;
            break;
        }
    }
    a->over = !a->solver;
    if (a->over)
        return RB_OK;
    const stage *s = &a->plan->stages[a->stage];
    a->info.solver = a->solver->name;
    a->stage_end = s->limit ? a->info.iters + s->limit : 0;
    a->task.opt.max_iters = a->stage_end;
    if (s->from == FROM_BEST && isfinite(a->task.best->error)) {
        memcpy(a->task.r, a->task.best->r, (size_t)a->task.m * sizeof(double));
        memcpy(a->task.v, a->task.best->r + a->task.m, (size_t)a->task.n * sizeof(double));
    } else
        rb_friction_task_start(&a->task);
    const rb_friction_method *method = a->solver->run;
    /* sweeps come nearer by themselves */
    a->task.tries = method == &rb_friction_newton ? POLISHES : 0;
    if (method->run)
        return RB_OK;
    a->state = malloc(method->size);
    if (!a->state)
        return RB_ENOMEM;
    const int yields = method == &rb_friction_sweeps ? RB_FRICTION_SWEEP_YIELD : 0;
    return method->start(&a->task, a->solver->variant | yields, a->state);
}

/* ---- Turns ------------------------------------------------------------------------- */

/* From the best iterate.  RB_MAXITER: in vain, and the member is where it was. */
static rb_status polish(member *a)
{
    rb_friction_task *t = &a->task;
    const size_t m = (size_t)t->m, n = (size_t)t->n;
    const int end = t->opt.max_iters, tries = t->tries;
    const char *name = a->info.solver;
    double *before = rb_alloc(m + n, 1);
    rb_status s = RB_MAXITER;

    t->nearly = 0;
    if (!before)
        return RB_ENOMEM;
    memcpy(before, t->r, m * sizeof *before);
    memcpy(before + m, t->v, n * sizeof *before);
    t->tries = 0;
    t->budget = INFINITY;
    t->opt.max_iters = 0;
    for (size_t k = 0; k < sizeof polishing / sizeof *polishing; k++) {
        const int variant = polishing[k].variant;
        memcpy(t->r, t->best->r, m * sizeof *before);
        memcpy(t->v, t->best->r + m, n * sizeof *before);
        a->info.solver = rb_friction_solver_of(&rb_friction_newton, variant)->name;
        s = rb_friction_run(t, &rb_friction_newton, variant, polishing[k].steps);
        if (s == RB_OK || s == RB_ENOMEM || s == RB_INTERRUPTED)
            break;
        s = RB_MAXITER;
    }
    t->tries = tries;
    t->opt.max_iters = end;
    if (s == RB_MAXITER) {
        memcpy(t->r, before, m * sizeof *before);
        memcpy(t->v, before + m, n * sizeof *before);
        a->info.solver = name;
    }
    free(before);
    return s;
}

static int iterations_left(const portfolio *p)
{
    int sum = 0;
    for (int k = 0; k < p->members; k++)
        sum += p->member[k].info.iters;
    const int most = p->task->opt.max_iters;
    return !most ? INT_MAX : most > sum ? most - sum : 0;
}

/* Stages until one solves the problem, or the allowance or the iterations of the turn are
 * used.  first: of the first turn, else NULL.  RB_MAXITER: the member has used its
 * allowance, or has no stage left.  What a stage stumbles on is not the reason why the
 * problem is not solved. */
static rb_status take_turn(const portfolio *p, member *a, double allowance, const first_turn *first)
{
    int paused = 0, again = 0;
    for (int stages = 0; !paused && iterations_left(p); stages += !again) {
        if (first && stages == first->stages)
            break;
        rb_status s = a->solver ? RB_OK : begin_stage(a);
        if (a->over)
            break;
        again = 0;
        if (s == RB_OK) {
            const rb_friction_method *method = a->solver->run;
            rb_friction_task *t = &a->task;
            const int turn = first ? first->iterations : 0, left = iterations_left(p);
            const int most = turn && turn < left ? turn : left;
            const int end = most < INT_MAX ? a->info.iters + most : 0;
            t->opt.max_iters = !end || (a->stage_end && a->stage_end < end) ? a->stage_end : end;
            t->budget = method->run ? INFINITY : allowance;
            if (method->run) {
                /* It cannot pause.  Its operations, roughly: as many pivots as unknowns,
                 * on a tableau of order 3 n_c where there is no W, or twenty
                 * factorisations. */
                const double m = t->m, tableau = 3.0 * t->contacts, order = m + t->n;
                const double cost = !(a->solver->needs & RB_FRICTION_ONLY_2D)
                                        ? 20.0 * order * fmin(order * order, 1e4)
                                    : t->shared->local ? rb_friction_lemke_pairs_flops(t, 2.0 * m)
                                                       : 5.0 * tableau * tableau * tableau;
                paused = rb_friction_task_spent(t) + cost > allowance;
                s = paused ? RB_MAXITER : method->run(t, a->solver->variant);
            } else {
                s = method->go_on(a->state);
                again = s == RB_MAXITER && t->nearly;
                if (again)
                    s = polish(a);
                paused = !again && s == RB_MAXITER &&
                         (rb_friction_task_spent(t) >= t->budget ||
                          (end && a->info.iters >= end && a->info.iters != a->stage_end));
            }
        }
        if (s == RB_OK && rb_friction_prove(&a->task))
            return RB_OK;
        if (s == RB_ENOMEM || s == RB_INTERRUPTED)
            return s;
        if (!paused && !again)
            end_stage(a);
    }
    return RB_MAXITER;
}

/* 1: r has zones that are proved, and leaves what rounding leaves or is proved itself. */
static int take_if_proved(void *context, const double *r)
{
    rb_friction_task *task = context;
    rb_friction_proof proof;
    if (rb_friction_prove_zones(task->problem, r, &proof, NULL) != RB_OK)
        return 0;
    memcpy(task->r, r, (size_t)task->m * sizeof *r);
    task->proved = rb_friction_prove(task) ||
                   (task->measured == RB_OK && task->info->scaled <= task->info->floor);
    if (task->proved)
        task->info->solver = "enumeration";
    return task->proved;
}

/* Few contacts, and no member has found a solution: all states of all contacts in a plane, in
 * space those that stick or are open.  Beside the reactions between bodies of very unlike masses
 * no measure sees the loads, so that a solution is taken where it is proved.  RB_MAXITER: there is
 * none. */
static rb_status try_all_states(rb_friction_task *task)
{
    const double left = task->deadline > 0.0 ? task->deadline - rb_seconds() : 0.0;
    if (task->d > 3 || task->contacts > RB_FRICTION_ALL_UP_TO || left < 0.0)
        return RB_MAXITER;
    rb_friction_solutions all = {0};
    const rb_status s = task->d == 2
                            ? rb_friction_all(task->problem, left, &all, NULL)
                            : rb_friction_try_sticking(task->problem, take_if_proved, task);
    const int ended = s == RB_ENOMEM || s == RB_INTERRUPTED;
    for (int k = 0; !ended && !task->proved && k < all.count; k++)
        take_if_proved(task, all.r + (size_t)k * (size_t)task->m);
    rb_friction_solutions_free(&all);
    return task->proved ? RB_OK : ended ? s : RB_MAXITER;
}

static rb_status run_auto(rb_friction_task *task, int variant)
{
    (void)variant;
    portfolio p;
    const plan *plans;
    rb_status s = choose_plan(task, &plans);
    if (s != RB_OK)
        return s;
    p.task = task;
    p.members = 0;
    p.memory = NULL;
    member *first = add_member(&p, plans), *winner = first;
    s = take_turn(&p, first, INFINITY, &plans->first);
    if (s == RB_MAXITER) {
        const size_t m = (size_t)task->m, n = (size_t)task->n;
        p.memory = rb_alloc(2 * m + n, MEMBERS - 1);
        for (int k = 1; p.memory && k < MEMBERS; k++) {
            rb_friction_task *t = &add_member(&p, &plans[k])->task;
            t->r = p.memory + (size_t)(k - 1) * (2 * m + n);
            t->u = t->r + m;
            t->v = t->u + m;
        }
        if (!p.memory)
            s = RB_ENOMEM;
    }
    double allowance = fmax(rb_friction_task_spent(&first->task), 1.0);
    /* Its sweeps have paused before their number was reached. */
    int stalled = first->solver && first->info.iters < plans->first.iterations;
    const int near = task->best->error < NEAR;
    for (int left = MEMBERS; s == RB_MAXITER && left && iterations_left(&p);) {
        left = 0;
        for (int k = 0; s == RB_MAXITER && k < MEMBERS; k++) {
            member *a = winner = &p.member[k];
            const double head = near ? a->plan->on_stall_near : a->plan->on_stall;
            const double share = stalled && head > 0.0 ? head : a->plan->share;
            if (!a->over)
                s = take_turn(&p, a, allowance * share, NULL);
            left += !a->over;
        }
        stalled = 0;
        if (allowance > MOST_OPERATIONS)
            break;
        allowance *= GROWTH;
    }
    /* The answer is the winner's; operations and iterations are those of all. */
    rb_friction_info *info = task->info;
    const rb_friction_info *proof = &winner->info;
    const rb_friction_task *from = &winner->task;
    for (int k = 0; k < p.members; k++) {
        info->iters += p.member[k].info.iters;
        info->flops += p.member[k].info.flops;
        task->beside += p.member[k].task.beside;
    }
    task->proved = from->proved;
    if (!task->proved)
        rb_friction_task_start(task);
    else {
        if (from->r != task->r) {
            memcpy(task->r, from->r, (size_t)task->m * sizeof(double));
            memcpy(task->u, from->u, (size_t)task->m * sizeof(double));
            memcpy(task->v, from->v, (size_t)task->n * sizeof(double));
        }
        info->solver = proof->solver;
        info->residual = proof->residual;
        info->scaled = proof->scaled;
        info->floor = proof->floor;
        info->worst = proof->worst;
        info->contact = proof->contact;
        info->measure = proof->measure;
    }
    for (int k = 0; k < p.members; k++)
        end_stage(&p.member[k]);
    free(p.memory);
    return s == RB_MAXITER && iterations_left(&p) ? try_all_states(task) : s;
}

const rb_friction_method rb_friction_auto_method = {.run = run_auto};
