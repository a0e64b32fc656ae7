/* The processes that solve the cases of a study.  Two files know who they are, one of
 * which is linked: pool.c (rollbem) has those of this machine, src/program/mpi/pool.c
 * (rollbem-mpi) also those that mpirun started beside this one. */
#ifndef ROLLBEM_CLI_POOL_H
#define ROLLBEM_CLI_POOL_H

#include "rolling/rolling.h"
#include "program/cli/cli.h"

#include <stdint.h>

/* Before anything is read: argv as the command got it.  CLI_CONTINUE, or the exit code. */
cli_exit cli_pool_begin(int argc, char **argv);

/* 1: this process solves what another one hands out, and writes nothing. */
int cli_pool_is_worker(void);

/* CLI_CONTINUE where every process said so, of the same study; otherwise the exit code,
 * after one line about it.  study: a fingerprint. */
cli_exit cli_pool_agree(cli_exit code, uint64_t study);

/* rb_rolling_sweep_run by the pool.  A worker process sees no row. */
rb_status cli_pool_run(const rb_rolling_sweep *sweep, rb_message *why);

/* After cli_pool_begin and whatever came of it. */
void cli_pool_end(void);

/* 1: mpirun (or srun with PMIx) started this process together with others. */
int cli_pool_is_launched(void);

#endif
