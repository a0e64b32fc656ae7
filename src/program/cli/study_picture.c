/* Pictures of a study: a result over one option that varies, or over two. */
#include "program/cli/case.h"
#include "program/cli/study.h"

#include <stdlib.h>
#include <string.h>

int cli_study_has_pictures(const study *st)
{
    return st->o->plot || st->o->map;
}

const char *cli_study_shown(const study *st)
{
    return st->o->show ? st->o->show : st->has_crack ? "delta_K_II" : "force_ratio";
}

void cli_study_keep(study *st, int j, int k, double x)
{
    const study_result *drawn = st->drawn ? &st->result[st->drawn_column - st->columns - 2] : NULL,
                       *result = j >= st->columns + 2 && j < st->columns + 2 + st->results
                                     ? &st->result[j - st->columns - 2]
                                     : NULL;
    if (drawn && result && drawn->r->unit && result->r->unit &&
        strcmp(drawn->r->unit, result->r->unit) == 0)
        st->largest = fmax(st->largest, fabs(x)); /* which passes over NAN */
    if (st->drawn && j == st->drawn_column)
        st->drawn[k] = x;
    if (st->band && j == st->band_column)
        st->band[k] = x;
}

static int varies(const study *st, const study_column *c)
{
    const double *value = c->value;
    for (int k = 1; k < st->rows[c->factor]; k++)
        if (value[k] != value[0])
            return 1;
    return 0;
}

/* The column of the option that --over or --family names; NULL: the last one that varies,
 * other than `but`, or -1. */
static cli_exit choose_axis(const study *st, const char *option, const char *name, int but,
                            int *found)
{
    rb_guess guess = {.word = name};
    for (*found = st->columns - 1; *found >= 0; --*found) {
        const study_column *c = &st->column[*found];
        if (name)
            rb_guess_try(&guess, c->name);
        if (*found != but && (name ? strcmp(c->name, name) == 0 : varies(st, c)))
            break;
    }
    return *found >= 0 || !name
               ? CLI_CONTINUE
               : cli_fail(CLI_USAGE, "--%s: expected %s option that varies, got '%s'%s", option,
                          but < 0 ? "an" : "another", name, rb_guess_text(&guess, ""));
}

static rb_report_quantity axis_of(const study *st, int k, double *value)
{
    if (k < 0)
        return (rb_report_quantity){0};
    const study_column *c = &st->column[k];
    const char *unit =
        rb_unit_name(rb_case_resolved(st->base)->units, cli_study_option(c->name)->unit);
    for (int i = 0; i < st->cases; i++)
        value[i] = cli_study_value(st, c, i);
    return (rb_report_quantity){c->name, strcmp(unit, "-") == 0 ? "" : unit, value};
}

/* "error_max_pressure" of an error bar. */
static const char *name_of(const study_result *result, char buffer[STUDY_HEADING])
{
    snprintf(buffer, STUDY_HEADING, "%s%s", result->is_error ? "error_" : "", result->r->name);
    return buffer;
}

/* The study as a picture, which keeps its coordinates in `value` (2 per case) and its name in
 * `name`. */
static rb_report_study picture_of(const study *st, double *value, char name[STUDY_HEADING])
{
    const rb_resolved_case *c = rb_case_resolved(st->base);
    const study_result *shown = &st->result[st->drawn_column - st->columns - 2];
    int bodies_vary = 0;
    for (int k = 0; k < st->columns; k++) {
        const rb_option *o = rb_case_option(st->column[k].name);
        bodies_vary |= o && strncmp(rb_case_section(o), "body-", 5) == 0;
    }
    return (rb_report_study){
        .n = st->cases,
        .x = axis_of(st, st->over, value),
        .y = axis_of(st, st->family, value + st->cases),
        .shown = {name_of(shown, name),
                  shown->r->unit ? rb_unit_name(c->units, shown->r->unit) : "", st->drawn},
        .rc = bodies_vary ? NULL : &c->rc,
        .units = c->units,
        .half_width = st->band,
        .band = st->band_column < st->columns + 2 + st->results ? "estimated error"
                                                                : "standard deviation",
        .is_sample = st->o->sample > 0,
        .rounding = shown->r->error_bar == RB_SCALE_NONE || shown->is_error ? 0.0
                    : shown->r->unit && shown->r->unit[0]                   ? 1e-14 * st->largest
                                                                            : 1e-14};
}

