/* Numbers of a case fitted to measured forces (theory-solvers.md, D5): where to start, intervals,
 * and all together. */
#include "analysis/fit/fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

/* A further round has the elements of the last one's result, if the sum of squares is another
 * one on them, by this part of itself or of the squares of the measured forces. */
enum { ROUNDS = 2 };
/* Elements with which a fit of more than twice as many starts, and of other starts at most. */
enum { COARSE = 40 };
static const double SAME = 1e-3, SAME_OF_ALL = 1e-8;
/* Steps with elements that move; what moves the fitted curve less, as a part of its noise, is none;
 * and what a fit that finds no lesser sum may be off. */
enum { MOVING_STEPS = 20, HALVINGS = 5 };
static const double AT_REST = 0.02, LITTLE = 0.3;
/* A lesser sum that other starts lead to is less by this part. */
static const double SAME_ELSEWHERE = 0.1;
/* How often a fit that has come to rest goes on from a lesser sum near by. */
enum { SEARCHES = 5 };
/* What elements may change in a force, as a part of the noise, or of all forces. */
static const double ROUGH = 0.5, ROUGH_OF_ALL = 5e-4;
/* The least and the largest of a coefficient of friction and its fall. */
static const double LEAST_MU = 0.01, MOST_MU = 3.0;
/* A correlation that is worth a word. */
static const double CORRELATED = 0.95;

/* ---- Intervals --------------------------------------------------------------------- */

/* (J'J)^-1, by the columns scaled to length 1; RB_SINGULAR with *which: the column that
 * the others make up. */
static rb_status covariance(const fit_problem *p, double *C, int *which)
{
    /* Columns of J scaled to length 1 make pivots comparable, whatever the units of the numbers. */
    const int n = p->n;
    double length[RB_CASE_FIT_MAX];

    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++)
            C[i + j * n] = fit_dot(p->points, fit_column(p, i), fit_column(p, j));
    for (int j = 0; j < n; j++)
        length[j] = sqrt(C[j + j * n]);
    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++)
            C[i + j * n] /= length[i] * length[j];
    for (int j = 0; j < n; j++)
        if (!(length[j] * p->fit->parameter[j].scale > 0.0)) {
            *which = j;
            return RB_SINGULAR;
        }
    /* L_jj is the distance of column j, of length 1, from what the columns before it span. */
    const int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, C, n);
    for (int j = 0; j < n && info == 0; j++)
        if (C[j + j * n] < 1e-6) {
            *which = j;
            return RB_SINGULAR;
        }
    if (info != 0 || LAPACKE_dpotri(LAPACK_COL_MAJOR, 'L', n, C, n) != 0) {
        *which = info > 0 ? info - 1 : n - 1;
        return RB_SINGULAR;
    }
    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++)
            C[j + i * n] = C[i + j * n] /= length[i] * length[j];
    return RB_OK;
}

/* With given deviations the residuals have variance 1; otherwise it is estimated from them. */
static double variance_of(const fit_problem *p)
{
    return p->data->sigma ? 1.0 : p->fit->chi_square / p->fit->degrees_of_freedom;
}

/* How many points lie where the force falls beyond its largest, by more than the noise. */
static int falling_points(const fit_problem *p)
{
    const rb_case_data *d = p->data;
    const double noise = sqrt(p->fit->chi_square / fmax(1, p->points - p->n));
    int top = 0, falling = 0;

    for (int k = 1; k < p->points; k++)
        if (fabs(d->force[k]) > fabs(d->force[top]))
            top = k;
    for (int k = 0; k < p->points; k++)
        falling +=
            fabs(d->creep[k]) > fabs(d->creep[top]) &&
            fabs(d->force[top]) - fabs(d->force[k]) > 3.0 * noise * (d->sigma ? d->sigma[k] : 1.0);
    return falling;
}

static int is_of_fall(const rb_case_parameter *of)
{
    return strcmp(of->name, "slip-scale") == 0 || strcmp(of->name, "mu-fall") == 0;
}

static void not_identified(const fit_problem *p, int j)
{
    rb_case_parameter *of = &p->fit->parameter[j];

    if (!of->identified)
        return;
    of->identified = 0;
    p->fit->unidentified++;
    if (is_of_fall(of) && falling_points(p) < 2)
        rb_append(p->fit->sentences, sizeof p->fit->sentences,
                  "no point in the falling part: %s is not identified\n", of->name);
    else
        rb_append(p->fit->sentences, sizeof p->fit->sentences,
                  "the data do not determine %s: it is not identified\n", of->name);
}

/* Intervals from the linear model at the minimum: theta +- t sqrt(variance C_jj), with Student's t
 * of the degrees of freedom; then what makes them doubtful. */
