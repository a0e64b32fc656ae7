/* Singularities subtracted from a condensation (B10).  For each contact element the half-plane's
 * solution of its load, whose logarithm at the ends of the element constant elements resolve
 * badly, is in closed form; boundary elements solve for what it leaves. */
#include "bem/bond.h"
#include "bem/column.h"
#include "bem/complex.h"
#include "bem/subtracted.h"
#include "base/blas.h"
#include "bem/assemble.h"
#include "bem/hierarchical/given.h"
#include "bem/internal.h"
#include "bem/hierarchical/skeleton.h"
#include "bem/strip.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the strip on a contact element leaves for the boundary elements to solve: the
 * tractions and displacements that it causes where others are given. */
struct rb_subtracted {
    const rb_bem_system *s;
    rb_strip *strip;     /* one per contact element */
    rb_element *element; /* the same for the kernels of boundary elements */
    double *bonded;      /* 2 bond->n x 2 contact_n: what the loads leave on a bonded contour;
                            NULL without one */
};

/* The displacement of one load's strip. */
typedef struct {
    const rb_strip *strip;
    double complex load;
} strip_load;

static double complex strip_field(rb_bem_material material, double complex z, const void *context)
{
    const strip_load *l = context;
    const rb_strip strip = rb_strip_in(*l->strip, material);
    return rb_strip_under(rb_strip_displacement(&strip, z), l->load);
}

/* Elements that are looked at together: columns multiplied at once, points of one vector loop; rows
 * of one product. */
enum { BLOCK = RB_STRIP_POINTS, SLICE = 256 };

/* Elements that strips are seen from, at most BLOCK of them: midpoints and outward normals. */
typedef struct {
    int n, element[BLOCK];
    rb_points midpoints;
    double complex outward[BLOCK];
} seen_from;

/* Elements first ... first + n - 1, or of a list those.  RB_ENOMEM; free the midpoints in any case.
 */
static rb_status see_from(const rb_bem_mesh *mesh, const int *list, int first, int n, seen_from *at)
{
    double x[BLOCK], y[BLOCK];

    at->n = n;
    for (int i = 0; i < n; i++) {
        const int k = at->element[i] = list ? list[first + i] : first + i;
        const double complex z = rb_strip_midpoint(mesh, k);
        x[i] = creal(z);
        y[i] = cimag(z);
        at->outward[i] = rb_strip_outward(mesh, k);
    }
    return rb_points_make(n, x, y, &at->midpoints);
}

/* Lam + i Th and q Z of the strip on contact element c at these elements: with such constants they
 * are sums and differences of the columns of H (kernels.h). */
static void look(const rb_subtracted *p, const seen_from *at, int c, double complex view[BLOCK],
                 double complex turned[BLOCK])
{
    static const rb_constants unscaled = {.H_mean = 1.0, .H_dev = 1.0, .H_skew = 1.0};
    double Hx[2 * BLOCK], Hy[2 * BLOCK];

    rb_column_variant_get(0)->fill(&unscaled, &p->element[c], -1, &at->midpoints,
                                   (double *[4]){Hx, Hy, NULL, NULL});
    for (int i = 0; i < at->n; i++) {
        const double *x = Hx + 2 * i, *y = Hy + 2 * i;
        view[i] = complex_of(0.5 * (y[0] - x[1]), 0.5 * (x[0] + y[1]));
        turned[i] = complex_of(0.5 * (x[0] - y[1]), 0.5 * (y[0] + x[1]));
    }
}

/* Boundary values of elements against the strip on contact element c: u_x, u_y (where the
 * displacement is given) or t_x, t_y; value[l]: under its load along x and along y. */
