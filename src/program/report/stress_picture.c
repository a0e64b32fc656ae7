/* Pictures of the stress below the surface: contours, photoelastic fringes, shakedown. */
#include "program/report/internal.h"

#include "rolling/case/closed_forms.h"

#include <gsl/gsl_math.h>

typedef struct {
    const rb_report_stress *s;
    rb_report_length length; /* of one unit of the axes */
    double y_unit;           /* the same of y: < 0 where books count it the other way */
    double stress_unit;
    rb_report_unit stress; /* of the title */
    int dimensionless;
    double from, to, depth; /* in units */
    double low, high;       /* of y, likewise */
    double fringe;          /* [stress]; 0: of contours */
    double shape;           /* of the canvas: width over height */
    int column;             /* panels below each other */
} view;

static view make_view(const rb_report_stress *s, int dimensionless)
{
    const rb_report_unit stress = rb_report_axis_unit(s->s->units, "MPa", s->s->max_pressure);
    view v = {.s = s,
              .length = dimensionless ? (rb_report_length){s->s->half_width, "/ a"}
                                      : rb_report_length_axis(s->s->units, s->s->half_width),
              .stress_unit = dimensionless ? s->s->max_pressure : stress.size,
              .stress = stress,
              .dimensionless = dimensionless};
    v.y_unit = dimensionless && s->of_b ? -v.length.size : v.length.size;
    v.from = v.to = s->at[0].x / v.length.size;
    v.depth = 0.0;
    for (int k = 0; k < s->n; k++) {
        v.from = fmin(v.from, s->at[k].x / v.length.size);
        v.to = fmax(v.to, s->at[k].x / v.length.size);
        if (rb_report_stress_is_inside(s, k))
            v.depth = fmax(v.depth, fabs(s->at[k].y) / v.length.size);
    }
    /* books draw the depth downwards */
    v.low = dimensionless ? v.depth : s->of_b ? -v.depth : 0.0;
    v.high = dimensionless || s->of_b ? 0.0 : v.depth;
    return v;
}

/* The largest value that is drawn apart: of a whole wheel three times the mean over its area,
 * because next to the contact the stress is far larger than in the rest of it. */
static double last_shown(const view *v, double (*of)(const rb_rolling_stress *at), double largest)
{
    const rb_report_stress *s = v->s;
    double sum = 0.0, area = 0.0;

    for (int k = 0; s->whole && k < s->n - s->nx; k++) {
        const rb_rolling_stress *at = &s->at[k], *next = at + 1, *above = at + s->nx;
        if (k % s->nx == s->nx - 1 || !isfinite(of(at)))
            continue;
        const double cell =
            fabs((next->x - at->x) * (above->y - at->y) - (next->y - at->y) * (above->x - at->x));
        sum += of(at) * cell;
        area += cell;
    }
    return area > 0.0 ? fmin(largest, 3.0 * sum / area) : largest;
}

static double shear_of(const rb_rolling_stress *at)
{
    return at->max_shear;
}

static double mises_of(const rb_rolling_stress *at)
{
    return at->von_mises;
}

/* How much of the dark and the light of fringes is left at a point: of cells that are as wide as a
 * fringe nothing, as in a photograph. */
static double contrast(const view *v, int k)
{
    const rb_report_stress *s = v->s;
    const int i = k % s->nx,
              neighbour[] = {i > 0 ? k - 1 : k, i < s->nx - 1 ? k + 1 : k,
                             k >= s->nx ? k - s->nx : k, k < s->n - s->nx ? k + s->nx : k};
    double orders = 0.0; /* from here to there, at most */

    for (int j = 0; j < 4; j++)
        if (rb_report_stress_is_inside(s, neighbour[j]))
            orders = fmax(orders, 2.0 * fabs(s->at[neighbour[j]].max_shear - s->at[k].max_shear) /
                                      v->fringe);
    return orders >= 1.0 ? 0.0 : orders > 0.0 ? sin(M_PI * orders) / (M_PI * orders) : 1.0;
}

