/* The cylinder's mesh and its condensation to the contact (B5-B9). */
#include "bem_shapes.h"

#include <lapacke.h>

static const rb_bem_material material = {.shear = 80.0, .poisson = 0.3};
static const rb_bem_cylinder on_arc = {.radius = 50.0, .support = RB_BEM_ARC, .arc = M_PI / 6.0},
                             on_hub = {.radius = 50.0, .support = RB_BEM_HUB, .hub_ratio = 0.3};

/* n_c equal elements over |x| <= a and one more after them */
static double *equal_ends(int n_c, double a)
{
    double *ends = rb_alloc((size_t)n_c + 2, 1);
    for (int i = 0; i < n_c + 2; i++)
        ends[i] = a * (2.0 * i - n_c) / n_c;
    return ends;
}

static rb_bem_mesh mesh_of(const rb_bem_cylinder *cylinder, int n_c, double a)
{
    rb_bem_mesh mesh;
    SCRATCH double *ends = equal_ends(n_c, a);
    CHECK_OK(rb_bem_mesh_cylinder(cylinder, n_c, ends, &mesh, &message));
    return mesh;
}

static rb_bem_flexibility condensed(const rb_bem_cylinder *cylinder, int n_c, double a,
                                    rb_bem_normals normals)
{
    rb_bem_flexibility f;
    held_system *system;
    OWNED(rb_bem_mesh) mesh = mesh_of(cylinder, n_c, a);
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
    CHECK_OK(rb_bem_condense(system, normals, &f, NULL));
    return f;
}

/* ---- The mesh (B7, B9) ------------------------------------------------------------- */

static double element_length(const rb_bem_mesh *mesh, int j)
{
    return hypot(mesh->x1[j] - mesh->x0[j], mesh->y1[j] - mesh->y0[j]);
}

/* Largest ratio of neighbours on the outer circle. */
static double grading(const rb_bem_mesh *mesh)
{
    double worst = 1.0;
    for (int j = 0; j + 1 < mesh->n && mesh->x0[j + 1] == mesh->x1[j]; j++) {
        const double ratio = element_length(mesh, j) / element_length(mesh, j + 1);
        worst = fmax(worst, fmax(ratio, 1.0 / ratio));
    }
    return worst;
}

TEST(neighbours_differ_by_a_fifth_at_most)
{
    for (double a = 0.5; a > 1e-9; a *= 0.1)
        for (int k = 0; k < 8; k++) {
            const rb_bem_cylinder cylinder = {.radius = 1.0,
                                              .support = k < 4 ? RB_BEM_ARC : RB_BEM_HUB,
                                              .arc = 0.1 + 0.4 * k,
                                              .hub_ratio = 0.15 + 0.2 * (k - 4)};
            OWNED(rb_bem_mesh) mesh = mesh_of(&cylinder, 30 + k, a);
            CHECK_OK(rb_bem_mesh_check(&mesh, NULL));
            CHECK_MAX(grading(&mesh), 1.2, "a/R = %g, support %d", a, k);
            CHECK_MAX(mesh.n, 1200, "a/R = %g, support %d", a, k);
        }
}

TEST(the_arc_ends_at_element_ends)
{
    OWNED(rb_bem_mesh) mesh = mesh_of(&on_arc, 40, 2.0);
    double clamped = 0.0;
    for (int j = 0; j < mesh.n; j++) {
        const double angle = fabs(atan2(midpoint_x(&mesh, j), 50.0 - midpoint_y(&mesh, j)));
        const int held = mesh.condition[2 * j] == RB_BEM_DISPLACEMENT;
        assert_int_equal(held, angle > M_PI - on_arc.arc);
        assert_int_equal(mesh.condition[2 * j], mesh.condition[2 * j + 1]);
        clamped += held ? 2.0 * asin(element_length(&mesh, j) / 100.0) : 0.0;
    }
    CHECK_REL(clamped, 2.0 * on_arc.arc, 1e-12, "clamped angle");
}

/* y = x^2/(R + sqrt(R^2 - x^2)) with all digits, at x = 1e-8 R and 1e-10 R apart. */
TEST(small_contacts_keep_their_digits)
{
    OWNED(rb_bem_mesh) mesh = mesh_of(&on_hub, 200, 50.0 * 1e-8);
    for (int j = 0; j <= 200; j++) {
        const double x = mesh.x1[j];
        CHECK_REL(mesh.y1[j], x * x / 100.0, 1e-14, "end %d", j);
        CHECK_REL(mesh.x1[j] - mesh.x0[j], 100.0 * 1e-8 / 200, 1e-11, "length %d", j);
    }
}

/* Not on the hub. */
static int on_circle(const rb_bem_mesh *mesh, int j)
{
    return hypot(mesh->x0[j], mesh->y0[j] - 50.0) > 49.9;
}

/* Ends x, y and condition of element j against those of element k in the mirror x = 0. */
static void check_mirrored(const rb_bem_mesh *mesh, int j, int k, double R)
{
    CHECK_ABS(mesh->x0[j], -mesh->x1[k], 1e-15 * R, "elements %d, %d", j, k);
    CHECK_ABS(mesh->x1[j], -mesh->x0[k], 1e-15 * R, "elements %d, %d", j, k);
    CHECK_ABS(mesh->y0[j], mesh->y1[k], 1e-15 * R, "elements %d, %d", j, k);
    CHECK_ABS(mesh->y1[j], mesh->y0[k], 1e-15 * R, "elements %d, %d", j, k);
    assert_int_equal(mesh->condition[2 * j], mesh->condition[2 * k]);
}