static void left_over(const rb_subtracted *p, const seen_from *at, int c,
                      double value[2][2 * BLOCK])
{
    const rb_bem_mesh *mesh = &p->s->mesh;
    double complex view[BLOCK], turned[BLOCK];
    rb_strip_answer u[BLOCK] = {{0.0, 0.0}};
    /* Displacements cost more than tractions, and are needed only where a support holds the body.
     */
    int held = 0;

    look(p, at, c, view, turned);
    for (int i = 0; i < 2 * at->n; i++)
        held |= mesh->condition[2 * at->element[i / 2] + i % 2] == RB_BEM_DISPLACEMENT;
    if (held)
        rb_strip_displacements(&p->strip[c], at->n, at->midpoints.x, at->midpoints.y, view, u);
    for (int i = 0; i < at->n; i++) {
        const int k = at->element[i], held_x = mesh->condition[2 * k] == RB_BEM_DISPLACEMENT,
                  held_y = mesh->condition[2 * k + 1] == RB_BEM_DISPLACEMENT;
        rb_strip_answer t = {0.0, 0.0};

        /* On a bonded contour the core takes part: what is left over there has been computed
         * once. */
        if (p->bonded && k >= p->s->bond->first) {
            const size_t rows = 2 * (size_t)p->s->bond->n;
            const double *own =
                p->bonded + 2 * (size_t)c * rows + 2 * (size_t)(k - p->s->bond->first);
            for (int l = 0; l < 2; l++)
                memcpy(value[l] + 2 * i, own + (size_t)l * rows, 2 * sizeof *own);
            continue;
        }
        /* On its own element the strip's traction is the load itself, of which nothing is left. */
        if (!(held_x && held_y) && k != mesh->contact_first + c)
            t = rb_strip_traction_of(&p->strip[c], view[i], turned[i], at->outward[i]);
        for (int l = 0; l < 2; l++) {
            const double complex load = l ? I : 1.0;
            value[l][2 * i] = -creal(rb_strip_under(held_x ? u[i] : t, load));
            value[l][2 * i + 1] = -cimag(rb_strip_under(held_y ? u[i] : t, load));
        }
    }
}

/* The strip is one on a half-plane, which has to contain the whole body: the contour must not reach
 * above the line of a contact element. */
rb_status rb_bem_check_convex(const rb_bem_system *s, rb_message *why)
{
    const rb_bem_mesh *mesh = &s->mesh;
    const double size = rb_bem_mesh_size(mesh);

    for (int c = 0; c < mesh->contact_n; c++) {
        const rb_strip strip = rb_strip_on(mesh, mesh->contact_first + c, s->material, size);
        for (int k = 0; k < mesh->n; k++)
            if (rb_strip_depth(&strip, rb_strip_midpoint(mesh, k)) < -1e-12 * size)
                return rb_fail(why, RB_EINVAL,
                               "condensation: element %d lies outside the half-plane of "
                               "contact element %d",
                               k, c);
    }
    return RB_OK;
}

rb_status rb_subtracted_create(const rb_bem_system *s, rb_subtracted **subtracted)
{
    const rb_bem_mesh *mesh = &s->mesh;
    const double unit = rb_bem_mesh_size(mesh);
    rb_subtracted *p = *subtracted = calloc(1, sizeof *p);

    if (!p)
        return RB_ENOMEM;
    *p = (rb_subtracted){s, calloc((size_t)mesh->contact_n, sizeof *p->strip),
                         calloc((size_t)mesh->contact_n, sizeof *p->element), NULL};
    if (!p->strip || !p->element)
        return RB_ENOMEM;
    for (int c = 0; c < mesh->contact_n; c++) {
        const int j = mesh->contact_first + c;
        p->strip[c] = rb_strip_on(mesh, j, s->material, unit);
        p->element[c] = rb_element_make(mesh->x0[j], mesh->y0[j], mesh->x1[j], mesh->y1[j], unit);
    }
    if (!s->bond)
        return RB_OK;
    p->bonded = rb_alloc(2 * (size_t)s->bond->n, 2 * (size_t)mesh->contact_n);
    if (!p->bonded)
        return RB_ENOMEM;
    rb_status status = RB_OK;
    for (int k = 0; k < 2 * s->mesh.contact_n && status == RB_OK; k++) {
        const strip_load load = {&p->strip[k / 2], k % 2 ? I : 1.0};
        status = rb_bond_left_over(s->bond, &s->mesh, s->material, strip_field, &load,
                                   p->bonded + (size_t)k * 2 * (size_t)s->bond->n);
    }
    return status;
}

void rb_subtracted_free(rb_subtracted *p)
{
    if (!p)
        return;
    free(p->strip);
    free(p->element);
    free(p->bonded);
    free(p);
}

/* X (ld x loads) += [G, -H] times what the strips leave at the boundary; R (units x loads): loads
 * that are combinations of unit loads, or NULL: the unit loads themselves. */
