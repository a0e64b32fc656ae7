/* The certificate of a result of --all-solutions: each solution is checked separately, as
 * the result of a case with the same inputs, and the solutions must differ. */
#include "program/certificate/internal.h"

#include "rollbem/case.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* Solutions whose friction differs by less, as a part of the largest one, are one. */
static const double SAME = 1e-7;

/* The largest difference of friction between two results, as a part of the largest
 * friction; INFINITY: their tables are not alike. */
static double difference(const json_t *one, const json_t *other)
{
    const json_t *q[] = {json_object_get(json_object_get(one, "table"), "q_MPa"),
                         json_object_get(json_object_get(other, "table"), "q_MPa")};
    const size_t n = json_array_size(q[0]);
    double most = 0.0, largest = 0.0;

    if (json_array_size(q[1]) != n)
        return INFINITY;
    for (size_t i = 0; i < n; i++) {
        const double a = json_number_value(json_array_get(q[0], i)),
                     b = json_number_value(json_array_get(q[1], i));
        most = fmax(most, fabs(a - b));
        largest = fmax(largest, fmax(fabs(a), fabs(b)));
    }
    return largest > 0.0 ? most / largest : 0.0;
}

/* The result with the summary and the table of `from`, and without a list. */
static json_t *result_with(const json_t *root, const json_t *from)
{
    json_t *one = json_copy((json_t *)root);

    static const char *const own[] = {"notes",           "derivatives",     "without_derivatives",
                                      "derivatives_are", "derivatives_of",  "tolerances",
                                      "own_of_b",        "uncertain_inputs"};
    if (one && json_object_size(one) != json_object_size(root)) { /* json_copy does not tell */
        json_decref(one);
        return NULL;
    }
    json_object_del(one, "solutions");
    for (size_t k = 0; k < sizeof own / sizeof *own && from != root; k++)
        json_object_del(one, own[k]); /* they are of the result itself */
    if (one && (json_object_set(one, "summary", json_object_get(from, "summary")) != 0 ||
                json_object_set(one, "table", json_object_get(from, "table")) != 0)) {
        json_decref(one);
        one = NULL;
    }
    return one;
}

/* one: taken over; NULL: no memory. */
static rb_status certify_one(FILE *out, const char *name, json_t *one, rb_case *words,
                             rb_certificate_outcome *found, rb_message *why)
{
    rb_certificate_outcome own;
    const rb_status s = one ? rb_certificate_check(out, name, one, words, &own, why)
                            : rb_fail(why, RB_ENOMEM, "%s: out of memory", name);

    json_decref(one);
    if (s == RB_OK) {
        found->violations += own.violations;
        found->numbers += own.numbers;
        found->residual = fmax(found->residual, own.residual);
    }
    return s;
}

rb_status rb_certificate_check_solutions(FILE *out, const char *name, const json_t *root,
                                         rb_case *words, rb_certificate_outcome *found,
                                         rb_message *why)
{
    const json_t *all = json_object_get(root, "solutions");
    char label[400];

    memset(found, 0, sizeof *found);
    if (json_object_get(root, "crack"))
        return rb_certificate_crack(out, name, root, words, found, why);
    if (!all)
        return rb_certificate_check(out, name, root, words, found, why);
    if (!json_is_array(all) || json_array_size(all) == 0)
        return rb_fail(why, RB_EFORMAT, "%s: cannot be checked: no list of solutions", name);
    rb_status s = certify_one(out, name, result_with(root, root), words, found, why);
    for (size_t k = 0; k < json_array_size(all) && s == RB_OK; k++) {
        const json_t *one = json_array_get(all, k);
        snprintf(label, sizeof label, "%.300s: solution %zu", name, k + 1);
        s = json_object_size(one) == 2
                ? certify_one(out, label, result_with(root, one), words, found, why)
                : rb_fail(why, RB_EFORMAT, "%s: cannot be checked: expected a summary and a table",
                          label);
    }
    if (s == RB_OK) {
        /* Each must be another one, and the result itself one of them. */
        int listed = 0;

        for (size_t k = 0; k < json_array_size(all); k++) {
            const json_t *one = json_array_get(all, k);
            listed |= difference(root, one) < SAME;
            for (size_t j = 0; j < k; j++)
                if (difference(one, json_array_get(all, j)) < SAME) {
                    fprintf(out, "%s: violated: solutions %zu and %zu are the same\n", name, j + 1,
                            k + 1);
                    found->violations++;
                }
        }
        if (!listed) {
            fprintf(out, "%s: violated: the result is none of its solutions\n", name);
            found->violations++;
        }
    }
    return s;
}
