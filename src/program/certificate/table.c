/* The certificate of a table: its inputs are those of the command line in its comments,
 * its approach and its motion those that fit its gaps and shifts best. */
#include "program/certificate/internal.h"
#include "rollbem/io.h"

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

/* ---- Comments ---------------------------------------------------------------------- */

/* "# patch 1: from -1 to 1 mm, p0 = 400 MPa, P = 500, Q = -20 N/mm" */
static void compare_patches(rb_certificate *c, const char *text)
{
    const rb_rolling_solution *s = &c->again;
    const double length = 1e-12 * s->half_width, stress = 1e-12 * s->max_pressure,
                 load = 1e-13 * s->normal_load;

    for (int k = 0; k < s->patches && s->patches > 1; k++) {
        const rb_rolling_patch *want = &s->patch[k];
        char start[40];
        double from, to, p0, P, Q;
        snprintf(start, sizeof start, "# patch %d: ", k + 1);
        const char *line = line_behind(text, start);
        if (!line || sscanf(line, "from %lf to %lf mm, p0 = %lf MPa, P = %lf, Q = %lf N/mm", &from,
                            &to, &p0, &P, &Q) != 5) {
            rb_certificate_violated(c, "patch %d is missing", k + 1);
            continue;
        }
        const struct {
            const char *what;
            double printed, want, rounding;
        } numbers[] = {{"from of a patch", from, want->from, length},
                       {"to of a patch", to, want->to, length},
                       {"p0 of a patch", p0, want->max_pressure, stress},
                       {"P of a patch", P, want->normal_load, load},
                       {"Q of a patch", Q, want->tangential_load, load}};
        for (int j = 0; j < 5; j++)
            rb_certificate_expect(c, numbers[j].what, 0, numbers[j].printed, numbers[j].want,
                                  1e-8 * fabs(numbers[j].want) + numbers[j].rounding);
    }
}

/* ---- All together ------------------------------------------------------------------ */

rb_status rb_certificate_check_table(FILE *out, const char *name, const char *text,
                                     const rb_case *words, rb_certificate_outcome *found,
                                     rb_message *why)
{
    const rb_resolved_case *resolved = rb_case_resolved(words);
    rb_io_table t = {0};
    double residual = 0.0;
    char *lines = strdup(text);

    memset(found, 0, sizeof *found);
    const char *refused =
        rb_case_has_steps(resolved)
            ? "its last state depends on the steps before it: take --json --states"
        : resolved->error || resolved->accuracy > 0.0 ? "error bars take solutions on other meshes"
        : resolved->units != RB_UNITS_MM              ? "units other than mm, N, MPa"
                                                      : NULL;
    rb_status s = refused ? rb_certificate_refuse(name, refused, why) : RB_OK;
    if (s == RB_OK && !lines)
        s = RB_ENOMEM;
    /* "# steady, solved; residual 3.1e-14" */
    const char *of = strstr(text, "; residual "), solved[] = ", solved";
    const ptrdiff_t n = (ptrdiff_t)strlen(solved);
    if (s == RB_OK && (!of || sscanf(of, "; residual %lf", &residual) != 1))
        s = rb_certificate_refuse(name, "expected a table of a single case, with its comments",
                                  why);
    if (s == RB_OK && !(of - text > n && strncmp(of - n, solved, (size_t)n) == 0))
        s = rb_certificate_refuse(name, "its status is not solved", why);
    if (s == RB_OK)
        s = rb_io_table_parse(name, lines, &t, why);
    free(lines);
    json_t *table = json_object();
    for (int j = 0; t.name && j < t.columns; j++) {
        char column[80]; /* JSON has no bytes that are not UTF-8; no column of ours is longer */
        rb_report_json_set(&table, rb_printable(t.name[j], column, sizeof column),
                           rb_report_json_numbers(t.rows, t.x + (size_t)j * (size_t)t.rows));
    }
    rb_certificate c = {.out = out, .name = name, .found = found, .table = table};
    if (s == RB_OK && !table)
        s = RB_ENOMEM;
    if (s == RB_OK && t.rows < 3)
        s = rb_fail(why, RB_EFORMAT, "%s: cannot be checked: it has %d elements", name, t.rows);
    if (s == RB_OK)
        s = rb_certificate_rebuild(&c, resolved, t.rows, why);
    if (s == RB_OK)
        s = rb_certificate_assess(&c, residual, why);
    if (s == RB_OK) {
        rb_certificate_expect(&c, "residual", 0, residual, c.again.residual, c.tol);
        compare_patches(&c, text);
    }
    rb_io_table_free(&t);
    s = rb_certificate_end(&c, s, why);
    json_decref(table);
    return s;
}
