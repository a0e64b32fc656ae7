/* What the page does not hold: transforms for long lines, hierarchical matrices, cone
 * solvers. The page's ranges stay below the sizes that would need
 * them; asked for all the same, they refuse. */
#include "program/api/internal.h"
#include "bem/hierarchical/given.h"
#include "bem/hierarchical/hierarchical.h"
#include "bem/large.h"
#include "bem/hierarchical/skeleton.h"
#include "bem/layers/stack.h"
#include "bem/bem.h"
#include "rolling/body/interpolant.h"
#include "rolling/body/mesh.h"
#include "base/blas.h"
#include "lcp/friction/friction.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>

static const char refusal[] = "not in the page: use the program";

double *rb_large_alloc(size_t rows, size_t cols)
{
    return rb_alloc(rows, cols);
}

rb_status rb_bem_flexibility_toeplitz(int n_c, const double *ends, const rb_bem_surface *body,
                                      rb_bem_flexibility *f, rb_message *why)
{
    (void)body;
    (void)ends;
    *f = (rb_bem_flexibility){0};
    return rb_fail(why, RB_EINVAL, "%d contact elements are %s", n_c, refusal);
}

rb_bem_stack_kernel *rb_bem_stack_kernel_create(const rb_bem_surface *body, double reach)
{
    (void)body;
    (void)reach;
    return NULL;
}

void rb_bem_stack_kernel_at(const rb_bem_stack_kernel *kernel, double X, double of[3])
{
    (void)kernel;
    (void)X;
    of[0] = of[1] = of[2] = NAN;
}

void rb_bem_stack_kernel_free(rb_bem_stack_kernel *kernel)
{
    (void)kernel;
}

rb_status rb_bem_stack_field_create(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                    rb_bem_stack_field **field, rb_message *why)
{
    (void)body;
    (void)load;
    *field = NULL;
    return rb_fail(why, RB_EINVAL, "several layers are %s", refusal);
}

rb_status rb_bem_stack_field_add(rb_bem_stack_field *field, rb_bem_points points, double *stress,
                                 rb_message *why)
{
    (void)field;
    (void)points;
    (void)stress;
    return rb_fail(why, RB_EINVAL, "several layers are %s", refusal);
}

void rb_bem_stack_field_free(rb_bem_stack_field *field)
{
    (void)field;
}

rb_status rb_bem_flexibility_wheel_products(int n_c, const double *ends, const rb_bem_wheel *wheel,
                                            rb_bem_normals normals, rb_bem_flexibility *f,
                                            rb_message *why)
{
    (void)ends;
    (void)wheel;
    (void)normals;
    *f = (rb_bem_flexibility){0};
    return rb_fail(why, RB_EINVAL, "%d contact elements are %s", n_c, refusal);
}

rb_status rb_bem_flexibility_surface_products(int n_c, const double *ends,
                                              const rb_bem_surface *body, rb_bem_flexibility *f,
                                              rb_message *why)
{
    (void)ends;
    (void)body;
    *f = (rb_bem_flexibility){0};
    return rb_fail(why, RB_EINVAL, "%d contact elements are %s", n_c, refusal);
}

rb_status rb_hierarchical_create(const rb_bem_mesh *mesh, rb_bem_material material,
                                 const double *unit, double tolerance, rb_hierarchical **h)
{
    (void)mesh;
    (void)material;
    (void)unit;
    (void)tolerance;
    *h = NULL;
    return RB_EINVAL;
}

rb_status rb_hierarchical_solve(const rb_hierarchical *h, int columns, double *X)
{
    (void)h;
    (void)columns;
    (void)X;
    return RB_EINVAL;
}

void rb_hierarchical_free(rb_hierarchical *h)
{
    (void)h;
}

/* Long boundaries alone, which have a hierarchical matrix. */
rb_status rb_given_create(const rb_bem_mesh *mesh, rb_bem_material material, const double *unit,
                          double tolerance, rb_given **given)
{
    (void)mesh;
    (void)material;
    (void)unit;
    (void)tolerance;
    *given = NULL;
    return RB_EINVAL;
}

rb_status rb_given_multiply(const rb_given *given, int count, const int *element, int columns,
                            const double *value, double *X)
{
    (void)given;
    (void)count;
    (void)element;
    (void)columns;
    (void)value;
    (void)X;
    return RB_EINVAL;
}

void rb_given_free(rb_given *given)
{
    (void)given;
}

rb_status rb_skeleton_alloc(int rows, int columns, rb_skeleton *s)
{
    (void)rows;
    (void)columns;
    *s = (rb_skeleton){0};
    return RB_EINVAL;
}

rb_status rb_skeleton_reduce(rb_skeleton *s, double tolerance, rb_arena *memory, int *kept,
                             int **order, double **T)
{
    (void)s;
    (void)tolerance;
    (void)memory;
    *kept = 0;
    *order = NULL;
    *T = NULL;
    return RB_EINVAL;
}

