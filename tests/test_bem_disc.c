/* The exact disc against its Fourier series, and the elements against the exact disc. */
#include "bem_shapes.h"

#include <complex.h>

static const rb_bem_material material = {.shear = 80.0, .poisson = 0.3};

/* t = sum tau_m exp(im theta) gives 2G u_m = R tau_m kap/m (m >= 2), R tau_m/|m| (m <=
 * -1), 2G u_1 = R (kap-1)/2 Re tau_1; tau_m = p (h/2pi) sinc((m-1) h/2).  The resultant,
 * here balanced by a uniform traction, belongs into the centre: -conj(P) exp(2i theta)/(4
 * pi G). */
static double complex series(double h, double angle, double complex p)
{
    const double kap = 3.0 - 4.0 * material.poisson, R = 2.0;
    const double complex turn = cexp(I * angle);
    double complex up = turn * turn, down = conj(turn), sum = 0.0;
    for (int m = 2; m < 2000000; m++, up *= turn) {
        if (m % 1000 == 0) /* the products drift */
            up = cexp(I * fmod(m * angle, 2 * M_PI));
        sum += up * kap / m * sin((m - 1) * 0.5 * h) / ((m - 1) * 0.5 * h);
    }
    for (int m = 1; m < 2000000; m++, down *= conj(turn)) {
        if (m % 1000 == 0)
            down = cexp(-I * fmod(m * angle, 2 * M_PI));
        sum += down / m * sin((m + 1) * 0.5 * h) / ((m + 1) * 0.5 * h);
    }
    const double complex u =
        R * h / (2 * M_PI) * (p * sum + turn * 0.5 * (kap - 1) * creal(p)) / (2 * material.shear);
    const double complex centre =
        -conj(p) * R * 2 * sin(0.5 * h) * turn * turn / (4 * M_PI * material.shear);
    return (u + centre) * conj(turn); /* along r and t of the point */
}

TEST(the_closed_form_is_the_series)
{
    const double h[] = {0.3, 1.0}, angle[] = {0.0, 0.2, -1.0, 3.1};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 2; k++) {
                double response[4];
                CHECK_OK(
                    rb_bem_disc_response(&(rb_bem_disc){2.0, material}, h[i], angle[j], response));
                const double complex want = series(h[i], angle[j], k ? I : 1.0);
                const double scale = 2.0 * h[i] / material.shear;
                CHECK_ABS(response[2 * k], creal(want), 1e-11 * scale, "u_r %g %g %d", h[i],
                          angle[j], k);
                CHECK_ABS(response[2 * k + 1], cimag(want), 1e-11 * scale, "u_t %g %g %d", h[i],
                          angle[j], k);
            }
}

/* Just nearer than 50 widths by primitives, just farther by Gauss points; and an arc is
 * the sum of its halves. */
TEST(arcs_add_up_at_any_width)
{
    for (double h = 1e-1; h > 1e-9; h *= 0.1)
        for (double place = 0.25; place < 2.0 / h && place < 1e4; place *= 7.0) {
            double whole[4], left[4], right[4];
            const double b = place * h;
            CHECK_OK(rb_bem_disc_response(&(rb_bem_disc){1.0, material}, h, b, whole));
            rb_bem_disc_response(&(rb_bem_disc){1.0, material}, 0.5 * h, b - 0.25 * h, left);
            rb_bem_disc_response(&(rb_bem_disc){1.0, material}, 0.5 * h, b + 0.25 * h, right);
            for (int k = 0; k < 4; k++)
                CHECK_ABS(left[k] + right[k], whole[k], 1e-13 * rb_norm_inf(4, whole),
                          "entry %d, h = %g, %g widths away", k, h, place);
        }
}

/* Largest error of the displacement under two opposite arcs of pressure, over its size. */
static double element_error(int n, double alpha)
{
    OWNED(rb_bem_mesh) mesh = pressed_disc(n, alpha);
    held_system *system;
    double *u = rb_alloc(2 * (size_t)n, 1), *t = rb_alloc(2 * (size_t)n, 1), error = 0.0;
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
    CHECK_OK(rb_bem_system_solve(system, NULL, u, t));
    for (int j = 0; j < n; j++) {
        const double angle = atan2(midpoint_y(&mesh, j), midpoint_x(&mesh, j));
        double top[4], bottom[4];
        rb_bem_disc_response(&(rb_bem_disc){1.0, material}, 2 * alpha, angle - M_PI_2, top);
        rb_bem_disc_response(&(rb_bem_disc){1.0, material}, 2 * alpha, angle + M_PI_2, bottom);
        const double r = -(top[0] + bottom[0]), s = -(top[1] + bottom[1]);
        error += pow(u[2 * j] - r * cos(angle) + s * sin(angle), 2) +
                 pow(u[2 * j + 1] - r * sin(angle) - s * cos(angle), 2);
    }
    const double scale = rb_norm_inf(2 * (size_t)n, u);
    free(u);
    free(t);
    return sqrt(error / n) / scale;
}

TEST(elements_converge_to_the_disc)
{
    const double coarse = element_error(60, M_PI / 20), fine = element_error(180, M_PI / 20),
                 finest = element_error(540, M_PI / 20);
    print_errors("rim", coarse, fine, finest, 3.0);
    CHECK_MAX(finest, 1.3e-3, "error on 540 elements");
    CHECK_ABS(order(coarse, fine) / log2(3), 1.0, 0.1, "order");
    CHECK_ABS(order(fine, finest) / log2(3), 1.0, 0.1, "order");
}

/* The first of the contact elements that is not of the others' arc is named. */
TEST(every_element_is_of_the_same_arc)
{
    enum { n = 4 };
    const rb_bem_disc disc = {2.0, material};
    for (int k = 0; k <= n; k++) {
        OWNED(rb_bem_flexibility) f;
        double ends[n + 2];
        for (int i = 0; i < n + 2; i++)
            ends[i] = 2.0 * sin(-0.2 + 0.15 * i);
        if (k > 0)
            ends[k] += 1e-6;
        CHECK_STATUS(rb_bem_flexibility_disc(n, ends, &disc, RB_BEM_NORMALS_SURFACE, &f, &message),
                     k ? RB_EINVAL : RB_OK);
        char text[80] = "";
        if (k)
            snprintf(text, sizeof text,
                     "disc: contact element %d has another length than the others", k);
        assert_string_equal(message.text, text);
        for (int i = 0; i < n && !k; i++) /* arcs, not chords */
            CHECK_REL(f.h[i], 2.0 * (asin(0.5 * ends[i + 1]) - asin(0.5 * ends[i])), 1e-14,
                      "length of element %d", i);
    }
}

TEST(bad_input_is_refused)
{
    double response[4];
    CHECK_STATUS(rb_bem_disc_response(&(rb_bem_disc){0.0, material}, 0.1, 0.0, response),
                 RB_EINVAL);
    CHECK_STATUS(rb_bem_disc_response(&(rb_bem_disc){1.0, material}, 0.0, 0.0, response),
                 RB_EINVAL);
    CHECK_STATUS(rb_bem_disc_response(&(rb_bem_disc){1.0, material}, 7.0, 0.0, response),
                 RB_EINVAL);
    CHECK_STATUS(rb_bem_disc_response(&(rb_bem_disc){1.0, material}, 0.1, NAN, response),
                 RB_EINVAL);
    CHECK_STATUS(rb_bem_disc_response(&(rb_bem_disc){1.0, {1.0, 0.6}}, 0.1, 0.0, response),
                 RB_EINVAL);
}

RUN_TESTS(NULL, NULL)