/* Twice as fine is twice the elements, on the hub too, and half of the largest one
 * where that is chosen. */
TEST(refinement_multiplies_what_is_outside)
{
    for (int k = 0; k < 4; k++) {
        rb_bem_cylinder cylinder = k % 2 ? on_arc : on_hub;
        double largest[2] = {0.0, 0.0};
        int outside[2];
        cylinder.outer_elements = k < 2 ? 0 : 80;
        for (int finer = 0; finer < 2; finer++) {
            cylinder.refinement = finer ? 2.0 : 0.0;
            OWNED(rb_bem_mesh) mesh = mesh_of(&cylinder, 40, 1.0);
            outside[finer] = mesh.n - 40;
            for (int j = 0; j < mesh.n; j++)
                largest[finer] =
                    fmax(largest[finer], hypot(mesh.x1[j] - mesh.x0[j], mesh.y1[j] - mesh.y0[j]));
        }
        CHECK_REL(outside[1], 2.0 * outside[0], 0.1, "elements, mesh %d", k);
        if (k < 2)
            CHECK_REL(largest[1], 0.5 * largest[0], 0.15, "largest one, mesh %d", k);
    }
}

TEST(symmetric_ends_make_a_symmetric_mesh)
{
    const int outer[] = {0, 8, 11, 60, 61, 700};
    for (double a = 30.0; a > 1e-6; a *= 0.03)
        for (int k = 0; k < 12; k++) {
            rb_bem_cylinder cylinder = k % 2 ? on_arc : on_hub;
            const int n_c = 20 + k, few = cylinder.support == RB_BEM_HUB ? 40 : 0;
            cylinder.outer_elements = outer[k / 2] == 0 ? 0 : outer[k / 2] + few;
            OWNED(rb_bem_mesh) mesh = mesh_of(&cylinder, n_c, a);
            int circle = 0;
            while (circle < mesh.n && on_circle(&mesh, circle))
                circle++;
            for (int j = 0; j < circle; j++)
                check_mirrored(&mesh, j, (n_c - 1 - j + circle) % circle, 50.0);
            for (int j = circle; j < mesh.n; j++)
                check_mirrored(&mesh, j, mesh.n - 1 - (j - circle), 50.0);
        }
}

/* Contact or not, to the last one; an odd number gets one more to stay symmetric. */
TEST(outer_elements_are_as_many_as_asked_for)
{
    for (int k = 0; k < 2; k++)
        for (int wanted = k ? 8 : 40; wanted < 3000; wanted += 1 + wanted / 3) {
            rb_bem_cylinder cylinder = k ? on_arc : on_hub;
            cylinder.outer_elements = wanted;
            OWNED(rb_bem_mesh) mesh = mesh_of(&cylinder, 100, 0.5);
            int outside = 0;
            for (int j = 100; j < mesh.n; j++)
                outside += on_circle(&mesh, j);
            assert_int_equal(outside, wanted + wanted % 2);
        }
}

