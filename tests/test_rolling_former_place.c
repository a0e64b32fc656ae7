/* Displacements where particles were a step ago, against those of whole elements and of
 * longer meshes. */
#include "check.h"
#include "study/internal.h"

#include <stdlib.h>
#include <string.h>

enum { N = 12, LARGE = RB_ROLLING_LARGE };

static rb_rolling_case plane(int elastic_b, int elements)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.a.poisson = 0.3;
    rc.elastic_b = elastic_b;
    rc.formulation = RB_TRANSIENT;
    rc.contact_elements = elements;
    return rc;
}

typedef struct {
    rb_rolling_mesh mesh;
    rb_rolling_bodies bodies;
    double *p, *q, *w; /* n, n, 2m: made up, and what they displace */
} pressed;

static pressed press(const rb_rolling_case *rc, double from, double to)
{
    pressed d;
    rb_message why = {""};
    CHECK_STATUS(rb_rolling_mesh_uniform(rc, NULL, from, to, &d.mesh, &why), RB_OK);
    CHECK_STATUS(rb_rolling_bodies_create(rc, NULL, &d.mesh, &d.bodies, &why), RB_OK);
    const int n = d.mesh.n;
    d.p = rb_alloc((size_t)n, 2);
    d.q = d.p + n;
    assert_non_null(d.p);
    d.w = rb_alloc(2 * (size_t)n + 2, 1);
    assert_non_null(d.w);
    for (int i = 0; i < n; i++) {
        d.p[i] = i % 3 == 1 ? 0.0 : 3.0 + sin(5.0 * i);
        d.q[i] = i % 4 == 2 ? 0.0 : cos(3.0 * i);
    }
    CHECK_STATUS(rb_rolling_displacement(&d.bodies, d.p, d.q, d.w), RB_OK);
    return d;
}

static void release(pressed *d)
{
    rb_rolling_mesh_free(&d->mesh);
    rb_rolling_bodies_free(&d->bodies);
    free(d->p);
    free(d->w);
}

static double largest(const pressed *d)
{
    return rb_norm_inf(2 * (size_t)d->mesh.n + 2, d->w);
}

/* A step of k elements finds what stands k midpoints upstream; half elements lie between,
 * where the displacement is smooth. */
TEST(whole_elements_ahead_are_their_midpoints)
{
    for (int k = 0; k < 4; k++) { /* with body B, with an interface */
        rb_rolling_case rc = plane(k % 2, N);
        rc.interlayer_tangential = k / 2 ? 1e-4 : 0.0;
        pressed d = press(&rc, -3.0, 3.0);
        double w_T[N];
        for (int steps = 1; steps <= 3; steps++) {
            rb_rolling_former_place ahead;
            CHECK_STATUS(
                rb_rolling_former_place_create(&rc, &d.bodies, steps * 6.0 / N, &ahead),
                RB_OK);
            rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
            for (int i = 0; i + steps <= N; i++)
                CHECK_ABS(w_T[i], d.w[N + 1 + i + steps], 1e-12 * largest(&d),
                          "case %d: %d elements ahead of %d", k, steps, i);
            rb_rolling_former_place_free(&ahead);
        }
        release(&d);
    }
}

/* A longer mesh has midpoints where the shorter one has none; half a step lies on the
 * line between its neighbours as far as the bodies differ from half-planes. */
TEST(places_beyond_the_mesh_are_those_of_a_longer_one)
{
    const rb_rolling_case rc = plane(1, N), longer = plane(1, N + 4);
    pressed d = press(&rc, -3.0, 3.0), more = press(&longer, -3.5, 4.5);
    rb_rolling_former_place ahead;
    double w_T[N], W_T[2 * 2 * N], outside[2] = {0.0, 0.0};
    memset(more.p, 0, sizeof(double) * (N + 4));
    memset(more.q, 0, sizeof(double) * (N + 4));
    memcpy(more.p + 1, d.p, sizeof(double) * N);
    memcpy(more.q + 1, d.q, sizeof(double) * N);
    CHECK_STATUS(rb_rolling_displacement(&more.bodies, more.p, more.q, more.w), RB_OK);
    CHECK_STATUS(rb_rolling_former_place_create(&rc, &d.bodies, 1.5, &ahead), RB_OK);
    rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
    for (int i = 0; i < N; i++)
        CHECK_ABS(w_T[i], more.w[N + 5 + i + 4], 1e-12 * largest(&d), "element %d", i);
    rb_rolling_former_place_free(&ahead);

    memset(W_T, 0, sizeof W_T);
    CHECK_STATUS(rb_rolling_displacement_outside(&rc, &d.bodies, W_T), RB_OK);
    for (int j = 0; j < N; j++)
        for (int k = 0; k < 2; k++)
            outside[k] += W_T[2 * j + k] * d.p[j] + W_T[2 * (N + j) + k] * d.q[j];
    CHECK_ABS(outside[0], more.w[N + 5], 1e-12 * largest(&d), "downstream");
    CHECK_ABS(outside[1], more.w[N + 5 + 1 + N + 1], 1e-12 * largest(&d), "upstream");
    release(&more);
    release(&d);
}

