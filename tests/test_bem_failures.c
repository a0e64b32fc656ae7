/* Boundary elements without memory, and with bad input: every kind of body, every
 * refusal. */
#include "bem_shapes.h"

static const rb_bem_material steel = {82000.0, 0.28}, rubber = {1.0, 0.45};

/* Equal elements in the middle, which a disc of this radius takes for equal arcs. */
enum { N = 6, M = N + 1 };
static const double RADIUS = 1e4;
static double ends[N + 2];

static int equal_ends(void **state)
{
    for (int i = 0; i < N + 2; i++)
        ends[i] = 0.1 * (i - 0.5 * N);
    return 0;
}

/* ---- Kinds of flexibilities -------------------------------------------------------- */

enum { FLAT, SOFT, REMEMBERS, LAYER, DENSE, DISC, DISC_TURNED, KINDS };

static rb_status make(int kind, rb_bem_flexibility *f)
{
    static const double ratio[] = {2.0, NAN}, length[] = {0.3, NAN}; /* one term is told */
    rb_bem_surface body = {.material = kind == FLAT ? steel : rubber, .datum = 7.0};
    const rb_bem_disc disc = {RADIUS, steel};

    if (kind >= DISC)
        return rb_bem_flexibility_disc(
            N, ends, &disc, kind == DISC ? RB_BEM_NORMALS_SURFACE : RB_BEM_NORMALS_OBSTACLE, f,
            NULL);
    if (kind == REMEMBERS) {
        body.terms = 1;
        body.ratio = ratio;
        body.length = length;
    }
    if (kind == LAYER)
        body.thickness = 0.4;
    return kind == DENSE ? rb_bem_flexibility_surface(N, ends, &body, f, NULL)
                         : rb_bem_flexibility_toeplitz(N, ends, &body, f, NULL);
}

/* Whatever two bodies are: F_A + F_B, whose coupling changes its sign; products are those
 * of the matrix, and so is what is stored. */
static void check_pair(int kind_a, int kind_b)
{
    rb_bem_flexibility a, b, f;
    double A[4 * M * N], B[4 * M * N], F[4 * M * N], r[2 * N], w[2 * M];
    const double most = 1e-3 + 1e-4 * (kind_a == FLAT && kind_b == FLAT);

    CHECK_OK(make(kind_a, &a));
    CHECK_OK(make(kind_b, &b));
    CHECK_OK(rb_bem_flexibility_matrix(&a, A, 2 * M));
    CHECK_OK(rb_bem_flexibility_matrix(&b, B, 2 * M));
    a.w0[1] = b.w0[1] = 3.0;
    a.w0[M + 1] = b.w0[M + 1] = 4.0;
    CHECK_OK(rb_bem_flexibility_pair(&a, &b, &f, NULL));
    CHECK_ABS(f.w0[1], 6.0, 0.0, "what is given along n adds up");
    CHECK_ABS(f.w0[M + 1], 0.0, 0.0, "what is given along t is mirrored");
    for (int stored = 0; stored < 2; stored++) {
        CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * M));
        for (int j = 0; j < 2 * N; j++)
            for (int i = 0; i < 2 * M; i++) {
                const double sign = (i < M) == (j < N) ? 1.0 : -1.0;
                CHECK_ABS(F[i + j * 2 * M], A[i + j * 2 * M] + sign * B[i + j * 2 * M],
                          1e-13 * most * 1e3, "kinds %d and %d: entry %d, %d", kind_a, kind_b, i,
                          j);
            }
        for (int k = 0; k < 3; k++) { /* all tractions, and those along n or t alone */
            for (int j = 0; j < 2 * N; j++)
                r[j] = k && (j < N) == (k - 1) ? 0.0 : cos(1.0 + j);
            rb_bem_flexibility_apply(&f, r, w);
            for (int i = 0; i < 2 * M; i++) {
                double want = 0.0;
                for (int j = 0; j < 2 * N; j++)
                    want += F[i + j * 2 * M] * r[j];
                CHECK_ABS(w[i], want, 1e-12, "kinds %d and %d: product %d", kind_a, kind_b, i);
            }
        }
        CHECK_OK(rb_bem_flexibility_store(&f));
        assert_non_null(rb_bem_flexibility_stored(&f));
    }
    rb_bem_flexibility_free(&f);
}

