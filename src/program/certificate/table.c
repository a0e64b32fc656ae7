/* The certificate of a table: its inputs are those of the command line in its comments,
 * its approach and its motion those that fit its gaps and shifts best. */
#include "program/certificate/internal.h"
#include "base/io/io.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What lies behind `start` in the first line that begins so; NULL: no line does. */
static const char *line_behind(const char *text, const char *start)
{
    const size_t n = strlen(start);
    while (strncmp(text, start, n) != 0) {
        text = strchr(text, '\n');
        if (!text)
            return NULL;
        text++;
    }
    return text + n;
}

rb_status rb_report_table_command(const char *text, char **line)
{
    const char *version = line_behind(text, "# rollbem ");
    const char *next = version ? strchr(version, '\n') : NULL;
    const char *command = next ? line_behind(next + 1, "# rollbem") : NULL;
    *line = command ? strndup(command, strcspn(command, "\r\n")) : NULL;
    return *line ? RB_OK : command ? RB_ENOMEM : RB_EFORMAT;
}

/* ---- Trees ------------------------------------------------------------------------- */

/* A comment as a list of its words; numbers among them as numbers. */
static json_t *words_of(const char *line, size_t n)
{
    json_t *words = json_array();
    char word[200];

    for (size_t i = 0, length; i < n; i += length) {
        i += strspn(line + i, " ");
        if (i >= n)
            break;
        length = strcspn(line + i, " \n");
        length = length < n - i ? length : n - i;
        char *end;
        snprintf(word, sizeof word, "%.*s", (int)length, line + i);
        const double x = rb_read_number(word, &end);
        rb_report_json_append(&words, end > word && strspn(end, ",;:") == strlen(end)
                                          ? rb_report_json_number(x)
                                          : rb_report_json_text(word));
    }
    return words;
}

/* The columns of a table, and its comments. */
static rb_status tree_of(const char *name, const char *text, json_t **tree, rb_message *why)
{
    rb_io_table t = {0};
    char *lines = strdup(text);
    json_t *columns = json_object(), *comments = json_array();
    rb_status s = lines ? rb_io_table_parse(name, lines, &t, why) : RB_ENOMEM;

    free(lines);
    for (int j = 0; s == RB_OK && j < t.columns; j++) {
        char column[80]; /* JSON has no bytes that are not UTF-8; no column of ours is longer */
        rb_report_json_set(&columns,
                           t.name ? rb_printable(t.name[j], column, sizeof column) : "unnamed",
                           rb_report_json_numbers(t.rows, t.x + (size_t)j * (size_t)t.rows));
    }
    for (const char *line = text; s == RB_OK && line && *line;) {
        const char *end = strchr(line, '\n');
        size_t n = end ? (size_t)(end - line) : strlen(line);
        n -= n > 0 && line[n - 1] == '\r'; /* of an editor on Windows, at the end alone */
        if (*line == '#')
            rb_report_json_append(&comments, words_of(line, n));
        line = end ? end + 1 : NULL;
    }
    rb_io_table_free(&t);
    *tree = json_object();
    rb_report_json_set(tree, "table", columns);
    rb_report_json_set(tree, "comments", comments);
    return s == RB_OK && !*tree ? RB_ENOMEM : s;
}

/* ---- All together ------------------------------------------------------------------ */

typedef struct {
    const json_t *tree;
    const rb_case *words;
    const char *command;
    double residual, elements, boundary; /* in the comments */
} source;

static rb_status write_table(rb_certificate *c, void *context, json_t **again, rb_message *why)
{
    const source *of = context;
    const rb_resolved_case *resolved = rb_case_resolved(of->words);
    const rb_certificate_contact stored = {
        NULL, json_object_get(of->tree, "table"), NULL, of->residual, of->elements, of->boundary};
    const int is_aligned = resolved->rc.mesh == RB_MESH_ALIGNED;
    rb_case_result r = {.has_errors = 0};
    rb_status s = rb_certificate_restore(c, resolved, &stored, &r, NULL, why);

    /* Equal elements that lie at the edges look like those that are used instead, of which a note
     * tells. */
    for (int tries = 0; tries <= is_aligned && s == RB_OK; tries++) {
        char *text = NULL;
        size_t size;
        FILE *lines = open_memstream(&text, &size);
        const rb_rolling_note_list notes = rb_case_find_notes(of->words, &r.solution, NULL);
        s = lines ? rb_report_table(lines, &resolved->rc, &r.solution, &notes, of->command,
                                    &(rb_report_style){.format = RB_REPORT_TSV})
                  : RB_ENOMEM;
        if (lines && (fclose(lines) != 0 || !text)) /* success without a text: no memory */
            s = RB_ENOMEM;
        json_decref(*again);
        *again = NULL;
        if (s == RB_OK)
            s = tree_of(c->name, text, again, why);
        free(text);
        if (json_array_size(json_object_get(*again, "comments")) ==
            json_array_size(json_object_get(of->tree, "comments")))
            break;
        r.solution.equal_instead = !r.solution.equal_instead;
    }
    rb_case_result_free(&r);
    return s;
}

rb_status rb_certificate_check_table(FILE *out, const char *name, const char *text,
                                     const rb_case *words, rb_certificate_outcome *found,
                                     rb_message *why)
{
    const rb_resolved_case *resolved = rb_case_resolved(words);
    rb_certificate c = {.out = out, .name = name, .found = found, .of = ""};
    json_t *tree = NULL;
    char *line = NULL, command[4200];
    rb_message reason = {.text = ""};

    *found = (rb_certificate_outcome){.prove = found->prove};
    const char *refused =
        rb_case_has_steps(resolved)
            ? "its last state depends on the steps before it: take --json --states"
        : strncmp(text, "x/a\t", 4) == 0 ? "dimensionless: take --json"
        : resolved->units != RB_UNITS_MM ? "units other than mm, N, MPa"
                                         : NULL;
    rb_status s = refused ? rb_certificate_refuse(&c, refused, &reason) : RB_OK;
    /* "# steady, solved; residual 3.1e-14" */
    const char *of = strstr(text, "; residual "), solved[] = ", solved";
    const ptrdiff_t n = (ptrdiff_t)strlen(solved);
    double residual;
    if (s == RB_OK && (!of || sscanf(of, "; residual %lf", &residual) != 1))
        s = rb_certificate_refuse(&c, "expected a table of a single case, with its comments",
                                  &reason);
    if (s == RB_OK && !(of - text > n && strncmp(of - n, solved, (size_t)n) == 0))
        s = rb_certificate_refuse(&c, "its status is not solved", &reason);
    if (s == RB_OK)
        s = rb_report_table_command(text, &line);
    if (s == RB_OK)
        s = tree_of(name, text, &tree, &reason);
    if (s == RB_OK) {
        snprintf(command, sizeof command, "rollbem%s", line);
        source from = {tree, words, command, residual, NAN, NAN};
        /* "# accuracy_elements 100, accuracy_boundary 1.5", the latter NaN without wheels */
        const char *mesh = line_behind(text, "# accuracy_elements ");
        if (mesh)
            sscanf(mesh, "%lf, accuracy_boundary %lf", &from.elements, &from.boundary);
        s = rb_certificate_compare(&c, tree, write_table, &from, &reason);
    }
    free(line);
    json_decref(tree);
    return rb_certificate_end(&c, s, &reason, why);
}
