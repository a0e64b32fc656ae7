/* Corrects rounding errors of the pivots with the original matrix: the residual, the
 * refinement of the constants along the path, and the refinement of the solution. */
#include "lcp/lemke/lemke.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

/* The constants are refreshed whenever z0 has fallen by this factor: otherwise z0 drowns
 * in rounding just when it should vanish. */
static const double REFRESH = 1e-3;

/* Beyond this relative defect a tableau is not refined but rebuilt. */
static const double DRIFT = 1e-12;

/* ---- The residual ------------------------------------------------------------------ */

enum { PANEL = 512 }; /* rows of w formed at a time: no memory is asked for */

/* Half of z and more is zero: only runs of other entries are gone through. */
static void add_product(int rows, int columns, const double *M, int ldm, const double *z, double *w)
{
    for (int from = 0, to; from < columns; from = to + 1) {
        for (to = from; to < columns && z[to] != 0.0;)
            to++;
        if (to > from)
            cblas_dgemv(CblasColMajor, CblasNoTrans, rows, to - from, 1.0,
                        M + (size_t)from * (size_t)ldm, ldm, z + from, 1, 1.0, w, 1);
    }
}

double rb_lcp_residual(const rb_lcp_problem *p, const double *z, double *w)
{
    double panel[PANEL], worst = 0.0;
    for (int first = 0; first < p->n; first += PANEL) {
        const int rows = p->n - first < PANEL ? p->n - first : PANEL;
        double *part = w ? w + first : panel;
        cblas_dcopy(rows, p->q + first, 1, part, 1);
        add_product(rows, p->n, p->M + first, p->ldm, z, part);
        for (int i = 0; i < rows; i++) { /* a NaN stays */
            const double m = z[first + i] < part[i] ? z[first + i] : part[i];
            worst =
                isnan(z[first + i]) || isnan(part[i]) || isnan(worst) ? NAN : fmax(worst, fabs(m));
        }
    }
    return worst;
}

/* ---- On the path ------------------------------------------------------------------- */

/* Of the variables first ... first + n - 1: the basic ones as given, `entering` 1, the
 * other nonbasic ones 0. */
static double values(const lemke *l, const double *basic, int entering, int first, double *x)
{
    for (int i = 0; i < l->n; i++) {
        const int v = first + i, row = l->t.place[v];
        x[i] = row >= 0 ? basic[row] : (double)(v == entering);
    }
    return rb_norm_inf((size_t)l->n, x);
}

/* r = constant + M z + d z0 - w at these values, which is zero but for rounding; constant
 * NULL: 0.  Returns max |r| as a part of the terms' size.  z: scratch. */
static double defect(const lemke *l, const double *constant, const double *basic, int entering,
                     double *z, double *r)
{
    const int n = l->n, z0_row = l->t.place[2 * n];
    const double z0 = z0_row >= 0 ? basic[z0_row] : (double)(entering == 2 * n);
    double size = values(l, basic, entering, 0, r);
    for (int i = 0; i < n; i++) {
        const double fixed = constant ? constant[i] : 0.0;
        const double cover = rb_lcp_cover(&l->data, i) * z0;
        size = fmax(size, fmax(fabs(fixed), fabs(cover)));
        r[i] = fixed + cover - r[i];
    }
    size = fmax(size, l->posed.largest * values(l, basic, entering, n, z));
    add_product(n, n, l->data.p.M, l->data.p.ldm, z, r);
    return size > 0.0 ? rb_norm_inf((size_t)n, r) / size : 0.0;
}

rb_status rb_lcp_lemke_rebuild(lemke *l)
{
    l->rebuilt = l->info->iters;
    const rb_status s = rb_lcp_tableau_rebuild(&l->t);
    return s == RB_ENOMEM ? rb_fail(&l->info->msg, s, "lcp: out of memory to rebuild the tableau")
                          : s;
}

