/* A bimatrix game of a file, by Lemke and Howson's method or by all extreme equilibria. */
#include "program/cli/lcp_run.h"

#include "base/io/io.h"

#include <math.h>

cli_exit cli_lcp_solve_game(lcp_run *run, lcp_result *r)
{
    rb_io_bimatrix g;
    rb_message why = {.text = ""};
    rb_status s = rb_io_bimatrix_read(r->file, &g, &why);
    if (s == RB_OK && run->o->label > g.m + g.n)
        s = rb_fail(&why, RB_EINVAL, "--label: expected one of the %d strategies of %.200s, got %d",
                    g.m + g.n, r->file, run->o->label);
    if (s != RB_OK) {
        rb_io_bimatrix_free(&g);
        return cli_lcp_failed(r, s, &why);
    }
    const rb_lcp_options opt = cli_lcp_solver_options(run, r);
    const rb_lcp_game game = {g.m, g.n, g.A, g.B, g.m};
    const double start = rb_seconds();
    rb_lcp_solutions all = {0};
    s = rb_fail(&r->info.msg, RB_ENOMEM, "out of memory");
    r->n = g.m + g.n;
    r->solver = "lemke-howson";
    r->z = rb_alloc((size_t)r->n, 1);
    r->w = rb_alloc((size_t)r->n, 1);
    if (run->o->all)
        s = rb_lcp_bimatrix_enumerate(&game, run->o->seconds, &all, &r->info.msg);
    else if (r->z && r->w)
        s = rb_lcp_bimatrix(&game, run->o->trace && !run->o->label ? 0 : run->o->label - 1, &opt,
                            r->z, &r->info);
    r->seconds = rb_seconds() - start;
    const rb_status end = s;
    if (run->o->all && s >= 0)
        s = cli_lcp_take_all(r, &all);
    if (s >= 0) {
        /* z = (x, y), w = what each strategy loses, of all solutions; the residual is the
         * worst, the payoffs are those of the first. */
        const size_t entries = (size_t)game.m * (size_t)game.n, n = (size_t)r->n;
        r->info.res = 0.0;
        for (int k = r->solutions - 1; k >= 0; k--)
            r->info.res =
                fmax(r->info.res, rb_lcp_bimatrix_regret(&game, r->z + (size_t)k * n,
                                                         r->w + (size_t)k * n, r->payoff));
        const double size = fmax(rb_norm_inf(entries, game.A), rb_norm_inf(entries, game.B));
        r->floor = 1e-14 * size;
        r->info.scaled = size > 0.0 ? r->info.res / size : r->info.res;
    }
    cli_exit code = s < 0         ? cli_lcp_invalid(r, s, &r->info.msg)
                    : run->o->all ? cli_lcp_say_all(run->o, r, &all, end)
                                  : cli_lcp_end(run->o, r, s);
    if (run->o->prove && run->o->all && end == RB_OK && s >= 0)
        code = cli_lcp_say_number(
            r, rb_lcp_prove_game_number(&game, r->solutions, r->z, run->o->seconds, &r->number),
            code);
    else if (run->o->prove && s >= 0 && !run->o->all)
        code = cli_lcp_say_proof(r, rb_lcp_prove_game(&game, r->z, &r->proof), code);
    rb_io_bimatrix_free(&g);
    return code;
}
