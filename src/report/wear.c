/* Wear: table of the steps, JSON, lines for people, picture of pressure and depth. */
#include "report/internal.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static rb_report_columns columns_of(const rb_rolling_wear_history *h)
{
    return (rb_report_columns){&rb_rolling_wear_columns, h, 0, RB_UNITS_MM};
}

static const char *unit_of(const rb_report_wear *w)
{
    return w->slides ? "mm slid" : w->rolls ? "turns" : "cycles";
}

rb_status rb_report_wear_table(FILE *out, const rb_report_wear *w, const char *command,
                               const rb_report_style *style)
{
    const rb_report_columns columns = columns_of(w->history);
    rb_report_cells c = rb_report_begin_columns(out, style, command, 1, &columns);

    rb_report_comment(&c, "way: %s; work: of friction per %s", unit_of(w),
                      w->slides  ? "mm slid"
                      : w->rolls ? "rolled mm"
                                 : "cycle");
    return rb_report_end_columns(&c, w->history->n, 1, &columns);
}

json_t *rb_report_json_wear(const rb_report_wear *w)
{
    const rb_report_columns columns = columns_of(w->history);
    json_t *wear = json_object();

    rb_report_json_columns(&wear, w->history->n, &columns, 0);
    return wear;
}

void rb_report_wear_summary(FILE *out, const rb_report_wear *w)
{
    const rb_rolling_wear_history *h = w->history;
    const int last = h->n - 1;

    fprintf(out, "wear: %d steps, %.5g %s\n", last, h->way[last], unit_of(w));
    fprintf(out, "  worn      %.6g mm3 per mm of width, at most %.5g mm deep\n",
            h->worn[last], h->max_depth[last]);
    fprintf(out, "  contact   %.5g ... %.5g mm, before %.5g ... %.5g mm\n",
            h->contact_from[last], h->contact_to[last], h->contact_from[0],
            h->contact_to[0]);
    fprintf(out, "  p0        %.6g MPa, before %.6g MPa; residual %.2g\n",
            h->max_pressure[last], h->max_pressure[0], h->residual[last]);
}

/* ---- What a picture keeps
 * ---------------------------------------------------------------
 */

void rb_report_wear_free(rb_report_wear *w)
{
    for (int k = 0; k < w->profiles; k++)
        free(w->profile[k].x);
    w->profiles = 0;
}

static rb_status keep_profile(const rb_rolling_solution *s, double depth, double way,
                              rb_report_wear_profile *p)
{
    const size_t n = (size_t)s->n;

    *p = (rb_report_wear_profile){.n = s->n, .way = way, .x = rb_alloc(n, 3)};
    if (!p->x)
        return RB_ENOMEM;
    p->p = p->x + n;
    p->depth = p->p + n;
    memcpy(p->x, s->x, n * sizeof *p->x);
    memcpy(p->p, s->p, n * sizeof *p->p);
    for (size_t i = 0; i < n; i++)
        p->depth[i] = s->worn ? s->worn[i] : depth;
    return RB_OK;
}

/* The first step, the last one, and in between those nearest to equal parts of the way.
 */
rb_status rb_report_wear_keep(rb_report_wear *w, const rb_rolling_solution *s,
                              const rb_rolling_wear_history *h, int step, int steps)
{
    const int most = RB_REPORT_WEAR_PROFILES - 1;
    const int part = steps > most ? (int)((long)step * most / steps) : step;
    const int before = steps > most ? (int)((long)(step - 1) * most / steps) : step - 1;

    if ((step > 0 && part == before) || w->profiles == RB_REPORT_WEAR_PROFILES)
        return RB_OK;
    return keep_profile(s, h->max_depth[step], h->way[step], &w->profile[w->profiles++]);
}

/* ---- Picture
 * ---------------------------------------------------------------------------
 */

static void write_data(FILE *out, const rb_report_wear *w)
{
    for (int k = 0; k < w->profiles; k++) {
        const rb_report_wear_profile *p = &w->profile[k];
        fprintf(out, "$profile%d << EOD\n", k);
        for (int i = 0; i < p->n; i++)
            fprintf(out, "%.9g %.9g %.9g\n", p->x[i], p->p[i], -1e3 * p->depth[i]);
        fputs("EOD\n", out);
    }
}

static void write_panel(FILE *out, const rb_report_wear *w, int column)
{
    fputs("plot ", out);
    for (int k = 0; k < w->profiles; k++)
        fprintf(out,
                "%s$profile%d using 1:%d with lines linecolor rgb '%s' dashtype %s "
                "linewidth 1.8 title '%.4g'",
                k > 0 ? ", " : "", k, column, rb_report_colour(k), rb_report_dashes(k),
                w->profile[k].way);
    fputc('\n', out);
}

static void write_script(FILE *out, rb_report_canvas canvas, const void *context)
{
    const rb_report_wear *w = context;
    const rb_report_place place = rb_report_place_of(canvas);
    const rb_rolling_wear_history *h = w->history;
    const int last = h->n - 1;
    const double from = fmin(h->contact_from[0], h->contact_from[last]);
    const double to = fmax(h->contact_to[0], h->contact_to[last]);

    write_data(out, w);
    fprintf(out,
            "set multiplot\nset lmargin at screen %g\nset rmargin at screen "
            "0.965\n" RB_REPORT_GRID "set format x ''\n",
            0.14 + place.right);
    fprintf(out,
            "set xrange [%.9g:%.9g]\nset key at screen 0.965, %g right horizontal "
            "maxrows 1 samplen 1.5 font ',%.3g'\nset label 2 '%s:' at screen %g, %g "
            "left\n",
            from - 0.1 * (to - from), to + 0.1 * (to - from), 0.91 + 1.6 * place.up,
            rb_report_key_font(canvas), unit_of(w), 0.14 - place.right, 0.897 + place.up);
    if (place.titled)
        fprintf(
            out,
            "set label 1 '{/:Bold Wear}   P = %.5g N/mm,  %.4g mm^3/mm worn after %.4g "
            "%s' at screen 0.54, 0.955 center\n",
            h->normal_load[last], h->worn[last], h->way[last], unit_of(w));
    fputs("set tmargin at screen 0.87\nset bmargin at screen 0.54\n"
          "set yrange [0:*]\nset label 3 'pressure  [MPa]' at screen 0.03, 0.705 center "
          "rotate\n",
          out);
    write_panel(out, w, 2);
    fputs("unset label\nunset key\nset tmargin at screen 0.50\nset bmargin at screen "
          "0.13\nset format x '%g'\nset yrange [*:*]\nset offsets 0,0,0,graph 0.05\n"
          "set label 3 'worn off  [µm]' at screen 0.03, 0.315 center rotate\nset xlabel "
          "'x [mm]' offset 0,0.3\n",
          out);
    write_panel(out, w, 3);
    fputs("unset multiplot\n", out);
}

rb_status rb_report_wear_picture(FILE *out, rb_report_canvas canvas,
                                 const rb_report_wear *w, rb_message *why)
{
    if (w->profiles < 1)
        return rb_fail(why, RB_EINVAL, "nothing to draw");
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, write_script, w, why);
}
