/* Proofs of reactions: problems of whole numbers whose solution is known without rounding, forged
 * reactions, borders between zones, files. */
#include "check.h"
#include "lcp/friction/friction.h"
#include "numbers.h"

enum { MOST = 18, PROBLEMS = 4000, PARTS = 10 };

typedef enum { SEPARATED, STICK, SLIP, SMOOTH, BORDER } zone; /* BORDER: stick, |r_T| = mu r_N */

typedef struct {
    int d, nc, m, kinds[5];
    double W[MOST * MOST], q[MOST], mu[MOST], r[MOST];
} posed;

static unsigned seed;

static int below(int n)
{
    return (int)((uniform_from(&seed) + 1.0) * 0.5 * n) % n;
}

/* W = H'H + 20 I of whole numbers, so that mu = 1/2 leaves one solution; r and u in zones drawn,
 * the slip along (3, 4)/5; q = u - W r. */
static void pose(int number, int borders, posed *p)
{
    memset(p, 0, sizeof *p);
    seed = 77u + 1000003u * (unsigned)number;
    for (int k = 0; k < 4; k++)
        uniform_from(&seed);
    p->d = 2 + number % 2;
    p->nc = 1 + below(18 / p->d);
    p->m = p->d * p->nc;
    const int d = p->d, m = p->m;
    int H[MOST][MOST];
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++)
            H[i][j] = below(3) - 1;
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) {
            int sum = i == j ? 20 : 0;
            for (int k = 0; k < m; k++)
                sum += H[k][i] * H[k][j];
            p->W[i + j * m] = sum;
        }
    double u[MOST] = {0.0};
    for (int c = 0; c < p->nc; c++) {
        const int kind = below(borders ? 5 : 4), k = 1 + below(4), sign = below(2) ? 1 : -1;
        double *r = p->r + c * d, *v = u + c * d;
        p->kinds[kind]++;
        p->mu[c] = kind == SMOOTH ? 0.0 : 0.5;
        r[0] = kind == SEPARATED ? 0.0 : 10.0 * k;
        v[0] = kind == SEPARATED ? k : 0.0;
        if (kind == STICK)
            r[1] = sign * (below(5 * k) - 2 * k); /* below 5 k */
        if (kind == SEPARATED || kind == SMOOTH)
            v[1] = sign * below(3);
        if (kind == SLIP || kind == BORDER) {
            r[1] = sign * (d == 2 ? 5 : 3) * k;
            r[2 % d] = d == 2 ? r[0] : 4 * k;
        }
        for (int a = 1; a < d && kind == SLIP; a++)
            v[a] = -2.0 * r[a];
    }
    for (int i = 0; i < m; i++) {
        p->q[i] = u[i];
        for (int j = 0; j < m; j++)
            p->q[i] -= p->W[i + j * m] * p->r[j];
    }
}

static rb_friction_problem as_problem(posed *p)
{
    return (rb_friction_problem){.form = RB_FRICTION_LOCAL_DENSE,
                                 .dimension = p->d,
                                 .contacts = p->nc,
                                 .mu = p->mu,
                                 .W = p->W,
                                 .q = p->q};
}

static double distance(const posed *p, const double *r)
{
    double apart = 0.0, most = 0.0;
    for (int i = 0; i < p->m; i++) {
        apart = fmax(apart, fabs(r[i] - p->r[i]));
        most = fmax(most, fabs(p->r[i]));
    }
    return most > 0.0 ? apart / most : 0.0;
}

/* From the solution, from reactions that are a little off, and from others: what is proved lies
 * where the solution does. */
