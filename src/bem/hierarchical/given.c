/* Upwards in the tree the values of a cluster's columns are gathered at its skeleton; where a
 * cluster is seen from afar its skeleton gives what all its columns give, near leaves are added
 * exactly. */
#include "bem/hierarchical/given.h"
#include "bem/internal.h"
#include "bem/hierarchical/mixed.h"
#include "base/blas.h"

#include <cblas.h>
#include <stdlib.h>

/* Elements of the smallest clusters. */
enum { LEAF = 32 };
/* Radius of the circle beyond which a skeleton stands for a cluster, over its own. */
static const double REACH = 2.0;

typedef struct {
    int columns, kept; /* of its own elements or of its parts' skeletons; the skeleton */
    int *column;       /* columns: their dofs */
    int *order;        /* columns: places in `column`, skeleton first */
    double *T;         /* kept x others: the others are the skeleton's times T */
    int near, far;     /* elements within reach; those within the parent's reach alone */
    int *point;        /* near + far: which elements these are, the near ones first */
    rb_arena memory;   /* of the arrays */
} cluster;

/* What a cluster does to neighbouring points of one leaf. */
typedef struct {
    const cluster *from;
    int first, count; /* of its points */
} view;

struct rb_given {
    rb_mixed matrix; /* its columns are what others have as values, and the reverse */
    int levels, points;
    double tolerance;
    int *order;       /* n: element j is the mesh's order[j] */
    double *factor;   /* 2n: of a value in the units of its column */
    cluster *cluster; /* levels 0 ... levels, level by level */
    int *first;       /* 2^levels + 1: where the views of a leaf begin */
    view *view;
    rb_arena memory; /* of the arrays */
};

static cluster *at(const rb_given *g, int level, int k)
{
    return g->cluster + rb_cluster_place(level, k);
}

static size_t clusters_of(const rb_given *g)
{
    return rb_cluster_place(g->levels + 1, 0);
}

void rb_given_free(rb_given *g)
{
    if (!g)
        return;
    for (size_t i = 0; g->cluster && i < clusters_of(g); i++)
        rb_arena_free(&g->cluster[i].memory);
    rb_mixed_free(&g->matrix);
    rb_arena_free(&g->memory);
    free(g);
}

/* ---- The tree ---------------------------------------------------------------------- */

/* The circle beyond which a cluster is far. */
static rb_circle reach_of(const rb_given *g, int level, int k)
{
    rb_circle circle = rb_cluster_circle(g->matrix.element, rb_cluster_first(g->matrix.n, level, k),
                                         rb_cluster_first(g->matrix.n, level, k + 1));
    circle.r *= REACH;
    return circle;
}

/* The elements that the parent reaches, in two lists: every element is far from exactly
 * one cluster on the way from a leaf to the root, or near the leaf. */
static rb_status part_points(const void *tree, int level, int k)
{
    const rb_given *g = tree;
    const cluster *parent = at(g, level - 1, k / 2);
    const rb_circle reach = reach_of(g, level, k);
    cluster *c = at(g, level, k);
    int far = parent->near;

    c->point = rb_arena_ints(&c->memory, (size_t)parent->near + 1);
    if (!c->point)
        return RB_ENOMEM;
    for (int i = 0; i < parent->near; i++) {
        const rb_element *e = &g->matrix.element[parent->point[i]];
        const double dx = e->mx - reach.x, dy = e->my - reach.y;
        const int is_near = dx * dx + dy * dy < reach.r * reach.r;
        c->point[is_near ? c->near++ : --far] = parent->point[i];
    }
    c->far = parent->near - c->near;
    for (int i = c->near, j = parent->near - 1; i < j; i++, j--) { /* ascending again */
        const int kept = c->point[i];
        c->point[i] = c->point[j];
        c->point[j] = kept;
    }
    return RB_OK;
}

/* Its columns are those of its elements, or of its parts' skeletons.  What they do on the
 * circle decides what they do beyond it. */
