/* A certificate of a result: the case is built again from the inputs that the result prints, its
 * model on the elements and with the state that are stored in it, and the writer of results writes
 * it again.  Nothing is solved but free rolling and other solutions, which are results of their
 * own. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Solutions whose friction differs by less, as a part of the largest one, are one. */
static const double SAME = 1e-6;

/* ---- What can be checked ----------------------------------------------------------- */

static rb_status check_head(const rb_certificate *c, const json_t *root, rb_message *why)
{
    static const char *const others[] = {"curve", "wear", "design", "parameters"},
                             *const with_more[] = {"history", "maxima", "grid", "points", "crack"};
    const json_t *inputs = json_object_get(root, "inputs"),
                 *summary = json_object_get(root, "summary");
    const int is_given = json_is_object(json_object_get(root, "tractions"));

    if (strcmp(rb_certificate_word(root, "schema"), "rollbem/1") != 0)
        return rb_certificate_refuse(c, "not a result of schema rollbem/1", why);
    if (json_object_get(root, "growth"))
        return rb_certificate_refuse(
            c, "a crack that grows: the faces at its other lengths are not printed", why);
    if (json_object_get(root, "crack") && !json_is_object(json_object_get(root, "faces")))
        return rb_certificate_refuse(
            c, "its stress intensities follow from the faces: take --states", why);
    for (size_t k = 0; k < sizeof others / sizeof *others; k++)
        if (json_object_get(root, others[k]))
            return rb_fail(why, RB_EFORMAT,
                           "%s: cannot be checked: results with '%s' (only single cases, "
                           "histories, stress and cracks without error bars can be)",
                           c->name, others[k]);
    if (!json_is_object(inputs) || (!is_given && (!json_is_object(summary) ||
                                                  !json_is_object(json_object_get(root, "table")))))
        return rb_certificate_refuse(c,
                                     "inputs, summary or table is missing (only single cases, "
                                     "histories, stress and cracks without error bars can be)",
                                     why);
    const int has_bars = json_is_true(json_object_get(inputs, "error")) ||
                         json_object_get(summary, "errors") ||
                         json_is_number(json_object_get(inputs, "accuracy"));
    for (size_t k = 0; k < sizeof with_more / sizeof *with_more && has_bars; k++)
        if (json_object_get(root, with_more[k]))
            return rb_certificate_refuse(c, "error bars take solutions on other meshes", why);
    if (strcmp(rb_certificate_word(inputs, "units"), "mm") != 0 ||
        strcmp(rb_certificate_word(json_object_get(root, "units"), "system"), "mm") != 0)
        return rb_certificate_refuse(c, "units other than mm, N, MPa", why);
    if (!is_given && strcmp(rb_certificate_word(summary, "status"), "solved") != 0)
        return rb_certificate_refuse(c, "its status is not solved", why);
    if (strcmp(rb_certificate_word(root, "version"), RB_VERSION) != 0)
        return rb_certificate_refuse(c, "it is of another version of rollbem", why);
    return RB_OK;
}

/* A sequence of steps needs the states of all, of which the last one follows. */
static rb_status check_steps(const rb_certificate *c, const json_t *root,
                             const rb_resolved_case *resolved, rb_message *why)
{
    const json_t *history = json_object_get(root, "history");

    if (rb_case_has_steps(resolved) != json_is_object(history))
        return rb_certificate_refuse(c, "its inputs and its history do not belong together", why);
    if (history && !json_is_object(json_object_get(history, "states")))
        return rb_certificate_refuse(
            c,
            json_object_get(root, "maxima")
                ? "its last state depends on the steps before it, which `rollbem stress` does not "
                  "print: check the contact alone, by the same case without `stress`, with --json "
                  "--states"
                : "its last state depends on the steps before it: take --states",
            why);
    return RB_OK;
}

/* ---- A case ------------------------------------------------------------------------ */

typedef struct {
    const json_t *root;
    rb_case *words;
} source;

/* All that is written of a case, as the command that solves it has it. */
typedef struct {
    rb_case_result r;
    rb_rolling_states states;
    rb_rolling_solutions all;
    rb_certificate_stress stress;
    rb_certificate_slopes slopes;
    rb_certificate_given given;
} parts;

static void free_parts(parts *p)
{
    rb_certificate_slopes_free(&p->slopes);
    rb_rolling_stress_grid_free(&p->stress.grid);
    rb_rolling_stress_maxima_free(&p->stress.maxima);
    free(p->given.numbers);
    rb_rolling_solutions_free(&p->all);
    rb_rolling_states_free(&p->states);
    rb_case_result_free(&p->r);
}

/* The largest difference of friction between two solutions, as a part of the largest
 * friction; INFINITY: their tables are not alike. */
