/* packings KIND BODIES MU SEED [global [LOOSE]]: a frictional contact problem of one time
 * step of a pile of rigid bodies, in Siconos' text form on standard output.
 *
 * KIND: boxes    brick wall in the plane, running bond
 *       discs    triangular lattice of discs in a trough, one in ten taken out
 *       bricks   brick wall in space, four contacts for each pair of bricks
 *       spheres  square layers of spheres in a box, each in the pits of the one below
 * All have more contact equations than motions.  The bodies start from rest with small
 * random velocities, under gravity that is tilted by a few degrees:
 *     W = H' M^-1 H,  q = H' (v + h g),  per contact [N, T] or [N, T1, T2].
 * global: M, H and f = M (v + h g) in place of W and q; LOOSE more bodies touch nothing.
 * The same arguments give the same file.  Random numbers: a linear congruence, so that it
 * does not depend on the C library. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GROUND = -1, MOST_BODIES = 8000, MOST_CONTACTS = 40000 };

typedef struct {
    double x[3], mass, inertia; /* of a sphere or a cube: isotropic */
} body;

typedef struct {
    int a, b; /* b is pushed along n, a against it; a may be GROUND */
    double x[3], n[3];
} contact;

typedef struct {
    int d, bodies, contacts;
    body body[MOST_BODIES];
    contact contact[MOST_CONTACTS];
    unsigned seed;
} pile;

static pile world;

/* -1 ... 1 */
static double uniform(pile *p)
{
    p->seed = p->seed * 1664525u + 1013904223u;
    return (double)(p->seed >> 8) / (1u << 24) * 2.0 - 1.0;
}

static void fail(const char *text)
{
    fprintf(stderr, "packings: %s\n", text);
    exit(64);
}

static int add_body(pile *p, double x, double y, double z, double mass, double inertia)
{
    if (p->bodies == MOST_BODIES)
        fail("too many bodies");
    p->body[p->bodies] = (body){{x, y, z}, mass, inertia};
    return p->bodies++;
}

static void touch(pile *p, int a, int b, const double x[3], const double n[3])
{
    if (p->contacts == MOST_CONTACTS)
        fail("too many contacts");
    contact *c = &p->contact[p->contacts++];
    *c = (contact){.a = a, .b = b};
    memcpy(c->x, x, sizeof c->x);
    memcpy(c->n, n, sizeof c->n);
}

/* ---- Walls of boxes and bricks: y is up ---------------------------------------------
 */

#define LENGTH 2.0 /* of a brick along x; height 1, depth 1 */

/* Contacts at the ends of the common interval of the lower face of b and the upper one of
 * a; in space at its four corners. */
static void lay(pile *p, int a, int b)
{
    const double *xb = p->body[b].x, up[3] = {0.0, 1.0, 0.0};
    double low = xb[0] - 0.5 * LENGTH, high = xb[0] + 0.5 * LENGTH;
    if (a != GROUND) {
        low = fmax(low, p->body[a].x[0] - 0.5 * LENGTH);
        high = fmin(high, p->body[a].x[0] + 0.5 * LENGTH);
    }
    if (high - low < 1e-9)
        return;
    for (int end = 0; end < 2; end++)
        for (int side = 0; side < p->d - 1; side++) {
            const double x[3] = {end ? high : low, xb[1] - 0.5, p->d == 3 ? side - 0.5 : 0.0};
            touch(p, a, b, x, up);
        }
}

static void wall(pile *p, int bodies)
{
    const int wide = (int)ceil(sqrt(bodies));
    for (int row = 0, first = 0, before = 0; p->bodies < bodies; row++) {
        const int below = first;
        first = p->bodies;
        for (int k = 0; k < wide && p->bodies < bodies; k++) {
            const int b = add_body(p, LENGTH * (k + 0.5 * (row % 2)), row + 0.5, 0.0, LENGTH,
                                   LENGTH * (LENGTH * LENGTH + 1.0) / 12.0);
            if (row == 0)
                lay(p, GROUND, b);
            for (int a = below; row > 0 && a < before; a++)
                lay(p, a, b);
        }
        before = p->bodies;
    }
}