/* The points that are drawn, finer than those of the printed table; NaN outside the body. */
static void let_grid(FILE *out, const view *v)
{
    const rb_report_stress *s = v->s;
    char x[RB_NUMBER_TEXT], y[RB_NUMBER_TEXT];
    const char *mm = rb_unit_name(s->s->units, "mm"), *stress = rb_unit_name(s->s->units, "MPa");

    fprintf(out, "$table << EOD\nx_%s\ty_%s\tmax_shear_%s\tvon_mises_%s%s\n", mm, mm, stress,
            stress, v->fringe > 0.0 ? "\tcontrast" : "");
    for (int k = 0; k < s->n; k++) {
        const rb_rolling_stress *at = &s->at[k];
        /* all digits: at the border of the picture none may lie outside */
        fprintf(out, "%s\t%s\t", rb_number_text(at->x, x), rb_number_text(at->y, y));
        if (rb_report_stress_is_inside(s, k))
            fprintf(out, "%.7g\t%.7g", at->max_shear, at->von_mises);
        else
            fputs("NaN\tNaN", out);
        if (v->fringe > 0.0 && rb_report_stress_is_inside(s, k))
            fprintf(out, "\t%.3g", contrast(v, k));
        else if (v->fringe > 0.0)
            fputs("\tNaN", out);
        fputc('\n', out);
        if (k % s->nx == s->nx - 1)
            fputc('\n', out); /* rows apart, as splot wants them */
    }
    fputs("EOD\n", out);
    rb_report_let_units(out, s->s->units);
}

/* Depth over width, as it is shown: maps that are much deeper or flatter are pressed or
 * stretched, because their tics and labels would not find room. */
static double shown_aspect(const view *v)
{
    return fmin(fmax(v->depth / (v->to - v->from), 0.35), 1.6);
}

static void let_axes(FILE *out, const view *v)
{
    rb_report_let(out, "x_unit", v->length.size);
    rb_report_let(out, "y_unit", v->y_unit);
    rb_report_let(out, "stress_unit", v->stress_unit);
    rb_report_let_text(out, "stress_name", "%s", v->dimensionless ? "p_0" : v->stress.name);
    rb_report_let_text(out, "stress_axis", "%s",
                       v->dimensionless ? " / p_0" : RB_REPORT_COUNTED_IN(0, v->stress.name));
    rb_report_let(out, "x_from", v->from);
    rb_report_let(out, "x_to", v->to);
    rb_report_let(out, "y_from", v->low);
    rb_report_let(out, "y_to", v->high);
    rb_report_let_whole(out, "surface_above", v->high == 0.0);
    rb_report_let_whole(out, "whole", v->s->whole);
    rb_report_let_whole(out, "circles", v->s->ny);
    rb_report_let(out, "aspect", shown_aspect(v));
    rb_report_let_text(out, "x_label", "x %s%s%s", v->length.label,
                       v->s->s->formulation == RB_STATIC ? "" : "   (rolling towards +x →)",
                       (shown_aspect(v) == v->depth / (v->to - v->from)) ? ""
                                                                         : "   (y not to scale)");
    rb_report_let_text(out, "y_label", "%s %s, %s", v->dimensionless ? "depth" : "y",
                       v->length.label,
                       !v->s->of_b        ? "into A"
                       : v->dimensionless ? "into B"
                                          : "0: surface of B");
}

/* Where the bodies touch. */
static void let_zones(FILE *out, const view *v)
{
    const rb_rolling_solution *s = v->s->s;

    fputs("$zones << EOD\nfrom to zone\n", out);
    for (int i = 0; i < s->n;) {
        const int first = i;
        const int zone = rb_report_zone(s, first);
        while (i < s->n && rb_report_zone(s, i) == zone)
            i++;
        if (zone != RB_ZONE_SEPARATED)
            fprintf(out, "%.9g %.9g %d\n", (s->x[first] - s->h[first] / 2) / v->length.size,
                    (s->x[i - 1] + s->h[i - 1] / 2) / v->length.size, zone);
    }
    fputs("EOD\n", out);
}

/* The texts `title`, `bodies` and `contact`; the last two are "" for given tractions. */
static void let_title(FILE *out, const view *v, const char *title)
{
    static const char *const kinds[] = {"static", "steady rolling", "transient rolling"};
    const rb_rolling_solution *s = v->s->s;
    const rb_report_unit length = rb_report_axis_unit(s->units, "mm", s->half_width);
    const double mu = rb_rolling_largest_mu(v->s->rc);
    const int given = v->s->tractions != NULL;
    char case_is[100] = "given tractions", force[60] = "";

    if (!given)
        snprintf(case_is, sizeof case_is, "%s,  μ %s %g", kinds[s->formulation], s->mu ? "≤" : "=",
                 mu);
    if (!given && isfinite(s->force_ratio))
        snprintf(force, sizeof force, ",  Q/(μP) = %.4g",
                 rb_report_tidy(s->force_ratio, 1.0) + 0.0);
    rb_report_let_text(out, "title", "{/:Bold %s}   %s,  p_0 = %s %s,  a = %s %s%s", title, case_is,
                       RB_REPORT_NUMBER(s->max_pressure / v->stress.size, 5), v->stress.name,
                       RB_REPORT_NUMBER(s->half_width / length.size, 4), length.name, force);
    rb_report_let_text(out, "contact", "%s",
                       given      ? ""
                       : mu > 0.0 ? "contact: thin line stick, thick line slip (orange →, purple ←)"
                                  : "contact: without friction");
    if (given)
        rb_report_let_text(out, "bodies", "%s", "");
    else
        rb_report_let_bodies(out, v->s->rc, s->units);
}

