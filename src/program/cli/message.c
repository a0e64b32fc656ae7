/* Exit codes and the one error line. */
#include "program/cli/cli.h"

#include <stdarg.h>

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

int cli_keep_failures(int keep)
{
    const int before = keeps;
    keeps = keep;
    return before;
}

const char *cli_kept_failure(void)
{
    return kept;
}

cli_exit cli_fail(cli_exit code, const char *format, ...)
{
    char line[4000], shown[8000];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    rb_printable(line, shown, sizeof shown);
    if (keeps)
        snprintf(kept, sizeof kept, "%.399s", shown);
    else
        fprintf(stderr, cli_is_coloured(stderr) ? "\033[31mrollbem:\033[0m %s\n" : "rollbem: %s\n",
                shown);
    return code;
}

cli_exit cli_say_of(const char *option, rb_status s, const rb_message *why)
{
    if (s == RB_OK)
        return CLI_CONTINUE;
    return cli_fail(cli_exit_of(s), "%s%s%s%s", option ? "--" : "", option ? option : "",
                    option ? ": " : "", rb_status_reason(s, why));
}

cli_exit cli_say(rb_status s, const rb_message *why)
{
    return cli_say_of(NULL, s, why);
}