/* A wheel differs from its half-plane by what is smooth along the surface. */
TEST(a_wheel_is_nearly_on_the_line_of_its_midpoints)
{
    rb_rolling_case rc = plane(0, N);
    rc.a.support = RB_BEM_HUB;
    rc.outer_elements = 60;
    pressed d = press(&rc, -0.6, 0.6);
    rb_rolling_former_place ahead;
    double w_T[N], W_T[2 * 2 * N], outside[2] = {0.0, 0.0};
    const double h = d.bodies.f.h[N / 2];
    CHECK_STATUS(rb_rolling_former_place_create(&rc, &d.bodies, h, &ahead), RB_OK);
    rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
    for (int i = 0; i < N; i++)
        CHECK_ABS(w_T[i], d.w[N + 2 + i], 1e-5 * largest(&d), "element %d", i);
    rb_rolling_former_place_free(&ahead);
    memset(W_T, 0, sizeof W_T);
    CHECK_STATUS(rb_rolling_displacement_outside(&rc, &d.bodies, W_T), RB_OK);
    for (int j = 0; j < N; j++)
        for (int k = 0; k < 2; k++)
            outside[k] += W_T[2 * j + k] * d.p[j] + W_T[2 * (N + j) + k] * d.q[j];
    /* beyond the tractions the displacement falls on along a smooth curve */
    rc.contact_elements = N + 4;
    pressed more = press(&rc, -0.7, 0.9);
    memset(more.p, 0, sizeof(double) * (N + 4));
    memset(more.q, 0, sizeof(double) * (N + 4));
    memcpy(more.p + 1, d.p, sizeof(double) * N);
    memcpy(more.q + 1, d.q, sizeof(double) * N);
    CHECK_STATUS(rb_rolling_displacement(&more.bodies, more.p, more.q, more.w), RB_OK);
    CHECK_ABS(outside[0], more.w[N + 5], 2e-2 * largest(&d), "downstream");
    CHECK_ABS(outside[1], more.w[N + 5 + N + 2], 2e-2 * largest(&d), "upstream");
    release(&more);
    release(&d);
}

/* Without a matrix, by distance alone; the interface acts under each point, linear
 * between midpoints. */
TEST(large_contacts_look_ahead_alike)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = plane(1, LARGE);
        const double h = 6.0 / LARGE;
        rc.interlayer_tangential = k ? 1e-4 : 0.0;
        pressed d = press(&rc, -3.0, 3.0);
        double *w_T = rb_alloc(LARGE, 2), *half = w_T + LARGE;
        rb_rolling_former_place ahead;
        assert_non_null(w_T);
        assert_null(d.bodies.F);
        CHECK_STATUS(rb_rolling_former_place_create(&rc, &d.bodies, 2.0 * h, &ahead),
                     RB_OK);
        rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
        rb_rolling_former_place_free(&ahead);
        for (int i = 0; i + 2 <= LARGE; i += 50)
            CHECK_ABS(w_T[i], d.w[LARGE + 1 + i + 2], 1e-11 * largest(&d), "element %d",
                      i);
        /* what an interface adds half an element ahead */
        CHECK_STATUS(rb_rolling_former_place_create(&rc, &d.bodies, 0.5 * h, &ahead),
                     RB_OK);
        rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
        rc.interlayer_tangential = 0.0;
        pressed without = press(&rc, -3.0, 3.0);
        rb_rolling_former_place_apply(&ahead, &without.bodies, d.p, d.q, half);
        for (int i = 0; i < LARGE; i += 7) {
            const double next = i + 1 < LARGE ? d.q[i + 1] : 0.0;
            CHECK_ABS(w_T[i] - half[i], k ? 1e-4 * 0.5 * (d.q[i] + next) : 0.0, 1e-13,
                      "interface at %d", i);
        }
        const int last = LARGE - 1;
        CHECK_ABS(w_T[last] - half[last], k ? 0.5e-4 * d.q[last] : 0.0, 1e-13, "last");
        rb_rolling_former_place_free(&ahead);
        release(&without);
        free(w_T);
        release(&d);
    }
}

