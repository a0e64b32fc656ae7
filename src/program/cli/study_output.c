/* The output of a study: rows that reach their file as they come, so that the same command goes
 * on from there, or a document that is written at the end. */
#include "program/cli/study.h"

#include "program/cli/case.h"
#include "program/report/report.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static cli_exit cannot_write(const char *path)
{
    return errno == ENOMEM ? cli_fail(CLI_INTERNAL, "%s: out of memory", path)
                           : cli_fail(CLI_CANTWRITE, "%s: cannot write: %s", path, strerror(errno));
}

/* 1: all rows so far are in the file. */
int cli_study_flush(study *st)
{
    if (fflush(st->out) != 0)
        return 0;
    if (st->path)
        st->whole = ftell(st->out);
    return 1;
}

/* ---- Written at the end, whole ------------------------------------------------------------ */

static rb_status write_json(const study *st)
{
    const rb_units units = rb_case_resolved(st->base)->units;
    const rb_rolling_note_list said = rb_rolling_list_study_notes(&st->notes, "case");
    char heading[STUDY_HEADING];
    json_t *root = rb_report_json_start(cli_command_line()), *table = json_object();

    rb_report_json_set(&root, "notes", rb_report_json_notes(&said));
    for (int j = 0; j < cli_study_columns(st); j++)
        rb_report_json_set(&table, cli_study_column_name(st, j, heading),
                           json_incref(json_array_get(st->list, (size_t)j)));
    rb_report_json_set(&root, "units", rb_report_json_units(units));
    rb_report_json_set(&root, "inputs", rb_report_json_inputs(st->base)); /* first case */
    if (st->o->tolerance)
        rb_report_json_uncertain_text(&root, st->o->tolerance);
    rb_report_json_set(&root, "table", table);
    return rb_report_json_write(st->out, root);
}

static cli_exit open_whole(study *st)
{
    rb_message why = {.text = ""};
    const rb_status s = rb_io_writer_open(st->o->output, &st->w, &why);
    if (s != RB_OK)
        return cli_say(s, &why);
    st->out = st->w.file;
    if (st->o->style.format == RB_REPORT_JSON) {
        /* The lists that the rows fill. */
        st->list = json_array();
        for (int j = 0; j < cli_study_columns(st); j++)
            rb_report_json_append(&st->list, json_array());
        return st->list ? CLI_CONTINUE : cli_fail(CLI_INTERNAL, "out of memory");
    }
    cli_study_write_head(st, st->out);
    return CLI_CONTINUE;
}

static cli_exit close_whole(study *st, cli_exit code)
{
    rb_message why = {.text = ""};
    if (!st->complete || st->lost) {
        rb_io_writer_abandon(&st->w);
        return st->lost ? cli_fail(CLI_INTERNAL, "out of memory") : code;
    }
    rb_status s = st->list ? write_json(st) : RB_OK;
    if (s == RB_OK)
        s = rb_io_writer_commit(&st->w, &why);
    else {
        if (s == RB_EWRITE)
            rb_fail(&why, s, "%s: cannot write: %s",
                    st->o->output ? st->o->output : "standard output", strerror(errno));
        const int e = errno;
        rb_io_writer_abandon(&st->w);
        errno = e;
    }
    if (s == RB_EWRITE && !st->o->output && errno == EPIPE)
        return CLI_CANTWRITE; /* | head has seen enough */
    return s == RB_OK ? code : cli_say(s, &why);
}

/* ---- Rows that are kept --------------------------------------------------------------------- */

static cli_exit close_rows(study *st, cli_exit code)
{
    int failed = ferror(st->out) || !cli_study_flush(st), e = errno;
    if (st->out != stdout && fclose(st->out) != 0 && !failed) {
        failed = 1;
        e = errno;
    }
    st->out = NULL;
    if (st->text && !failed) {
        failed = cli_show_table(st->text, 4) != RB_OK;
        e = errno;
    }
    free(st->text);
    st->text = NULL;
    if (failed && st->path) {
        /* What was not written whole is taken back: half a row, half a head. */
        struct stat now;
        if (st->created && st->whole == 0)
            unlink(st->path);
        else if (stat(st->path, &now) == 0 && now.st_size > st->whole)
            (void)!truncate(st->path, st->whole);
    }
    if (!failed || code == CLI_CANTWRITE || (!st->path && e == EPIPE))
        return failed ? CLI_CANTWRITE : code;
    errno = e;
    return cannot_write(st->o->output ? st->o->output : "standard output");
}

