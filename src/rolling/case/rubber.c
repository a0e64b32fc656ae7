/* Young's modulus of rubber by its hardness (docs/rolls.md). */
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

const rb_rubber_relation rb_rubber_relations[RB_RUBBER_RELATIONS] = {
    {"Gent", by_gent}, {"BS 903", by_bs903}, {"Qi, Joyce and Boyce", by_qi}};

double rb_rubber_band(double shore)
{
    double least = INFINITY, largest = 0.0;
    for (int k = 0; k < RB_RUBBER_RELATIONS; k++) {
        const double young = rb_rubber_relations[k].young(shore);
        least = fmin(least, young);
        largest = fmax(largest, young);
    }
    return largest / least;
}

/* ---- As a value ---------------------------------------------------------------------- */

int rb_rubber_read(const char *text, double *young, rb_message *why)
{
    char *end;
    const double shore = strchr(" \t\n", *text) ? NAN : rb_read_number(text, &end);
    if (!isfinite(shore) || end == text)
        return 0;
    end += strspn(end, " ");
    if (strncasecmp(end, "shore", 5) != 0)
        return 0;
    end += 5;
    end += strspn(end, " -");
    *young = NAN;
    if (strcasecmp(end, "A") != 0)
        rb_fail(why, RB_EINVAL, "a hardness in ShoreA, of which the modulus is known; got '%.60s'",
                text);
    else if (shore < RB_RUBBER_SOFTEST || shore > RB_RUBBER_HARDEST)
        rb_fail(why, RB_EINVAL,
                "a hardness of %g to %g ShoreA, where it says the modulus; got '%.60s'",
                RB_RUBBER_SOFTEST, RB_RUBBER_HARDEST, text);
    else
        *young = by_gent(shore);
    return 1;
}