TEST(two_of_any_kind_are_their_sum)
{
    for (int a = 0; a < KINDS; a++)
        for (int b = 0; b < KINDS; b++)
            check_pair(a, b);
}

/* What is added on the diagonals stays where the operator changes its kind. */
TEST(interfaces_yield_under_their_own_traction)
{
    double c[2 * N], bad[N], F[4 * M * N], G[4 * M * N], r[2 * N], w[2 * M];

    for (int i = 0; i < 2 * N; i++) {
        c[i] = 0.1 * (i + 1);
        r[i] = sin(2.0 + i);
    }
    for (int kind = 0; kind < KINDS; kind++) {
        OWNED(rb_bem_flexibility) f;
        CHECK_OK(make(kind, &f));
        CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * M));
        for (int k = 0; k < 6; k++) {
            memcpy(bad, c, sizeof bad);
            bad[k] = k % 3 == 0 ? -1.0 : k % 3 == 1 ? NAN : INFINITY;
            CHECK_STATUS(rb_bem_flexibility_add_compliance(&f, k < 3 ? bad : c, k < 3 ? c : bad),
                         RB_EINVAL);
        }
        for (int twice = 0; twice < 2; twice++)
            CHECK_OK(rb_bem_flexibility_add_compliance(&f, c, c + N));
        for (int stored = 0; stored < 2; stored++) {
            CHECK_OK(rb_bem_flexibility_matrix(&f, G, 2 * M));
            rb_bem_flexibility_apply(&f, r, w);
            for (int i = 0; i < 2 * M; i++) {
                double product = 0.0;
                for (int j = 0; j < 2 * N; j++) {
                    const int own = i == (j < N ? j : j - N + M);
                    CHECK_ABS(G[i + j * 2 * M], F[i + j * 2 * M] + own * 2.0 * c[j], 1e-14,
                              "kind %d: entry %d, %d", kind, i, j);
                    product += G[i + j * 2 * M] * r[j];
                }
                CHECK_ABS(w[i], product, 1e-12, "kind %d: product %d", kind, i);
            }
            CHECK_OK(rb_bem_flexibility_store(&f));
        }
    }
}

/* ---- Memory ------------------------------------------------------------------------ */

/* Does the work with the first allocation refused, then the second ...: it fails where,
 * and only where, one was. */
static void check_memory(rb_status (*work)(const void *of), const void *of)
{
    for (int count = 0, refused = 1; refused; count += 1 + count / 40) {
        refused = REFUSED_FROM(count, work(of));
        assert_true(count < 10000);
    }
}

static rb_status make_pair(const void *of)
{
    static const double upstream[4] = {0.0, 1.0, -1.0, 0.0};
    const int *kinds = of;
    double F[4 * M * N], c[2 * N] = {0.0};
    OWNED(rb_bem_flexibility) a = {0}, b = {0}, f = {0};
    rb_bem_circulant *circulant = NULL;

    rb_status s = make(kinds[0], &a);
    if (s == RB_OK)
        s = make(kinds[1], &b);
    if (s == RB_OK)
        s = rb_bem_flexibility_pair(&a, &b, &f, NULL);
    if (s == RB_OK)
        s = rb_bem_circulant_create(&f, upstream, upstream, &circulant);
    if (s == RB_OK)
        s = rb_bem_flexibility_add_compliance(&f, c, c);
    if (s == RB_OK)
        s = rb_bem_flexibility_matrix(&f, F, 2 * M);
    if (s == RB_OK)
        s = rb_bem_flexibility_store(&f);
    rb_bem_circulant_free(circulant);
    return s;
}

TEST(pairs_tell_of_missing_memory)
{
    static const int kinds[][2] = {
        {FLAT, SOFT}, {LAYER, DENSE}, {DENSE, REMEMBERS}, {DISC_TURNED, DISC}};
    for (int k = 0; k < 4; k++)
        check_memory(make_pair, kinds[k]);
}

static rb_bem_cylinder cylinder_of(int has_cover)
{
    return (rb_bem_cylinder){.radius = 2.0,
                             .support = RB_BEM_HUB,
                             .hub_ratio = 0.4,
                             .cover = has_cover ? 0.5 : 0.0,
                             .outer_elements = has_cover ? 30 : 12};
}