static rb_status subtracted_loads_dense(const rb_subtracted *p, int loads, const double *R,
                                        double *X)
{
    const rb_bem_system *s = p->s;
    const int units = 2 * s->mesh.contact_n;
    const rb_bem_condition *condition = s->mesh.condition;
    /* Of a block of elements: columns of [G, -H] for the values that are left over (ld x 2
     * BLOCK), and these (2 BLOCK x units, of loads that are combined x loads). */
    double *columns = rb_alloc((size_t)s->ld, 2 * BLOCK),
           *values = rb_alloc(2 * BLOCK, (size_t)units + (R ? (size_t)loads : 0)),
           *combined = R && values ? values + 2 * BLOCK * (size_t)units : values;
    const int threads = rb_blas_threads(1);
    rb_assembly assembly = {0};
    rb_status status =
        columns && values ? rb_assembly_begin(&s->mesh, s->material, &assembly) : RB_ENOMEM;

    /* X += [G, -H] times the boundary values left over, block by block. All in one parallel region:
     * threads that wait for a product by one of them would spin. */
    for (int from = 0; status == RB_OK && from < s->mesh.n; from += BLOCK) {
        const int to = from + BLOCK < s->mesh.n ? from + BLOCK : s->mesh.n;
        seen_from at;
        status = see_from(&s->mesh, NULL, from, to - from, &at);
        if (status != RB_OK)
            break;
#pragma omp parallel num_threads(rb_blas_loop_threads()) if ((double)(to - from) * s->mesh.n >     \
                                                             rb_pairs_for_threads / 32)
        {
#pragma omp for schedule(static)
            for (int k = from; k < to; k++) {
                double *out[4] = {NULL, NULL, NULL, NULL};
                for (int d = 0; d < 2; d++)
                    out[condition[2 * k + d] == RB_BEM_DISPLACEMENT ? d : 2 + d] =
                        columns + (size_t)(2 * (k - from) + d) * (size_t)s->ld;
                rb_assembly_columns(&assembly, k, 1.0, out);
            }
#pragma omp for schedule(static)
            for (int c = 0; c < s->mesh.contact_n; c++) {
                double value[2][2 * BLOCK];
                left_over(p, &at, c, value);
                for (int l = 0; l < 2; l++)
                    for (int row = 0; row < 2 * at.n; row++) { /* -: of H */
                        const int held = condition[2 * from + row] == RB_BEM_DISPLACEMENT;
                        values[row + (size_t)(2 * c + l) * 2 * BLOCK] =
                            held ? -value[l][row] : value[l][row];
                    }
            }
#pragma omp for schedule(static)
            for (int l = 0; l < (R ? loads : 0); l++)
                cblas_dgemv(CblasColMajor, CblasNoTrans, 2 * (to - from), units, 1.0, values,
                            2 * BLOCK, R + (size_t)l * (size_t)units, 1, 0.0,
                            combined + (size_t)l * 2 * BLOCK, 1);
#pragma omp for schedule(static)
            for (int row = 0; row < s->dofs; row += SLICE)
                cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans,
                            s->dofs - row < SLICE ? s->dofs - row : SLICE, loads, 2 * (to - from),
                            1.0, columns + row, s->ld, combined, 2 * BLOCK, 1.0, X + row, s->ld);
        }
        rb_points_free(&at.midpoints);
    }
    rb_assembly_end(&assembly); /* also where only the points of a block found no memory */
    rb_blas_threads(threads);
    free(columns);
    free(values);
    return status;
}

/* ---- The same on long boundaries, by products of a tree ----------------------------- */

/* Elements near the contact, whose values every load decides by itself, and those far
 * from it, where a few loads stand for all. */
typedef struct {
    int near, far;
    int *element; /* the near ones first */
    int sampled;  /* far elements that tell which loads stand for the others */
    int *sample;
    int kept;        /* so many loads stand for all */
    int *order;      /* loads: these first */
    double *T;       /* kept x others */
    rb_arena memory; /* of the arrays */
} split;

static double distance_from(double complex middle, const rb_bem_mesh *mesh, int k)
{
    return cabs(rb_strip_midpoint(mesh, k) - middle);
}

/* Fields of loads vary over lengths of a part of the distance from them: one element on
 * either side for every twentieth that the distance grows by tells them. */