static void set_intervals(fit_problem *p, const double *theta)
{
    rb_case_fit *fit = p->fit;
    double C[RB_CASE_FIT_MAX * RB_CASE_FIT_MAX];
    const int n = p->n;
    int which = -1;

    const double variance = variance_of(p);
    /* The quantile that leaves half of 1 - level on either side. */
    const double t = gsl_cdf_tdist_Pinv(0.5 + 0.5 * fit->level, fit->degrees_of_freedom);
    const rb_status s = covariance(p, C, &which);

    fit->noise = sqrt(fit->chi_square / fit->degrees_of_freedom);
    for (int j = 0; j < n; j++) {
        rb_case_parameter *of = &fit->parameter[j];
        const double half = s == RB_OK ? t * sqrt(variance * C[j + j * n]) : INFINITY;
        of->value = theta[j];
        of->interval[0] = theta[j] - half;
        of->interval[1] = theta[j] + half;
        of->deviation = half / t;
        of->identified = 1;
        of->at_bound =
            theta[j] <= of->low + 1e-8 * of->scale || theta[j] >= of->high - 1e-8 * of->scale;
        for (int i = 0; i < n; i++)
            of->correlation[i] =
                s == RB_OK ? C[i + j * n] / sqrt(C[i + i * n] * C[j + j * n]) : NAN;
    }
    if (s != RB_OK)
        not_identified(p, which);
    for (int j = 0; j < n; j++) {
        const rb_case_parameter *of = &fit->parameter[j];
        const double half = 0.5 * (of->interval[1] - of->interval[0]);
        if ((is_of_fall(of) && falling_points(p) < 2) ||
            (of->positive && !(half < fabs(of->value))))
            not_identified(p, j);
        if (of->at_bound && of->identified)
            rb_append(fit->sentences, sizeof fit->sentences,
                      "%s lies at an end of its range; its interval does not hold there\n",
                      of->name);
        for (int i = 0; i < j; i++)
            if (fabs(of->correlation[i]) > CORRELATED)
                rb_append(fit->sentences, sizeof fit->sentences,
                          "%s and %s are correlated by more than 0.95: the data determine only a "
                          "combination of them\n",
                          fit->parameter[i].name, of->name);
    }
    /* the band of the fitted curve */
    for (int k = 0; k < p->points; k++) {
        /* J_k C J_k', the variance of the curve at point k. */
        double sum = 0.0;
        const double sigma = p->data->sigma ? p->data->sigma[k] : 1.0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                sum += p->J[k + (size_t)i * (size_t)p->points] * C[i + j * n] *
                       p->J[k + (size_t)j * (size_t)p->points];
        fit->band[k] = s == RB_OK ? t * sigma * sqrt(variance * fmax(sum, 0.0)) : NAN;
    }
}

/* |Q/P| of a point, as well as it is known before the fit. */
static double force_over_load(const fit_problem *p, int k)
{
    const rb_case_data *d = p->data;
    const rb_resolved_case *c = &p->c->resolved;
    const double P = d->load ? d->load[k] : c->derived.load;

    return fabs(d->force[k]) * (d->measure == RB_CASE_FORCE         ? 1.0 / P
                                : d->measure == RB_CASE_FORCE_RATIO ? c->rc.mu
                                                                    : 1.0);
}

/* Signs and units of others. */
static void doubt_data(const fit_problem *p)
{
    int alike = 0;
    double most = 0.0;

    for (int k = 0; k < p->points; k++) {
        alike += p->data->creep[k] * p->data->force[k] > 0.0;
        most = fmax(most, force_over_load(p, k));
    }
    if (2 * alike > p->points)
        rb_append(p->fit->sentences, sizeof p->fit->sentences,
                  "most forces have the sign of their creepage: a braked wheel has creepage > 0 "
                  "and force < 0; change the sign of one of the two columns\n");
    if (most > MOST_MU)
        rb_append(p->fit->sentences, sizeof p->fit->sentences,
                  "the largest force is %.3g times the load: check the units of the forces\n",
                  most);
}

/* ---- Where to start ---------------------------------------------------------------- */

static int is_fitted(const rb_case_fit *fit, const char *name)
{
    int found = 0;
    for (int j = 0; j < fit->n; j++)
        found |= strcmp(fit->parameter[j].name, name) == 0;
    return found;
}

/* What the data themselves say: the largest force, the last one, the first slope, where the force
 * is 0. Each number starts from the part of the measured curve that it changes most. */
