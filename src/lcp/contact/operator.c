/* The operator of a contact problem by its table of functions: matrices or products. */
#include "lcp/contact/internal.h"

void rb_contact_operator_free(rb_contact_operator *op)
{
    if (op)
        op->kind->free(op);
}

void rb_contact_operator_add(rb_contact_operator *op, const double *p, const double *q, double *gap,
                             double *slip)
{
    op->kind->add(op, p, q, gap, slip);
}

rb_contact_matrix rb_contact_operator_matrix(const rb_contact_operator *op)
{
    return op->matrix;
}

rb_contact_response rb_contact_operator_response(const rb_contact_operator *op)
{
    return op->response;
}
