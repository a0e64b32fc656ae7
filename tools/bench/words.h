/* A case by its options in words, resolved and solved as by the command line. */
#ifndef ROLLBEM_BENCH_WORDS_H
#define ROLLBEM_BENCH_WORDS_H

#include "rolling/case/case.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* words: "name value name value ...", ended by NULL; later ones win. */
static inline rb_case *case_of_words(const char *const *words)
{
    rb_message why = {.text = ""};
    rb_case *c = rb_case_create(RB_CASE_SINGLE);
    rb_status s = c ? RB_OK : RB_ENOMEM;

    for (; s == RB_OK && *words; words++) {
        char text[300], *rest = text;
        snprintf(text, sizeof text, "%s", *words);
        for (char *name; s == RB_OK && (name = strtok_r(rest, " ", &rest));)
            s = rb_case_set(c, name, strtok_r(NULL, " ", &rest), RB_GIVEN_ARGUMENT, &why);
    }
    if (s == RB_OK)
        s = rb_case_resolve(c, &why);
    if (s != RB_OK) {
        fprintf(stderr, "not a case: %s\n", why.text);
        exit(70);
    }
    return c;
}

/* "NAME N" */
typedef struct {
    char text[40];
} word_number;

static inline word_number word_of(const char *name, int n)
{
    word_number w;
    snprintf(w.text, sizeof w.text, "%s %d", name, n);
    return w;
}

#endif
