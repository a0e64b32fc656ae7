/* A pass of 121 positions of a Hertzian contact of 100 elements over a crack of 30
 * degrees, 40 elements: the crack's matrices, and the pass. Argument: the number of
 * elements of the crack (default 40). */
#include "fast_blas.h"
#include "analysis/crack/crack.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STRIPS = 100, POSITIONS = 121 };

int main(int argc, char **argv)
{
    fast_blas(argv);
    const rb_crack_shape shape = {.path = rb_crack_straight(0.0, 0.0, 1.0, 30.0),
                                  .elements = argc > 1 ? atoi(argv[1]) : 40,
                                  .friction = 0.1,
                                  .shear = 1.0,
                                  .poisson = 0.3};
    double ends[STRIPS + 1], p[STRIPS], q[STRIPS] = {0}, x[POSITIONS];
    rb_message why = {.text = ""};
    rb_crack *crack = NULL;
    rb_crack_history h = {0};

    for (int i = 0; i <= STRIPS; i++)
        ends[i] = -cos(3.14159265358979 * i / STRIPS);
    for (int i = 0; i < STRIPS; i++) {
        const double middle = 0.5 * (ends[i] + ends[i + 1]);
        p[i] = sqrt(1.0 - middle * middle);
    }
    for (int k = 0; k < POSITIONS; k++)
        x[k] = -6.0 + 0.1 * k;
    const rb_bem_edge_load load = {STRIPS, ends, p, q};
    const double start = rb_seconds();
    rb_status s = rb_crack_create(&shape, &crack, &why);
    const double assembled = rb_seconds();
    for (int fluid = RB_CRACK_DRY; fluid <= RB_CRACK_TRAPPED && s == RB_OK; fluid++) {
        const rb_crack_passage passage = {.steps = POSITIONS,
                                          .x = x,
                                          .loads = 1,
                                          .load = &load,
                                          .passes = 1,
                                          .fluid = (rb_crack_fluid)fluid};
        const double before = rb_seconds();
        s = rb_crack_pass(crack, &passage, &h, &why);
        printf("%d elements, %d positions, %s: matrices %.4f s, pass %.4f s\n", shape.elements,
               POSITIONS, fluid == RB_CRACK_DRY ? "dry" : "trapped fluid", assembled - start,
               rb_seconds() - before);
        rb_crack_history_free(&h);
    }
    rb_crack_free(crack);
    if (s != RB_OK)
        fprintf(stderr, "%s\n", why.text);
    return s != RB_OK;
}
