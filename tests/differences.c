/* Derivatives of a case against central differences of its solutions, for the net.
 *
 *     differences FIRST EVERY BOUND [--OPTION VALUE]...
 *
 * compares every EVERY-th input from number FIRST on.  A line says what deviates by more
 * than BOUND; the exit code is 0, 2 where the case has no derivatives, 1 where it is not
 * solved, each with a line on standard error. */
#include "differences.h"

static int fails(int code, const char *text)
{
    fprintf(stderr, "%s\n", text);
    return code;
}

int main(int argc, char **argv)
{
    rb_message why = {.text = ""};
    rb_case *c = rb_case_create(RB_CASE_SINGLE);
    differences d;

    if (!c || argc < 4)
        return fails(1, "differences FIRST EVERY BOUND [--OPTION VALUE]...");
    for (int i = 4; i < argc; i++) {
        const char *name = argv[i] + 2;
        const rb_option *o = rb_case_option(name);
        if (!o)
            return fails(1, name);
        const char *value = o->kind == RB_OPTION_FLAG ? "yes" : argv[++i];
        /* the state counts, not who finds it and how soon it ends */
        if (strcmp(name, "solver") != 0 && strcmp(name, "tol") != 0 &&
            rb_case_set(c, name, value, RB_GIVEN_ARGUMENT, &why) != RB_OK)
            return fails(1, why.text);
    }
    if (rb_case_set_number(c, "tol", 1e-13, &why) != RB_OK || rb_case_resolve(c, &why) != RB_OK)
        return fails(1, why.text);
    const int first = atoi(argv[1]), every = atoi(argv[2]),
              steps = rb_case_has_steps(rb_case_resolved(c));
    const rb_status s = (steps ? compare_steps : compare_single)(c, first, every, &d, &why);
    if (!(d.off <= atof(argv[3])))
        printf("%.2g: %s\n", d.off, d.text);
    rb_case_free(c);
    return s == RB_OK ? 0 : fails(s == RB_EINVAL ? 2 : 1, why.text);
}
