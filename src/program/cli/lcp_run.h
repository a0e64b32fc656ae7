/* What `rollbem lcp` solves (lcp_solve.c, lcp_game.c) and shows of it (lcp_rows.c). */
#ifndef ROLLBEM_CLI_LCP_RUN_H
#define ROLLBEM_CLI_LCP_RUN_H

#include "program/cli/output.h"
#include "program/cli/rows.h"

#include "lcp/lcp.h"
#include "program/report/report.h"

typedef struct {
    double tol, seconds;
    int game, solver, all, label, max_pivots, rule, trace, solution, prove;
    rb_report_style style;
    const char *q, *lower, *upper, *cover, *start, *output;
} lcp_options;

typedef struct {
    cli_problems files;
    const lcp_options *o;
    const char *solver; /* its name, of --solver */
    const char *file;   /* the current file */
    cli_rows pivots;    /* of it, for JSON alone */
} lcp_run;

typedef struct {
    const char *file, *status, *solver;
    int n; /* 0: not read */
    rb_lcp_info info;
    double floor, seconds;
    rb_sparse M;                           /* owned, as the vectors */
    rb_lcp_mixed_problem boxed;            /* borrows M, lower, upper, and q of the file */
    double *lower, *upper, *cover, *start; /* n each, or NULL */
    double *z, *w;                         /* n x solutions */
    int solutions;                         /* 1 but for --all */
    int singular, undecided;               /* --all: bases */
    int *singular_basis, *nearby;          /* --all: of each solution, or NULL; owned */
    int sets, *set, *member;               /* --game --all: as of rb_lcp_solutions; owned */
    double payoff[2];                      /* --game, the first solution */
    rb_lcp_proof proof;                    /* --prove, of one solution; owned */
    int is_counted;                        /* 1: --all --prove has run: */
    rb_lcp_number number;                  /* owned */
    int is_empty;                          /* 1: n = 0, which is solved */
} lcp_result;

/* ---- lcp_solve.c ----------------------------------------------------------------------- */

rb_lcp_options cli_lcp_solver_options(lcp_run *run, const lcp_result *r);
/* Reads the file of r and solves it; prints why if not.  Free r in any case. */
cli_exit cli_lcp_solve(lcp_run *run, lcp_result *r);

/* How a problem ended, on standard error; each returns the exit code.  s: the status of what was
 * called; code: that so far. */
cli_exit cli_lcp_failed(lcp_result *r, rb_status s, const rb_message *why);
/* The same of numbers in the file: RB_EINVAL is its fault. */
cli_exit cli_lcp_invalid(lcp_result *r, rb_status s, const rb_message *why);
/* "solved" is what the recomputed residual says, not the method. */
cli_exit cli_lcp_end(const lcp_options *o, lcp_result *r, rb_status s);
/* s: of rb_lcp_prove, of rb_lcp_prove_number. */
cli_exit cli_lcp_say_proof(lcp_result *r, rb_status s, cli_exit code);
cli_exit cli_lcp_say_number(lcp_result *r, rb_status s, cli_exit code);

/* --all: r takes over the solutions that the enumeration has found; then what they are, and what
 * it could not decide.  end: RB_OK, RB_TIME_LIMIT. */
rb_status cli_lcp_take_all(lcp_result *r, rb_lcp_solutions *all);
cli_exit cli_lcp_say_all(const lcp_options *o, lcp_result *r, const rb_lcp_solutions *all,
                         rb_status end);

/* ---- lcp_game.c ------------------------------------------------------------------------ */

cli_exit cli_lcp_solve_game(lcp_run *run, lcp_result *r);

/* ---- lcp_rows.c ------------------------------------------------------------------------ */

/* A row of a pivot; context: lcp_run. */
void cli_lcp_trace(const rb_lcp_pivot *p, void *context);
/* 0: nothing is known of the problem, which was not read. */
int cli_lcp_is_known(const lcp_result *r);
/* What --game, --all, --solution, --prove and --trace add to the object of the file. */
void cli_lcp_add_members(const lcp_run *run, cli_rows *rows, const lcp_result *r);
/* A # line of the file, and a row per unknown of each solution. */
void cli_lcp_list_unknowns(const lcp_run *run, cli_rows *rows, const lcp_result *r);

#endif