static cli_exit check_kind(const study *st, const char *option, int map)
{
    char name[STUDY_HEADING];
    rb_message why = {""};
    double *value = rb_alloc((size_t)st->cases, 2);
    rb_status s = rb_fail(&why, RB_ENOMEM, "out of memory");
    if (value) {
        const rb_report_study picture = picture_of(st, value, name);
        s = rb_report_study_check(&picture, map, &why);
    }
    free(value);
    return s == RB_OK ? CLI_CONTINUE : cli_say_of(option, s, &why);
}

cli_exit cli_study_prepare_pictures(study *st)
{
    const study_options *o = st->o;
    char name[STUDY_HEADING];
    if (!cli_study_has_pictures(st))
        return o->show || o->over || o->family
                   ? cli_fail(CLI_USAGE,
                              "--%s: there is no picture; --plot FILE or --map FILE asks for one",
                              o->show   ? "show"
                              : o->over ? "over"
                                        : "family")
                   : CLI_CONTINUE;
    for (int j = 0; j < st->results; j++)
        if (strcmp(name_of(&st->result[j], name), cli_study_shown(st)) == 0)
            st->drawn_column = st->columns + 2 + j;
    cli_exit code = choose_axis(st, "over", o->over, -1, &st->over);
    if (code == CLI_CONTINUE && st->over < 0)
        code = cli_fail(CLI_USAGE, "--%s: no option varies", o->plot ? "plot" : "map");
    st->family = -1;
    if (code == CLI_CONTINUE && o->sample > 0 && o->family)
        code = cli_fail(CLI_USAGE, "--family: the cases of --sample are points, not curves");
    if (code == CLI_CONTINUE && o->sample == 0)
        code = choose_axis(st, "family", o->family, st->over, &st->family);
    if (code == CLI_CONTINUE && o->plot)
        code = check_kind(st, "plot", 0);
    if (code == CLI_CONTINUE && o->map)
        code = check_kind(st, "map", 1);
    if (code != CLI_CONTINUE)
        return code;
    /* The band is the error bar of the result that is shown, or its standard deviation. */
    const int first = st->columns + 2;
    const study_result *shown = &st->result[st->drawn_column - first];
    if (!shown->is_error && o->sample == 0) {
        for (int j = 0; j < st->slopes.deviations; j++)
            if (st->slopes.deviation[j] == shown->r)
                st->band_column = first + st->results + st->slopes.n + j;
        for (int j = 0; j < st->results; j++)
            if (st->result[j].r == shown->r && st->result[j].is_error)
                st->band_column = first + j;
    }
    st->drawn = rb_alloc((size_t)st->cases, 1);
    st->band = st->band_column ? rb_alloc((size_t)st->cases, 1) : NULL;
    return !st->drawn || (st->band_column && !st->band) ? cli_fail(CLI_INTERNAL, "out of memory")
                                                        : CLI_CONTINUE;
}

static rb_status draw(FILE *out, rb_report_canvas canvas, const study *st, int map, rb_message *why)
{
    char name[STUDY_HEADING];
    double *value = rb_alloc((size_t)st->cases, 2);
    if (!value)
        return rb_fail(why, RB_ENOMEM, "out of memory");
    const rb_report_study picture = picture_of(st, value, name);
    const rb_status s = rb_report_study_picture(out, canvas, &picture, map, why);
    free(value);
    return s;
}

static rb_status draw_curves(FILE *out, rb_report_canvas canvas, const void *st, rb_message *why)
{
    return draw(out, canvas, st, 0, why);
}

static rb_status draw_map(FILE *out, rb_report_canvas canvas, const void *st, rb_message *why)
{
    return draw(out, canvas, st, 1, why);
}

/* Cases that were not solved leave holes. */
cli_exit cli_study_draw(const study *st, cli_exit code)
{
    const study_options *o = st->o;
    cli_exit drawn = code == CLI_CANTWRITE
                         ? code
                         : cli_draw_file(&o->pictures, "plot", o->plot, draw_curves, st);
    if (drawn == CLI_OK)
        drawn = cli_draw_file(&o->pictures, "map", o->map, draw_map, st);
    return drawn > code ? drawn : code;
}
