/* A complementarity problem of a file: read, solved by one method or by all, and how it ended. */
#include "program/cli/lcp_run.h"

#include "base/io/io.h"

#include <stdlib.h>

/* A scaled residual that rounding leaves. */
static const double ROUNDING = 1e-14;

cli_exit cli_lcp_failed(lcp_result *r, rb_status s, const rb_message *why)
{
    r->status = rb_status_text(s);
    r->n = 0;
    return cli_fail(cli_exit_of(s), "%s", rb_status_reason(s, why));
}

rb_lcp_options cli_lcp_solver_options(lcp_run *run, const lcp_result *r)
{
    rb_lcp_options opt = rb_lcp_defaults();
    opt.max_iters = run->o->max_pivots;
    opt.seconds = run->o->seconds;
    opt.rule = (rb_lcp_rule)run->o->rule;
    opt.cover = r->cover;
    opt.start = r->start;
    opt.trace = run->o->trace ? cli_lcp_trace : NULL;
    opt.trace_context = run;
    return opt;
}

/* The numbers are of a file: RB_EINVAL is its fault. */
cli_exit cli_lcp_invalid(lcp_result *r, rb_status s, const rb_message *msg)
{
    rb_message why = {.text = ""};
    rb_fail(&why, s, "%s: %s", r->file, msg->text);
    return cli_lcp_failed(r, s == RB_EINVAL ? RB_EFORMAT : s, &why);
}

/* A solution of the method whose residual is above the tolerance, and above rounding, is none. */
static rb_status judged(const lcp_options *o, lcp_result *r, rb_status s)
{
    if (s != RB_OK || r->info.scaled <= fmax(o->tol, ROUNDING))
        return s;
    return rb_fail(&r->info.msg, RB_INACCURATE,
                   "the residual of row %d is %.2g of its terms, above --tol %g", r->info.row + 1,
                   r->info.scaled, o->tol);
}

/* "solved" is what the recomputed residual says, not the method. */
cli_exit cli_lcp_end(const lcp_options *o, lcp_result *r, rb_status s)
{
    s = judged(o, r, s);
    const cli_exit code = s == RB_OK ? CLI_OK : CLI_UNSOLVED;
    r->status = s == RB_OK && r->info.scaled > o->tol ? "solved-to-rounding" : rb_status_text(s);
    if (s == RB_MAXITER)
        cli_fail(code, "%s: no solution after --max-pivots %d", r->file,
                 o->max_pivots ? o->max_pivots : r->info.iters);
    else if (code != CLI_OK)
        cli_fail(code, "%s: %s", r->file, r->info.msg.text);
    return code;
}

/* What is proved of z, on standard error; s: of rb_lcp_prove. */
cli_exit cli_lcp_say_proof(lcp_result *r, rb_status s, cli_exit code)
{
    char text[400];
    if (s == RB_EINVAL) { /* the problem was read: z has overflown */
        r->proof.reason = "z is not finite";
        fprintf(stderr, "rollbem: %s: not proved: %s\n", r->file, r->proof.reason);
        return code;
    }
    if (s < 0)
        return cli_lcp_invalid(r, s, &(rb_message){.text = "out of memory"});
    fprintf(stderr, "rollbem: %s: %s\n", r->file,
            rb_report_proof_text(&r->proof, text, sizeof text));
    return code;
}

/* How many solutions there are; s: of rb_lcp_prove_number. */
cli_exit cli_lcp_say_number(lcp_result *r, rb_status s, cli_exit code)
{
    char text[400];
    if (s == RB_INTERRUPTED || s < 0)
        return cli_lcp_failed(r, s, &(rb_message){.text = ""});
    r->is_counted = 1;
    fprintf(stderr, "rollbem: %s: %s%s\n", r->file,
            rb_report_number_text(&r->number, text, sizeof text),
            s == RB_TIME_LIMIT ? " (time limit)" : "");
    return code;
}

/* ---- All solutions ----------------------------------------------------------------- */