static rb_status skeletonise(const void *tree, int level, int k)
{
    const rb_given *g = tree;
    const int first = rb_cluster_first(g->matrix.n, level, k), is_leaf = level == g->levels;
    const cluster *part = is_leaf ? NULL : at(g, level + 1, 2 * k);
    cluster *c = at(g, level, k);
    rb_circle reach = reach_of(g, level, k);
    rb_skeleton far_field = {0};

    c->columns = is_leaf ? 2 * (rb_cluster_first(g->matrix.n, level, k + 1) - first)
                         : part[0].kept + part[1].kept;
    c->column = rb_arena_ints(&c->memory, (size_t)c->columns);
    if (!c->column)
        return RB_ENOMEM;
    for (int i = 0; i < c->columns; i++)
        c->column[i] = is_leaf            ? 2 * first + i
                       : i < part[0].kept ? part[0].column[part[0].order[i]]
                                          : part[1].column[part[1].order[i - part[0].kept]];
    rb_status s = rb_mixed_see_columns(&g->matrix, 0, NULL, &reach, g->points, c->columns,
                                       c->column, &far_field);
    if (s == RB_OK)
        s = rb_skeleton_reduce(&far_field, g->tolerance, &c->memory, &c->kept, &c->order, &c->T);
    rb_skeleton_free(&far_field);
    return s;
}

/* The points of all clusters leaf by leaf; view NULL: only counted. */
static void list_views(const rb_given *g, view *list, int *next)
{
    const int n = g->matrix.n, leaves = 1 << g->levels;

    for (size_t i = 1; i < clusters_of(g); i++) {
        const cluster *c = &g->cluster[i];
        const int leaf_itself = (int)i + 1 >= leaves, all = c->near + c->far;
        for (int first = leaf_itself ? 0 : c->near; first < all;) {
            /* The leaf that holds the point. */
            int k = (int)(((size_t)c->point[first] << g->levels) / (size_t)n), count = 0;
            while (rb_cluster_first(n, g->levels, k + 1) <= c->point[first])
                k++;
            const int last = rb_cluster_first(n, g->levels, k + 1),
                      end = first < c->near ? c->near : all;
            while (first + count < end && c->point[first + count] < last &&
                   c->point[first + count] == c->point[first] + count)
                count++;
            if (list)
                list[next[k]] = (view){c, first, count};
            next[k]++;
            first += count;
        }
    }
}

rb_status rb_given_create(const rb_bem_mesh *mesh, rb_bem_material material, const double *unit,
                          double tolerance, rb_given **given)
{
    rb_given *g = calloc(1, sizeof *g);
    rb_status s = g ? RB_OK : RB_ENOMEM;

    if (g) {
        g->levels = rb_cluster_levels(mesh->n, LEAF);
        g->tolerance = tolerance;
        g->points = 2 * (int)ceil(-log(tolerance) / log(REACH));
        g->order = rb_arena_ints(&g->memory, (size_t)mesh->n);
        g->factor = rb_arena_doubles(&g->memory, 2 * (size_t)mesh->n, 1);
        g->cluster = rb_arena_zeros(&g->memory, clusters_of(g), sizeof *g->cluster);
        s = g->memory.failed ? RB_ENOMEM : RB_OK;
    }
    const int threads = rb_blas_threads(1);
    if (s == RB_OK) {
        /* Columns that are of order one, like those of the unknowns. */
        s = rb_mixed_make(mesh, material, unit, g->levels, g->order, &g->matrix);

        if (s == RB_OK) {
            rb_held_contours_free(&g->matrix.contours); /* which belong to the unknowns */
            for (int i = 0; i < 2 * mesh->n; i++) {
                const double own = unit[g->order[i / 2]];
                g->factor[i] = g->matrix.held[i] ? -1.0 : -1.0 / own;
                g->matrix.held[i] = !g->matrix.held[i];
            }
        }
    }
    if (s == RB_OK) {
        /* Points from the root down, skeletons from the leaves up. */
        cluster *root = at(g, 0, 0);

        root->near = g->matrix.n;
        root->point = rb_arena_ints(&root->memory, (size_t)root->near);
        if (!root->point)
            s = RB_ENOMEM;
        else {
            for (int i = 0; i < root->near; i++)
                root->point[i] = i;
            for (int level = 1; level <= g->levels && s == RB_OK; level++)
                s = rb_cluster_run(g, level, part_points);
            for (int level = g->levels; level > 0 && s == RB_OK; level--)
                s = rb_cluster_run(g, level, skeletonise);
        }
    }
    if (s == RB_OK) {
        const size_t leaves = (size_t)1 << g->levels;
        int *next = rb_arena_ints(&g->memory, leaves);

        g->first = rb_arena_ints(&g->memory, leaves + 1);
        if (!g->memory.failed) {
            list_views(g, NULL, next);
            for (size_t k = 0; k < leaves; k++) {
                g->first[k + 1] = g->first[k] + next[k];
                next[k] = g->first[k];
            }
            g->view = rb_arena_zeros(&g->memory, (size_t)g->first[leaves] + 1, sizeof *g->view);
            if (g->view)
                list_views(g, g->view, next);
        }
        s = g->view ? RB_OK : RB_ENOMEM;
    }
    rb_blas_threads(threads);
    *given = s == RB_OK ? g : NULL;
    if (s != RB_OK)
        rb_given_free(g);
    return s;
}

