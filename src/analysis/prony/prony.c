/* Non-negative least squares of a Prony series, by complementarity. */
#include "analysis/prony/prony.h"
#include "lcp/lcp.h"

#include <complex.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <string.h>

enum { JOINED = -2 };

/* The largest measured modulus over E_g: below it J_g is a rounding error, as that of a liquid. */
static const double LEAST = 1e-3;

/* ---- One set of times ------------------------------------------------------------------- */

/* A column of the problem over the measured |J*|: 1 for k = 0, 1/(1 + i w tau) of term k - 1. */
static double complex entry(const rb_prony_data *d, const double *time, int i, int k)
{
    const double weight = hypot(d->storage[i], d->loss[i]);
    return k == 0 ? weight : weight / (1.0 + I * d->omega[i] * time[k - 1]);
}

/* The measured J* over its absolute value. */
static double complex target(const rb_prony_data *d, int i)
{
    const double complex E = d->storage[i] + I * d->loss[i];
    return conj(E) / cabs(E);
}

/* The columns have the size of the moduli, hence the scale. */
static void normal_equations(const rb_prony_data *d, const rb_prony_series *s, double scale,
                             double *M, double *q)
{
    const int m = s->terms + 1;
    memset(M, 0, (size_t)m * (size_t)m * sizeof *M);
    memset(q, 0, (size_t)m * sizeof *q);
    for (int i = 0; i < d->n; i++) {
        double complex row[RB_PRONY_MOST + 1];
        for (int k = 0; k < m; k++)
            row[k] = scale * entry(d, s->time, i, k);
        for (int k = 0; k < m; k++) {
            q[k] -= creal(conj(row[k]) * target(d, i));
            for (int j = 0; j < m; j++)
                M[k + j * m] += creal(conj(row[k]) * row[j]);
        }
    }
}

static void measure_misfit(const rb_prony_data *d, rb_prony_series *s)
{
    double sum = 0.0;
    s->largest = -1.0;
    for (int i = 0; i < d->n; i++) {
        double complex J = entry(d, s->time, i, 0);
        for (int k = 0; k < s->terms; k++)
            J += s->ratio[k] * entry(d, s->time, i, k + 1);
        const double off = cabs(J / s->young - target(d, i));
        sum += off * off;
        if (off > s->largest) {
            s->largest = off;
            s->worst = i;
        }
    }
    s->rms = sqrt(sum / d->n);
}

static void take_out(rb_prony_series *s, int k)
{
    const size_t behind = (size_t)(s->terms-- - k - 1);
    memmove(s->time + k, s->time + k + 1, behind * sizeof *s->time);
    memmove(s->ratio + k, s->ratio + k + 1, behind * sizeof *s->ratio);
    memmove(s->place + k, s->place + k + 1, behind * sizeof *s->place);
}

/* Fits E_g and the ratios of the times of s.  Terms of 0 are taken out; so is the shortest time as
 * long as nothing is left for J_g: beyond the data both are the same. */
static rb_status fit_ratios(const rb_prony_data *d, rb_prony_series *s, rb_message *why)
{
    rb_arena scratch = {0};
    const size_t most = (size_t)s->terms + 1;
    double *M = rb_arena_doubles(&scratch, most, most), *q = rb_arena_doubles(&scratch, most, 1),
           *c = rb_arena_doubles(&scratch, most, 1), scale = 0.0;
    rb_status status = RB_OK;

    if (scratch.failed)
        return rb_fail(why, rb_arena_done(&scratch, RB_ENOMEM), "out of memory for %d times",
                       s->terms);
    for (int i = 0; i < d->n; i++)
        scale = fmax(scale, hypot(d->storage[i], d->loss[i]));
    for (;; take_out(s, 0)) {
        rb_lcp_info info;
        const rb_lcp_problem p = {s->terms + 1, M, s->terms + 1, q};
        normal_equations(d, s, 1.0 / scale, M, q);
        status = rb_lcp_lemke(&p, NULL, c, &info);
        if (status != RB_OK)
            rb_fail(why, status, "prony: %d times: %s", s->terms,
                    rb_status_reason(status, &info.msg));
        if (status != RB_OK || c[0] > LEAST || s->terms == 0)
            break;
    }
    if (status != RB_OK)
        return rb_arena_done(&scratch, status);
    s->young = scale / c[0];
    for (int k = 0; k < s->terms; k++)
        s->ratio[k] = c[k + 1] / c[0];
    for (int k = s->terms - 1; k >= 0; k--)
        if (!(s->ratio[k] > 0.0))
            take_out(s, k);
    measure_misfit(d, s);
    return rb_arena_done(&scratch, RB_OK);
}

/* ---- Times ------------------------------------------------------------------------------ */

static void range_of(const rb_prony_data *d, double *shortest, double *decades)
{
    double low, high;
    gsl_stats_minmax(&low, &high, d->omega, 1, (size_t)d->n);
    *shortest = -0.5 - log10(high);
    *decades = log10(high) - log10(low) + 1.0;
}