/* ---- Discs and spheres of diameter 1 ------------------------------------------------
 */

static void touch_round(pile *p, int a, int b)
{
    double n[3], x[3], size = 0.0;
    for (int k = 0; k < 3; k++) {
        n[k] = p->body[b].x[k] - p->body[a].x[k];
        size += n[k] * n[k];
    }
    if (size > 1.0 + 1e-9)
        return;
    for (int k = 0; k < 3; k++)
        x[k] = 0.5 * (p->body[a].x[k] + p->body[b].x[k]);
    touch(p, a, b, x, n);
}

/* Against the plane n.x = offset */
static void touch_plane(pile *p, int b, double nx, double ny, double nz, double offset)
{
    const double n[3] = {nx, ny, nz}, *at = p->body[b].x;
    double x[3], distance = -offset;
    for (int k = 0; k < 3; k++)
        distance += n[k] * at[k];
    for (int k = 0; k < 3; k++)
        x[k] = at[k] - 0.5 * n[k];
    if (distance < 0.5 + 1e-9)
        touch(p, GROUND, b, x, n);
}

static void discs(pile *p, int bodies)
{
    const int wide = (int)ceil(sqrt(bodies));
    for (int row = 0; p->bodies < bodies; row++)
        for (int k = 0; k < wide - row % 2 && p->bodies < bodies; k++) {
            if (row > 0 && uniform(p) > 0.8) /* taken out */
                continue;
            const int b =
                add_body(p, 0.5 + k + 0.5 * (row % 2), 0.5 + row * sqrt(0.75), 0.0, 1.0, 0.125);
            touch_plane(p, b, 0.0, 1.0, 0.0, 0.0);
            touch_plane(p, b, 1.0, 0.0, 0.0, 0.0);
            touch_plane(p, b, -1.0, 0.0, 0.0, -wide);
            for (int a = 0; a < b; a++)
                touch_round(p, a, b);
        }
}

static void spheres(pile *p, int bodies)
{
    const int wide = (int)ceil(cbrt(bodies));
    for (int row = 0; p->bodies < bodies; row++)
        for (int k = 0; k < (wide - row % 2) * (wide - row % 2); k++) {
            if (p->bodies == bodies)
                break;
            const int side = wide - row % 2;
            const double shift = 0.5 + 0.5 * (row % 2);
            const int b =
                add_body(p, shift + k % side, 0.5 + row * sqrt(0.5), shift + k / side, 1.0, 0.1);
            touch_plane(p, b, 0.0, 1.0, 0.0, 0.0);
            touch_plane(p, b, 1.0, 0.0, 0.0, 0.0);
            touch_plane(p, b, -1.0, 0.0, 0.0, -wide);
            touch_plane(p, b, 0.0, 0.0, 1.0, 0.0);
            touch_plane(p, b, 0.0, 0.0, -1.0, -wide);
            for (int a = 0; a < b; a++)
                touch_round(p, a, b);
        }
}

/* ---- The problem ----------------------------------------------------------------------
 */

/* Row of direction t at contact c for the motions of body k: 3 forces, 3 moments. */
static void row_of(const pile *p, const contact *c, int k, const double t[3], double h[6])
{
    const double sign = k == c->b ? 1.0 : -1.0;
    double arm[3];
    for (int i = 0; i < 3; i++) {
        arm[i] = c->x[i] - p->body[k].x[i];
        h[i] = sign * t[i];
    }
    h[3] = sign * (arm[1] * t[2] - arm[2] * t[1]);
    h[4] = sign * (arm[2] * t[0] - arm[0] * t[2]);
    h[5] = sign * (arm[0] * t[1] - arm[1] * t[0]);
}

