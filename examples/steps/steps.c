/* Rolling contact from first principles in one file: what `rollbem` does for one case, by the
 * plainest means, on LAPACK alone.  Read it from top to bottom; the tags (B1), (K5) are those of
 * docs/theory.md.  Units mm, N, MPa; matrices are column-major, entry (i, j) is A[i + j * rows].
 *
 *     cc -O2 -o steps steps.c -llapack -lm
 *     ./steps 0.3 0.1                                 as rollbem --mu 0.3 --creep 0.1 --zone 35
 *     ./steps 0.3 0.1 steady                          as ... --formulation steady
 *     ./steps 0.3 0.001 steady halfplane 1000         as ... --support halfplane --load 1000
 *
 * mu, creepage xi, static or steady, wheel or halfplane, load P [N/mm] (0: approach R/2), zone
 * [mm]. Signs: x to the right, y up, the wheel A above rolls towards +x; pressure p >= 0; q
 * friction on A, positive towards +x; xi > 0 brakes the wheel: its surface slides towards +x. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern void dgesv_(const int *n, const int *columns, double *A, const int *lda, int *pivots,
                   double *b, const int *ldb, int *fault);

static const double PI = 3.14159265358979323846;

static double *zeros(int n)
{
    double *x = calloc((size_t)n, sizeof *x);
    if (!x)
        abort();
    return x;
}

/* ---- 1 The case: that of Addi, Adly, Goeleven and Thera (2006) where nothing else is said ---- */

static const double R = 50.0, E = 94500.0, NU = 0.1;             /* wheel on a rigid plane */
static const double ARC = 30.0 * 3.14159265358979323846 / 180.0; /* half of the clamped top */
enum { N = 60, M = N + 1 }; /* elements that may touch; and one more, upstream of them */

typedef struct {
    double mu, xi;     /* friction coefficient, creepage */
    int steady, plane; /* rolling, or displaced once; half-plane, or wheel */
    double load;       /* P [N/mm]; 0: the approach is given */
    double zone;       /* the elements that may touch lie in |x| < zone [mm] */
    double approach;   /* how far A is moved down [mm] */
    double shift;      /* static: how far A is moved towards +x [mm] */
} contact_case;

/* Before it is loaded the circle is this far above the plane (K1); not R - sqrt(R^2 - x^2), which
 * loses all digits of small x (B9). */
static double circle(double x)
{
    return x * x / (R + sqrt(R * R - x * x));
}

/* ---- 2 Boundary elements around the wheel (B4, B7) ------------------------------------------- */

enum { FREE, CLAMPED };
typedef struct {
    int n;
    double unit; /* unit of lengths in ln r, of the size of the wheel (B2) */
    double x0[1000], y0[1000], x1[1000], y1[1000];
    int kind[1000];
} mesh;

/* An element between two angles, from the lowest point counter-clockwise. */
static void add(mesh *m, double from, double to, int kind)
{
    const int e = m->n++;
    m->x0[e] = R * sin(from);
    m->y0[e] = 2.0 * R * pow(sin(0.5 * from), 2);
    m->x1[e] = R * sin(to);
    m->y1[e] = 2.0 * R * pow(sin(0.5 * to), 2);
    m->kind[e] = kind;
}

/* From the contact to the top the elements grow by 15 % of the distance s from it, from h up to 5
 * degrees: so many of them reach the distance s, and so far the first `count` of them reach. */
static const double GROWTH = 0.15, LARGEST = 5.0 * 3.14159265358979323846 / 180.0;
static double count_until(double h, double s)
{
    const double bend = (LARGEST - h) / GROWTH;
    return log1p(GROWTH * fmin(s, bend) / h) / GROWTH + fmax(s - bend, 0.0) / LARGEST;
}
static double reach_of(double h, double count)
{
    const double graded = count_until(h, (LARGEST - h) / GROWTH);
    return h * expm1(GROWTH * fmin(count, graded)) / GROWTH + fmax(count - graded, 0.0) * LARGEST;
}

/* Counter-clockwise, so that the body lies on the left: the N elements that may touch, one more
 * upstream, the right side up to the top, the left side down again. */
