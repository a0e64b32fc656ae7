/* Rolling friction: balls whose laws of slip and of rolling are judged contact by contact
 * from the equations of motion. */
#define _XOPEN_SOURCE 700
#include "check.h"
#include "lcp/friction/friction.h"
#include "base/io/io_fclib.h"
#include "scratch.h"
#include "numbers.h"

#include <unistd.h>

enum { MOST = 12, CONTACTS = 2 * MOST, ROWS = 5 * CONTACTS, DOFS = 6 * MOST };

#define INERTIA 0.1 /* of a ball of mass 1 and diameter 1 */

/* Balls in a row on the ground: each touches the ground and its neighbours.  H: dofs x
 * rows, column-major. */
typedef struct {
    int balls, contacts, dofs, rows;
    double H[DOFS * ROWS], v[DOFS], mu, mu_r;
    double w[ROWS]; /* u = H'v + w: what moves by itself */
} row_of_balls;

/* Column of one direction at contact c: b is pushed along t, a against it; a turn: the
 * same for the rates. */
static void push(row_of_balls *s, int column, const int body[2], const double n[3],
                 const double t[3], int turn)
{
    for (int k = 0; k < 2; k++) {
        if (body[k] < 0)
            continue;
        double *h = s->H + column * s->dofs + 6 * body[k], arm[3];
        const double sign = k ? 1.0 : -1.0;
        for (int i = 0; i < 3; i++) {
            arm[i] = (k ? -0.5 : 0.5) * n[i];
            h[i + (turn ? 3 : 0)] = sign * t[i];
        }
        for (int i = 0; !turn && i < 3; i++) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            h[3 + i] = sign * (arm[j] * t[l] - arm[l] * t[j]);
        }
    }
}

static void make_row(int balls, double mu, double mu_r, unsigned seed, row_of_balls *s)
{
    memset(s, 0, sizeof *s);
    s->balls = balls, s->mu = mu, s->mu_r = mu_r;
    s->contacts = 2 * balls - 1, s->dofs = 6 * balls, s->rows = 5 * s->contacts;
    for (int c = 0; c < s->contacts; c++) {
        const int on_ground = c < balls;
        const int body[2] = {on_ground ? -1 : c - balls, on_ground ? c : c - balls + 1};
        const double n[3] = {!on_ground, on_ground, 0.0};
        const double t[2][3] = {{on_ground, -!on_ground, 0.0}, {0.0, 0.0, 1.0}};
        push(s, 5 * c, body, n, n, 0);
        for (int a = 0; a < 2; a++) {
            push(s, 5 * c + 1 + a, body, n, t[a], 0);
            push(s, 5 * c + 3 + a, body, n, t[a], 1);
        }
    }
    for (int i = 0; i < s->dofs; i++)
        s->v[i] = i % 6 == 1 ? -1.0 : 0.5 * uniform_from(&seed);
}

static double mass(int dof)
{
    return dof % 6 < 3 ? 1.0 : INERTIA;
}

/* In lengths of 1/unit and masses of 1: what a file in other units would hold. */
static void as_file(const row_of_balls *s, double unit, rb_io_fclib *p)
{
    const size_t n = (size_t)s->dofs, nc = (size_t)s->contacts;
    SCRATCH double *H = rb_alloc(n, (size_t)s->rows);
    OWNED(rb_triplets) M = {.rows = s->dofs, .cols = s->dofs};
    *p = (rb_io_fclib){.global = 1,
                       .rolling = 1,
                       .spacedim = 5,
                       .contacts = s->contacts,
                       .f = rb_alloc(n, 1),
                       .w = rb_alloc(5 * nc, 1),
                       .mu = rb_alloc(nc, 1),
                       .mu_r = rb_alloc(nc, 1)};
    for (int i = 0; i < s->dofs; i++) {
        const int turns = i % 6 > 2;
        const double m = mass(i) * (turns ? unit * unit : 1.0);
        rb_triplets_add(&M, i, i, m);
        p->f[i] = m * s->v[i] * (turns ? 1.0 : unit);
        for (int k = 0; k < s->rows; k++) /* slip: arms are lengths; turns: rates */
            H[i + k * s->dofs] = s->H[i + k * s->dofs] * (turns && k % 5 < 3 ? unit : 1.0);
    }
    for (int c = 0; c < s->contacts; c++)
        p->mu[c] = s->mu, p->mu_r[c] = unit * s->mu_r;
    for (int k = 0; k < s->rows; k++)
        p->w[k] = s->w[k] * (k % 5 < 3 ? unit : 1.0);
    CHECK_OK(rb_sparse_from_triplets(&M, &p->M));
    CHECK_OK(rb_sparse_from_dense(s->dofs, s->rows, H, s->dofs, &p->H));
}