TEST(reactions_that_are_proved_are_solutions)
{
    int proved = 0, from_solution = 0, tried = 0;
    for (int number = 0; number < PROBLEMS; number++) {
        static posed p;
        if (!is_in_turn(number / 2, PARTS))
            continue;
        pose(number, 0, &p);
        const rb_friction_problem problem = as_problem(&p);
        for (int start = 0; start < 4; start++) {
            double r[MOST];
            const double off[] = {0.0, 1e-9, 1e-4, 1.0};
            for (int i = 0; i < p.m; i++)
                r[i] = p.r[i] * (1.0 + off[start] * uniform_from(&seed));
            rb_friction_proof proof;
            const rb_status s = rb_friction_prove_zones(&problem, r, &proof, &message);
            assert_int_equal(s, proof.proved ? RB_OK : RB_UNDECIDED);
            tried++;
            if (!proof.proved) {
                if (start < 2)
                    fail_msg("problem %d, start %d: %s", number, start, proof.reason);
                continue;
            }
            proved++;
            from_solution += start == 0;
            const double apart = distance(&p, r);
            CHECK_MAX(apart, proof.stored_within * (1.0 + 1e-15), "problem %d, start %d: %g",
                      number, start, apart / proof.stored_within - 1.0);
            CHECK_MAX(proof.stored_within, apart * (1.0 + 1e-12) + 1e-11, "problem %d, start %d",
                      number, start);
            for (int k = 0; k < 4; k++)
                assert_int_equal(proof.zones[k], p.kinds[k]);
            assert_true(proof.isolated);
            if (start == 0)
                CHECK_MAX(proof.nearby, 4e-15, "problem %d is exact", number);
        }
    }
    assert_true(from_solution * 4 == tried && proved > from_solution * 2);
}

/* Where a contact lies on the border between stick and slip no zone is strict. */
TEST(borders_between_zones_are_not_proved)
{
    int counted = 0;
    for (int number = 0; number < 200; number++) {
        static posed p;
        pose(number, 1, &p);
        if (!p.kinds[BORDER])
            continue;
        const rb_friction_problem problem = as_problem(&p);
        rb_friction_proof proof;
        CHECK_STATUS(rb_friction_prove_zones(&problem, p.r, &proof, &message), RB_UNDECIDED);
        CHECK_MAX(proof.nearby, 4e-15, "problem %d is exact", number);
        counted++;
    }
    assert_true(counted > 20);
}

/* The same contact twice shares its force in any way: not isolated, not proved, but exact. */
TEST(redundant_contacts_are_exact_for_data_nearby)
{
    double W[16] = {1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1}, q[] = {-3, .5, -3, .5},
           mu[] = {.5, .5}, r[] = {1, -.2, 2, -.3}, bad[] = {1, -.2, 2, NAN};
    const rb_friction_problem problem = {
        .form = RB_FRICTION_LOCAL_DENSE, .dimension = 2, .contacts = 2, .mu = mu, .W = W, .q = q};
    rb_friction_proof proof;
    CHECK_STATUS(rb_friction_prove_zones(&problem, r, &proof, &message), RB_UNDECIDED);
    CHECK_MAX(proof.nearby, 1e-15, "data nearby");
    CHECK_STATUS(rb_friction_prove_zones(&problem, bad, &proof, &message), RB_EINVAL);
}

/* A contact whose row reads no reaction and whose gap is zero touches exactly. */
TEST(contacts_that_touch_exactly_are_not_isolated)
{
    double W[16] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2}, q[] = {-4, 1, 0, 1},
           mu[] = {.5, .5}, r[] = {2, -.5, 0, 0};
    const rb_friction_problem problem = {
        .form = RB_FRICTION_LOCAL_DENSE, .dimension = 2, .contacts = 2, .mu = mu, .W = W, .q = q};
    rb_friction_proof proof;
    CHECK_OK(rb_friction_prove_zones(&problem, r, &proof, &message));
    assert_int_equal(proof.touching, 1);
    assert_false(proof.isolated);
}

static rb_status prove_without_memory(void *context)
{
    rb_friction_proof proof;
    return rb_friction_prove_zones(context, ((rb_friction_problem *)context)->q, &proof, NULL);
}

TEST(allocations_that_fail_are_said)
{
    static posed p;
    pose(3, 0, &p);
    rb_friction_problem problem = as_problem(&p);
    assert_true(alloc_fail_each(prove_without_memory, &problem) > 10);
}

RUN_TESTS(NULL, NULL)
