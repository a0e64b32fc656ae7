/* Tables of named series: what curves, histories and stresses have in common. */
#include "report/internal.h"

#include <math.h>

void rb_report_print_head(FILE *out, const char *command)
{
    fprintf(out, "# rollbem %s\n# %s\n", RB_VERSION, command);
    for (const char *const *line = rb_report_conventions; *line; line++)
        fprintf(out, "# %s\n", *line);
}

void rb_report_print_names(FILE *out, int columns, const rb_report_series *series,
                           int bare)
{
    if (!bare)
        fputs("# ", out);
    for (int j = 0; j < columns; j++)
        fprintf(out, "%s%s%s", j > 0 ? "\t" : "", series[j].is_error ? "error_" : "",
                series[j].name);
    fputc('\n', out);
}

int rb_report_add_errors(int columns, const rb_report_series *error,
                         rb_report_series *series)
{
    for (int j = 0; j < columns; j++) {
        series[j] = error[j];
        series[j].is_error = 1;
    }
    return columns;
}

void rb_report_print_row(FILE *out, int i, int columns, const rb_report_series *series)
{
    for (int j = 0; j < columns; j++) {
        if (j > 0)
            fputc('\t', out);
        if (!series[j].x)
            fprintf(out, "%d", series[j].k[i]);
        else if (isfinite(series[j].x[i]))
            fprintf(out, "%.17g", series[j].x[i]);
        else
            fputs("nan", out); /* whatever its sign: there is no value */
    }
    fputc('\n', out);
}

void rb_report_print_rows(FILE *out, int rows, int columns,
                          const rb_report_series *series)
{
    for (int i = 0; i < rows; i++)
        rb_report_print_row(out, i, columns, series);
}

rb_status rb_report_print_end(FILE *out)
{
    return fflush(out) == 0 && !ferror(out) ? RB_OK : RB_EWRITE;
}
