/* A case as a contact problem (theory.md 4.2): operator, weights, controls, scales. */
#include "cases.h"
#include "check.h"
#include "posed.h"

#include <cblas.h>
#include <float.h>

/* Tangential displacement of midpoint i, the one upstream included, under a unit traction
 * j. */
static double w_T(const posed *d, int i, int j)
{
    return d->bodies.F[(size_t)j * 2 * M + M + (size_t)i];
}

static double S(const posed *d, int i, int j)
{
    return d->K.S[(size_t)j * N + (size_t)i];
}

/* ---- The operator ------------------------------------------------------------------ */

TEST(steady_slip_is_the_difference_upstream)
{
    const rb_rolling_case steady = posed_plane(RB_STEADY), rest = posed_plane(RB_STATIC);
    posed rolls = pose(&steady, NULL), stands = pose(&rest, NULL);
    assert_int_equal(rolls.p.differences, 1);
    assert_int_equal(stands.p.differences, 0);
    for (int j = 0; j < 2 * N; j++)
        for (int i = 0; i < N; i++) {
            CHECK_ABS(S(&rolls, i, j), w_T(&rolls, i, j) - w_T(&rolls, i + 1, j), 0.0,
                      "steady %d %d", i, j);
            CHECK_ABS(S(&stands, i, j), w_T(&stands, i, j), 0.0, "static %d %d", i, j);
        }
    for (int i = 0; i < N; i++) {
        CHECK_REL(rolls.p.e_T[i], 0.2, 1e-12, "one element");
        CHECK_ABS(stands.p.e_T[i], 1.0, 0.0, "a shift");
    }
    release(&rolls);
    release(&stands);
}

/* ((1-t)/4, (3+3t)/4, -(5+3t)/4, (1+t)/4); what the interface has under its own element
 * takes t = 1. */
TEST(the_second_order_operator_has_four_points)
{
    const double t = 0.0740956,
                 a[4] = {(1 - t) / 4, (3 + 3 * t) / 4, -(5 + 3 * t) / 4, (1 + t) / 4};
    rb_rolling_case rc = with(posed_plane(RB_STEADY), "slip-operator second");
    posed d = pose(&rc, NULL);
    for (int j = 0; j < 2 * N; j++)
        for (int i = 1; i + 1 < N; i++)
            CHECK_ABS(S(&d, i, j),
                      a[0] * w_T(&d, i - 1, j) + a[1] * w_T(&d, i, j) + a[2] * w_T(&d, i + 1, j) +
                          a[3] * w_T(&d, i + 2, j),
                      1e-12 * fabs(w_T(&d, 0, N)), "%d %d", i, j);
    /* a half-plane answers to distances alone: rows at the ends are moved others */
    for (int j = 1; j < N; j++)
        CHECK_ABS(S(&d, 0, N + j - 1), S(&d, 1, N + j), 1e-12 * fabs(w_T(&d, 0, N)),
                  "first row, %d", j);
    for (int j = 1; j < N; j++)
        CHECK_ABS(S(&d, N - 1, N + j), S(&d, N - 2, N + j - 1), 1e-12 * fabs(w_T(&d, 0, N)),
                  "last row, %d", j);

    static const double local[4] = {0.0, 1.5, -2.0, 0.5};
    rc.interlayer_tangential = 1e-5;
    posed with = pose(&rc, NULL);
    for (int i = 1; i + 1 < N; i++) /* the outermost elements are open */
        for (int j = 0; j < N; j++) {
            const int k = j - i + 1;
            CHECK_ABS(S(&with, i, N + j) - S(&d, i, N + j), k >= 0 && k < 4 ? 1e-5 * local[k] : 0.0,
                      1e-16, "interface %d %d", i, j);
            CHECK_ABS(S(&with, i, j), S(&d, i, j), 0.0, "of pressures %d %d", i, j);
        }
    release(&with);
    release(&d);
}

