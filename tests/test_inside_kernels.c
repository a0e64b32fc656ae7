/* Columns of the matrices of boundary elements: every instruction set, every range of
 * distances. */
#include "bem/column.h"
#include "bem_shapes.h"
#include "numbers.h"

enum { n_seen = 1003, rounds = 40 };

/* Where the points of one column lie, seen from the element. */
enum { ANYWHERE, COLLINEAR, ABOVE, places };

static const char *const place_name[places] = {"anywhere", "collinear", "above"};

static rb_element element_in_general_position(void)
{
    const double h = pow(10.0, between(-3, 0)), angle = between(0, 2 * M_PI), x = between(-1, 1),
                 y = between(-1, 1);
    return rb_element_make(x, y, x + h * cos(angle), y + h * sin(angle), 1.0);
}

/* At 0.1 to 10^4 half-lengths, not nearer to an end; point 77 of ANYWHERE: the midpoint */
static void put_points(const rb_element *e, int place, double *x, double *y)
{
    for (int i = 0; i < n_seen; i++) {
        const double away = e->a * pow(10.0, between(-1, 4)), angle = between(0, 2 * M_PI);
        const double along = place == ANYWHERE    ? away * cos(angle)
                             : place == COLLINEAR ? e->a + away
                                                  : 0.0;
        const double above = place == ANYWHERE    ? away * sin(angle)
                             : place == COLLINEAR ? 0.0
                                                  : away;
        x[i] = e->mx + along * e->tx - above * e->ty;
        y[i] = e->my + along * e->ty + above * e->tx;
    }
    if (place == ANYWHERE) {
        x[77] = e->mx;
        y[77] = e->my;
    }
}

typedef double columns_of_H_and_G[4][2 * n_seen]; /* of odd alignments */

typedef struct {
    rb_element e;
    rb_bem_material material;
    int self;
    double x[n_seen], y[n_seen];
} column_case;

static void make_column_case(int place, column_case *c)
{
    c->e = element_in_general_position();
    c->material = (rb_bem_material){pow(10.0, between(-2, 5)), between(0.0, 0.4)};
    c->self = place == ANYWHERE ? 77 : -1;
    put_points(&c->e, place, c->x, c->y);
}

static void fill_columns(const column_case *c, const rb_column_variant *variant, int with_G,
                         columns_of_H_and_G to)
{
    const rb_constants k = rb_constants_make(&c->e, c->material);
    OWNED(rb_points) points;
    CHECK_OK(rb_points_make(n_seen, c->x, c->y, &points));
    variant->fill(&k, &c->e, c->self, &points,
                  (double *const[4]){to[0], to[1], with_G ? to[2] : NULL, with_G ? to[3] : NULL});
}

static void put_blocks(const double H[4], const double G[4], int i, columns_of_H_and_G to)
{
    for (int c = 0; c < 2; c++)
        for (int r = 0; r < 2; r++) {
            to[c][2 * i + r] = H[2 * c + r];
            to[2 + c][2 * i + r] = G[2 * c + r];
        }
}

/* The same points one by one, as single points are integrated. */
static void fill_scalar(const column_case *c, columns_of_H_and_G to)
{
    const rb_constants k = rb_constants_make(&c->e, c->material);
    for (int i = 0; i < n_seen; i++) {
        rb_influence f;
        if (i == c->self) {
            rb_integrate_self(&k, c->e.a, &f);
        } else {
            const rb_view_angles v = rb_view_angles_of(&c->e, c->x[i], c->y[i]);
            rb_integrate_H(&k, &v, &f);
            rb_integrate_G(&k, c->e.a, &v, &f);
        }
        put_blocks((double[]){f.Hxx, f.Hyx, f.Hxy, f.Hyy}, (double[]){f.Gxx, f.Gxy, f.Gxy, f.Gyy},
                   i, to);
    }
}

/* (B3) as it stands in kernels.h, in the element's axes, from long double functions. */
static void integrate_long(const column_case *c, int i, double H[4], double G[4])
{
    const long double pi = acosl(-1.0L), t = hypotl(c->e.tx, c->e.ty), tx = c->e.tx / t,
                      ty = c->e.ty / t, a = c->e.a, nu = c->material.poisson,
                      C = 1 / (8 * pi * c->material.shear * (1 - nu)), D = -1 / (4 * pi * (1 - nu)),
                      kap = 3 - 4 * nu;
    const long double dx = (long double)c->e.mx - c->x[i], dy = (long double)c->e.my - c->y[i],
                      X = dx * tx + dy * ty, d = dx * ty - dy * tx, r1 = hypotl(X - a, d),
                      r2 = hypotl(X + a, d);
    const long double Th = i == c->self ? 0 : atan2l(2 * a * d, X * X + d * d - a * a),
                      Lam = 0.5L * log1pl(4 * a * X / (r1 * r1)),
                      L = X * Lam + a * logl(r1 * r2) - 2 * a + d * Th,
                      q = 2 * a * d / (r1 * r1 * r2 * r2);
    const long double dev = q * (X * X - d * d - a * a), shear = q * 2 * X * d, g = a - d * Th,
                      g12 = d * Lam, cc = tx * tx - ty * ty, ss = 2 * tx * ty,
                      mean = 2 * (1 - nu) * Th, skew = (1 - 2 * nu) * Lam;
    const double own = i == c->self ? 0.5 : 0.0;
    H[0] = own + (double)(D * (mean + cc * dev + ss * shear));
    H[3] = own + (double)(D * (mean - cc * dev - ss * shear));
    H[1] = (double)(D * (ss * dev - cc * shear - skew));
    H[2] = (double)(D * (ss * dev - cc * shear + skew));
    G[0] = (double)(C * (a - kap * L + cc * g + ss * g12));
    G[3] = (double)(C * (a - kap * L - cc * g - ss * g12));
    G[1] = G[2] = (double)(C * (ss * g - cc * g12));
}