static rb_status split_elements(const rb_bem_mesh *mesh, split *p)
{
    enum { PARTS = 20, MOST = 2000 };
    const int n = mesh->n, from = mesh->contact_first, to = from + mesh->contact_n - 1;
    const double complex a = mesh->x0[from] + mesh->y0[from] * I,
                         b = mesh->x1[to] + mesh->y1[to] * I, middle = 0.5 * (a + b);
    const double reach = cabs(b - a); /* twice the radius of the contact */
    char taken[2 * MOST] = {0};

    p->element = rb_arena_ints(&p->memory, (size_t)n);
    p->sample = rb_arena_ints(&p->memory, 2 * MOST);
    if (p->memory.failed)
        return RB_ENOMEM;
    for (int k = 0; k < n; k++)
        if (distance_from(middle, mesh, k) < reach)
            p->element[p->near++] = k;
    for (int k = 0; k < n; k++) {
        const double r = distance_from(middle, mesh, k) / reach;
        if (r < 1.0)
            continue;
        const int right = creal(rb_strip_midpoint(mesh, k)) > creal(middle),
                  bin = (int)fmin(PARTS * log(r), MOST - 1);
        p->element[p->near + p->far++] = k;
        if (!taken[2 * bin + right])
            p->sample[p->sampled++] = k;
        taken[2 * bin + right] = 1;
    }
    return RB_OK;
}

/* Which loads stand for all far from the contact: traction times distance over the shear
 * modulus is of the order of a displacement. */
static rb_status choose_loads(const rb_subtracted *p, split *far)
{
    const rb_bem_mesh *mesh = &p->s->mesh;
    const int loads = 2 * mesh->contact_n;
    const double complex middle =
        rb_strip_midpoint(mesh, mesh->contact_first + mesh->contact_n / 2);
    rb_skeleton far_field;
    rb_status s = rb_skeleton_alloc(2 * far->sampled, loads, &far_field);

    if (s != RB_OK)
        return s;
    for (int from = 0; from < far->sampled && s == RB_OK; from += BLOCK) {
        seen_from at;
        s = see_from(mesh, far->sample, from, (int)fmin(BLOCK, far->sampled - from), &at);
        for (int c = 0; c < mesh->contact_n && s == RB_OK; c++) {
            double value[2][2 * BLOCK];
            left_over(p, &at, c, value);
            for (int l = 0; l < 2; l++)
                for (int row = 0; row < 2 * at.n; row++) {
                    const int k = at.element[row / 2];
                    const double over = distance_from(middle, mesh, k) / p->s->material.shear;
                    far_field.K[2 * from + row + (size_t)(2 * c + l) * (size_t)far_field.ld] =
                        value[l][row] *
                        (mesh->condition[2 * k + row % 2] == RB_BEM_DISPLACEMENT ? 1.0 : over);
                }
        }
        rb_points_free(&at.midpoints);
    }
    if (s == RB_OK)
        s = rb_skeleton_reduce(&far_field, 1e-2 * p->s->tolerance, &far->memory, &far->kept,
                               &far->order, &far->T);
    rb_skeleton_free(&far_field);
    return s;
}

/* X += B value of some elements under some loads; load: which; NULL: all. */
static rb_status multiply_values(const rb_subtracted *p, const rb_given *given, int count,
                                 const int *element, int loads, const int *load, double *X)
{
    const size_t rows = 2 * (size_t)count;
    double *value = rb_alloc(rows, (size_t)loads);

    if (!value)
        return RB_ENOMEM;
    rb_status s = RB_OK;
#pragma omp parallel for num_threads(rb_blas_loop_threads()) schedule(static)
    for (int from = 0; from < count; from += BLOCK) {
        seen_from at;
        const rb_status own =
            see_from(&p->s->mesh, element, from, (int)fmin(BLOCK, count - from), &at);
        double both[2][2 * BLOCK];
        for (int l = 0, seen = -1; l < loads && own == RB_OK; l++) {
            const int which = load ? load[l] : l;
            if (which / 2 != seen)
                left_over(p, &at, which / 2, both);
            seen = which / 2;
            memcpy(value + 2 * (size_t)from + (size_t)l * rows, both[which % 2],
                   2 * (size_t)at.n * sizeof *value);
        }
        rb_points_free(&at.midpoints);
        if (own != RB_OK) {
#pragma omp critical
            s = own;
        }
    }
    if (s == RB_OK)
        s = rb_given_multiply(given, count, element, loads, value, X);
    free(value);
    return s;
}

/* Near the contact every load by itself, far away by the few whose fields all others are
 * combinations of (T). */
