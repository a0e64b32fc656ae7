/* What is proved of a solution, for people and as JSON. */
#include "program/report/internal.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* The undecided are `what`, as "pair", with words before their number. */
static const char *status_text(int proved, int undecided, const char *before, const char *what,
                               char *text, size_t size)
{
    if (proved && undecided)
        snprintf(text, size, "proved but for %s%d %s%s", before, undecided, what,
                 undecided == 1 ? "" : "s");
    else
        snprintf(text, size, "%s", proved ? "proved" : "not proved");
    return text;
}

const char *rb_report_proof_status(const rb_lcp_proof *p, char *text, size_t size)
{
    return status_text(p->proved, p->undecided, "", "pair", text, size);
}

const char *rb_report_proof_text(const rb_lcp_proof *p, char *text, size_t size)
{
    char status[60];
    snprintf(text, size, "%s", rb_report_proof_status(p, status, sizeof status));
    if (!p->proved) {
        rb_append(text, size, ": %s", p->reason);
        if (p->row >= 0)
            rb_append(text, size, " (row %d)", p->row + 1);
    } else
        rb_append(text, size,
                  ": a solution with these signs, %seach z within %.2g max z of it, those printed "
                  "within %.2g max z",
                  p->isolated ? "isolated, " : "", p->bound, p->stored_within);
    if (isfinite(p->nearby))
        rb_append(text, size, "; exact for a q within %.2g of the terms", p->nearby);
    return text;
}

json_t *rb_report_json_proof(const rb_lcp_proof *p)
{
    char status[60];
    json_t *object = json_object();
    rb_report_json_set(&object, "status",
                       json_string(rb_report_proof_status(p, status, sizeof status)));
    rb_report_json_set(&object, "reason", p->proved ? json_null() : json_string(p->reason));
    rb_report_json_set(&object, "row",
                       !p->proved && p->row >= 0 ? json_integer(p->row + 1) : json_null());
    rb_report_json_set(&object, "bound", rb_report_json_number(p->proved ? p->bound : NAN));
    rb_report_json_set(&object, "stored_within",
                       rb_report_json_number(p->proved ? p->stored_within : NAN));
    rb_report_json_set(&object, "undecided", json_integer(p->proved ? p->undecided : 0));
    rb_report_json_set(&object, "isolated", json_boolean(p->proved && p->isolated));
    rb_report_json_set(&object, "nearby", rb_report_json_number(p->nearby));
    rb_report_json_set(&object, "margin", rb_report_json_number(p->proved ? p->margin : NAN));
    rb_report_json_set(&object, "norm", rb_report_json_number(p->norm));
    return object;
}

/* ---- Contact -------------------------------------------------------------------------- */

static const char *contact_status(const rb_contact_proof *p, char *text, size_t size)
{
    return status_text(p->proved, p->undecided, "the zone of ", "element", text, size);
}

const char *rb_report_contact_proof_text(const rb_contact_proof *p, char *text, size_t size)
{
    char status[60];
    snprintf(text, size, "%s", contact_status(p, status, sizeof status));
    for (int k = 0; p->proved && k < p->undecided && k < RB_CONTACT_UNDECIDED; k++)
        rb_append(text, size, "%s %d", k ? "," : "", p->element[k]);
    if (p->undecided > RB_CONTACT_UNDECIDED)
        rb_append(text, size, ", ...");
    if (p->proved) {
        if (!p->undecided)
            rb_append(text, size, ": zones exact");
        rb_append(text, size, ", p within %.2g of p0, q within %.2g", p->bound_p, p->bound_q);
        const char *const unique = p->unique ? p->unique : "not shown";
        if (strcmp(unique, "pressure") == 0)
            rb_append(text, size, ", p unique");
        else if (strcmp(unique, "fixed friction") == 0)
            rb_append(text, size, ", unique for these coefficients of friction");
        else if (strcmp(unique, "not shown") != 0)
            rb_append(text, size, ", unique");
        if (p->isolated && (strcmp(unique, "pressure") == 0 || strcmp(unique, "not shown") == 0))
            rb_append(text, size, ", isolated");
    } else {
        rb_append(text, size, ": %s", p->reason);
        if (*p->where)
            rb_append(text, size, " (%s)", p->where);
    }
    if (!p->proved && isfinite(p->nearby))
        rb_append(text, size, "; exact for data within %.2g", p->nearby);
    if (p->steps)
        rb_append(text, size, " (%d of %d steps proved)", p->steps_proved, p->steps);
    return text;
}

json_t *rb_report_json_contact_proof(const rb_contact_proof *p)
{
    char status[60];
    json_t *object = json_object(), *elements = json_array();
    for (int k = 0; k < p->undecided && k < RB_CONTACT_UNDECIDED; k++)
        rb_report_json_append(&elements, json_integer(p->element[k]));
    rb_report_json_set(&object, "status", json_string(contact_status(p, status, sizeof status)));
    rb_report_json_set(&object, "reason", p->proved ? json_null() : json_string(p->reason));
    rb_report_json_set(&object, "where", *p->where ? json_string(p->where) : json_null());
    rb_report_json_set(&object, "bound_p", rb_report_json_number(p->bound_p));
    rb_report_json_set(&object, "bound_q", rb_report_json_number(p->bound_q));
    rb_report_json_set(&object, "stored_within", rb_report_json_number(p->stored_within));
    rb_report_json_set(&object, "undecided", elements);
    rb_report_json_set(&object, "isolated", json_boolean(p->proved && p->isolated));
    rb_report_json_set(&object, "unique", json_string(p->unique ? p->unique : "not shown"));
    rb_report_json_set(&object, "nearby", rb_report_json_number(p->nearby));
    rb_report_json_set(&object, "margin", rb_report_json_number(p->margin));
    rb_report_json_set(&object, "norm", rb_report_json_number(p->norm));
    if (p->steps) {
        rb_report_json_set(&object, "steps", json_integer(p->steps));
        rb_report_json_set(&object, "steps_proved", json_integer(p->steps_proved));
    }
    return object;
}