/* ---- Products ---------------------------------------------------------------------- */

/* Values of all columns of a cluster (columns x q) and of its skeleton (kept x q); NULL
 * where they are zero. */
typedef struct {
    double *all, *skeleton;
} values;

typedef struct {
    const rb_given *g;
    int q, rows;
    const double *value; /* rows x q, the given ones */
    int *place;          /* n, in the clusters' order: of an element in them, or -1 */
    values *of;          /* of each cluster */
    double *X;
} product;

/* All values of a leaf: the given ones in the units of its columns. */
static rb_status leaf_values(const product *p, const cluster *c, values *v)
{
    int any = 0;

    for (int i = 0; i < c->columns; i += 2)
        any = any || p->place[c->column[i] / 2] >= 0;
    if (!any)
        return RB_OK;
    v->all = rb_alloc((size_t)c->columns, (size_t)p->q);
    for (int i = 0; v->all && i < c->columns; i++) {
        const int dof = c->column[i], place = p->place[dof / 2];
        for (int l = 0; place >= 0 && l < p->q; l++)
            v->all[i + (size_t)l * (size_t)c->columns] =
                p->g->factor[dof] * p->value[2 * place + dof % 2 + (size_t)l * (size_t)p->rows];
    }
    return v->all ? RB_OK : RB_ENOMEM;
}

/* From the leaves to the root: all values of a parent are those of its parts' skeletons,
 * one below the other; the skeleton's are its own, and T times those of the others. */
static rb_status make_values(const product *p, int level, int k)
{
    const cluster *c = at(p->g, level, k);
    values *v = &p->of[c - p->g->cluster];

    if (level == p->g->levels) {
        if (leaf_values(p, c, v) != RB_OK)
            return RB_ENOMEM;
    } else {
        const cluster *part = at(p->g, level + 1, 2 * k);
        const values *from = &p->of[part - p->g->cluster];
        if (from[0].skeleton || from[1].skeleton) {
            v->all = rb_alloc((size_t)c->columns, (size_t)p->q);
            if (!v->all)
                return RB_ENOMEM;
            for (int h = 0, row = 0; h < 2; row += part[h++].kept)
                if (from[h].skeleton)
                    LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', part[h].kept, p->q, from[h].skeleton,
                                        part[h].kept, v->all + row, c->columns);
        }
    }
    if (!v->all)
        return RB_OK;
    const size_t kept = (size_t)c->kept, others = (size_t)c->columns - kept;
    double *rest = rb_alloc(others + 1, (size_t)p->q);

    v->skeleton = rb_alloc(kept, (size_t)p->q);
    const rb_status s = rest && v->skeleton ? RB_OK : RB_ENOMEM;
    for (size_t l = 0; s == RB_OK && l < (size_t)p->q; l++) {
        const double *all = v->all + l * (size_t)c->columns;
        for (size_t i = 0; i < kept; i++)
            v->skeleton[i + l * kept] = all[c->order[i]];
        for (size_t i = 0; i < others; i++)
            rest[i + l * others] = all[c->order[kept + i]];
    }
    if (s == RB_OK && others > 0)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, c->kept, p->q, (int)others, 1.0,
                    c->T, c->kept, rest, (int)others, 1.0, v->skeleton, c->kept);
    free(rest);
    if (level < p->g->levels) {
        free(v->all);
        v->all = NULL;
    }
    return s;
}