/* What a wheel has over the half-plane of its material is continued on a line, over the
 * two points outside of which the second-order operator asks. */
TEST(displacement_outside_continues_the_wheel)
{
    const double t = 0.0740956, first = (1 - t) / 4, last = (1 + t) / 4,
                 middle[2] = {(3 + 3 * t) / 4, -(5 + 3 * t) / 4};
    rb_rolling_case rc = with(posed_plane(RB_STEADY), "slip-operator second");
    posed flat = pose(&rc, NULL);
    rc.a.support = RB_BEM_ARC;
    rc.a.radius = 5000.0; /* arcs are as long as their chords */
    rc.outer_elements = 30;
    posed wheel = pose(&rc, NULL);
    for (int j = 0; j < 2 * N; j++) {
        double over[M], before = S(&wheel, 0, j) - S(&flat, 0, j),
                        beyond = S(&wheel, N - 1, j) - S(&flat, N - 1, j);
        for (int i = 0; i < M; i++)
            over[i] = w_T(&wheel, i, j) - w_T(&flat, i, j);
        before -= middle[0] * over[0] + middle[1] * over[1] + last * over[2];
        beyond -= first * over[N - 2] + middle[0] * over[N - 1] + middle[1] * over[N];
        const double small = 1e-8 * fabs(w_T(&flat, 0, N));
        CHECK_ABS(before, first * (2.0 * over[0] - over[1]), small, "before, %d", j);
        CHECK_ABS(beyond, last * (2.0 * over[N] - over[N - 1]), small, "beyond, %d", j);
    }
    release(&flat);
    release(&wheel);
}

/* Displacements of the elements under a unit traction on element `of`, without a matrix. */
static void answer_to(posed *d, int of, double *answer)
{
    const int n = d->p.n;
    double *r = calloc(4 * (size_t)n, sizeof *r), *w = r + 2 * n;
    assert_non_null(r);
    r[of] = 1.0;
    rb_contact_operator_add(d->p.op, r, r + n, w, w + n);
    memcpy(answer, w, 2 * (size_t)n * sizeof *w);
    free(r);
}

/* Half-planes answer to distances alone, with products as with matrices: the answer to a
 * traction moves with it, from the first element to the last one. */
TEST(products_move_with_the_tractions)
{
    enum { n = RB_ROLLING_LARGE };
    static double here[2 * n], there[2 * n];
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = posed_plane(RB_STEADY);
        set(&rc, "contact-elements %d slip-operator %s", n, k ? "second" : "upstream");
        posed d = pose(&rc, NULL);
        assert_null(d.K.S);
        for (int side = 0; side < 2; side++)
            for (int left = 0; left < n; left += n - 2) {
                answer_to(&d, side * n + left, here);
                answer_to(&d, side * n + left + 1, there);
                const double most = fabs(here[cblas_idamax(2 * n, here, 1)]);
                for (int i = 0; i < 2 * n; i++)
                    if (i != n - 1 && i != 2 * n - 1)
                        CHECK_ABS(there[i + 1], here[i], 1e-12 * most, "answer %d to %d", i, left);
            }
        release(&d);
    }
}

/* ---- What moves the surfaces ------------------------------------------------------- */

/* u_i = recall_0 u_i+1 + recall_1 u_i+2 + own |plastic_i|: steadily by the order of the
 * slip, in a step of its own. */
TEST(what_yields_follows_the_material)
{
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = posed_plane(k == 2 ? RB_TRANSIENT : RB_STEADY);
        static const double want[3][3] = {
            {1.0, 0.0, 1.0}, {4.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0}, {0.0, 0.0, 1.0}};
        set(&rc, "slip-operator %s yield-stress 50", k == 1 ? "second" : "upstream");
        posed d = pose(&rc, NULL);
        CHECK_ABS(d.p.recall[0], want[k][0], 1e-15, "case %d", k);
        CHECK_ABS(d.p.recall[1], want[k][1], 1e-15, "case %d", k);
        CHECK_ABS(d.p.own, want[k][2], 1e-15, "case %d", k);
        CHECK_ABS(d.p.hardening, 0.0, 0.0, "case %d", k);
        release(&d);
    }
}

