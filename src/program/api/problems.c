/* Problems that the caller passes as arrays: complementarity problems, friction problems,
 * sweeps of cases. */
#include "analysis/crack/crack_case.h"
#include "program/api/internal.h"

#include "lcp/friction/friction.h"
#include "lcp/lcp.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Every call forgets the arrays, notes and numbers of the call of its kind before it. */
static void begin_problem(rb_api *a, const char *arrays, const char *solver)
{
    rb_api_forget_arrays(a, arrays);
    rb_api_forget_notes(a);
    rb_api_forget_call(a);
    a->iterations = 0;
    a->residual = a->scaled_residual = NAN;
    a->solver = solver;
    a->proof_reason = "";
}

/* ---- Proofs ------------------------------------------------------------------------ */

int rb_api_prove_problems(rb_api *a, int yes)
{
    a->proves = yes != 0;
    return rb_api_ended(a, RB_OK);
}

/* The array "what.name" of n numbers. */
static rb_status keep_numbers(rb_api *a, const char *what, const char *name, int n, const double *x)
{
    char text[40];
    snprintf(text, sizeof text, "%s.%s", what, name);
    return rb_api_copy_array(a, text, n, 1, x) ? RB_OK : RB_ENOMEM;
}

/* Takes over the proof; s: of rb_lcp_prove. */
static rb_status keep_proof(rb_api *a, const char *what, rb_status s, rb_lcp_proof *p)
{
    const double numbers[] = {p->proved, p->undecided, p->isolated, p->bound,    p->stored_within,
                              p->nearby, p->margin,    p->norm,     p->least_sum};
    if (s != RB_OK && s != RB_UNDECIDED)
        return s;
    a->proof_reason = p->reason;
    s = keep_numbers(a, what, "proof", sizeof numbers / sizeof *numbers, numbers);
    if (s == RB_OK && p->proved)
        s = keep_numbers(a, what, "proof.z", p->n, p->z);
    if (s == RB_OK && p->proved)
        s = keep_numbers(a, what, "proof.error", p->n, p->error);
    rb_lcp_proof_free(p);
    return s;
}

/* The same of how many solutions there are; most is NAN where it is not bounded. */
static rb_status keep_number(rb_api *a, const char *what, rb_status s, rb_lcp_number *n)
{
    if (s != RB_OK && s != RB_TIME_LIMIT)
        return s;
    const double numbers[] = {n->least, n->most >= 0 ? n->most : NAN, n->open};
    s = keep_numbers(a, what, "number", 3, numbers);
    rb_lcp_number_free(n);
    return s;
}

static rb_status prove_friction(rb_api *a, const rb_friction_problem *problem, const double *r)
{
    rb_friction_proof p;
    const rb_status s = rb_friction_prove_zones(problem, r, &p, &a->why);
    const double numbers[] = {p.proved,   p.touching, p.isolated, p.bound,     p.stored_within,
                              p.nearby,   p.margin,   p.norm,     p.condensed, p.zones[0],
                              p.zones[1], p.zones[2], p.zones[3]};
    if (s != RB_OK && s != RB_UNDECIDED)
        return s;
    a->proof_reason = p.reason;
    return keep_numbers(a, "friction", "proof", sizeof numbers / sizeof *numbers, numbers);
}

/* ---- Complementarity --------------------------------------------------------------- */

/* The matrix in compressed columns that the caller owns; RB_EINVAL: it is none. */
static rb_status borrow_matrix(int n, const int *p, const int *i, const double *x, rb_sparse *M,
                               rb_message *why)
{
    if (n < 1)
        return rb_fail(why, RB_EINVAL, "lcp: n = %d", n);
    for (int j = 0; j < n; j++)
        if (p[0] != 0 || p[j + 1] < p[j])
            return rb_fail(why, RB_EINVAL, "matrix: column %d begins at %d and ends at %d", j + 1,
                           p[j], p[j + 1]);
    for (int j = 0; j < n; j++)
        for (int k = p[j]; k < p[j + 1]; k++)
            if (i[k] < 0 || i[k] >= n || (k > p[j] && i[k] <= i[k - 1]))
                return rb_fail(why, RB_EINVAL,
                               "matrix: column %d: row %d, expected rows of 0 to %d that increase",
                               j + 1, i[k], n - 1);
    *M = (rb_sparse){n, n, (int *)(uintptr_t)p, (int *)(uintptr_t)i, (double *)(uintptr_t)x};
    return RB_OK;
}