/* Y += what the cluster of a view does to points of leaf k, by all its columns where they
 * are near. */
static rb_status add_view(const product *p, const view *w, int k, double *Y, int ld)
{
    const rb_given *g = p->g;
    const cluster *c = w->from;
    const values *v = &p->of[c - g->cluster];
    const int near = w->first < c->near, columns = near ? c->columns : c->kept, m = 2 * w->count;
    rb_arena scratch = {0};
    int *row = rb_arena_ints(&scratch, (size_t)m),
        *column = rb_arena_ints(&scratch, (size_t)columns);
    double *A = rb_arena_doubles(&scratch, (size_t)m, (size_t)columns);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int i = 0; i < m; i++)
        row[i] = 2 * c->point[w->first + i / 2] + i % 2;
    for (int j = 0; j < columns; j++)
        column[j] = c->column[near ? j : c->order[j]];
    const rb_status s =
        rb_mixed_entries(&g->matrix, m, row, columns, column, (rb_matrix_view){A, 1, (size_t)m});
    if (s == RB_OK)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, p->q, columns, 1.0, A, m,
                    near ? v->all : v->skeleton, columns, 1.0,
                    Y + (row[0] - 2 * rb_cluster_first(g->matrix.n, g->levels, k)), ld);
    return rb_arena_done(&scratch, s);
}

static rb_status add_leaf(const void *tree, int level, int k)
{
    const product *p = tree;
    const rb_given *g = p->g;
    const int first = rb_cluster_first(g->matrix.n, level, k),
              m = 2 * (rb_cluster_first(g->matrix.n, level, k + 1) - first);
    double *Y = rb_alloc((size_t)m, (size_t)p->q);
    rb_status s = Y ? RB_OK : RB_ENOMEM;

    for (int i = g->first[k]; i < g->first[k + 1] && s == RB_OK; i++)
        if (p->of[g->view[i].from - g->cluster].skeleton)
            s = add_view(p, &g->view[i], k, Y, m);
    for (size_t l = 0; s == RB_OK && l < (size_t)p->q; l++)
        for (int i = 0; i < m; i++)
            p->X[2 * (size_t)g->order[first + i / 2] + (size_t)(i % 2) +
                 l * 2 * (size_t)g->matrix.n] += Y[(size_t)i + l * (size_t)m];
    free(Y);
    return s;
}

rb_status rb_given_multiply(const rb_given *g, int count, const int *element, int columns,
                            const double *value, double *X)
{
    const int n = g->matrix.n;
    product p = {.g = g,
                 .q = columns,
                 .rows = 2 * count,
                 .value = value,
                 .place = rb_alloc_int((size_t)n),
                 .of = calloc(clusters_of(g), sizeof *p.of),
                 .X = X};
    int *place = rb_alloc_int((size_t)n); /* in the mesh's order */
    const int threads = rb_blas_threads(1);
    rb_status s = p.place && p.of && place ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        for (int j = 0; j < n; j++)
            place[j] = -1;
        for (int i = 0; i < count; i++)
            place[element[i]] = i;
        for (int j = 0; j < n; j++)
            p.place[j] = place[g->order[j]];
    }
    for (int level = g->levels; level > 0; level--)
        for (int k = 0; k < 1 << level && s == RB_OK; k++)
            s = make_values(&p, level, k);
    if (s == RB_OK)
        s = rb_cluster_run(&p, g->levels, add_leaf);
    rb_blas_threads(threads);
    for (size_t i = 0; p.of && i < clusters_of(g); i++) {
        free(p.of[i].all);
        free(p.of[i].skeleton);
    }
    free(place);
    free(p.of);
    free(p.place);
    return s;
}
