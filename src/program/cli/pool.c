/* The worker pool of rollbem: processes of this machine.  Under mpirun rollbem-mpi takes
 * over: the library of MPI would slow the start of every command. */
#include "program/cli/pool.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

cli_exit cli_pool_begin(int argc, char **argv)
{
    if (!cli_pool_is_launched())
        return CLI_CONTINUE;
    /* The program beside this one. */
    char path[4096];
    const ssize_t n = readlink("/proc/self/exe", path, sizeof path - sizeof "-mpi");
    char **all = calloc((size_t)argc + 2, sizeof *all);

    if (n > 0 && all) {
        strcpy(path + n, "-mpi");
        all[0] = path;
        memcpy(all + 1, argv, (size_t)argc * sizeof *all);
        execv(path, all);
    }
    free(all);
    return cli_fail(CLI_INTERNAL, "started by mpirun, but there is no rollbem-mpi beside "
                                  "rollbem: built without Open MPI");
}

int cli_pool_is_worker(void)
{
    return 0;
}

cli_exit cli_pool_agree(cli_exit code, uint64_t study)
{
    (void)study;
    return code;
}

rb_status cli_pool_run(const rb_rolling_sweep *sweep, rb_message *why)
{
    return rb_rolling_sweep_run(sweep, why);
}

void cli_pool_end(void)
{
}
