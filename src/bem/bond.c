/* The core under a cover (B11): its flexibility, what it adds to the system, what it leaves over.
 */
#include "bem/bond.h"

#include "bem/internal.h"
#include "bem/strip.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>

void rb_bond_free(rb_bond *bond)
{
    if (!bond)
        return;
    rb_bem_mesh_free(&bond->core);
    free(bond->C);
    free(bond);
}

/* Element of the core's mesh that is element i of the interface in the cover's order. */
static int in_core(const rb_bond *bond, int i)
{
    return i < bond->n ? bond->n - 1 - i : i;
}

rb_status rb_bond_create(const rb_bem_mesh *cover, const rb_bem_mesh *core,
                         rb_bem_material material, rb_bond **bond, rb_message *why)
{
    const size_t rows = 2 * (size_t)core->n;
    const double tolerance = 1e-9 * rb_bem_mesh_size(cover);
    rb_bond *b = calloc(1, sizeof *b);
    rb_bem_system *system = NULL;
    rb_assembly assembly;
    double *X = NULL;
    int hub_n = 0;

    *bond = NULL;
    for (int j = 0; j < core->n; j++)
        hub_n += core->condition[2 * j] == RB_BEM_DISPLACEMENT;
    rb_status s = b ? rb_bem_mesh_copy(core, &b->core) : RB_ENOMEM;
    if (s == RB_OK) {
        b->n = core->n - hub_n;
        b->hub_n = hub_n;
        b->first = cover->n - b->n;
        b->material = material;
        b->C = rb_alloc(2 * (size_t)b->n, rows);
        b->W = b->C ? b->C + 4 * (size_t)b->n * (size_t)b->n : NULL;
        X = rb_alloc(rows, rows);
        s = b->C && X ? RB_OK : RB_ENOMEM;
    }
    /* The cover's own inner contour is the core's outer one, run backwards. */
    for (int i = 0; s == RB_OK && i < b->n; i++) {
        const int j = b->first + i, k = in_core(b, i);
        const double apart = hypot(cover->x0[j] - core->x1[k], cover->y0[j] - core->y1[k]);
        if (!(apart <= tolerance))
            s = rb_fail(why, RB_EINVAL,
                        "bond: element %d of the cover is not element %d of the core", j, k);
    }
    /* One solve with a right-hand side for every dof of the core's boundary: G of the
     * interface, -H of the hub. */
    if (s == RB_OK)
        s = rb_bem_system_create_as(&b->core, material, 1, &system, why);
    if (s == RB_OK)
        s = rb_assembly_begin(&b->core, material, &assembly);
    if (s == RB_OK) {
        for (int j = 0; j < core->n; j++) {
            double *x = X + 2 * (size_t)j * rows, *y = x + rows;
            const int hub = j >= b->n;
            rb_assembly_columns(
                &assembly, j, 1.0,
                (double *const[4]){hub ? x : NULL, hub ? y : NULL, hub ? NULL : x, hub ? NULL : y});
            for (size_t i = 0; hub && i < 2 * rows; i++)
                x[i] = -x[i];
        }
        rb_assembly_end(&assembly);
        s = rb_bem_system_solve_columns(system, (int)rows, X);
    }
    /* The rows of the interface in the cover's order; the cover's traction is the opposite
     * of the core's, so that a positive C answers it with -C t. */
    for (int j = 0; s == RB_OK && j < core->n; j++)
        for (int k = 0; k < 2; k++) {
            const double *from = X + (size_t)(2 * in_core(b, j) + k) * rows;
            double *to = b->C + (size_t)(2 * j + k) * 2 * (size_t)b->n;
            for (int i = 0; i < b->n; i++)
                for (int a = 0; a < 2; a++)
                    to[2 * i + a] = from[2 * in_core(b, i) + a];
        }
    rb_bem_system_free(system);
    free(X);
    if (s == RB_OK)
        *bond = b;
    else
        rb_bond_free(b);
    return s;
}

rb_status rb_bond_add(rb_bem_system *s, const rb_assembly *assembly)
{
    const rb_bond *bond = s->bond;
    const size_t rows = (size_t)s->dofs, columns = 2 * (size_t)bond->n;
    double *H = rb_alloc(rows, columns), *C = rb_alloc(columns, columns);

    if (H && C) {
        for (int i = 0; i < bond->n; i++) {
            double *x = H + 2 * (size_t)i * rows;
            rb_assembly_columns(assembly, bond->first + i, 1.0,
                                (double *const[4]){x, x + rows, NULL, NULL});
        }
        for (size_t k = 0; k < columns * columns; k++)
            C[k] = bond->C[k] * s->unit[(size_t)bond->first + k / columns / 2];
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, s->dofs, 2 * bond->n, 2 * bond->n,
                    -1.0, H, s->dofs, C, 2 * bond->n, 1.0, rb_bem_system_column(s, 2 * bond->first),
                    s->ld);
    }
    const rb_status status = H && C ? RB_OK : RB_ENOMEM;
    free(C);
    free(H);
    return status;
}

/* An incompressible cover does not tell how its core is pressed all around. */
rb_status rb_bem_system_create_bonded(const rb_bem_mesh *cover, rb_bem_material material,
                                      const rb_bem_mesh *core, rb_bem_material core_material,
                                      rb_bem_system **system, rb_message *why)
{
    rb_bond *bond = NULL;
    *system = NULL;
    rb_status s = rb_bem_mesh_check(cover, why);
    if (s == RB_OK && rb_bem_is_incompressible(material))
        s = rb_fail(why, RB_EINVAL,
                    "cover on an elastic core: expected Poisson's ratio below 1/2, got %g",
                    material.poisson);
    if (s == RB_OK)
        s = rb_bem_material_check(core_material, why);
    if (s == RB_OK)
        s = rb_bond_create(cover, core, core_material, &bond, why);
    return s == RB_OK ? rb_bem_system_make(cover, material, 1, INFINITY, bond, system, why) : s;
}

/* value = u of the strips in the core - in the cover, - W u of the strips on the hub. */
rb_status rb_bond_left_over(const rb_bond *bond, const rb_bem_mesh *cover, rb_bem_material material,
                            rb_bond_field *field, const void *context, double *value)
{
    double *hub = rb_alloc(2 * (size_t)bond->hub_n, 1);

    if (!hub)
        return RB_ENOMEM;
    for (int k = 0; k < bond->hub_n; k++) {
        const double complex u =
            field(bond->material, rb_strip_midpoint(&bond->core, bond->n + k), context);
        hub[2 * k] = creal(u);
        hub[2 * k + 1] = cimag(u);
    }
    for (int i = 0; i < bond->n; i++) {
        const double complex z = rb_strip_midpoint(cover, bond->first + i);
        const double complex u = field(bond->material, z, context) - field(material, z, context);
        value[2 * i] = creal(u);
        value[2 * i + 1] = cimag(u);
    }
    cblas_dgemv(CblasColMajor, CblasNoTrans, 2 * bond->n, 2 * bond->hub_n, -1.0, bond->W,
                2 * bond->n, hub, 1, 1.0, value, 1);
    free(hub);
    return RB_OK;
}