static void fill_long(const column_case *c, columns_of_H_and_G to)
{
    for (int i = 0; i < n_seen; i++) {
        double H[4], G[4];
        integrate_long(c, i, H, G);
        put_blocks(H, G, i, to);
    }
}

/* Of blocks: largest difference of entries over the largest entry. */
typedef struct {
    double largest, squares;
    int n;
} differences;

static void compare(columns_of_H_and_G got, columns_of_H_and_G want, int matrix, differences *to)
{
    for (int i = 0; i < n_seen; i++) {
        double size = 0.0, error = 0.0;
        for (int k = 0; k < 4; k++) {
            const double is = got[2 * matrix + k / 2][2 * i + k % 2],
                         should = want[2 * matrix + k / 2][2 * i + k % 2];
            size = fmax(size, fabs(should));
            error = isnan(is) ? HUGE_VAL : fmax(error, fabs(is - should));
        }
        to->largest = fmax(to->largest, error / size);
        to->squares += error / size * (error / size);
        to->n++;
    }
}

/* In the mean below one rounding.  One block may have more: where one of its parts
 * changes sign it is small against what it was made of. */
static void check_differences(const differences *of, double mean, double largest, const char *who,
                              const char *whom, int place, char matrix)
{
    CHECK_MAX(sqrt(of->squares / of->n), mean, "%c, %s against %s, %s, root mean square", matrix,
              who, whom, place_name[place]);
    CHECK_MAX(of->largest, largest, "%c, %s against %s, %s", matrix, who, whom, place_name[place]);
}

TEST(every_instruction_set_gives_the_same)
{
    static columns_of_H_and_G single, exact, got;
    static column_case c;
    const rb_column_variant *variant;
    srand(3);
    for (int place = 0; place < places; place++)
        for (int v = 0; (variant = rb_column_variant_get(v)); v++) {
            differences from_single[2] = {{0}}, from_exact[2] = {{0}};
            for (int round = 0; round < rounds; round++) {
                make_column_case(place, &c);
                fill_scalar(&c, single);
                fill_long(&c, exact);
                fill_columns(&c, variant, 1, got);
                for (int m = 0; m < 2; m++) {
                    compare(got, single, m, &from_single[m]);
                    compare(got, exact, m, &from_exact[m]);
                }
            }
            for (int m = 0; m < 2; m++) {
                check_differences(&from_single[m], 2e-16, 5e-15, variant->name, "single points",
                                  place, "HG"[m]);
                check_differences(&from_exact[m], 3e-16, 1e-14, variant->name, "long double", place,
                                  "HG"[m]);
            }
        }
    assert_null(rb_column_variant_get(-1));
    assert_string_equal(rb_bem_vector_name(), rb_column_variant_get(0)->name);
}

TEST(the_series_meet_at_the_ends_of_their_ranges)
{
    const rb_far_range *const range[] = {&rb_far, &rb_farther, &rb_farthest};
    const rb_element e = rb_element_make(-1.0, 0.0, 1.0, 0.0, 1.0);
    for (int k = 0; k < 3; k++)
        for (int angle = 0; angle < 90; angle++) {
            const double r = range[k]->reach, c = r * cos(angle * M_PI / 45),
                         s = r * sin(angle * M_PI / 45);
            rb_view_angles v = rb_see(&e, -c, s);
            rb_turn_far(1.0, range[k]->terms, 2.0 / v.rho, &v);
            const long double Lam = 0.5L *
                                    log1pl(4.0L * v.X /
                                           ((v.X - 1.0L) * (v.X - 1.0L) + (long double)v.d * v.d)),
                              Th = atan2l(2.0L * v.d,
                                          (long double)v.X * v.X + (long double)v.d * v.d - 1.0L);
            CHECK_ABS(v.Lam, (double)Lam, 1e-15 / r, "Lam, %d terms", range[k]->terms);
            CHECK_ABS(v.Th, (double)Th, 1e-15 / r, "Th, %d terms", range[k]->terms);
        }
}

TEST(H_alone_is_H_to_rounding)
{
    static columns_of_H_and_G both, alone;
    static column_case c;
    srand(5);
    for (int place = 0; place < places; place++) {
        differences of = {0};
        make_column_case(place, &c);
        fill_columns(&c, rb_column_variant_get(0), 1, both);
        fill_columns(&c, rb_column_variant_get(0), 0, alone);
        compare(alone, both, 0, &of);
        CHECK_MAX(of.largest, 4.5e-16, "%s", place_name[place]);
    }
}

RUN_TESTS(NULL, NULL)