static rb_status subtracted_loads_long(const rb_subtracted *p, double *X)
{
    const rb_bem_system *s = p->s;
    const int n = s->dofs, loads = 2 * s->mesh.contact_n;
    rb_given *given = NULL;
    split parts = {0};
    double *few = NULL, *rest = NULL;
    rb_status status = split_elements(&s->mesh, &parts);

    if (status == RB_OK)
        status = choose_loads(p, &parts);
    if (status == RB_OK)
        status = rb_given_create(&s->mesh, s->material, s->unit, s->tolerance, &given);
    if (status == RB_OK)
        status = multiply_values(p, given, parts.near, parts.element, loads, NULL, X);
    const int kept = parts.kept, others = loads - kept;
    if (status == RB_OK) {
        few = rb_arena_doubles(&parts.memory, (size_t)n, (size_t)kept);
        rest = rb_arena_doubles(&parts.memory, (size_t)n, (size_t)others + 1);
        status = parts.memory.failed
                     ? RB_ENOMEM
                     : multiply_values(p, given, parts.far, parts.element + parts.near, kept,
                                       parts.order, few);
    }
    if (status == RB_OK && others > 0)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, others, kept, 1.0, few, n,
                    parts.T, kept, 0.0, rest, n);
    for (int l = 0; status == RB_OK && l < loads; l++)
        cblas_daxpy(n, 1.0,
                    l < kept ? few + (size_t)l * (size_t)n : rest + (size_t)(l - kept) * (size_t)n,
                    1, X + (size_t)parts.order[l] * (size_t)n, 1);
    rb_given_free(given);
    return rb_arena_done(&parts.memory, status);
}

rb_status rb_subtracted_loads(const rb_subtracted *p, int loads, const double *R, double *X)
{
    const int units = 2 * p->s->mesh.contact_n;
    const size_t rows = (size_t)p->s->ld;

    /* Dense where there is a matrix A; a tree's products otherwise, of unit loads first. */
    memset(X, 0, rows * (size_t)loads * sizeof *X);
    if (p->s->A)
        return subtracted_loads_dense(p, loads, R, X);
    if (!R)
        return subtracted_loads_long(p, X);
    double *all = rb_alloc(rows, (size_t)units);
    const rb_status status = all ? subtracted_loads_long(p, all) : RB_ENOMEM;
    if (status == RB_OK)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, p->s->dofs, loads, units, 1.0, all,
                    p->s->ld, R, units, 0.0, X, p->s->ld);
    free(all);
    return status;
}

rb_status rb_subtracted_add_strips(const rb_subtracted *p, int loads, const double *R, double *X)
{
    const rb_bem_system *s = p->s;
    const rb_bem_mesh *mesh = &s->mesh;
    const int kept = 2 * (mesh->contact_n + 1), units = 2 * mesh->contact_n;
    double *U = X + s->dofs - kept, *strips = R ? rb_alloc((size_t)kept, (size_t)units) : U;
    const size_t rows = R ? (size_t)kept : (size_t)s->ld;

    if (!strips)
        return RB_ENOMEM;
    rb_status status = RB_OK;
    for (int from = 0; from <= mesh->contact_n && status == RB_OK; from += BLOCK) {
        const int rest = mesh->contact_n + 1 - from;
        double complex view[BLOCK], turned[BLOCK];
        rb_strip_answer answer[BLOCK];
        seen_from at;
        status = see_from(mesh, NULL, mesh->contact_first + from, rest < BLOCK ? rest : BLOCK, &at);
        for (int c = 0; c < mesh->contact_n && status == RB_OK; c++) {
            look(p, &at, c, view, turned);
            rb_strip_displacements(&p->strip[c], at.n, at.midpoints.x, at.midpoints.y, view,
                                   answer);
            for (int l = 0; l < 2; l++)
                for (int i = 0; i < at.n; i++) {
                    const double complex u = rb_strip_under(answer[i], l ? I : 1.0);
                    double *to = strips + 2 * (from + i) + (size_t)(2 * c + l) * rows;
                    to[0] += creal(u);
                    to[1] += cimag(u);
                }
        }
        rb_points_free(&at.midpoints);
    }
    if (R && status == RB_OK)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, kept, loads, units, 1.0, strips,
                    kept, R, units, 1.0, U, s->ld);
    if (R)
        free(strips);
    return status;
}