/* A problem without unknowns is solved. */
static int nothing_is_unknown(rb_api *a)
{
    a->iterations = 0;
    a->residual = a->scaled_residual = 0.0;
    return rb_api_ended(a, RB_OK);
}

/* M in compressed columns is borrowed for the call; z and w become arrays of the handle. */
int rb_api_lcp_sparse(rb_api *a, int n, const int *p, const int *i, const double *x,
                      const double *q, const double *lower, const double *upper,
                      const double *start, const char *solver, int max_pivots, double seconds)
{
    rb_lcp_options options = rb_lcp_defaults();
    rb_lcp_info info = {0};
    rb_sparse M;
    int count, known = 0;
    const rb_lcp_solver *solvers = rb_lcp_solvers(&count);
    while (known < count && strcmp(solver, solvers[known].name) != 0)
        known++;
    begin_problem(a, "lcp.", known < count ? solvers[known].name : "");
    options.max_iters = max_pivots;
    options.seconds = seconds;
    options.start = start;
    if (known == count)
        return rb_api_refuse(
            a, "--solver: expected auto, lemke, lemke-sparse or newton, got '%.60s'", solver);
    if (n == 0)
        return nothing_is_unknown(a);
    rb_status s = borrow_matrix(n, p, i, x, &M, &a->why);
    if (s != RB_OK)
        return rb_api_ended(a, s);
    const rb_lcp_mixed_problem problem = {.M = &M, .q = q, .lower = lower, .upper = upper};
    api_array *z = rb_api_make_array(a, "lcp.z", n, 1);
    api_array *w = z ? rb_api_make_array(a, "lcp.w", n, 1) : NULL;
    if (!w)
        return rb_api_ended(a, RB_ENOMEM);
    rb_api_call_begins(a);
    s = rb_lcp_solve(solver, &problem, &options, z->at, &info);
    /* The residual is recomputed from z, also of an iterate that is no solution. */
    if (s >= 0)
        a->residual = rb_lcp_residual_mixed(&problem, z->at, w->at);
    a->why = info.msg;
    if (s >= 0 && s != RB_INTERRUPTED && a->proves) {
        rb_lcp_proof proof;
        const rb_status found = s;
        const rb_status proved =
            keep_proof(a, "lcp", rb_lcp_prove_answer(&problem, z->at, &s, &proof, &a->why), &proof);
        int row;
        if (found != RB_OK && s == RB_OK) { /* z is the one of the proof */
            a->residual = rb_lcp_residual_mixed(&problem, z->at, w->at);
            s = rb_lcp_scaled_residual(&problem, z->at, &info.scaled, &row);
        }
        s = proved == RB_OK ? s : proved;
    }
    s = rb_api_call_ends(a, s);
    a->scaled_residual = info.scaled;
    a->iterations = info.iters;
    a->solver = info.solver ? info.solver : a->solver;
    return rb_api_ended(a, s);
}

/* By way of compressed columns: the solvers look at the structure of M by themselves. */
int rb_api_lcp(rb_api *a, int n, const double *M, const double *q, const char *solver,
               int max_pivots)
{
    rb_sparse columns = {0};
    const rb_status s = n > 0 ? rb_sparse_from_dense(n, n, M, n, &columns) : RB_OK;
    if (s != RB_OK) {
        begin_problem(a, "lcp.", "");
        return rb_api_ended(a, s);
    }
    const int ended = rb_api_lcp_sparse(a, n, columns.p, columns.i, columns.x, q, NULL, NULL, NULL,
                                        solver, max_pivots, 0.0);
    rb_sparse_free(&columns);
    return ended;
}

