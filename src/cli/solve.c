/* rollbem [OPTION...] [CASE.ini]: solves one case. */
#include "cli/cli.h"

int cli_solve(int argc, char **argv)
{
    const cli_spec spec = {.synopsis = "rollbem [OPTION...] [CASE.ini]",
                           .about = "Solves one case of rolling contact."};
    cli_args args = {0};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    cli_args_free(&args);
    return code == CLI_CONTINUE ? CLI_OK : code;
}
