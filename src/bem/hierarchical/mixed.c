/* The matrix of a mixed problem (B4) is never stored: its entries are integrated when they are
 * asked for.  What lies far from a cluster acts on it like loads on a circle around it, because
 * both solve the equations of equilibrium inside the circle; so a circle of a few dozen points
 * stands for all that is far (proxies), in the rows as in the columns. */
#include "bem/hierarchical/mixed.h"
#include "bem/internal.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

void rb_mixed_free(rb_mixed *a)
{
    free(a->element);
    free(a->constants);
    free(a->held);
    rb_held_contours_free(&a->contours);
    *a = (rb_mixed){0};
}

/* Kelvin's constants with tractions in units of `factor`, so that the unknowns of a column, whether
 * displacements or tractions, are of one size. */
static rb_constants scaled(const rb_element *e, rb_bem_material material, double factor)
{
    rb_constants k = rb_constants_make(e, material);
    rb_constants_scale_G(&k, factor);
    return k;
}

rb_status rb_mixed_make(const rb_bem_mesh *mesh, rb_bem_material material, const double *unit,
                        int levels, int *order, rb_mixed *a)
{
    const size_t n = (size_t)mesh->n;
    const double size = rb_bem_mesh_size(mesh);
    rb_element *element = calloc(n, sizeof *element);
    rb_held_contours contours;
    rb_status s = rb_held_contours_find(mesh, material, &contours);

    *a = (rb_mixed){.n = mesh->n,
                    .material = material,
                    .size = size,
                    .element = calloc(n, sizeof *a->element),
                    .constants = calloc(n, sizeof *a->constants),
                    .held = rb_alloc_int(2 * n)};
    if (contours.count > 0)
        a->contours = (rb_held_contours){contours.count, rb_alloc_int(n), rb_alloc(n, 2)};
    if (!element || !a->element || !a->constants || !a->held ||
        (contours.count > 0 && (!a->contours.contour || !a->contours.normal)))
        s = RB_ENOMEM;
    if (s == RB_OK) {
        for (size_t j = 0; j < n; j++)
            element[j] = rb_element_make(mesh->x0[j], mesh->y0[j], mesh->x1[j], mesh->y1[j], size);
        rb_cluster_order(a->n, element, levels, order);
    }
    /* elements in the order of the clusters: each cluster is then a range of rows and columns */
    for (int j = 0; s == RB_OK && j < a->n; j++) {
        const int from = order[j];
        a->element[j] = element[from];
        a->constants[j] = scaled(&a->element[j], material, -unit[from]);
        for (int k = 0; k < 2; k++)
            a->held[2 * j + k] = mesh->condition[2 * from + k] == RB_BEM_DISPLACEMENT;
        if (contours.count > 0) {
            a->contours.contour[j] = contours.contour[from];
            a->contours.normal[2 * j] = contours.normal[2 * from];
            a->contours.normal[2 * j + 1] = contours.normal[2 * from + 1];
        }
    }
    free(element);
    rb_held_contours_free(&contours);
    if (s != RB_OK)
        rb_mixed_free(a);
    return s;
}

void rb_mixed_rows_free(rb_mixed_rows *r)
{
    rb_points_free(&r->points);
    free(r->element);
    free(r->at);
    *r = (rb_mixed_rows){0};
}

/* Of point q of a circle. */
static double angle(int q, int points)
{
    return 2.0 * M_PI * q / points;
}

rb_status rb_mixed_rows_make(const rb_mixed *a, int rows, const int *row, const rb_circle *circle,
                             int points, rb_mixed_rows *r)
{
    const size_t all = (size_t)rows + 2 * (size_t)points;
    double *x = rb_alloc(all, 2), *y = x ? x + all : NULL;
    rb_status s = RB_ENOMEM;

    *r = (rb_mixed_rows){.rows = (int)all, .own = rows, .row = row};
    r->at = rb_alloc_int(all);
    r->element = rb_alloc_int((size_t)rows);
    if (x && r->at && r->element) {
        int last = -1;
        /* the two rows of an element need its midpoint once */
        for (int i = 0; i < r->own; i++) {
            const int j = r->row[i] / 2;
            if (j != last) {
                x[r->elements] = a->element[j].mx;
                y[r->elements] = a->element[j].my;
                r->element[r->elements++] = last = j;
            }
            r->at[i] = 2 * (r->elements - 1) + r->row[i] % 2;
        }
        /* x, y: of the points, after those of the rows' elements. */
        for (int q = 0; q < points; q++) {
            const int point = r->elements + q;
            x[point] = circle->x + circle->r * cos(angle(q, points));
            y[point] = circle->y + circle->r * sin(angle(q, points));
            for (int k = 0; k < 2; k++)
                r->at[r->own + 2 * q + k] = 2 * point + k;
        }
        s = rb_points_make(r->elements + points, x, y, &r->points);
    }
    free(x);
    if (s != RB_OK)
        rb_mixed_rows_free(r);
    return s;
}