/* What the enumeration has found, and what it could not decide.  end: RB_OK, RB_TIME_LIMIT. */
cli_exit cli_lcp_say_all(const lcp_options *o, lcp_result *r, const rb_lcp_solutions *all,
                         rb_status end)
{
    int singular_only = 0, nearby = 0;
    r->info.iters = all->bases;
    r->singular = all->singular;
    r->undecided = all->undecided;
    for (int k = 0; k < all->count; k++)
        singular_only += r->singular_basis[k];
    for (int k = 0; r->nearby && k < all->count; k++)
        nearby += r->nearby[k];
    cli_note_enumeration(r->file, "bases", all->count, nearby, singular_only, all->undecided,
                         all->bases);
    int mixed = 0; /* sets with more than one */
    for (int k = 0; k < r->sets; k++)
        mixed += r->set[k + 1] - r->set[k] > 1;
    if (mixed)
        cli_note(r->file,
                 "%d extreme equilibria in %d maximal set%s; all others are "
                 "mixtures within a set",
                 all->count, r->sets, rb_plural(r->sets));
    if (o->game && all->count && r->sets == 0)
        cli_note(r->file,
                 "%d extreme equilibria, in more than 1000 maximal sets, which are "
                 "not listed",
                 all->count);
    if (all->count && end == RB_OK)
        return cli_lcp_end(o, r, RB_OK);
    if (!all->count)
        r->info.res = r->info.scaled = r->floor = NAN;
    r->status = rb_status_text(end != RB_OK ? end : all->undecided ? RB_UNDECIDED : RB_NO_SOLUTION);
    if (end != RB_OK)
        return cli_fail(CLI_UNSOLVED, "%s: %s", r->file, r->info.msg.text);
    if (all->undecided)
        return cli_fail(CLI_UNSOLVED, "%s: none found, %d of %d complementary bases undecided",
                        r->file, all->undecided, all->bases);
    const char *bases = all->bases == 1 ? "basis" : "bases";
    return all->singular ? cli_fail(CLI_UNSOLVED,
                                    "%s: no solution (%d complementary %s; %d singular, each "
                                    "excluded)",
                                    r->file, all->bases, bases, all->singular)
                         : cli_fail(CLI_UNSOLVED, "%s: no solution (%d complementary %s)", r->file,
                                    all->bases, bases);
}

/* r->z, the solutions, is taken over from all, and r->w made as large. */
rb_status cli_lcp_take_all(lcp_result *r, rb_lcp_solutions *all)
{
    free(r->z);
    free(r->w);
    r->z = all->z;
    r->singular_basis = all->singular_basis;
    r->nearby = all->nearby;
    all->singular_basis = all->nearby = NULL;
    r->sets = all->sets;
    r->set = all->set;
    r->member = all->member;
    all->set = all->member = NULL;
    r->w = rb_alloc((size_t)all->n, (size_t)all->count);
    r->solutions = all->count;
    r->solver = "enumeration";
    all->z = NULL;
    return r->w ? RB_OK : rb_fail(&r->info.msg, RB_ENOMEM, "out of memory");
}

static cli_exit run_all(lcp_run *run, rb_io_matrix *M, lcp_result *r)
{
    rb_lcp_solutions all = {0};
    const double start = rb_seconds();
    rb_status s = rb_fail(&r->info.msg, RB_ENOMEM, "out of memory");
    if (rb_io_matrix_to_dense(M) == RB_OK)
        s = rb_lcp_enumerate(&(rb_lcp_problem){r->n, M->dense, r->n, r->boxed.q}, r->lower,
                             r->upper, run->o->seconds, &all, &r->info.msg);
    r->seconds = rb_seconds() - start;
    const rb_status end = s;
    if (s >= 0)
        s = cli_lcp_take_all(r, &all);
    if (s != RB_OK)
        return cli_lcp_invalid(r, s, &r->info.msg);
    r->floor = all.count ? rb_lcp_rounding_floor(&r->boxed, r->z, r->w) : NAN;
    r->info.res = r->info.scaled = 0.0;
    for (int k = 0; k < all.count; k++) {
        const double *z = r->z + (size_t)k * (size_t)r->n;
        double *w = r->w + (size_t)k * (size_t)r->n, scaled;
        const double res = rb_lcp_residual_mixed(&r->boxed, z, w);
        int row;
        if (rb_lcp_scaled_residual(&r->boxed, z, &scaled, &row) != RB_OK)
            return cli_lcp_invalid(r, RB_ENOMEM, &(rb_message){.text = "out of memory"});
        r->info.res = fmax(r->info.res, res);
        if (!(scaled <= r->info.scaled)) {
            r->info.scaled = scaled;
            r->info.row = row;
        }
    }
    const cli_exit code = cli_lcp_say_all(run->o, r, &all, end);
    if (!run->o->prove || end != RB_OK)
        return code;
    return cli_lcp_say_number(
        r, rb_lcp_prove_number(&r->boxed, NULL, all.count, r->z, run->o->seconds, &r->number),
        code);
}