/* The solutions of a list, rows x count, and which of them are of a singular basis only, or
 * solutions within rounding only. */
static rb_status keep_all(rb_api *a, const char *what, const rb_lcp_solutions *all)
{
    char name[40];
    snprintf(name, sizeof name, "%s.all", what);
    api_array *z = rb_api_make_array(a, name, all->n, all->count);
    snprintf(name, sizeof name, "%s.singular_basis", what);
    api_array *singular = z ? rb_api_make_array(a, name, all->count, 1) : NULL;
    snprintf(name, sizeof name, "%s.nearby", what);
    api_array *nearby = singular ? rb_api_make_array(a, name, all->count, 1) : NULL;
    snprintf(name, sizeof name, "%s.bases", what);
    api_array *bases = nearby ? rb_api_make_array(a, name, 3, 1) : NULL;
    if (!bases)
        return RB_ENOMEM;
    if (all->count > 0)
        memcpy(z->at, all->z, sizeof *z->at * (size_t)all->n * (size_t)all->count);
    for (int k = 0; k < all->count; k++) {
        singular->at[k] = all->singular_basis ? all->singular_basis[k] : 0;
        nearby->at[k] = all->nearby ? all->nearby[k] : 0;
    }
    bases->at[0] = all->bases;
    bases->at[1] = all->singular;
    bases->at[2] = all->undecided;
    return RB_OK;
}

/* All solutions, and with proofs how many there are: `least` are proved to exist, `most` not to be
 * exceeded. */
int rb_api_lcp_all(rb_api *a, int n, const double *M, const double *q, const double *lower,
                   const double *upper, double seconds)
{
    const rb_lcp_problem p = {n, M, n, q};
    rb_lcp_solutions all = {0};
    begin_problem(a, "lcp.", "enumeration");
    rb_api_call_begins(a);
    rb_status s = rb_lcp_enumerate(&p, lower, upper, seconds, &all, &a->why);
    if (s == RB_OK && a->proves) {
        rb_sparse columns = {0};
        rb_lcp_number number;
        s = rb_sparse_from_dense(n, n, M, n, &columns);
        if (s == RB_OK)
            s = keep_number(a, "lcp",
                            rb_lcp_prove_number(&(rb_lcp_mixed_problem){&columns, q, lower, upper},
                                                NULL, all.count, all.z, seconds, &number),
                            &number);
        rb_sparse_free(&columns);
    }
    s = rb_api_call_ends(a, s);
    if ((s == RB_OK || s == RB_TIME_LIMIT) && keep_all(a, "lcp", &all) != RB_OK)
        s = RB_ENOMEM;
    if (s == RB_OK && all.count == 0)
        s = all.undecided
                ? rb_fail(&a->why, RB_UNDECIDED, "lcp: none found, %d of %d bases undecided",
                          all.undecided, all.bases)
                : rb_fail(&a->why, RB_NO_SOLUTION,
                          "lcp: no solution (%d bases; %d singular, each excluded)", all.bases,
                          all.singular);
    rb_lcp_solutions_free(&all);
    return rb_api_ended(a, s);
}

/* One equilibrium by Lemke and Howson's path, or all extreme ones. z: probabilities of both
 * players, m + n; regret: what each pure strategy loses against the other player's. */