/* Values at points, two to each, become the rows that are asked for. */
static void scatter(const rb_mixed_rows *r, const double *from, double *to, size_t step)
{
    for (int i = 0; i < r->rows; i++)
        to[(size_t)i * step] = from[r->at[i]];
}

/* The point on element j, or -1. */
static int point_on(const rb_mixed_rows *r, int j)
{
    int low = 0, high = r->elements;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (r->element[middle] < j)
            low = middle + 1;
        else
            high = middle;
    }
    return low < r->elements && r->element[low] == j ? low : -1;
}

rb_status rb_mixed_block(const rb_mixed *a, const rb_mixed_rows *r, int columns, const int *column,
                         rb_matrix_view out)
{
    const size_t rows = 2 * (size_t)r->points.n;
    rb_column_fn *fill = rb_column_variant_get(0)->fill;
    double *buffer = rb_alloc(rows, 2);

    if (!buffer)
        return RB_ENOMEM;
    /* both columns of an element come from one integration over it */
    for (int c = 0; c < columns;) {
        const int j = column[c] / 2;
        double *part[4] = {NULL, NULL, NULL, NULL};
        int end = c;
        for (; end < columns && column[end] / 2 == j; end++) {
            const int k = column[end] % 2;
            /* where displacements are given the unknown is a traction: a column of G, else of H */
            part[a->held[column[end]] ? 2 + k : k] = buffer + (size_t)k * rows;
        }
        fill(&a->constants[j], &a->element[j], point_on(r, j), &r->points, part);
        for (; c < end; c++) {
            double *to = out.x + (size_t)c * out.column_step;
            scatter(r, buffer + (size_t)(column[c] % 2) * rows, to, out.row_step);
            /* an incompressible body: what holds its volume */
            if (a->contours.count && a->contours.contour[column[c] / 2] >= 0)
                for (int i = 0; i < r->own; i++)
                    to[(size_t)i * out.row_step] +=
                        rb_held_contours_term(&a->contours, r->row[i], column[c]);
        }
    }
    free(buffer);
    return RB_OK;
}

rb_status rb_mixed_entries(const rb_mixed *a, int rows, const int *row, int columns,
                           const int *column, rb_matrix_view out)
{
    rb_mixed_rows r;
    rb_status s = rb_mixed_rows_make(a, rows, row, NULL, 0, &r);

    if (s == RB_OK)
        s = rb_mixed_block(a, &r, columns, column, out);
    rb_mixed_rows_free(&r);
    return s;
}

rb_status rb_mixed_see_columns(const rb_mixed *a, int rows, const int *row, const rb_circle *circle,
                               int points, int columns, const int *column, rb_skeleton *far_field)
{
    rb_mixed_rows r;
    rb_status s = rb_mixed_rows_make(a, rows, row, circle, points, &r);

    if (s == RB_OK)
        s = rb_skeleton_alloc(r.rows, columns, far_field);
    if (s == RB_OK)
        s = rb_mixed_block(a, &r, columns, column,
                           (rb_matrix_view){far_field->K, 1, (size_t)far_field->ld});
    rb_mixed_rows_free(&r);
    return s;
}

rb_status rb_mixed_far(const rb_mixed *a, const rb_mixed_rows *r, rb_circle circle, int points,
                       rb_matrix_view out)
{
    const size_t rows = 2 * (size_t)r->points.n;
    double *buffer = rb_alloc(rows, 2);

    if (!buffer)
        return RB_ENOMEM;
    /* far columns: tractions on the chords of the circle, whose displacements are of order one */
    for (int q = 0; q < points; q++) {
        const double from = angle(q, points), to = angle(q + 1, points);
        const rb_element e =
            rb_element_make(circle.x + circle.r * cos(from), circle.y + circle.r * sin(from),
                            circle.x + circle.r * cos(to), circle.y + circle.r * sin(to), a->size);
        const rb_constants k = scaled(&e, a->material, 0.5 * a->material.shear / e.a);
        rb_column_variant_get(0)->fill(&k, &e, -1, &r->points,
                                       (double *[4]){NULL, NULL, buffer, buffer + rows});
        for (int d = 0; d < 2; d++)
            scatter(r, buffer + (size_t)d * rows, out.x + (size_t)(2 * q + d) * out.column_step,
                    out.row_step);
    }
    free(buffer);
    return RB_OK;
}
