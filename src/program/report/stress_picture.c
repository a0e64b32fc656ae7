/* Pictures of the stress below the surface: contours, photoelastic fringes, shakedown. */
#include "program/report/internal.h"

#include "rolling/case/closed_forms.h"

#include <math.h>

typedef struct {
    const rb_report_stress *s;
    rb_report_length length; /* of one unit of the axes */
    double stress_unit;
    const char *stress_label;
    double from, to, depth; /* in units */
    double low, high;       /* of y, likewise */
    double fringe;          /* [stress] */
    double shape;           /* of the canvas: width over height */
    int column;             /* panels below each other */
} view;

static view make_view(const rb_report_stress *s)
{
    const rb_report_unit stress = rb_report_axis_unit(s->s->units, "MPa", s->s->max_pressure);
    view v = {.s = s,
              .length = rb_report_length_axis(s->s->units, s->s->half_width),
              .stress_unit = stress.size,
              .stress_label = stress.name};
    v.from = s->at[0].x / v.length.size;
    v.to = s->at[s->nx - 1].x / v.length.size;
    v.depth = 0.0;
    for (int k = 0; k < s->n; k++)
        if (rb_report_stress_is_inside(s, k))
            v.depth = fmax(v.depth, fabs(s->at[k].y) / v.length.size);
    v.low = s->of_b ? -v.depth : 0.0;
    v.high = s->of_b ? 0.0 : v.depth;
    return v;
}

/* x, y, in-plane shear, von Mises, order of the fringe; rows apart, as splot wants. */
static void write_grid(FILE *out, const view *v)
{
    const rb_report_stress *s = v->s;
    fputs("$grid << EOD\n", out);
    for (int k = 0; k < s->n; k++) {
        const rb_rolling_stress *at = &s->at[k];
        fprintf(out, "%.9g %.9g ", at->x / v->length.size, at->y / v->length.size);
        if (rb_report_stress_is_inside(s, k))
            fprintf(out, "%.7g %.7g %.7g\n", at->max_shear / v->stress_unit,
                    at->von_mises / v->stress_unit,
                    v->fringe > 0.0 ? 2.0 * at->max_shear / v->fringe : 0.0);
        else
            fputs("NaN NaN NaN\n", out);
        if (k % s->nx == s->nx - 1)
            fputc('\n', out);
    }
    fputs("EOD\n", out);
}

/* Depth over width, as it is shown: maps that are much deeper or flatter are pressed or
 * stretched, because their tics and labels would not find room. */
static double shown_aspect(const view *v)
{
    return fmin(fmax(v->depth / (v->to - v->from), 0.35), 1.6);
}

static void write_x_label(FILE *out, const view *v)
{
    fprintf(out, "set xlabel 'x %s%s%s' offset 0,0.2\n", v->length.label,
            v->s->s->formulation == RB_STATIC ? "" : "   (rolling towards +x →)",
            (shown_aspect(v) == v->depth / (v->to - v->from)) ? "" : "   (y not to scale)");
}

static void write_axes(FILE *out, const view *v)
{
    fputs("set view map\nset tics scale 0.6\nunset key\n"
          "set pm3d map corners2color mean\n",
          out);
    fprintf(out, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", v->from, v->to, v->low,
            v->high);
    write_x_label(out, v);
    /* Where the bodies touch: one line for each zone, drawn outside the surface. */
    const double beside = v->s->of_b ? 1.018 : -0.018;
    const rb_rolling_solution *s = v->s->s;
    for (int i = 0; i < s->n;) {
        const int first = i;
        const int zone = rb_report_zone(s, first);
        while (i < s->n && rb_report_zone(s, i) == zone)
            i++;
        if (zone == RB_ZONE_SEPARATED)
            continue;
        fprintf(out,
                "set arrow from %.9g, graph %g to %.9g, graph %g nohead linewidth %d "
                "linecolor rgb '%s' front\n",
                (s->x[first] - s->h[first] / 2) / v->length.size, beside,
                (s->x[i - 1] + s->h[i - 1] / 2) / v->length.size, beside,
                zone == RB_ZONE_STICK ? 2 : 6, rb_report_zone_colour(zone, 0));
    }
}