/* Reads the rows that are there; what was cut at the end is written over. */
static cli_exit resume(study *st)
{
    char *line = NULL, *head = NULL;
    size_t capacity = 0, size;
    ssize_t n;
    cli_exit code = CLI_CONTINUE;
    /* The head of this study, but for the command line, which may name another count of
     * jobs. */
    FILE *memory = open_memstream(&head, &size);
    int same = memory != NULL;
    if (memory) {
        cli_study_write_head(st, memory);
        same = fclose(memory) == 0;
    }
    const char *wanted = head;
    for (int k = 0; same && k < STUDY_HEAD_LINES; k++) {
        const size_t length = strcspn(wanted, "\n") + 1;
        n = getline(&line, &capacity, st->out);
        same = k == STUDY_COMMAND_LINE ? n > 0
                                       : n == (ssize_t)length && memcmp(line, wanted, length) == 0;
        wanted += length;
    }
    free(head);
    if (!same)
        code = cli_fail(CLI_CANTWRITE, "%s: has other contents; --restart would overwrite it",
                        st->path);
    st->whole = ftell(st->out);
    while (code == CLI_CONTINUE && (n = getline(&line, &capacity, st->out)) > 0 &&
           line[n - 1] == '\n') {
        if (cli_study_is_note(st, line))
            continue;
        if (st->first == st->cases || !cli_study_is_row(st, st->first, line, (size_t)n))
            code = cli_fail(
                CLI_CANTWRITE,
                "%s:%d: not the row of case %d of this study; --restart would overwrite the file",
                st->path, STUDY_HEAD_LINES + st->first + 1, st->first + 1);
        st->first++;
        st->noted = st->found;
        st->whole = ftell(st->out);
    }
    st->found = 0;
    free(line);
    if (code != CLI_CONTINUE)
        st->path = NULL; /* it is another's: nothing of it is taken back */
    if (code == CLI_CONTINUE &&
        (ftruncate(fileno(st->out), st->whole) != 0 || fseek(st->out, st->whole, SEEK_SET) != 0))
        code = cannot_write(st->path);
    if (code == CLI_CONTINUE && !st->o->quiet && st->first > 0)
        fprintf(stderr, "rollbem: %s holds %d of %d case%s\n", st->path, st->first, st->cases,
                rb_plural(st->cases));
    return code;
}

/* A file that keeps the rows as they come: empty, or with the first rows of this study. */
static cli_exit open_kept(study *st, const char *path, int exists)
{
    const int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    st->out = fd >= 0 ? fdopen(fd, "r+") : NULL;
    if (!st->out) {
        const cli_exit code = cannot_write(path);
        if (fd >= 0)
            close(fd);
        return code;
    }
    st->path = path;
    st->created = !exists;
    /* Two processes on one file would mix their rows; some file systems have no locks. */
    struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    struct stat now;
    cli_exit code = CLI_CONTINUE;
    if (fcntl(fd, F_SETLK, &all) != 0 && (errno == EACCES || errno == EAGAIN))
        code = cli_fail(CLI_CANTWRITE, "%s: another process is writing it", path);
    else if (st->o->restart && ftruncate(fd, 0) != 0)
        code = cannot_write(path);
    else if (fstat(fd, &now) == 0 && now.st_size > 0)
        code = resume(st);
    else {
        cli_study_write_head(st, st->out);
        code = cli_study_flush(st) ? CLI_CONTINUE : cannot_write(path);
    }
    return code == CLI_CONTINUE ? code : close_rows(st, code);
}

/* ---- Any of them ---------------------------------------------------------------------------- */

cli_exit cli_study_open(study *st)
{
    struct stat old;
    const char *path = st->o->output;
    const int exists = path && stat(path, &old) == 0;

    /* What cannot be resumed appears at the end, whole. */
    if (st->o->style.format != RB_REPORT_TSV || st->o->style.bare)
        return open_whole(st);
    st->out = stdout;
    if (!path && cli_reader_is_person()) {
        st->out = open_memstream(&st->text, &st->size);
        if (!st->out)
            return cli_fail(CLI_INTERNAL, "out of memory");
        cli_study_write_head(st, st->out);
        return CLI_CONTINUE;
    }
    if (!path || strcmp(path, "-") == 0 || (exists && !S_ISREG(old.st_mode))) {
        if (exists)
            st->out = fopen(path, "w");
        if (!st->out)
            return cannot_write(path);
        cli_study_write_head(st, st->out);
        return CLI_CONTINUE;
    }
    return open_kept(st, path, exists);
}

cli_exit cli_study_close(study *st, cli_exit code)
{
    return st->w.file ? close_whole(st, code) : close_rows(st, code);
}
