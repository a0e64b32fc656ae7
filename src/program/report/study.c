/* Pictures of a parameter study: curves of one result over one of the options that vary,
 * and a map of it over two of them. */
#include "program/report/internal.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The cases in order ------------------------------------------------------------ */

typedef struct {
    double x, y, value, half_width;
    int k; /* number of the case, from 0 */
} spot;

/* Cases of one y, a curve or a row of the map, stand together, x ascending. */
static int compare_rows(const void *a, const void *b)
{
    const spot *p = a, *q = b;
    if (p->y != q->y)
        return p->y < q->y ? -1 : 1;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return p->k - q->k;
}

static spot *sort_cases(const rb_report_study *s)
{
    spot *at = calloc((size_t)s->n + 1, sizeof *at);
    for (int k = 0; at && k < s->n; k++)
        at[k] = (spot){s->x.value[k], s->y.value ? s->y.value[k] : 0.0,
                       s->shown.value ? s->shown.value[k] : NAN,
                       s->half_width ? s->half_width[k] : 0.0, k};
    if (at)
        qsort(at, (size_t)s->n, sizeof *at, compare_rows);
    return at;
}

/* How many cases from `first` on have the same y. */
static int length_of_group(const rb_report_study *s, const spot *at, int first)
{
    int n = 1;
    while (first + n < s->n && at[first + n].y == at[first].y)
        n++;
    return n;
}

/* ---- What can be drawn ------------------------------------------------------------- */

static rb_status check_curves(const rb_report_study *s, const spot *at, rb_message *why)
{
    int groups = 0;
    for (int i = 0; i < s->n; i += length_of_group(s, at, i))
        groups++;
    if (groups > RB_REPORT_CURVES)
        return rb_fail(why, RB_EINVAL, "%d values of %s: at most %d curves are drawn", groups,
                       s->y.name, RB_REPORT_CURVES);
    for (int i = 0; i < s->n && !s->points; i += length_of_group(s, at, i))
        if (length_of_group(s, at, i) < 2)
            return s->y.word
                       ? rb_fail(why, RB_EINVAL, "a curve needs two values of %s; %s = %s has one",
                                 s->x.name, s->y.name, s->y.word[at[i].k])
                   : s->y.value
                       ? rb_fail(why, RB_EINVAL, "a curve needs two values of %s; %s = %g has one",
                                 s->x.name, s->y.name, at[i].y)
                       : rb_fail(why, RB_EINVAL, "a curve needs two values of %s", s->x.name);
    return RB_OK;
}

/* Every row of the map has the x of the first row. */
static rb_status check_map(const rb_report_study *s, const spot *at, rb_message *why)
{
    const int n = s->n > 0 ? length_of_group(s, at, 0) : 0;
    if (s->x.word || s->y.word)
        return rb_fail(why, RB_EINVAL, "a map needs two options with numbers, %s has words",
                       s->x.word ? s->x.name : s->y.name);
    if (!s->y.value || n < 2 || n == s->n)
        return rb_fail(why, RB_EINVAL, "a map needs two options with two values or more");
    for (int i = n; i < s->n; i += n)
        for (int j = 0; j < n; j++)
            if (length_of_group(s, at, i) != n || at[i + j].x != at[j].x)
                return rb_fail(why, RB_EINVAL,
                               "a map needs a case for every pair of %s and %s; those "
                               "with %s = %g are others than those with %s = %g",
                               s->x.name, s->y.name, s->y.name, at[i].y, s->y.name, at[0].y);
    return RB_OK;
}

rb_status rb_report_study_check(const rb_report_study *s, int map, rb_message *why)
{
    spot *at = sort_cases(s);
    if (!at)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d cases", s->n);
    /* A place has one case, or the picture would need a third direction. */
    rb_status status = RB_OK;
    if (s->is_sample && map)
        status = rb_fail(why, RB_EINVAL, "the cases of a sample are on no grid; --plot draws them");
    for (int i = 1; i < s->n && status == RB_OK && !s->is_sample && (map || !s->points); i++)
        if (at[i].x == at[i - 1].x && at[i].y == at[i - 1].y)
            status = rb_fail(why, RB_EINVAL,
                             "cases %d and %d have the same %s%s%s: more options vary than "
                             "the picture shows",
                             at[i - 1].k + 1, at[i].k + 1, s->x.name, s->y.value ? " and " : "",
                             s->y.value ? s->y.name : "");
    if (status == RB_OK && !s->is_sample)
        status = map ? check_map(s, at, why) : check_curves(s, at, why);
    free(at);
    return status;
}

/* ---- Axes -------------------------------------------------------------------------- */

/* Values are shown in a power of ten where their numbers would be long. */
typedef struct {
    double from, to, unit;
    int exponent, logarithmic;
    int flat;    /* of a result: its values differ by rounding alone, or are one */
    int is_zero; /* they are rounding about 0 */
} axis;