static double start_of(const fit_problem *p, const char *name)
{
    const rb_case_data *d = p->data;
    const rb_rolling_derived *derived = &p->c->resolved.derived;
    double most = 0.0, far = 0.0, near = INFINITY, last = 0.0, slope = 0.0, zero = 0.0;
    double *slip = rb_alloc((size_t)p->points, 1);

    for (int k = 0; k < p->points; k++) {
        const double xi = fabs(d->creep[k]), f = force_over_load(p, k);
        most = fmax(most, f);
        if (xi >= far) {
            far = xi;
            last = f;
        }
        if (xi > 0.0 && xi < near) {
            near = xi;
            slope = f / xi;
        }
        if (slip)
            slip[k] = xi * (d->speed ? d->speed[k] : p->c->resolved.rc.speed);
        if (k > 0 && d->force[k] * d->force[k - 1] < 0.0)
            zero = d->creep[k - 1] - d->force[k - 1] * (d->creep[k] - d->creep[k - 1]) /
                                         (d->force[k] - d->force[k - 1]);
    }
    if (slip)
        gsl_sort(slip, 1, (size_t)p->points);
    const double middle = slip ? slip[p->points / 2] : NAN;
    free(slip);
    /* The first slope of Carter's law, Q/P over xi; a third body makes it less. */
    const double stiff = 2.0 * derived->radius / derived->half_width;
    return strcmp(name, "mu") == 0
               ? fmax(is_fitted(p->fit, "mu-fall") ? 0.95 * last : most, LEAST_MU)
           : strcmp(name, "mu-fall") == 0    ? fmax(most - last, 0.1 * most)
           : strcmp(name, "slip-scale") == 0 ? middle
           : strcmp(name, "interlayer-tangential") == 0
               ? 0.1 * derived->half_width / derived->modulus *
                     fmin(fmax(stiff / slope - 1.0, 0.2), 10.0)
           : strcmp(name, "creep-offset") == 0 ? -zero
                                               : NAN;
}

/* Start, range, bounds and unit of a number. The start is that of the caller, else the case's own
 * value if it was given, else the guess from the data. */
static rb_status set_parameter(fit_problem *p, int j, rb_message *why)
{
    rb_case_parameter *of = &p->fit->parameter[j];
    const rb_option *o =
        strcmp(of->name, "creep-offset") == 0 ? p->creep : rb_case_option(of->name);
    const rb_rolling_derived *d = &p->c->resolved.derived;

    if (rb_case_fit_check_name(of->name, why) != RB_OK)
        return RB_EINVAL;
    p->option[j] = o;
    of->unit = o->unit;
    const int offset = o == p->creep;
    if (offset)
        p->offset = j;
    const double own = *(const double *)(const void *)((const char *)&p->c->resolved + o->offset);
    const int by = p->c->given[o - rb_case_table];
    const int given = by != 0 && by != RB_GIVEN_NUMBER; /* else it was prepared */
    const double guess = start_of(p, of->name);
    of->value = !isnan(of->start)  ? of->start
                : !offset && given ? own
                : isfinite(guess)  ? guess
                                   : own;
    of->from = offset ? -INFINITY : o->range.from;
    of->to = offset ? INFINITY : o->range.to;
    of->low_open = o->range.from_open;
    of->high_open = o->range.to_open;
    of->positive =
        !offset && o->range.from == 0.0 && (o->range.from_open || strcmp(of->name, "mu") == 0);
    const double asked[] = {of->low, of->high};
    of->low = fmax(of->low, strcmp(of->name, "mu") == 0        ? LEAST_MU
                            : strcmp(of->name, "mu-fall") == 0 ? 0.0
                                                               : of->from);
    of->high =
        fmin(of->high,
             strcmp(of->name, "mu") == 0 || strcmp(of->name, "mu-fall") == 0 ? MOST_MU : of->to);
    if (!isfinite(of->value))
        return rb_refuse(why, "fit", "%s has no value to start from; give --%s", of->name,
                         of->name);
    of->scale = of->value != 0.0                 ? fabs(of->value)
                : offset                         ? 0.1 * d->half_width / d->radius
                : strcmp(o->unit, "mm/MPa") == 0 ? 1e-2 * d->half_width / d->modulus
                                                 : 1e-2;
    const rb_units units = p->c->resolved.units;
    if (!(of->low <= of->high))
        return rb_refuse(why, "bounds", "%s: no value of %g to %g can be fitted", of->name,
                         rb_unit_shown(units, of->unit, asked[0]),
                         rb_unit_shown(units, of->unit, asked[1]));
    const double x = of->value, near = 1e-12 * of->scale; /* what other units round */
    if (!isnan(of->start) && (x < of->low - near || x > of->high + near ||
                              (of->low_open && x <= of->from) || (of->high_open && x >= of->to)))
        return rb_refuse(why, "start", "%s = %g is not within its bounds, %g to %g", of->name,
                         rb_unit_shown(units, of->unit, of->value),
                         rb_unit_shown(units, of->unit, of->low),
                         rb_unit_shown(units, of->unit, of->high));
    rb_case_fit_clip(of, &of->value);
    return RB_OK;
}

/* Gives the case whatever the fitted numbers need to have an effect, and refuses columns of the
 * data that would have none. */
