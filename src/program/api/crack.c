/* A crack below the contact of a case. */
#include "analysis/crack/crack_case.h"
#include "program/api/internal.h"

#include <stdio.h>
#include <string.h>

/* Typed values as they are given: rb_case_store reads plain numbers in the case's units. */
rb_status rb_api_set_crack(rb_api *a, int n, const char *const *name, const char *const *value,
                           rb_case_crack *crack, rb_message *why)
{
    int given[API_CRACK_OPTIONS] = {0}, plain[API_CRACK_OPTIONS] = {0}, k;
    const rb_option_set set = {rb_case_crack_options, rb_case_crack_options_n, crack, given, plain};
    for (int i = 0; i < n; i++) {
        rb_guess guess = {.word = name[i]};
        if (!rb_option_find(1, &set, name[i], strlen(name[i]), &k, &guess))
            return rb_fail(why, RB_EINVAL, "crack: unknown option '%.60s'%s", name[i],
                           rb_guess_text(&guess, ""));
        char label[80];
        snprintf(label, sizeof label, "--%.60s", name[i]);
        const rb_status s = rb_option_assign(&set, k, RB_GIVEN_ARGUMENT, label, value[i], why);
        if (s != RB_OK)
            return s;
    }
    rb_case_store(a->words, &set, crack);
    return RB_OK;
}

/* What a picture of the open crack is drawn from. */
static rb_status keep_faces(rb_api *a, const rb_case_crack_result *r)
{
    const rb_crack_history *h = &r->history;
    const rb_crack_path *path = &r->shape.path;
    const int n = h->nodes, steps = h->n;
    rb_crack *crack = NULL;
    static const char *const names[] = {
        "crack.node.x",  "crack.node.y",  "crack.node.length", "crack.node.t_x", "crack.node.t_y",
        "crack.opening", "crack.sliding", "crack.pressure",    "crack.friction", "crack.zone"};
    enum { NODES = 5, ALL = sizeof names / sizeof *names };
    api_array *at[ALL];
    rb_status s = rb_crack_create(&r->shape, &crack, &a->why);

    for (int k = 0; k < ALL && s == RB_OK; k++) {
        at[k] = rb_api_make_array(a, names[k], n, k < NODES ? 1 : steps);
        s = at[k] ? RB_OK : RB_ENOMEM;
    }
    if (s == RB_OK)
        rb_crack_places(crack, at[0]->at, at[1]->at, at[2]->at, at[3]->at, at[4]->at);
    for (int k = 0; k < n * steps && s == RB_OK; k++) {
        const size_t N = (size_t)(k / n) * 2 * (size_t)n + (size_t)(k % n), T = N + (size_t)n;
        at[5]->at[k] = h->D[N];
        at[6]->at[k] = h->D[T];
        at[7]->at[k] = h->r[N] / at[2]->at[k % n];
        at[8]->at[k] = h->r[T] / at[2]->at[k % n];
        at[9]->at[k] = h->zone[k];
    }
    rb_crack_free(crack);
    if (s == RB_OK && (!rb_api_copy_array(a, "crack.path.x", path->pieces + 1, 1, path->x) ||
                       !rb_api_copy_array(a, "crack.path.y", path->pieces + 1, 1, path->y)))
        s = RB_ENOMEM;
    return s;
}

static int count_step(int step, int steps, void *context)
{
    rb_api *a = context;
    a->total = steps;
    a->done = step;
    return a->stopped;
}

int rb_api_crack(rb_api *a, int n, const char *const *names, const char *const *values)
{
    rb_case_crack crack = rb_case_crack_defaults();
    rb_case_crack_result result = {0};
    rb_api_forget_call(a);
    rb_api_forget_arrays(a, "crack.");
    rb_status s = rb_case_resolve(a->words, &a->why);
    if (s == RB_OK)
        s = rb_api_set_crack(a, n, names, values, &crack, &a->why);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = rb_case_crack_solve(rb_case_resolved(a->words), &crack,
                                &(rb_crack_observer){count_step, a}, &result, &a->why);
    s = rb_api_call_ends(a, s);
    /* Columns over the positions and over the lengths, and the numbers of the pass. */
    const api_entries kept[] = {
        {"crack.", &rb_case_crack_columns, &result.history, result.history.n, 1, 0},
        {"crack.growth.", &rb_case_crack_growth_columns, &result.growth, result.growth.n, 1, 0},
        {"crack.summary.", &rb_case_crack_scalars, &result.summary, 1, 1, sizeof result.summary}};
    for (int t = 0; t < 3; t++)
        for (int k = 0; k < kept[t].table->n && s == RB_OK; k++)
            if (rb_api_has_entries(&kept[t], &kept[t].table->row[k]) &&
                !rb_api_make_entries(a, &kept[t], &kept[t].table->row[k]))
                s = RB_ENOMEM;
    if (s == RB_OK)
        s = keep_faces(a, &result);
    rb_case_crack_free(&result);
    return rb_api_ended(a, s);
}