static void make_mesh(mesh *m, double zone)
{
    const double half = asin(zone / R), h = 2.0 * half / N, begin = half + h, side = PI - begin;
    const double free_part = count_until(h, side - ARC);
    const double arc_part = count_until(h, side) - free_part;
    const int free_n = (int)floor(free_part + 0.5), arc_n = (int)floor(arc_part + 0.5);
    double at[500];

    for (int k = 0; k <= free_n + arc_n; k++)
        at[k] = begin + reach_of(h, k <= free_n ? free_part * k / free_n
                                                : free_part + arc_part * (k - free_n) / arc_n);
    m->n = 0;
    for (int i = 0; i < M; i++)
        add(m, -half + i * h, -half + (i + 1) * h, FREE);
    for (int k = 0; k < free_n + arc_n; k++)
        add(m, at[k], at[k + 1], k < free_n ? FREE : CLAMPED);
    for (int k = free_n + arc_n; k > 0; k--)
        add(m, -at[k], -at[k - 1], k <= free_n ? FREE : CLAMPED);
    add(m, -begin, -half, FREE);
    m->unit = 0.0;
    for (int e = 0; e < m->n; e++)
        m->unit += sqrt(2.0) / PI * hypot(m->x1[e] - m->x0[e], m->y1[e] - m->y0[e]);
}

/* ---- 3 Kelvin's solution, integrated over an element in closed form (B2, B3) ------------------
 */

/* A load in direction i at (px, py): H[i][j] multiplies the displacement of element e in direction
 * j, G[i][j] its traction. */
static void integrate(const mesh *m, int e, double px, double py, double H[2][2], double G[2][2])
{
    const double shear = E / (2.0 * (1.0 + NU)), kap = 3.0 - 4.0 * NU;
    const double C = 1.0 / (8.0 * PI * shear * (1.0 - NU)), D = -1.0 / (4.0 * PI * (1.0 - NU));
    /* half-length a, tangent (tx, ty), outward normal (ty, -tx); the middle seen from p is X along
     * the tangent, d along the normal */
    const double ex = m->x1[e] - m->x0[e], ey = m->y1[e] - m->y0[e], a = 0.5 * hypot(ex, ey);
    const double tx = 0.5 * ex / a, ty = 0.5 * ey / a;
    const double dx = 0.5 * (m->x0[e] + m->x1[e]) - px, dy = 0.5 * (m->y0[e] + m->y1[e]) - py;
    const double X = dx * tx + dy * ty, d = dx * ty - dy * tx;
    const int self = dx == 0.0 && dy == 0.0;
    /* Lam = ln(r2/r1) of the distances to both ends, Th the angle between them, L = int ln r ds */
    const double dot = X * X + d * d - a * a, cross = 2.0 * a * d, W = dot * dot + cross * cross;
    const double Lam =
        self ? 0.0 : 0.5 * log(((X + a) * (X + a) + d * d) / ((X - a) * (X - a) + d * d));
    const double Th = self ? 0.0 : atan2(cross, dot);
    const double L = X * Lam + 0.5 * a * log(W) - 2.0 * a + d * Th - 2.0 * a * log(m->unit);
    const double cos2 = tx * tx - ty * ty, sin2 = 2.0 * tx * ty, s11 = a - d * Th, s12 = d * Lam;

    G[0][0] = C * (a - kap * L + cos2 * s11 + sin2 * s12);
    G[1][1] = C * (a - kap * L - cos2 * s11 - sin2 * s12);
    G[0][1] = G[1][0] = C * (sin2 * s11 - cos2 * s12);
    /* the free term 1/2 of a smooth contour stands on the diagonal (B1) */
    const double q = self ? 0.0 : cross / W;
    const double re = dx * dx - dy * dy - a * a * cos2, im = 2.0 * dx * dy - a * a * sin2;
    H[0][0] = D * (2.0 * (1.0 - NU) * Th + q * re) + (self ? 0.5 : 0.0);
    H[1][1] = D * (2.0 * (1.0 - NU) * Th - q * re) + (self ? 0.5 : 0.0);
    H[0][1] = D * (q * im + (1.0 - 2.0 * NU) * Lam);
    H[1][0] = D * (q * im - (1.0 - 2.0 * NU) * Lam);
}

/* ---- 4 Flexibility of the contact: w = F r ----------------------------------------------------
 */

/* F is 2M x 2N: displacements w_N (up) and w_T (to the right) of the elements that may touch and of
 * the one upstream, by their pressures r_N and frictions r_T. */