/* An element softens by less than its slip sets free: the limit is 1/(own S_ii). */
TEST(softening_has_a_limit)
{
    rb_rolling_case rc = with(posed_plane(RB_STEADY), "yield-stress 50");
    posed d = pose(&rc, NULL);
    double most = 0.0;
    for (int i = 0; i < N; i++)
        most = fmax(most, S(&d, i, N + i));
    release(&d);
    for (int k = 0; k < 2; k++) {
        rc.hardening = -(k ? 1.0001 : 0.9999) / most;
        if (k == 0) {
            d = pose(&rc, NULL);
            release(&d);
            continue;
        }
        d = (posed){.rc = rc};
        CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -1.0, 0.8, &d.mesh, &message));
        CHECK_OK(rb_rolling_bodies_create(&rc, NULL, &d.mesh, &d.bodies, &message));
        CHECK_SAYS(rb_rolling_problem_create(&rc, &d.mesh, &d.bodies, NULL, &d.p, &message),
                   RB_EINVAL, "has no unique solution");
        release(&d);
    }
}

/* ---- Forces ------------------------------------------------------------------------ */

/* Along the surface of the wheel normals turn by x/R. */
TEST(normals_of_the_surface_turn_with_it)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = posed_plane(RB_STATIC);
        set(&rc, "support arc outer-elements 30 radius 2 normals %s", k ? "surface" : "obstacle");
        posed d = pose(&rc, NULL);
        for (int i = 0; i < N; i++) {
            const double x = d.bodies.f.x[i], h = d.bodies.f.h[i];
            const double sine = k ? x / 2.0 : 0.0, cosine = sqrt(1.0 - sine * sine);
            CHECK_REL(d.p.load_N[i], h * cosine, 1e-14, "load of p, %d", i);
            CHECK_ABS(d.p.load_T[i], h * sine, 1e-15, "load of q, %d", i);
            CHECK_ABS(d.p.force_N[i], -h * sine, 1e-15, "force of p, %d", i);
            CHECK_REL(d.p.force_T[i], h * cosine, 1e-14, "force of q, %d", i);
            CHECK_ABS(d.p.moment_N[i], x * h * cosine, 1e-14, "moment of p, %d", i);
            CHECK_ABS(d.p.moment_T[i], x * h * sine, 1e-14, "moment of q, %d", i);
        }
        release(&d);
    }
}

/* ---- Controls ---------------------------------------------------------------------- */

/* ---- Scales ------------------------------------------------------------------------ */

TEST(scales_make_the_diagonals_one)
{
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = posed_plane(RB_STEADY);
        rc.mu = k == 0 ? 0.3 : k == 1 ? 0.0 : 1e-6;
        posed d = pose(&rc, NULL);
        const rb_contact_response unit = rb_contact_operator_response(d.p.op);
        const double p0 = rb_rolling_derive(&rc).stress;
        CHECK_REL(d.p.stress, p0, 1e-15, "Hertz's p0");
        CHECK_REL(d.p.gap_length, p0 * unit.gap, 1e-15, "gaps");
        CHECK_REL(d.p.slip_length,
                  p0 * fmax((k == 0   ? 0.3
                             : k == 1 ? 1.0
                                      : 1e-6) *
                                unit.slip,
                            unit.coupled_slip),
                  1e-15, "slips");
        CHECK_ABS(d.p.rounding, 64.0 * DBL_EPSILON * unit.reach, 1e-30, "rounding");
        CHECK_ABS(unit.reach, 0.0, 0.0, "of matrices");
        release(&d);
    }
}

RUN_TESTS(NULL, NULL)
