/* Young's modulus of rubber by its hardness (docs/cookbook.md). */
#include "rolling/case/rubber.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>
#include <strings.h>

/* ---- Shore A ----------------------------------------------------------------------- */

/* Gent's is E = GENT (56 + SLOPE S)/(254 - 2.54 S). */
static const double GENT = 0.0981 / 0.137505, SLOPE = 7.62336;

static double by_gent(double shore)
{
    return GENT * (56.0 + SLOPE * shore) / (254.0 - 2.54 * shore);
}

double rb_rubber_shore(double young)
{
    return (254.0 * young - 56.0 * GENT) / (SLOPE * GENT + 2.54 * young);
}

/* S = 100 erf(3.186e-4 sqrt(E/Pa)).  Newton's method from 0 rises to the solution, because erf is
 * concave there. */
static double by_bs903(double shore)
{
    double x = 0.0, step = 1.0;
    while (step > 1e-15 * x) {
        step = (shore / 100.0 - erf(x)) * exp(x * x) / M_2_SQRTPI;
        x += step;
    }
    return pow(x / 3.186e-4, 2.0) * 1e-6;
}

static double by_qi(double shore)
{
    return pow(10.0, 0.0235 * shore - 0.6403);
}

/* ---- P&J: hundredths of a millimetre that a ball of 3.175 mm sinks under 9.81 N -------- */

static const double BALL = 0.5 * 3.175, WEIGHT = 9.81;

/* ISO 48: 61.5 r^-0.48 (F/E)^0.74 hundredths of a millimetre. */
static double by_iso48(double hundredths)
{
    return WEIGHT * pow(61.5 * pow(BALL, -0.48) / hundredths, 1.0 / 0.74);
}

/* F = 16/9 E sqrt(r d^3) at nu = 1/2. */
static double by_hertz(double hundredths)
{
    return WEIGHT * 9.0 / 16.0 / sqrt(BALL * gsl_pow_3(0.01 * hundredths));
}

const rb_rubber_scale rb_rubber_scales[RB_RUBBER_SCALES] = {
    {"ShoreA",
     20.0,
     90.0,
     3,
     {{"Gent", by_gent}, {"BS 903", by_bs903}, {"Qi, Joyce and Boyce", by_qi}}},
    {"P&J", 10.0, 200.0, 2, {{"ISO 48", by_iso48}, {"Hertz", by_hertz}}}};

void rb_rubber_band(const rb_rubber_scale *scale, double hardness, double *least, double *largest)
{
    *least = INFINITY;
    *largest = 0.0;
    for (int k = 0; k < scale->relations; k++) {
        const double young = scale->relation[k].young(hardness);
        *least = fmin(*least, young);
        *largest = fmax(*largest, young);
    }
}

/* ---- As a value ---------------------------------------------------------------------- */

int rb_rubber_read(const char *text, int bare, double *shore, rb_message *why)
{
    const rb_rubber_scale *scale = &rb_rubber_scales[RB_RUBBER_SHORE_A];
    char *end;
    const double read = strchr(" \t\n", *text) ? NAN : rb_read_number(text, &end);
    if (!isfinite(read) || end == text)
        return 0;
    end += strspn(end, " ");
    const int named = strncasecmp(end, "shore", 5) == 0;
    if (!named && !bare)
        return 0;
    end += named ? 5 + strspn(end + 5, " -") : 0;
    *shore = NAN;
    const char *or_modulus = bare ? "" : "a modulus, or ";
    if (strcasecmp(end, "A") != 0 && (named || *end))
        rb_fail(why, RB_EINVAL,
                "%sa hardness in ShoreA (others have no known modulus), got '%.60s'", or_modulus,
                text);
    else if (read < scale->lowest || read > scale->highest)
        rb_fail(
            why, RB_EINVAL,
            "%sa hardness of %g to %g ShoreA, outside of which it tells no modulus; got '%.60s'",
            or_modulus, scale->lowest, scale->highest, text);
    else
        *shore = read;
    return 1;
}