/* [N, T1, T2]; in the plane T2 is across it and not used. */
static void frame(const contact *c, double t[3][3])
{
    const double *n = c->n;
    const double other[3] = {fabs(n[2]) < 0.9 ? 0.0 : 1.0, 0.0, fabs(n[2]) < 0.9 ? 1.0 : 0.0};
    double size = 0.0;
    memcpy(t[0], n, sizeof t[0]);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        t[1][i] = n[j] * other[k] - n[k] * other[j];
        size += t[1][i] * t[1][i];
    }
    for (int i = 0; i < 3; i++)
        t[1][i] /= sqrt(size);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        t[2][i] = n[j] * t[1][k] - n[k] * t[1][j];
    }
}

/* W between two contacts that share body k */
static void add_block(const pile *p, const contact *c, const contact *e, int k, double block[3][3])
{
    double tc[3][3], te[3][3], hc[6], he[6];
    const body *b = &p->body[k];
    frame(c, tc);
    frame(e, te);
    for (int i = 0; i < p->d; i++)
        for (int j = 0; j < p->d; j++) {
            row_of(p, c, k, tc[i], hc);
            row_of(p, e, k, te[j], he);
            for (int l = 0; l < 6; l++)
                block[i][j] += hc[l] * he[l] / (l < 3 ? b->mass : b->inertia);
        }
}

static int shares(const contact *c, const contact *e)
{
    return c->b == e->b || c->b == e->a || (c->a != GROUND && c->a == e->a) ||
           (c->a != GROUND && c->a == e->b);
}

/* The block of W, rounded so that it is exactly symmetric */
static void block_of(const pile *p, int i, int j, double block[3][3])
{
    const contact *c = &p->contact[i < j ? i : j], *e = &p->contact[i < j ? j : i];
    double x[3][3] = {{0.0}};
    const int of_c[2] = {c->a, c->b};
    for (int k = 0; k < 2; k++)
        if (of_c[k] != GROUND && (of_c[k] == e->a || of_c[k] == e->b))
            add_block(p, c, e, of_c[k], x);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            block[a][b] = i < j ? x[a][b] : i > j ? x[b][a] : 0.5 * (x[a][b] + x[b][a]);
}

static void print_head(int rows, int cols, int nz)
{
    printf("2\n%d\n%d\n1\n(packings)\ntriplet: %d-by-%d, nzmax: %d nnz: %d\n", rows, cols, rows,
           cols, nz, nz);
}

static void print_matrix(const pile *p)
{
    const int d = p->d, m = d * p->contacts;
    int nz = 0;
    for (int i = 0; i < p->contacts; i++)
        for (int j = 0; j < p->contacts; j++)
            nz += shares(&p->contact[i], &p->contact[j]) ? d * d : 0;
    print_head(m, m, nz);
    for (int i = 0; i < p->contacts; i++)
        for (int j = 0; j < p->contacts; j++) {
            double block[3][3];
            if (!shares(&p->contact[i], &p->contact[j]))
                continue;
            block_of(p, i, j, block);
            for (int a = 0; a < d; a++)
                for (int b = 0; b < d; b++)
                    printf("%d %d : %.17g\n", i * d + a, j * d + b, block[a][b]);
        }
}

/* v + h g: 3 velocities and 3 rates of turn of every body; off the plane 0 */
static void velocities(pile *p, double (*v)[6])
{
    const double tilt = 0.1 * uniform(p), turn = p->d == 3 ? 3.14 * uniform(p) : 0.0;
    const double g[3] = {sin(tilt) * cos(turn), -cos(tilt), sin(tilt) * sin(turn)};
    for (int b = 0; b < p->bodies; b++)
        for (int l = 0; l < 6; l++) {
            const int off_plane = p->d == 2 && l > 1 && l < 5;
            v[b][l] = (l < 3 ? g[l] : 0.0) + (off_plane ? 0.0 : 0.1 * uniform(p));
        }
}

