/* Summary of a solution in a few lines, and the notes on how to read it. */
#include "program/report/internal.h"
#include "rolling/case/case.h"
#include "base/blas.h"

#include <math.h>
#include <string.h>

/* ---- Strip ------------------------------------------------------------------------ */

enum { MARGIN = 3 }; /* separated elements shown beside the contact */

static int is_contact(const rb_rolling_solution *s, int i)
{
    return s->zone[i] != RB_ZONE_SEPARATED;
}

void rb_report_strip(const rb_rolling_solution *s, int width, char *strip)
{
    static const char marks[] = "oS|*=", mark[] = "o*SS||="; /* mark: of each zone */
    /* Elements first .. last - 1: the contact and a margin, or all without contact. */
    int first = 0, last = s->n, at = 0;
    while (first < s->n && !is_contact(s, first))
        first++;
    if (first == s->n)
        first = 0;
    else {
        while (!is_contact(s, last - 1))
            last--;
        first = first > MARGIN ? first - MARGIN : 0;
        last = last + MARGIN < s->n ? last + MARGIN : s->n;
    }
    const int shown = last - first;
    const int room = width - 2;
    const int n = shown < room ? shown : room;
    strip[at++] = '.';
    for (int k = 0; k < n; k++) {
        const int from = first + (int)((long)shown * k / n);
        const int to = first + (int)((long)shown * (k + 1) / n);
        /* The commonest mark of these elements. */
        int count[5] = {0}, best = 0;
        for (int i = from; i < to; i++)
            count[strchr(marks, mark[rb_report_zone(s, i)]) - marks]++;
        for (int j = 1; j < 5; j++)
            if (count[j] >= count[best])
                best = j;
        strip[at++] = marks[best];
    }
    strip[at++] = '.';
    strip[at] = '\0';
}

/* ---- Summary ---------------------------------------------------------------------- */

double rb_report_tidy(double x, double size)
{
    return fabs(x) <= 1e-12 * fabs(size) ? 0.0 : x;
}

double rb_report_creepage(const rb_rolling_solution *s)
{
    const double bound = 1e-12;
    return fabs(s->creepage) <= bound && fabs(s->creep_ratio) <= bound ? 0.0 : s->creepage;
}

/* Creepage, friction power, the resistance to rolling and the torques that it takes. */
static void write_rolling(FILE *out, const rb_rolling_solution *s)
{
    const char *load = rb_unit_name(s->units, "N/mm");
    const double creepage = rb_report_creepage(s);

    fprintf(out, "  creepage  xi = %.6g", creepage);
    if (!isnan(s->creep_ratio))
        fprintf(out, ", xi R/(mu a) = %.5g", creepage == 0.0 ? 0.0 : s->creep_ratio);
    if (!isnan(s->free_creepage)) {
        const int zero = fabs(s->free_creepage) <= 1e-12 + 1e-9 * fabs(s->creepage);
        fprintf(out, ", free rolling at %.5g", zero ? 0.0 : s->free_creepage);
    } else if (s->formulation == RB_STEADY && !isnan(s->creep_ratio)) {
        fputs(", free rolling not found", out);
    }
    fputc('\n', out);
    if (!isnan(s->dissipation))
        fprintf(out, "  power     %.5g %s dissipated, per unit speed\n",
                rb_report_tidy(s->dissipation, s->normal_load), load);
    if (s->hysteresis > 0.0) {
        fprintf(out, "  resists   M = %.5g %s, ", s->resistance_moment,
                rb_unit_name(s->units, "N"));
        if (!isnan(s->resistance_ratio))
            fprintf(out, "M/(P R) = %.5g, ", s->resistance_ratio);
        if (!isnan(s->hysteresis_factor))
            fprintf(out, "factor %.5g, ", s->hysteresis_factor);
        fprintf(out, "hysteresis %.5g %s per unit speed\n", s->hysteresis, load);
        const double lever = s->normal_load * s->half_width;
        fprintf(out, "  torque    %.5g %s on A's axle", rb_report_tidy(s->torque_a, lever),
                rb_unit_name(s->units, "N"));
        if (!isnan(s->torque_b))
            fprintf(out, ", %.5g %s on B's", rb_report_tidy(s->torque_b, lever),
                    rb_unit_name(s->units, "N"));
        fputs(", > 0: it drives\n", out);
    }
}

