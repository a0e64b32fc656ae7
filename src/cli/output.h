/* Where the results of a command that solves go, and in which format. */
#ifndef ROLLBEM_CLI_OUTPUT_H
#define ROLLBEM_CLI_OUTPUT_H

#include "cli/cli.h"
#include "rollbem/report.h"
#include "rollbem/io.h"

#include <jansson.h>

enum { CLI_OUTPUT_OPTIONS_MAX = 8 };

typedef struct {
    int json, bare, quiet;
    const char *output, *plot;
    const char *plot_option; /* that names the picture; NULL: plot */
    int given[CLI_OUTPUT_OPTIONS_MAX];
} cli_output;

/* --json, --header, --output, --plot, --quiet: section [output]. */
rb_option_set cli_output_set(cli_output *o);

/* Refuses a picture of an unknown kind before anything is solved. */
cli_exit cli_output_check(const cli_output *o);

/* Both write what context is.  RB_EWRITE: errno says why. */
typedef rb_status cli_write(FILE *out, const cli_output *o, const void *context);
typedef rb_status cli_draw(FILE *out, rb_report_picture_kind kind, const void *context,
                           rb_message *why);

/* An output opened before the work, because what cannot be written need not be solved. */
typedef struct {
    const cli_output *o;
    void *writer; /* opaque */
} cli_sink;

cli_exit cli_sink_open(const cli_output *o, cli_sink *sink);
cli_exit cli_sink_write(cli_sink *sink, cli_write *write, const void *context);
/* Nothing appears; does nothing after a write. */
void cli_sink_abandon(cli_sink *sink);

/* The picture asked for by --plot, if any. */
cli_exit cli_output_draw(const cli_output *o, cli_draw *draw, const void *context);

/* Characters in a line of standard error. */
int cli_terminal_width(void);

/* The end of a command that runs over problems from files: the writer takes them as JSON
 * (problems, taken over; NULL: the table is written already) and is committed.  Returns
 * worst, or what went wrong. */
cli_exit cli_finish_problems(rb_io_writer *w, const char *conventions, json_t *problems,
                             cli_exit worst);

#endif
