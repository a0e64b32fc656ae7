#include "bem/hierarchical.h"
#include "bem/internal.h"
#include "bem/kernels.h"

#include <hmat/hmat.h>

#include <stdlib.h>
#include <string.h>

struct rb_hierarchical {
    int n;
    rb_element *element; /* n, owned, as all here */
    rb_constants *constants;
    int *held;    /* 2n: 1 where the unknown is a traction */
    double *unit; /* n */
    hmat_interface_t library;
    hmat_cluster_tree_t *tree;
    hmat_matrix_t *matrix;
    double tolerance;
};

void rb_hierarchical_free(rb_hierarchical *h)
{
    if (!h)
        return;
    if (h->matrix)
        h->library.destroy(h->matrix);
    if (h->tree)
        hmat_delete_cluster_tree(h->tree);
    free(h->element);
    free(h->constants);
    free(h->held);
    free(h->unit);
    free(h);
}

/* ---- Entries -------------------------------------------------------------------------
 */

/* What a block of the library's own numbering needs to know. */
typedef struct {
    const rb_hierarchical *h;
    const int *row, *column; /* dofs of the block */
} block;

/* Entries of point i and element j: rows load direction, columns component. */
static void pair(const rb_hierarchical *h, int i, int j, double A[2][2])
{
    const rb_element *e = &h->element[j], *p = &h->element[i];
    const int *held = h->held + 2 * j;
    const double unit = -h->unit[j];
    rb_influence f;

    if (i == j) {
        rb_integrate_self(&h->constants[j], e->a, &f);
    } else {
        const rb_seen v = rb_look(e, p->mx, p->my);
        rb_integrate_H(&h->constants[j], e->a, &v, &f);
        rb_integrate_G(&h->constants[j], e->a, &v, &f);
    }
    A[0][0] = held[0] ? unit * f.Gxx : f.Hxx;
    A[1][0] = held[0] ? unit * f.Gxy : f.Hyx;
    A[0][1] = held[1] ? unit * f.Gxy : f.Hxy;
    A[1][1] = held[1] ? unit * f.Gyy : f.Hyy;
}

/* Both dofs of an element stand at one place and are mostly neighbours here: its
 * integrals are computed once for both. */
static void compute(void *data, int row_start, int rows, int column_start, int columns,
                    void *out)
{
    const block *b = data;
    double *entry = out, A[2][2];

    for (int r = 0; r < rows; r++)
        for (int c = 0, i = -1, j = -1; c < columns; c++) {
            const int row = b->row[row_start + r], column = b->column[column_start + c];
            if (row / 2 != i || column / 2 != j) {
                i = row / 2;
                j = column / 2;
                pair(b->h, i, j, A);
            }
            entry[r + (size_t)c * (size_t)rows] = A[row % 2][column % 2];
        }
}

static void prepare(int row_start, int rows, int column_start, int columns, int *row_dof,
                    int *row_place, int *column_dof, int *column_place, void *context,
                    hmat_block_info_t *info)
{
    block *b = malloc(sizeof *b);
    (void)rows;
    (void)columns;
    (void)row_place;
    (void)column_place;
    if (!b)
        abort(); /* the library has no way to hear of it */
    *b = (block){context, row_dof + row_start, column_dof + column_start};
    info->block_type = hmat_block_full;
    info->user_data = b;
    info->release_user_data = free;
}

/* ---- Matrix ---------------------------------------------------------------------------
 */