/* A wheel: H u = G t (B1).  Where tractions are given, the displacements are unknown, on clamped
 * elements the tractions: A x = G_c t_c (B4), solved for 2N unit tractions (B5). */
static double *flexibility_wheel(const mesh *m)
{
    const int size = 2 * m->n, columns = 2 * N;
    double *A = zeros(size * size), *X = zeros(size * columns), *F = zeros(2 * M * columns);
    int *pivots = malloc((size_t)size * sizeof *pivots), fault = 0;

    for (int p = 0; p < m->n; p++)
        for (int e = 0; e < m->n; e++) {
            double H[2][2], G[2][2];
            integrate(m, e, 0.5 * (m->x0[p] + m->x1[p]), 0.5 * (m->y0[p] + m->y1[p]), H, G);
            for (int i = 0; i < 2; i++)
                for (int j = 0; j < 2; j++) {
                    A[2 * p + i + (2 * e + j) * size] =
                        m->kind[e] == CLAMPED ? -E * G[i][j] : H[i][j];
                    if (e < N) /* a unit pressure pushes along y, friction along x */
                        X[2 * p + i + (j == 1 ? e : N + e) * size] = G[i][j];
                }
        }
    dgesv_(&size, &columns, A, &size, pivots, X, &size, &fault);
    if (fault)
        abort(); /* nothing holds the wheel (B6) */
    for (int c = 0; c < columns; c++)
        for (int i = 0; i < M; i++) {
            F[i + c * 2 * M] = X[2 * i + 1 + c * size];
            F[M + i + c * 2 * M] = X[2 * i + c * size];
        }
    free(A);
    free(X);
    free(pivots);
    return F;
}

/* A half-plane instead: Flamant's solution, integrated over elements of length h; the surface at
 * the distance 2R/e does not move, as in a half-cylinder that is held at its middle (B6). */
static double *flexibility_halfplane(double h)
{
    const double c = (1.0 - 2.0 * NU) * (1.0 + NU) / (2.0 * E), datum = 2.0 * R / exp(1.0);
    double *F = zeros(2 * M * 2 * N);

    for (int j = 0; j < N; j++)
        for (int i = 0; i < M; i++) {
            const double l = (i - j - 0.5) * h, r = (i - j + 0.5) * h;
            const double log_part = r * log(fabs(r) / datum) - l * log(fabs(l) / datum) - h;
            const double w = -2.0 * (1.0 - NU * NU) / (PI * E) * log_part;
            double *N_N = F + i + j * 2 * M, *N_T = N_N + N * 2 * M;
            N_N[0] = w;
            N_T[M] = w;
            N_T[0] = c * (fabs(r) - fabs(l)); /* friction lifts what lies ahead of it */
            N_N[M] = -N_T[0];                 /* pressure draws the surface towards itself */
        }
    return F;
}

/* ---- 5 Contact and friction as one complementarity problem (K1, K2, K3, K5) -------------------
 */

/* Surfaces that slide do so towards `sense` or back.  With the friction r_T = sense (g - mu r_N),
 *     gap            y = d_N + F_NN r_N + F_NT r_T           y >= 0,  r_N >= 0,  one of them 0 (K1)
 *     slip    s+ - s-  = sense (d_T + A (F_TN r_N + F_TT r_T)) (K2) friction       g >= 0 with s+
 * >= 0,   2 mu r_N - g >= 0 with s- >= 0                      (K3) is w = T z + b for z = (r_N, g,
 * s-) and w = (y, s+, 2 mu r_N - g) (K5).  Displaced once, A = I: slip is the shift.  In steady
 * rolling material comes from upstream, A = I - S: it slips by the difference to the next element
 * at +x.  Tractions count in E, lengths in R.  b is the last column of [T b]. */