/* ---- A problem --------------------------------------------------------------------- */

/* What rounding could leave and what z does leave, of the solver's z or of the proof's. */
static rb_status find_residuals(lcp_result *r)
{
    r->floor = rb_lcp_rounding_floor(&r->boxed, r->z, r->w);
    r->info.res = rb_lcp_residual_mixed(&r->boxed, r->z, r->w);
    return rb_lcp_scaled_residual(&r->boxed, r->z, &r->info.scaled, &r->info.row) == RB_OK
               ? RB_OK
               : rb_fail(&r->info.msg, RB_ENOMEM, "out of memory");
}

cli_exit cli_lcp_solve(lcp_run *run, lcp_result *r)
{
    const lcp_options *o = run->o;
    rb_io_lcp p;
    rb_message why = {.text = ""};
    rb_status s = rb_io_lcp_read(r->file, o->q, &p, &why);
    if (s == RB_OK && p.n == 0) { /* nothing is unknown */
        r->status = rb_status_text(RB_OK);
        r->is_empty = 1;
        r->info.res = r->info.scaled = r->seconds = 0.0;
        rb_io_lcp_free(&p);
        return CLI_OK;
    }
    /* The vectors of the options, each of n numbers. */
    if (s == RB_OK && o->lower)
        s = rb_io_bounds_read(o->lower, p.n, "lower", &r->lower, &why);
    if (s == RB_OK && o->upper)
        s = rb_io_bounds_read(o->upper, p.n, "upper", &r->upper, &why);
    if (s == RB_OK && o->cover)
        s = rb_io_vector_read(o->cover, p.n, "cover", &r->cover, &why);
    if (s == RB_OK && o->start)
        s = rb_io_vector_read(o->start, p.n, "start", &r->start, &why);
    if (s == RB_OK) {
        r->n = p.n;
        r->z = rb_alloc((size_t)p.n, 1);
        r->w = rb_alloc((size_t)p.n, 1);
        if (!r->z || !r->w || rb_io_matrix_to_sparse(&p.M, &r->M) != RB_OK)
            s = rb_fail(&why, RB_ENOMEM, "out of memory");
        r->boxed = (rb_lcp_mixed_problem){&r->M, p.q, r->lower, r->upper};
    }
    cli_exit code = CLI_CONTINUE;
    if (s != RB_OK)
        code = cli_lcp_failed(r, s, &why);
    else if (o->all)
        code = run_all(run, &p.M, r);
    if (code == CLI_CONTINUE) {
        const rb_lcp_options opt = cli_lcp_solver_options(run, r);
        const double start = rb_seconds();
        rb_status proved = RB_OK;
        s = rb_lcp_solve(run->solver, &r->boxed, &opt, r->z, &r->info);
        r->seconds = rb_seconds() - start;
        if (s >= 0) {
            r->solver = r->info.solver;
            const rb_status measured = find_residuals(r);
            s = measured == RB_OK ? s : measured;
        }
        if (s >= 0 && o->prove) {
            /* The status says what is proved. */
            const rb_status found = s = judged(o, r, s);
            proved = rb_lcp_prove_answer(&r->boxed, r->z, &s, &r->proof, &r->info.msg);
            if (found != RB_OK && s == RB_OK) {
                s = find_residuals(r);
                cli_note(r->file,
                         "%s found no solution (%s); the proof found this one from its last z",
                         r->solver, rb_status_text(found));
            }
        }
        code = s < 0 ? cli_lcp_invalid(r, s, &r->info.msg) : cli_lcp_end(o, r, s);
        if (s >= 0 && o->prove)
            code = cli_lcp_say_proof(r, proved, code);
    }
    rb_io_lcp_free(&p);
    return code;
}
