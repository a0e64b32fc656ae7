/* SIGINT, SIGTERM and SIGHUP in commands that go from case to case or from step to step.
 * All other work may end at once: files have no name before they are whole (io.h). */
#ifndef ROLLBEM_CLI_INTERRUPT_H
#define ROLLBEM_CLI_INTERRUPT_H

/* From here to cli_interrupts_leave they are noted. */
void cli_interrupts_catch(void);
void cli_interrupts_leave(void);
/* 1: one of them has come since the last cli_interrupts_catch. */
int cli_interrupted(void);

#endif
