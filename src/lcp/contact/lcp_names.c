/* Names of the variables of a contact problem's LCP, in traces and tableaux. */
#include "lcp/contact/contact.h"

#include <stdio.h>

const char *rb_contact_lcp_variable(const rb_contact_lcp *lcp, int n, int variable,
                                    char name[RB_CONTACT_VARIABLE])
{
    /* Blocks of n (pivoted form) after r_N; w then z.  Mirrored, the signs change places. */
    static const char *const pivoted[2][2][2] = {{{"lambda+", "gamma-"}, {"gamma+", "lambda-"}},
                                                 {{"lambda-", "gamma+"}, {"gamma-", "lambda+"}}};
    const int size = lcp->size, is_z = variable >= size, k = variable - is_z * size;
    const int contact = (lcp->yields ? 5 : 3) * n;
    if (variable == 2 * size)
        snprintf(name, RB_CONTACT_VARIABLE, "z0");
    else if (k < contact) {
        if (k < n) {
            snprintf(name, RB_CONTACT_VARIABLE, "%s[%d]", is_z ? "p" : "gap", k + 1);
        } else if (k >= 3 * n) {
            const int kwak = lcp->form == RB_LCP_KWAK, place = k - 3 * n;
            const int minus = kwak ? place % 2 : place / n != lcp->mirrored;
            snprintf(name, RB_CONTACT_VARIABLE, "%s%c[%d]", is_z ? "plastic" : "yield",
                     minus ? '-' : '+', (kwak ? place / 2 : place % n) + 1);
        } else if (lcp->form == RB_LCP_KWAK) {
            const int i = (k - n) / 2, minus = (k - n) % 2;
            snprintf(name, RB_CONTACT_VARIABLE, "%s%c[%d]", is_z ? "lambda" : "gamma",
                     minus ? '-' : '+', i + 1);
        } else {
            const int block = (k - n) / n;
            snprintf(name, RB_CONTACT_VARIABLE, "%s[%d]", pivoted[lcp->mirrored][is_z][block],
                     (k - n) % n + 1);
        }
    } else
        snprintf(name, RB_CONTACT_VARIABLE, "%s[%d]", is_z ? "motion" : "force", k - contact + 1);
    return name;
}
