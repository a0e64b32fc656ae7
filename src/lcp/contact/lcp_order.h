/* Where the unknowns of a contact problem's LCP stand, and what few cases make of its first form.
 */
#ifndef ROLLBEM_CONTACT_LCP_ORDER_H
#define ROLLBEM_CONTACT_LCP_ORDER_H

#include "lcp/contact/internal.h"

/* Columns of the two bordered unknowns (K6), delta' and xi', behind those of the contact: 3n, or 5n
 * where a layer yields. */
static inline int rb_contact_delta_column(const rb_contact_problem *p)
{
    return (p->yield ? 5 : 3) * p->n;
}
static inline int rb_contact_xi_column(const rb_contact_problem *p)
{
    return rb_contact_delta_column(p) + p->load_given;
}

/* Pivoted form: plastic slips s+ (sign 0) and s- (1), against sigma+- = yield + hardening u +- r_T
 * (Y1), stand behind the 3n, block by block. */
static inline int rb_contact_yield_index(const rb_contact_problem *p, int i, int sign)
{
    return (3 + sign) * p->n + i;
}

/* Where unknown k of the pivoted form stands in Kwak's: lambda+- and s+- in pairs. */
static inline int rb_contact_kwak_place(const rb_contact_problem *p, int k)
{
    const int n = p->n, block = (k - n) / n;
    return k < n || k >= rb_contact_delta_column(p)
               ? k
               : n + 2 * n * (block / 2) + 2 * ((k - n) % n) + block % 2;
}

/* plastic.c: the rows and columns of a layer that yields (Y1), in the pivoted form. */
void rb_contact_lcp_add_yield(const rb_contact_problem *p, rb_contact_lcp *lcp);

/* kwak.c: the pivoted form becomes Kwak's.  RB_SINGULAR: A F_TT has no inverse; RB_ENOMEM. */
rb_status rb_contact_kwak_form(const rb_contact_problem *p, rb_contact_lcp *lcp);

#endif
