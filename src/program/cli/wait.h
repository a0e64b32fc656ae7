/* What a person who waits is told. */
#ifndef ROLLBEM_CLI_WAIT_H
#define ROLLBEM_CLI_WAIT_H

/* From two seconds on a line of a terminal says how long it takes and what is at work
 * (rb_phase); elsewhere a line on standard error does from 20 s of the processor on, and
 * whenever these have doubled. */
void cli_wait_begin(void);
/* Someone else has written to the terminal. */
void cli_wait_rest(void);
/* Takes the line away. */
void cli_wait_end(void);

#endif