/* A wheel, or a cover on its core, its flexibility, its memory and its stress. */
static rb_status make_wheel(const void *of)
{
    static const double ratio[] = {2.0, NAN}, length[] = {0.3, NAN};
    const int has_cover = *(const int *)of;
    const rb_bem_cylinder cylinder = cylinder_of(has_cover);
    const rb_bem_wheel wheel = {.radius = 2.0,
                                .inner = has_cover ? 1.5 : 0.8,
                                .material = rubber,
                                .terms = 1,
                                .ratio = ratio,
                                .length = length,
                                .hub = has_cover ? 0.8 : 0.0,
                                .core = steel};
    const double t_contact[2 * N] = {0.0, 1.0}, xy[4] = {0.0, 0.2, 0.1, 0.3};
    double stress[6], u[600], t[600];
    OWNED(rb_bem_mesh) mesh = {0}, core = {0};
    held_system *system = NULL;
    rb_bem_field *field = NULL;
    rb_bem_loaded *loaded = NULL;
    double r[2 * N] = {1.0}, change[2 * M];
    OWNED(rb_bem_flexibility) f = {0}, g = {0}, waves = {0}, below = {0}, pair = {0};
    double F[4 * N * (N + 1)];
    const rb_bem_edge_load load = {1, ends, t_contact + 1, t_contact},
                           nodes = {2, ends, t_contact + 1, t_contact};
    const rb_bem_surface plane = rb_bem_halfplane(rubber, 1.0);
    double w[2];

    rb_status s = rb_bem_mesh_cylinder(&cylinder, N, ends, &mesh, NULL);
    if (s == RB_OK && has_cover)
        s = rb_bem_mesh_core(&cylinder, &mesh, &core, NULL);
    if (s == RB_OK)
        s = has_cover ? rb_bem_system_create_bonded(&mesh, rubber, &core, steel, &system, NULL)
                      : rb_bem_system_create(&mesh, rubber, &system, NULL);
    if (s == RB_OK)
        s = rb_bem_system_solve(system, t_contact, u, t);
    if (s == RB_OK)
        s = rb_bem_condense(system, RB_BEM_NORMALS_SURFACE, &f, NULL);
    if (s == RB_OK)
        s = rb_bem_condense_subtracted(system, RB_BEM_NORMALS_OBSTACLE, &g, NULL);
    if (s == RB_OK && !has_cover)
        s = rb_bem_loaded_create(system, RB_BEM_NORMALS_SURFACE, 1, r, &loaded, NULL);
    if (s == RB_OK && !has_cover)
        s = rb_bem_loaded_change(loaded, &mesh, rubber, change);
    rb_bem_loaded_free(loaded);
    if (s == RB_OK)
        s = rb_bem_flexibility_add_memory(&wheel, RB_BEM_NORMALS_OBSTACLE, ends, &g, NULL);
    if (s == RB_OK)
        s = rb_bem_flexibility_wheel(N, ends, &wheel, RB_BEM_NORMALS_OBSTACLE, &waves, NULL);
    if (s == RB_OK)
        s = rb_bem_wheel_normal(&wheel, &load, 2, xy, w);
    if (s == RB_OK)
        s = rb_bem_field_create(system, &nodes, &field, NULL);
    if (s == RB_OK)
        s = rb_bem_field_stress(field, (rb_bem_points){2, xy}, stress, NULL);
    assert_true(mesh.n <= 300);
    rb_bem_flexibility_free(&waves);
    if (s == RB_OK)
        s = rb_bem_flexibility_wheel_products(N, ends, &wheel, RB_BEM_NORMALS_OBSTACLE, &waves,
                                              NULL);
    rb_bem_flexibility_free(&waves);
    if (s == RB_OK)
        s = rb_bem_flexibility_surface_products(N, ends, &plane, &waves, NULL);
    if (s == RB_OK)
        s = rb_bem_flexibility_surface_products(N, ends, &plane, &below, NULL);
    if (s == RB_OK)
        s = rb_bem_flexibility_pair(&waves, &below, &pair, NULL);
    if (s == RB_OK)
        s = rb_bem_flexibility_matrix(&pair, F, 2 * (N + 1));
    rb_bem_flexibility_free(&pair);
    rb_bem_flexibility_free(&waves);
    rb_bem_field_free(field);
    rb_bem_flexibility_free(&g);
    return s;
}