int rb_api_game(rb_api *a, int m, int n, const double *A, const double *B, int label, int all_of_it,
                int max_pivots, double seconds)
{
    const rb_lcp_game game = {m, n, A, B, m};
    rb_lcp_options options = rb_lcp_defaults();
    rb_lcp_info info = {0};
    rb_lcp_solutions all = {0};
    begin_problem(a, "game.", all_of_it ? "enumeration" : "lemke-howson");
    options.max_iters = max_pivots;
    options.seconds = seconds;
    if (m < 1 || n < 1 || m > INT_MAX - n)
        return rb_api_refuse(a, "game: %d x %d strategies", m, n);
    api_array *z = rb_api_make_array(a, "game.z", m + n, 1);
    api_array *payoff = z ? rb_api_make_array(a, "game.payoff", 2, 1) : NULL;
    api_array *regret = payoff ? rb_api_make_array(a, "game.regret", m + n, 1) : NULL;
    rb_status s = regret ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        rb_api_call_begins(a);
        if (all_of_it)
            s = rb_lcp_bimatrix_enumerate(&game, seconds, &all, &a->why);
        else {
            s = rb_lcp_bimatrix(&game, label, &options, z->at, &info);
            a->why = info.msg;
        }
        if (s == RB_OK && a->proves) {
            rb_lcp_number number;
            rb_lcp_proof proof;
            s = all_of_it ? keep_number(
                                a, "game",
                                rb_lcp_prove_game_number(&game, all.count, all.z, seconds, &number),
                                &number)
                          : keep_proof(a, "game", rb_lcp_prove_game(&game, z->at, &proof), &proof);
        }
        s = rb_api_call_ends(a, s);
        a->iterations = info.iters;
        a->scaled_residual = all_of_it ? NAN : info.scaled;
    }
    if (s >= 0 && !all_of_it)
        a->residual = rb_lcp_bimatrix_regret(&game, z->at, regret->at, payoff->at);
    if ((s == RB_OK || s == RB_TIME_LIMIT) && all_of_it && keep_all(a, "game", &all) != RB_OK)
        s = RB_ENOMEM;
    rb_lcp_solutions_free(&all);
    return rb_api_ended(a, s);
}

/* ---- Friction ---------------------------------------------------------------------- */

/* r and u, d x contacts, and a copy of mu, which proofs and pictures need beside them. */
static rb_status solve_friction(rb_api *a, const rb_friction_problem *p, const char *solver,
                                double tol, int max_iters)
{
    rb_friction_options options = rb_friction_defaults();
    rb_friction_info info = {0};
    options.tol = tol;
    options.max_iters = max_iters;
    options.measure = a->by_acary ? RB_FRICTION_BY_ACARY : RB_FRICTION_BY_SCALED;
    api_array *r = rb_api_make_array(a, "friction.r", p->dimension, p->contacts);
    api_array *u = r ? rb_api_make_array(a, "friction.u", p->dimension, p->contacts) : NULL;
    api_array *mu = u ? rb_api_copy_array(a, "friction.mu", p->contacts, 1, p->mu) : NULL;
    if (!mu)
        return RB_ENOMEM;
    const rb_friction_solution solution = {r->at, u->at, NULL};
    rb_api_call_begins(a);
    rb_status s = rb_friction_solve(solver, p, &options, &solution, &info);
    a->why = info.msg;
    if (s >= 0 && s != RB_INTERRUPTED && a->proves) {
        const rb_status proved = prove_friction(a, p, r->at);
        s = proved == RB_OK ? s : proved;
    }
    s = rb_api_call_ends(a, s);
    a->solver = info.solver;
    a->iterations = info.iters;
    a->residual = info.residual;
    a->scaled_residual = info.scaled;
    if (s == RB_OK)
        rb_friction_note(tol, &info, &a->note);
    return s;
}

int rb_api_friction_measure(rb_api *a, const char *measure)
{
    const int by_acary = strcmp(measure, "acary") == 0;
    if (!by_acary && strcmp(measure, "scaled") != 0)
        return rb_api_refuse(a, "--measure: expected scaled or acary, got '%.60s'", measure);
    a->by_acary = by_acary;
    return rb_api_ended(a, RB_OK);
}