/* q = H' (v + h g) */
static void print_velocities(const pile *p, double (*v)[6])
{
    for (int i = 0; i < p->contacts; i++) {
        const contact *c = &p->contact[i];
        double t[3][3], h[6];
        frame(c, t);
        for (int a = 0; a < p->d; a++) {
            double q = 0.0;
            for (int k = 0; k < 2; k++) {
                const int b = k ? c->b : c->a;
                if (b == GROUND)
                    continue;
                row_of(p, c, b, t[a], h);
                for (int l = 0; l < 6; l++)
                    q += h[l] * v[b][l];
            }
            printf("%.17g\n", q);
        }
    }
}

/* ---- The global form ------------------------------------------------------------------
 */

/* The motions of a body that there are: all six, or two and the turn in the plane. */
static int motions(const pile *p, int l[6])
{
    static const int of[2][6] = {{0, 1, 5}, {0, 1, 2, 3, 4, 5}};
    memcpy(l, of[p->d == 3], sizeof of[0]);
    return p->d == 3 ? 6 : 3;
}

static double mass_of(const pile *p, int b, int l)
{
    return l < 3 ? p->body[b].mass : p->body[b].inertia;
}

/* M, H, f = M (v + h g), b = 0 */
static void print_global(const pile *p, double (*v)[6])
{
    int l[6];
    const int each = motions(p, l), n = each * p->bodies, m = p->d * p->contacts;
    int nz = 0;
    print_head(n, n, n);
    for (int i = 0; i < n; i++)
        printf("%d %d : %.17g\n", i, i, mass_of(p, i / each, l[i % each]));
    for (int i = 0; i < p->contacts; i++)
        nz += p->d * each * (p->contact[i].a == GROUND ? 1 : 2);
    print_head(n, m, nz);
    for (int i = 0; i < p->contacts; i++) {
        const contact *c = &p->contact[i];
        double t[3][3], h[6];
        frame(c, t);
        for (int a = 0; a < p->d; a++)
            for (int k = 0; k < 2; k++) {
                const int b = k ? c->b : c->a;
                if (b == GROUND)
                    continue;
                row_of(p, c, b, t[a], h);
                for (int j = 0; j < each; j++)
                    printf("%d %d : %.17g\n", b * each + j, i * p->d + a, h[l[j]]);
            }
    }
    for (int i = 0; i < n; i++)
        printf("%.17g\n", mass_of(p, i / each, l[i % each]) * v[i / each][l[i % each]]);
    for (int i = 0; i < m; i++)
        printf("0\n");
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        int d;
        void (*build)(pile *p, int bodies);
    } kinds[] = {
        {"boxes", 2, wall}, {"discs", 2, discs}, {"bricks", 3, wall}, {"spheres", 3, spheres}};
    static double v[MOST_BODIES][6];
    const int global = argc > 5 && !strcmp(argv[5], "global");
    if (argc < 5 || argc > 6 + global || (argc > 5 && !global))
        fail("expected KIND BODIES MU SEED [global [LOOSE]], KIND boxes, discs, bricks or "
             "spheres");
    const int bodies = atoi(argv[2]);
    const double mu = atof(argv[3]);
    if (bodies < 1 || !(mu >= 0.0))
        fail("expected at least one body and mu >= 0");
    world.seed = 7919u * (unsigned)atoi(argv[4]) + 1u;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (!strcmp(kinds[k].name, argv[1])) {
            world.d = kinds[k].d;
            kinds[k].build(&world, bodies);
        }
    if (!world.contacts)
        fail("KIND is boxes, discs, bricks or spheres");
    for (int k = argc > 6 ? atoi(argv[6]) : 0; k > 0; k--)
        add_body(&world, 0.0, 1e3 + k, 0.0, 1.0, 1.0);
    velocities(&world, v);
    printf("%d\n%d\n", world.d, world.contacts);
    if (global) {
        print_global(&world, v);
    } else {
        print_matrix(&world);
        print_velocities(&world, v);
    }
    for (int i = 0; i < world.contacts; i++)
        printf("%.17g\n", mu);
    return 0;
}
