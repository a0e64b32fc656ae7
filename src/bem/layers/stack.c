/* Waves in a stack of bonded layers: the compliance of a face from that of the face below it (L6).
 * Compliances are carried and never products of transfer matrices, whose two growing solutions
 * would become parallel. */
#include "bem/layers/stack.h"

#include <math.h>
#include <stdlib.h>

/* Beyond this product of wave number and thickness a layer is a half-plane. */
static const double DEEP = 45.0;

static void set_row(double thickness, rb_bem_material m, double unit, rb_bem_stack_row *row)
{
    const double G = m.shear / unit, nu = m.poisson, c = nu / (1.0 - nu),
                 beta = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)), half = (1.0 - nu) / G;

    *row = (rb_bem_stack_row){.thickness = thickness,
                              .A = {{0.0, -1.0, 1.0 / G, 0.0},
                                    {c, 0.0, 0.0, beta / G},
                                    {2.0 * G / (1.0 - nu), 0.0, 0.0, -c},
                                    {0.0, 0.0, 1.0, 0.0}},
                              .half = {{half, half * beta}, {half * beta, half}},
                              .poisson = nu};
}

rb_bem_stack_rows *rb_bem_stack_rows_of(const rb_bem_surface *body)
{
    const rb_bem_stack *stack = body->stack;
    rb_bem_stack_rows *rows = calloc(1, sizeof *rows);
    rb_bem_stack_row *row = calloc((size_t)stack->n + 1, sizeof *row);

    if (!rows || !row) {
        free(rows);
        free(row);
        return NULL;
    }
    *rows = (rb_bem_stack_rows){.n = stack->n, .elastic_base = body->elastic_base, .row = row};
    for (int j = 0; j < stack->n; j++) {
        set_row(stack->thickness[j], rb_bem_material_from_young(stack->young[j], stack->poisson[j]),
                body->material.shear, &row[j]);
        rows->height += stack->thickness[j];
    }
    if (body->elastic_base)
        set_row(INFINITY, body->base, body->material.shear, &row[stack->n]);
    return rows;
}

void rb_bem_stack_rows_free(rb_bem_stack_rows *rows)
{
    if (!rows)
        return;
    free(rows->row);
    free(rows);
}

/* ---- Within a row ------------------------------------------------------------------ */

void rb_bem_stack_factors(double eta, double a[4])
{
    const double fade2 = exp(-2.0 * eta), ch = 0.5 * (1.0 + fade2),
                 sh = eta < 0.3 ? -0.5 * expm1(-2.0 * eta) : 0.5 * (1.0 - fade2);

    a[2] = 0.5 * eta * sh;
    if (eta < 0.3) { /* eta ch - sh = sum 2 n eta^(2n + 1)/(2n + 1)! */
        double term = eta, sum = 0.0;
        for (int n = 1; n <= 8; n++) {
            term *= eta * eta / (2 * n * (2 * n + 1));
            sum += n * term;
        }
        a[3] = sum * exp(-eta);
    } else {
        a[3] = 0.5 * (eta * ch - sh);
    }
    a[0] = ch - a[2];
    a[1] = sh - a[3];
}

/* A s, without the entries that are zero. */
static void times_A(const rb_bem_stack_row *row, const double s[4], double to[4])
{
    const double(*A)[4] = row->A;
    to[RB_STACK_U] = A[RB_STACK_U][RB_STACK_X] * s[RB_STACK_X] - s[RB_STACK_W];
    to[RB_STACK_W] =
        A[RB_STACK_W][RB_STACK_U] * s[RB_STACK_U] + A[RB_STACK_W][RB_STACK_Y] * s[RB_STACK_Y];
    to[RB_STACK_X] =
        A[RB_STACK_X][RB_STACK_U] * s[RB_STACK_U] + A[RB_STACK_X][RB_STACK_Y] * s[RB_STACK_Y];
    to[RB_STACK_Y] = s[RB_STACK_X];
}

void rb_bem_stack_lift(const rb_bem_stack_row *row, const double a[4], const double s[4],
                       double to[4])
{
    double power[4][4] = {{s[0], s[1], s[2], s[3]}};

    for (int k = 1; k < 4; k++)
        times_A(row, power[k - 1], power[k]);
    for (int i = 0; i < 4; i++)
        to[i] = a[0] * power[0][i] - a[1] * power[1][i] + a[2] * power[2][i] - a[3] * power[3][i];
}

/* The compliance on the upper face from that on the lower one; down: tractions of the lower face by
 * those of the upper one, without exp(-k thickness). */
static void ascend(const rb_bem_stack_row *row, double k, const double below[2][2],
                   double above[2][2], double down[2][2])
{
    double u[2][2], t[2][2]; /* of the upper face, by tractions of one on the lower one */
    double a[4];

    rb_bem_stack_factors(k * row->thickness, a);
    for (int j = 0; j < 2; j++) {
        const double s[4] = {-below[0][j], -below[1][j], j == 0, j == 1};
        double to[4];
        rb_bem_stack_lift(row, a, s, to);
        for (int i = 0; i < 2; i++) {
            u[i][j] = to[i];
            t[i][j] = to[2 + i];
        }
    }
    const double det = t[0][0] * t[1][1] - t[0][1] * t[1][0];
    const double inverse[2][2] = {{t[1][1] / det, -t[0][1] / det}, {-t[1][0] / det, t[0][0] / det}};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            above[i][j] = -(u[i][0] * inverse[0][j] + u[i][1] * inverse[1][j]);
            down[i][j] = inverse[i][j];
        }
    above[0][1] = above[1][0] = 0.5 * (above[0][1] + above[1][0]);
    for (int i = 0; i < 2 && k * row->thickness > DEEP; i++)
        for (int j = 0; j < 2; j++)
            above[i][j] = row->half[i][j];
}

void rb_bem_stack_compliances(const rb_bem_stack_rows *rows, double k, double (*C)[2][2],
                              double (*down)[2][2])
{
    double unused[2][2];

    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            C[rows->n][i][j] = rows->elastic_base ? rows->row[rows->n].half[i][j] : 0.0;
    for (int j = rows->n - 1; j >= 0; j--)
        ascend(&rows->row[j], k, (const double(*)[2])C[j + 1], C[j], down ? down[j] : unused);
}
