/* Meshes of closed polygons (B4): memory and checks. */
#include "bem/internal.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

rb_status rb_bem_mesh_alloc(int n, rb_bem_mesh *mesh)
{
    memset(mesh, 0, sizeof *mesh);
    if (n < 1)
        return RB_EINVAL;
    const size_t size = (size_t)n;
    mesh->n = n;
    mesh->x0 = rb_alloc(size, 1);
    mesh->y0 = rb_alloc(size, 1);
    mesh->x1 = rb_alloc(size, 1);
    mesh->y1 = rb_alloc(size, 1);
    mesh->value = rb_alloc(2 * size, 1);
    mesh->condition = calloc(2 * size, sizeof *mesh->condition); /* RB_BEM_TRACTION */
    if (mesh->x0 && mesh->y0 && mesh->x1 && mesh->y1 && mesh->value && mesh->condition)
        return RB_OK;
    rb_bem_mesh_free(mesh);
    return RB_ENOMEM;
}

void rb_bem_mesh_free(rb_bem_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->x0);
    free(mesh->y0);
    free(mesh->x1);
    free(mesh->y1);
    free(mesh->value);
    free(mesh->condition);
    memset(mesh, 0, sizeof *mesh);
}

rb_status rb_bem_mesh_copy(const rb_bem_mesh *from, rb_bem_mesh *to)
{
    const size_t n = (size_t)from->n;
    const rb_status s = rb_bem_mesh_alloc(from->n, to);
    if (s != RB_OK)
        return s;
    memcpy(to->x0, from->x0, n * sizeof *to->x0);
    memcpy(to->y0, from->y0, n * sizeof *to->y0);
    memcpy(to->x1, from->x1, n * sizeof *to->x1);
    memcpy(to->y1, from->y1, n * sizeof *to->y1);
    memcpy(to->value, from->value, 2 * n * sizeof *to->value);
    memcpy(to->condition, from->condition, 2 * n * sizeof *to->condition);
    to->contact_first = from->contact_first;
    to->contact_n = from->contact_n;
    return RB_OK;
}

double rb_bem_mesh_length(const rb_bem_mesh *mesh, int j)
{
    return hypot(mesh->x1[j] - mesh->x0[j], mesh->y1[j] - mesh->y0[j]);
}

/* Element `next` begins where j ends, within rounding: of a contour that closes. */
static int meets(const rb_bem_mesh *mesh, int j, int next)
{
    const double gap = hypot(mesh->x0[next] - mesh->x1[j], mesh->y0[next] - mesh->y1[j]);
    return gap <= 1e-9 * fmin(rb_bem_mesh_length(mesh, j), rb_bem_mesh_length(mesh, next));
}

double rb_bem_mesh_size(const rb_bem_mesh *mesh)
{
    double longest = 0.0, length = 0.0;

    for (int j = 0, start = 0; j < mesh->n; j++) {
        length += rb_bem_mesh_length(mesh, j);
        longest = fmax(longest, length);
        if (meets(mesh, j, start)) {
            start = j + 1;
            length = 0.0;
        }
    }
    return M_SQRT2 / M_PI * longest;
}

void rb_bem_mesh_next(const rb_bem_mesh *mesh, int *next)
{
    int start = 0;
    for (int j = 0; j < mesh->n; j++) {
        const int closes = meets(mesh, j, start);
        next[j] = closes ? start : j + 1;
        start = closes ? j + 1 : start;
    }
}

rb_status rb_bem_mesh_check(const rb_bem_mesh *mesh, rb_message *why)
{
    const int n = mesh->n, first = mesh->contact_first, upstream = first + mesh->contact_n;

    if (n < 1)
        return rb_fail(why, RB_EINVAL, "a mesh of %d elements", n);
    /* The contact, and the element upstream of it. */
    if (mesh->contact_n < 0 || (mesh->contact_n > 0 && (first < 0 || mesh->contact_n >= n - first)))
        return rb_fail(why, RB_EINVAL,
                       "contact elements %d to %d and one after them: the mesh has %d", first,
                       upstream - 1, n);
    for (int k = 0; mesh->contact_n > 0 && k < 2; k++)
        if (mesh->condition[2 * upstream + k] != RB_BEM_TRACTION)
            return rb_fail(why, RB_EINVAL, "element %d, upstream of the contact, is not free",
                           upstream);
    for (int j = first; mesh->contact_n > 0 && j <= upstream; j++)
        if (!(mesh->x0[j] < mesh->x1[j]))
            return rb_fail(why, RB_EINVAL, "contact element %d does not run towards +x", j);
    for (int j = 0; j < n; j++) {
        const int in_contact = j >= first && j < upstream;
        const double h = rb_bem_mesh_length(mesh, j);
        if (!(h > 0.0 && isfinite(h)))
            return rb_fail(why, RB_EINVAL, "element %d: length %g, expected > 0", j, h);
        for (int k = 0; k < 2; k++) {
            const rb_bem_condition given = mesh->condition[2 * j + k];
            if (!isfinite(mesh->value[2 * j + k]))
                return rb_fail(why, RB_EINVAL, "element %d: given %s in %c = %g", j,
                               given == RB_BEM_DISPLACEMENT ? "displacement" : "traction", "xy"[k],
                               mesh -> value[2 * j + k]);
            if ((given == RB_BEM_CONTACT) != in_contact)
                return rb_fail(why, RB_EINVAL,
                               "element %d: %s contact, but its condition in %c says otherwise", j,
                               in_contact ? "in" : "outside the", "xy"[k]);
        }
    }
    /* Each contour is a run of elements, end to start, whose last end is the run's start. */
    for (int j = 0, start = 0; j < n; j++) {
        if (meets(mesh, j, start))
            start = j + 1;
        else if (j + 1 == n || !meets(mesh, j, j + 1))
            return rb_fail(why, RB_EINVAL,
                           "element %d ends at (%g, %g): the contour from element %d does not "
                           "close",
                           j, mesh->x1[j], mesh->y1[j], start);
    }
    double area = 0.0; /* twice that on the left of all contours */
    for (int j = 0; j < n; j++)
        area += (mesh->x0[j] - mesh->x0[0]) * (mesh->y1[j] - mesh->y0[j]) -
                (mesh->y0[j] - mesh->y0[0]) * (mesh->x1[j] - mesh->x0[j]);
    return area > 0.0 ? RB_OK
                      : rb_fail(why, RB_EINVAL,
                                "the body is not on the left of its contours: outer ones run "
                                "counter-clockwise, holes clockwise");
}

rb_status rb_bem_ends_check(int n_c, const double *ends, rb_message *why)
{
    if (n_c < 1 || !ends)
        return rb_fail(why, RB_EINVAL, "contact elements: %d, expected at least 1", n_c);
    for (int i = 0; i <= n_c; i++)
        if (!(isfinite(ends[i]) && isfinite(ends[i + 1]) && ends[i] < ends[i + 1]))
            return rb_fail(why, RB_EINVAL,
                           "contact element %d from x = %g to %g: expected increasing ends", i,
                           ends[i], ends[i + 1]);
    return RB_OK;
}