static double *contact_lcp(const contact_case *c, const double *F, const double *x)
{
    const int n = 3 * N, next = c->steady ? 1 : 0;
    const double sense = (c->steady ? c->xi : c->shift) < 0.0 ? -1.0 : 1.0, mu = c->mu;
    double *T = zeros(n * (n + 1));

    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            const double *NN = F + i + j * 2 * M, *NT = NN + N * 2 * M, *TN = NN + M, *TT = NT + M;
            const double A_TN = TN[0] - next * TN[next], A_TT = TT[0] - next * TT[next];
            T[i + j * n] = E / R * (NN[0] - sense * mu * NT[0]);
            T[i + (N + j) * n] = E / R * sense * NT[0];
            T[N + i + j * n] = E / R * (sense * A_TN - mu * A_TT);
            T[N + i + (N + j) * n] = E / R * A_TT;
        }
    for (int i = 0; i < N; i++) {
        T[N + i + (2 * N + i) * n] = 1.0;
        T[2 * N + i + i * n] = 2.0 * mu;
        T[2 * N + i + (N + i) * n] = -1.0;
        T[i + n * n] = (circle(x[i]) - c->approach) / R;
        T[N + i + n * n] = sense * (c->steady ? c->xi * (x[i + 1] - x[i]) : c->shift) / R;
    }
    return T;
}

/* ---- 6 Lemke's method (Cottle, Pang, Stone, section 4.4) --------------------------------------
 */

/* w = M z + b + z0, all w basic: z0 rises until every w >= 0, and takes the place of the w that was
 * least.  Then the partner of what left enters and rises until a basic variable falls to zero,
 * which leaves, until that is z0.  Variables: w_i is i, z_i is n + i, z0 is 2n.  Mb = [M b].
 * Returns the number of pivots, less than 0 where nothing stops what enters (a ray: no solution
 * found). */
static int lemke(int n, const double *Mb, double *z)
{
    int *basic = malloc((size_t)n * sizeof(int)), *column = malloc(((size_t)n + 1) * sizeof(int));
    double *t = zeros(n * (n + 2)), *q = t + n * (n + 1); /* basic = q + t nonbasic */
    int pivots = 0, enters = 2 * n, row = 0, solved = 0;

    memcpy(t, Mb, (size_t)(n * n) * sizeof *t);
    memcpy(q, Mb + n * n, (size_t)n * sizeof *q);
    for (int i = 0; i < n; i++) {
        basic[i] = i;
        column[i] = n + i;
        t[i + n * n] = 1.0; /* of z0 */
        row = q[i] < q[row] ? i : row;
    }
    column[n] = 2 * n;
    solved = q[row] >= 0.0;
    while (!solved && pivots < 50 * n) {
        int c = 0;
        while (column[c] != enters)
            c++;
        /* ratio test: which basic variable falls to zero first? where z0 is among them, z0 */
        if (pivots > 0) {
            double least = INFINITY;
            row = -1;
            for (int i = 0; i < n; i++) {
                const double ratio = t[i + c * n] < -1e-11 ? -q[i] / t[i + c * n] : INFINITY;
                if (ratio < least - 1e-13 || (basic[i] == 2 * n && ratio <= least + 1e-13)) {
                    least = ratio;
                    row = i;
                }
            }
            if (row < 0)
                break;
        }
        /* exchange: solve that row for what enters, and put it into all others */
        const double pivot = t[row + c * n];
        for (int k = 0; k <= n + 1; k++)
            t[row + k * n] = k == c ? 1.0 / pivot : -t[row + k * n] / pivot;
        for (int k = 0; k <= n + 1; k++)
            for (int i = 0; i < n && k != c; i++)
                if (i != row)
                    t[i + k * n] += t[i + c * n] * t[row + k * n];
        for (int i = 0; i < n; i++)
            if (i != row)
                t[i + c * n] /= pivot;
        const int leaves = basic[row];
        basic[row] = enters;
        column[c] = leaves;
        enters = leaves < n ? leaves + n : leaves - n; /* its partner */
        solved = leaves == 2 * n;
        pivots++;
    }
    memset(z, 0, (size_t)n * sizeof *z);
    for (int i = 0; i < n; i++)
        if (basic[i] >= n && basic[i] < 2 * n)
            z[basic[i] - n] = q[i];
    free(basic);
    free(column);
    free(t);
    return solved ? pivots : -pivots - 1;
}

/* ---- 7 Solve, under a given load for the approach that carries it -----------------------------
 */

