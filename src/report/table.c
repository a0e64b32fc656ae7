/* The traction table, and the names that all formats share. */
#include "report/internal.h"

#include <stddef.h>

#define COLUMN(name, field, whole)                                                       \
    {                                                                                    \
        name, offsetof(rb_rolling_solution, field), whole                                \
    }

const rb_report_column rb_report_columns[] = {
    COLUMN("x_mm", x, 0),   COLUMN("h_mm", h, 0),         COLUMN("gap_mm", gap, 0),
    COLUMN("p_MPa", p, 0),  COLUMN("q_MPa", q, 0),        COLUMN("un_mm", un, 0),
    COLUMN("ut_mm", ut, 0), COLUMN("shift_mm", shift, 0), COLUMN("slip_1", slip, 0),
    COLUMN("zone", zone, 1)};
const int rb_report_column_n = sizeof rb_report_columns / sizeof rb_report_columns[0];

const char *const rb_report_conventions[] = {
    "x to the right, y up; A is the upper body and rolls towards +x: the leading edge is "
    "at +x",
    "p >= 0: pressure; q: friction on A, positive towards +x; loads per unit length",
    "creepage xi > 0: A's surface slides towards +x over the ground (braked wheel), Q < "
    "0",
    "slip_1 > 0: A's surface slides towards +x; shift_mm likewise",
    "zone: 0 separated, 1 stick, 2 slip with q = -mu p, 3 slip with q = +mu p",
    NULL};

const char *rb_report_formulation(rb_rolling_formulation formulation)
{
    static const char *const names[] = {"static", "steady", "transient"};
    return names[formulation];
}

const char *rb_report_solver(const rb_rolling_solution *s)
{
    static const char *const names[] = {"auto", "lemke", "newton"};
    return s->solver == RB_SOLVER_CONE ? s->cone_solver : names[s->solver];
}

const char *rb_report_lcp_form(rb_rolling_lcp_form form)
{
    return form == RB_LCP_KWAK ? "kwak" : "pivoted";
}

static const void *array_of(const rb_rolling_solution *s, const rb_report_column *c)
{
    return (const char *)s + c->offset;
}

const double *rb_report_doubles(const rb_rolling_solution *s, const rb_report_column *c)
{
    return *(double *const *)array_of(s, c);
}

const int *rb_report_ints(const rb_rolling_solution *s, const rb_report_column *c)
{
    return *(int *const *)array_of(s, c);
}

static void print_headers(FILE *out, const rb_rolling_solution *s, const char *command)
{
    rb_report_print_head(out, command);
    fprintf(out, "# %s, %s; residual %.3g\n", rb_report_formulation(s->formulation),
            rb_status_text(s->status), s->residual);
    for (int k = 0; k < s->patches && s->patches > 1; k++)
        fprintf(out,
                "# patch %d: from %.9g to %.9g mm, p0 = %.9g MPa, P = %.9g, Q = %.9g "
                "N/mm\n",
                k + 1, s->patch[k].from, s->patch[k].to, s->patch[k].max_pressure,
                s->patch[k].normal_load, s->patch[k].tangential_load);
}

static void print_row(FILE *out, const rb_rolling_solution *s, int i)
{
    for (int j = 0; j < rb_report_column_n; j++) {
        const rb_report_column *c = &rb_report_columns[j];
        if (j > 0)
            fputc('\t', out);
        if (c->whole)
            fprintf(out, "%d", rb_report_ints(s, c)[i]);
        else
            fprintf(out, "%.17g", rb_report_doubles(s, c)[i]);
    }
    fputc('\n', out);
}

rb_status rb_report_table(FILE *out, const rb_rolling_solution *s, const char *command,
                          int bare)
{
    if (!bare)
        print_headers(out, s, command);
    for (int j = 0; j < rb_report_column_n; j++)
        fprintf(out, "%s%s", j > 0 ? "\t" : bare ? "" : "# ", rb_report_columns[j].name);
    fputc('\n', out);
    for (int i = 0; i < s->n; i++)
        print_row(out, s, i);
    return rb_report_print_end(out);
}