TEST(wheels_tell_of_missing_memory)
{
    const rb_bem_cylinder wheel = {.radius = 50.0, .support = RB_BEM_HUB, .hub_ratio = 0.5};
    rb_bem_mesh mesh;
    rb_message why = {.text = ""};
    char text[80];
    CHECK_OK(rb_bem_mesh_cylinder(&wheel, N, ends, &mesh, NULL));
    snprintf(text, sizeof text, "cylinder: out of memory for %d elements", mesh.n);
    rb_bem_mesh_free(&mesh);
    alloc_fail_after(0);
    const rb_status s = rb_bem_mesh_cylinder(&wheel, N, ends, &mesh, &why);
    alloc_succeed();
    CHECK_STATUS(s, RB_ENOMEM);
    assert_string_equal(why.text, text);
    for (int has_cover = 0; has_cover < 2; has_cover++)
        check_memory(make_wheel, &has_cover);
}

/* ---- Where formulas have no value of their own ------------------------------------- */

/* At the ends of strips, where a logarithm or its angle has none, values are those beside
 * them. */
TEST(ends_of_strips_are_limits)
{
    static const double ratio = 2.0, length = 0.3, one = 1.0;
    const rb_bem_surface body = {
        .material = rubber, .datum = 5.0, .terms = 1, .ratio = &ratio, .length = &length};
    const rb_bem_disc disc = {2.0, steel};
    const double strip[2] = {-0.2, 0.3}, xy[4] = {-0.2, 0.0, 0.3, 0.0};
    double W[4], beside[4], stress[6];

    for (int k = 0; k < 2; k++) {
        const double near = strip[k] + 1e-9;
        CHECK_OK(rb_bem_surface_displacement(&body, 1, strip, 1, &strip[k], W));
        CHECK_OK(rb_bem_surface_displacement(&body, 1, strip, 1, &near, beside));
        for (int i = 0; i < 4; i++)
            CHECK_ABS(W[i], beside[i], 1e-7, "surface, end %d, entry %d", k, i);
        const double angle = k ? 0.05 : -0.05;
        CHECK_OK(rb_bem_disc_response(&disc, 0.1, angle, W));
        CHECK_OK(rb_bem_disc_response(&disc, 0.1, angle + 1e-9, beside));
        for (int i = 0; i < 4; i++)
            CHECK_ABS(W[i], beside[i], 1e-11, "disc, end %d, entry %d", k, i);
    }
    const rb_bem_edge_load load = {1, strip, &one, &one};
    CHECK_OK(rb_bem_halfplane_stress(&load, (rb_bem_points){2, xy}, stress));
    for (int k = 0; k < 2; k++) {
        CHECK_REL(stress[3 * k + 1], -0.5, 1e-12, "half of the pressure");
        CHECK_REL(stress[3 * k + 2], -0.5, 1e-12, "half of the friction");
    }
}

/* Of displacement and stress each may be asked for alone, inside and on the surface. */
TEST(fields_may_be_asked_for_alone)
{
    const rb_bem_cylinder cylinder = cylinder_of(0);
    const double t_contact[2 * N] = {0.0, 1.0, 0.5, 2.0};
    double u[600], t[600], both_u[4], both_s[6], alone[6];
    OWNED(rb_bem_mesh) mesh;
    held_system *system;

    CHECK_OK(rb_bem_mesh_cylinder(&cylinder, N, ends, &mesh, NULL));
    CHECK_OK(rb_bem_system_create(&mesh, steel, &system, NULL));
    CHECK_OK(rb_bem_system_solve(system, t_contact, u, t));
    const int c = mesh.contact_first + 2;
    const double xy[4] = {0.1, 0.5, midpoint_x(&mesh, c), midpoint_y(&mesh, c)};
    const rb_bem_points points = {2, xy};
    const rb_bem_boundary body = {&mesh, steel, u, t};
    CHECK_OK(rb_bem_interior(&body, points, both_u, both_s, NULL));
    CHECK_OK(rb_bem_interior(&body, points, alone, NULL, NULL));
    assert_memory_equal(alone, both_u, sizeof both_u);
    CHECK_OK(rb_bem_interior(&body, points, NULL, alone, NULL));
    assert_memory_equal(alone, both_s, sizeof both_s);
    CHECK_ABS(both_u[2], u[2 * c], 1e-12 * fabs(u[2 * c]), "displacement of the element");
}

/* ---- Clusters ---------------------------------------------------------------------- */

