/* The viscoelastic part of the flexibility of one body, from which its hysteresis is
 * computed. */
#include "rolling/body/internal.h"

rb_status rb_rolling_memory_before(const rb_bem_flexibility *glassy, double **memory)
{
    const int rows = 2 * glassy->m;

    *memory = rb_alloc((size_t)rows, 2 * (size_t)glassy->n);
    return *memory ? rb_bem_flexibility_matrix(glassy, *memory, rows) : RB_ENOMEM;
}

void rb_rolling_memory_after(const rb_bem_flexibility *whole, double *memory)
{
    const double *F = rb_bem_flexibility_stored(whole);
    const size_t size = 4 * (size_t)whole->m * (size_t)whole->n;

    for (size_t k = 0; k < size; k++)
        memory[k] = F[k] - memory[k];
}
