/* Element matrices: two-node bars, four-node quads, eight-node bricks. */
#include "fem/fem.h"

#include <math.h>
#include <string.h>

rb_status rb_fem_bar_stiffness(const double x[6], const rb_fem_material *m, double K[36])
{
    const double d[3] = {x[3] - x[0], x[4] - x[1], x[5] - x[2]};
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(length > 0.0))
        return RB_EINVAL;
    const double k = m->young * m->section / (length * length * length);
    for (int a = 0; a < 6; a++)
        for (int b = 0; b < 6; b++)
            K[a + 6 * b] = (a / 3 == b / 3 ? k : -k) * d[a % 3] * d[b % 3];
    return RB_OK;
}

/* Corners of the reference square (first four) and cube. */
static const double corner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

typedef struct {
    double N[8];     /* shape functions */
    double dN[8][3]; /* their gradients in space */
    double jacobian; /* times the Gauss weight, which is 1 */
} gauss_point;

static rb_status at_gauss_point(int d, const double *x, int point, gauss_point *g)
{
    const double place = 1.0 / sqrt(3.0);
    double xi[3], local[8][3], inverse[3][3];
    double J[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, d == 2}};
    for (int k = 0; k < d; k++)
        xi[k] = point >> k & 1 ? place : -place;
    /* N_a = prod_k (1 + s_ak xi_k)/2 and its derivatives in the reference cell. */
    for (int a = 0; a < 1 << d; a++) {
        g->N[a] = 1.0;
        for (int k = 0; k < d; k++)
            g->N[a] *= 0.5 * (1.0 + corner[a][k] * xi[k]);
        for (int k = 0; k < d; k++) {
            local[a][k] = 0.5 * corner[a][k];
            for (int l = 0; l < d; l++)
                if (l != k)
                    local[a][k] *= 0.5 * (1.0 + corner[a][l] * xi[l]);
        }
    }
    for (int a = 0; a < 1 << d; a++)
        for (int i = 0; i < d; i++)
            for (int k = 0; k < d; k++)
                J[i][k] += x[d * a + i] * local[a][k];
    /* Inverse of the d x d matrix J (the rest of the 3 x 3 is the identity); its
     * determinant. */
    double det = 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int r = (j + 1) % 3, s = (j + 2) % 3, p = (i + 1) % 3, q = (i + 2) % 3;
            inverse[i][j] = J[r][p] * J[s][q] - J[r][q] * J[s][p];
        }
    for (int k = 0; k < 3; k++)
        det += J[0][k] * inverse[k][0];
    for (int i = 0; i < 9; i++)
        inverse[i / 3][i % 3] /= det;
    g->jacobian = det;
    for (int a = 0; a < 1 << d; a++)
        for (int i = 0; i < d; i++) {
            g->dN[a][i] = 0.0;
            for (int k = 0; k < d; k++)
                g->dN[a][i] += local[a][k] * inverse[k][i];
        }
    return g->jacobian > 0.0 ? RB_OK : RB_EINVAL;
}

static rb_status solid_stiffness(int d, const double *x, const rb_fem_material *m, double thickness,
                                 double *K)
{
    const double shear = 0.5 * m->young / (1.0 + m->poisson);
    const double lambda = 2.0 * shear * m->poisson / (1.0 - 2.0 * m->poisson);
    const int corners = 1 << d, n = d * corners;
    memset(K, 0, (size_t)(n * n) * sizeof *K);
    for (int point = 0; point < corners; point++) {
        gauss_point g;
        if (at_gauss_point(d, x, point, &g) != RB_OK)
            return RB_EINVAL;
        /* K_ai,bj += w [lambda N_a,i N_b,j + shear (N_a,j N_b,i + d_ij N_a,k N_b,k)] */
        const double w = thickness * g.jacobian;
        for (int b = 0; b < corners; b++)
            for (int a = 0; a < corners; a++) {
                double dot = 0.0;
                for (int k = 0; k < d; k++)
                    dot += g.dN[a][k] * g.dN[b][k];
                for (int j = 0; j < d; j++)
                    for (int i = 0; i < d; i++)
                        K[d * a + i + n * (d * b + j)] +=
                            w * (lambda * g.dN[a][i] * g.dN[b][j] +
                                 shear * (g.dN[a][j] * g.dN[b][i] + (i == j) * dot));
            }
    }
    return RB_OK;
}

rb_status rb_fem_quad_stiffness(const double x[8], const rb_fem_material *m, double K[64])
{
    return solid_stiffness(2, x, m, m->section, K);
}

rb_status rb_fem_brick_stiffness(const double x[24], const rb_fem_material *m, double K[576])
{
    return solid_stiffness(3, x, m, 1.0, K);
}

rb_status rb_fem_brick_mass(const double x[24], const rb_fem_material *m, double M[576])
{
    memset(M, 0, 576 * sizeof *M);
    for (int point = 0; point < 8; point++) {
        gauss_point g;
        if (at_gauss_point(3, x, point, &g) != RB_OK)
            return RB_EINVAL;
        for (int b = 0; b < 8; b++)
            for (int a = 0; a < 8; a++)
                for (int i = 0; i < 3; i++)
                    M[3 * a + i + 24 * (3 * b + i)] += m->density * g.jacobian * g.N[a] * g.N[b];
    }
    return RB_OK;
}
