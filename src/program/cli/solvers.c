#include "program/cli/solvers.h"

const rb_choice cli_friction_measures[] = {
    {"scaled", RB_FRICTION_BY_SCALED}, {"acary", RB_FRICTION_BY_ACARY}, {NULL, 0}};

cli_exit cli_friction_solver(const char *option, const char *name,
                             const rb_friction_solver **solver)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    rb_guess guess = {.word = name};
    *solver = rb_friction_solver_named(name);
    if (*solver)
        return CLI_CONTINUE;
    for (int k = 0; k < count; k++)
        rb_guess_try(&guess, all[k].name);
    return cli_fail(CLI_USAGE, "--%s: no friction solver is called '%s'%s", option, name,
                    rb_guess_text(&guess, ""));
}

void cli_friction_solver_lines(char *text, size_t size)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    text[0] = '\0';
    for (int k = 0; k < count; k++)
        rb_append(text, size, "  %-17s %s: %s%s\n", all[k].name, all[k].method, all[k].summary,
                  all[k].needs & RB_FRICTION_ONLY_2D ? " (2D)" : "");
}
