/* Bodies whose surface answers alike everywhere: memory and layers against quadrature,
 * limits and identities. */
#include "bem_shapes.h"
#include "check.h"
#include "bem/bem.h"

#include <complex.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

enum { MANY = 4000 };

static const rb_bem_material rubber = {1.2, 0.4}, soft = {1.0, 0.5}, core = {7.0, 0.3};

/* Entries NN, TN, NT, TT of one strip [-b, b] seen from x. */
static void strip_entries(const rb_bem_surface *body, double x, double b, double entry[4])
{
    const double ends[2] = {-b, b};
    CHECK_OK(rb_bem_surface_displacement(body, 1, ends, 1, &x, entry));
}

static double adaptive(double (*f)(double, void *), void *context, double from)
{
    double value, error;
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(MANY);
    gsl_function g = {f, context};
    const int s = gsl_integration_qagiu(&g, from, 0.0, 1e-12, MANY, room, &value, &error);
    gsl_integration_workspace_free(room);
    assert_int_equal(s, 0);
    return value;
}

/* ---- Memory ------------------------------------------------------------------------ */

typedef struct {
    const rb_bem_surface *elastic;
    double x, b, L;
    int entry;
    double reach; /* from the strip, beyond which w_e is nothing; 0: there is no such */
} average;

/* exp(-t) w_e(x + L t): what a particle brings from where it has been. */
static double brought(double t, void *context)
{
    const average *a = context;
    double entry[4];
    strip_entries(a->elastic, a->x + a->L * t, a->b, entry);
    return exp(-t) * entry[a->entry];
}

/* Split where the point passes the ends of the strip, whose logarithms have no derivative
 * there. */
static double average_of(average *a)
{
    const double corner[3] = {(-a->b - a->x) / a->L, (a->b - a->x) / a->L,
                              (a->reach - a->x) / a->L};
    double from = 0.0, sum = 0.0, error, part;
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(MANY);
    gsl_function g = {brought, a};
    for (int k = 0; k < (a->reach > 0.0 ? 3 : 2); k++)
        if (corner[k] > from) {
            const int s =
                gsl_integration_qags(&g, from, corner[k], 1e-14, 1e-11, MANY, room, &part, &error);
            assert_int_equal(s, 0);
            sum += part;
            from = corner[k];
        }
    gsl_integration_workspace_free(room);
    return a->reach > 0.0 ? sum : sum + adaptive(brought, a, from);
}

/* (V1) w = w_e + sum f_k E_k w_e, entry by entry. */
TEST(memory_averages_what_lies_upstream)
{
    const double ratio[2] = {1.5, 4.0}, b = 0.5;
    const rb_bem_surface elastic = rb_bem_halfplane(rubber, 20.0);
    for (int trial = 0; trial < 14; trial++) {
        const double x = -4.0 + 0.61 * trial;
        const double length[2] = {0.03 * (1 + trial % 7), 2.0 * (1 + trial % 5)};
        rb_bem_surface body = elastic;
        double got[4], want[4];
        body.terms = 2;
        body.ratio = ratio;
        body.length = length;
        strip_entries(&body, x, b, got);
        strip_entries(&elastic, x, b, want);
        for (int e = 0; e < 4; e++)
            for (int k = 0; k < 2; k++) {
                average a = {&elastic, x, b, length[k], e, 0.0};
                want[e] += ratio[k] * average_of(&a);
            }
        for (int e = 0; e < 4; e++)
            CHECK_ABS(got[e], want[e], 2e-10, "x = %g, entry %d", x, e);
    }
}

/* No memory length: the rubbery half-plane; a length beyond all others: the glassy one up
 * to a constant; strips that are tiny against it keep their digits. */