TEST(bad_cylinders_are_refused)
{
    const double ends[] = {-1.0, 0.0, 1.0, 2.0}, wide[] = {-1.0, 0.0, 1.0, 50.0},
                 back[] = {-1.0, 0.0, -0.5, 2.0}, most[] = {-49.99, 0.0, 1.0, 49.99};
    const struct {
        rb_bem_cylinder cylinder;
        int n_c;
        const double *ends;
        const char *text;
    } bad[] = {
        {{50, RB_BEM_ARC, 0.5, 0, 0, 0, 0}, 0, ends, "at least 1"},
        {{50, RB_BEM_ARC, 0.5, 0, 0, 0, 0}, 2, back, "increasing"},
        {{0, RB_BEM_ARC, 0.5, 0, 0, 0, 0}, 2, ends, "radius"},
        {{NAN, RB_BEM_ARC, 0.5, 0, 0, 0, 0}, 2, ends, "radius"},
        {{50, RB_BEM_ARC, 0, 0, 0, 0, 0}, 2, ends, "arc"},
        {{50, RB_BEM_ARC, 1.6, 0, 0, 0, 0}, 2, ends, "arc"},
        {{50, RB_BEM_HUB, 0, 1.0, 0, 0, 0}, 2, ends, "hub ratio"},
        {{50, RB_BEM_HUB, 0, 0.0, 0, 0, 0}, 2, ends, "hub ratio"},
        {{50, RB_BEM_HALFPLANE, 0.5, 0.5, 0, 0, 0}, 2, ends, "support"},
        {{50, RB_BEM_ARC, 0.5, 0, 0, 7, 0}, 2, ends, "outer elements"},
        {{50, RB_BEM_HUB, 0, 0.6, 0, 8, 0}, 2, ends, "cut through the hub"},
        {{50, RB_BEM_ARC, 0.5, 0, 0, 2000000, 0}, 2, ends, "million"},
        {{50, RB_BEM_ARC, 0.5, 0, 0, 0, -1.0}, 2, ends, "refinement"},
        {{50, RB_BEM_ARC, 0.5, 0, 0, 0, 0}, 2, wide, "radius of 50"},
        {{50, RB_BEM_ARC, M_PI_2, 0, 0, 0, 0}, 2, most, "clamped arc"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        OWNED(rb_bem_mesh) mesh;
        CHECK_SAYS(rb_bem_mesh_cylinder(&bad[k].cylinder, bad[k].n_c, bad[k].ends, &mesh, &message),
                   RB_EINVAL, bad[k].text);
        assert_null(mesh.x0); /* who is refused owns nothing */
    }
}

/* With the elements beside it the zone reaches at most 95 % of the way to the clamped
 * arc, on either side. */
TEST(the_zone_ends_before_the_clamped_arc)
{
    const rb_bem_cylinder half = {.radius = 50.0, .support = RB_BEM_ARC, .arc = M_PI_2};
    for (int k = 0; k < 4; k++) {
        const double reach = (0.95 + (k % 2 ? 1e-6 : -1e-6)) * M_PI_2, arc = 0.2;
        double ends[5];
        for (int i = 0; i < 5; i++)
            ends[i] = 50.0 * sin(k < 2 ? reach - (4 - i) * arc : -reach + (1 + i) * arc);
        OWNED(rb_bem_mesh) mesh;
        CHECK_STATUS(rb_bem_mesh_cylinder(&half, 3, ends, &mesh, &message),
                     k % 2 ? RB_EINVAL : RB_OK);
        assert_true(k % 2 == (strstr(message.text, "clamped arc of half-angle 1.57") != NULL));
    }
}

typedef void spoil(rb_bem_mesh *mesh);
static void open_contour(rb_bem_mesh *m)
{
    m->x1[m->n - 1] += 1.0;
}
static void gap_inside(rb_bem_mesh *m)
{
    m->y1[20] += 1e-3;
}
static void no_length(rb_bem_mesh *m)
{
    m->x1[27] = m->x0[27];
    m->y1[27] = m->y0[27];
}
static void infinite_value(rb_bem_mesh *m)
{
    m->value[9] = INFINITY;
}
static void contact_elsewhere(rb_bem_mesh *m)
{
    m->condition[40] = RB_BEM_CONTACT;
}
static void contact_given_up(rb_bem_mesh *m)
{
    m->condition[3] = RB_BEM_TRACTION;
}
static void upstream_held(rb_bem_mesh *m)
{
    m->condition[2 * m->contact_n] = RB_BEM_DISPLACEMENT;
}
static void contact_beyond(rb_bem_mesh *m)
{
    m->contact_n = m->n;
}
static void no_elements(rb_bem_mesh *m)
{
    m->n = 0;
}
static void one_element(rb_bem_mesh *m)
{
    m->n = 1;
    m->contact_n = 0;
}
static void clockwise(rb_bem_mesh *m)
{
    for (int j = 0; j < m->n; j++) {
        m->x0[j] = -m->x0[j];
        m->x1[j] = -m->x1[j];
    }
    for (int j = 0; j < 2 * m->n; j++)
        m->condition[j] = RB_BEM_TRACTION;
    m->contact_n = 0;
}
static void contact_backwards(rb_bem_mesh *m)
{
    m->x0[2] = m->x1[2] + 1.0;
}

TEST(spoilt_meshes_are_refused)
{
    const struct {
        spoil *how;
        const char *text;
    } bad[] = {{open_contour, "does not close"},
               {one_element, "outside the contact"},
               {gap_inside, "element 20 ends"},
               {no_length, "element 27: length"},
               {infinite_value, "element 4: given"},
               {contact_elsewhere, "element 20"},
               {contact_given_up, "element 1: in contact"},
               {upstream_held, "is not free"},
               {contact_beyond, "contact elements"},
               {no_elements, "0 elements"},
               {clockwise, "left of its contours"},
               {contact_backwards, "element 2 does not run"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        OWNED(rb_bem_mesh) mesh = mesh_of(&on_arc, 10, 2.0);
        const int n = mesh.n;
        bad[k].how(&mesh);
        CHECK_SAYS(rb_bem_mesh_check(&mesh, &message), RB_EINVAL, bad[k].text);
        mesh.n = n;
    }
    rb_bem_mesh mesh;
    CHECK_STATUS(rb_bem_mesh_alloc(0, &mesh), RB_EINVAL);
    rb_bem_mesh_free(NULL);
}

/* ---- The paper's Schur complement (20)-(24), r = +C t_c (B5) ----------------------- */

/* B <- A^-1 B */
static void divide(int n, int columns, double *A, double *B)
{
    lapack_int *pivot = calloc((size_t)n, sizeof *pivot);
    assert_int_equal(LAPACKE_dgesv(LAPACK_COL_MAJOR, n, columns, A, n, pivot, B, n), 0);
    free(pivot);
}

/* rows x cols block of A (leading dimension ld) at (row, col), copied */
static double *block(const double *A, int ld, int row, int col, int rows, int cols)
{
    double *B = rb_alloc((size_t)rows, (size_t)cols);
    for (int j = 0; j < cols; j++)
        for (int i = 0; i < rows; i++)
            B[i + j * rows] = A[row + i + (size_t)(col + j) * (size_t)ld];
    return B;
}

/* C -= A B */
static void subtract_product(int m, int n, int k, const double *A, const double *B, double *C)
{
    for (int j = 0; j < n; j++)
        for (int l = 0; l < k; l++)
            for (int i = 0; i < m; i++)
                C[i + j * m] -= A[i + l * m] * B[l + j * k];
}

/* Rows of C_i: inward normal and tangent of element i. */
static void frame(const rb_bem_mesh *mesh, int i, rb_bem_normals normals, double C[2][2])
{
    const double dx = mesh->x1[i] - mesh->x0[i], dy = mesh->y1[i] - mesh->y0[i];
    const double phi = normals == RB_BEM_NORMALS_SURFACE ? atan2(dy, dx) : 0.0;
    C[0][0] = -sin(phi);
    C[0][1] = cos(phi);
    C[1][0] = cos(phi);
    C[1][1] = sin(phi);
}

/* Contact dofs first (c), all others (f) after them; H holds the unknowns' columns, the
 * right-hand side b the given tractions' part, G the contact tractions' columns. */
typedef struct {
    int c, f;
    double *H, *G, *b;
} partition;

static partition partition_of(const rb_bem_mesh *mesh)
{
    const int dofs = 2 * mesh->n, c = 2 * mesh->contact_n;
    partition p = {c, dofs - c, rb_alloc((size_t)dofs, (size_t)dofs),
                   rb_alloc((size_t)dofs, (size_t)dofs), rb_alloc((size_t)dofs, 1)};
    CHECK_OK(rb_bem_assemble(mesh, material, p.H, p.G, dofs, NULL));
    for (int j = 0; j < dofs; j++)
        for (int i = 0; i < dofs; i++) {
            const int at = i + j * dofs;
            if (mesh->condition[j] == RB_BEM_DISPLACEMENT)
                p.H[at] = -p.G[at]; /* held at 0 */
            else if (mesh->condition[j] == RB_BEM_TRACTION)
                p.b[i] += p.G[at] * mesh->value[j];
        }
    return p;
}

static void check_schur(rb_bem_normals normals)
{
    rb_bem_cylinder small = on_arc;
    small.outer_elements = 24;
    enum { n_c = 5 };
    OWNED(rb_bem_mesh) mesh = mesh_of(&small, n_c, 12.0);
    give(&mesh, 9, RB_BEM_TRACTION, 1.0, -2.0);
    const partition p = partition_of(&mesh);
    const int dofs = p.c + p.f;
    double *Hcc = block(p.H, dofs, 0, 0, p.c, p.c), *Hcf = block(p.H, dofs, 0, p.c, p.c, p.f);
    double *Hff = block(p.H, dofs, p.c, p.c, p.f, p.f);
    /* right-hand sides of H_ff: [H_fc  G_fc  f_f], then of the complement */
    double *Xf = rb_alloc((size_t)p.f, 2 * (size_t)p.c + 1),
           *Xc = rb_alloc((size_t)p.c, (size_t)p.c + 1);
    for (int j = 0; j < p.c; j++) {
        memcpy(Xf + j * p.f, p.H + j * dofs + p.c, (size_t)p.f * sizeof *Xf);
        memcpy(Xf + (p.c + j) * p.f, p.G + j * dofs + p.c, (size_t)p.f * sizeof *Xf);
        memcpy(Xc + j * p.c, p.G + j * dofs, (size_t)p.c * sizeof *Xc);
    }
    memcpy(Xf + 2 * p.c * p.f, p.b + p.c, (size_t)p.f * sizeof *Xf);
    memcpy(Xc + p.c * p.c, p.b, (size_t)p.c * sizeof *Xc);
    divide(p.f, 2 * p.c + 1, Hff, Xf);
    subtract_product(p.c, p.c, p.f, Hcf, Xf, Hcc);
    subtract_product(p.c, p.c + 1, p.f, Hcf, Xf + p.c * p.f, Xc);
    divide(p.c, p.c + 1, Hcc, Xc); /* u_c = Xc (t_c, 1) */

    held_system *system;
    OWNED(rb_bem_flexibility) f;
    double F[4 * (n_c + 1) * n_c], C[2][2], D[2][2];
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
    CHECK_OK(rb_bem_condense(system, normals, &f, NULL));
    CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * f.m));
    const double scale = rb_norm_inf(4 * (n_c + 1) * n_c, F), scale0 = rb_norm_inf(12, f.w0);
    for (int i = 0; i < n_c; i++)
        for (int a = 0; a < 2; a++) {
            frame(&mesh, i, normals, C);
            const double *u0 = Xc + p.c * p.c + 2 * i;
            CHECK_ABS(f.w0[a * f.m + i], C[a][0] * u0[0] + C[a][1] * u0[1], 1e-10 * scale0,
                      "w0 %d %d", a, i);
            for (int j = 0; j < n_c; j++)
                for (int b = 0; b < 2; b++) {
                    double want = 0.0;
                    frame(&mesh, j, normals, D);
                    for (int k = 0; k < 2; k++)
                        for (int l = 0; l < 2; l++)
                            want += C[a][k] * Xc[2 * i + k + (2 * j + l) * p.c] * D[b][l];
                    CHECK_ABS(F[a * f.m + i + 2 * f.m * (b * n_c + j)], want, 1e-10 * scale,
                              "F %d%d(%d, %d)", a, b, i, j);
                }
        }
    double *all[] = {p.H, p.G, p.b, Hcc, Hcf, Hff, Xf, Xc};
    for (int k = 0; k < 8; k++)
        free(all[k]);
}

