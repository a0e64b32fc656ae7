/* The functions of rollbem/api.h in any order, with any values. */
#include "fuzz.h"
#include "rollbem/api.h"

#include <math.h>
#include <stdlib.h>

/* Meshes stay small, so that an order of calls takes milliseconds. */
static const char *const settings[][2] = {{"contact-elements", "12"},
                                          {"contact-elements", "9"},
                                          {"outer-elements", "24"},
                                          {"support", "halfplane"},
                                          {"support", "hub"},
                                          {"support", "arc"},
                                          {"support", "nonsense"},
                                          {"similar", "yes"},
                                          {"young-b", "200000"},
                                          {"radius-b", "80"},
                                          {"mu", "0"},
                                          {"mu", "0.3"},
                                          {"mu", "-1"},
                                          {"mu", "1e-12"},
                                          {"load", "100"},
                                          {"load", "1e300"},
                                          {"load", "0"},
                                          {"approach", "0.01"},
                                          {"approach", "-1"},
                                          {"half-width", "1"},
                                          {"formulation", "steady"},
                                          {"formulation", "static"},
                                          {"formulation", "transient"},
                                          {"distance", "0.3"},
                                          {"steps", "3"},
                                          {"creep", "0.001"},
                                          {"creep-ratio", "0.5"},
                                          {"force-ratio", "0.6"},
                                          {"force", "-5"},
                                          {"shift", "0.001"},
                                          {"mesh", "fitted"},
                                          {"mesh", "uniform"},
                                          {"solver", "newton"},
                                          {"solver", "lemke"},
                                          {"solver", "nsgs-ac"},
                                          {"lcp-form", "kwak"},
                                          {"zone", "0.5"},
                                          {"zone", "auto"},
                                          {"units", "si"},
                                          {"hub-ratio", "0.9"},
                                          {"gap", "exact"},
                                          {"gap", "/nowhere"},
                                          {"interlayer-normal", "1e-6"},
                                          {"layer-thickness", "2"},
                                          {"normals", "surface"},
                                          {"poisson", "0.5"},
                                          {"increments", "2"}};

static const char *const names[] = {"p",
                                    "q",
                                    "zone",
                                    "F",
                                    "H",
                                    "history.distance",
                                    "history.error.distance",
                                    "step.p",
                                    "step.x",
                                    "ends",
                                    "gap0",
                                    "mesh.x0",
                                    "curve.creepage",
                                    "lcp.M",
                                    "pivot.before",
                                    "pivot.value",
                                    "newton.zone",
                                    "guess.p",
                                    "stress.max_shear",
                                    "maxima.von_mises",
                                    "sweep.status",
                                    "lcp.z",
                                    "friction.r",
                                    "patch.from",
                                    "friction_power",
                                    "derivative.tangential_load",
                                    "derivative.q",
                                    "derivative.value",
                                    "derivative.approach.gap",
                                    "tolerance.max_pressure",
                                    "curve.derivative.tangential_load:mu",
                                    "curve.tolerance.tangential_load",
                                    "history.derivative.tangential_load:load",
                                    "history.tolerance.approach",
                                    "sweep.derivative.max_pressure:mu",
                                    "nothing",
                                    ""};

static const char *const words[] = {"status",           "formulation", "solver", "lcp-form",
                                    "task.solver",      "normal_load", "carter", "task.iterations",
                                    "error.half_width", "hertz_load",  ""};

enum {
    SETTINGS = sizeof settings / sizeof settings[0],
    NAMES = sizeof names / sizeof names[0],
    WORDS = sizeof words / sizeof words[0],
    CALLS_MAX = 40
};

/* What has derivatives, and what has none. */
static const char *const of[] = {"all",      "tangential_load:mu,max_pressure:mu",
                                 "all:load", "max_pressure,tangential_load:load",
                                 "all:zone", "residual",
                                 ",",        ""};
static const char *const uncertain[] = {"mu=0.02",           "radius=1%,load=2%", "mu=-1", "zone=1",
                                        "mu=1%,mu=1%",       "load=1e300",        "",      "=",
                                        "creep-ratio=10%,mu"};

/* Every entry of the array can be read. */
static void look_at(rb_api *a, const char *name)
{
    int rows = -1, columns = -1;
    const double *x = rb_api_array(a, name, &rows, &columns);
    int without_value = 0;
    fuzz_require(!x || (rows >= 0 && columns >= 0), "an array has a size");
    for (int k = 0; x && k < rows * columns; k++)
        without_value += isnan(x[k]) != 0;
    fuzz_require(!x || without_value <= rows * columns, "an array has its entries");
}