/* ---- Refusals ---------------------------------------------------------------------- */

TEST(absurd_cylinders_are_refused)
{
    static const double lopsided[] = {-1.8, 0.0, 0.01, 1.0};
    static const struct {
        rb_bem_cylinder c;
        const double *ends;
        const char *said;
    } all[] = {
        {{.radius = NAN, .support = RB_BEM_HUB, .hub_ratio = 0.4}, NULL, "radius = "},
        {{.radius = INFINITY, .support = RB_BEM_HUB, .hub_ratio = 0.4}, NULL, "radius = "},
        {{.radius = 2.0, .support = RB_BEM_HALFPLANE}, NULL, "support arc or hub"},
        {{.radius = 2.0, .support = RB_BEM_ARC, .arc = 2.0}, NULL, "half-angle 2"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 1.0}, NULL, "hub ratio = 1"},
        {{.radius = 2.0, .support = RB_BEM_ARC, .arc = 0.5, .cover = 0.5}, NULL, "cover of"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 0.4, .cover = -0.5},
         NULL,
         "cover of thickness -0.5"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 0.4, .cover = 2.0},
         NULL,
         "cover of thickness 2"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 0.4, .outer_elements = -1},
         NULL,
         "outer elements = -1"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 0.4, .outer_elements = 7},
         NULL,
         "outer elements = 7"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 0.4, .refinement = -1.0},
         NULL,
         "refinement = -1"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 0.4, .refinement = 1001.0},
         NULL,
         "refinement = 1001"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 0.4, .outer_elements = 1000001},
         NULL,
         "at most a million"},
        {{.radius = 0.3, .support = RB_BEM_HUB, .hub_ratio = 0.4}, NULL, "on a radius of 0.3"},
        {{.radius = 2.0, .support = RB_BEM_ARC, .arc = 0.5}, lopsided, "the clamped arc"},
        {{.radius = 2.0, .support = RB_BEM_HUB, .hub_ratio = 0.4}, lopsided, "no space"}};

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_bem_mesh mesh;
        CHECK_SAYS(rb_bem_mesh_cylinder(&all[k].c, all[k].ends ? 2 : N,
                                        all[k].ends ? all[k].ends : ends, &mesh, &message),
                   RB_EINVAL, all[k].said);
    }
}

TEST(absurd_surfaces_are_refused)
{
    static const double one = 1.0, endless = INFINITY, none = NAN;
    static const double reversed[] = {0.0, 1.0, 0.5}, open[] = {0.0, 1.0, INFINITY},
                        endless_left[] = {-INFINITY, 0.0, 1.0};
    const struct {
        rb_bem_surface body;
        const double *ends;
        const char *said;
    } all[] = {{{.material = {INFINITY, 0.3}, .datum = 1.0}, ends, "shear"},
               {{.material = rubber, .datum = INFINITY}, ends, "datum"},
               {{.material = rubber, .thickness = INFINITY}, ends, "thickness"},
               {{.material = rubber, .thickness = NAN}, ends, "thickness"},
               {{.material = rubber, .datum = 1.0, .terms = 1, .ratio = &endless, .length = &one},
                ends,
                "ratio inf"},
               {{.material = rubber, .datum = 1.0, .terms = 1, .ratio = &none, .length = &one},
                ends,
                "ratio"},
               {{.material = rubber, .datum = 1.0, .terms = 1, .ratio = &one, .length = &endless},
                ends,
                "length inf"},
               {{.material = rubber, .datum = 1.0}, NULL, "contact elements: 1"},
               {{.material = rubber, .datum = 1.0}, reversed, "expected increasing ends"},
               {{.material = rubber, .datum = 1.0}, open, "expected increasing ends"},
               {{.material = rubber, .datum = 1.0}, endless_left, "expected increasing ends"}};
    double W[4], w[1] = {0.0};

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_bem_flexibility f;
        CHECK_SAYS(rb_bem_flexibility_surface(1, all[k].ends, &all[k].body, &f, &message),
                   RB_EINVAL, all[k].said);
        if (k < 7)
            CHECK_STATUS(rb_bem_surface_displacement(&all[k].body, 1, ends, 1, &one, W), RB_EINVAL);
        const rb_bem_edge_load load = {k < 7, ends, &one, &one};
        CHECK_STATUS(rb_bem_surface_add_normal(&all[k].body, &load, 1, &one, w), RB_EINVAL);
    }
    const rb_bem_surface good = {.material = rubber, .datum = 1.0};
    CHECK_STATUS(rb_bem_surface_displacement(&good, 0, ends, 1, &one, W), RB_EINVAL);
    CHECK_STATUS(rb_bem_surface_displacement(&good, 1, ends, 0, &one, W), RB_EINVAL);
}