rb_status rb_case_prepare_fit(rb_case *c, const rb_case_data *data, const rb_case_fit *fit,
                              rb_message *why)
{
    static const char *const of_speed[] = {"relaxation-time", "relaxation-time-b", "conductivity",
                                           "mu-fall"};
    const int falls = is_fitted(fit, "mu-fall") || is_fitted(fit, "slip-scale");
    int depends_on_speed = 0;
    rb_status s = RB_OK;

    if (falls && !rb_case_given(c, "friction-law"))
        s = rb_case_set(c, "friction-law", "exponential", RB_GIVEN_NUMBER, why);
    if (s == RB_OK && falls && !rb_case_given(c, "mu-fall"))
        s = rb_case_set_number(c, "mu-fall", 0.1, why);
    if (s == RB_OK && falls && !rb_case_given(c, "slip-scale"))
        rb_case_assign(c, rb_case_option("slip-scale"), 1.0);
    if (s == RB_OK && data->temperature && !rb_case_given(c, "conductivity"))
        s = rb_fail(why, RB_EINVAL,
                    "the data have a column temperature, but the case has no heat: give "
                    "--conductivity, --heat-capacity and --mu-heat, or leave the column out");
    for (size_t k = 0; k < sizeof of_speed / sizeof *of_speed; k++)
        depends_on_speed |= rb_case_given(c, of_speed[k]) != 0;
    if (s == RB_OK && data->speed && !depends_on_speed)
        s = rb_fail(why, RB_EINVAL,
                    "the data have a column speed, but nothing in the case depends on it: give "
                    "--relaxation-time, --conductivity or --mu-fall, or leave the column out");
    if (s == RB_OK && data->speed && !rb_case_given(c, "speed"))
        rb_case_assign(c, rb_case_option("speed"), 1.0);
    if (s == RB_OK && data->load && !rb_case_given(c, "load") && !rb_case_given(c, "half-width") &&
        !rb_case_given(c, "approach"))
        rb_case_assign(c, rb_case_option("load"), data->load[0]);
    return s;
}

/* ---- Elements that do not come to rest --------------------------------------------- */

/* What a fit has come to. */
typedef struct {
    double theta[RB_CASE_FIT_MAX], start[RB_CASE_FIT_MAX];
    double squares; /* of the measured forces, over their deviations */
    int several;    /* 1: the model has several solutions there */
    int searched;   /* 1: numbers around have no lesser sum, on few elements */
} progress;

/* The step d of Gauss and Newton from theta to the least sum of squares, and by what part of the
 * noise the curve then moves, all points together.  Numbers that a bound holds stay. */
static rb_status gauss_newton_step(const fit_problem *p, const double *theta, double squares,
                                   double *d, double *moves, rb_message *why)
{
    /* Columns in units of their scale, and numbers held by a bound with a column of zeros: the
     * least-squares solution of least norm leaves these where they are. */
    const size_t points = (size_t)p->points, n = (size_t)p->n;
    rb_arena scratch = {0};
    double *J = rb_arena_doubles(&scratch, points, n), *b = rb_arena_doubles(&scratch, points, 1),
           singular[RB_CASE_FIT_MAX], moved = 0.0;
    lapack_int rank = 0;

    if (scratch.failed)
        return rb_arena_done(&scratch, rb_fail(why, RB_ENOMEM, "out of memory for a step"));
    for (size_t j = 0; j < n; j++) {
        const double scale =
            rb_case_fit_is_held(p, (int)j, theta[j]) ? 0.0 : p->fit->parameter[j].scale;
        for (size_t k = 0; k < points; k++)
            J[k + j * points] = fit_column(p, (int)j)[k] * scale;
    }
    for (size_t k = 0; k < points; k++)
        b[k] = -p->f[k];
    const int info = LAPACKE_dgelsd(LAPACK_COL_MAJOR, p->points, p->n, 1, J, p->points, b,
                                    p->points, singular, 1e-9, &rank);
    for (size_t j = 0; j < n; j++)
        d[j] = b[j] * p->fit->parameter[j].scale;
    for (int k = 0; k < p->points; k++) {
        double by = 0.0;
        for (int j = 0; j < p->n; j++)
            by += fit_column(p, j)[k] * d[j];
        moved += by * by;
    }
    /* A fit without noise has the rounding of the forces as its noise. */
    *moves = sqrt(moved / fmax(variance_of(p), SAME_OF_ALL * squares / p->points));
    return rb_arena_done(&scratch, info == 0 ? RB_OK
                                   : rb_lapack_status(info) == RB_ENOMEM
                                       ? rb_fail(why, RB_ENOMEM, "out of memory for a step")
                                       : rb_fail(why, RB_SINGULAR, "fit: no step is found"));
}

/* Gauss and Newton's method on elements that move with the numbers, where the minima on elements
 * that stay lead from one to the next.  The points have their elements for theta and are tried
 * there. RB_MAXITER: no minimum is found. */
