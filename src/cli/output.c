#include "cli/output.h"

#include "rollbem/io.h"

#include <errno.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static const rb_choice headers[] = {{"full", 0}, {"bare", 1}, {NULL, 0}};

#define PLACE(member) offsetof(cli_output, member)

static const rb_option options[] = {
    RB_GROUP_LINE("output", "Output"),
    RB_FLAG_LINE("json", PLACE(json), "JSON instead of the table"),
    RB_CHOICE_LINE("header", PLACE(bare), headers,
                   "of the table: # lines and column names, or the names alone"),
    RB_TEXT_LINE("output", PLACE(output), "FILE",
                 "where the table or JSON goes, whole or not at all",
                 .unset = "standard output"),
    RB_TEXT_LINE("plot", PLACE(plot), "FILE", "picture: .png, .svg or .pdf (by gnuplot)",
                 .unset = "none"),
    RB_FLAG_LINE("quiet", PLACE(quiet), "no summary and no notes on standard error"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert((int)OPTIONS <= (int)CLI_OUTPUT_OPTIONS_MAX,
               "CLI_OUTPUT_OPTIONS_MAX is too small");

rb_option_set cli_output_set(cli_output *o)
{
    return (rb_option_set){options, OPTIONS, o, o->given};
}

static cli_exit refuse_picture(const cli_output *o, cli_exit code, const rb_message *why)
{
    return cli_fail(code, "--%s: %s", o->plot_option ? o->plot_option : "plot",
                    why->text);
}

cli_exit cli_output_check(const cli_output *o)
{
    rb_report_picture_kind kind;
    rb_message why;
    if (o->plot && rb_report_picture_kind_of(o->plot, &kind, &why) != RB_OK)
        return refuse_picture(o, CLI_USAGE, &why);
    return CLI_CONTINUE;
}

cli_exit cli_sink_open(const cli_output *o, cli_sink *sink)
{
    rb_message why = {"out of memory"};
    rb_io_writer *w = calloc(1, sizeof *w);
    *sink = (cli_sink){o, w};
    const rb_status s = w ? rb_io_writer_open(o->output, w, &why) : RB_ENOMEM;
    if (s == RB_OK)
        return CLI_CONTINUE;
    free(w);
    sink->writer = NULL;
    return cli_fail(cli_exit_of(s), "%s", why.text);
}

static cli_exit cannot_write(const cli_output *o, rb_status s)
{
    const char *reason = s == RB_EWRITE ? strerror(errno) : rb_status_text(s);
    return cli_fail(cli_exit_of(s), "%s: %s", o->output ? o->output : "standard output",
                    reason);
}

cli_exit cli_sink_write(cli_sink *sink, cli_write *write, const void *context)
{
    rb_message why;
    rb_io_writer *w = sink->writer;
    rb_status s = write(w->file, sink->o, context);
    cli_exit code = CLI_OK;
    if (s != RB_OK) {
        code = cannot_write(sink->o, s);
        rb_io_writer_abandon(w);
    } else {
        s = rb_io_writer_commit(w, &why);
        if (s != RB_OK)
            code = cli_fail(cli_exit_of(s), "%s", why.text);
    }
    free(w);
    sink->writer = NULL;
    return code;
}

void cli_sink_abandon(cli_sink *sink)
{
    if (sink->writer)
        rb_io_writer_abandon(sink->writer);
    free(sink->writer);
    sink->writer = NULL;
}

cli_exit cli_output_draw(const cli_output *o, cli_draw *draw, const void *context)
{
    rb_report_picture_kind kind;
    rb_io_writer w;
    rb_message why;
    if (!o->plot)
        return CLI_OK;
    rb_status s = rb_report_picture_kind_of(o->plot, &kind, &why);
    if (s == RB_OK)
        s = rb_io_writer_open(o->plot, &w, &why);
    if (s != RB_OK)
        return refuse_picture(o, cli_exit_of(s), &why);
    s = draw(w.file, kind, context, &why);
    if (s != RB_OK) {
        rb_io_writer_abandon(&w);
        return refuse_picture(o, CLI_INTERNAL, &why);
    }
    s = rb_io_writer_commit(&w, &why);
    return s == RB_OK ? CLI_OK : cli_fail(cli_exit_of(s), "%s", why.text);
}

int cli_terminal_width(void)
{
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
    return 80;
}

/* ---- Problems from files
 * --------------------------------------------------------------- */

static rb_status write_problems(FILE *out, const char *conventions, json_t *problems)
{
    json_t *root = rb_report_json_start(cli_command_line());
    json_object_set_new(root, "conventions", json_string(conventions));
    json_object_set(root, "problems", problems);
    const rb_status s = rb_report_json_write(out, root);
    json_decref(root);
    return s;
}

cli_exit cli_finish_problems(rb_io_writer *w, const char *conventions, json_t *problems,
                             cli_exit worst)
{
    rb_message why;
    rb_status s = problems ? write_problems(w->file, conventions, problems) : RB_OK;

    json_decref(problems);
    if (s == RB_ENOMEM) {
        rb_io_writer_abandon(w);
        return cli_fail(CLI_INTERNAL, "out of memory");
    }
    s = rb_io_writer_commit(w, &why); /* knows of failed writes */
    return s == RB_OK ? worst : cli_fail(cli_exit_of(s), "%s", why.text);
}