rb_status rb_lcp_lemke_keep_accurate(lemke *l)
{
    const int many_pivots = l->info->iters - l->checked >= 50 + l->n / 4;
    if (!(many_pivots || lemke_z0(l) <= REFRESH * l->refreshed))
        return RB_OK;
    rb_status s = RB_SINGULAR;
    double *r = l->r, *before = l->scratch;
    memcpy(before, l->t.q, (size_t)l->n * sizeof *before);
    if (defect(l, l->data.p.q, l->t.q, -1, l->other, r) > DRIFT)
        s = rb_lcp_lemke_rebuild(l);
    if (s == RB_SINGULAR) {
        /* One step of iterative refinement: the tableau's columns of w hold minus the
         * basis inverse. */
        const int n = l->n, *place = l->t.place;
        memset(l->weight, 0, ((size_t)n + 1) * sizeof *l->weight);
        for (int i = 0; i < n; i++)
            if (place[i] >= 0)
                l->t.q[place[i]] += r[i];
            else
                l->weight[-1 - place[i]] = -r[i];
        rb_lcp_tableau_combine(&l->t, l->weight, l->other, l->sum);
        cblas_daxpy(n, 1.0, l->sum, 1, l->t.q, 1);
    }
    /* A constant that was zero stays zero: noise in its place would break ties. */
    const double zero = ZERO * rb_norm_inf((size_t)l->n, l->t.q);
    for (int i = 0; i < l->n; i++)
        if (before[i] == 0.0 && fabs(l->t.q[i]) <= zero)
            l->t.q[i] = 0.0;
    l->refreshed = lemke_z0(l);
    l->checked = l->info->iters;
    return s == RB_ENOMEM ? s : RB_OK;
}

int rb_lcp_lemke_column_holds(lemke *l, int entering)
{
    return l->rebuilt == l->info->iters ||
           defect(l, NULL, l->a, entering, l->other, l->scratch) <= DRIFT;
}

/* ---- The answer ------------------------------------------------------------------- */

typedef struct {
    int m, *index, *pivots; /* the basic z, n each */
    double *LU;             /* m x m: M_BB */
} final_basis;

/* x_B -= M_BB^-1 (M x + q)_B */
static void correct(const lemke *l, const final_basis *b, double *w, double *r, double *x)
{
    rb_lcp_residual(&l->data.p, x, w);
    for (int k = 0; k < b->m; k++)
        r[k] = w[b->index[k]];
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', b->m, 1, b->LU, b->m, b->pivots, r, b->m);
    for (int k = 0; k < b->m; k++)
        x[b->index[k]] -= r[k];
}

void rb_lcp_lemke_answer(lemke *l, int solved, double *z)
{
    const int n = l->n;
    for (int i = 0; i < n; i++) {
        const int row = l->t.place[n + i];
        z[i] = row >= 0 ? fmax(l->t.q[row], 0.0) : 0.0;
    }
    l->info->res = rb_lcp_residual(&l->data.p, z, NULL);
    if (!solved)
        return;
    /* Removes the pivots' rounding errors: z_B from the final basis B and the original
     * matrix, one factorisation (in the tableau's memory) and one correction.  Taken only
     * when it is the better of the two. */
    final_basis b = {.index = l->tied, .pivots = l->t.basis, .LU = l->t.T};
    double *x = l->t.q;
    const size_t ldm = (size_t)l->data.p.ldm;
    for (int i = 0; i < n; i++)
        if (l->t.place[n + i] >= 0)
            b.index[b.m++] = i;
    const size_t m = (size_t)b.m;
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < m; i++)
            b.LU[i + j * m] = l->data.p.M[(size_t)b.index[i] + (size_t)b.index[j] * ldm];
    if (m == 0 || LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, b.m, b.m, b.LU, b.m, b.pivots) != 0)
        return;
    memset(x, 0, (size_t)n * sizeof *x);
    correct(l, &b, l->a, l->other, x);
    correct(l, &b, l->a, l->other, x);
    for (int i = 0; i < n; i++)
        x[i] = fmax(x[i], 0.0);
    const double res = rb_lcp_residual(&l->data.p, x, NULL);
    if (res <= l->info->res) {
        memcpy(z, x, (size_t)n * sizeof *z);
        l->info->res = res;
    }
}