TEST(flexibility_is_the_papers_schur_complement)
{
    check_schur(RB_BEM_NORMALS_OBSTACLE);
    check_schur(RB_BEM_NORMALS_SURFACE);
}

/* The upstream row and w0 agree with full solutions of the system. */
TEST(every_row_is_a_displacement_of_the_full_solution)
{
    enum { n_c = 6 };
    OWNED(rb_bem_mesh) mesh = mesh_of(&on_hub, n_c, 5.0);
    give(&mesh, 30, RB_BEM_TRACTION, 1.0, 3.0);
    held_system *system;
    OWNED(rb_bem_flexibility) f;
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
    CHECK_OK(rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, NULL));
    double r[2 * n_c], t_c[2 * n_c], w[2 * (n_c + 1)];
    SCRATCH double *u = rb_alloc(2 * (size_t)mesh.n, 1), *t = rb_alloc(2 * (size_t)mesh.n, 1);
    for (int i = 0; i < n_c; i++) {
        t_c[2 * i + 1] = r[i] = 1.0 + i;
        t_c[2 * i] = r[n_c + i] = 0.3 - 0.1 * i;
    }
    rb_bem_flexibility_apply(&f, r, w);
    CHECK_OK(rb_bem_system_solve(system, t_c, u, t));
    for (int i = 0; i <= n_c; i++) {
        CHECK_REL(w[i] + f.w0[i], u[2 * i + 1], 1e-11, "w_N %d", i);
        CHECK_ABS(w[n_c + 1 + i] + f.w0[n_c + 1 + i], u[2 * i], 1e-11 * fabs(u[1]), "w_T %d", i);
        CHECK_REL(f.x[i], midpoint_x(&mesh, i), 1e-15, "x %d", i);
        CHECK_REL(f.h[i], element_length(&mesh, i), 1e-15, "h %d", i);
    }
}