/* Largest violation of both laws, u recomputed from r by M v = H r + f. */
static double violation(const row_of_balls *s, const double *r)
{
    double v[DOFS], u[ROWS], worst = 0.0;
    for (int i = 0; i < s->dofs; i++) {
        v[i] = s->v[i];
        for (int k = 0; k < s->rows; k++)
            v[i] += s->H[i + k * s->dofs] * r[k] / mass(i);
    }
    for (int k = 0; k < s->rows; k++) {
        u[k] = s->w[k];
        for (int i = 0; i < s->dofs; i++)
            u[k] += s->H[i + k * s->dofs] * v[i];
    }
    for (int c = 0; c < s->contacts; c++) {
        const double *F = r + 5 * c, *V = u + 5 * c;
        worst = fmax(worst, fmax(-F[0], fmax(-V[0], fabs(F[0] * V[0]))));
        worst = fmax(worst, hypot(F[1], F[2]) - s->mu * F[0]);
        worst = fmax(worst, hypot(F[3], F[4]) - s->mu_r * F[0]);
        worst = fmax(worst, fabs(s->mu * F[0] * hypot(V[1], V[2]) + F[1] * V[1] + F[2] * V[2]));
        worst = fmax(worst, fabs(s->mu_r * F[0] * hypot(V[3], V[4]) + F[3] * V[3] + F[4] * V[4]));
    }
    return worst;
}

/* Through a file, solved, as five entries per contact. */
static rb_status solve_row(const row_of_balls *s, double unit, const char *solver, double *r,
                           double *u)
{
    OWNED(rb_io_fclib) file;
    OWNED(rb_friction_problem) p;
    rb_friction_options opt = rb_friction_defaults();
    as_file(s, unit, &file);
    CHECK_OK(rb_io_fclib_write(path, &file, RB_IO_FCLIB_CSC, "", "", &message));
    CHECK_OK(rb_friction_read(path, &p, &message));
    assert_int_equal(p.contacts, 2 * s->contacts);
    opt.tol = 1e-9;
    const rb_status st =
        rb_friction_solve(solver, &p, &opt, &(rb_friction_solution){r, u, NULL}, NULL);
    rb_friction_unite_rolling(&p, r, u, r, u);
    for (int k = 0; k < s->rows; k++)
        r[k] /= k % 5 < 3 ? unit : unit * unit; /* back to lengths of 1 */
    return st;
}

TEST(rows_of_balls_obey_both_laws)
{
    static const struct {
        int balls;
        double mu, mu_r;
    } cases[] = {{1, 0.5, 0.05}, {1, 0.5, 0.5},  {2, 0.3, 0.02}, {3, 0.5, 0.05}, {5, 0.8, 0.2},
                 {8, 0.3, 0.01}, {12, 0.5, 0.1}, {4, 0.0, 0.1},  {4, 0.5, 0.0}};
    static double r[6 * CONTACTS], u[6 * CONTACTS];
    unsigned random = 8;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (unsigned seed = 1; seed < 4; seed++) {
            row_of_balls s;
            make_row(cases[k].balls, cases[k].mu, cases[k].mu_r, seed, &s);
            const int is_tried = is_in_turn((int)(k + seed), 3);
            if (is_tried) {
                CHECK_OK(solve_row(&s, 1.0, "auto", r, u));
                CHECK_MAX(violation(&s, r), 1e-7, "%d balls, mu %g, mu_r %g", s.balls, s.mu,
                          s.mu_r);
            }
            for (int i = 0; i < s.rows; i++)
                s.w[i] = 0.2 * uniform_from(&random);
            if (is_tried) {
                CHECK_OK(solve_row(&s, 2.0, "auto", r, u));
                CHECK_MAX(violation(&s, r), 1e-7, "%d balls, moved", s.balls);
            }
        }
}

