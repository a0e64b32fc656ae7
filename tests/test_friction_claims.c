/* Does any solver ever call a problem solved that is not?  Problems of many families, the
 * worst that can be made among them: without solution, indefinite, unsymmetric,
 * redundant, in units far from 1.  Every claim is judged here from W, q, mu and r alone,
 * in long double and without a call of the library.  5000 runs, with
 * ROLLBEM_TEST_ALL 200 000. */
#include "check.h"
#include "friction_problems.h"
#include "lcp/friction/friction.h"
#include "numbers.h"

enum { MOST = 36 }; /* rows */

typedef struct {
    int d, contacts, hopeless; /* hopeless: made so that it has no solution */
    double W[MOST * MOST], q[MOST], mu[MOST];
    const char *family;
} challenge;

static int below(unsigned *state, int n)
{
    return (int)((uniform_from(state) + 1.0) * 0.5 * n) % n;
}

/* W = H'H, q = H'v + noise with H random (motions x rows), its entries rounded to
 * integers where ties are wanted. */
static void gram(unsigned *seed, int motions, int ties, double noise, challenge *p)
{
    const int m = p->d * p->contacts;
    double H[MOST * MOST], v[MOST];
    for (int k = 0; k < motions * m; k++)
        H[k] = ties ? (double)(below(seed, 5) - 2) : uniform_from(seed);
    for (int j = 0; j < m; j += p->d) /* no normal without compliance */
        H[j * motions] += H[j * motions] < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < motions; i++)
        v[i] = ties ? (double)(below(seed, 5) - 2) : uniform_from(seed);
    for (int i = 0; i < m; i++) {
        p->q[i] = noise * uniform_from(seed);
        for (int k = 0; k < motions; k++)
            p->q[i] += H[k + i * motions] * v[k];
        for (int j = 0; j < m; j++) {
            double sum = 0.0;
            for (int k = 0; k < motions; k++)
                sum += H[k + i * motions] * H[k + j * motions];
            p->W[i + j * m] = sum;
        }
    }
}

/* The second contact pushes against the first, without friction, and together they close:
 * u_N1 + u_N2 = q_N1 + q_N2 < 0 whatever the forces are. */
static void wedge(unsigned *seed, challenge *p)
{
    const int d = p->d, m = d * p->contacts;
    for (int i = 0; i < m; i++) {
        p->W[d + i * m] = -p->W[i * m];
        p->W[i + d * m] = -p->W[i];
    }
    p->W[d + d * m] = p->W[0];
    p->W[d] = p->W[d * m] = -p->W[0];
    for (int a = 1; a < d; a++) /* of frictionless contacts the tangents do not matter */
        p->W[d + a * m] = -p->W[a * m], p->W[a + d * m] = -p->W[a];
    p->q[d] = -p->q[0] - 0.01 - 0.5 * fabs(uniform_from(seed));
    p->hopeless = 1;
}

static void scale(double w, double q, challenge *p)
{
    const int m = p->d * p->contacts;
    for (int k = 0; k < m * m; k++)
        p->W[k] *= w;
    for (int k = 0; k < m; k++)
        p->q[k] *= q;
}

