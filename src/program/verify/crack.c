/* Cracks: at an edge in tension, closed in the full plane under a shear that goes back
 * and forth, and filled with a fluid. */
#include "program/verify/internal.h"

#include "analysis/crack/crack_case.h"

#include <math.h>

static const double PI = 3.14159265358979323846;
enum { ELEMENTS = 40 };

/* A crack of length 1 with its mouth in the surface, or of that length in the full plane. */
static rb_crack *crack_of(rb_verify *v, double angle, int full_plane)
{
    static rb_message why;
    const rb_crack_shape shape = {.path = rb_crack_straight(0.0, 0.0, 1.0, angle),
                                  .full_plane = full_plane,
                                  .elements = ELEMENTS,
                                  .friction = 0.3,
                                  .shear = 1.0,
                                  .poisson = 0.3};
    rb_crack *crack = NULL;
    why.text[0] = '\0';
    rb_verify_note(v, rb_crack_create(&shape, &crack, &why), &why);
    return crack;
}

/* Koiter's 1.1215 at 90 degrees; the others by collocation to six digits, at 45 degrees
 * 0.705 and 0.364 in the handbooks. */
static void edge_crack(rb_verify *v, double angle, double K_I, double K_II)
{
    rb_crack *crack = crack_of(v, angle, 0);
    const double x = 0.0;
    const rb_crack_passage tension = {.steps = 1, .x = &x, .passes = 1, .tension = 1.0};
    rb_crack_history h = {0};
    const rb_status s = crack ? rb_crack_pass(crack, &tension, &h, NULL) : RB_ENOMEM;
    rb_verify_absolute(v, s == RB_OK ? h.K_I[0] / sqrt(PI) : NAN, K_I, 3e-4,
                       "edge crack in tension, %g degrees: K_I", angle);
    if (K_II > 0.0)
        rb_verify_absolute(v, s == RB_OK ? h.K_II[0] / sqrt(PI) : NAN, K_II, 3e-4,
                           "edge crack in tension, %g degrees: K_II", angle);
    rb_crack_history_free(&h);
    rb_crack_free(crack);
}

/* Paris's law from 1 to 2 mm under 0 to 100 MPa, C = 1e-12, m = 3, without a contact:
 * 2 (1 - 2^-1/2)/(C (1.1215 S sqrt(pi))^3). */
static void paris(rb_verify *v)
{
    static const char *const words[][2] = {
        {"support", "halfplane"}, {"unloaded", "yes"},        {"mu", "0"},
        {"crack-angle", "90"},    {"crack-length", "1mm"},    {"grow-to", "2mm"},
        {"grow-steps", "20"},     {"remote-stress", "0,100"}, {"paris", "1e-12,3"}};
    static rb_message why;
    rb_case *c = rb_case_create(RB_CASE_CRACK);
    rb_case_crack_result r = {.notes = 0};
    rb_status s = c ? RB_OK : RB_ENOMEM;

    why.text[0] = '\0';
    if (c)
        rb_case_crack_set(c); /* which lets it take the options of a crack */
    for (size_t k = 0; k < sizeof words / sizeof *words && s == RB_OK; k++)
        s = rb_case_set(c, words[k][0], words[k][1], RB_GIVEN_ARGUMENT, &why);
    if (s == RB_OK)
        s = rb_case_resolve(c, &why);
    if (s == RB_OK)
        s = rb_case_crack_solve(rb_case_resolved(c), rb_case_crack_of(c), NULL, &r, &why);
    rb_verify_note(v, s, &why);
    rb_verify_relative(v, s == RB_OK ? r.growth.cycles[r.growth.n - 1] : NAN, 74579.02, 1e-3,
                       "stress that cycles: passes from 1 to 2 mm");
    rb_case_crack_free(&r);
    rb_case_free(c);
}

/* Unit pressure, friction 0.3, shear 0.8, then -0.5: it slips back by 0.5 - 0.3 only. */
static void closed_crack(rb_verify *v)
{
    static const double tau[] = {0.8, -0.5};
    rb_crack *crack = crack_of(v, 0.0, 1);
    rb_crack_state state = {0};
    double hat[ELEMENTS], T[2 * ELEMENTS];
    rb_status s = crack ? rb_crack_state_alloc(crack, &state) : RB_ENOMEM;
    for (int k = 0; k < 2 && s == RB_OK; k++) {
        rb_crack_places(crack, NULL, NULL, hat, NULL, NULL);
        for (int j = 0; j < state.n; j++) {
            T[j] = -hat[j];
            T[state.n + j] = tau[k] * hat[j];
        }
        s = rb_crack_step(crack, T, RB_CRACK_DRY, 0.0, 1.0, &state, NULL);
    }
    rb_verify_absolute(v, s == RB_OK ? state.K_II / sqrt(0.5 * PI) : NAN, -0.2, 1e-10,
                       "closed crack, shear back and forth: K_II");
    /* as much fluid as opens it under that pressure */
    const double volume = 0.02, kappa = 3.0 - 4.0 * 0.3;
    state.volume = volume;
    for (int j = 0; j < state.n && s == RB_OK; j++)
        T[state.n + j] = 0.0;
    if (s == RB_OK)
        s = rb_crack_step(crack, T, RB_CRACK_TRAPPED, 0.0, 1.0, &state, NULL);
    rb_verify_relative(v, s == RB_OK ? state.fluid_pressure : NAN,
                       1.0 + 16.0 * volume / (PI * (kappa + 1.0)), 2e-3,
                       "closed crack, trapped fluid: its pressure");
    rb_crack_state_free(&state);
    rb_crack_free(crack);
}

void rb_verify_crack(rb_verify *v)
{
    edge_crack(v, 90.0, 1.1215222552, 0.0);
    edge_crack(v, 60.0, 0.920100, 0.305800);
    edge_crack(v, 45.0, 0.704910, 0.364491);
    edge_crack(v, 30.0, 0.462431, 0.336140);
    paris(v);
    closed_crack(v);
}