TEST(every_family_of_solvers_takes_it)
{
    static const char *const names[] = {"nsn-ac",  "nsn-fb",        "nsn-ac-hybrid",
                                        "nsgs-ac", "nsgs-aa",       "nsgs-fp",
                                        "admm",    "extragradient", "soclcp-smoothing"};
    static double r[6 * CONTACTS], u[6 * CONTACTS];
    row_of_balls s;
    make_row(3, 0.5, 0.05, 5, &s);
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        CHECK_OK(solve_row(&s, 1.0, names[k], r, u));
        CHECK_MAX(violation(&s, r), 1e-6, "%s", names[k]);
    }
}

/* One ball, thrown down and along x at speed V without spin, r_N = 1.  Sliding to the
 * end: |r_T| = mu; rolling is stopped by the moment mu_r r_N at most. */
TEST(one_ball_slides_rolls_or_stops)
{
    double r[6], u[6];
    row_of_balls s;
    make_row(1, 0.1, 0.01, 1, &s);
    memset(s.v, 0, sizeof s.v);
    s.v[0] = 2.0, s.v[1] = -1.0;
    CHECK_OK(solve_row(&s, 1.0, "nsn-fb", r, u));
    CHECK_ABS(r[0], 1.0, 1e-7, "r_N");
    CHECK_ABS(fabs(r[1]), 0.1, 1e-7, "it slides");
    CHECK_ABS(hypot(r[3], r[4]), 0.01, 1e-7, "and turns");
    /* rate: (mu R - mu_r) r_N / J, about -z */
    CHECK_ABS(hypot(u[3], u[4]), (0.1 * 0.5 - 0.01) / INERTIA, 1e-6, "rate");

    s.mu = 5.0, s.mu_r = 0.1; /* sticks: R r_T - mu_r r_N = J w, 2 - r_T = R w */
    CHECK_OK(solve_row(&s, 1.0, "nsn-fb", r, u));
    const double rate = (0.5 * 2.0 - 0.1) / (INERTIA + 0.25);
    CHECK_ABS(hypot(u[3], u[4]), rate, 1e-6, "it rolls");
    CHECK_ABS(hypot(u[1], u[2]), 0.0, 1e-6, "without slip");

    s.mu_r = 1.5; /* more than R V: it stops */
    CHECK_OK(solve_row(&s, 1.0, "nsn-fb", r, u));
    CHECK_ABS(hypot(u[3], u[4]), 0.0, 1e-6, "it stops");
    CHECK_ABS(hypot(r[3], r[4]), 1.0, 1e-6, "by R V");
}

TEST(units_do_not_matter)
{
    static double r[6 * CONTACTS], u[6 * CONTACTS];
    row_of_balls s;
    make_row(4, 0.5, 0.05, 2, &s);
    for (double unit = 0.0078125; unit < 1e3; unit *= 128.0) {
        CHECK_OK(solve_row(&s, unit, "auto", r, u));
        CHECK_MAX(violation(&s, r), 1e-7, "lengths of 1/%g", unit);
    }
}

/* A held ball (bilateral constraints on its rates of turn) does not roll. */
TEST(constraints_go_with_rolling_friction)
{
    double r[6], u[6];
    int turns[] = {3, 4, 5}, each[] = {0, 1, 2};
    double one[] = {1.0, 1.0, 1.0};
    row_of_balls s;
    OWNED(rb_io_fclib) file;
    OWNED(rb_friction_problem) p;
    make_row(1, 0.1, 0.01, 1, &s);
    memset(s.v, 0, sizeof s.v);
    s.v[0] = 2.0, s.v[1] = -1.0;
    as_file(&s, 1.0, &file);
    file.constraints = 3;
    file.b = rb_alloc(3, 1);
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 6, .cols = 3, .nz = 3, .row = turns, .col = each, .x = one},
        &file.G));
    CHECK_OK(rb_io_fclib_write(path, &file, RB_IO_FCLIB_CSC, "", "", &message));
    CHECK_OK(rb_friction_read(path, &p, &message));
    CHECK_OK(rb_friction_solve(NULL, &p, NULL, &(rb_friction_solution){r, u, NULL}, NULL));
    rb_friction_unite_rolling(&p, r, u, r, u);
    CHECK_ABS(fabs(r[1]), 0.1, 1e-7, "it slides");
    CHECK_ABS(hypot(u[3], u[4]), 0.0, 1e-9, "and does not turn");
    CHECK_STATUS(rb_friction_write(path, &p, NULL, "", &message), RB_EINVAL);
}