typedef struct {
    const rb_report_study *study;
    const spot *at;
    int row; /* of a map: cases of one y */
    axis x, y, shown;
} view;

/* Values that stand equally in their logarithm, as first:last:count:log gives them, over
 * a decade or more. */
static int is_logarithmic(int n, const double *value)
{
    double *x = rb_alloc((size_t)n, 1);
    int k = 0;
    if (!x)
        return 0;
    memcpy(x, value, (size_t)n * sizeof *x);
    gsl_sort(x, 1, (size_t)n);
    for (int i = 0; i < n; i++)
        if (i == 0 || x[i] != x[k - 1])
            x[k++] = x[i];
    int logarithmic = k > 2 && x[0] > 0.0 && x[k - 1] >= 10.0 * x[0];
    for (int i = 2; i < k && logarithmic; i++)
        logarithmic = fabs(log(x[i] / x[i - 1]) / log(x[1] / x[0]) - 1.0) < 1e-6;
    free(x);
    return logarithmic;
}

static axis axis_of(int n, const rb_report_quantity *q, int may_be_logarithmic)
{
    axis a = {.from = INFINITY, .to = -INFINITY, .unit = 1.0};
    for (int k = 0; k < n && q->value; k++) {
        a.from = fmin(a.from, q->value[k]); /* fmin and fmax pass over NAN */
        a.to = fmax(a.to, q->value[k]);
    }
    const double largest = fmax(fabs(a.from), fabs(a.to));
    a.logarithmic = may_be_logarithmic && q->value && is_logarithmic(n, q->value);
    if (!a.logarithmic && isfinite(largest) && largest > 0.0 && (largest < 0.1 || largest >= 1e5))
        a.exponent = (int)floor(log10(largest));
    a.unit = pow(10.0, a.exponent);
    a.from /= a.unit;
    a.to /= a.unit;
    return a;
}

/* In words: gnuplot would lower what follows an underscore, as it shall of K alone. */
static const char *plain(const char *name, char buffer[64])
{
    buffer[0] = '\0';
    if (strncmp(name, "delta_K", 7) == 0) {
        rb_append(buffer, 64, "Δ");
        name += strlen("delta_");
    }
    while (*name)
        if (strncmp(name, "K_", 2) == 0) {
            const size_t n = strspn(name + 2, "I");
            rb_append(buffer, 64, "K_{%.*s}", n ? (int)n : (int)strlen("θ"), n ? name + 2 : "θ");
            name += 2 + (n ? n : strlen("theta"));
        } else {
            rb_append(buffer, 64, "%c", *name == '_' || *name == '-' ? ' ' : *name);
            name++;
        }
    return buffer;
}

/* "max pressure  [10^{9} Pa]" */
static void let_label(FILE *out, const char *label, const rb_report_quantity *q, const axis *a)
{
    char name[64], unit[40];
    rb_report_let_text(out, label, "%s%s", plain(q->name, name),
                       RB_REPORT_COUNTED_IN(a->exponent, rb_report_raised(q->unit, unit)));
}

/* Digits that tell the numbers of an axis apart where gnuplot's own five do not; else 0. */
static int digits_of(const axis *a)
{
    enum { OF_GNUPLOT = 5, OF_DOUBLE = 15 };
    if (a->flat || a->logarithmic || !(a->to > a->from))
        return 0;
    const double largest = fmax(fabs(a->from), fabs(a->to)), step = (a->to - a->from) / 10.0;
    const double digits = floor(log10(largest)) - floor(log10(step)) + 1.0;
    return digits > OF_GNUPLOT ? (int)fmin(digits, OF_DOUBLE) : 0;
}

/* The axis of this letter, with so many numbers: X_label, X_format ("": gnuplot's own), X_from,
 * X_to, X_unit, in which it counts, and X_step, 0 where it is logarithmic. */
static void let_axis(FILE *out, char letter, const rb_report_quantity *q, const axis *a, int labels)
{
    const double step = a->logarithmic ? 0.0 : rb_report_round_step((a->to - a->from) / labels);
    const rb_report_named numbers[] = {
        {"from", a->from}, {"to", a->to}, {"unit", a->unit}, {"step", isfinite(step) ? step : 0.0}};
    char name[20];

    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        rb_format(name, sizeof name, "%c_%s", letter, numbers[k].name);
        rb_report_let(out, name, numbers[k].x);
    }
    rb_format(name, sizeof name, "%c_label", letter);
    let_label(out, name, q, a);
    rb_format(name, sizeof name, "%c_format", letter);
    if (digits_of(a))
        rb_report_let_text(out, name, "%%.%dg", digits_of(a));
    else
        rb_report_let_text(out, name, "%s",
                           a->logarithmic ? rb_report_log_format(a->from, a->to) : "");
}

