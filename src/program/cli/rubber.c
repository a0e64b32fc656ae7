/* rollbem rubber: the modulus of a hardness by every published relation, and how far they differ.
 */
#include "rolling/case/rubber.h"
#include "program/cli/cli.h"
#include "program/cli/output.h"
#include "program/cli/rows.h"
#include "rolling/case/options.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>

/* Points by which what is sold in Shore A may differ; a gauge repeats to 2. */
static const double SOLD = 5.0;

typedef struct {
    int units;
    const char *shore; /* as it was typed; NULL: not given */
    double depth;      /* P&J; NAN: not given */
    cli_output output;
    int given[12];
    const rb_rubber_scale *scale;
    double hardness, least, largest; /* MPa, by the relations */
} rubber;

#define PLACE(member) offsetof(rubber, member)

static const rb_option options[] = {
    RB_GROUP_LINE("hardness", "Hardness"),
    RB_TEXT_LINE("shore", PLACE(shore), "X", "Shore A, in [20, 90]: 60A, 60ShoreA or 60",
                 .unset = "not given"),
    RB_NUMBER_LINE("pj", PLACE(depth), "", RB_FROM_TO(10, 200),
                   "P&J (Pusey and Jones): depth of a ball of 3.175 mm under 9.81 N, in 0.01 mm",
                   .unset = "not given"),
    RB_CHOICE_LINE("units", PLACE(units), rb_case_systems, "of the moduli", .common = 1),
    RB_GROUP_LINE("output", "Output"),
    CLI_STYLE_LINES(PLACE(output.style)),
    CLI_OUTPUT_LINE(PLACE(output.output)),
    RB_FLAG_LINE("quiet", PLACE(output.quiet), "no summary on standard error"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS <= 12, "given");

static const char about[] =
    "Young's modulus of rubber by its hardness: Shore A by Gent (1958), BS 903 and Qi, Joyce and\n"
    "Boyce (2003), P&J by the law of ISO 48 and by Hertz's. The first one is what --young "
    "60ShoreA\n"
    "means; all of them together are its error bar.";

static const char notes[] =
    "All are moduli at rest of a material with --poisson near 0.5; rolling needs the one at the\n"
    "frequency V/a, which `rollbem prony` takes from E' and tan delta.\n"
    "Example: rollbem rubber --shore 60A\n"
    "Exit codes: 0; 64, 70, 73 as of the other commands.\n";

static double modulus(const rubber *r, double x)
{
    return rb_unit_shown((rb_units)r->units, "MPa", x);
}

static const char *unit(const rubber *r)
{
    return rb_unit_name((rb_units)r->units, "MPa");
}

static double by(const rubber *r, int relation, double more)
{
    return modulus(r, r->scale->relation[relation].young(r->hardness + more));
}

/* ---- Words ----------------------------------------------------------------------------- */

enum { LINES = 3 };

static void write_lines(const rubber *r, rb_message line[LINES])
{
    rb_format(line[0].text, sizeof line->text,
              "%g %s: E = %.4g %s by %s, %.4g to %.4g by all, a factor of %.2g", r->hardness,
              r->scale->name, by(r, 0, 0.0), unit(r), r->scale->relation[0].name,
              modulus(r, r->least), modulus(r, r->largest), r->largest / r->least);
    if (r->shore)
        rb_format(line[1].text, sizeof line->text,
                  "makers allow %g points, %.4g to %.4g %s by %s; a gauge repeats to 2", SOLD,
                  by(r, 0, -SOLD), by(r, 0, SOLD), unit(r), r->scale->relation[0].name);
    else
        rb_format(line[1].text, sizeof line->text,
                  "a cover thinner than %.3g mm, ten times the depth, reads hard",
                  0.1 * r->hardness);
    rb_format(line[2].text, sizeof line->text,
              "at rest, with nu near 0.5: rolling needs the modulus of its frequency, V/a");
}

static void summarise_rubber(FILE *out, const void *context)
{
    rb_message line[LINES];
    write_lines(context, line);
    for (int k = 0; k < LINES; k++)
        fprintf(out, "%s\n", line[k].text);
}

/* ---- Results --------------------------------------------------------------------------- */

static json_t *json_of(const rubber *r, const rb_message line[LINES], json_t *relations)
{
    json_t *root = rb_report_json_start(cli_command_line()), *list = json_array();
    rb_report_json_set(&root, "units", rb_report_json_units((rb_units)r->units));
    rb_report_json_set(&root, "scale", json_string(r->scale->name));
    rb_report_json_set(&root, "hardness", rb_report_json_number(r->hardness));
    rb_report_json_set(&root, "young", rb_report_json_number(by(r, 0, 0.0)));
    rb_report_json_set(&root, "young_least", rb_report_json_number(modulus(r, r->least)));
    rb_report_json_set(&root, "young_largest", rb_report_json_number(modulus(r, r->largest)));
    for (int k = 0; k < LINES; k++)
        rb_report_json_append(&list, json_string(line[k].text));
    rb_report_json_set(&root, "notes", list);
    rb_report_json_set(&root, "relations", relations);
    return root;
}

static rb_status write_results(FILE *out, const void *context, rb_message *why)
{
    const rubber *r = context;
    rb_message line[LINES];
    char heading[40], columns[80];
    (void)why;
    rb_format(heading, sizeof heading, "young_%s", unit(r));
    rb_format(columns, sizeof columns, "relation %s", heading);
    write_lines(r, line);
    cli_rows rows = cli_rows_begin(out, &r->output.style, columns);
    for (int k = 0; k < LINES && !rows.is_json; k++)
        rb_report_comment(&rows.cells, "%s", line[k].text);
    for (int k = 0; k < r->scale->relations; k++)
        cli_rows_add(&rows, 2,
                     (cli_value[]){CLI_TEXT("relation", "relation", r->scale->relation[k].name),
                                   CLI_NUMBER("young", heading, by(r, k, 0.0))});
    return rows.is_json ? rb_report_json_write(out, json_of(r, line, rows.list))
                        : rb_report_flush(out);
}

/* ---- Command --------------------------------------------------------------------------- */

static cli_exit read_hardness(rubber *r)
{
    rb_message why = {.text = ""};
    if ((r->shore == NULL) == (isnan(r->depth) != 0))
        return cli_fail(CLI_USAGE, "rubber: expected one of --shore 60A and --pj 100");
    r->scale = &rb_rubber_scales[r->shore ? RB_RUBBER_SHORE_A : RB_RUBBER_PJ];
    r->hardness = r->depth;
    if (r->shore && !rb_rubber_read(r->shore, 1, &r->hardness, &why))
        rb_fail(&why, RB_EINVAL, "a hardness such as 60A; got '%.60s'", r->shore);
    if (*why.text)
        return cli_fail(CLI_USAGE, "--shore: expected %s", why.text);
    rb_rubber_band(r->scale, r->hardness, &r->least, &r->largest);
    return CLI_CONTINUE;
}

static cli_exit show_rubber(const rubber *r)
{
    const cli_exit code = cli_write_file(r->output.output, write_results, r);
    if (code == CLI_OK && !r->output.quiet)
        cli_print_lines(summarise_rubber, r);
    return code;
}

int cli_rubber(int argc, char **argv)
{
    rubber r = {.depth = NAN};
    cli_args args = {0};
    const cli_spec spec = {.synopsis = "rollbem rubber --shore 60A | --pj 100 [OPTION...]",
                           .about = about,
                           .notes = notes,
                           .sets = {{options, OPTIONS, &r, r.given, NULL}},
                           .set_n = 1};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands > 0)
        code = cli_fail(CLI_USAGE, "rubber: unexpected '%s'", args.operand[0]);
    if (code == CLI_CONTINUE)
        code = read_hardness(&r);
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    if (code == CLI_CONTINUE)
        code = show_rubber(&r);
    cli_args_free(&args);
    return code;
}
