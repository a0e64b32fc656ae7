/* rollbem prony FILE: measured E' and tan delta as --relaxation-time and --relaxation-ratio. */
#include "analysis/prony/prony.h"
#include "program/cli/cli.h"
#include "program/cli/output.h"
#include "program/cli/rows.h"
#include "rolling/case/options.h"

#include <gsl/gsl_math.h>
#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

/* Relative deviations above it are worth a note; so is a plateau that the data miss by more. */
static const double SMALL = 0.05;

enum { NOTES = 5 };

typedef struct {
    int units;
    double per_decade;
    cli_output output;
    int given[20];
    rb_io_table table;
    rb_prony_data data;
    rb_prony_series series;
    char options[800];
    int notes;
    rb_message note[NOTES];
} prony;

#define PLACE(member) offsetof(prony, member)

static const rb_option options[] = {
    RB_GROUP_LINE("prony", "Relaxation times"),
    RB_NUMBER_LINE("per-decade", PLACE(per_decade), "", RB_FROM_TO(0.5, 8),
                   "relaxation times per decade, equally spaced in log, from which the fit chooses",
                   .unset = "2, doubled while the deviation falls by a third"),
    RB_CHOICE_LINE("units", PLACE(units), rb_case_systems,
                   "of moduli whose column names no unit, and of the results", .common = 1),
    RB_GROUP_LINE("output", "Output"),
    CLI_STYLE_LINES(PLACE(output.style)),
    CLI_OUTPUT_LINE(PLACE(output.output)),
    CLI_PLOT_LINES(PLACE(output.plot), PLACE(output.pictures)),
    RB_FLAG_LINE("quiet", PLACE(output.quiet), "no summary and no notes on standard error"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS <= 20, "given");

static const char about[] =
    "Fits a Prony series to moduli measured over the frequency at one temperature, and prints\n"
    "the options --young, --relaxation-time, --relaxation-ratio that make it the material of a\n"
    "roll. FILE: columns frequency_Hz or omega_rad/s, storage_modulus_MPa (E'), and tan_delta or\n"
    "loss_modulus_MPa (E''), in any order and units.";

static const char notes[] =
    "The series is that of the creep compliance, 1/(E' + i E'') = (1 + sum f_k/(1 + i w "
    "tau_k))/E_g\n"
    "with E_g and f_k >= 0 by least squares of the relative deviations. Of --poisson, which stays\n"
    "constant, the data say nothing: give it as well.\n"
    "Example: rollbem prony examples/roll/rubber.tsv --plot rubber.png\n"
    "Exit codes: 0 fitted; 1 not fitted; 64, 65, 66, 70, 73 as of the other commands.\n";

static double modulus(const prony *p, double x)
{
    return rb_unit_shown((rb_units)p->units, "MPa", x);
}

static const char *unit(const prony *p)
{
    return rb_unit_name((rb_units)p->units, "MPa");
}

/* ---- Words ----------------------------------------------------------------------------- */

static void write_list(prony *p, const char *option, const double *x)
{
    for (int k = 0; k < p->series.terms; k++)
        rb_append(p->options, sizeof p->options, "%s%.6g", k ? "," : option, x[k]);
}

static void write_options(prony *p)
{
    rb_append(p->options, sizeof p->options, "--young %.6g%s", modulus(p, p->series.young),
              unit(p));
    write_list(p, " --relaxation-time ", p->series.time);
    write_list(p, " --relaxation-ratio ", p->series.ratio);
}

static void RB_PRINTF(2, 3) add_note(prony *p, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(p->note[p->notes].text, sizeof p->note->text, format, args);
    va_end(args);
    p->notes++;
}

static void find_notes(prony *p)
{
    const rb_prony_data *d = &p->data;
    const rb_prony_series *s = &p->series;
    int low = 0, high = 0;
    for (int i = 1; i < d->n; i++) {
        low = d->omega[i] < d->omega[low] ? i : low;
        high = d->omega[i] > d->omega[high] ? i : high;
    }
    if (s->largest > SMALL)
        add_note(p,
                 "the largest deviation is %.2g %%, at %.4g rad/s: too few relaxation times per "
                 "decade, or scatter of the data",
                 100.0 * s->largest, d->omega[s->worst]);
    if (d->storage[high] < (1.0 - SMALL) * s->young)
        add_note(p,
                 "E_g = %.4g %s is extrapolated: E' of the highest frequency, %.4g rad/s, is %.4g "
                 "%s",
                 modulus(p, s->young), unit(p), d->omega[high], modulus(p, d->storage[high]),
                 unit(p));
    if (d->storage[low] > (1.0 + SMALL) * rb_prony_slow(s))
        add_note(p,
                 "the modulus of slow loads, %.4g %s, is extrapolated: E' of the lowest frequency, "
                 "%.4g rad/s, is %.4g %s",
                 modulus(p, rb_prony_slow(s)), unit(p), d->omega[low], modulus(p, d->storage[low]),
                 unit(p));
    if (s->limited)
        add_note(p, "%.2g times per decade: a body has at most %d", s->per_decade,
                 RB_ROLLING_TERMS);
    if (s->terms == 0)
        add_note(p, "the data show no relaxation: the material is elastic");
}

static void summarise_prony(FILE *out, const void *context)
{
    const prony *p = context;
    const rb_prony_series *s = &p->series;
    for (int k = 0; k < p->notes; k++)
        fprintf(out, "note: %s\n", p->note[k].text);
    fprintf(out, "%d term%s of %.3g times per decade, %d pair%s joined; %d points\n", s->terms,
            rb_plural(s->terms), s->per_decade, s->joined, rb_plural(s->joined), p->data.n);
    fprintf(out, "deviation rms %.2g %%, largest %.2g %% at %.4g rad/s; slow loads %.4g %s\n",
            100.0 * s->rms, 100.0 * s->largest, p->data.omega[s->worst],
            modulus(p, rb_prony_slow(s)), unit(p));
    fprintf(out, "%s\n", p->options);
}

/* ---- Results --------------------------------------------------------------------------- */

/* Columns with the unit of the results in their names. */
enum { WITH_UNIT = 4 };
typedef char headings[WITH_UNIT][40];

/* Without what converting to rad/s and MPa and back has rounded. */
static double measured(double x)
{
    char text[RB_NUMBER_TEXT];
    rb_format(text, sizeof text, "%.15g", x);
    return rb_read_number(text, NULL);
}

static void add_rows(const prony *p, headings heading, cli_rows *rows)
{
    for (int i = 0; i < p->data.n; i++) {
        const double omega = p->data.omega[i], storage = p->data.storage[i], loss = p->data.loss[i];
        double E, E_loss;
        rb_prony_moduli(&p->series, omega, &E, &E_loss);
        const cli_value values[] = {
            CLI_NUMBER("omega", "omega_rad/s", measured(omega)),
            CLI_NUMBER("frequency", "frequency_Hz", measured(omega / (2.0 * M_PI))),
            CLI_NUMBER("storage_modulus", heading[0], measured(modulus(p, storage))),
            CLI_NUMBER("storage_fitted", heading[1], modulus(p, E)),
            CLI_NUMBER("loss_modulus", heading[2], measured(modulus(p, loss))),
            CLI_NUMBER("loss_fitted", heading[3], modulus(p, E_loss)),
            CLI_NUMBER("tan_delta", "tan_delta", measured(loss / storage)),
            CLI_NUMBER("tan_delta_fitted", "tan_delta_fitted", E_loss / E),
            CLI_NUMBER("deviation", "deviation",
                       hypot(storage - E, loss - E_loss) / hypot(E, E_loss))};
        cli_rows_add(rows, sizeof values / sizeof *values, values);
    }
}

static json_t *json_of(const prony *p, json_t *points)
{
    const rb_prony_series *s = &p->series;
    json_t *root = rb_report_json_start(cli_command_line()), *list = json_array();
    rb_report_json_set(&root, "units", rb_report_json_units((rb_units)p->units));
    rb_report_json_set(&root, "options", json_string(p->options));
    rb_report_json_set(&root, "young", rb_report_json_number(modulus(p, s->young)));
    rb_report_json_set(&root, "young_slow", rb_report_json_number(modulus(p, rb_prony_slow(s))));
    rb_report_json_set(&root, "relaxation_time", rb_report_json_numbers(s->terms, s->time));
    rb_report_json_set(&root, "relaxation_ratio", rb_report_json_numbers(s->terms, s->ratio));
    rb_report_json_set(&root, "rms", rb_report_json_number(s->rms));
    rb_report_json_set(&root, "largest", rb_report_json_number(s->largest));
    rb_report_json_set(&root, "largest_at", rb_report_json_number(p->data.omega[s->worst]));
    rb_report_json_set(&root, "per_decade", rb_report_json_number(s->per_decade));
    rb_report_json_set(&root, "joined", json_integer(s->joined));
    for (int k = 0; k < p->notes; k++)
        rb_report_json_append(&list, json_string(p->note[k].text));
    rb_report_json_set(&root, "notes", list);
    rb_report_json_set(&root, "points", points);
    return root;
}

static rb_status write_results(FILE *out, const void *context, rb_message *why)
{
    const prony *p = context;
    (void)why;
    static const char *const names[WITH_UNIT] = {"storage_modulus", "storage_fitted",
                                                 "loss_modulus", "loss_fitted"};
    headings heading;
    char columns[300] = "omega_rad/s frequency_Hz";
    for (int k = 0; k < WITH_UNIT; k++) {
        snprintf(heading[k], sizeof heading[k], "%s_%s", names[k], unit(p));
        rb_append(columns, sizeof columns, " %s", heading[k]);
    }
    rb_append(columns, sizeof columns, " tan_delta tan_delta_fitted deviation");
    cli_rows rows = cli_rows_begin(out, &p->output.style, columns);
    if (!rows.is_json) {
        rb_report_comment(&rows.cells, "%s", p->options);
        rb_report_comment(&rows.cells, "deviation rms %.3g, largest %.3g", p->series.rms,
                          p->series.largest);
        for (int k = 0; k < p->notes; k++)
            rb_report_comment(&rows.cells, "note: %s", p->note[k].text);
    }
    add_rows(p, heading, &rows);
    return rows.is_json ? rb_report_json_write(out, json_of(p, rows.list)) : rb_report_flush(out);
}

static rb_status draw_prony(FILE *out, rb_report_canvas canvas, const void *context,
                            rb_message *why)
{
    const prony *p = context;
    const rb_report_prony drawn = {&p->data, &p->series, (rb_units)p->units};
    return rb_report_prony_picture(out, canvas, &drawn, why);
}

/* ---- Command --------------------------------------------------------------------------- */

static cli_exit fit_file(prony *p, const char *path)
{
    rb_message why = {.text = ""};
    cli_exit code =
        cli_say(rb_prony_read(path, (rb_units)p->units, &p->table, &p->data, &why), &why);
    if (code != CLI_CONTINUE)
        return code;
    code =
        cli_say(rb_prony_solve(&p->data, p->per_decade, RB_ROLLING_TERMS, &p->series, &why), &why);
    if (code != CLI_CONTINUE)
        return code;
    write_options(p);
    find_notes(p);
    const int first = !p->output.output && cli_reader_is_person();
    cli_page_begin();
    if (first && !p->output.quiet)
        cli_print_lines(summarise_prony, p);
    code = cli_write_file(p->output.output, write_results, p);
    if (code == CLI_OK)
        code = cli_draw_file(&p->output.pictures, "plot", p->output.plot, draw_prony, p);
    if (code == CLI_OK && !first && !p->output.quiet)
        cli_print_lines(summarise_prony, p);
    cli_page_end();
    return code;
}

int cli_prony(int argc, char **argv)
{
    prony p = {.per_decade = NAN};
    cli_args args = {0};
    const cli_spec spec = {.synopsis = "rollbem prony [OPTION...] FILE",
                           .about = about,
                           .notes = notes,
                           .sets = {{options, OPTIONS, &p, p.given, NULL}},
                           .set_n = 1};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands != 1)
        code = cli_fail(CLI_USAGE, "prony: expected one FILE, got %d files", args.operands);
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    if (code == CLI_CONTINUE)
        code = fit_file(&p, args.operand[0]);
    rb_io_table_free(&p.table);
    cli_args_free(&args);
    return code;
}
