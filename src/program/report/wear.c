/* Wear: table of the steps, JSON, summary, picture of pressure and depth. */
#include "program/report/internal.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The steps, and their error bars.  Returns how many. */
static int parts_of(const rb_rolling_wear_history *h, rb_report_columns part[2])
{
    part[0] =
        (rb_report_columns){.columns = &rb_rolling_wear_columns, .owner = h, .units = h->units};
    if (h->errors)
        part[1] = (rb_report_columns){.columns = &rb_rolling_wear_columns,
                                      .owner = h->errors,
                                      .kind = RB_REPORT_ERRORS,
                                      .units = h->units};
    return h->errors ? 2 : 1;
}

/* What the way counts, and what the work of friction is per. */
typedef struct {
    char way[20], work[20];
} wear_words;

static wear_words words_of(const rb_rolling_wear_history *h)
{
    const char *mm = rb_unit_name(h->units, "mm");
    wear_words words = {"cycles", "cycle"};

    if (h->slides) {
        snprintf(words.way, sizeof words.way, "%s slid", mm);
        memcpy(words.work, words.way, sizeof words.work);
    } else if (h->rolls) {
        snprintf(words.way, sizeof words.way, "turns");
        snprintf(words.work, sizeof words.work, "rolled %s", mm);
    }
    return words;
}

rb_status rb_report_wear_table(FILE *out, const rb_report_wear *w,
                               const rb_rolling_note_list *notes, const char *command,
                               const rb_report_style *style)
{
    rb_report_columns part[2];
    const int parts = parts_of(w->history, part);
    const wear_words words = words_of(w->history);
    rb_report_cells c = rb_report_begin_columns(out, style, command, parts, part);

    rb_report_comment(&c, "way: %s; work: of friction per %s", words.way, words.work);
    if (w->history->positions > 0)
        rb_report_comment(&c,
                          "stroke: long, the wear is that of %d places along it; approach, "
                          "contact and p0 belong to its middle",
                          w->history->positions);
    const rb_status noted = rb_report_comment_notes(&c, notes);
    return noted == RB_OK ? rb_report_end_columns(&c, w->history->n, parts, part) : noted;
}

json_t *rb_report_json_wear(const rb_report_wear *w)
{
    rb_report_columns part[2];
    const int parts = parts_of(w->history, part);
    json_t *wear = json_object();

    rb_report_json_columns(&wear, w->history->n, &part[0], 0);
    if (parts > 1) {
        json_t *errors = json_object();
        rb_report_json_columns(&errors, w->history->n, &part[1], 0);
        rb_report_json_set(&wear, "errors", errors);
    }
    return wear;
}

void rb_report_wear_summary(FILE *out, const rb_report_wear *w)
{
    void *before = rb_locale_begin();
    const rb_rolling_wear_history *h = w->history;
    const int last = h->n - 1;
    const char *mm = rb_unit_name(h->units, "mm"), *MPa = rb_unit_name(h->units, "MPa");

    char positions[80] = "";
    if (h->positions > 0)
        snprintf(positions, sizeof positions,
                 ", solved at %d places along it; contact and p0 in its middle", h->positions);
    fprintf(out, "wear: %d steps, %.5g %s\n", last, h->way[last], words_of(h).way);
    fprintf(out, "  worn      %.6g %s3 per %s of width, at most %.5g %s deep\n", h->worn[last], mm,
            mm, h->max_depth[last], mm);
    if (h->worn_b)
        fprintf(out, "  worn of B %.6g %s3 per %s of width, %s %.5g %s deep\n", h->worn_b[last], mm,
                mm, h->slides || (h->rolls && !h->radius_b) ? "in one passage" : "at most",
                h->max_depth_b[last], mm);
    if (h->stroke)
        fprintf(out, "  stroke    +-%.5g %s%s\n", h->stroke[last], mm, positions);
    fprintf(out, "  contact   %.5g ... %.5g %s, before %.5g ... %.5g %s\n", h->contact_from[last],
            h->contact_to[last], mm, h->contact_from[0], h->contact_to[0], mm);
    fprintf(out, "  p0        %.6g %s, before %.6g %s; residual %.2g\n", h->max_pressure[last], MPa,
            h->max_pressure[0], MPa, h->residual[last]);
    for (int j = 0; j < rb_rolling_wear_columns.n && h->errors; j++) {
        const rb_rolling_result *r = &rb_rolling_wear_columns.row[j];
        if (j == 0)
            fputs("  error bars at the end (estimated from coarser meshes and longer steps)\n",
                  out);
        if (!r->error_bar || !rb_rolling_has_column(r, h))
            continue;
        const double e = rb_rolling_entry(r, h->errors, last);
        const char *unit = r->unit ? rb_report_unit_name(h->units, r->unit) : "";
        if (isnan(e))
            fprintf(out, "    %-16s no bar\n", r->name);
        else
            fprintf(out, "    %-16s %.8g +- %.1g%s%s\n", r->name, rb_rolling_entry(r, h, last), e,
                    *unit ? " " : "", unit);
    }
    rb_locale_end(before);
}