static rb_status gauss_newton(fit_problem *p, progress *of, double chi2,
                              const rb_case_fit_observer *observer, rb_message *why)
{
    double *theta = of->theta, d[RB_CASE_FIT_MAX], trial[RB_CASE_FIT_MAX], moves = INFINITY;
    rb_status s = RB_OK;

    for (int k = 0; s == RB_OK; k++) {
        /* J and the residuals at theta, on elements that belong to it; then the step, halved until
         * the sum is less. */
        double part = 1.0, least = INFINITY;
        p->fit->chi_square = chi2;
        s = rb_case_fit_move(p, theta, why);
        if (s == RB_OK)
            s = gauss_newton_step(p, theta, of->squares, d, &moves, why);
        if (s != RB_OK || moves <= AT_REST || k == MOVING_STEPS)
            break;
        for (int h = 0; h < HALVINGS && s == RB_OK && !(least < chi2); h++, part *= 0.5) {
            int moved;
            for (int j = 0; j < p->n; j++) {
                trial[j] = theta[j] + part * d[j];
                rb_case_fit_clip(&p->fit->parameter[j], &trial[j]);
            }
            s = rb_case_fit_place(p, trial, &moved, why);
            if (s == RB_OK)
                s = rb_case_fit_try(p, trial, &least, why);
            if (s != RB_OK && s != RB_ENOMEM) { /* a point has no solution there */
                least = INFINITY;
                s = RB_OK;
            }
        }
        if (s == RB_OK && least < chi2) {
            memcpy(theta, trial, (size_t)p->n * sizeof *trial);
            chi2 = least;
            s = rb_case_fit_tell(p->fit, observer, chi2, theta, why);
            continue;
        }
        /* back to the elements of the least sum */
        int moved;
        if (s == RB_OK)
            s = rb_case_fit_place(p, theta, &moved, why);
        if (s == RB_OK)
            s = rb_case_fit_try(p, theta, &chi2, why);
        break;
    }
    for (int k = 0; k < p->points; k++)
        p->fit->model[k] = p->data->force[k] + p->f[k] * (p->data->sigma ? p->data->sigma[k] : 1.0);
    return s == RB_OK && !(moves <= LITTLE)
               ? rb_fail(why, RB_MAXITER,
                         "fit: not converged: a new mesh still changes the sum of squares. The "
                         "data may not determine all numbers: fit fewer, keep the elements "
                         "(--mesh uniform --zone X), or give another start (--start)")
               : s;
}

/* ---- All together ------------------------------------------------------------------ */

/* Whether the model has several solutions with the numbers found.  Where a fall is fitted that
 * the data do not show, they do not tell kappa either. */
static int has_several(const fit_problem *p)
{
    int falls = 0;
    for (int j = 0; j < p->n; j++)
        falls |= is_of_fall(&p->fit->parameter[j]);
    return p->kappa > 1.0 && !(falls && falling_points(p) < 2);
}

/* RB_INACCURATE, with the sliding distance of a memory that makes kappa a half: kappa is
 * inverse to a long one (theory-rolling.md F3). */
static rb_status refuse_several(fit_problem *p, const double *theta, rb_message *why)
{
    const double length = 1e6 * p->c->resolved.derived.half_width;
    double kappa;
    const rb_status s = rb_case_fit_kappa(p, theta, length, &kappa, why);

    return s != RB_OK
               ? s
               : rb_fail(why, RB_INACCURATE,
                         "fit: kappa = %.3g at the best fit: above 1 the model itself has "
                         "several solutions, and behind a third body kappa grows with the "
                         "number of elements; give friction a memory (--memory %.1g), with "
                         "which kappa stays below 1, or fewer elements",
                         p->kappa, rb_unit_shown(p->c->resolved.units, "mm", 2.0 * kappa * length));
}

/* Moves theta to the fit with few elements, which is near that with all of them, with the search
 * around it, which many elements would make long; and sets kappa of all elements there: if it is
 * above 1, their sum of squares has jumps.  Where this fails, theta stays. */
static rb_status start_coarsely(fit_problem *p, progress *of, const rb_case_fit_observer *observer,
                                rb_message *why)
{
    /* p->c is the coarse case while the search runs. */
    const rb_case *fine = p->c;
    rb_case *coarse = rb_case_copy(fine);
    double coarsely[RB_CASE_FIT_MAX];
    int moved, found = 1;
    rb_status s = coarse ? RB_OK : rb_fail(why, RB_ENOMEM, "out of memory for a case");

    memcpy(coarsely, of->theta, sizeof coarsely);
    if (s == RB_OK)
        s = rb_case_set_number(coarse, "contact-elements", COARSE, why);
    if (s == RB_OK)
        s = rb_case_resolve(coarse, why);
    p->c = coarse;
    for (int k = 0; k < SEARCHES && s == RB_OK && found; k++) {
        s = rb_case_fit_place(p, coarsely, &moved, why);
        if (s == RB_OK)
            s = rb_case_fit_descend(p, coarsely, observer, why);
        if (s == RB_OK)
            s = rb_case_fit_search(p, of->squares, coarsely, &found, why);
    }
    p->c = fine;
    p->known_n = 0;
    rb_case_free(coarse);
    p->kappa = 0.0;
    if (s == RB_OK)
        s = rb_case_fit_kappa(p, coarsely, NAN, &p->kappa, why);
    if (s == RB_OK)
        memcpy(of->theta, coarsely, sizeof coarsely);
    of->searched = s == RB_OK && !found;
    return s == RB_ENOMEM || s == RB_INTERRUPTED ? s : RB_OK;
}

