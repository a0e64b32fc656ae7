/* Which results a study has: those of its cases, and those that options name. */
#include "program/cli/case.h"
#include "program/cli/study.h"

#include <string.h>

/* A file names a column once: what was given is not printed again. */
static int is_given(const study *st, const char *name)
{
    for (int k = 0; k < st->columns; k++)
        if (strcmp(st->column[k].heading, name) == 0)
            return 1;
    return 0;
}

static void choose(study *st, study_result wanted)
{
    for (int k = 0; k < st->results; k++)
        if (st->result[k].r == wanted.r && st->result[k].is_error == wanted.is_error)
            return;
    if (st->results < RESULTS_MAX)
        st->result[st->results++] = wanted;
}

/* The results of the cases, and whose they are: of a crack and its contact, or of the
 * contact and the stress below it. */
typedef struct {
    int n;
    const rb_rolling_results *table[5];
    int of[5];
} study_tables;

/* The contact of a crack has no error bars of its own. */
static int has_error_bar(const study *st, const study_result *of)
{
    const int of_cycle =
        of->r->condition == RB_FOR_FRETTING || of->r->condition == RB_FOR_FRETTING_B;
    return of->r->error_bar && (of->of == OF_CRACK || !st->has_crack) &&
           (of_cycle || !rb_case_resolved(st->one)->rc.fretting);
}

/* A crack may have a result of the same name as its contact. */
static int has_meaning(const study *st, const study_result *of)
{
    return of->of != OF_CRACK || rb_case_crack_has_result(of->r, rb_case_crack_of(st->one));
}

/* The number of a bond of this name; 0: it is none, or there are too many. */
static int choose_bond(study *st, const char *name, study_result *found)
{
    rb_rolling_bond_number b;
    int i = 0;
    if (st->has_crack || !rb_rolling_find_bond_number(name, &b.k, &b.part, &b.of_b))
        return 0;
    while (i < st->bonds && memcmp(&st->bond[i], &b, sizeof b) != 0)
        i++;
    if (i == RB_ROW_BONDS)
        return 0;
    st->bond[i] = b;
    st->bonds += i == st->bonds;
    *found = (study_result){rb_rolling_describe_maximum(b.k, b.part, b.of_b, &st->bond_of[i]),
                            OF_BOND, 0, i};
    return 1;
}

/* "error_max_pressure" is the error bar of max_pressure, which comes along. */
static cli_exit choose_by_name(study *st, const char *option, const char *name)
{
    const int bar = strncmp(name, "error_", 6) == 0;
    const char *own = bar ? name + 6 : name;
    rb_guess guess = {.word = own};
    const study_tables from =
        st->has_crack ? (study_tables){2,
                                       {&rb_case_crack_scalars, &rb_rolling_solution_scalars},
                                       {OF_CRACK, OF_SOLUTION}}
                      : (study_tables){5,
                                       {&rb_rolling_solution_scalars, &rb_rolling_maxima_scalars,
                                        &rb_rolling_maxima_b_scalars, &rb_rolling_bond_scalars,
                                        &rb_rolling_bond_b_scalars},
                                       {OF_SOLUTION, OF_STRESS, OF_STRESS_B, OF_BOND, OF_BOND}};
    study_result of_bond;
    if (bar && !rb_case_resolved(st->base)->error)
        return cli_case_refuse(st->base, option, "'%s' needs --error", name);
    if (choose_bond(st, own, &of_bond)) {
        choose(st, of_bond);
        return CLI_CONTINUE;
    }
    for (int t = 0; t < from.n; t++)
        for (int k = 0; k < from.table[t]->n; k++) {
            const study_result found = {&from.table[t]->row[k], from.of[t], 0, 0};
            rb_guess_try(&guess, found.r->name);
            if (strcmp(found.r->name, own) != 0 || !has_meaning(st, &found))
                continue;
            choose(st, found);
            return bar && !has_error_bar(st, &found)
                       ? cli_case_refuse(st->base, option, "%s has no error bar", own)
                       : CLI_CONTINUE;
        }
    /* With the results that there are, where none is similar. */
    const char *near = rb_guess_text(&guess, bar ? "error_" : "");
    char all[3000] = "";
    for (int t = 0; t < from.n && !*near; t++)
        for (int k = 0; k < from.table[t]->n; k++)
            rb_append(all, sizeof all, "%s%s", *all ? ", " : "; there are ",
                      from.table[t]->row[k].name);
    return cli_case_refuse(st->base, option, "no result '%s'%s%s", name, near, all);
}