static void pose(unsigned seed, challenge *p)
{
    static const char *const families[] = {"regular", "redundant",    "very redundant",
                                           "ties",    "unsymmetric",  "indefinite",
                                           "wedge",   "no solution?", "units"};
    static const double coefficients[] = {0.0, 0.05, 0.3, 0.7, 1.0, 2.0};
    const unsigned number = seed;
    seed = seed * 2654435761u + 12345u;
    for (int k = 0; k < 4; k++)
        uniform_from(&seed);
    *p = (challenge){.d = 2 + (int)(number % 2),
                     .contacts = 2 + below(&seed, 10),
                     .family = families[number / 2 % 9]};
    const int d = p->d, m = d * p->contacts;
    for (int c = 0; c < p->contacts; c++)
        p->mu[c] = coefficients[below(&seed, 6)];
    switch (number / 2 % 9) {
    case 0:
        gram(&seed, m, 0, 0.0, p);
        break;
    case 1:
        gram(&seed, 1 + m / 2, 0, 0.0, p);
        break;
    case 2:
        gram(&seed, d, 0, 0.0, p);
        break;
    case 3:
        gram(&seed, 1 + m / 2, 1, 0.0, p);
        break;
    case 4:
        gram(&seed, m, 0, 0.1, p);
        for (int k = 0; k < m * m; k++)
            p->W[k] += k % (m + 1) ? 0.2 * uniform_from(&seed) : 0.5;
        break;
    case 5:
        gram(&seed, m, 0, 0.1, p);
        for (int i = 0; i < m; i++)
            p->W[i * (m + 1)] *= i % d ? 0.7 : 1.0;
        break;
    case 6:
        gram(&seed, m, 0, 0.0, p);
        wedge(&seed, p);
        for (int c = 0; c < p->contacts; c++)
            p->mu[c] = 0.0;
        break;
    case 7: /* redundant, and q outside the range of H' */
        gram(&seed, 1 + m / 3, 0, 0.5, p);
        break;
    default:
        gram(&seed, 1 + m / 2, 0, 0.0, p);
        scale(pow(10.0, below(&seed, 13) - 6), pow(10.0, below(&seed, 13) - 6), p);
    }
}

/* ---- The judge --------------------------------------------------------------------- */

static long double sqr(long double x)
{
    return x * x;
}

/* Distance of (w r, u) of one contact from Coulomb's law: open, stick, or slip along u_T or
 * against r_T, whichever is nearest. */
static long double miss(int d, long double mu, long double w, const double *r, const long double *u)
{
    long double s[3] = {0.0L}, size = 0.0L, closed = 0.0L, st = 0.0L, ut = 0.0L;
    for (int a = 0; a < d; a++) {
        s[a] = w * r[a];
        size += sqr(s[a]);
        closed += sqr(u[a]);
        st += a ? sqr(s[a]) : 0.0L;
        ut += a ? sqr(u[a]) : 0.0L;
    }
    st = sqrtl(st);
    ut = sqrtl(ut);
    const long double L = hypotl(1.0L, mu), out = (st - mu * s[0]) / L;
    long double least = size + (u[0] < 0.0L ? sqr(u[0]) : 0.0L);
    if (out <= 0.0L && s[0] >= 0.0L)
        least = fminl(least, closed);
    else
        least = fminl(least, closed + (s[0] + mu * st > 0.0L ? sqr(out) : size));
    for (int side = -1; side <= 1; side += 2) {
        const long double length = side > 0 ? ut : -st;
        if (length == 0.0L)
            continue;
        long double a0 = s[0], b0 = 0.0L, far = sqr(u[0]);
        for (int a = 1; a < d; a++) {
            const long double v = (side > 0 ? u[a] : s[a]) / length;
            a0 -= mu * v * s[a];
            b0 += v * u[a];
        }
        a0 = fmaxl(a0, 0.0L) / sqr(L);
        b0 = fmaxl(b0, 0.0L);
        far += sqr(s[0] - a0);
        for (int a = 1; a < d; a++) {
            const long double v = (side > 0 ? u[a] : s[a]) / length;
            far += sqr(s[a] + a0 * mu * v) + sqr(u[a] - b0 * v);
        }
        least = fminl(least, far);
    }
    return sqrtl(least);
}

/* The scaled measure, the worst contact and the floor of docs/friction.md. */
static void assess(const challenge *p, const double *r, double *error, double *worst, double *floor)
{
    const int d = p->d, m = d * p->contacts;
    long double e = 0.0L, f = 0.0L, size = 0.0L, far[MOST], own[MOST];
    for (int c = 0; c < p->contacts; c++) {
        const long double w = p->W[c * d * (m + 1)], first = p->W[0];
        const long double D = exp2l(-floorl(0.5L * (ilogbl(w / first) + 1)));
        long double u[3], y = 0.0L, force = 0.0L;
        for (int a = 0; a < d; a++) {
            const int i = c * d + a;
            long double terms = fabsl((long double)p->q[i]);
            u[a] = p->q[i];
            for (int j = 0; j < m; j++) {
                const long double x = (long double)p->W[i + j * m] * r[j];
                u[a] += x;
                terms += fabsl(x);
            }
            y += sqr(D * terms);
            force += sqr(D * w * r[i]);
            size += sqr(D * p->q[i]);
        }
        f += y;
        far[c] = D * miss(d, p->mu[c], w, r + c * d, u);
        own[c] = sqrtl(fmaxl(y, force));
        e += sqr(far[c]);
    }
    *error = (double)sqrtl(e / size);
    *floor = (double)(1e-14L * sqrtl(f / size));
    *worst = 0.0;
    for (int c = 0; c < p->contacts; c++)
        *worst = fmax(*worst, (double)(far[c] / fmaxl(own[c], 1e-4L * sqrtl(size))));
}

