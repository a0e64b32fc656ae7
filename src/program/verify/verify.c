/* `verify`: compares all references with the values that the program computes. */
#include "program/verify/internal.h"

int rb_verify_run(rb_verify_each_check *each, void *context)
{
    rb_verify v = {.each = each, .context = context};
    rb_verify_bodies(&v);
    rb_verify_contact(&v);
    rb_verify_rolling(&v);
    rb_verify_accuracy(&v);
    rb_verify_interface(&v);
    rb_verify_crack(&v);
    for (int k = 0; k < 2; k++)
        rb_rolling_solution_free(&v.solved[k]);
    return v.failed;
}