static void let_all(FILE *out, const view *v, const char *title)
{
    let_grid(out, v);
    let_zones(out, v);
    let_axes(out, v);
    let_title(out, v, title);
}

/* ---- Contours ---------------------------------------------------------------------- */

typedef struct {
    double left, middle, width, height; /* in parts of the canvas */
} panel;

/* As large as fits. `set size ratio -1` would shrink the map inside its margins and leave
 * the tics behind. */
static panel panel_of(const view *v, int k)
{
    const double wide = v->column ? 0.61 : 0.345, high = v->column ? 0.31 : 0.55;
    const double aspect = v->shape * shown_aspect(v);
    const double width = fmin(wide, high / aspect);
    const double left = v->column ? 0.2 : 0.085 + 0.475 * k;
    return (panel){.left = left + 0.5 * (wide - width),
                   .middle = !v->column ? 0.505 : 0.755 - 0.45 * k,
                   .width = width,
                   .height = width * aspect};
}

static double number_font(rb_report_canvas canvas)
{
    return 0.6 * rb_report_key_font(canvas);
}

typedef struct {
    const view *v;
    double (*of)(const rb_rolling_stress *at);
} field;

static void point_of_grid(const void *of, int k, double at[3])
{
    const field *f = of;
    const rb_rolling_stress *s = &f->v->s->at[k];
    at[0] = s->x / f->v->length.size;
    at[1] = s->y / f->v->y_unit;
    at[2] = rb_report_stress_is_inside(f->v->s, k) ? f->of(s) / f->v->stress_unit : NAN;
}

/* Panel k: its place, steps, the largest value, and the block $numbersK. */
static void let_panel(FILE *out, rb_report_canvas canvas, const view *v, int k, const field *f,
                      const rb_rolling_extremum *m)
{
    const panel at = panel_of(v, k);
    const double largest = m->value / v->stress_unit, x = m->x / v->length.size,
                 y = m->y / v->y_unit;
    const double last = last_shown(v, f->of, m->value) / v->stress_unit;
    const double step =
        rb_report_round_step(last / fmin(10.0, 2.0 * rb_report_labels_in(at.height)));
    const rb_report_named numbers[] = {
        {"left", at.left},
        {"middle", at.middle},
        {"width", at.width},
        {"height", at.height},
        {"x_step",
         rb_report_round_step((v->to - v->from) /
                              fmax(rb_report_labels_in((v->column ? 0.7 : 1.2) * at.width), 4.0))},
        {"y_step",
         rb_report_round_step(v->depth / fmin(5.0, 0.6 * rb_report_labels_in(at.height)))},
        {"scale_step", rb_report_round_step(last / rb_report_labels_in(at.height))},
        {"level_step", step},
        {"last", last},
        {"largest", largest},
        {"largest_x", x},
        {"largest_y", y}};
    char name[40];
    double letters[2];

    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        rb_format(name, sizeof name, "%s%d", numbers[i].name, k + 1);
        rb_report_let(out, name, numbers[i].x);
    }
    rb_format(name, sizeof name, "largest_text%d", k + 1);
    rb_report_let_text(out, name, "%s", RB_REPORT_NUMBER(largest, 4));
    rb_report_letters_in(canvas, RB_REPORT_WIDE, number_font(canvas), letters);
    rb_format(name, sizeof name, "numbers%d", k + 1);
    rb_report_contour_numbers(out, name,
                              &(rb_report_contours){.nx = v->s->nx,
                                                    .ny = v->s->ny,
                                                    .point = point_of_grid,
                                                    .of = f,
                                                    .from = {v->from, v->low},
                                                    .to = {v->to, v->high},
                                                    .first = step,
                                                    .step = step,
                                                    .last = last,
                                                    .letter = {1.0 / (letters[0] * at.width),
                                                               1.0 / (letters[1] * at.height)},
                                                    .mark = (double[]){x, y}});
}