/* What the last cycle of a history does to the surfaces. */
static void write_fretting(FILE *out, const rb_rolling_solution *s)
{
    const rb_rolling_fretting *f = &s->fretting;
    const char *mm = rb_unit_name(s->units, "mm");

    fprintf(out,
            "  fretting  %.5g %s of work in the last cycle, at most %.5g %s; slip range %.4g %s",
            f->work, rb_unit_name(s->units, "N"), f->fretting_work.value,
            rb_unit_name(s->units, "N/mm"), f->slip_range.value, mm);
    for (int b = 0; b < (s->tension_b ? 2 : 1); b++) {
        const rb_rolling_peak *ruiz = b ? &f->ruiz_2_b : &f->ruiz_2, *swt = b ? &f->swt_b : &f->swt;
        fprintf(out, "\n            %s: Ruiz 2 %.4g %s", b ? "B" : "A", ruiz->value,
                rb_unit_name(s->units, "MPa.N/mm"));
        if (!isnan(ruiz->at))
            fprintf(out, " at x = %.4g %s", ruiz->at, mm);
        fprintf(out, ", SWT %.4g %s", swt->value, rb_unit_name(s->units, "MPa"));
        if (!isnan(swt->at))
            fprintf(out, " at x = %.4g %s", swt->at, mm);
    }
    fputc('\n', out);
}

static void write_material(FILE *out, double young, double poisson, rb_units units)
{
    fprintf(out, "E = %.6g %s, nu = %.6g", rb_unit_shown(units, "MPa", young),
            rb_unit_name(units, "MPa"), poisson);
}

static void write_body(FILE *out, const rb_rolling_body *body, rb_units units)
{
    const char *mm = rb_unit_name(units, "mm");

    if (body->stack)
        fprintf(out, "%d layers, the first of ", body->stack->n);
    write_material(out, body->young, body->poisson, units);
    if (body->memory.n > 0)
        fputs(" at once, relaxing", out);
    const double thickness = body->layer > 0.0 ? body->layer : body->cover;
    if (!(thickness > 0.0))
        return;
    const double young = body->layer > 0.0 ? body->base_young : body->core_young;
    fprintf(out, ", %.6g %s thick%s ", rb_unit_shown(units, "mm", thickness), mm,
            body->stack                          ? ","
            : body->layer_base == RB_BASE_SMOOTH ? ", sliding on"
                                                 : " on");
    if (body->stack)
        fprintf(out, "all %.6g %s on ", rb_unit_shown(units, "mm", rb_rolling_layers_depth(body)),
                mm);
    if (young > 0.0)
        write_material(out, young, body->layer > 0.0 ? body->base_poisson : body->core_poisson,
                       units);
    else
        fputs(body->layer > 0.0 ? "a rigid base" : "a rigid core", out);
}

/* 1: B differs from A in nothing that write_body names. */
static int is_alike(const rb_rolling_body *a, const rb_rolling_body *b)
{
    return a->young == b->young && a->poisson == b->poisson && a->layer == b->layer &&
           a->stack == b->stack && a->cover == b->cover && a->base_young == b->base_young &&
           a->layer_base == b->layer_base && a->base_poisson == b->base_poisson &&
           a->core_young == b->core_young && a->core_poisson == b->core_poisson &&
           (a->memory.n > 0) == (b->memory.n > 0);
}

void rb_report_bodies(FILE *out, const rb_rolling_case *rc, rb_units units)
{
    void *before = rb_locale_begin();

    fputs("  bodies    A: ", out);
    write_body(out, &rc->a, units);
    fputs("; B: ", out);
    if (!rc->elastic_b)
        fputs("rigid", out);
    else if (is_alike(&rc->a, &rc->b))
        fputs("the same", out);
    else
        write_body(out, &rc->b, units);
    fprintf(out, "; plane %s\n", rb_case_word("plane", (int)rc->plane));
    rb_locale_end(before);
}

