/* Exit codes and the one error line. */
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
