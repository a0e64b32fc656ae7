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
static int compare(const void *a, const void *b)
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
        qsort(at, (size_t)s->n, sizeof *at, compare);
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
static void write_label(FILE *out, const char *label, const rb_report_quantity *q, const axis *a)
{
    char name[64], unit[40];
    fprintf(out, "set %s '%s%s'\n", label, plain(q->name, name),
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

static void write_format(FILE *out, const char *letters, const axis *a)
{
    if (digits_of(a))
        fprintf(out, "set format %s '%%.%dg'\n", letters, digits_of(a));
}

static void write_axis(FILE *out, char letter, const rb_report_quantity *q, const axis *a,
                       int labels)
{
    char label[] = "xlabel";
    label[0] = letter;
    write_label(out, label, q, a);
    write_format(out, (char[]){letter, '\0'}, a);
    fprintf(out, "set %crange [%.9g:%.9g]\n", letter, a->from, a->to);
    if (a->logarithmic) {
        fprintf(out, "set logscale %c\n", letter);
        rb_report_log_tics(out, letter, a->from, a->to);
    } else
        fprintf(out, "set %ctics %.9g\n", letter, rb_report_round_step((a->to - a->from) / labels));
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

/* Words below the picture, each at its place. */
static void write_words(FILE *out, const view *v)
{
    const rb_report_study *s = v->study;
    char name[64], text[64];
    fprintf(out, "set xlabel '%s'\nset xrange [%.9g:%.9g]\nset xtics (", plain(s->x.name, name),
            v->x.from - 0.5, v->x.to + 0.5);
    double last = -1.0; /* cases with one y stand in the order of x */
    for (double place = v->x.from; place <= v->x.to; place += 1.0)
        for (int k = 0; k < s->n && last < place; k++)
            if (s->x.value[k] == place) {
                fprintf(out, "%s'%s' %g", place > v->x.from ? ", " : "",
                        as_title(s->x.word[k], text), place);
                last = place;
            }
    fputs(")\n", out);
}

/* As many numbers below the picture as a column and a page of print take. */
static int labels_below(rb_report_place place)
{
    return place.titled ? 8 : 4;
}

static void write_title(FILE *out, const view *v, rb_report_place place)
{
    const rb_report_study *s = v->study;
    char shown[64];
    if (!place.titled)
        return;
    fprintf(out, "set label 1 '{/:Bold %s}   %d cases%s", plain(s->shown.name, shown), s->n,
            s->is_sample ? " of a sample" : "");
    if (v->shown.is_zero)
        fputs(",  all 0 but for rounding", out);
    if (s->half_width) {
        char unit[40];
        double most = 0.0;
        for (int k = 0; k < s->n; k++)
            most = fmax(most, s->half_width[k]); /* fmax passes over NAN */
        fprintf(out, ",  band: ± %s, at most %s%s%s", s->band, RB_REPORT_NUMBER(most, 2),
                s->shown.unit[0] ? " " : "", rb_report_raised(s->shown.unit, unit));
    }
    fputs("' at screen 0.5, 0.972 center\n", out);
    if (s->rc)
        rb_report_label_bodies(out, s->rc, s->units, 0.5, 0.935);
}

/* ---- Curves ------------------------------------------------------------------------ */

enum { POINTS_UP_TO = 24 }; /* values of a curve that are marked one by one */

static void write_curves(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_report_study *s = v->study;
    const rb_report_place place = rb_report_place_of(canvas);
    char name[64], value[64];
    int curves = 0;
    for (int i = 0; i < s->n; curves++) {
        fprintf(out, "$curve%d << EOD\n", curves);
        for (const int end = i + length_of_group(s, v->at, i); i < end; i++)
            fprintf(out, s->half_width ? "%.9g %.9g %.9g\n" : "%.9g %.9g\n", v->at[i].x / v->x.unit,
                    v->at[i].value / v->shown.unit, v->at[i].half_width / v->shown.unit);
        fputs("EOD\n", out);
    }
    fprintf(out,
            "set bmargin at screen %g\nset tmargin at screen %g\n" RB_REPORT_GRID
            "set offsets 0,0,graph 0.05,graph %g\n" RB_REPORT_ZERO,
            0.14 + place.up, 0.9 + place.up, v->shown.from < 0.0 ? 0.05 : 0.0);
    write_title(out, v, place);
    if (s->x.word)
        write_words(out, v);
    else
        write_axis(out, 'x', &s->x, &v->x, labels_below(place));
    write_label(out, "ylabel", &s->shown, &v->shown);
    write_format(out, "y", &v->shown);
    if (v->shown.flat)
        fprintf(out, "set yrange [%.9g:%.9g]\n", v->shown.from, v->shown.to);
    if (s->y.value)
        fprintf(out, "set key outside right center samplen 2 font ',%.3g' title \"%s%s%s%s\"\n",
                rb_report_key_font(canvas), plain(s->y.name, name), s->y.unit[0] ? "\\n[" : "",
                s->y.unit, s->y.unit[0] ? "]" : "");
    else
        fputs("unset key\n", out);
    fputs("plot ", out);
    for (int k = 0; k < curves && s->half_width; k++)
        fprintf(out, "$curve%d using 1:($2-$3):($2+$3) " RB_REPORT_BAND " notitle, ", k,
                rb_report_colour(k));
    for (int k = 0, i = 0; k < curves; i += length_of_group(s, v->at, i), k++) {
        snprintf(value, sizeof value, "%g", v->at[i].y);
        fprintf(out,
                "%s$curve%d using 1:2 with %s linecolor rgb '%s' dashtype %s "
                "pointtype 7 pointsize 0.7 linewidth 2.2 title '%s'",
                k ? ", " : "", k,
                s->is_sample || s->points || s->x.word        ? "points"
                : length_of_group(s, v->at, i) > POINTS_UP_TO ? "lines"
                                                              : "linespoints",
                rb_report_colour(k), rb_report_dashes(k),
                s->y.word ? as_title(s->y.word[v->at[i].k], value) : value);
    }
    fputc('\n', out);
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

/* room: width and height of the map, in parts of the canvas. */
static void write_numbers(FILE *out, rb_report_canvas canvas, const view *v, const double room[2],
                          double first, double step, double last)
{
    double letters[2];
    rb_report_letters_in(canvas, RB_REPORT_FOUR_THIRDS, rb_report_key_font(canvas), letters);
    rb_report_contour_numbers(
        out, "numbers",
        &(rb_report_contours){
            .nx = v->row,
            .ny = v->study->n / v->row,
            .point = point_of_map,
            .of = v,
            .from = {v->x.from, v->y.from},
            .to = {v->x.to, v->y.to},
            .logarithmic = {v->x.logarithmic, v->y.logarithmic},
            .first = first,
            .step = step,
            .last = last,
            .letter = {1.0 / (letters[0] * room[0]), 1.0 / (letters[1] * room[1])}});
}

static void write_map(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_report_study *s = v->study;
    const rb_report_place place = rb_report_place_of(canvas);
    /* Long numbers beside the map and its scale take room from it. */
    const double of_digit = 0.012;
    const double beside = of_digit * fmax(digits_of(&v->y) - 3.0, 0.0);
    const double right = of_digit * fmax(digits_of(&v->shown) - 5.0, 0.0);
    const double bottom = 0.14 + place.up, height = 0.76, left = 0.13 + place.right + beside;
    const double width = 0.67 - 2.0 * place.right - beside - right;
    fputs("$map << EOD\n", out);
    for (int i = 0; i < s->n; i++)
        fprintf(out, "%.9g %.9g %.9g\n%s", v->at[i].x / v->x.unit, v->at[i].y / v->y.unit,
                v->at[i].value / v->shown.unit, i % v->row == v->row - 1 ? "\n" : "");
    fprintf(out,
            "EOD\nset view map\nset pm3d map corners2color mean interpolate %d,%d\nunset key\n",
            steps_between(v->row), steps_between(s->n / v->row));
    rb_report_room(out, left, left + width, bottom, bottom + height);
    fputs(RB_REPORT_PALETTE, out);
    write_title(out, v, place);
    write_axis(out, 'x', &s->x, &v->x, labels_below(place));
    write_axis(out, 'y', &s->y, &v->y, 8);
    fprintf(out, "set colorbox user origin %g, %g size 0.022, %g\n", left + width + 0.02, bottom,
            height);
    char label[96];
    snprintf(label, sizeof label, "label 2 at screen 0.968, %g center rotate",
             bottom + height / 2.0);
    write_label(out, label, &s->shown, &v->shown);
    write_format(out, "cb", &v->shown);
    if (v->shown.flat)
        fprintf(out, "set cbrange [%.9g:%.9g]\n", v->shown.from, v->shown.to);
    else {
        /* Contours at the numbers of the scale, but for its ends. */
        const double least = v->shown.from, most = v->shown.to;
        const double step = rb_report_round_step((most - least) / rb_report_labels_in(height));
        const double first = step * (floor(least / step + 1e-6) + 1.0);
        fprintf(
            out,
            "set cbrange [%.9g:%.9g]\nset cbtics %.9g\nset contour base\nset cntrlabel onecolor\n"
            "set cntrparam levels incremental %.9g, %.9g, %.9g\n"
            "set style textbox opaque noborder fillcolor rgb '#ffffff' margins 0.6,0.6\n",
            least, most, step, first, step, most - 1e-6 * (most - least));
        write_numbers(out, canvas, v, (double[]){width, height}, first, step,
                      most - 1e-6 * (most - least));
    }
    fprintf(out, "splot $map using 1:2:3 with pm3d nocontour%s",
            v->shown.flat ? "\n"
                          : ", $map using 1:2:3 with lines nosurface linecolor rgb '#ffffff' "
                            "linewidth 0.8, ");
    if (!v->shown.flat)
        fprintf(out, RB_REPORT_NUMBERS " font ',%.3g'\n", rb_report_key_font(canvas));
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
                 ? rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, NULL,
                                  map ? write_map : write_curves, &v, why)
                 : rb_fail(why, RB_EINVAL, "no case has a %s", s->shown.name);
    free(at);
    return status;
}