/* ---- Symmetry, block by block ------------------------------------------------------ */

/* max |F_ab(i,j) - F_ba(j,i)| over max |F_ab|, i, j in the contact */
static double asymmetry(const rb_bem_flexibility *f, int a, int b)
{
    const int n = f->n, m = f->m;
    double *F = rb_alloc(2 * (size_t)m, 2 * (size_t)n), worst = 0.0, largest = 0.0;
    CHECK_OK(rb_bem_flexibility_matrix(f, F, 2 * m));
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const double here = F[a * m + i + 2 * m * (b * n + j)],
                         there = F[b * m + j + 2 * m * (a * n + i)];
            worst = fmax(worst, fabs(here - there));
            largest = fmax(largest, fabs(here));
        }
    free(F);
    return worst / largest;
}

/* At n_c = 40, a/R = 1e-3: diagonal blocks below 4e-4, coupling 2.5 % of its own maximum,
 * which is 2 % of theirs. */
TEST(flexibility_is_symmetric_up_to_discretisation)
{
    const rb_bem_cylinder *bodies[] = {&on_arc, &on_hub};
    for (int k = 0; k < 2; k++) {
        OWNED(rb_bem_flexibility)
        f = condensed(bodies[k], 40, 0.05, RB_BEM_NORMALS_OBSTACLE);
        CHECK_MAX(asymmetry(&f, 0, 0), 4e-4, "NN, body %d", k);
        CHECK_MAX(asymmetry(&f, 1, 1), 4e-4, "TT, body %d", k);
        CHECK_MAX(asymmetry(&f, 0, 1), 2.5e-2, "NT, body %d", k);
        CHECK_MAX(asymmetry(&f, 1, 0), 2.5e-2, "TN, body %d", k);
    }
}

/* ---- The half-plane limit ---------------------------------------------------------- */

/* Hertz's pressure and a friction of the same shape on |x| <= a; largest difference of
 * the displacements against those of the half-plane, both less their mean, over their
 * range. */
static double halfplane_difference(const rb_bem_cylinder *cylinder, int n_c, double a, int friction)
{
    OWNED(rb_bem_flexibility)
    wheel = condensed(cylinder, n_c, a, RB_BEM_NORMALS_OBSTACLE), plane;
    double *ends = equal_ends(n_c, a), *r = rb_alloc(2 * (size_t)n_c, 1),
           *w = rb_alloc(4 * (size_t)wheel.m, 1), *v = w + 2 * wheel.m;
    CHECK_OK(rb_bem_flexibility_surface(n_c, ends, HALFPLANE(material, 50.0), &plane, NULL));
    for (int i = 0; i < n_c; i++)
        r[friction * n_c + i] = sqrt(1.0 - pow(wheel.x[i] / a, 2));
    rb_bem_flexibility_apply(&wheel, r, w);
    rb_bem_flexibility_apply(&plane, r, v);
    double worst = 0.0, low = INFINITY, high = -INFINITY;
    for (int c = 0; c < 2; c++) {
        const double *x = w + c * wheel.m, *y = v + c * wheel.m;
        double mean = 0.0;
        for (int i = 0; i < wheel.m; i++)
            mean += (x[i] - y[i]) / wheel.m;
        for (int i = 0; i < wheel.m; i++) {
            worst = fmax(worst, fabs(x[i] - y[i] - mean));
            low = fmin(low, y[i] - (c == friction ? v[c * wheel.m] : 0.0));
            high = fmax(high, y[i] - (c == friction ? v[c * wheel.m] : 0.0));
        }
    }
    free(ends);
    free(r);
    free(w);
    return worst / (high - low);
}

