/* Cases as the commands that solve take them: from the command line and a case file. */
#ifndef ROLLBEM_CLI_CASE_H
#define ROLLBEM_CLI_CASE_H

#include "cli/cli.h"

/* For --help of every command that takes a case. */
#define CLI_CASE_SIGNS                                                                   \
    "Signs: x to the right, y up; A is above and rolls towards +x, so the leading\n"     \
    "edge is at +x. Creepage xi = (V_A - V_B)/|V| > 0: A's surface slides towards +x\n"  \
    "over the ground (a braked wheel) and the friction q on A points to -x, Q < 0.\n"    \
    "Pressure p >= 0. Loads per unit length. Units: mm, N, MPa, unless --units says\n"   \
    "others or a value its own (--young 210GPa); columns name theirs.\n"                 \
    "\n"                                                                                 \
    "    y, n                   .---.         P, approach: A moves down\n"               \
    "     |                   /       \\\n"                                              \
    "     |                  |    A    |  -->  rolls towards +x\n"                       \
    "     +--- x, t           \\       /\n"                                              \
    "                           '-^-'         p >= 0 pushes A up\n"                      \
    "    ==============================================================\n"               \
    "     B                      -->          q > 0, Q > 0: friction on A"

#define CLI_CASE_NOTES                                                                   \
    "A case file holds the same names as keys, in the sections named in brackets or\n"   \
    "in none; the command line wins over the file.\n"

/* A case of defaults, or NULL after saying that there is no memory. */
rb_case *cli_case_create(rb_case_purpose purpose);

/* Parses the arguments, reads the case file (the only operand allowed), settles the case,
 * which is the first set of spec, and checks the files that the options name.
 * CLI_CONTINUE or an exit code, its line printed. */
cli_exit cli_case_parse(const cli_spec *spec, int argc, char **argv, rb_case *c,
                        cli_args *args);
/* The same in two parts: what is given, and what it means. */
cli_exit cli_case_read(const cli_spec *spec, int argc, char **argv, rb_case *c,
                       cli_args *args);
cli_exit cli_case_settle(const cli_spec *spec, rb_case *c, const cli_args *args);

/* The system of the plain numbers of a command's own option: the case file's where the
 * file gave it.  given: as in its set. */
rb_units cli_units_of(const rb_case *c, const rb_option *options, int n, const int *given,
                      const char *name);

/* The start of JSON on a case: notes on the solution (s NULL: none), units, inputs, which
 * are taken over. */
struct json_t *cli_case_json(const rb_case *c, const rb_rolling_solution *s,
                             struct json_t *inputs);

/* --example NAME, the last set of every spec of a case, and what it asks for. */
rb_option_set cli_example_set(void);
cli_exit cli_example_read(rb_case *c, const cli_args *args);

/* Prints why the library refused the case; the exit code tells command line from file. */
cli_exit cli_case_refused(const rb_case *c, rb_status s, rb_message *why);

#endif
