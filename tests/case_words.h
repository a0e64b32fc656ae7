/* Cases from pairs of words. */
#ifndef ROLLBEM_TEST_CASE_WORDS_H
#define ROLLBEM_TEST_CASE_WORDS_H

#include "check.h"
#include "rollbem/case.h"

enum { WORDS = 64 };

typedef struct {
    const char *word[WORDS]; /* name, value, name, value, ..., NULL */
} words;

/* The resolved case, with another number of this name (NULL: as the words say). */
static inline rb_case *case_of(rb_case_purpose purpose, const words *w, const char *name,
                               double value)
{
    rb_case *c = rb_case_create(purpose);
    assert_non_null(c);
    for (int k = 0; w->word[k]; k += 2)
        CHECK_OK(rb_case_set(c, w->word[k], w->word[k + 1], RB_GIVEN_ARGUMENT, &heard));
    if (name && rb_case_set_number(c, name, value, &heard) != RB_OK)
        fail_msg("%s", heard.text);
    CHECK_OK(rb_case_resolve(c, &heard));
    return c;
}

#endif