/* The first round, from the coarse fit theta or, if a point has no solution there, from `start`. */
static rb_status descend_first(fit_problem *p, double *theta, const double *start,
                               const rb_case_fit_observer *observer, rb_message *why)
{
    const size_t bytes = (size_t)p->n * sizeof *theta;
    int moved;
    rb_status s = rb_case_fit_place(p, theta, &moved, why);

    if (s == RB_OK)
        s = rb_case_fit_descend(p, theta, observer, why);
    if (s <= 0 || s == RB_INTERRUPTED || p->accepted >= 0 || memcmp(theta, start, bytes) == 0)
        return s;
    memcpy(theta, start, bytes);
    s = rb_case_fit_place(p, theta, &moved, why);
    return s == RB_OK ? rb_case_fit_descend(p, theta, observer, why) : s;
}

/* To a minimum of the sum: on elements that stay, which are then made anew; where they differ, on
 * elements that move, because a sum on those that stay has minima of its own. */
static rb_status converge(fit_problem *p, progress *of, const rb_case_fit_observer *observer,
                          rb_message *why)
{
    double *theta = of->theta, chi2 = INFINITY;
    int moved = 1;
    rb_status s = RB_OK;

    /* A round: the minimum on the present elements, then new elements for it; it is done where
     * these give nearly the same sum. */
    for (int round = 0; round < ROUNDS && s == RB_OK && moved && !of->several; round++) {
        s = round == 0 ? descend_first(p, theta, of->start, observer, why)
                       : rb_case_fit_descend(p, theta, observer, why);
        of->several = s == RB_OK && has_several(p);
        if (of->several)
            return s;
        if (s == RB_OK)
            s = rb_case_fit_place(p, theta, &moved, why);
        p->moves |= moved;
        if (s == RB_OK && moved)
            s = rb_case_fit_try(p, theta, &chi2, why);
        if (s == RB_OK && moved)
            moved = fabs(chi2 - p->fit->chi_square) >
                    SAME * p->fit->chi_square + SAME_OF_ALL * of->squares;
    }
    return s == RB_OK && p->moves ? gauss_newton(p, of, chi2, observer, why) : s;
}

/* The same from numbers that a search has found. */
static rb_status converge_again(fit_problem *p, progress *of, const rb_case_fit_observer *observer,
                                rb_message *why)
{
    double chi2;
    int moved;

    memcpy(of->start, of->theta, sizeof of->start);
    if (!p->moves)
        return converge(p, of, observer, why);
    rb_status s = rb_case_fit_place(p, of->theta, &moved, why);
    if (s == RB_OK)
        s = rb_case_fit_try(p, of->theta, &chi2, why);
    return s == RB_OK ? gauss_newton(p, of, chi2, observer, why) : s;
}

/* From half and twice each number that the fit has begun with, and from 4 and 8 times more or less
 * where the sum there is less, but not of a coefficient of friction, of which forces are nearly
 * linear: a lesser sum may lie beyond larger ones.  On few elements, which the fit then leaves for
 * its own at the least sum of all. */
static rb_status try_other_starts(fit_problem *p, progress *of, const double *given,
                                  const rb_case_fit_observer *observer, rb_message *why)
{
    static const double factors[] = {0.5, 0.25, 0.125, 2.0, 4.0, 8.0};
    enum { FACTORS = sizeof factors / sizeof *factors, OTHERS = 1 + FACTORS * RB_CASE_FIT_MAX };
    const rb_case *fine = p->c;
    const size_t bytes = (size_t)p->n * sizeof *given;
    double least = INFINITY, nearer = INFINITY, best[RB_CASE_FIT_MAX];
    double from[OTHERS][RB_CASE_FIT_MAX];
    int moved, others = 1, is_far[OTHERS] = {0};

    /* The starts: the result itself, and each positive number times each of the factors. */
    memcpy(from[0], of->theta, bytes);
    for (int j = 0; j < p->n; j++)
        for (int k = 0; k < FACTORS && p->fit->parameter[j].positive &&
                        strcmp(p->fit->parameter[j].name, "mu") != 0;
             k++) {
            memcpy(from[others], given, bytes);
            from[others][j] *= factors[k];
            rb_case_fit_clip(&p->fit->parameter[j], &from[others][j]);
            is_far[others] = k % 3 != 0;
            others += memcmp(from[others], given, bytes) != 0;
        }
    if (others == 1)
        return RB_OK;
    rb_case *coarse = rb_case_copy(fine);
    rb_status s = coarse ? RB_OK : rb_fail(why, RB_ENOMEM, "out of memory for a case");
    if (s == RB_OK && fine->resolved.rc.contact_elements > COARSE)
        s = rb_case_set_number(coarse, "contact-elements", COARSE, why);
    if (s == RB_OK)
        s = rb_case_resolve(coarse, why);
    p->c = coarse;
    p->known_n = 0;
    memcpy(best, of->theta, bytes);
    for (int k = 0; k < others && s == RB_OK; k++) {
        double theta[RB_CASE_FIT_MAX], sum = INFINITY;
        rb_message reason = {.text = ""};
        memcpy(theta, from[k], bytes);
        rb_status at = rb_case_fit_place(p, theta, &moved, &reason);
        if (at == RB_OK && k > 0)
            at = rb_case_fit_sum(p, theta, INFINITY, NULL, &sum, &reason);
        /* Farther starts are worth a descent only where the sum falls towards them. */
        if (at == RB_OK && is_far[k] && !(sum < nearer))
            continue;
        nearer = sum;
        if (at == RB_OK)
            at = rb_case_fit_descend(p, theta, NULL, &reason);
        if (at == RB_OK)
            at = rb_case_fit_sum(p, theta, INFINITY, NULL, &sum, &reason);
        if (at == RB_ENOMEM || at == RB_INTERRUPTED)
            s = rb_fail(why, at, "%s", rb_status_reason(at, &reason));
        /* A sum that is less by a tenth is that of another minimum; less may be the mesh. */
        if (at == RB_OK &&
            (k == 0 || sum < (1.0 - SAME_ELSEWHERE) * least - SAME_OF_ALL * of->squares)) {
            least = sum;
            if (k > 0)
                memcpy(best, theta, bytes);
        }
    }
    p->c = fine;
    p->known_n = 0;
    rb_case_free(coarse);
    if (s != RB_OK)
        return s;
    memcpy(of->theta, best, bytes);
    return converge_again(p, of, observer, why);
}

