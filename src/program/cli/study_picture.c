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

static int same_row(const study_column *c, int i, int k)
{
    const char *a = c->word ? c->word[i] : NULL, *b = c->word ? c->word[k] : NULL;
    return a && b ? strcmp(a, b) == 0 : !a && !b && c->value[i] == c->value[k];
}

static int varies(const study *st, const study_column *c)
{
    for (int k = 1; k < st->rows[c->factor]; k++)
        if (!same_row(c, k, 0))
            return 1;
    return 0;
}

static int has_words(const study *st, const study_column *c)
{
    int some = 0;
    for (int k = 0; c->word && k < st->rows[c->factor]; k++)
        some |= c->word[k] != NULL;
    return some;
}

/* The column that --over or --family names; NULL: the last one that varies, other than `but`: of
 * numbers before words, and these before labels; or -1. */
static cli_exit choose_axis(const study *st, const char *option, const char *name, int but,
                            int *found)
{
    rb_guess guess = {.word = name};
    *found = -1;
    for (int rank = 0; rank < 3 && *found < 0; rank++)
        for (int k = st->columns - 1; k >= 0 && *found < 0; k--) {
            const study_column *c = &st->column[k];
            const int own = !c->option ? 2 : has_words(st, c) ? 1 : 0;
            if (name)
                rb_guess_try(&guess, c->name);
            if (k != but && (name ? strcmp(c->name, name) == 0 || strcmp(c->heading, name) == 0
                                  : own == rank && varies(st, c)))
                *found = k;
        }
    return *found >= 0 || !name
               ? CLI_CONTINUE
               : cli_case_refuse(st->base, option, "expected %s option that varies, got '%s'%s",
                                 but < 0 ? "an" : "another", name, rb_guess_text(&guess, ""));
}

/* The word of a row of a column; numbers between words as they are read. */
static const char *text_of(const study_column *c, int i, rb_arena *memory)
{
    if (c->word && c->word[i])
        return c->word[i];
    char *text = rb_arena_zeros(memory, RB_NUMBER_TEXT, 1);
    return text ? rb_number_text(c->value[i], text) : "";
}

/* The values of all cases along an axis.  Words, and labels, stand in the order in which they
 * come. */
static rb_report_quantity axis_of(const study *st, int k, rb_arena *memory)
{
    if (k < 0)
        return (rb_report_quantity){0};
    const study_column *c = &st->column[k];
    const char *unit =
        c->option ? rb_unit_name(rb_case_resolved(st->base)->units, c->option->unit) : "";
    const int words = has_words(st, c) || !c->option, rows = st->rows[c->factor];
    double *value = rb_arena_doubles(memory, (size_t)st->cases, 1),
           *place = rb_arena_doubles(memory, (size_t)rows, 1);
    const char **text = rb_arena_zeros(memory, (size_t)rows, sizeof *text),
               **word = rb_arena_zeros(memory, (size_t)st->cases, sizeof *word);
    if (memory->failed)
        return (rb_report_quantity){0};
    for (int i = 0, different = 0; i < rows && words; i++) {
        int same = 0;
        while (!same_row(c, i, same))
            same++;
        place[i] = same < i ? place[same] : different++;
        text[i] = same < i ? text[same] : text_of(c, i, memory);
    }
    for (int i = 0; i < st->cases; i++) {
        const int row = cli_study_row(st, c, i);
        value[i] = words ? place[row] : c->value[row];
        word[i] = text[row];
    }
    return (rb_report_quantity){c->name, strcmp(unit, "-") == 0 || words ? "" : unit, value,
                                words ? word : NULL};
}

/* "error_max_pressure" of an error bar. */
static const char *name_of(const study_result *result, char buffer[STUDY_HEADING])
{
    snprintf(buffer, STUDY_HEADING, "%s%s", result->is_error ? "error_" : "", result->r->name);
    return buffer;
}

