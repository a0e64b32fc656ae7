/* Properties of the terminal. */
#include "program/cli/cli.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static int always, never;

int cli_set_colour(const char *when)
{
    always = strcmp(when, "always") == 0;
    never = strcmp(when, "never") == 0;
    return always || never || strcmp(when, "auto") == 0;
}

int cli_is_coloured(FILE *stream)
{
    const char *none = getenv("NO_COLOR");
    if (always || never)
        return always;
    return isatty(fileno(stream)) && !(none && *none);
}

int cli_terminal_width(int fd)
{
    struct winsize size;
    return ioctl(fd, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

int cli_terminal_height(void)
{
    struct winsize size;
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 ? size.ws_row : 24;
}