static double difference(const rb_rolling_solution *a, const rb_rolling_solution *b)
{
    double most = 0.0, largest = 0.0;

    for (int i = 0; i < a->n && a->n == b->n; i++) {
        most = fmax(most, fabs(a->q[i] - b->q[i]));
        largest = fmax(largest, fmax(fabs(a->q[i]), fabs(b->q[i])));
    }
    return a->n != b->n ? INFINITY : largest > 0.0 ? most / largest : 0.0;
}

static int is_among(const rb_rolling_solutions *all, int n, const rb_rolling_solution *one)
{
    for (int k = 0; k < n; k++)
        if (difference(&all->solution[k], one) < SAME)
            return k + 1;
    return 0;
}

static rb_status restore_solutions(rb_certificate *c, const source *of, parts *p, rb_message *why)
{
    const json_t *list = json_object_get(of->root, "solutions");
    const size_t n = json_array_size(list);
    char label[40];
    rb_status s = RB_OK;

    if (n == 0)
        return rb_certificate_refuse(c, "no list of solutions", why);
    p->all.solution = calloc(n, sizeof *p->all.solution);
    if (!p->all.solution)
        return RB_ENOMEM;
    for (size_t k = 0; k < n && s == RB_OK; k++) {
        const json_t *one = json_array_get(list, k);
        const json_t *summary = json_object_get(one, "summary");
        const rb_certificate_contact stored = {summary,
                                               json_object_get(one, "table"),
                                               NULL,
                                               rb_certificate_member(summary, "residual"),
                                               rb_certificate_member(summary, "accuracy_elements"),
                                               rb_certificate_member(summary, "accuracy_boundary")};
        rb_case_result r = {0};
        snprintf(label, sizeof label, "solution %zu", k + 1);
        c->of = label;
        s = stored.summary && stored.table
                ? rb_certificate_restore(c, rb_case_resolved(of->words), &stored, &r, NULL, why)
                : rb_fail(why, RB_EFORMAT,
                          "%s: %s: cannot be checked: expected a summary and a table", c->name,
                          label);
        if (s == RB_OK) {
            p->all.solution[p->all.n++] = r.solution;
            memset(&r.solution, 0, sizeof r.solution);
        }
        rb_case_result_free(&r);
        c->of = "";
    }
    return s;
}

/* Each is another one, the result is one of them, and none is missing that a search from here
 * finds. */
static rb_status judge_solutions(rb_certificate *c, parts *p, rb_message *why)
{
    rb_rolling_solutions found = {0};

    for (int k = 0; k < p->all.n; k++) {
        const int other = is_among(&p->all, k, &p->all.solution[k]);
        if (other > 0)
            rb_certificate_violated(c, "solutions %d and %d are the same", other, k + 1);
    }
    if (!is_among(&p->all, p->all.n, &p->r.solution))
        rb_certificate_violated(c, "the result is none of its solutions");
    const rb_status s = rb_rolling_find_solutions(&p->r.model, &found, why);
    for (int k = 0; k < found.n && s == RB_OK; k++)
        if (!is_among(&p->all, p->all.n, &found.solution[k]))
            rb_certificate_violated(c, "solutions: one with Q = %.6g N/mm is missing",
                                    found.solution[k].tangential_load);
    rb_rolling_solutions_free(&found);
    return s;
}

/* A printed bound that is less than this part of the bound that is proved now is not one that the
 * program has printed: bounds differ by the order of a few sums alone. */
static const double LEAST = 0.01;

/* What the summary prints of a proof, against the proof that was found from the stored state. */
static void judge_proof(rb_certificate *c, const json_t *summary)
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

/* What is said of the materials is judged by their values: that one of them was not given is known
 * from no input. */
static void confirm_materials(const json_t *root, const rb_case *words, rb_rolling_note_list *notes)
{
    const json_t *said = json_object_get(root, "notes");

    for (size_t k = 0; k < json_array_size(said); k++) {
        const char *note = json_string_value(json_array_get(said, k));
        if (note)
            rb_case_confirm_materials(words, note, notes);
    }
}

/* Bars take solutions on other meshes, and are taken as stated: which results have one is
 * compared, and that none is negative. */
static void restore_bars(rb_certificate *c, const rb_resolved_case *resolved, const json_t *summary,
                         rb_case_result *r)
{
    const json_t *bars = json_object_get(summary, "errors");

    r->has_errors = !rb_case_has_steps(resolved) && (resolved->error || resolved->accuracy > 0.0);
    for (int k = 0; k < rb_rolling_solution_scalars.n && r->has_errors; k++) {
        const rb_rolling_result *one = &rb_rolling_solution_scalars.row[k];
        const double bar = rb_certificate_member(bars, one->name);
        rb_rolling_set_number(one, &r->errors.scalar, bar);
        if (bar < 0.0 && c->judges)
            rb_certificate_violated(c, "errors: %s is printed as %.3g, below 0", one->name, bar);
    }
    c->found->bars = r->has_errors;
}