/* First order in the element at a/R = 1e-8, with nothing left of the wheel or its
 * support; at 100 elements the wheel's own share is below this from a/R = 1e-4 on. */
TEST(small_contacts_are_on_a_half_plane)
{
    const rb_bem_cylinder *bodies[] = {&on_arc, &on_hub};
    for (int k = 0; k < 2; k++)
        for (int friction = 0; friction < 2; friction++) {
            const double coarse = halfplane_difference(bodies[k], 25, 5e-7, friction),
                         fine = halfplane_difference(bodies[k], 50, 5e-7, friction),
                         finest = halfplane_difference(bodies[k], 100, 5e-7, friction);
            print_errors("half-plane", coarse, fine, finest, 2.0);
            CHECK_MAX(finest, 1.7e-3, "body %d, friction %d", k, friction);
            CHECK_ABS(order(coarse, fine), 1.1, 0.1, "order, body %d, %d", k, friction);
            CHECK_ABS(order(fine, finest), 1.1, 0.1, "order, body %d, %d", k, friction);
            CHECK_MAX(halfplane_difference(bodies[k], 100, 5e-3, friction), 1.8e-3,
                      "a/R = 1e-4, body %d, friction %d", k, friction);
        }
}

/* The wheel's share of the difference falls with a/R (normal load, 100 elements). */
TEST(the_wheel_shows_less_and_less)
{
    const double limit = halfplane_difference(&on_hub, 100, 5e-7, 0);
    const double large = halfplane_difference(&on_hub, 100, 5.0, 0) - limit,
                 middle = halfplane_difference(&on_hub, 100, 0.5, 0) - limit,
                 small = halfplane_difference(&on_hub, 100, 0.05, 0) - limit;
    print_message("what a wheel adds: %.3e, %.3e, %.3e\n", large, middle, small);
    CHECK_ABS(large / middle, 10.0, 1.0, "a/R = 0.1 and 0.01");
    CHECK_ABS(middle / small, 10.0, 1.0, "a/R = 0.01 and 0.001");
}

/* ---- Loads and approach ------------------------------------------------------------ */

/* Another end of an element becomes the widest of the circle within these radii. */
TEST(flexibilities_are_smooth_in_the_radius)
{
    enum { n = 30, radii = 12, order = 4 };
    double *F[order] = {NULL}, largest = 0.0, third = 0.0;

    for (int i = 0; i < radii; i++) {
        const rb_bem_cylinder cylinder = {.radius = 50.6 + 0.025 * i,
                                          .support = RB_BEM_ARC,
                                          .arc = M_PI / 36.0,
                                          .outer_elements = 40};
        OWNED(rb_bem_flexibility) f = condensed(&cylinder, n, 0.25, RB_BEM_NORMALS_OBSTACLE);
        const size_t size = 4 * (size_t)f.m * n;
        double *now = F[i % order];
        const double *a = F[(i + 1) % order], *b = F[(i + 2) % order], *c = F[(i + 3) % order];
        if (!now)
            now = F[i % order] = rb_alloc(size, 1);
        memcpy(now, f.data, size * sizeof *now);
        for (size_t j = 0; j < size && i >= order - 1; j++) {
            largest = fmax(largest, fabs(now[j]));
            third = fmax(third, fabs(now[j] - 3.0 * c[j] + 3.0 * b[j] - a[j]));
        }
    }
    CHECK_MAX(third / largest, 1e-9, "third differences");
    for (int i = 0; i < order; i++)
        free(F[i]);
}

/* w = F r of a wheel with 12 contact elements; of: the radius, the hub or arc, or Poisson's ratio
 * is larger by this part of itself. */
enum { LOADED = 12, LOADED_M = LOADED + 1 };

static rb_bem_material loaded_wheel(int on_the_hub, int of, double part, rb_bem_mesh *mesh)
{
    rb_bem_cylinder wheel = on_the_hub ? on_hub : on_arc;
    rb_bem_material m = material;
    SCRATCH double *ends = equal_ends(LOADED, 4.0);

    wheel.outer_elements = 40;
    *(of == 0      ? &wheel.radius
      : of == 2    ? &m.poisson
      : on_the_hub ? &wheel.hub_ratio
                   : &wheel.arc) *= 1.0 + part;
    CHECK_OK(rb_bem_mesh_cylinder(&wheel, LOADED, ends, mesh, &message));
    return m;
}

static void loaded_displacement(const rb_bem_mesh *mesh, rb_bem_material m, int subtracted,
                                rb_bem_normals normals, const double *r, double *w)
{
    held_system *system;
    OWNED(rb_bem_flexibility) f = {0};

    CHECK_OK(rb_bem_system_create(mesh, m, &system, NULL));
    CHECK_OK(
        (subtracted ? rb_bem_condense_subtracted : rb_bem_condense)(system, normals, &f, NULL));
    rb_bem_flexibility_apply(&f, r, w);
}