TEST(memory_for_what_is_ahead_may_be_refused)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = plane(0, k ? LARGE : N);
        pressed d = press(&rc, -1.0, 1.0);
        rb_rolling_former_place ahead;
        assert_int_equal(d.bodies.F == NULL, k);
        alloc_fail_after(0);
        CHECK_STATUS(rb_rolling_former_place_create(&rc, &d.bodies, 0.01, &ahead),
                     RB_ENOMEM);
        alloc_succeed();
        assert_true(!ahead.W_T && !ahead.response);
        release(&d);
    }
}

/* Half-way through a half-plane without a matrix: one element ahead is the next midpoint.
 */
TEST(large_contacts_know_what_is_ahead)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.a.young = 209920.0;
    rc.a.poisson = 0.3;
    rc.gap = RB_GAP_PARABOLA;
    rc.load = 100.0;
    rc.contact_elements = RB_ROLLING_LARGE;
    rb_rolling_mesh mesh;
    rb_rolling_bodies bodies;
    rb_rolling_former_place ahead;
    const int n = RB_ROLLING_LARGE, m = n + 1;

    CHECK_STATUS(rb_rolling_mesh_uniform(&rc, NULL, -0.2, 0.2, &mesh, NULL), RB_OK);
    CHECK_STATUS(rb_rolling_bodies_create(&rc, NULL, &mesh, &bodies, NULL), RB_OK);
    assert_null(bodies.F);
    CHECK_STATUS(rb_rolling_former_place_create(&rc, &bodies, bodies.f.h[0], &ahead),
                 RB_OK);
    double *r = calloc((size_t)(2 * n), sizeof *r),
           *w = calloc((size_t)(2 * m), sizeof *w), *w_T = calloc((size_t)n, sizeof *w_T);
    for (int i = n / 3; i < 2 * n / 3; i++) {
        r[i] = 1.0 + 0.3 * sin(0.01 * i);
        r[n + i] = cos(0.02 * i);
    }
    CHECK_STATUS(rb_rolling_displacement(&bodies, r, r + n, w), RB_OK);
    rb_rolling_former_place_apply(&ahead, &bodies, r, r + n, w_T);
    for (int i = 0; i < n; i++)
        CHECK_ABS(w_T[i], w[m + i + 1], 1e-11 * fabs(w[m + n / 2]), "element %d", i);
    free(r);
    free(w);
    free(w_T);
    rb_rolling_former_place_free(&ahead);
    rb_rolling_bodies_free(&bodies);
    rb_rolling_mesh_free(&mesh);
}

/* What a step of 1.3 elements brings, with a matrix and by transforms. */
TEST(an_interface_moves_with_the_steps)
{
    double *w[2];
    const int n = 1501;
    double *p = rb_alloc((size_t)n, 2), *q = p + n;

    for (int i = 0; i < n - 1; i++)
        q[i] = 100.0 * rand() / RAND_MAX;
    for (int large = 0; large < 2; large++) {
        rb_rolling_case rc = plane(0, n);
        rc.a.young = 210000.0;
        rc.a.poisson = 0.28;
        rc.a.radius = 500.0;
        rb_rolling_mesh mesh;
        rb_rolling_bodies bodies;
        rb_rolling_former_place ahead;
        rc.contact.solver = large ? RB_SOLVER_NEWTON : RB_SOLVER_LEMKE;
        rc.interlayer_tangential = 1e-2;
        CHECK_STATUS(rb_rolling_mesh_uniform(&rc, NULL, -1.3, 1.3, &mesh, NULL), RB_OK);
        CHECK_STATUS(rb_rolling_bodies_create(&rc, NULL, &mesh, &bodies, NULL), RB_OK);
        assert_int_equal(bodies.F == NULL, large);
        CHECK_STATUS(rb_rolling_former_place_create(&rc, &bodies, 1.3 * 2.6 / n, &ahead),
                     RB_OK);
        w[large] = rb_alloc((size_t)n, 1);
        rb_rolling_former_place_apply(&ahead, &bodies, p, q, w[large]);
        rb_rolling_former_place_free(&ahead);
        rb_rolling_bodies_free(&bodies);
        rb_rolling_mesh_free(&mesh);
    }
    for (int i = 0; i < n; i++)
        CHECK_ABS(w[0][i], w[1][i], 1e-9, "element %d", i);
    free(w[0]);
    free(w[1]);
    free(p);
}

RUN_TESTS(NULL, NULL)