static rb_status write_case(rb_certificate *c, void *context, json_t **again, rb_message *why)
{
    const source *of = context;
    const json_t *root = of->root, *history = json_object_get(root, "history"),
                 *summary = json_object_get(root, "summary");
    const rb_certificate_contact stored = {summary,
                                           json_object_get(root, "table"),
                                           history,
                                           rb_certificate_member(summary, "residual"),
                                           rb_certificate_member(summary, "accuracy_elements"),
                                           rb_certificate_member(summary, "accuracy_boundary")};
    const int has_solutions = json_object_get(root, "solutions") != NULL;
    static const char *const of_stress[] = {"maxima", "grid", "points"};
    int has_stress = 0;
    parts p = {.all.n = 0};

    for (size_t k = 0; k < sizeof of_stress / sizeof *of_stress; k++)
        has_stress |= json_object_get(root, of_stress[k]) != NULL;
    const int is_given = json_is_object(json_object_get(root, "tractions"));
    rb_status s = is_given ? rb_certificate_restore_given(c, root, rb_case_resolved(of->words),
                                                          &p.r, &p.given, why)
                           : rb_certificate_restore(c, rb_case_resolved(of->words), &stored, &p.r,
                                                    &p.states, why);
    if (s == RB_OK && c->judges)
        judge_proof(c, summary);
    if (s == RB_OK)
        restore_bars(c, rb_case_resolved(of->words), summary, &p.r);
    if (s == RB_OK && has_stress)
        s = rb_certificate_restore_stress(c, root, &p.r, &p.stress, why);
    if (s == RB_OK && is_given)
        rb_report_stress_take(&p.stress.shown, &p.given.rows, &p.r.model);
    if (s == RB_OK && !is_given)
        s = rb_certificate_restore_slopes(c, root, of->words, &p.r, &p.states, &p.slopes, why);
    if (s == RB_OK && has_solutions)
        s = restore_solutions(c, of, &p, why);
    if (s == RB_OK && has_solutions && c->judges)
        s = judge_solutions(c, &p, why);
    if (s == RB_OK) {
        rb_rolling_note_list notes =
            is_given ? (rb_rolling_note_list){.n = 0}
                     : rb_rolling_find_notes(&rb_case_resolved(of->words)->rc, &p.r.solution);
        rb_rolling_list_step_notes(p.r.of_steps, "step", &notes);
        confirm_materials(root, of->words, &notes);
        *again = rb_report_json_document(&(rb_report_document){
            .command = rb_certificate_word(root, "command"),
            .words = of->words,
            .notes = is_given ? NULL : &notes,
            .result = is_given ? NULL : &p.r,
            .states = history ? &p.states : NULL,
            .slopes = &p.slopes.of_steps,
            .stress = has_stress ? &p.stress.shown : NULL,
            .solutions = has_solutions ? &p.all : NULL,
            .derivatives = p.slopes.names && !history ? &p.slopes.shown : NULL,
            .deviations = p.slopes.deviates && !history ? &p.slopes.shown : NULL,
            .derivatives_of = p.slopes.names,
            .uncertain = p.slopes.deviates ? &p.slopes.uncertain : NULL});
        s = *again ? RB_OK : RB_ENOMEM;
    }
    free_parts(&p);
    return s;
}

/* ---- A crack ----------------------------------------------------------------------- */

static rb_status write_crack(rb_certificate *c, void *context, json_t **again, rb_message *why)
{
    const source *of = context;
    rb_case_crack_result r = {.notes = 0};
    rb_status s = rb_certificate_restore_crack(c, of->root, of->words, &r, why);

    if (s == RB_OK) {
        const rb_rolling_solution *contact = &r.contact.solution;
        rb_rolling_note_list notes =
            contact->n > 0 ? rb_rolling_find_notes(&rb_case_resolved(of->words)->rc, contact)
                           : (rb_rolling_note_list){.n = 0};
        rb_rolling_list_step_notes(r.contact.of_steps, "step", &notes);
        confirm_materials(of->root, of->words, &notes);
        *again = rb_report_json_document(
            &(rb_report_document){.command = rb_certificate_word(of->root, "command"),
                                  .words = of->words,
                                  .notes = contact->n > 0 ? &notes : NULL,
                                  .crack = &r,
                                  .faces = 1});
        s = *again ? RB_OK : RB_ENOMEM;
    }
    rb_case_crack_free(&r);
    return s;
}