/* ---- What a picture keeps ---------------------------------------------------------- */

void rb_report_wear_free(rb_report_wear *w)
{
    for (int k = 0; k < w->profiles; k++)
        free(w->profile[k].x);
    w->profiles = 0;
}

/* The first step, the last one, and in between those nearest to equal parts of the way. */
rb_status rb_report_wear_keep(rb_report_wear *w, const rb_rolling_solution *s,
                              const rb_rolling_wear_history *h, int step, int steps)
{
    const long parts = RB_REPORT_WEAR_PROFILES - 1;

    if ((step > 0 && step * parts / steps == (step - 1) * parts / steps) ||
        w->profiles == RB_REPORT_WEAR_PROFILES)
        return RB_OK;
    const double way = h->slides ? rb_unit_shown(s->units, "mm", h->way[step]) : h->way[step];
    const double depth = rb_unit_shown(s->units, "mm", h->max_depth[step]);
    rb_report_wear_profile *p = &w->profile[w->profiles++];
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

/* ---- Picture ----------------------------------------------------------------------- */

static rb_status write_table(FILE *out, const void *of, const rb_report_style *style)
{
    return rb_report_wear_table(out, of, NULL, "", style);
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *context)
{
    const rb_report_wear *w = context;
    const rb_rolling_wear_history *h = w->history;
    const int last = h->n - 1;
    const double half = 0.5 * (h->contact_to[last] - h->contact_from[last]);
    const rb_report_unit length = rb_report_axis_unit(h->units, "mm", half);
    const rb_report_unit stress =
        rb_report_axis_unit(h->units, "MPa", fmax(h->max_pressure[0], 0.0));
    /* Depths are shown in a small unit. */
    static const rb_report_unit all[] = {[RB_UNITS_MM] = {1e-3, "µm"},
                                         [RB_UNITS_SI] = {1e-6, "µm"},
                                         [RB_UNITS_INCH] = {1e-3, "mil"}};
    const rb_report_unit depth = all[h->units];
    const double from = fmin(h->contact_from[0], h->contact_from[last]) / length.size;
    const double to = fmax(h->contact_to[0], h->contact_to[last]) / length.size;
    const char *mm = rb_unit_name(h->units, "mm");
    const wear_words words = words_of(h);
    char name[20], first[20 * RB_REPORT_WEAR_PROFILES] = "",
                              ends[20 * RB_REPORT_WEAR_PROFILES] = "";
    int rows = 0;

    (void)canvas;
    rb_report_let_table(out, "table", write_table, w);
    rb_report_let_units(out, h->units);
    fputs("$profiles << EOD\nx p depth\n", out);
    for (int k = 0; k < w->profiles; k++) {
        const rb_report_wear_profile *p = &w->profile[k];
        rb_append(first, sizeof first, "%s%d", k ? " " : "", rows);
        for (int i = 0; i < p->n; i++, rows++)
            fprintf(out, "%.9g %.9g %.9g\n", p->x[i] / length.size, p->p[i] / stress.size,
                    -p->depth[i] / depth.size);
        rb_append(ends, sizeof ends, "%s%d", k ? " " : "", rows - 1);
    }
    fputs("EOD\n", out);
    rb_report_let_text(out, "first", "%s", first);
    rb_report_let_text(out, "last", "%s", ends);
    for (int k = 0; k < w->profiles; k++) {
        snprintf(name, sizeof name, "name%d", k + 1);
        rb_report_let_text(out, name, "%s", RB_REPORT_NUMBER(w->profile[k].way, 5));
    }
    rb_report_let(out, "x_from", from - 0.1 * (to - from));
    rb_report_let(out, "x_to", to + 0.1 * (to - from));
    rb_report_let_text(out, "title", "{/:Bold Wear}   P = %s %s,  %s %s^3/%s worn after %s %s",
                       RB_REPORT_NUMBER(h->normal_load[last], 5), rb_unit_name(h->units, "N/mm"),
                       RB_REPORT_NUMBER(h->worn[last], 4), mm, mm,
                       RB_REPORT_NUMBER(h->way[last], 5), words.way);
    rb_report_let_text(out, "way", "%s", words.way);
    rb_report_let_text(out, "x_label", "x [%s]", length.name);
    rb_report_let_text(out, "p_label", "pressure  [%s]", stress.name);
    rb_report_let_text(out, "depth_label", "worn off  [%s]", depth.name);
}

rb_status rb_report_wear_picture(FILE *out, rb_report_canvas canvas, const rb_report_wear *w,
                                 rb_message *why)
{
    if (w->profiles < 1)
        return rb_fail(why, RB_EINVAL, "nothing to draw");
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "wear", write_inputs, w, why);
}