/* How many elements stick, slip and are separated, and a strip of their zones. */
static void write_elements(FILE *out, const rb_rolling_solution *s, int width)
{
    enum { LONGEST = 200 };
    const char *mm = rb_unit_name(s->units, "mm");
    char strip[LONGEST + 1];
    const int room = width - 13 < LONGEST ? width - 13 : LONGEST;
    int frictionless = 0;
    for (int i = 0; i < s->n; i++)
        frictionless += rb_report_zone(s, i) == RB_REPORT_FRICTIONLESS;
    fprintf(out, "  elements  %d: ", s->n);
    if (frictionless > 0)
        fprintf(out, "%d touch without friction, ", frictionless);
    if (frictionless < s->contact || s->contact == 0)
        fprintf(out, "%d stick, %d slip, ", s->stick, s->slipping - frictionless);
    if (s->yielding >= 0)
        fprintf(out, "%d of them yield, ", s->yielding);
    fprintf(out, "%d separated", s->n - s->contact);
    if (s->stick > 0) {
        const double between = s->stick_to - s->stick_from;

        const double least = 1e-12 * between; /* below it an end is rounding about 0 */
        fprintf(out, "; stick %.5g ... %.5g %s", fabs(s->stick_from) > least ? s->stick_from : 0.0,
                fabs(s->stick_to) > least ? s->stick_to : 0.0, mm);
        if (s->stick_length < (1.0 - 1e-9) * between)
            fprintf(out, ", %.5g of these %.5g %s", s->stick_length, between, mm);
    }
    rb_report_strip(s, room < 8 ? 8 : room, strip);
    fprintf(out, "\n            %s\n", strip);
}