/* W dense, or in compressed columns (p not NULL); all of it is copied. */
static int local_friction(rb_api *a, int dimension, int contacts, const double *W, const int *p,
                          const int *i, const double *x, const double *q, const double *mu,
                          const char *solver, double tol, int max_iters)
{
    begin_problem(a, "friction.", solver);
    if (contacts == 0 && (dimension == 2 || dimension == 3))
        return nothing_is_unknown(a);
    if (dimension < 2 || dimension > 3 || contacts < 1 || contacts > INT_MAX / dimension)
        return rb_api_refuse(a, "friction: %d contacts of dimension %d, expected 2 or 3", contacts,
                             dimension);
    const size_t m = (size_t)dimension * (size_t)contacts;
    rb_friction_problem problem = {.form = p ? RB_FRICTION_LOCAL_SPARSE : RB_FRICTION_LOCAL_DENSE,
                                   .dimension = dimension,
                                   .contacts = contacts,
                                   .W = p ? NULL : rb_alloc(m, m),
                                   .q = rb_alloc(m, 1),
                                   .mu = rb_alloc((size_t)contacts, 1)};
    rb_sparse borrowed;
    rb_status s = (p || problem.W) && problem.q && problem.mu ? RB_OK : RB_ENOMEM;
    /* The rows and columns of a matrix of the caller are checked before they are followed. */
    if (s == RB_OK && p)
        s = borrow_matrix((int)m, p, i, x, &borrowed, &a->why);
    if (s == RB_OK && p)
        s = rb_sparse_copy(&borrowed, &problem.Ws);
    if (s == RB_OK) {
        if (problem.W && W)
            memcpy(problem.W, W, sizeof *W * m * m);
        if (m > 0) {
            memcpy(problem.q, q, sizeof *q * m);
            memcpy(problem.mu, mu, sizeof *mu * (size_t)contacts);
        }
        s = rb_friction_problem_check(&problem, &a->why);
    }
    if (s == RB_OK)
        s = solve_friction(a, &problem, solver, tol, max_iters);
    rb_friction_problem_free(&problem);
    return rb_api_ended(a, s);
}

int rb_api_friction(rb_api *a, int dimension, int contacts, const double *W, const double *q,
                    const double *mu, const char *solver, double tol, int max_iters)
{
    return local_friction(a, dimension, contacts, W, NULL, NULL, NULL, q, mu, solver, tol,
                          max_iters);
}

int rb_api_friction_sparse(rb_api *a, int dimension, int contacts, const int *p, const int *i,
                           const double *x, const double *q, const double *mu, const char *solver,
                           double tol, int max_iters)
{
    return local_friction(a, dimension, contacts, NULL, p, i, x, q, mu, solver, tol, max_iters);
}

int rb_api_friction_file(rb_api *a, const char *path, const char *solver, double tol, int max_iters)
{
    rb_friction_problem p = {0};
    begin_problem(a, "friction.", solver);
    rb_status s = rb_friction_read(path, &p, &a->why);
    const int is_empty = s == RB_OK && p.contacts == 0;
    if (s == RB_OK && !is_empty)
        s = solve_friction(a, &p, solver, tol, max_iters);
    rb_friction_problem_free(&p);
    return is_empty ? nothing_is_unknown(a) : rb_api_ended(a, s);
}

/* ---- Many cases -------------------------------------------------------------------- */

/* A study: worker processes solve the cases, and this process gets the rows. */
typedef struct {
    rb_api *a;
    rb_api *const *cases;
    rb_case_crack *crack;   /* of each case; NULL: there is none; owned */
    rb_case_slopes *slopes; /* derivatives of each case, of the handle; n = 0: none */
    int now;                /* the case that this process solves */
} study;

static rb_status make_case(int k, rb_rolling_case *rc, void *context)
{
    study *st = context;
    st->now = k;
    *rc = rb_case_resolved(st->cases[k]->words)->rc;
    return RB_OK;
}

static const rb_rolling_program *program_of_case(void *context)
{
    const study *st = context;
    const rb_resolved_case *now = rb_case_resolved(st->cases[st->now]->words);
    return now->program.n > 0 && now->rc.fretting ? &now->program : NULL;
}

static rb_status solve_crack(int k, rb_rolling_row *row, void *context, rb_message *why)
{
    const study *st = context;
    return rb_case_crack_row(rb_case_resolved(st->cases[k]->words), &st->crack[k], row, why);
}

