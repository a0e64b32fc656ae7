/* The stress below strips of tractions where there is no crack, as nodal forces (C5). */
#include "crack/internal.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* Terms of the series far away from the load, and how many half-widths that is: 2^-48. */
enum { TERMS = 48 };
static const double FAR = 2.0;

/* Phi = sum J_k ln(e_k - z): jumps of f = p - i q at the ends of strips.  Far away a
 * series in half/(z - centre). */
typedef struct {
    int ends;
    double *end;
    double complex *jump; /* ends; owned, as end */
    double centre, half;
    double complex moment[TERMS + 1];
} source;

static void source_free(source *s)
{
    free(s->end);
    free(s->jump);
}

static rb_status source_create(const rb_bem_edge_load *load, double x, source *s)
{
    const size_t ends = (size_t)load->n + 1;
    double complex before = 0.0;

    memset(s, 0, sizeof *s);
    s->end = rb_alloc(ends, 1);
    s->jump = calloc(ends, sizeof *s->jump);
    if (!s->end || !s->jump)
        return RB_ENOMEM; /* the caller frees what there is */
    for (int k = 0; k <= load->n; k++) {
        const double complex f = k < load->n ? load->p[k] - I * load->q[k] : 0.0;
        if (f != before) {
            s->end[s->ends] = x + load->x[k];
            s->jump[s->ends++] = (before - f) / (2.0 * M_PI * I);
        }
        before = f;
    }
    if (s->ends == 0)
        return RB_OK;
    s->centre = 0.5 * (s->end[0] + s->end[s->ends - 1]);
    s->half = 0.5 * (s->end[s->ends - 1] - s->end[0]);
    for (int k = 0; k < s->ends; k++) {
        const double u = (s->end[k] - s->centre) / s->half;
        double power = 1.0;
        for (int m = 1; m <= TERMS; m++) {
            power *= u;
            s->moment[m] += s->jump[k] * power;
        }
    }
    return RB_OK;
}

/* Phi(z), Phi(conj z) and Phi'(z) below the surface. */
static void potential(const source *s, double complex z, double complex *Phi,
                      double complex *above, double complex *slope)
{
    *Phi = *above = *slope = 0.0;
    if (s->ends == 0)
        return;
    if (cabs(z - s->centre) < FAR * s->half) {
        for (int k = 0; k < s->ends; k++) {
            const double dx = s->end[k] - creal(z), dy = -cimag(z),
                         square = dx * dx + dy * dy;
            const double complex logarithm = 0.5 * log(square) + I * atan2(dy, dx);
            *Phi += s->jump[k] * logarithm;
            *above += s->jump[k] * conj(logarithm);
            *slope -= s->jump[k] * ((dx - I * dy) / square);
        }
        return;
    }
    const double complex v = s->half / (z - s->centre), u = conj(v);
    for (int m = TERMS; m >= 1; m--) { /* Horner: -sum M_m v^m/m and its derivative */
        *Phi = (*Phi - s->moment[m] / m) * v;
        *above = (*above - s->moment[m] / m) * u;
        *slope = (*slope + s->moment[m]) * v;
    }
    *slope *= v / s->half;
}

rb_status rb_crack_load(const rb_crack *c, const rb_bem_edge_load *load, double x,
                        double tension, double *T)
{
    source s = {0};
    const rb_status status = load ? source_create(load, x, &s) : RB_OK;

    memset(T, 0, 2 * (size_t)c->n * sizeof *T);
    for (int k = 0; k < c->shape.elements && status == RB_OK; k++) {
        rb_crack_point point[RB_CRACK_LOAD_POINTS];
        rb_crack_load_points(&c->element[k], point);
        for (int q = 0; q < RB_CRACK_LOAD_POINTS; q++) {
            const double complex z = point[q].z, n = I * c->element[k].t;
            double complex Phi, above, slope;
            potential(&s, z, &Phi, &above, &slope);
            const double complex vertical =
                Phi - above + (z - conj(z)) * conj(slope); /* syy - i sxy */
            const double syy = creal(vertical), sxy = -cimag(vertical),
                         sxx = 4.0 * creal(Phi) - syy + tension;
            const double complex traction =
                sxx * creal(n) + sxy * cimag(n) + I * (sxy * creal(n) + syy * cimag(n));
            for (int end = 0; end < 2; end++) {
                const int j = k + end - c->first;
                if (j < 0 || j >= c->n)
                    continue;
                const double weight = point[q].weight * point[q].hat[end];
                T[j] += weight * creal(traction * conj(I * c->t[j]));
                T[j + c->n] += weight * creal(traction * conj(c->t[j]));
            }
        }
    }
    source_free(&s);
    return status;
}