/* Refuses a result around which the forces jump by more than their noise, from one mesh to the
 * next or where an edge of the contact passes an element: the sum then has many minima.  Where no
 * noise is left, the result is none of the others. */
static rb_status check_smooth(fit_problem *p, const progress *of, rb_message *why)
{
    const double chi2 = p->fit->chi_square, all = sqrt(of->squares / p->points),
                 noise = sqrt(chi2 / p->fit->degrees_of_freedom);
    double roughness = 0.0;

    if (!(chi2 > SAME_OF_ALL * of->squares))
        return RB_OK;
    const rb_status s = rb_case_fit_roughness(p, of->theta, &roughness, why);
    return s != RB_OK || roughness <= ROUGH * fmax(noise, ROUGH_OF_ALL * all)
               ? s
               : rb_fail(why, RB_MAXITER,
                         "fit: not converged: on these elements the forces jump by %.2g of their "
                         "noise where the numbers change by 8 %%, so that the sum of squares has "
                         "many minima; give more elements (--contact-elements %d) or --mesh fitted",
                         roughness / noise, 2 * p->c->resolved.rc.contact_elements);
}

/* The fit of the same case on its own elements.  is_first: 0: its starts are results. */
static rb_status fit_on_own_elements(const rb_case *c, const rb_case_data *data, int is_first,
                                     const rb_case_fit_observer *observer, rb_case_fit *fit,
                                     rb_message *why)
{
    const size_t points = (size_t)data->n;
    fit_problem p = {.c = c,
                     .data = data,
                     .fit = fit,
                     .n = fit->n,
                     .points = data->n,
                     .offset = -1,
                     .accepted = -1,
                     .creep = rb_case_option(data->is_ratio ? "creep-ratio" : "creep"),
                     .load = rb_case_option("load"),
                     .speed = rb_case_option("speed"),
                     .temperature = rb_case_option("temperature")};
    progress of = {.several = 0};
    double given[RB_CASE_FIT_MAX];
    rb_status s = RB_OK;

    if (data->n <= fit->n)
        return rb_refuse(why, "fit", "expected at least %d points for %d number%s, got %d",
                         fit->n + 1, fit->n, fit->n > 1 ? "s" : "", data->n);
    /* Memory for the points: models, residuals f (points), and J (points x n, column-major). */
    fit->degrees_of_freedom = data->n - fit->n;
    p.at = calloc(points, sizeof *p.at);
    p.known = calloc(FIT_CASES, sizeof *p.known);
    p.order = rb_alloc_int(points);
    p.f = rb_alloc(points, 1);
    p.J = rb_alloc(points, (size_t)fit->n);
    fit->model = rb_alloc(points, 1);
    fit->band = rb_alloc(points, 1);
    if (!p.at || !p.known || !p.order || !p.f || !p.J || !fit->model || !fit->band)
        s = rb_fail(why, RB_ENOMEM, "out of memory for a fit of %d points", data->n);
    for (int j = 0; j < fit->n && s == RB_OK; j++) {
        s = set_parameter(&p, j, why);
        of.theta[j] = fit->parameter[j].value;
    }
    if (s == RB_OK && p.offset >= 0 && data->is_ratio)
        s = rb_refuse(why, "fit", "creep-offset needs creepages, a column creep and no ratios");
    memcpy(of.start, of.theta, sizeof of.start);
    memcpy(given, of.theta, sizeof given);
    /* The scale of all sums of squares: that of the forces themselves. */
    for (int k = 0; k < p.points && s == RB_OK; k++) {
        p.order[k] = k;
        of.squares += gsl_pow_2(rb_case_fit_residual(&p, k, 0.0));
    }
    /* 1. A start on few elements. */
    if (s == RB_OK && c->resolved.rc.contact_elements > 2 * COARSE)
        s = start_coarsely(&p, &of, observer, why);
    /* 2. The minimum, unless friction that falls has several solutions there. */
    of.several = s == RB_OK && has_several(&p);
    if (s == RB_OK && !of.several)
        s = converge(&p, &of, observer, why);
    /* A minimum is one if no numbers around it, near or far, have a lesser sum. 3. The search for
     * lesser sums around it. */
    int found = !of.searched || s != RB_OK;
    for (int k = 0; k < SEARCHES && s >= 0 && s != RB_INTERRUPTED && !of.several && found; k++) {
        rb_message reason = {.text = ""};
        const rb_status searched = rb_case_fit_search(&p, of.squares, of.theta, &found, &reason);
        if (searched != RB_OK)
            s = rb_fail(why, searched, "%s", rb_status_reason(searched, &reason));
        else if (found)
            s = converge_again(&p, &of, observer, why);
    }
    if (s == RB_OK && !of.several && found)
        s = rb_fail(why, RB_MAXITER,
                    "fit: not converged: numbers around the result still have a lesser sum of "
                    "squares. Give another start (--start), or fit fewer numbers");
    /* 4. Other minima, from other starts. */
    if (s == RB_OK && !of.several && is_first)
        s = try_other_starts(&p, &of, given, observer, why);
    for (int j = 0; j < fit->n && s != RB_EINVAL && s != RB_ENOMEM; j++)
        fit->parameter[j].value = of.theta[j];
    fit->kappa = p.kappa;
    /* 5. Intervals, and whether the sum is smooth enough to have them. */
    if (s == RB_OK && !of.several) {
        doubt_data(&p);
        set_intervals(&p, of.theta);
        s = check_smooth(&p, &of, why);
    }
    if (s == RB_OK && has_several(&p))
        s = refuse_several(&p, of.theta, why);
    fit->status = s;
    rb_case_fit_release(&p, p.accepted == 0);
    rb_case_fit_release(&p, p.accepted);
    for (size_t k = 0; p.at && k < points; k++)
        rb_rolling_model_free(&p.at[k].base);
    free(p.at);
    free(p.known);
    free(p.order);
    free(p.f);
    free(p.J);
    return s;
}