TEST(memory_has_its_limits)
{
    const double ratio = 3.0, none = 0.0, tiny = 1e-9, long_ = 1e9;
    const rb_bem_surface elastic = rb_bem_halfplane(rubber, 20.0);
    double e[4], got[4], other[4], e2[4];
    rb_bem_surface body = elastic;
    body.terms = 1;
    body.ratio = &ratio;
    for (int k = 0; k < 2; k++) {
        body.length = k ? &tiny : &none;
        strip_entries(&body, 1.3, 0.2, got);
        strip_entries(&elastic, 1.3, 0.2, e);
        for (int j = 0; j < 4; j++)
            CHECK_ABS(got[j], 4.0 * e[j], 1e-8, "rubbery, entry %d", j);
    }
    body.length = &long_;
    strip_entries(&body, 1.3, 0.2, got);
    strip_entries(&body, 2.9, 0.2, other);
    strip_entries(&elastic, 1.3, 0.2, e);
    strip_entries(&elastic, 2.9, 0.2, e2);
    for (int j = 0; j < 4; j += 3)
        CHECK_ABS(got[j] - other[j], e[j] - e2[j], 1e-8, "glassy, entry %d", j);
}

/* ---- Layers ------------------------------------------------------------------------ */

/* The closed transfer functions of a layer on a rigid base (L1). */
typedef struct {
    rb_bem_material m;
    double d, x, b;
    int entry;
} layer_entry;

static void rigid_transfer(double nu, double al, double L[3])
{
    const double ka = 3.0 - 4.0 * nu, E = exp(-2.0 * al), E2 = E * E;
    const double cosh2 = 1.0 + E2, sinh2 = 1.0 - E2; /* both times 2 exp(-2 al) */
    const double D = ka * cosh2 + E * (4.0 * al * al + 1.0 + ka * ka);
    L[0] = (ka * sinh2 - 4.0 * al * E) / D;
    L[1] = (ka * sinh2 + 4.0 * al * E) / D;
    L[2] = (ka * (ka - 1.0) * (cosh2 - 2.0 * E) - 8.0 * al * al * E) / ((ka + 1.0) * D);
}

/* Displacement of a smooth wave packet: here the strip itself, as an integral over all
 * waves without splitting off the half-plane; the tail falls like 1/k^2. */
static double wave(double k, void *context)
{
    const layer_entry *e = context;
    double L[3];
    const double nu = e->m.poisson, scale = 2.0 * (1.0 - nu) / (M_PI * e->m.shear);
    const double strip = sin(k * e->b) / (k * k);
    rigid_transfer(nu, k * e->d, L);
    return scale * strip *
           (e->entry == 0   ? L[0] * cos(k * e->x)
            : e->entry == 3 ? L[1] * cos(k * e->x)
            : e->entry == 2 ? L[2] * sin(k * e->x)
                            : -L[2] * sin(k * e->x));
}

/* The wave integral up to k = last by panels of Gauss; beyond it less than 2/(last) of
 * it. */
static double integral_over_waves(layer_entry *e, double last)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(32);
    gsl_function f = {wave, e};
    const double width = 2.0 / (fabs(e->x) + e->b + e->d);
    double sum = 0.0;
    for (double k = 0.0; k < last; k += width)
        sum += gsl_integration_glfixed(&f, k, k + width, rule);
    gsl_integration_glfixed_table_free(rule);
    return sum;
}

TEST(layers_are_integrals_over_their_waves)
{
    const rb_bem_material material[3] = {rubber, soft, {3.0, 0.1}};
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 5; j++) {
            const double x = 0.7 * j - 1.4, b = 0.3, d = 0.4 + 0.8 * k;
            const rb_bem_surface body = {.material = material[k], .thickness = d};
            double got[4];
            strip_entries(&body, x, b, got);
            for (int entry = 0; entry < 4; entry++) {
                layer_entry e = {material[k], d, x, b, entry};
                const double want = integral_over_waves(&e, 3000.0);
                CHECK_ABS(got[entry], want, 1e-6, "material %d, x = %g, entry %d", k, x, entry);
            }
        }
}