void rb_report_summary(FILE *out, const rb_rolling_solution *s, int width)
{
    void *before = rb_locale_begin();
    const int newton = s->solver == RB_SOLVER_NEWTON;
    fprintf(out, "%s: %s by ", rb_case_word("formulation", (int)s->formulation),
            rb_status_text(s->status));
    if (s->solver == RB_SOLVER_CONE)
        fprintf(out, "%s, %d iterations", rb_report_solver(s), s->iterations);
    else if (newton)
        fprintf(out, "Newton%s, %d steps", s->large ? " with Fourier transforms" : "",
                s->iterations);
    else
        fprintf(out, "Lemke (%s form), %d pivots", rb_case_word("lcp-form", (int)s->lcp_form),
                s->iterations);
    fprintf(out, ", residual %.2g\n", s->residual);
    if (s->proof.asked) {
        char text[400];
        fprintf(out, "  proof     %s\n",
                rb_report_contact_proof_text(&s->proof, text, sizeof text));
    }
    const char *load = rb_unit_name(s->units, "N/mm"), *mm = rb_unit_name(s->units, "mm"),
               *stress = rb_unit_name(s->units, "MPa");
    fprintf(out, "  load      P = %.6g %s, Q = %.6g %s", s->normal_load, load,
            rb_report_tidy(s->tangential_load, s->normal_load), load);
    if (!isnan(s->force_ratio))
        fprintf(out, ", Q/(mu P) = %.5g", rb_report_tidy(s->force_ratio, 1.0));
    fputc('\n', out);
    if (s->contact > 0)
        fprintf(out, "  contact   %.5g ... %.5g %s, p0 = %.6g %s, approach %.5g %s\n",
                s->contact_from, s->contact_to, mm, s->max_pressure, stress, s->approach, mm);
    for (int k = 0; k < s->patches && s->patches > 1; k++)
        fprintf(out, "  patch %-3d %.5g ... %.5g %s, p0 = %.6g %s, P = %.6g %s\n", k + 1,
                s->patch[k].from, s->patch[k].to, mm, s->patch[k].max_pressure, stress,
                s->patch[k].normal_load, load);
    if (!isnan(s->mean_pressure))
        fprintf(out, "  period    mean pressure %.6g %s, %.4g %% of the period in contact\n",
                s->mean_pressure, stress, 100.0 * s->contact_share);
    if (!isnan(s->ellipse.radius))
        fprintf(
            out,
            "  ellipse   a = %.6g, b = %.6g %s, p0 = %.6g %s, approach %.6g %s; its middle as a "
            "cylinder of radius %.6g %s\n",
            s->ellipse.a, s->ellipse.b, mm, s->ellipse.pressure, stress, s->ellipse.approach, mm,
            s->ellipse.radius, mm);
    if (!isnan(s->ellipse_force)) {
        fprintf(out, "  ellipse   Q = %.6g %s of the whole of it by strips",
                rb_report_tidy(s->ellipse_force, s->normal_load), rb_unit_name(s->units, "N"));
        if (!isnan(s->ellipse_force_kalker))
            fprintf(out, ", %.6g %s with the slope of Kalker's C11",
                    rb_report_tidy(s->ellipse_force_kalker, s->normal_load),
                    rb_unit_name(s->units, "N"));
        fputc('\n', out);
    }
    if (!isnan(s->tilt))
        fprintf(out, "  tilt      %.6g, M = %.6g %s\n", s->tilt, s->resistance_moment,
                rb_unit_name(s->units, "N"));
    if (s->formulation == RB_STATIC && !isnan(s->tangential_shift))
        fprintf(out, "  shift     %.6g %s\n", s->tangential_shift, rb_unit_name(s->units, "mm"));
    if (!isnan(s->creepage) && (s->formulation != RB_STATIC || s->creepage != 0.0))
        write_rolling(out, s);
    if (!isnan(s->fretting.work))
        write_fretting(out, s);
    if (!isnan(s->max_temperature))
        fprintf(out, "  heat      %.5g K at x = %.4g %s at most, Peclet number %.3g\n",
                s->max_temperature, s->max_temperature_at, rb_unit_name(s->units, "mm"), s->peclet);
    if (!isnan(s->heat_into_a)) {
        fprintf(out, "            %.5g W/m into A, %.5g W/m into B", s->heat_into_a,
                s->heat_into_b);
        if (!isnan(s->heat_share_a))
            fprintf(out, ": A takes %.4g %%", 100.0 * s->heat_share_a);
        fputc('\n', out);
    }
    write_elements(out, s, width);
    if (!isnan(s->accuracy_elements)) {
        fprintf(out, "  accuracy  with %.0f contact elements", s->accuracy_elements);
        if (s->accuracy_boundary > 1.0)
            fprintf(out, ", %.4g times the usual ones on the rest of the boundary",
                    s->accuracy_boundary);
        fputc('\n', out);
    }
    /* What it ran on: where it was slow, this says why. */
    fprintf(out, "  computed  in %.3g s", s->seconds_total);
    if (s->boundary_elements > 0)
        fprintf(out, "; %d boundary elements (%s, %s)", s->boundary_elements,
                s->hierarchical ? "hierarchical" : "dense", rb_bem_vector_name());
    fprintf(out, "; BLAS %s\n", rb_blas_core());
    rb_locale_end(before);
}

void rb_report_solutions(FILE *out, const rb_rolling_solutions *all)
{
    fprintf(out, "%d solution%s from %d starts, %d of which did not converge\n", all->n,
            all->n == 1 ? "" : "s that differ", all->starts, all->failed);
    for (int k = 0; k < all->n; k++) {
        const rb_rolling_solution *s = &all->solution[k];
        fprintf(out, "  %-3d Q/(mu P) = %.6g, %d stick, %d slip, ", k + 1, s->force_ratio, s->stick,
                s->slipping);
        if (s->stick > 0)
            fprintf(out, "stick %.5g ... %.5g %s, ", s->stick_from, s->stick_to,
                    rb_unit_name(s->units, "mm"));
        fprintf(out, "residual %.2g\n", s->residual);
    }
}