/* (B13) against differences of flexibilities, whose fourth-order error is 1e-12. */
TEST(displacements_change_as_flexibilities_do)
{
    static const int place[] = {-2, -1, 1, 2};
    static const double weight[] = {1 / 12., -8 / 12., 8 / 12., -1 / 12.}, step = 1e-3;
    double r[2 * LOADED];

    for (int i = 0; i < LOADED; i++) {
        r[i] = 1.0 + 0.1 * i;
        r[LOADED + i] = 0.3 - 0.05 * i;
    }
    for (int k = 0; k < 12; k++) {
        const int on_the_hub = k % 2, of = k / 2 % 3, subtracted = k / 6;
        const rb_bem_normals normals = k % 4 ? RB_BEM_NORMALS_OBSTACLE : RB_BEM_NORMALS_SURFACE;
        double got[2 * LOADED_M] = {0.0}, want[2 * LOADED_M] = {0.0}, w[2 * LOADED_M],
                       largest = 0.0, off = 0.0;
        held_system *system;
        rb_bem_loaded *loaded;
        OWNED(rb_bem_mesh) mesh = {0};
        const rb_bem_material m = loaded_wheel(on_the_hub, of, 0.0, &mesh);

        CHECK_OK(rb_bem_system_create(&mesh, m, &system, NULL));
        CHECK_OK(rb_bem_loaded_create(system, normals, subtracted, r, &loaded, NULL));
        for (int j = 0; j < 4; j++) {
            OWNED(rb_bem_mesh) other = {0};
            const rb_bem_material n = loaded_wheel(on_the_hub, of, place[j] * step, &other);
            CHECK_OK(rb_bem_loaded_change(loaded, &other, n, w));
            for (int i = 0; i < 2 * LOADED_M; i++)
                got[i] += weight[j] / step * w[i];
            loaded_displacement(&other, n, subtracted, normals, r, w);
            for (int i = 0; i < 2 * LOADED_M; i++)
                want[i] += weight[j] / step * w[i];
        }
        rb_bem_loaded_free(loaded);
        for (int i = 0; i < 2 * LOADED_M; i++) {
            largest = fmax(largest, fabs(want[i]));
            off = fmax(off, fabs(got[i] - want[i]));
        }
        CHECK_MAX(off, 1e-9 * largest, "case %d", k);
    }
}

/* (reaction at the support + load)/load of a uniform pressure on the contact */
static double balance(const rb_bem_cylinder *cylinder, int n_c, int outer)
{
    rb_bem_cylinder wheel = *cylinder;
    wheel.outer_elements = outer;
    OWNED(rb_bem_mesh) mesh = mesh_of(&wheel, n_c, 5.0);
    held_system *system;
    SCRATCH double *u = rb_alloc(2 * (size_t)mesh.n, 1), *t = rb_alloc(2 * (size_t)mesh.n, 1);
    double *pressure = rb_alloc(2 * (size_t)n_c, 1), load = 0.0, sum = 0.0;
    for (int i = 0; i < n_c; i++)
        pressure[2 * i + 1] = 1.0;
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
    CHECK_OK(rb_bem_system_solve(system, pressure, u, t));
    for (int j = 0; j < mesh.n; j++) {
        sum += t[2 * j + 1] * element_length(&mesh, j);
        load += j < n_c ? element_length(&mesh, j) : 0.0;
    }
    free(pressure);
    return sum / load;
}

TEST(the_support_carries_the_load)
{
    const rb_bem_cylinder *bodies[] = {&on_arc, &on_hub};
    for (int k = 0; k < 2; k++) {
        const double coarse = fabs(balance(bodies[k], 20, 80)),
                     fine = fabs(balance(bodies[k], 40, 160)),
                     finest = fabs(balance(bodies[k], 80, 320));
        print_errors("balance", coarse, fine, finest, 2.0);
        CHECK_MAX(finest, 3e-4, "balance, body %d", k);
        CHECK_MAX(1.0, order(coarse, fine), "order of the balance, body %d", k);
        CHECK_MAX(1.0, order(fine, finest), "order of the balance, body %d", k);
    }
}

/* Half-plane with the datum 2R/e under Hertz's pressure, and (below) the disc itself:
 * delta = P (1-nu^2)/(pi E) [2 ln(4R/a) - 1]. */
static double compression(double P, double R, double a)
{
    const double nu = material.poisson, E = 2.0 * material.shear * (1.0 + nu);
    return P * (1.0 - nu * nu) / (M_PI * E) * (2.0 * log(4.0 * R / a) - 1.0);
}

/* mean of sqrt(1 - x^2) over [x, y] within [-1, 1] */
static double hertz_mean(double x, double y)
{
    return 0.5 * (y * sqrt(fmax(0, 1 - y * y)) + asin(y) - x * sqrt(fmax(0, 1 - x * x)) - asin(x)) /
           (y - x);
}

TEST(the_default_datum_is_the_half_cylinder)
{
    enum { n = 200 };
    const double R = 50.0, a = 0.1;
    double *ends = equal_ends(n, a), r[2 * n] = {0}, w[2 * (n + 1)];
    OWNED(rb_bem_flexibility) f;
    CHECK_OK(rb_bem_flexibility_surface(n, ends, HALFPLANE(material, 2.0 * R / M_E), &f, NULL));
    for (int i = 0; i < n; i++)
        r[i] = hertz_mean(ends[i] / a, fmin(1.0, ends[i + 1] / a));
    rb_bem_flexibility_apply(&f, r, w);
    CHECK_REL(w[n / 2], compression(M_PI_2 * a, R, a), 1e-4, "compression");
    free(ends);
}

