/* Cases from options and their values. */
#ifndef ROLLBEM_TEST_CASE_WORDS_H
#define ROLLBEM_TEST_CASE_WORDS_H

#include "check.h"
#include "rolling/case/case.h"

#include <string.h>

enum { WORDS = 16 };

typedef struct {
    const char *word[WORDS]; /* "name value name value ...", in parts, the last one NULL */
} words;

/* The resolved case, with another number of this name (NULL: as the words say). */
static inline rb_case *case_of(rb_case_purpose purpose, const words *w, const char *name,
                               double value)
{
    char text[2000], *rest = text;
    size_t length = 0;
    rb_case *c = NOT_NULL(rb_case_create(purpose));
    for (int k = 0; w->word[k]; k++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%s ", w->word[k]);
    for (char *option; (option = strtok_r(rest, " ", &rest));) {
        const char *given = NOT_NULL(strtok_r(NULL, " ", &rest));
        CHECK_OK(rb_case_set(c, option, given, RB_GIVEN_ARGUMENT, &message));
    }
    if (name && rb_case_set_number(c, name, value, &message) != RB_OK)
        fail_msg("%s", message.text);
    CHECK_OK(rb_case_resolve(c, &message));
    return c;
}

#endif