/* Words of users in gnuplot's quotes, without what it takes for commands. */
static const char *as_title(const char *word, char text[64])
{
    size_t n = 0;
    for (; *word && n < 60; word++)
        text[n++] = strchr("'\\{}_^@&~\n", *word) ? ' ' : *word;
    text[n] = '\0';
    return text;
}

/* Words below the picture: word1 at 0, word2 at 1 ... */
static void let_words(FILE *out, const view *v)
{
    const rb_report_study *s = v->study;
    char name[20], text[64];
    int words = 0;

    for (int k = 0; k < s->n && s->x.word; k++) /* cases with one y stand in the order of x */
        if (s->x.value[k] == words) {
            rb_format(name, sizeof name, "word%d", ++words);
            rb_report_let_text(out, name, "%s", as_title(s->x.word[k], text));
        }
    rb_report_let_whole(out, "words", words);
}

/* As many numbers below the picture as a column and a page of print take. */
static int labels_below(rb_report_place place)
{
    return place.titled ? 8 : 4;
}

static void let_title(FILE *out, const view *v)
{
    const rb_report_study *s = v->study;
    char shown[64], unit[40], text[300] = "";

    if (v->shown.is_zero)
        rb_append(text, sizeof text, ",  all 0 but for rounding");
    if (s->half_width) {
        double most = 0.0;
        for (int k = 0; k < s->n; k++)
            most = fmax(most, s->half_width[k]); /* fmax passes over NAN */
        rb_append(text, sizeof text, ",  band: ± %s, at most %s%s%s", s->band,
                  RB_REPORT_NUMBER(most, 2), s->shown.unit[0] ? " " : "",
                  rb_report_raised(s->shown.unit, unit));
    }
    rb_report_let_text(out, "title", "{/:Bold %s}   %d cases%s%s", plain(s->shown.name, shown),
                       s->n, s->is_sample ? " of a sample" : "", text);
    if (s->rc)
        rb_report_let_bodies(out, s->rc, s->units);
    else
        rb_report_let_text(out, "bodies", "%s", "");
}

/* The cases in the order in which they are drawn; a blank line behind each `row` cases, 0: none. */
static void let_table(FILE *out, const view *v, int row)
{
    const rb_report_study *s = v->study;
    char x[RB_NUMBER_TEXT], y[RB_NUMBER_TEXT];

    fprintf(out, "$table << EOD\nx y value%s\n", s->half_width ? " band" : "");
    for (int i = 0; i < s->n; i++) {
        /* all digits: at the border of a map none may lie outside */
        fprintf(out, "%s %s %.9g", rb_number_text(v->at[i].x, x), rb_number_text(v->at[i].y, y),
                v->at[i].value);
        if (s->half_width)
            fprintf(out, " %.9g", v->at[i].half_width);
        fputs(row > 0 && i % row == row - 1 ? "\n\n" : "\n", out);
    }
    fputs("EOD\n", out);
}

/* ---- Curves ------------------------------------------------------------------------ */

/* Curve k has the rows word(first, k) to word(last, k) of the table and the name nameK. */
static void let_curves(FILE *out, const view *v)
{
    const rb_report_study *s = v->study;
    char first[200] = "", last[200] = "", name[20], value[64];
    int n = 0;

    for (int i = 0; i < s->n; n++) {
        rb_format(name, sizeof name, "name%d", n + 1);
        snprintf(value, sizeof value, "%g", v->at[i].y);
        rb_report_let_text(out, name, "%s",
                           s->y.word ? as_title(s->y.word[v->at[i].k], value) : value);
        rb_append(first, sizeof first, " %d", i);
        i += length_of_group(s, v->at, i);
        rb_append(last, sizeof last, " %d", i - 1);
    }
    rb_report_let_text(out, "first", "%s", first);
    rb_report_let_text(out, "last", "%s", last);
}

static void write_curves(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_report_study *s = v->study;
    char name[64];

    let_table(out, v, 0);
    let_title(out, v);
    let_axis(out, 'x', &s->x, &v->x, labels_below(rb_report_place_of(canvas)));
    let_axis(out, 'v', &s->shown, &v->shown, 8);
    let_words(out, v);
    let_curves(out, v);
    rb_report_let_text(out, "y_name", "%s", s->y.value ? plain(s->y.name, name) : "");
    rb_report_let_text(out, "y_unit", "%s", s->y.value ? s->y.unit : "");
    rb_report_let_whole(out, "flat", v->shown.flat);
    rb_report_let_whole(out, "banded", s->half_width != NULL);
    rb_report_let_whole(out, "apart", s->is_sample || s->points || s->x.word);
}

/* ---- Map --------------------------------------------------------------------------- */

