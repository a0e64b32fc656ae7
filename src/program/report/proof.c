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
                 rb_plural(undecided));
    else
        snprintf(text, size, "%s", proved ? "proved" : "not proved");
    return text;
}

const char *rb_report_proof_status(const rb_lcp_proof *p, char *text, size_t size)
{
    if (isinf(p->least_sum)) {
        snprintf(text, size, "no solution");
        return text;
    }
    return status_text(p->proved, p->undecided, "", "pair", text, size);
}

const char *rb_report_proof_text(const rb_lcp_proof *p, char *text, size_t size)
{
    char status[60];
    if (isinf(p->least_sum)) {
        snprintf(text, size, "proved: there is no solution");
        return text;
    }
    snprintf(text, size, "%s", rb_report_proof_status(p, status, sizeof status));
    if (p->least_sum > 0.0) /* two digits are not above it */
        rb_append(text, size, ": every solution has sum(z) >= %.2g", 0.95 * p->least_sum);
    else if (!p->proved) {
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
    rb_report_json_set(&object, "least_sum",
                       rb_report_json_number(p->least_sum > 0.0 ? p->least_sum : NAN));
    return object;
}

const char *rb_report_number_text(const rb_lcp_number *n, char *text, size_t size)
{
    text[0] = '\0';
    if (n->most == 0)
        rb_append(text, size, "proved: there is no solution");
    else if (n->most == n->least)
        rb_append(text, size, "proved: exactly %d solution%s", n->least, rb_plural(n->least));
    else if (n->least > 0)
        rb_append(text, size, "proved: at least %d solution%s", n->least, rb_plural(n->least));
    else
        rb_append(text, size,
                  n->most > 0 ? "proved: " : "not proved: how many solutions there are");
    if (n->most > n->least)
        rb_append(text, size, "%sat most %d", n->least ? ", " : "", n->most);
    if (n->open)
        rb_append(text, size, "; of %d complementary %s it is open", n->open,
                  n->open == 1 ? "basis" : "bases");
    return text;
}

json_t *rb_report_json_number_of_solutions(const rb_lcp_number *n)
{
    json_t *object = json_object();
    rb_report_json_set(&object, "least", json_integer(n->least));
    rb_report_json_set(&object, "most", n->most >= 0 ? json_integer(n->most) : json_null());
    rb_report_json_set(&object, "open", json_integer(n->open));
    return object;
}

/* ---- Friction ------------------------------------------------------------------------- */

const char *rb_report_friction_proof_text(const rb_friction_proof *p, char *text, size_t size)
{
    static const char *const zones[] = {"separated", "stick", "slip", "closed without friction"};
    text[0] = '\0';
    if (p->proved) {
        const char *before = "proved: ";
        for (int k = 0; k < 4; k++)
            if (p->zones[k]) {
                rb_append(text, size, "%s%d %s", before, p->zones[k], zones[k]);
                before = ", ";
            }
        rb_append(
            text, size,
            "; %sreactions within %.2g max r of the solution, those printed within %.2g max r",
            p->isolated ? "isolated, " : "", p->bound, p->stored_within);
    } else {
        rb_append(text, size, "not proved: %s", p->reason);
        if (p->contact >= 0)
            rb_append(text, size, " (contact %d)", p->contact + 1);
    }
    if (isfinite(p->nearby))
        rb_append(text, size, "; exact for q and mu within %.2g", p->nearby);
    if (p->condensed)
        rb_append(text, size, "; of the condensed problem");
    return text;
}

json_t *rb_report_json_friction_proof(const rb_friction_proof *p)
{
    const rb_lcp_proof as_lcp = {.proved = p->proved,
                                 .reason = p->reason,
                                 .row = -1,
                                 .bound = p->bound,
                                 .stored_within = p->stored_within,
                                 .isolated = p->isolated,
                                 .nearby = p->nearby,
                                 .margin = p->margin,
                                 .norm = p->norm};
    json_t *object = rb_report_json_proof(&as_lcp);
    rb_report_json_set(&object, "contact",
                       p->contact >= 0 ? json_integer(p->contact + 1) : json_null());
    rb_report_json_set(&object, "touching", json_integer(p->proved ? p->touching : 0));
    rb_report_json_set(&object, "condensed", json_boolean(p->condensed));
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
        else if (strcmp(unique, "at its creepage") == 0)
            rb_append(text, size, ", unique at its creepage");
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