unsigned cli_study_stress_of(const study *st, const study_result *of)
{
    const int of_b = of->of == OF_STRESS_B || (of->of == OF_BOND && st->bond[of->bond].of_b);
    return of->of == OF_SOLUTION || of->of == OF_CRACK ? 0U
           : of_b                                      ? RB_ROW_STRESS_B
                                                       : RB_ROW_STRESS;
}

/* Those of the crack, or those that the cases have and no option names, then those of
 * --results and --show, then the error bars of all; derivatives, and standard deviations of
 * the results of the contact. */
cli_exit cli_study_choose_results(study *st)
{
    const rb_resolved_case *one = rb_case_resolved(st->one);
    char heading[RB_ROLLING_HEADING];
    const rb_rolling_result *r;
    rb_message why = {.text = ""};
    cli_exit code = CLI_CONTINUE;
    for (int k = 0; k < rb_case_crack_scalars.n && st->has_crack; k++)
        if (has_meaning(st, &(study_result){&rb_case_crack_scalars.row[k], OF_CRACK, 0, 0}))
            choose(st, (study_result){&rb_case_crack_scalars.row[k], OF_CRACK, 0, 0});
    for (int k = 1; (r = rb_rolling_study_column(k)) && !st->has_crack; k++)
        if (rb_rolling_has_result(r, &one->rc, 0) &&
            !is_given(st, rb_rolling_heading(r, one->units, heading)))
            choose(st, (study_result){r, OF_SOLUTION, 0, 0});
    char name[STUDY_HEADING];
    for (const char *at = st->o->results;
         code == CLI_CONTINUE && (at = rb_next_word(at, name, sizeof name));)
        code = choose_by_name(st, "results", name);
    if (code == CLI_CONTINUE && cli_study_has_pictures(st)) {
        const char *shown = cli_study_shown(st);
        code = is_given(st, shown)
                   ? cli_case_refuse(st->base, "show", "%s varies; expected a result", shown)
                   : choose_by_name(st, "show", shown);
    }
    if (code == CLI_CONTINUE && one->error) {
        const int n = st->results;
        for (int k = 0; k < n; k++)
            if (has_error_bar(st, &st->result[k]))
                choose(st,
                       (study_result){st->result[k].r, st->result[k].of, 1, st->result[k].bond});
    }
    const int frets = one->rc.fretting;
    if (code == CLI_CONTINUE && frets &&
        (st->o->derivatives || (st->o->tolerance && !st->o->sample)))
        code = cli_case_refuse(st->base, st->o->derivatives ? "derivatives" : "tolerance",
                               "what fretting does has no derivatives; --sample draws cases");
    if (code == CLI_CONTINUE && st->o->derivatives && st->has_crack)
        code = cli_case_refuse(st->base, "derivatives", "the K of cracks have none");
    if (code == CLI_CONTINUE && st->o->derivatives) {
        const rb_status s =
            rb_case_slopes_choose(st->base, &rb_rolling_solution_scalars, st->o->derivatives,
                                  RB_ROW_OWN, &st->slopes, &why);
        if (s != RB_OK)
            code = cli_case_refused(st->base, s, &why);
    }
    const int deviates = st->o->tolerance && st->o->sample == 0;
    if (code == CLI_CONTINUE && deviates && st->has_crack)
        code = cli_case_refuse(st->base, "tolerance",
                               "the K of cracks have no derivatives; give --sample");
    if (code == CLI_CONTINUE && deviates) {
        const rb_rolling_result *of[RESULTS_MAX];
        int n = 0;
        for (int k = 0; k < st->results; k++)
            if (st->result[k].of == OF_SOLUTION && !st->result[k].is_error)
                of[n++] = st->result[k].r;
        const rb_status s =
            rb_case_slopes_add_deviations(st->base, st->o->tolerance, n, of, &st->slopes, &why);
        if (s != RB_OK)
            code = cli_case_refused(st->base, s, &why);
    }
    /* Not every body's stress is known; what else is wrong is known with the first case. */
    if (code != CLI_CONTINUE)
        return code;
    const rb_rolling_case *rc = &rb_case_resolved(st->one)->rc;
    for (int k = 0; k < st->results; k++) {
        const unsigned stress = cli_study_stress_of(st, &st->result[k]);
        const rb_status s = stress == RB_ROW_STRESS     ? rb_rolling_stress_check(rc, &why)
                            : stress == RB_ROW_STRESS_B ? rb_rolling_mirror_check(rc, &why)
                                                        : RB_OK;
        if (s != RB_OK)
            return cli_case_refused(st->one, s, &why);
    }
    return CLI_CONTINUE;
}