/* What the mesh leaves in the numbers: their spread over n/2, 0.7 n and n elements, as of error
 * bars, twice as much, three times where n is below 200. */
static rb_status add_mesh_part(const rb_case *c, const rb_case_data *data, rb_case_fit *fit,
                               rb_message *why)
{
    static const double parts[] = {0.5, 0.7};
    const int n = c->resolved.rc.contact_elements;
    double low[RB_CASE_FIT_MAX], high[RB_CASE_FIT_MAX];
    rb_status s = RB_OK;

    for (int j = 0; j < fit->n; j++)
        low[j] = high[j] = fit->parameter[j].value;
    for (size_t k = 0; k < sizeof parts / sizeof *parts && s == RB_OK; k++) {
        rb_case_fit other = {.n = fit->n, .level = fit->level};
        rb_case *fewer = rb_case_copy(c);
        rb_message reason = {.text = ""};
        s = fewer ? rb_case_set_number(fewer, "contact-elements", round(parts[k] * n), why)
                  : RB_ENOMEM;
        if (s == RB_OK)
            s = rb_case_resolve(fewer, why);
        for (int j = 0; j < fit->n; j++) {
            other.parameter[j] = fit->parameter[j];
            other.parameter[j].start = fit->parameter[j].value;
        }
        const rb_status solved =
            s == RB_OK ? fit_on_own_elements(fewer, data, 0, NULL, &other, &reason) : RB_ENOMEM;
        if (s == RB_OK && (solved == RB_ENOMEM || solved == RB_INTERRUPTED))
            s = rb_fail(why, solved, "%s", rb_status_reason(solved, &reason));
        for (int j = 0; j < fit->n; j++) {
            const double x = solved == RB_OK ? other.parameter[j].value : NAN;
            low[j] = isnan(x) ? NAN : fmin(low[j], x);
            high[j] = isnan(x) ? NAN : fmax(high[j], x);
        }
        if (s == RB_OK && solved != RB_OK)
            rb_append(
                fit->sentences, sizeof fit->sentences,
                "what the mesh leaves in the numbers is not known: with %.0f elements the fit "
                "does not converge\n",
                round(parts[k] * n));
        rb_case_fit_free(&other);
        rb_case_free(fewer);
        if (solved != RB_OK)
            break;
    }
    for (int j = 0; j < fit->n; j++)
        fit->parameter[j].mesh = (n < 200 ? 3.0 : 2.0) * (high[j] - low[j]);
    return s;
}

rb_status rb_case_fit_solve(const rb_case *c, const rb_case_data *data,
                            const rb_case_fit_observer *observer, rb_case_fit *fit, rb_message *why)
{
    for (int j = 0; j < fit->n; j++)
        fit->parameter[j].mesh = NAN;
    rb_status s = fit_on_own_elements(c, data, 1, observer, fit, why);
    if (s == RB_OK && c->resolved.error)
        s = fit->status = add_mesh_part(c, data, fit, why);
    return s;
}

void rb_case_fit_free(rb_case_fit *fit)
{
    free(fit->model);
    free(fit->band);
    fit->model = fit->band = NULL;
}
