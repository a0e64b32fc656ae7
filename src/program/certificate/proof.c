/* Proof of a stored result: that the discrete problem has a solution with the stored zones, and
 * that the stored tractions lie within its bounds.  Nothing is solved. */
#include "program/certificate/internal.h"

#include "lcp/contact/contact.h"

#include <math.h>
#include <string.h>

/* A printed bound that is less than this part of the bound that is proved now is not one that the
 * program has printed: bounds differ by the order of a few sums alone. */
static const double LEAST = 0.01;

rb_status rb_certificate_prove(rb_certificate *c)
{
    rb_contact_proof *proof = &c->found->proof;
    const int steps = c->step ? proof->steps : 0, proved = c->step ? proof->steps_proved : 0;
    rb_message why;
    if (!c->proves)
        return RB_OK;
    const rb_status s = rb_contact_prove(&c->model->problem, &c->model->state, proof, &why);
    if (c->step) {
        proof->steps = steps + 1;
        proof->steps_proved = proved + proof->proved;
    }
    return s > 0 ? RB_OK : s;
}

void rb_certificate_judge_proof(rb_certificate *c, const json_t *summary)
{
    const json_t *printed = json_object_get(summary, "proof");
    const rb_contact_proof *proof = &c->found->proof;
    const double within = rb_certificate_member(printed, "stored_within");
    const char *status = rb_certificate_word(printed, "status");
    if (!printed)
        return;
    if (strncmp(status, "proved", 6) == 0 && !proof->proved)
        rb_certificate_violated(c, "proof: %s is printed, but not proved: %s%s%s", status,
                                proof->reason, *proof->where ? ", " : "", proof->where);
    else if (strncmp(status, "proved", 6) == 0 && !(within >= LEAST * proof->stored_within))
        rb_certificate_violated(c, "proof: stored_within is printed as %.3g, proved is %.3g",
                                within, proof->stored_within);
}