/* ---- The runs ---------------------------------------------------------------------- */

typedef struct {
    int runs, claims, wrong, hopeless;
} count;

static void ask(const challenge *c, const rb_friction_solver *solver, double tol, count *n)
{
    const size_t m = (size_t)(c->d * c->contacts);
    double r[MOST], u[MOST], W[MOST * MOST], q[MOST], mu[MOST], error, worst, floor;
    memcpy(W, c->W, m * m * sizeof *W);
    memcpy(q, c->q, m * sizeof *q);
    memcpy(mu, c->mu, (size_t)c->contacts * sizeof *mu);
    const rb_friction_problem p = local_with(c->d, c->contacts, mu, W, q);
    rb_friction_options opt = rb_friction_defaults();
    rb_friction_info info;
    opt.tol = tol;
    opt.max_iters = 3000;
    n->runs++;
    n->hopeless += c->hopeless;
    if (rb_friction_solve(solver->name, &p, &opt, &(rb_friction_solution){r, u, NULL}, &info) !=
        RB_OK)
        return;
    n->claims++;
    assess(c, r, &error, &worst, &floor);
    const double allowed = fmax(tol, fmin(floor, 1e-6));
    if (!c->hopeless && error <= 1.01 * allowed + 0.1 * floor &&
        (info.scaled > tol || worst <= 1.01 * tol + 1e-14))
        return;
    n->wrong++;
    print_error("%s, %s in %dD, %d contacts, tol %g: claims %g and %g, is %g and %g%s\n",
                solver->name, c->family, c->d, c->contacts, tol, info.scaled, info.worst, error,
                worst, c->hopeless ? ", and there is no solution" : "");
}

TEST(no_solver_claims_what_is_not_so)
{
    static const double tolerances[] = {1e-8, 1e-4, 1e-12};
    const int wanted = getenv("ROLLBEM_TEST_ALL") ? 200000 : 5000;
    int solvers;
    const rb_friction_solver *all = rb_friction_solvers(&solvers);
    count n = {0};
    for (unsigned number = 0; n.runs < wanted; number++) {
        challenge c;
        pose(number, &c);
        for (int k = 0; k < solvers; k++)
            if (c.d == 2 || !(all[k].needs & RB_FRICTION_ONLY_2D))
                ask(&c, &all[k], tolerances[number % 3], &n);
    }
    print_message("%d runs, %d claims, %d wrong; %d runs on problems without solution\n", n.runs,
                  n.claims, n.wrong, n.hopeless);
    assert_int_equal(n.wrong, 0);
    assert_true(n.claims > n.runs / 2 && n.hopeless > n.runs / 20);
}

/* The judge sees a force that is a millionth off. */
TEST(the_judge_sees_small_errors)
{
    challenge c;
    double r[MOST], u[MOST], error, worst, floor;
    pose(0, &c);
    const rb_friction_problem p = local_with(c.d, c.contacts, c.mu, c.W, c.q);
    CHECK_OK(rb_friction_solve(NULL, &p, NULL, &(rb_friction_solution){r, u, NULL}, NULL));
    assess(&c, r, &error, &worst, &floor);
    CHECK_MAX(error, 1e-8, "a solution");
    int at = 0;
    while (r[at] == 0.0)
        at += c.d;
    r[at] *= 1.0 + 1e-6;
    assess(&c, r, &error, &worst, &floor);
    CHECK_MAX(1e-8, error, "no solution");
}

RUN_TESTS(NULL, NULL)