/* line: from one line of the title to the next. */
static void write_subtitle(FILE *out, const view *v, const char *title, double y, double line)
{
    static const char *const kinds[] = {"static", "steady rolling", "transient rolling"};
    const rb_rolling_solution *s = v->s->s;
    const rb_report_unit length = rb_report_axis_unit(s->units, "mm", s->half_width);
    if (v->s->tractions) {
        fprintf(out,
                "set label 1 '{/:Bold %s}   given tractions,  p_0 = %s %s,  a = %s %s' at screen "
                "0.5, %g center\n",
                title, RB_REPORT_NUMBER(s->max_pressure / v->stress_unit, 5), v->stress_label,
                RB_REPORT_NUMBER(s->half_width / length.size, 4), length.name, y);
        return;
    }
    fprintf(out, "set label 1 '{/:Bold %s}   %s,  μ %s %g,  p_0 = %s %s,  a = %s %s", title,
            kinds[s->formulation], s->mu ? "≤" : "=", rb_rolling_largest_mu(v->s->rc),
            RB_REPORT_NUMBER(s->max_pressure / v->stress_unit, 5), v->stress_label,
            RB_REPORT_NUMBER(s->half_width / length.size, 4), length.name);
    if (isfinite(s->force_ratio))
        fprintf(out, ",  Q/(μP) = %.4g", rb_report_tidy(s->force_ratio, 1.0) + 0.0);
    fprintf(out,
            "' at screen 0.5, %g center\nset label 4 '{/*0.8 contact: %s}' at screen 0.5, 0.025 "
            "center textcolor rgb '#444444'\n",
            y,
            rb_rolling_largest_mu(v->s->rc) > 0.0
                ? "thin line stick, thick line slip (orange →, purple ←)"
                : "without friction");
    rb_report_label_bodies(out, v->s->rc, s->units, 0.5, y - line);
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

static const char *into(const view *v)
{
    return v->s->of_b ? "0: surface of B" : "into A";
}

/* Where there is room beside the numbers: gnuplot would put it beyond the canvas. */
static void write_y_label(FILE *out, const view *v, panel at)
{
    fprintf(out, "set label 5 'y %s, %s' at screen %g, %g center rotate\n", v->length.label,
            into(v), at.left - (v->column ? 0.145 : 0.073), at.middle);
}

static double number_font(rb_report_canvas canvas)
{
    return 0.6 * rb_report_key_font(canvas);
}

typedef struct {
    const view *v;
    int column; /* of the block $grid */
} field;

static void point_of_grid(const void *of, int k, double at[3])
{
    const field *f = of;
    const rb_rolling_stress *s = &f->v->s->at[k];
    at[0] = s->x / f->v->length.size;
    at[1] = s->y / f->v->length.size;
    at[2] = !rb_report_stress_is_inside(f->v->s, k)
                ? NAN
                : (f->column == 3 ? s->max_shear : s->von_mises) / f->v->stress_unit;
}

static void write_numbers(FILE *out, rb_report_canvas canvas, const view *v, int column,
                          const rb_rolling_extremum *m, panel at, double step)
{
    double letters[2];
    rb_report_letters_in(canvas, RB_REPORT_WIDE, number_font(canvas), letters);
    rb_report_contour_numbers(
        out, &(rb_report_contours){
                 .nx = v->s->nx,
                 .ny = v->s->ny,
                 .point = point_of_grid,
                 .of = &(field){v, column},
                 .from = {v->from, v->low},
                 .to = {v->to, v->high},
                 .first = step,
                 .step = step,
                 .last = m->value / v->stress_unit,
                 .letter = {1.0 / (letters[0] * at.width), 1.0 / (letters[1] * at.height)},
                 .mark = (double[]){m->x / v->length.size, m->y / v->length.size}});
}

static void write_panel(FILE *out, rb_report_canvas canvas, const view *v, const char *name,
                        int column, const rb_rolling_extremum *m, panel at)
{
    const double bottom = at.middle - at.height / 2, top = bottom + at.height;
    rb_report_room(out, at.left, at.left + at.width, bottom, top);
    fprintf(
        out, "set xtics %.9g\nset ytics %.9g\n",
        rb_report_round_step((v->to - v->from) /
                             fmax(rb_report_labels_in((v->column ? 0.7 : 1.2) * at.width), 4.0)),
        rb_report_round_step(v->depth / fmin(5.0, 0.6 * rb_report_labels_in(at.height))));
    /* the value of the maximum stands in the title, where it covers no contour's */
    fprintf(out,
            "set cbtics %.9g\nset colorbox user origin %g, %g size 0.013, %g\n"
            "set label 2 '%s  [%s],  largest %s at +' at screen %g, %g center\n"
            "set label 3 '' at first %.9g, %.9g point pointtype 1 pointsize 1.6 linewidth 1.6 "
            "linecolor rgb '#111111' front\n",
            rb_report_round_step(m->value / v->stress_unit / rb_report_labels_in(at.height)),
            at.left + at.width + 0.012, bottom, at.height, name, v->stress_label,
            RB_REPORT_NUMBER(m->value / v->stress_unit, 4), at.left + at.width / 2,
            top + (v->column ? 0.03 : 0.05), m->x / v->length.size, m->y / v->length.size);
    const double step = rb_report_round_step(m->value / v->stress_unit /
                                             fmin(10.0, 2.0 * rb_report_labels_in(at.height)));
    fprintf(out, "set cbrange [0:%.9g]\nset cntrparam levels incremental %.9g, %.9g, %.9g\n",
            step * ceil(m->value / v->stress_unit / step), step, step, m->value / v->stress_unit);
    write_numbers(out, canvas, v, column, m, at, step);
    fprintf(out,
            "splot $grid using 1:2:%d with pm3d nocontour, $grid using 1:2:%d with lines nosurface "
            "linecolor rgb '#ffffff' linewidth 0.6, " RB_REPORT_NUMBERS " font ',%.3g'\n",
            column, column, number_font(canvas));
}

static void write_contours(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const panel first = panel_of(v, 0);
    write_grid(out, v);
    write_axes(out, v);
    fputs("set contour base\nset cntrlabel onecolor\n" RB_REPORT_PALETTE "set multiplot\n"
          "set style textbox opaque noborder fillcolor rgb '#ffffff' margins 0.6,0.6\n",
          out);
    write_subtitle(out, v,
                   v->s->of_b ? "Stress below the surface of B" : "Stress below the surface of A",
                   first.middle + first.height / 2 + 0.18, 0.06);
    if (v->column) /* its caption says the rest; the lower panel has the x axis of both */
        fputs("unset label 1\nunset label 9\nset xlabel\n", out);
    const panel second = panel_of(v, 1);
    write_y_label(out, v, first);
    write_panel(out, canvas, v, "in-plane shear", 3, &v->s->maxima->max_shear, first);
    fputs("unset label 1\nunset label 4\nunset label 9\n", out);
    if (v->column) {
        write_x_label(out, v);
        write_y_label(out, v, second);
    } else
        fputs("unset label 5\n", out);
    write_panel(out, canvas, v, "von Mises", 4, &v->s->maxima->von_mises, second);
    fputs("unset multiplot\n", out);
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
    view v = make_view(s);
    v.shape = rb_report_width_over_height(canvas, RB_REPORT_WIDE);
    v.column = canvas.size == RB_REPORT_85MM;
    return rb_report_draw(out, canvas, RB_REPORT_WIDE, NULL, write_contours, &v, why);
}

/* ---- Fringes ----------------------------------------------------------------------- */

/* Between crossed polarisers light passes as sin^2 of pi times the order. */
static void write_fringes(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_report_place place = rb_report_place_of(canvas);
    write_grid(out, v);
    fputs("set palette gray\nset cbrange [0:1]\nunset colorbox\n", out);
    rb_report_room(out, 0.11 + 1.5 * place.right, 0.97, 0.17, 0.87);
    write_axes(out, v);
    fprintf(out, "set ylabel 'y %s, %s'\n", v->length.label, into(v));
    fprintf(out, "set size ratio %g\nset xtics %.9g\nset ytics %.9g\n", shown_aspect(v),
            rb_report_round_step((v->to - v->from) / (place.titled ? 8.0 : 5.0)),
            rb_report_round_step(v->depth / 5.0));
    write_subtitle(out, v, v->s->of_b ? "Isochromatics of B" : "Isochromatics", 0.975, 0.036);
    if (!place.titled)
        fputs("unset label 1\nunset label 9\n", out);
    fprintf(out,
            "set label 2 'dark where σ_1 − σ_2 is a multiple of %.4g %s' at screen 0.5, 0.9 center "
            "textcolor rgb '#444444'\n",
            v->fringe / v->stress_unit, v->stress_label);
    fputs("splot $grid using 1:2:(sin(pi*$5)**2) with pm3d\n", out);
}

rb_status rb_report_fringes(FILE *out, rb_report_canvas canvas, const rb_report_stress *s,
                            double fringe, rb_message *why)
{
    if (check_grid(s, why) != RB_OK)
        return RB_EINVAL;
    view v = make_view(s);
    if (fringe > 0.0)
        v.fringe = fringe;
    else {
        /* A round number is easier to count with. */
        enum { ORDERS = 12 };
        v.fringe = rb_report_round_step(2.0 * s->maxima->max_shear.value / ORDERS);
    }
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, NULL, write_fringes, &v, why);
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