static rb_status fit_spaced(const rb_prony_data *d, int n, rb_prony_series *s, rb_message *why)
{
    double shortest, decades;
    range_of(d, &shortest, &decades);
    *s = (rb_prony_series){.terms = n, .per_decade = (n - 1) / decades};
    for (int k = 0; k < n; k++) {
        s->time[k] = pow(10.0, shortest + k / s->per_decade);
        s->place[k] = k;
    }
    return fit_ratios(d, s, why);
}

/* How many times there are at this spacing or the next closer one that meets both ends. */
static rb_status count_times(const rb_prony_data *d, double per_decade, int *n, rb_message *why)
{
    double shortest, decades;
    if (d->n < 3)
        return rb_fail(why, RB_EINVAL, "prony: expected 3 frequencies or more, got %d", d->n);
    for (int i = 0; i < d->n; i++)
        if (!(d->omega[i] > 0.0 && d->storage[i] > 0.0 && d->loss[i] >= 0.0) ||
            !isfinite(d->omega[i]) || !isfinite(d->storage[i]) || !isfinite(d->loss[i]))
            return rb_fail(why, RB_EINVAL,
                           "prony: point %d: expected a frequency > 0, a storage modulus > 0 and a "
                           "loss >= 0",
                           i + 1);
    range_of(d, &shortest, &decades);
    const double times = ceil(per_decade * decades - 1e-9) + 1.0; /* of rounded decades */
    if (!(times >= 2.0 && times <= RB_PRONY_MOST))
        return rb_fail(why, RB_EINVAL,
                       "prony: expected 2 ... %d relaxation times, got %g per decade over %.3g "
                       "decades",
                       RB_PRONY_MOST, per_decade, decades);
    *n = (int)times;
    return RB_OK;
}

rb_status rb_prony_fit(const rb_prony_data *d, double per_decade, rb_prony_series *s,
                       rb_message *why)
{
    int n;
    const rb_status status = count_times(d, per_decade, &n, why);
    return status == RB_OK ? fit_spaced(d, n, s, why) : status;
}

/* ---- Pairs ------------------------------------------------------------------------------ */

static int are_neighbours(const rb_prony_series *s, int k)
{
    return k >= 0 && k + 1 < s->terms && s->place[k] >= 0 && s->place[k + 1] == s->place[k] + 1;
}

static int is_pair(const rb_prony_series *s, int k)
{
    return are_neighbours(s, k) && !are_neighbours(s, k - 1) && !are_neighbours(s, k + 1);
}

/* Means are those of the ratios before any pair is joined: their order does not matter. */
rb_status rb_prony_join(const rb_prony_data *d, rb_prony_series *s, rb_message *why)
{
    const rb_prony_series before = *s;
    for (int j = 0; j + 1 < before.terms; j++) {
        int k = 0;
        while (k < s->terms && s->place[k] != before.place[j])
            k++;
        if (!is_pair(&before, j) || !are_neighbours(s, k))
            continue;
        rb_prony_series one = *s;
        const double share = before.ratio[j] / (before.ratio[j] + before.ratio[j + 1]);
        one.time[k] = pow(s->time[k], share) * pow(s->time[k + 1], 1.0 - share);
        one.place[k] = JOINED;
        one.joined++;
        take_out(&one, k + 1);
        const rb_status status = fit_ratios(d, &one, why);
        if (status != RB_OK)
            return status;
        if (one.rms < s->rms)
            *s = one;
    }
    return RB_OK;
}

/* ---- The series of a table ---------------------------------------------------------------- */

static rb_status solve_at(const rb_prony_data *d, double per_decade, int most, rb_prony_series *s,
                          rb_message *why)
{
    int n;
    rb_status status = count_times(d, per_decade, &n, why);
    for (int limited = 0; status == RB_OK; limited = 1, n--) {
        status = fit_spaced(d, n, s, why);
        if (status == RB_OK)
            status = rb_prony_join(d, s, why);
        s->limited = limited;
        if (s->terms <= most)
            break;
    }
    return status;
}

rb_status rb_prony_solve(const rb_prony_data *d, double per_decade, int most, rb_prony_series *s,
                         rb_message *why)
{
    rb_status status = solve_at(d, per_decade > 0.0 ? per_decade : 2.0, most, s, why);
    for (int closer = 4; status == RB_OK && !(per_decade > 0.0) && closer <= 8; closer *= 2) {
        rb_prony_series one;
        /* too close for the normal equations: what there is stays */
        if (rb_prony_fit(d, closer, &one, NULL) != RB_OK || rb_prony_join(d, &one, NULL) != RB_OK ||
            one.terms > most || one.rms > s->rms / 1.5)
            break;
        *s = one;
    }
    return status;
}

void rb_prony_moduli(const rb_prony_series *s, double omega, double *storage, double *loss)
{
    double complex J = 1.0;
    for (int k = 0; k < s->terms; k++)
        J += s->ratio[k] / (1.0 + I * omega * s->time[k]);
    *storage = creal(s->young / J);
    *loss = cimag(s->young / J);
}

double rb_prony_slow(const rb_prony_series *s)
{
    double sum = 1.0;
    for (int k = 0; k < s->terms; k++)
        sum += s->ratio[k];
    return s->young / sum;
}