static void call(rb_api *a, rb_api *other, fuzz_bytes *b)
{
    static const int zones[12] = {0, 1, 2, 3, 1, 1, 2, 0, 0, 5, -1, 1};
    const double M[] = {2.0, 1.0, 1.0, 3.0}, q[] = {fuzz_number(b), -1.0};
    const double points[] = {0.0, fuzz_number(b), 0.1, 0.2}, mu[] = {0.3};
    char text[40];
    rb_api *cases[] = {other};
    switch (fuzz_choice(b, 24)) {
    case 0:
        rb_api_resolve(a);
        break;
    case 1:
    case 2:
        rb_api_solve(a);
        break;
    case 3:
        rb_api_pivots(a);
        break;
    case 4:
        rb_api_newton(a);
        break;
    case 5:
        rb_api_guess(a, fuzz_choice(b, 13), zones);
        break;
    case 6:
        rb_api_stress(a, fuzz_choice(b, 5), fuzz_choice(b, 5), fuzz_number(b));
        break;
    case 7:
        rb_api_stress_at(a, fuzz_choice(b, 3), points);
        break;
    case 8:
        rb_api_stress_maxima(a, 0.0);
        break;
    case 9:
        rb_api_curve(a, "creep-ratio", 0.0, 1.0, fuzz_choice(b, 4), NULL, NULL);
        break;
    case 10:
        rb_api_curve(a, "creep", 0.0, fuzz_number(b), 2, NULL, NULL);
        break;
    case 11:
        rb_api_lcp(a, 2, M, q, fuzz_choice(b, 2) ? "lemke" : "newton", 0);
        break;
    case 12:
        rb_api_friction(a, 2, 1, M, q, mu, fuzz_choice(b, 2) ? "auto" : "none", 1e-8, 9);
        break;
    case 13:
        rb_api_stop(a);
        break;
    case 14:
        rb_api_sweep(a, fuzz_choice(b, 2), cases, NULL, NULL, 1);
        break;
    case 15:
        rb_api_variable(a, fuzz_byte(b) - 3, text, (int)sizeof text);
        break;
    case 16:
        rb_api_value(a, settings[fuzz_choice(b, SETTINGS)][0], text, 3);
        break;
    case 17:
        rb_api_number(a, words[fuzz_choice(b, WORDS)]);
        break;
    case 18:
        rb_api_word(a, words[fuzz_choice(b, WORDS)]);
        break;
    case 19:
        look_at(a, names[fuzz_choice(b, NAMES)]);
        break;
    case 23: { /* derivatives */
        const char *const results = of[fuzz_choice(b, sizeof of / sizeof *of)],
                          *inputs = uncertain[fuzz_choice(b, sizeof uncertain / sizeof *uncertain)];
        switch (fuzz_choice(b, 7)) {
        case 0:
            rb_api_derivatives(a);
            break;
        case 1:
            rb_api_tolerances(a, inputs);
            break;
        case 2:
            rb_api_curve(a, "creep-ratio", 0.0, 1.0, fuzz_choice(b, 4) - 1, results,
                         fuzz_choice(b, 2) ? inputs : NULL);
            break;
        case 3:
            rb_api_curve(a, "creep", fuzz_number(b), 1e-3, 2, NULL, inputs);
            break;
        case 4:
            rb_api_step_derivatives(a, results, NULL);
            break;
        case 5:
            rb_api_sweep(a, fuzz_choice(b, 2), cases, results, "mu=1%", 1);
            break;
        default:
            rb_api_derivative(a, fuzz_choice(b, 2) ? "curve" : "history", fuzz_byte(b) - 3, "name",
                              text, (int)sizeof text);
            rb_api_input(a, fuzz_byte(b) - 3, "name", text, 3);
        }
        break;
    }
    default: {
        const char *const *s = settings[fuzz_choice(b, SETTINGS)];
        char kept[64];
        if (rb_api_set(a, s[0], s[1]) < 0 && b->at < b->end && *b->at % 4 &&
            rb_api_value(a, s[0], kept, sizeof kept)) /* or nothing can be solved */
            rb_api_set(a, s[0], kept);
    }
    }
    fuzz_require(rb_api_status(a) == RB_OK || rb_api_message(a)[0], "a refusal says why");
}

void fuzz_handle(const uint8_t *data, size_t size)
{
    static const char *const purposes[] = {"solve", "curve", "stress", "sweep"};
    fuzz_bytes b = {data, data + size};
    rb_api *a = rb_api_create_for(purposes[fuzz_choice(&b, 4)]);
    rb_api *other = rb_api_create_for("sweep");
    fuzz_require(a && other, "there is memory");
    for (int k = 0; k < 3; k++) /* fewest elements */
        rb_api_set(k < 1 ? other : a, settings[k][0], settings[k][1]);
    for (int k = 0; k < CALLS_MAX && b.at < b.end; k++)
        call(a, other, &b);
    for (int k = 0; k < NAMES; k++)
        look_at(a, names[k]);
    rb_api_free(other);
    rb_api_free(a);
}