void rb_skeleton_free(rb_skeleton *s)
{
    (void)s;
}

rb_status rb_contact_operator_products(int n, const rb_contact_products *products,
                                       rb_contact_operator **op)
{
    (void)n;
    products->free(products->context);
    *op = NULL;
    return RB_EINVAL;
}

/* products are then summed one by one */
rb_bem_convolution *rb_bem_convolution_create(int n, const double *t)
{
    (void)n;
    (void)t;
    return NULL;
}

void rb_bem_convolution_apply(const rb_bem_convolution *c, const double *r, double *w)
{
    (void)c;
    (void)r;
    (void)w;
}

void rb_bem_convolution_free(rb_bem_convolution *convolution)
{
    (void)convolution;
}

rb_status rb_bem_circulant_create(const rb_bem_flexibility *f, const double stencil[4],
                                  const double local[4], rb_bem_circulant **circulant)
{
    (void)f;
    (void)stencil;
    (void)local;
    *circulant = NULL;
    return RB_EINVAL;
}

void rb_bem_circulant_apply(const rb_bem_circulant *c, const double *w, double *r)
{
    (void)c;
    (void)w;
    (void)r;
}

void rb_bem_circulant_apply_difference(const rb_bem_circulant *c, const double *w, double *r)
{
    (void)c;
    (void)w;
    (void)r;
}

void rb_bem_circulant_apply_yielding(const rb_bem_circulant *c, double hardening, const double *w,
                                     double *r)
{
    (void)c;
    (void)hardening;
    (void)w;
    (void)r;
}

void rb_bem_circulant_free(rb_bem_circulant *circulant)
{
    (void)circulant;
}

/* No file, no profile. */
rb_status rb_rolling_profile_create(int n, const double *x, const double *gap, double noise,
                                    rb_rolling_profile **profile, rb_message *why)
{
    (void)n;
    (void)x;
    (void)gap;
    (void)noise;
    *profile = NULL;
    return rb_fail(why, RB_EINVAL, "a gap from a file is %s", refusal);
}

rb_status rb_rolling_profile_punch(int n, const double *x, const double *gap, double noise,
                                   rb_rolling_profile **profile, rb_message *why)
{
    return rb_rolling_profile_create(n, x, gap, noise, profile, why);
}

void rb_rolling_profile_free(rb_rolling_profile *profile)
{
    (void)profile;
}

void rb_rolling_profile_range(const rb_rolling_profile *profile, double *from, double *to)
{
    (void)profile;
    *from = *to = 0.0;
}

double rb_rolling_profile_gap(const rb_rolling_profile *profile, double x)
{
    (void)profile;
    (void)x;
    return NAN;
}

int rb_rolling_profile_rows(const rb_rolling_profile *profile, const double **x)
{
    (void)profile;
    *x = NULL;
    return 0;
}

double rb_rolling_profile_radius(const rb_rolling_profile *profile)
{
    (void)profile;
    return NAN;
}

int rb_rolling_profile_corners(const rb_rolling_profile *profile, const double **x,
                               const double **bend)
{
    (void)profile;
    *x = *bend = NULL;
    return 0;
}

/* Nor an interpolant. */
rb_status rb_rolling_interpolant_create(int n, const double *x, const double *y, int is_smooth,
                                        rb_rolling_interpolant **interpolant)
{
    (void)n;
    (void)x;
    (void)y;
    (void)is_smooth;
    *interpolant = NULL;
    return RB_EINVAL;
}

void rb_rolling_interpolant_free(rb_rolling_interpolant *interpolant)
{
    (void)interpolant;
}

double rb_rolling_interpolant_at(const rb_rolling_interpolant *interpolant, double x)
{
    (void)interpolant;
    (void)x;
    return NAN;
}

int rb_rolling_interpolant_corners(const rb_rolling_interpolant *interpolant, const double **x,
                                   const double **bend)
{
    (void)interpolant;
    *x = *bend = NULL;
    return 0;
}

int rb_rolling_interpolant_rows(const rb_rolling_interpolant *interpolant, const double **x)
{
    (void)interpolant;
    *x = NULL;
    return 0;
}

int rb_rolling_interpolant_untold(const rb_rolling_interpolant *interpolant)
{
    (void)interpolant;
    return 0;
}

rb_status rb_rolling_points_check(const char *what, int n, const double *x, const double *gap,
                                  rb_message *why)
{
    (void)n;
    (void)x;
    (void)gap;
    return rb_fail(why, RB_EINVAL, "%s is %s", what, refusal);
}

/* One thread. */
int rb_blas_threads(int threads)
{
    (void)threads;
    return 1;
}

int rb_blas_loop_threads(void)
{
    return 1;
}

rb_contact_cone_solver rb_friction_cone_solver(const char *name)
{
    return (rb_contact_cone_solver){name, NULL};
}

/* No file of the page's is somebody else's. */
char *realpath(const char *restrict path, char *restrict to)
{
    (void)path;
    (void)to;
    return NULL;
}