/* A disc pressed at its bottom and top, elements graded like sinh from both: m (odd)
 * elements on each half; the central ones carry Hertz's pressure over half-width a. */
static double disc_compression_error(int m, double a)
{
    const double k = 9.0;
    OWNED(rb_bem_mesh) mesh;
    CHECK_OK(rb_bem_mesh_alloc(2 * m, &mesh));
    for (int j = 0; j < 2 * m; j++)
        for (int end = 0; end < 2; end++) {
            const int e = (j + end) % (2 * m), top = e >= m;
            const double s = 2.0 * (e % m) / m - 1.0, angle = M_PI_2 * sinh(k * s) / sinh(k),
                         sign = top ? -1.0 : 1.0;
            double *x = end ? mesh.x1 : mesh.x0, *y = end ? mesh.y1 : mesh.y0;
            x[j] = sign * sin(angle);
            y[j] = sign * 2.0 * pow(sin(0.5 * angle), 2) + (top ? 2.0 : 0.0);
        }
    for (int j = 0; j < 2 * m; j++) {
        const double low = fmax(-1.0, fmin(mesh.x0[j], mesh.x1[j]) / a),
                     high = fmin(1.0, fmax(mesh.x0[j], mesh.x1[j]) / a);
        if (low < high) /* the pressed share of the element */
            mesh.value[2 * j + 1] = (j < m ? 1.0 : -1.0) * hertz_mean(low, high) * (high - low) *
                                    a / fabs(mesh.x1[j] - mesh.x0[j]);
    }
    mesh.condition[2 * (m / 2)] = mesh.condition[2 * (m + m / 2)] = RB_BEM_DISPLACEMENT;
    mesh.condition[2 * (m / 4) + 1] = RB_BEM_DISPLACEMENT; /* unloaded: only the rigid motion */
    held_system *system;
    SCRATCH double *u = rb_alloc(4 * (size_t)m, 1), *t = rb_alloc(4 * (size_t)m, 1);
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
    CHECK_OK(rb_bem_system_solve(system, NULL, u, t));
    const double delta = 0.5 * (u[2 * (m / 2) + 1] - u[2 * (m + m / 2) + 1]);
    return fabs(delta / compression(M_PI_2 * a, 1.0, a) - 1.0);
}

TEST(the_disc_is_compressed_as_two_half_cylinders)
{
    const double coarse = disc_compression_error(101, 0.01),
                 fine = disc_compression_error(201, 0.01),
                 finest = disc_compression_error(401, 0.01);
    print_errors("compression", coarse, fine, finest, 2.0);
    CHECK_MAX(finest, 6.5e-4, "compression on 802 elements");
    CHECK_ABS(order(coarse, fine), 1.1, 0.1, "order");
    CHECK_ABS(order(fine, finest), 1.1, 0.1, "order");
}

/* A memory that is over at once makes a wheel on a rigid hub twice as soft: what it adds
 * in closed form is what the boundary elements of the same wheel have given, but for the
 * error of constant elements beside the load and of their coupling. */
TEST(memory_without_length_doubles_the_flexibility)
{
    enum { n = 8, m = n + 1 };
    static const double ratio[] = {0.25, 0.75}, length[] = {1e-9, 1e-8};
    double ends[n + 2], F[4 * m * n], soft[4 * m * n], most = 0.0;

    for (int i = 0; i < n + 2; i++)
        ends[i] = 0.5 * (i - n / 2);
    const rb_bem_cylinder cylinder = {
        .radius = 50.0, .support = RB_BEM_HUB, .hub_ratio = 0.5, .outer_elements = 200};
    const rb_bem_material steel = {.shear = 82000.0, .poisson = 0.28};
    const rb_bem_wheel wheel = {.radius = 50.0,
                                .inner = 25.0,
                                .material = steel,
                                .terms = 2,
                                .ratio = ratio,
                                .length = length};
    OWNED(rb_bem_mesh) mesh;
    held_system *system;
    OWNED(rb_bem_flexibility) f;
    CHECK_OK(rb_bem_mesh_cylinder(&cylinder, n, ends, &mesh, NULL));
    CHECK_OK(rb_bem_system_create(&mesh, steel, &system, NULL));
    CHECK_OK(rb_bem_condense(system, RB_BEM_NORMALS_SURFACE, &f, NULL));
    CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * m));
    CHECK_OK(rb_bem_flexibility_add_memory(&wheel, RB_BEM_NORMALS_SURFACE, ends, &f, NULL));
    CHECK_OK(rb_bem_flexibility_matrix(&f, soft, 2 * m));
    for (int k = 0; k < 4 * m * n; k++)
        most = fmax(most, fabs(F[k]));
    for (int k = 0; k < 4 * m * n; k++) {
        const int row = k % (2 * m), column = k / (2 * m), apart = abs(row % m - column % n);
        const int is_coupling = row / m != column / n;
        CHECK_ABS(soft[k], 2.0 * F[k], (apart < 2 || is_coupling ? 0.02 : 1e-3) * most,
                  "row %d, column %d", row, column);
    }
}

RUN_TESTS(NULL, NULL)