/* Without reading any end of them; and what does not fit together. */
TEST(absurd_operators_are_refused)
{
    const rb_bem_surface good = {.material = rubber, .datum = 1.0};
    rb_bem_flexibility f, a, b, none = {0}, other = {0};

    CHECK_SAYS(rb_bem_flexibility_toeplitz((1 << 28) + 1, NULL, &good, &f, &message), RB_EINVAL,
               "expected at most 268435456");
    CHECK_OK(make(FLAT, &a));
    CHECK_STATUS(rb_bem_flexibility_matrix(&a, NULL, 2 * M), RB_EINVAL);
    CHECK_OK(rb_bem_flexibility_surface(2, ends, &good, &b, NULL));
    CHECK_STATUS(rb_bem_flexibility_pair(&a, &b, &f, &message), RB_EINVAL);
    assert_string_equal(message.text, "bodies in contact: 6 elements on A, 2 on B");
    CHECK_STATUS(rb_bem_flexibility_pair(&none, &other, &f, &message), RB_EINVAL);
    CHECK_OK(make(FLAT, &a));
    CHECK_OK(make(SOFT, &b));
    b.x[2] += 1e-6;
    CHECK_SAYS(rb_bem_flexibility_pair(&a, &b, &f, &message), RB_EINVAL, "point 2");
    /* docs/performance.md, "Memory" */
    const int most = RB_BEM_HIERARCHICAL - 1;
    const double all = most, n = 10.0;
    CHECK_REL(rb_bem_system_bytes(most, 10), 8.0 * (4.0 * all * all + 8.0 * all * n + 4.0 * n * n),
              1e-14, "dense");
    CHECK_REL(rb_bem_system_bytes(most + 1, 10), (all + 1.0) * (6000.0 + 64.0 * n), 1e-14,
              "hierarchical");
}

TEST(absurd_discs_are_refused)
{
    static const double beside[] = {1.0, 1.1, 1.2, 1.3};
    const rb_bem_disc all[] = {
        {INFINITY, steel}, {NAN, steel}, {1.05, steel}, {0.5, steel}, {5.0, {-1.0, 0.3}}};
    double response[4];

    for (int k = 0; k < 5; k++) {
        rb_bem_flexibility f;
        CHECK_STATUS(rb_bem_flexibility_disc(2, beside, &all[k], RB_BEM_NORMALS_SURFACE, &f, NULL),
                     RB_EINVAL);
    }
    CHECK_STATUS(rb_bem_disc_response(&all[2], 7.0, 0.0, response), RB_EINVAL);
    CHECK_STATUS(rb_bem_disc_response(&all[2], 0.0, 0.0, response), RB_EINVAL);
    CHECK_STATUS(rb_bem_disc_response(&all[2], 0.1, INFINITY, response), RB_EINVAL);
    CHECK_STATUS(rb_bem_disc_response(&all[4], 0.1, 0.0, response), RB_EINVAL);
}

TEST(absurd_wheels_are_refused)
{
    static const double one = 1.0, endless = INFINITY, zero = 0.0, minus = -1.0;
    const struct {
        double radius, inner, hub;
        const double *ratio, *length;
        const char *said;
    } all[] = {{2.0, 1.0, -0.5, &one, &one, "radii -0.5, 1, 2"},
               {2.0, 1.0, 1.0, &one, &one, "hub of radius 1"},
               {2.0, 2.0, 1.0, &one, &one, "radii 1, 2, 2"},
               {INFINITY, 2.0, 1.0, &one, &one, "radii 1, 2, inf"},
               {2.0, 1.0, 0.0, &minus, &one, "term 1: ratio -1"},
               {2.0, 1.0, 0.0, &endless, &one, "term 1: ratio inf"},
               {2.0, 1.0, 0.0, &one, &zero, "term 1: ratio 1, length 0"},
               {2.0, 1.0, 0.0, &one, &endless, "length inf"}};
    OWNED(rb_bem_flexibility) f;

    CHECK_OK(make(FLAT, &f));
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        const rb_bem_wheel wheel = {.radius = all[k].radius,
                                    .inner = all[k].inner,
                                    .hub = all[k].hub,
                                    .material = rubber,
                                    .core = steel,
                                    .terms = 1,
                                    .ratio = all[k].ratio,
                                    .length = all[k].length};
        CHECK_SAYS(
            rb_bem_flexibility_add_memory(&wheel, RB_BEM_NORMALS_OBSTACLE, ends, &f, &message),
            RB_EINVAL, all[k].said);
    }
}