/* A layer on a base of its own material is the half-plane, whatever its thickness. */
TEST(equal_materials_are_the_half_plane)
{
    const rb_bem_surface plane = rb_bem_halfplane(rubber, 20.0);
    for (int j = 0; j < 12; j++) {
        const double x = 0.5 * j - 2.0;
        const rb_bem_surface body = {.material = rubber,
                                     .datum = 20.0,
                                     .thickness = 0.1 * (1 << j % 6),
                                     .elastic_base = 1,
                                     .base = rubber};
        double got[4], want[4];
        strip_entries(&body, x, 0.2, got);
        strip_entries(&plane, x, 0.2, want);
        for (int e = 0; e < 4; e++)
            CHECK_ABS(got[e], want[e], 1e-12, "x = %g, entry %d", x, e);
    }
}

/* A thick layer answers like its own half-plane, a thin one like its base, and a base
 * that is far stiffer like a rigid one. */
TEST(layers_have_their_limits)
{
    const rb_bem_surface own = rb_bem_halfplane(rubber, 20.0), under = rb_bem_halfplane(core, 20.0);
    rb_bem_surface body = {.material = rubber, .datum = 20.0, .elastic_base = 1, .base = core};
    double near[4], far[4], a[4], b[4];
    body.thickness = 1e6;
    strip_entries(&body, 0.1, 0.2, near);
    strip_entries(&body, 1.7, 0.2, far);
    strip_entries(&own, 0.1, 0.2, a);
    strip_entries(&own, 1.7, 0.2, b);
    for (int e = 0; e < 4; e++)
        CHECK_ABS(near[e] - far[e], a[e] - b[e], 1e-7, "thick, entry %d", e);
    body.thickness = 1e-5;
    strip_entries(&body, 0.7, 0.2, near);
    strip_entries(&under, 0.7, 0.2, a);
    for (int e = 0; e < 4; e++)
        CHECK_ABS(near[e], a[e], 1e-5, "thin, entry %d", e);
    body.thickness = 0.5;
    body.base.shear = 1e12;
    strip_entries(&body, 0.7, 0.2, near);
    body.elastic_base = 0;
    strip_entries(&body, 0.7, 0.2, far);
    for (int e = 0; e < 4; e++)
        CHECK_ABS(near[e], far[e], 1e-10, "stiff base, entry %d", e);
}

/* Under a wide uniform pressure a thin compressible layer is a mattress: w = p d/M. */
TEST(thin_layers_are_mattresses)
{
    const rb_bem_surface body = {.material = rubber, .thickness = 0.01};
    const double nu = rubber.poisson, M = 2.0 * rubber.shear * (1.0 - nu) / (1.0 - 2.0 * nu);
    double got[4];
    strip_entries(&body, 0.1, 1.0, got);
    CHECK_REL(got[0], 0.01 / M, 1e-9, "pressure");
    CHECK_REL(got[3], 0.01 / rubber.shear, 1e-9, "friction");
}

/* So is a film, as far as the half-plane's digits reach: it has as few waves as any. */
TEST(films_are_mattresses)
{
    const double nu = rubber.poisson, M = 2.0 * rubber.shear * (1.0 - nu) / (1.0 - 2.0 * nu);
    for (double d = 1e-3; d > 1e-9; d *= 0.1) {
        const rb_bem_surface body = {.material = rubber, .thickness = d};
        double got[4], beside[4];
        strip_entries(&body, 0.1, 1.0, got);
        strip_entries(&body, 1.3, 1.0, beside);
        CHECK_ABS(got[0], d / M, 1e-14, "pressure on d = %g", d);
        CHECK_ABS(got[3], d / rubber.shear, 1e-14, "friction on d = %g", d);
        CHECK_ABS(beside[0], 0.0, 1e-14, "beside the pressure on d = %g", d);
    }
}

/* (V1) holds for a viscoelastic layer as for the half-plane, also where its memory
 * reaches a hundred thousand thicknesses. */
