/* Options that exclude each other. */
#include "cli/cli.h"

#include <string.h>

const char *cli_source(const cli_option *option, int given, const char *path, char *room,
                       size_t size)
{
    if (given > 0)
        snprintf(room, size, "%s:%d: %s", path, given, option->name);
    else
        snprintf(room, size, "--%s", option->name);
    return room;
}

static size_t size_of(cli_kind kind)
{
    switch (kind) {
    case CLI_NUMBER:
        return sizeof(double);
    case CLI_TEXT:
        return sizeof(const char *);
    default:
        return sizeof(int);
    }
}

static void take_back(const cli_set *set, int i, const void *defaults)
{
    const cli_option *o = &set->options[i];
    memcpy((char *)set->target + o->offset, (const char *)defaults + o->offset,
           size_of(o->kind));
    set->given[i] = 0;
}

static int exclude_each_other(unsigned a, unsigned b, unsigned alike)
{
    a |= a & alike ? alike : 0;
    b |= b & alike ? alike : 0;
    return (a & b) != 0;
}

/* i and j are both given and exclude each other. */
static cli_exit settle_pair(const cli_set *set, int i, int j, const void *defaults,
                            const char *path)
{
    char first[400], second[400];
    const int argument_i = set->given[i] == CLI_GIVEN_ARGUMENT;
    const int argument_j = set->given[j] == CLI_GIVEN_ARGUMENT;
    if (argument_i != argument_j) {
        take_back(set, argument_i ? j : i, defaults);
        return CLI_CONTINUE;
    }
    const cli_option *a = &set->options[i], *b = &set->options[j];
    return cli_fail(argument_i ? CLI_USAGE : CLI_DATA, "%s and %s exclude each other",
                    cli_source(a, set->given[i], path, first, sizeof first),
                    cli_source(b, set->given[j], path, second, sizeof second));
}

cli_exit cli_settle(const cli_set *set, const void *defaults, unsigned alike,
                    const char *path)
{
    for (int i = 0; i < set->n; i++)
        for (int j = i + 1; j < set->n && set->given[i]; j++) {
            if (!set->given[j] || !exclude_each_other(set->options[i].excludes,
                                                      set->options[j].excludes, alike))
                continue;
            const cli_exit code = settle_pair(set, i, j, defaults, path);
            if (code != CLI_CONTINUE)
                return code;
        }
    return CLI_CONTINUE;
}