TEST(absurd_meshes_are_refused)
{
    static const struct {
        int at;
        double value;
        rb_bem_condition condition;
        int first, n;
        const char *said;
    } all[] = {{11, INFINITY, RB_BEM_TRACTION, 0, 0, "element 11: given traction in y = inf"},
               {11, NAN, RB_BEM_DISPLACEMENT, 0, 0, "element 11: given displacement in y = "},
               {11, 0.0, RB_BEM_CONTACT, 0, 0, "element 11: outside the contact"},
               {11, 0.0, RB_BEM_TRACTION, 11, 1, "element 11: in contact"},
               {3, 0.0, RB_BEM_TRACTION, 0, -1, "contact elements 0 to -2"},
               {3, 0.0, RB_BEM_TRACTION, -1, 1, "contact elements -1 to -1"},
               {3, 0.0, RB_BEM_TRACTION, 16, 1, "contact elements 16 to 16"},
               {3, 0.0, RB_BEM_TRACTION, 15, 1, NULL}};

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        OWNED(rb_bem_mesh) mesh = circle(16, 1.0);
        mesh.value[2 * all[k].at + 1] = all[k].value;
        mesh.condition[2 * all[k].at + 1] = all[k].condition;
        mesh.contact_first = all[k].first;
        mesh.contact_n = all[k].n;
        CHECK_STATUS(rb_bem_mesh_check(&mesh, &message), RB_EINVAL);
        if (all[k].said && !strstr(message.text, all[k].said))
            fail_msg("case %zu: %s", k, message.text);
    }
    rb_bem_mesh mesh = circle(16, 1.0);
    mesh.x1[4] = mesh.x0[5] = INFINITY;
    CHECK_SAYS(rb_bem_mesh_check(&mesh, &message), RB_EINVAL, "element 4: length inf");
    rb_bem_mesh_free(&mesh);
    mesh = circle(16, 1.0);
    mesh.contact_first = 3;
    mesh.contact_n = 1;
    mesh.x1[3] = mesh.x0[3]; /* upright */
    CHECK_STATUS(rb_bem_mesh_check(&mesh, &message), RB_EINVAL);
    assert_string_equal(message.text, "contact element 3 does not run towards +x");
    rb_bem_mesh_free(&mesh);
}

/* An incompressible cover does not tell how its core is pressed, a core without hub
 * floats, and one of another cover does not fit. */
TEST(covers_need_their_core)
{
    const rb_bem_material jelly = {1.0, 0.5}, wrong = {-1.0, 0.3};
    rb_bem_cylinder cylinder = cylinder_of(1);
    rb_bem_mesh mesh, core, other;
    rb_bem_system *system;

    CHECK_OK(rb_bem_mesh_cylinder(&cylinder, N, ends, &mesh, NULL));
    CHECK_OK(rb_bem_mesh_core(&cylinder, &mesh, &core, NULL));
    CHECK_SAYS(rb_bem_system_create_bonded(&mesh, jelly, &core, steel, &system, &message),
               RB_EINVAL, "cover on an elastic core: expected Poisson's ratio below");
    CHECK_SAYS(rb_bem_system_create_bonded(&mesh, rubber, &core, wrong, &system, &message),
               RB_EINVAL, "shear");
    cylinder.hub_ratio = 0.74;
    CHECK_SAYS(rb_bem_mesh_core(&cylinder, &mesh, &other, &message), RB_EINVAL,
               "hub of radius 1.48");
    core.x1[1] = core.x0[2] += 1e-3;
    CHECK_SAYS(rb_bem_system_create_bonded(&mesh, rubber, &core, steel, &system, &message),
               RB_EINVAL, "of the cover is not element");
    rb_bem_mesh_free(&mesh);
    rb_bem_mesh_free(&core);
}

RUN_TESTS(equal_ends, NULL)
