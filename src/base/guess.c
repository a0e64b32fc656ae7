/* Finds the name that is most similar to a misspelt word. */
#include "base/base.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int min2(int a, int b)
{
    return a < b ? a : b;
}

void rb_guess_try(rb_guess *guess, const char *candidate)
{
    /* the beginning of a name is as near as one edit */
    enum { BEGINNING = 3 };
    const size_t typed = strlen(guess->word);
    if (typed >= BEGINNING && strncmp(candidate, guess->word, typed) == 0 && candidate[typed] &&
        !(guess->best && guess->distance <= 1)) {
        guess->best = candidate;
        guess->distance = 1;
        return;
    }
    /* every letter more or less is an edit */
    const int at_least = abs((int)typed - (int)strlen(candidate));
    if (guess->best && at_least >= guess->distance)
        return;
    int distance;
    /* Optimal string alignment: insertions, deletions, substitutions and swapped
     * neighbours. */
    enum { MAX = 40 };
    const size_t n = typed, m = strlen(candidate);
    if (n > MAX || m > MAX)
        distance = MAX;
    else {
        int d[MAX + 1][MAX + 1];
        for (size_t i = 0; i <= n; i++)
            d[i][0] = (int)i;
        for (size_t j = 0; j <= m; j++)
            d[0][j] = (int)j;
        for (size_t i = 1; i <= n; i++)
            for (size_t j = 1; j <= m; j++) {
                d[i][j] = min2(d[i - 1][j] + 1, d[i][j - 1] + 1);
                d[i][j] = min2(d[i][j], d[i - 1][j - 1] + (guess->word[i - 1] != candidate[j - 1]));
                if (i > 1 && j > 1 && guess->word[i - 1] == candidate[j - 2] &&
                    guess->word[i - 2] == candidate[j - 1])
                    d[i][j] = min2(d[i][j], d[i - 2][j - 2] + 1);
            }
        distance = d[n][m];
    }
    if (guess->best && distance >= guess->distance)
        return;
    guess->best = candidate;
    guess->distance = distance;
}

const char *rb_guess_text(rb_guess *guess, const char *prefix)
{
    const int length = (int)strlen(guess->word);
    guess->text[0] = '\0';
    /* more than a third wrong is another word, as is another letter */
    if (guess->best && guess->distance <= (length + 2) / 3 &&
        (guess->distance < length || guess->best[0] == guess->word[0]))
        snprintf(guess->text, sizeof guess->text, " (did you mean '%s%s'?)", prefix, guess->best);
    return guess->text;
}
