/* Places and weights of differences: around a value, or on one side of it where the range of an
 * input ends. */
#include "analysis/sensitivity/internal.h"

const rb_sensitivity_stencil rb_sensitivity_nearest = {2, {-1, 1}, {-0.5, 0.5}};
const rb_sensitivity_stencil rb_sensitivity_middle = {
    4, {-2, -1, 1, 2}, {1 / 12., -8 / 12., 8 / 12., -1 / 12.}};
const rb_sensitivity_stencil rb_sensitivity_ahead = {
    5, {0, 1, 2, 3, 4}, {-25 / 12., 48 / 12., -36 / 12., 16 / 12., -3 / 12.}};
static const rb_sensitivity_stencil behind = {
    5, {0, -1, -2, -3, -4}, {25 / 12., -48 / 12., 36 / 12., -16 / 12., 3 / 12.}};

const rb_sensitivity_stencil *rb_sensitivity_stencil_of(const rb_sensitivity_input *input,
                                                        double step)
{
    const int can_fall = input->value - 2.0 * step > input->from,
              can_grow = input->value + 2.0 * step < input->to;

    return can_fall && can_grow ? &rb_sensitivity_middle
           : can_grow           ? &rb_sensitivity_ahead
           : can_fall           ? &behind
                                : NULL;
}
