/* Tables of columns: what tractions, curves and histories have in common. */
#include "report/internal.h"

#include <math.h>

void rb_report_print_head(FILE *out, const char *command)
{
    fprintf(out, "# rollbem %s\n# %s\n", RB_VERSION, command);
    for (const char *const *line = rb_report_conventions; *line; line++)
        fprintf(out, "# %s\n", *line);
}

/* The k-th column of all parts, and its part; NULL: there are no more. */
static const rb_rolling_result *column(int k, int parts, const rb_report_columns *part,
                                       const rb_report_columns **of)
{
    for (int p = 0; p < parts; p++)
        for (int j = 0; j < part[p].columns->n; j++) {
            const rb_rolling_result *r = &part[p].columns->row[j];
            if (part[p].errors && !r->error_bar)
                continue;
            if (k-- == 0) {
                *of = &part[p];
                return r;
            }
        }
    return NULL;
}

void rb_report_print_names(FILE *out, int parts, const rb_report_columns *part, int bare)
{
    const rb_report_columns *of;
    const rb_rolling_result *r;
    char heading[RB_ROLLING_HEADING];

    for (int k = 0; (r = column(k, parts, part, &of)); k++)
        fprintf(out, "%s%s%s",
                k > 0  ? "\t"
                : bare ? ""
                       : "# ",
                of->errors ? "error_" : "", rb_rolling_heading(r, heading));
    fputc('\n', out);
}

void rb_report_print_row(FILE *out, int i, int parts, const rb_report_columns *part)
{
    const rb_report_columns *of;
    const rb_rolling_result *r;

    for (int k = 0; (r = column(k, parts, part, &of)); k++) {
        const double x = rb_rolling_entry(r, of->owner, i);
        if (k > 0)
            fputc('\t', out);
        if (isfinite(x))
            fprintf(out, "%.17g", x);
        else
            fputs("nan", out); /* whatever its sign: there is no value */
    }
    fputc('\n', out);
}

void rb_report_print_rows(FILE *out, int rows, int parts, const rb_report_columns *part)
{
    for (int i = 0; i < rows; i++)
        rb_report_print_row(out, i, parts, part);
}

rb_status rb_report_print_end(FILE *out)
{
    return fflush(out) == 0 && !ferror(out) ? RB_OK : RB_EWRITE;
}