static void write_contours(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;

    static const char *const titles[] = {"Stress below the surface of A",
                                         "Stress below the surface of B",
                                         "Stress in the whole of A", "Stress in the whole of B"};
    let_all(out, v, titles[2 * v->s->whole + v->s->of_b]);
    let_panel(out, canvas, v, 0, &(field){v, shear_of}, &v->s->maxima->max_shear);
    let_panel(out, canvas, v, 1, &(field){v, mises_of}, &v->s->maxima->von_mises);
    fprintf(out, "number_font = ',%.3g'\n", number_font(canvas));
}

static rb_status check_grid(const rb_report_stress *s, rb_message *why)
{
    return s->nx > 1 && s->ny > 1 ? RB_OK
                                  : rb_fail(why, RB_EINVAL, "a picture of the stress needs a grid");
}

rb_status rb_report_stress_picture(FILE *out, rb_report_canvas canvas, const rb_report_stress *s,
                                   rb_message *why)
{
    if (check_grid(s, why) != RB_OK)
        return RB_EINVAL;
    view v = make_view(s, canvas.dimensionless);
    v.shape = rb_report_width_over_height(canvas, RB_REPORT_WIDE);
    v.column = canvas.size == RB_REPORT_85MM;
    return rb_report_draw(out, canvas, RB_REPORT_WIDE, "stress", write_contours, &v, why);
}

/* ---- Fringes ----------------------------------------------------------------------- */

static void write_fringes(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_report_place place = rb_report_place_of(canvas);

    static const char *const titles[] = {"Isochromatics", "Isochromatics of B",
                                         "Isochromatics of the whole of A",
                                         "Isochromatics of the whole of B"};
    let_all(out, v, titles[2 * v->s->whole + v->s->of_b]);
    rb_report_let(out, "fringe", v->fringe / v->stress_unit);
    rb_report_let(out, "last_fringe",
                  2.0 * last_shown(v, shear_of, v->s->maxima->max_shear.value) / v->stress_unit);
    rb_report_let(out, "x_step",
                  rb_report_round_step((v->to - v->from) / (place.titled ? 8.0 : 5.0)));
    rb_report_let(out, "y_step", rb_report_round_step(v->depth / 5.0));
}

rb_status rb_report_fringes(FILE *out, rb_report_canvas canvas, const rb_report_stress *s,
                            double fringe, rb_message *why)
{
    if (check_grid(s, why) != RB_OK)
        return RB_EINVAL;
    view v = make_view(s, canvas.dimensionless);
    if (fringe > 0.0)
        v.fringe = fringe;
    else {
        /* A round number is easier to count with. */
        enum { ORDERS = 12 };
        const double last = last_shown(&v, shear_of, s->maxima->max_shear.value);
        v.fringe = v.stress_unit * rb_report_round_step(2.0 * last / (ORDERS * v.stress_unit));
    }
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "fringes", write_fringes, &v, why);
}

/* ---- Shakedown --------------------------------------------------------------------- */

/* The largest pressure for elastic behaviour under repeated rolling. */
static void write_limit(FILE *out, rb_report_canvas canvas, const void *context)
{
    enum { POINTS = 60 };
    const rb_report_stress *s = context;
    const double traction = fabs(s->s->tangential_load / s->s->normal_load);
    const double most = fmax(0.6, 1.2 * traction);
    const double own = s->s->max_pressure / s->yield_shear;
    const double limit = s->s->max_pressure / s->shakedown->shear_yield;
    const rb_report_unit stress = rb_report_axis_unit(s->s->units, "MPa", s->s->max_pressure);

    (void)canvas;
    fputs("$table << EOD\ntraction\tlimit\n", out);
    for (int k = 0; k <= POINTS; k++)
        fprintf(out, "%.9g\t%.9g\n", most * k / POINTS,
                rb_closed_shakedown_limit(most * k / POINTS));
    fputs("EOD\n", out);
    rb_report_let(out, "traction", traction);
    rb_report_let(out, "limit", limit);
    rb_report_let(out, "own", own);
    rb_report_let(out, "traction_to", most);
    rb_report_let(out, "limit_to", fmax(5.0, isfinite(own) ? 1.1 * own : 0.0));
    rb_report_let_text(out, "title",
                       "{/:Bold Shakedown}   p_0 = %.5g %s,  p_0 ≤ %.4g k shakes down",
                       s->s->max_pressure / stress.size, stress.name, limit);
}

rb_status rb_report_shakedown_map(FILE *out, rb_report_canvas canvas, const rb_report_stress *s,
                                  rb_message *why)
{
    if (!s->shakedown || !(s->s->normal_load > 0.0))
        return rb_fail(why, RB_EINVAL, "no contact to draw");
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "shakedown", write_limit, s, why);
}