static rb_hierarchical *hierarchical_alloc(const rb_bem_mesh *mesh,
                                           rb_bem_material material, const double *unit)
{
    const size_t n = (size_t)mesh->n;
    const double r0 = rb_bem_mesh_size(mesh);
    rb_hierarchical *h = calloc(1, sizeof *h);

    if (!h)
        return NULL;
    h->n = mesh->n;
    h->element = calloc(n, sizeof *h->element);
    h->constants = calloc(n, sizeof *h->constants);
    h->held = rb_alloc_int(2 * n);
    h->unit = rb_alloc(n, 1);
    if (!h->element || !h->constants || !h->held || !h->unit) {
        rb_hierarchical_free(h);
        return NULL;
    }
    memcpy(h->unit, unit, n * sizeof *unit);
    for (int j = 0; j < mesh->n; j++) {
        h->element[j] =
            rb_element_make(mesh->x0[j], mesh->y0[j], mesh->x1[j], mesh->y1[j], r0);
        h->constants[j] = rb_constants_make(&h->element[j], material);
        for (int k = 0; k < 2; k++)
            h->held[2 * j + k] = mesh->condition[2 * j + k] == RB_BEM_DISPLACEMENT;
    }
    return h;
}

static rb_status make_tree(rb_hierarchical *h)
{
    double *place = rb_alloc(2, 2 * (size_t)h->n);
    hmat_clustering_algorithm_t *median = hmat_create_clustering_median();
    hmat_clustering_algorithm_t *leaves =
        median ? hmat_create_clustering_max_dof(median, 64) : NULL;

    for (int k = 0; place && k < 2 * h->n; k++) {
        place[2 * k] = h->element[k / 2].mx;
        place[2 * k + 1] = h->element[k / 2].my;
    }
    if (place && leaves)
        h->tree = hmat_create_cluster_tree(place, 2, 2 * h->n, leaves);
    if (leaves)
        hmat_delete_clustering(leaves);
    if (median)
        hmat_delete_clustering(median);
    free(place);
    return h->tree ? RB_OK : RB_ENOMEM;
}

static rb_status assemble(rb_hierarchical *h)
{
    hmat_admissibility_t *far = hmat_create_admissibility_standard(2.0);
    hmat_assemble_context_t context;

    h->matrix = h->library.create_empty_hmatrix_admissibility(h->tree, h->tree, 0, far);
    hmat_delete_admissibility(far);
    if (!h->matrix)
        return RB_ENOMEM;
    h->library.set_low_rank_epsilon(h->matrix, h->tolerance);
    hmat_assemble_context_init(&context);
    hmat_compression_algorithm_t *compression =
        hmat_create_compression_aca_plus(0.1 * h->tolerance);
    context.compression = compression;
    context.prepare = prepare;
    context.block_compute = compute;
    context.user_context = h;
    context.progress = NULL;
    const int fault = h->library.assemble_generic(h->matrix, &context);
    hmat_delete_compression(compression);
    return fault ? RB_ENOMEM : RB_OK;
}

rb_status rb_hierarchical_create(const rb_bem_mesh *mesh, rb_bem_material material,
                                 const double *unit, double tolerance,
                                 rb_hierarchical **out)
{
    rb_hierarchical *h = hierarchical_alloc(mesh, material, unit);
    rb_status s = h ? RB_OK : RB_ENOMEM;

    *out = NULL;
    if (s == RB_OK) {
        h->tolerance = tolerance;
        hmat_init_default_interface(&h->library, HMAT_DOUBLE_PRECISION);
        h->library.init();
        s = make_tree(h);
    }
    if (s == RB_OK)
        s = assemble(h);
    if (s == RB_OK)
        *out = h;
    else
        rb_hierarchical_free(h);
    return s;
}

rb_status rb_hierarchical_factor(rb_hierarchical *h)
{
    hmat_factorization_context_t context;

    hmat_factorization_context_init(&context);
    context.factorization = hmat_factorization_lu;
    context.progress = NULL;
    return h->library.factorize_generic(h->matrix, &context) ? RB_SINGULAR : RB_OK;
}

rb_status rb_hierarchical_solve(const rb_hierarchical *h, int columns, double *X)
{
    return h->library.solve_systems(h->matrix, X, columns) ? RB_SINGULAR : RB_OK;
}

double rb_hierarchical_ratio(const rb_hierarchical *h)
{
    hmat_info_t info;
    h->library.get_info(h->matrix, &info);
    return (double)info.compressed_size / (double)info.uncompressed_size;
}