/* A case without derivatives has its results. */
static rb_status measure_slopes(const rb_rolling_model *model, double *own, void *context,
                                rb_message *why)
{
    const study *st = context;
    return rb_case_slopes_row(st->cases[st->now]->words, model, st->slopes, own, why);
}

static api_array *column_of(rb_api *a, const char *name)
{
    char text[120];
    snprintf(text, sizeof text, "sweep.%s", name);
    return rb_api_find_array(a, text);
}

/* 1: a contact has a result of that name, so that a crack's shares its column. */
static int is_of_contact(const char *name)
{
    return rb_rolling_find_result(&rb_rolling_solution_scalars, name) != NULL;
}

static int see_row(int k, const rb_rolling_row *row, void *context)
{
    const study *st = context;
    const rb_rolling_results *table = &rb_rolling_solution_scalars;
    for (int j = 0; j < st->slopes->n; j++)
        for (int side = 0; side < 2; side++)
            st->slopes->value[2 * (k * st->slopes->n + j) + side] = row->own[j];
    for (int j = 0; j < st->slopes->deviations; j++) {
        char name[60];
        snprintf(name, sizeof name, "tolerance.%s", st->slopes->deviation[j]->name);
        column_of(st->a, name)->at[k] = row->own[st->slopes->n + j];
    }
    rb_rolling_row_notes notes = row->notes;
    rb_case_note_materials_of_row(st->cases[k]->words, &notes);
    rb_rolling_add_row_notes(&st->a->rows, k, &notes);
    column_of(st->a, "status")->at[k] = row->solution.status;
    for (int j = 0; j < table->n; j++)
        column_of(st->a, table->row[j].name)->at[k] =
            rb_rolling_number(&table->row[j], &row->solution);
    for (int j = 0; j < rb_case_crack_scalars.n && st->crack; j++) {
        const rb_rolling_result *r = &rb_case_crack_scalars.row[j];
        if (rb_case_crack_has_result(r, &st->crack[k]) || !is_of_contact(r->name))
            column_of(st->a, r->name)->at[k] = rb_case_crack_of_row(r, 0, row);
    }
    return 0;
}

static int tick(int finished, void *context)
{
    const study *st = context;
    st->a->done = finished;
    return st->a->stopped;
}

/* The columns of derivatives and of standard deviations; NULL: none. */
static rb_status choose_slopes(rb_api *a, int n, rb_api *const *cases, const char *derivatives,
                               const char *tolerance, rb_case_slopes *s)
{
    const rb_rolling_results *table = &rb_rolling_solution_scalars;
    const rb_rolling_result *result[RB_ROW_OWN];
    rb_status status = RB_OK;
    int known = 0;
    if (derivatives)
        status = rb_case_slopes_choose(cases[0]->words, table, derivatives, RB_ROW_OWN, s, &a->why);
    if (status == RB_OK)
        status = rb_case_slopes_alloc(n, s);
    for (; known < table->n && known < RB_ROW_OWN; known++)
        result[known] = &table->row[known];
    if (status == RB_OK && tolerance)
        status =
            rb_case_slopes_add_deviations(cases[0]->words, tolerance, known, result, s, &a->why);
    for (int k = 0; k < s->deviations && status == RB_OK; k++) {
        char name[60];
        snprintf(name, sizeof name, "sweep.tolerance.%s", s->deviation[k]->name);
        status = rb_api_make_array(a, name, n, 1) ? RB_OK : RB_ENOMEM;
    }
    return status;
}