TEST(layers_remember)
{
    const double ratio = 2.0, length[2] = {0.8, 6e4};
    const rb_bem_surface elastic = {.material = rubber, .thickness = 0.6};
    rb_bem_surface body = elastic;
    body.terms = 1;
    body.ratio = &ratio;
    for (int j = 0; j < 6; j++) {
        const double x = 0.6 * (j % 5) - 1.5;
        double got[4], want[4];
        body.length = &length[j / 5];
        strip_entries(&body, x, 0.25, got);
        strip_entries(&elastic, x, 0.25, want);
        for (int e = 0; e < 4; e++) {
            average a = {&elastic, x, 0.25, length[j / 5], e, j < 5 ? 0.0 : 15.0};
            want[e] += ratio * average_of(&a);
            CHECK_ABS(got[e], want[e], 1e-9, "x = %g, entry %d", x, e);
        }
    }
}

/* What is seen alone is what is seen together with what lies farther away. */
TEST(what_lies_far_away_is_met)
{
    const rb_bem_surface body = {.material = rubber, .thickness = 0.6};
    const double ends[2] = {-0.25, 0.25}, at = 18.0, x[2] = {at, 3.0 * at};
    double under[4], alone[4], together[8];
    strip_entries(&body, 0.0, 0.25, under);
    CHECK_OK(rb_bem_surface_displacement(&body, 1, ends, 1, &at, alone));
    CHECK_OK(rb_bem_surface_displacement(&body, 1, ends, 2, x, together));
    for (int e = 0; e < 4; e++)
        CHECK_ABS(alone[e], together[2 * e], 5e-13 * fabs(under[0]), "entry %d", e);
}

/* ---- Operators --------------------------------------------------------------------- */

/* Entries and products of the transforms against the dense matrix, with memory and
 * layers. */
TEST(transforms_are_the_dense_matrix)
{
    enum { n = 37, m = n + 1, ld = 2 * m };
    const double ratio[2] = {1.0, 4.0}, length[2] = {0.1, 2.0};
    const rb_bem_surface bodies[3] = {
        {.material = rubber, .datum = 9.0, .terms = 2, .ratio = ratio, .length = length},
        {.material = soft, .thickness = 0.7},
        {.material = rubber, .thickness = 0.3, .terms = 1, .ratio = ratio, .length = length}};
    static double ends[n + 2], F[ld * 2 * n], T[ld * 2 * n], r[2 * n], w[ld], v[ld];
    for (int i = 0; i < n + 2; i++)
        ends[i] = -1.1 + 0.06 * i;
    for (int i = 0; i < 2 * n; i++)
        r[i] = sin(3.0 * i) + 0.4;
    for (int k = 0; k < 3; k++) {
        OWNED(rb_bem_flexibility) dense, fast;
        CHECK_OK(rb_bem_flexibility_surface(n, ends, &bodies[k], &dense, &message));
        CHECK_OK(rb_bem_flexibility_toeplitz(n, ends, &bodies[k], &fast, &message));
        CHECK_OK(rb_bem_flexibility_matrix(&dense, F, ld));
        CHECK_OK(rb_bem_flexibility_matrix(&fast, T, ld));
        for (int j = 0; j < ld * 2 * n; j++)
            CHECK_ABS(T[j], F[j], 1e-12, "body %d, entry %d", k, j);
        rb_bem_flexibility_apply(&dense, r, w);
        rb_bem_flexibility_apply(&fast, r, v);
        for (int i = 0; i < ld; i++)
            CHECK_ABS(v[i], w[i], 1e-11, "body %d, product %d", k, i);
    }
}

/* Without a matrix the displacement is the matrix times the tractions, for more points
 * than are taken together too; bad sizes are refused, and a failing allocation leaves
 * nothing. */
