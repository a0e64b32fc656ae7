/* Cases that are refused, each with its words, and their neighbours that are not. */
#ifndef REFUSED_H
#define REFUSED_H

#include "check.h"
#include "rolling/rolling.h"

#include <string.h>

static inline void check_refused(const rb_rolling_case *rc, const char *first, const char *second)
{
    CHECK_STATUS(rb_rolling_case_check(rc, &message), RB_EINVAL);
    if (!strstr(message.text, first) || !strstr(message.text, second))
        fail_msg("'%s' does not name '%s' and '%s'", message.text, first, second);
}

/* A default case with these changes is refused with these words, or accepted. */
#define REFUSED(words, ...)                                                                        \
    do {                                                                                           \
        rb_rolling_case rc = rb_rolling_case_defaults();                                           \
        __VA_ARGS__;                                                                               \
        check_refused(&rc, words, "");                                                             \
    } while (0)
#define ACCEPTED(...)                                                                              \
    do {                                                                                           \
        rb_rolling_case rc = rb_rolling_case_defaults();                                           \
        rb_message why = {.text = ""};                                                             \
        __VA_ARGS__;                                                                               \
        if (rb_rolling_case_check(&rc, &why) != RB_OK)                                             \
            fail_msg("%s: %s", #__VA_ARGS__, why.text);                                            \
    } while (0)

#define HUB rc.a.support = RB_BEM_HUB
#define PLANE rc.a.support = RB_BEM_HALFPLANE
#define STEADY rc.formulation = RB_STEADY
#define TRANSIENT rc.formulation = RB_TRANSIENT
/* A half-plane that heats as it rolls. */
#define WARM                                                                                       \
    PLANE;                                                                                         \
    STEADY;                                                                                        \
    rc.speed = 1.0;                                                                                \
    rc.heat_a = (rb_rolling_heat)                                                                  \
    {                                                                                              \
        .conductivity = 40.0, .heat_capacity = 3.5                                                 \
    }

#endif