/* names NULL: without cracks; derivatives, tolerance NULL: without them. */
static int run_sweep(rb_api *a, int n, rb_api *const *cases, int m, const char *const *names,
                     const char *const *values, const char *derivatives, const char *tolerance,
                     int workers)
{
    rb_case_slopes *own = &a->slopes[API_SLOPES_SWEEP];
    study st = {.a = a, .cases = cases, .slopes = own};
    rb_rolling_sweep of_cases = {.count = n,
                                 .workers = workers,
                                 .make = make_case,
                                 .solve = names ? solve_crack : NULL,
                                 .see = see_row,
                                 .tick = tick,
                                 .program = program_of_case,
                                 .context = &st};
    rb_status s = RB_OK;
    begin_problem(a, "sweep.", NULL);
    rb_api_forget_slopes(a, API_SLOPES_SWEEP);
    if (names && n > 0) {
        st.crack = calloc((size_t)n, sizeof *st.crack);
        s = st.crack ? RB_OK : RB_ENOMEM;
    }
    for (int k = 0; k < n && s == RB_OK; k++)
        if ((s = (rb_status)rb_api_resolve(cases[k])) != RB_OK)
            rb_fail(&a->why, s, "case %d: %.580s", k + 1, rb_api_message(cases[k]));
        else if (rb_case_resolved(cases[k]->words)->error && !names)
            s = rb_fail(&a->why, RB_EINVAL,
                        "case %d: error: these studies have no error bars; rollbem sweep has",
                        k + 1);
        else if (names) {
            /* The crack of case k, with its m options. */
            rb_api *of = st.cases[k];
            rb_message why = {.text = ""};
            st.crack[k] = rb_case_crack_defaults();
            rb_status u =
                rb_api_set_crack(of, m, names, values + (size_t)k * (size_t)m, &st.crack[k], &why);
            if (u == RB_OK)
                u = rb_case_crack_check(rb_case_resolved(of->words), &st.crack[k], &why);
            if (u == RB_OK && !isnan(st.crack[k].paris))
                u = rb_refuse(&why, "paris", "a study has the K of cracks of given lengths");
            if (u != RB_OK)
                rb_api_name_option(&why);
            s = u == RB_OK ? u : rb_fail(&st.a->why, u, "case %d: %.580s", k + 1, why.text);
        }
    a->study_units = n > 0 && s == RB_OK ? rb_case_resolved(cases[0]->words)->units : RB_UNITS_MM;
    for (int k = 1; k < n && s == RB_OK; k++)
        if (rb_case_resolved(cases[k]->words)->units != a->study_units)
            s = rb_fail(&a->why, RB_EINVAL, "case %d: units: the cases of a study have the same",
                        k + 1);
    if (s == RB_OK && (derivatives || tolerance) && n > 0) {
        s = choose_slopes(a, n, cases, derivatives, tolerance, own);
        of_cases.measure = measure_slopes;
    }
    if (s == RB_OK && n > 0) {
        const int cracks = names != NULL;
        const rb_rolling_results *tables[] = {&rb_rolling_solution_scalars, &rb_case_crack_scalars};
        char text[120];
        api_array *made = rb_api_make_array(a, "sweep.status", n, 1);
        for (int t = 0; t <= cracks; t++)
            for (int j = 0; made && j < tables[t]->n; j++) {
                if (t > 0 && is_of_contact(tables[t]->row[j].name))
                    continue;
                snprintf(text, sizeof text, "sweep.%s", tables[t]->row[j].name);
                made = rb_api_make_array(a, text, n, 1);
            }
        s = made ? RB_OK : RB_ENOMEM;
    }
    a->total = n;
    a->row = "case";
    of_cases.units = n > 0 ? rb_case_resolved(cases[0]->words)->units : RB_UNITS_MM;
    if (s == RB_OK) {
        rb_api_call_begins(a);
        s = rb_rolling_sweep_run(&of_cases, &a->why);
        s = rb_api_call_ends(a, s);
    }
    free(st.crack);
    own->tolerance = NULL; /* the caller's */
    if (s != RB_OK)
        rb_api_forget_slopes(a, API_SLOPES_SWEEP);
    return rb_api_ended(a, s);
}

int rb_api_sweep(rb_api *a, int n, rb_api *const *cases, const char *derivatives,
                 const char *tolerance, int workers)
{
    return run_sweep(a, n, cases, 0, NULL, NULL, derivatives, tolerance, workers);
}

int rb_api_sweep_cracks(rb_api *a, int n, rb_api *const *cases, int m, const char *const *names,
                        const char *const *values, int workers)
{
    return run_sweep(a, n, cases, m, names, values, NULL, NULL, workers);
}
