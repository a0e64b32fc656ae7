/* Exit codes, the one error line, nearest names. */
#include "cli/cli.h"

#include <stdarg.h>
#include <string.h>

cli_exit cli_exit_of(rb_status s)
{
    switch (s) {
    case RB_OK:
        return CLI_OK;
    case RB_EINVAL:
        return CLI_USAGE;
    case RB_EFORMAT:
        return CLI_DATA;
    case RB_ENOENT:
        return CLI_NOINPUT;
    case RB_EWRITE:
        return CLI_CANTWRITE;
    case RB_ENOMEM:
        return CLI_INTERNAL;
    default:
        return s > 0 ? CLI_UNSOLVED : CLI_INTERNAL;
    }
}

static char kept[400];
static int keeps;

void cli_keep_failures(void)
{
    keeps = 1;
}

const char *cli_kept_failure(void)
{
    return kept;
}

cli_exit cli_fail(cli_exit code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (keeps) {
        vsnprintf(kept, sizeof kept, format, args);
    } else {
        fputs("rollbem: ", stderr);
        vfprintf(stderr, format, args);
        fputc('\n', stderr);
    }
    va_end(args);
    return code;
}

static int min2(int a, int b)
{
    return a < b ? a : b;
}

/* Optimal string alignment: insertions, deletions, substitutions and swapped neighbours.
 */
static int edit_distance(const char *a, const char *b)
{
    enum { MAX = 40 };
    const size_t n = strlen(a), m = strlen(b);
    if (n > MAX || m > MAX)
        return MAX;
    int d[MAX + 1][MAX + 1];
    for (size_t i = 0; i <= n; i++)
        d[i][0] = (int)i;
    for (size_t j = 0; j <= m; j++)
        d[0][j] = (int)j;
    for (size_t i = 1; i <= n; i++)
        for (size_t j = 1; j <= m; j++) {
            d[i][j] = min2(d[i - 1][j] + 1, d[i][j - 1] + 1);
            d[i][j] = min2(d[i][j], d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = min2(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[n][m];
}

void cli_guess_try(cli_guess *guess, const char *candidate)
{
    const int distance = edit_distance(guess->word, candidate);
    if (guess->best && distance >= guess->distance)
        return;
    guess->best = candidate;
    guess->distance = distance;
}

const char *cli_guess_text(const cli_guess *guess, const char *prefix)
{
    static char text[80];
    const int length = (int)strlen(guess->word);
    text[0] = '\0';
    /* more than a third wrong is another word */
    if (guess->best && guess->distance <= (length + 2) / 3)
        snprintf(text, sizeof text, " (did you mean '%s%s'?)", prefix, guess->best);
    return text;
}