/* Two contacts stand for a rolling one and carry the same pressure: what they do together
 * is what the united one does. */
TEST(united_entries_do_the_same_work)
{
    const double r[6] = {3.0, 0.5, -0.7, 3.0, 0.2, 0.9}, u[6] = {0.4, -1.0, 2.0, -0.3, 5.0, 0.25};
    double force[5], velocity[5], length[1] = {0.8}, apart = 0.0, together = 0.0;
    rb_friction_problem p = {.contacts = 2, .dimension = 3, .lengths = length};
    rb_friction_unite_rolling(&p, r, u, force, velocity);
    for (int i = 0; i < 6; i++)
        apart += r[i] * u[i];
    for (int i = 0; i < 5; i++)
        together += force[i] * velocity[i];
    CHECK_REL(together, apart, 1e-14, "work");
    CHECK_REL(force[3], 0.8 * 0.2, 1e-14, "moment");
    CHECK_REL(velocity[0], 0.1, 1e-12, "approach");
}

TEST(the_program_tells_five_entries_per_contact)
{
    const char *build = getenv("B") ? getenv("B") : "build";
    char command[300], line[300];
    int rows = 0, contacts = 0, dimension = 0;
    row_of_balls s;
    OWNED(rb_io_fclib) file;
    make_row(3, 0.5, 0.05, 5, &s);
    as_file(&s, 1.0, &file);
    CHECK_OK(rb_io_fclib_write(path, &file, RB_IO_FCLIB_CSC, "", "", &message));
    snprintf(command, sizeof command, "%s/rollbem friction --solution %s", build, path);
    FILE *out = popen(command, "r");
    while (fgets(line, sizeof line, out))
        rows += line[0] == '/';
    assert_int_equal(pclose(out), 0);
    assert_int_equal(rows, s.rows);
    snprintf(command, sizeof command, "%s/rollbem friction %s", build, path);
    out = popen(command, "r");
    while (fgets(line, sizeof line, out))
        sscanf(line, "/%*s %*s %*s %d %d", &contacts, &dimension);
    assert_int_equal(pclose(out), 0);
    assert_int_equal(contacts, 5);
    assert_int_equal(dimension, 5);
}

TEST(bad_problems_are_refused)
{
    row_of_balls s;
    rb_io_fclib file;
    rb_friction_problem p;
    make_row(1, 0.1, 0.01, 1, &s);
    as_file(&s, 1.0, &file);
    file.mu_r[0] = -1.0;
    CHECK_OK(rb_io_fclib_write(path, &file, RB_IO_FCLIB_CSC, "", "", &message));
    CHECK_SAYS(rb_friction_read(path, &p, &message), RB_EFORMAT, "mu_r of contact 1 is -1");
    file.mu_r[0] = 0.1;
    file.spacedim = 3; /* six columns of H are no multiple */
    CHECK_OK(rb_io_fclib_write(path, &file, RB_IO_FCLIB_CSC, "", "", &message));
    CHECK_SAYS(rb_friction_read(path, &p, &message), RB_EFORMAT, "spacedim is 3, expected 5");
    rb_io_fclib_free(&file);
    for (int count = 0, done = 0; !done; count++) {
        assert_true(count < 100);
        as_file(&s, 1.0, &file);
        p = (rb_friction_problem){.form = RB_FRICTION_GLOBAL,
                                  .dimension = 5,
                                  .contacts = 1,
                                  .dofs = 6,
                                  .mu = file.mu,
                                  .f = file.f,
                                  .w = file.w,
                                  .K = file.M,
                                  .H = file.H};
        file.mu = file.f = file.w = NULL, file.M = file.H = (rb_sparse){0};
        alloc_fail_after(count);
        const rb_status st = rb_friction_split_rolling(&p, file.mu_r, &message);
        alloc_succeed();
        assert_true(st == RB_OK || st == RB_ENOMEM);
        assert_int_equal(p.dimension, st == RB_OK ? 3 : 5);
        done = st == RB_OK;
        rb_friction_problem_free(&p);
        rb_io_fclib_free(&file);
    }
}

RUN_TESTS(make_path, remove_path)