TEST(tractions_are_summed_as_by_the_matrix)
{
    enum { n = 3, many = 1100 };
    const double ratio[2] = {1.0, 4.0}, length[2] = {0.1, 2.0};
    const double ends[n + 1] = {-0.5, -0.2, 0.1, 0.7}, p[n] = {1.0, 3.0, -2.0},
                          q[n] = {0.5, -1.0, 0.7};
    const rb_bem_edge_load strips = {n, ends, p, q};
    const rb_bem_surface bodies[3] = {
        {.material = rubber, .datum = 9.0, .terms = 2, .ratio = ratio, .length = length},
        {.material = soft, .thickness = 0.7},
        {.material = rubber, .thickness = 0.3, .elastic_base = 1, .base = core, .datum = 5.0}};
    static double x[many], w[many], W[2 * many * 2 * n];
    for (int i = 0; i < many; i++)
        x[i] = -2.0 + 4.0 * i / many;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < many; i++)
            w[i] = 1.0;
        CHECK_OK(rb_bem_surface_displacement(&bodies[k], n, ends, many, x, W));
        CHECK_OK(rb_bem_surface_add_normal(&bodies[k], &strips, many, x, w));
        for (int i = 0; i < many; i++) {
            double want = 1.0;
            for (int j = 0; j < n; j++)
                want += W[i + 2 * many * j] * p[j] + W[i + 2 * many * (n + j)] * q[j];
            CHECK_ABS(w[i], want, 1e-11, "body %d, x = %g", k, x[i]);
        }
        CHECK_STATUS(rb_bem_surface_add_normal(&bodies[k], &strips, 0, x, w), RB_EINVAL);
    }
    for (int i = 0, done = 0; !done; i++) {
        rb_bem_surface fresh = bodies[1]; /* no table of it is kept */
        fresh.material.poisson = 0.3 - 1e-3 * i;
        alloc_fail_after(i);
        const rb_status s = rb_bem_surface_add_normal(&fresh, &strips, 2, x, w);
        alloc_fail_after(-1);
        done = s == RB_OK;
        assert_true(done ? i >= 4 : s == RB_ENOMEM);
    }
}

TEST(bad_surfaces_are_refused)
{
    const double minus = -1.0, one = 1.0;
    const double ends[3] = {0.0, 1.0, 2.0};
    const struct {
        rb_bem_surface body;
        const char *word;
    } bad[] = {
        {{.material = rubber, .datum = 1.0, .terms = 1, .ratio = &minus, .length = &one},
         "ratio -1"},
        {{.material = rubber, .datum = 1.0, .terms = 1, .ratio = &one, .length = &minus},
         "length -1"},
        {{.material = rubber, .thickness = -2.0, .datum = 1.0}, "thickness -2"},
        {{.material = rubber,
          .thickness = 1.0,
          .elastic_base = 1,
          .base = {-1.0, 0.3},
          .datum = 1.0},
         "shear"},
        {{.material = rubber, .thickness = 1.0, .elastic_base = 1, .base = core}, "datum"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_bem_flexibility f;
        CHECK_SAYS(rb_bem_flexibility_surface(1, ends, &bad[k].body, &f, &message), RB_EINVAL,
                   bad[k].word);
        CHECK_STATUS(rb_bem_flexibility_toeplitz(1, ends, &bad[k].body, &f, &message), RB_EINVAL);
    }
}

TEST(short_memory_is_told)
{
    rb_bem_surface body = {.material = rubber, .thickness = 0.5};
    const double ends[5] = {0.0, 1.0, 2.0, 3.0, 4.0};
    for (int i = 0, refused = 1; refused; i++) {
        body.material.poisson = 0.2 - 1e-3 * i; /* no table of it is kept */
        OWNED(rb_bem_flexibility) f = {0};
        refused = REFUSED_FROM(i, rb_bem_flexibility_surface(3, ends, &body, &f, &message));
        assert_true(refused || i > 5);
    }
}

int main(void)
{
    gsl_set_error_handler_off();
    return run_all_tests(NULL, NULL);
}
