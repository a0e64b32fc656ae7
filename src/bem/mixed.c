#include "bem/mixed.h"
#include "bem/internal.h"

#include <stdlib.h>

void rb_mixed_free(rb_mixed *a)
{
    free(a->element);
    free(a->constants);
    free(a->held);
    *a = (rb_mixed){0};
}

static rb_constants scaled(const rb_element *e, rb_bem_material material, double factor)
{
    rb_constants k = rb_constants_make(e, material);
    k.G_cos *= factor;
    k.G_sin *= factor;
    k.G_kap *= factor;
    k.G_mean *= factor;
    return k;
}

/* Elements in the clusters' order. */
static rb_status order_elements(const rb_bem_mesh *mesh, int levels, int *order,
                                rb_mixed *a)
{
    rb_element *element = calloc((size_t)a->n, sizeof *element);

    if (!element)
        return RB_ENOMEM;
    for (int j = 0; j < a->n; j++)
        element[j] =
            rb_element_make(mesh->x0[j], mesh->y0[j], mesh->x1[j], mesh->y1[j], a->size);
    rb_cluster_order(a->n, element, levels, order);
    for (int j = 0; j < a->n; j++)
        a->element[j] = element[order[j]];
    free(element);
    return RB_OK;
}

rb_status rb_mixed_make(const rb_bem_mesh *mesh, rb_bem_material material,
                        const double *unit, int levels, int *order, rb_mixed *a)
{
    const size_t n = (size_t)mesh->n;

    *a = (rb_mixed){.n = mesh->n, .material = material, .size = rb_bem_mesh_size(mesh)};
    a->element = calloc(n, sizeof *a->element);
    a->constants = calloc(n, sizeof *a->constants);
    a->held = rb_alloc_int(2 * n);
    if (!a->element || !a->constants || !a->held ||
        order_elements(mesh, levels, order, a) != RB_OK) {
        rb_mixed_free(a);
        return RB_ENOMEM;
    }
    for (int j = 0; j < a->n; j++) {
        a->constants[j] = scaled(&a->element[j], material, -unit[order[j]]);
        for (int k = 0; k < 2; k++)
            a->held[2 * j + k] = mesh->condition[2 * order[j] + k] == RB_BEM_DISPLACEMENT;
    }
    return RB_OK;
}

void rb_mixed_rows_free(rb_mixed_rows *r)
{
    rb_points_free(&r->points);
    free(r->at);
    *r = (rb_mixed_rows){0};
}

static double angle(int q, int points)
{
    return 2.0 * 3.14159265358979323846 * q / points;
}

rb_status rb_mixed_rows_make(const rb_mixed *a, int rows, const int *row,
                             const rb_circle *circle, int points, rb_mixed_rows *r)
{
    const size_t all = (size_t)rows + 2 * (size_t)points;
    double *x = rb_alloc(all, 2), *y = x + all;
    int count = 0, last = -1;
    rb_status s = RB_ENOMEM;

    *r = (rb_mixed_rows){.rows = (int)all, .at = rb_alloc_int(all)};
    for (int i = 0; x && r->at && i < rows; i++) {
        if (row[i] / 2 != last) {
            last = row[i] / 2;
            x[count] = a->element[last].mx;
            y[count++] = a->element[last].my;
        }
        r->at[i] = 2 * (count - 1) + row[i] % 2;
    }
    for (int q = 0; x && r->at && q < points; q++, count++) {
        x[count] = circle->x + circle->r * cos(angle(q, points));
        y[count] = circle->y + circle->r * sin(angle(q, points));
        r->at[rows + 2 * q] = 2 * count;
        r->at[rows + 2 * q + 1] = 2 * count + 1;
    }
    if (x && r->at)
        s = rb_points_make(count, x, y, &r->points);
    free(x);
    if (s != RB_OK)
        rb_mixed_rows_free(r);
    return s;
}

static void scatter(const rb_mixed_rows *r, const double *from, double *to, size_t step)
{
    for (int i = 0; i < r->rows; i++)
        to[(size_t)i * step] = from[r->at[i]];
}

rb_status rb_mixed_block(const rb_mixed *a, const rb_mixed_rows *r, int columns,
                         const int *column, int own, double *out, size_t row_step,
                         size_t column_step)
{
    const size_t rows = 2 * (size_t)r->points.n;
    rb_column_fn *fill = rb_column_variant_get(0)->fill;
    double *buffer = rb_alloc(rows, 2);

    if (!buffer)
        return RB_ENOMEM;
    for (int c = 0; c < columns;) {
        const int j = column[c] / 2, self = own < 0 ? -1 : j - own;
        double *part[4] = {NULL, NULL, NULL, NULL};
        int end = c;
        for (; end < columns && column[end] / 2 == j; end++) {
            const int k = column[end] % 2;
            part[a->held[column[end]] ? 2 + k : k] = buffer + (size_t)k * rows;
        }
        fill(&a->constants[j], &a->element[j], self, &r->points, part);
        for (; c < end; c++)
            scatter(r, buffer + (size_t)(column[c] % 2) * rows,
                    out + (size_t)c * column_step, row_step);
    }
    free(buffer);
    return RB_OK;
}

rb_status rb_mixed_far(const rb_mixed *a, const rb_mixed_rows *r, rb_circle circle,
                       int points, double *out, size_t row_step, size_t column_step)
{
    const size_t rows = 2 * (size_t)r->points.n;
    double *buffer = rb_alloc(rows, 2);

    if (!buffer)
        return RB_ENOMEM;
    for (int q = 0; q < points; q++) {
        const double from = angle(q, points), to = angle(q + 1, points);
        const rb_element e = rb_element_make(
            circle.x + circle.r * cos(from), circle.y + circle.r * sin(from),
            circle.x + circle.r * cos(to), circle.y + circle.r * sin(to), a->size);
        const rb_constants k = scaled(&e, a->material, 0.5 * a->material.shear / e.a);
        rb_column_variant_get(0)->fill(&k, &e, -1, &r->points,
                                       (double *[4]){NULL, NULL, buffer, buffer + rows});
        for (int d = 0; d < 2; d++)
            scatter(r, buffer + (size_t)d * rows, out + (size_t)(2 * q + d) * column_step,
                    row_step);
    }
    free(buffer);
    return RB_OK;
}
