/* Random cases over all options of a single case, as command lines: bodies, surfaces,
 * gaps, third bodies, friction laws, heat, controls, meshes.  The k-th one is the same
 * whichever others are made.  Some are refused by the program: options that are drawn
 * independently may contradict each other. */
#ifndef ROLLBEM_TESTS_RANDOM_CASE_H
#define ROLLBEM_TESTS_RANDOM_CASE_H

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef enum { RANDOM_STATIC, RANDOM_STEADY, RANDOM_STEPS, RANDOM_TRANSIENT } random_regime;

typedef struct {
    uint64_t state;
    random_regime regime;
    double radius, half_width; /* of A; about that of the contact */
    int is_thin;               /* a layer or a cover much thinner than the contact */
    char line[1500];
} random_case;

static inline uint64_t random_bits(random_case *c)
{
    uint64_t z = c->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static inline int random_choice(random_case *c, int n)
{
    return (int)(random_bits(c) % (uint64_t)n);
}

static inline double random_between(random_case *c, double low, double high)
{
    return low + (high - low) * (double)(random_bits(c) >> 11) / 9007199254740992.0;
}

static inline double random_log(random_case *c, double low, double high)
{
    return exp(random_between(c, log(low), log(high)));
}

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static inline void
random_add(random_case *c, const char *format, ...)
{
    const size_t at = strlen(c->line);
    va_list args;
    va_start(args, format);
    vsnprintf(c->line + at, sizeof c->line - at, format, args);
    va_end(args);
}

/* Support, material and surface of A (b = "") or B ("-b"). */
static inline void random_body(random_case *c, const char *b, double young, double radius,
                               int is_flat)
{
    static const double poisson[] = {-0.5, 0.0, 0.3, 0.4, 0.49, 0.5};
    const int support = is_flat ? 0 : random_choice(c, 8), relaxes = !random_choice(c, 4);
    const double a = c->half_width;
    random_add(c, " --young%s %.6g --poisson%s %.4g", b, young, b,
               random_choice(c, 2) ? poisson[random_choice(c, 6)] : random_between(c, -0.2, 0.5));
    if (support < 4) {
        random_add(c, " --support%s halfplane", b);
        if (!random_choice(c, 4)) {
            const double d = a * random_log(c, 0.1, 10.0);
            c->is_thin |= d < a;
            random_add(c, " --layer-thickness%s %.6g", b, d);
            if (random_choice(c, 2))
                random_add(c, " --base-young%s %.6g --base-poisson%s 0.3", b,
                           young * random_log(c, 0.1, 100.0), b);
        }
    } else if (support < 7) {
        random_add(c, " --support%s hub --hub-ratio%s %.4g", b, b,
                   random_choice(c, 3) ? random_between(c, 0.1, 0.7)
                                       : random_between(c, 0.7, 0.95));
        if (!random_choice(c, 4) && a < 0.1 * radius) {
            const double d = radius * random_log(c, 0.02, 0.15);
            c->is_thin |= d < a;
            random_add(c, " --cover-thickness%s %.6g", b, d);
            if (random_choice(c, 2))
                random_add(c, " --core-young%s %.6g --core-poisson%s 0.3", b,
                           young * random_log(c, 1.0, 100.0), b);
        }
    } else {
        random_add(c, " --support%s arc --arc%s %.4g", b, b, random_between(c, 10.0, 80.0));
    }
    if (relaxes && (c->regime == RANDOM_STEADY || c->regime == RANDOM_TRANSIENT) &&
        (support < 4 || (c->regime == RANDOM_STEADY && support < 7))) {
        random_add(c, " --relaxation-time%s %.5g,%.5g --relaxation-ratio%s %.4g,%.4g", b,
                   a / 1000.0 * random_log(c, 0.05, 20.0), a / 1000.0 * random_log(c, 0.05, 20.0),
                   b, random_log(c, 0.03, 10.0), random_log(c, 0.03, 3.0));
        if (!strstr(c->line, "--speed"))
            random_add(c, " --speed 1000");
    }
}

static inline void random_bodies(random_case *c)
{
    const double young = random_log(c, 1.0, 3e5);
    if (!random_choice(c, 8))
        random_add(c, " --plane stress");
    random_add(c, " --radius %.6g", c->radius);
    random_body(c, "", young, c->radius, 0);
    switch (random_choice(c, 8)) {
    case 0:
        random_add(c, " --similar");
        break;
    case 1:
        random_body(c, "-b", young * random_log(c, 0.2, 5.0), INFINITY, 1);
        break;
    case 2: {
        const double radius = c->radius * random_log(c, 0.3, 10.0);
        random_add(c, " --radius-b %.6g", radius);
        random_body(c, "-b", young * random_log(c, 0.2, 5.0), radius, 0);
        break;
    }
    case 3:
        random_add(c, " --radius-b %.6g --similar", c->radius * random_log(c, 0.3, 10.0));
        break;
    case 4:
        random_add(c, " --radius-b %.6g --young-b %.6g --poisson-b 0.3",
                   -c->radius * random_log(c, 1.3, 10.0), young * random_log(c, 0.2, 5.0));
        break;
    default: /* rigid */
        if (!random_choice(c, 6))
            random_add(c, " --normals surface");
    }
}

static inline void random_gap(random_case *c)
{
    const double a = c->half_width, height = a * a / (2.0 * c->radius);
    const int kind = random_choice(c, 10);
    FILE *file;
    if (kind < 6) {
        random_add(c, "%s", kind < 2 ? " --gap parabola" : "");
    } else if (kind < 8 && (file = fopen("gap.txt", "w"))) {
        for (int k = -60; k <= 60; k++) {
            const double x = 0.1 * k * a;
            fprintf(file, "%.10g %.10g\n", x,
                    x * x / (2.0 * c->radius) + 0.01 * height * cos(4.0 * x / a));
        }
        fclose(file);
        random_add(c, " --gap gap.txt");
        if (random_choice(c, 2))
            random_add(c, " --gap-smoothing %.4g", 1e-3 * height);
    } else if ((file = fopen("worn.txt", "w"))) {
        const double depth = height * random_log(c, 1e-3, 0.2);
        fprintf(file, "%.9g 0\n%.9g %.9g\n%.9g %.9g\n%.9g 0\n", -0.9 * a, -0.3 * a, depth, 0.2 * a,
                1.5 * depth, 0.8 * a);
        fclose(file);
        random_add(c, " --worn worn.txt");
    }
}

/* A third body, a law of friction, heat: none of them in most cases. */
static inline void random_interface(random_case *c)
{
    const int rolls = c->regime == RANDOM_STEADY;
    const double mu = random_choice(c, 4)   ? random_log(c, 0.02, 0.8)
                      : random_choice(c, 3) ? random_log(c, 0.8, 3.0)
                                            : 0.0;
    random_add(c, " --mu %.5g", mu);
    const char *young = strstr(c->line, "--young ");
    const double E = young ? strtod(young + 8, NULL) : 1.0;
    const double soft = c->half_width / E;
    switch (random_choice(c, 10)) {
    case 0:
        random_add(c, " --interlayer-tangential %.4g", soft * random_log(c, 1e-3, 1.0));
        break;
    case 1:
        random_add(c, " --interlayer-normal %.4g --interlayer-tangential %.4g",
                   soft * random_log(c, 1e-3, 1.0), soft * random_log(c, 1e-3, 1.0));
        break;
    case 2:
        if (c->regime == RANDOM_STATIC || rolls)
            random_add(c, " --interlayer-tangential %.4g --yield-stress %.4g --hardening %.4g",
                       soft * random_log(c, 1e-2, 1.0),
                       E * c->half_width / c->radius * random_log(c, 0.01, 0.3),
                       E / c->half_width * random_log(c, 1e-2, 1.0));
        break;
    case 3:
        if (rolls && mu > 0.0 && !strstr(c->line, "--relaxation"))
            random_add(
                c, " --speed 1000 --friction-law exponential --mu-fall %.4g --slip-scale %.4g",
                0.3 * mu, 1000.0 * mu * c->half_width / c->radius * random_log(c, 0.3, 10.0));
        break;
    case 4:
        if (rolls && mu > 0.0 && !strstr(c->line, "--relaxation"))
            random_add(c, " --speed 1000 --conductivity 50 --heat-capacity 3.6");
        break;
    default:
        break;
    }
}

static inline void random_controls(random_case *c)
{
    const double a = c->half_width, sign = random_choice(c, 2) ? 1.0 : -1.0;
    if (random_choice(c, 3))
        random_add(c, " --half-width %.6g", a);
    else
        random_add(c, " --approach %.6g", a * a / c->radius * random_between(c, 0.3, 2.0));
    switch (random_choice(c, c->regime == RANDOM_STEADY ? 5 : 4)) {
    case 0:
        random_add(c,
                   c->regime == RANDOM_STATIC || c->regime == RANDOM_STEPS ? " --shift %.6g"
                                                                           : " --creep %.6g",
                   sign * a / c->radius * random_log(c, 1e-4, 1.0) *
                       (c->regime == RANDOM_STATIC || c->regime == RANDOM_STEPS ? a : 1.0));
        break;
    case 1:
        random_add(c, " --force-ratio %.5g", sign * random_between(c, 0.0, 0.98));
        break;
    case 2:
        if (!strstr(c->line, "--mu 0 ") && c->regime != RANDOM_STATIC)
            random_add(c, " --creep-ratio %.5g", sign * random_between(c, 0.0, 1.5));
        break;
    case 4:
        random_add(c, " --free-axle");
        break;
    default:
        break;
    }
}

/* elements: about the least number in the contact. */
static inline void random_mesh(random_case *c, int elements)
{
    static const char *const equal[] = {"", " --mesh uniform", " --slip-operator second"};
    const int is_wheel = strstr(c->line, " hub ") || strstr(c->line, " arc ");
    const char *const any[] = {"",
                               "",
                               " --mesh uniform",
                               " --mesh fitted",
                               " --mesh aligned",
                               is_wheel ? " --near-field exact" : ""};
    random_add(c, " --contact-elements %d", elements + random_choice(c, 2 * elements));
    if (c->regime == RANDOM_STATIC)
        random_add(c, "%s", any[random_choice(c, 6)]);
    else if (c->regime == RANDOM_STEADY)
        random_add(c, "%s",
                   random_choice(c, 5) ? any[random_choice(c, 6)] : equal[random_choice(c, 3)]);
    if (!random_choice(c, 12))
        random_add(c, " --lcp-form kwak");
    if (!random_choice(c, 8))
        random_add(c, random_choice(c, 2) ? " --solver newton" : " --solver lemke");
}

static inline void random_case_make(random_case *c, int k, int elements)
{
    static const random_regime regimes[] = {RANDOM_STATIC, RANDOM_STEADY, RANDOM_STEADY,
                                            RANDOM_STEADY, RANDOM_STEPS,  RANDOM_TRANSIENT};
    *c = (random_case){.state = (uint64_t)(k + 1)};
    c->state = random_bits(c); /* or the numbers of a case would be those of the next one */
    c->regime = regimes[random_choice(c, 6)];
    c->radius = random_log(c, 1.0, 2000.0);
    c->half_width = c->radius * random_log(c, 1e-3, 0.15);
    random_bodies(c);
    random_gap(c);
    random_interface(c);
    random_add(c, "%s",
               c->regime == RANDOM_STATIC   ? " --formulation static"
               : c->regime == RANDOM_STEADY ? " --formulation steady"
               : c->regime == RANDOM_STEPS  ? " --formulation static --increments 3"
                                            : " --formulation transient");
    if (c->regime == RANDOM_TRANSIENT)
        random_add(c, " --distance %.3g", random_between(c, 0.1, 0.5));
    random_controls(c);
    random_mesh(c, elements);
}

#endif