/* The load grows with the approach, from nothing at 0: secants.  Returns the pivots of the last. */
static int solve(contact_case *c, const double *F, const double *x, const double *h, double *z)
{
    double before = 0.0, P_before = 0.0;
    for (int k = 0;; k++) {
        double *T = contact_lcp(c, F, x), P = 0.0;
        const int pivots = lemke(3 * N, T, z);
        free(T);
        for (int i = 0; i < N; i++)
            P += E * z[i] * h[i];
        if (c->load == 0.0 || fabs(P - c->load) < 1e-14 * c->load || k == 50)
            return pivots;
        const double step = (c->load - P) * (c->approach - before) / (P - P_before);
        before = c->approach;
        P_before = P;
        c->approach += step;
    }
}

int main(int argc, char **argv)
{
    contact_case c = {.mu = argc > 1 ? atof(argv[1]) : 0.3, .xi = argc > 2 ? atof(argv[2]) : 0.1};
    c.steady = argc > 3 && !strcmp(argv[3], "steady");
    c.plane = argc > 4 && !strcmp(argv[4], "halfplane");
    c.load = argc > 5 ? atof(argv[5]) : 0.0;
    c.zone = argc > 6 ? atof(argv[6]) : 35.0;
    c.approach = c.load > 0.0 ? 1e-3 * R : 0.5 * R;
    c.shift = c.load > 0.0 ? 0.0 : 0.1 * c.approach;

    static mesh m; /* mesh, then flexibility */
    double x[M], h[M], z[3 * N], r[2 * N], w[2 * M], P = 0.0, Q = 0.0, residual = 0.0;

    make_mesh(&m, c.zone);
    for (int i = 0; i < M; i++) {
        h[i] = c.plane ? 2.0 * c.zone / N : hypot(m.x1[i] - m.x0[i], m.y1[i] - m.y0[i]);
        x[i] = c.plane ? -c.zone + (i + 0.5) * h[i] : 0.5 * (m.x0[i] + m.x1[i]);
    }
    double *F = c.plane ? flexibility_halfplane(h[0]) : flexibility_wheel(&m);

    /* contact and friction; then tractions from the unknowns, displacements from the tractions */
    const int pivots = solve(&c, F, x, h, z);
    const double sense = (c.steady ? c.xi : c.shift) < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < N; i++) {
        r[i] = E * z[i];
        r[N + i] = sense * E * (z[N + i] - c.mu * z[i]);
    }
    for (int i = 0; i < 2 * M; i++) {
        w[i] = 0.0;
        for (int j = 0; j < 2 * N; j++)
            w[i] += F[i + j * 2 * M] * r[j];
    }

    /* the table; slip: of steady rolling that of the problem, else afterwards by (12) */
    printf("x_mm\tgap_mm\tp_MPa\tq_MPa\tshift_mm\tslip\tzone\n");
    for (int i = 0; i < N; i++) {
        const double gap = circle(x[i]) + w[i] - c.approach, p = r[i], q = r[N + i];
        const double dx = x[i + 1] - x[i], stretch = w[M + i + 1] - w[M + i];
        double moved = c.steady ? c.xi * dx - stretch : c.shift + w[M + i];
        enum { APART, STICK, SLIP, SLIP_BACK } zone = SLIP; /* q = -mu p; q = +mu p */
        if (p == 0.0)
            zone = APART;
        else if (z[N + i] > 0.0 && z[2 * N + i] == 0.0)
            zone = STICK;
        else if ((z[2 * N + i] > 0.0) != (sense < 0.0))
            zone = SLIP_BACK;
        /* what is left of (K1) to (K3): the proof that this is a solution */
        /* what is left of (K1) to (K3): the proof that this is a solution */
        const double law = zone == STICK ? moved / R : (q + (zone == SLIP ? 1 : -1) * c.mu * p) / E;
        residual = fmax(residual, fmax(fabs(fmin(p / E, gap / R)), fabs(law)));
        residual = fmax(residual, (fabs(q) - c.mu * p) / E);
        P += p * h[i];
        Q += q * h[i];
        moved = zone == STICK ? 0.0 : moved;
        printf("%.13g\t%.13g\t%.13g\t%.13g\t%.13g\t%.13g\t%d\n", x[i], gap, p, q, moved,
               c.steady ? moved / dx : c.xi - stretch / dx, zone);
    }
    fprintf(stderr, "%s, %d pivots, residual %.2g: P = %.12g, Q = %.12g N/mm, approach %.12g mm\n",
            pivots < 0 ? "not solved" : "solved", abs(pivots), residual, P, Q, c.approach);
    free(F);
    return pivots < 0;
}