/* What a crack needs to be checked. */
static rb_status check_crack(const rb_certificate *c, const json_t *root, const rb_case *words,
                             rb_message *why)
{
    const rb_case_crack *crack = rb_case_crack_of(words);
    const json_t *faces = json_object_get(root, "faces");
    const size_t rows = json_array_size(json_object_get(json_object_get(root, "table"), "x"));

    /* before anything is computed that is larger than the file */
    if ((size_t)rb_case_resolved(words)->rc.steps > rows ||
        (size_t)crack->elements > json_array_size(json_object_get(faces, "x_mm")) + 1)
        return rb_fail(why, RB_EFORMAT,
                       "%s: cannot be checked: %zu nodes in faces, %zu positions in table, not as "
                       "many as --crack-elements and --steps ask for",
                       c->name, json_array_size(json_object_get(faces, "x_mm")), rows);
    return rb_case_crack_check(rb_case_resolved(words), crack, why);
}

/* ---- Any result -------------------------------------------------------------------- */

/* Names of the machine that has solved are those that are printed. */
static void take_over_machine(const json_t *printed, json_t *again)
{
    static const char *const names[] = {"integrals", "openblas"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        json_t *name = json_object_get(printed, names[k]);
        if (json_object_get(again, names[k]) && json_is_string(name) && *json_string_value(name))
            json_object_set(again, names[k], name);
    }
}

static rb_status write_again(rb_certificate *c, void *context, json_t **again, rb_message *why)
{
    source *of = context, other = *of;
    const int is_crack = json_object_get(of->root, "crack") != NULL;
    rb_status s = RB_OK;

    if (c->moving > 0)
        s = rb_certificate_move_inputs(c, of->root, of->words, &other.words, why);
    if (s == RB_OK)
        s = (is_crack ? write_crack : write_case)(c, &other, again, why);
    if (c->moving > 0)
        rb_case_free(other.words);
    const json_t *all = json_object_get(of->root, "solutions");

    if (s != RB_OK)
        return s;
    take_over_machine(json_object_get(of->root, "summary"), json_object_get(*again, "summary"));
    json_t *proof = json_object_get(json_object_get(of->root, "summary"), "proof");
    if (proof) /* which has been judged */
        json_object_set(json_object_get(*again, "summary"), "proof", proof);
    take_over_machine(json_object_get(of->root, "contact"), json_object_get(*again, "contact"));
    for (size_t k = 0; k < json_array_size(all); k++)
        take_over_machine(
            json_object_get(json_array_get(all, k), "summary"),
            json_object_get(json_array_get(json_object_get(*again, "solutions"), k), "summary"));
    return s;
}

/* 1: the inputs are those of the result, but a file that they name is not; everything else would
 * differ with it. */
static int other_file(rb_certificate *c, const json_t *root, const rb_case *words)
{
    const json_t *printed = json_object_get(root, "input_hash");
    json_t *now = rb_report_json_input_hash(words);
    const int differs = json_is_string(printed) && json_is_string(now) && !json_equal(printed, now);
    char files[300] = "";
    json_decref(now);
    for (const rb_option *o = rb_case_table; differs && o < rb_case_table + rb_case_table_n; o++) {
        const char *path = rb_option_path(o, rb_case_resolved(words));
        if (path && o->file == RB_FILE_READ)
            rb_append(files, sizeof files, "%s%s of --%s", *files ? ", " : "", path, o->name);
    }
    if (*files)
        rb_certificate_violated(c,
                                "input_hash: a file that the inputs name is not the one of the "
                                "result, or has changed since (%s)",
                                files);
    return *files != '\0';
}

rb_status rb_certificate_check(FILE *out, const char *name, const json_t *root, rb_case *words,
                               rb_certificate_outcome *found, rb_message *why)
{
    rb_certificate c = {.out = out, .name = name, .found = found, .of = ""};
    source of = {root, words};
    rb_message reason = {.text = ""};

    const int is_crack = json_object_get(root, "crack") != NULL;

    *found = (rb_certificate_outcome){.prove = found->prove};
    if (is_crack)
        rb_case_crack_set(words);
    rb_status s = check_head(&c, root, &reason);
    if (s == RB_OK)
        s = rb_certificate_inputs(&c, root, words, &reason);
    if (s == RB_OK && other_file(&c, root, words))
        return rb_certificate_end(&c, s, &reason, why);
    if (s == RB_OK)
        s = is_crack ? check_crack(&c, root, words, &reason)
                     : check_steps(&c, root, rb_case_resolved(words), &reason);
    if (s == RB_OK)
        s = rb_certificate_compare(&c, root, write_again, &of, &reason);
    return rb_certificate_end(&c, s, &reason, why);
}
