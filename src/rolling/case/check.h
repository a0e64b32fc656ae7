/* Checks of a case. */
#ifndef ROLLBEM_ROLLING_CASE_CHECK_H
#define ROLLBEM_ROLLING_CASE_CHECK_H

#include "rolling/history/history.h"

/* Checks the case of a program before its rows, which rb_rolling_program_check checks.  A program
 * of no rows: rb_rolling_case_check. */
rb_status rb_rolling_program_check_base(const rb_rolling_program *program,
                                        const rb_rolling_case *rc, rb_message *why);

/* Checks the numbers of a case: RB_EINVAL "young: expected a number > 0, got -1".  What
 * has its default is not given. */
rb_status rb_rolling_check_ranges(const rb_rolling_case *rc, const rb_rolling_case *defaults,
                                  rb_message *why);
/* Checks a number against the range of the option with this name. */
rb_status rb_rolling_check_number(const char *option, double value, rb_message *why);

#endif