/* Colours between the values of the cases, where these are few. */
static int steps_between(int values)
{
    enum { FINE = 80 };
    return values > FINE ? 1 : (FINE + values - 1) / values;
}

static void point_of_map(const void *of, int k, double at[3])
{
    const view *v = of;
    at[0] = v->at[k].x / v->x.unit;
    at[1] = v->at[k].y / v->y.unit;
    at[2] = v->at[k].value / v->shown.unit;
}

static void let_numbers(FILE *out, rb_report_canvas canvas, const view *v, double width,
                        double height)
{
    /* Contours at the numbers of the scale, but for its ends. */
    const double least = v->shown.from, most = v->shown.to;
    const double step = rb_report_round_step((most - least) / rb_report_labels_in(height));
    const double first = step * (floor(least / step + 1e-6) + 1.0);
    const double last = most - 1e-6 * (most - least);
    double letters[2];

    rb_report_let(out, "level_step", step);
    rb_report_let(out, "level_first", first);
    rb_report_let(out, "level_last", last);
    rb_report_letters_in(canvas, RB_REPORT_FOUR_THIRDS, rb_report_key_font(canvas), letters);
    rb_report_contour_numbers(
        out, "numbers",
        &(rb_report_contours){.nx = v->row,
                              .ny = v->study->n / v->row,
                              .point = point_of_map,
                              .of = v,
                              .from = {v->x.from, v->y.from},
                              .to = {v->x.to, v->y.to},
                              .logarithmic = {v->x.logarithmic, v->y.logarithmic},
                              .first = first,
                              .step = step,
                              .last = last,
                              .letter = {1.0 / (letters[0] * width), 1.0 / (letters[1] * height)}});
}

static void write_map(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_report_study *s = v->study;
    const rb_report_place place = rb_report_place_of(canvas);
    /* Long numbers beside the map and its scale take room from it. */
    const double of_digit = 0.012;
    const double beside = of_digit * fmax(digits_of(&v->y) - 3.0, 0.0);
    const double scale = of_digit * fmax(digits_of(&v->shown) - 5.0, 0.0);
    const double height = 0.76, width = 0.67 - 2.0 * place.right - beside - scale;

    let_table(out, v, v->row);
    let_title(out, v);
    let_axis(out, 'x', &s->x, &v->x, labels_below(place));
    let_axis(out, 'y', &s->y, &v->y, 8);
    let_axis(out, 'v', &s->shown, &v->shown, 8);
    rb_report_let(out, "left", 0.13 + place.right + beside);
    rb_report_let(out, "bottom", 0.14 + place.up);
    rb_report_let(out, "width", width);
    rb_report_let(out, "height", height);
    rb_report_let_whole(out, "between_x", steps_between(v->row));
    rb_report_let_whole(out, "between_y", steps_between(s->n / v->row));
    rb_report_let_whole(out, "flat", v->shown.flat);
    if (!v->shown.flat)
        let_numbers(out, canvas, v, width, height);
}

/* ---- Draw -------------------------------------------------------------------------- */

rb_status rb_report_study_picture(FILE *out, rb_report_canvas canvas, const rb_report_study *s,
                                  int map, rb_message *why)
{
    rb_status status = rb_report_study_check(s, map, why);
    spot *at = status == RB_OK ? sort_cases(s) : NULL;
    if (status != RB_OK)
        return status;
    if (!at)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d cases", s->n);
    rb_report_study shown = *s;
    if (map) /* draws no band */
        shown.half_width = NULL;
    view v = {.study = &shown,
              .at = at,
              .row = length_of_group(s, at, 0),
              .x = axis_of(s->n, &s->x, !s->x.word),
              .y = axis_of(s->n, &s->y, 1),
              .shown = axis_of(s->n, &s->shown, 0)};
    /* Where the result is the same in all cases, a range around it, or the picture would
     * show the rounding. */
    const double size = fmax(fabs(v.shown.from), fabs(v.shown.to));
    if (size * v.shown.unit <= s->rounding) {
        for (int k = 0; k < s->n; k++)
            at[k].value *= 0.0; /* what was not solved stays so */
        v.shown = (axis){.from = -1.0, .to = 1.0, .unit = 1.0, .flat = 1, .is_zero = 1};
    } else if (v.shown.to - v.shown.from <= 1e-9 * size) {
        v.shown.flat = 1;
        const double margin = size > 0.0 ? 0.1 * size : 1.0;
        v.shown.from -= margin;
        v.shown.to += margin;
    }
    status = v.shown.from <= v.shown.to
                 ? rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, map ? "map" : "study",
                                  map ? write_map : write_curves, &v, why)
                 : rb_fail(why, RB_EINVAL, "no case has a %s", s->shown.name);
    free(at);
    return status;
}