/* The study as a picture, which keeps its coordinates in `memory` and its name in `name`. */
static rb_report_study picture_of(const study *st, rb_arena *memory, char name[STUDY_HEADING])
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
        .x = axis_of(st, st->over, memory),
        .y = axis_of(st, st->family, memory),
        .shown = {name_of(shown, name),
                  shown->r->unit ? rb_unit_name(c->units, shown->r->unit) : "", st->drawn, NULL},
        .rc = bodies_vary ? NULL : &c->rc,
        .units = c->units,
        .half_width = st->band,
        .band = st->band_column < st->columns + 2 + st->results ? "estimated error"
                                                                : "standard deviation",
        .is_sample = st->o->sample > 0,
        .points = st->points,
        .rounding = shown->r->error_bar == RB_SCALE_NONE || shown->is_error ? 0.0
                    : shown->r->unit && shown->r->unit[0]                   ? 1e-14 * st->largest
                                                                            : 1e-14};
}

static rb_status check_picture(const study *st, int map, rb_message *why)
{
    char name[STUDY_HEADING];
    rb_arena memory = {0};
    const rb_report_study picture = picture_of(st, &memory, name);
    if (memory.failed)
        return rb_arena_done(&memory, rb_fail(why, RB_ENOMEM, "out of memory"));
    return rb_arena_done(&memory, rb_report_study_check(&picture, map, why));
}

/* Cases of a table need not stand on a grid: they are then drawn as points, all in one colour
 * unless --family names a column. */
static cli_exit check_curves(study *st)
{
    rb_message why = {.text = ""};
    rb_status s = check_picture(st, 0, &why);
    if (s == RB_EINVAL && st->o->cases && !st->o->map) {
        st->points = 1;
        st->family = st->o->family ? st->family : -1;
        s = check_picture(st, 0, &why);
    }
    return s == RB_OK ? CLI_CONTINUE : cli_say_of("plot", s, &why);
}

cli_exit cli_study_prepare_pictures(study *st)
{
    const study_options *o = st->o;
    char name[STUDY_HEADING];
    if (!cli_study_has_pictures(st))
        return o->show || o->over || o->family
                   ? cli_case_refuse(st->base, "show,over,family",
                                     "there is no picture; --plot FILE or --map FILE asks for one")
                   : CLI_CONTINUE;
    for (int j = 0; j < st->results; j++)
        if (strcmp(name_of(&st->result[j], name), cli_study_shown(st)) == 0)
            st->drawn_column = st->columns + 2 + j;
    cli_exit code = choose_axis(st, "over", o->over, -1, &st->over);
    if (code == CLI_CONTINUE && st->over < 0)
        code = cli_case_refuse(st->base, "plot,map", "no option varies");
    st->family = -1;
    if (code == CLI_CONTINUE && o->sample > 0 && o->family)
        code = cli_case_refuse(st->base, "family", "the cases of --sample are points, not curves");
    if (code == CLI_CONTINUE && o->sample == 0)
        code = choose_axis(st, "family", o->family, st->over, &st->family);
    if (code == CLI_CONTINUE && o->map) {
        rb_message why = {.text = ""};
        const rb_status s = check_picture(st, 1, &why);
        code = s == RB_OK ? code : cli_say_of("map", s, &why);
    }
    if (code == CLI_CONTINUE && o->plot)
        code = check_curves(st);
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

static rb_status draw_study(FILE *out, rb_report_canvas canvas, const study *st, int map,
                            rb_message *why)
{
    char name[STUDY_HEADING];
    rb_arena memory = {0};
    const rb_report_study picture = picture_of(st, &memory, name);
    if (memory.failed)
        return rb_arena_done(&memory, rb_fail(why, RB_ENOMEM, "out of memory"));
    return rb_arena_done(&memory, rb_report_study_picture(out, canvas, &picture, map, why));
}

static rb_status draw_curves(FILE *out, rb_report_canvas canvas, const void *st, rb_message *why)
{
    return draw_study(out, canvas, st, 0, why);
}

static rb_status draw_map(FILE *out, rb_report_canvas canvas, const void *st, rb_message *why)
{
    return draw_study(out, canvas, st, 1, why);
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
