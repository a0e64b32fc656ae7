/* What a steady half-plane may have besides, against the plain one on as many elements:
 * processor time of a whole solution, the least of three, on the mesh that the program
 * chooses and on equal elements, for similar and for unlike bodies.  Arguments: elements
 * (default 400 1600 6400). */
#include "fast_blas.h"
#include "rolling/case/case.h"
#include "rows.h"

#include <stdlib.h>
#include <string.h>

/* Options in words: name, value, name, value, ...; NULL: no more. */
typedef struct {
    const char *name;
    const char *word[12];
} ability;

#define HEAT "conductivity", "50", "heat-capacity", "3.5", "speed", "1e5", "mu-heat"
static const ability abilities[] = {
    {"none", {NULL}},
    {"friction falls with slip",
     {"friction-law", "exponential", "mu-fall", ".1", "slip-scale", "2", "speed", "1000"}},
    {"... and with memory",
     {"friction-law", "exponential", "mu-fall", ".1", "slip-scale", "2", "speed", "1000", "memory",
      ".05"}},
    {"friction falls by heat, .1", {HEAT, "-.1,0,.01"}},
    {"friction falls by heat, .2", {HEAT, "-.2,0,.01"}},
    {"normal interlayer", {"interlayer-normal", "1e-6"}},
    {"tangential interlayer", {"interlayer-tangential", "1e-6"}},
    {"yielding interlayer", {"yield-stress", "10", "hardening", "1e5"}},
};
enum { ABILITIES = sizeof abilities / sizeof *abilities, MOST_SIZES = 6 };

static const struct {
    const char *name, *word[6];
} kinds[] = {{"similar, aligned", {NULL}},
             {"similar, equal", {"mesh", "uniform"}},
             {"unlike, aligned", {"young-b", "70000", "poisson-b", ".3"}},
             {"unlike, equal", {"young-b", "70000", "poisson-b", ".3", "mesh", "uniform"}}};

static rb_status set_words(rb_case *c, int most, const char *const *word, rb_message *why)
{
    rb_status s = RB_OK;

    for (int k = 0; k + 1 < most && word[k] && s == RB_OK; k += 2)
        s = rb_case_set(c, word[k], word[k + 1], RB_GIVEN_ARGUMENT, why);
    return s;
}

/* The case of every row; NULL: *why tells. */
static rb_case *case_with(int n, int kind, const ability *with, rb_message *why)
{
    static const char *const common[] = {"support",     "halfplane", "half-width",  ".05",
                                         "formulation", "steady",    "creep-ratio", ".4",
                                         "poisson",     ".5"};
    rb_case *c = rb_case_create(RB_CASE_SINGLE);
    rb_status s = c ? set_words(c, 10, common, why) : RB_ENOMEM;

    if (s == RB_OK)
        s = rb_case_set_number(c, "contact-elements", n, why);
    if (s == RB_OK)
        s = set_words(c, 6, kinds[kind].word, why);
    if (s == RB_OK)
        s = set_words(c, 12, with->word, why);
    if (s == RB_OK)
        s = rb_case_resolve(c, why);
    if (s != RB_OK)
        rb_case_free(c);
    return s == RB_OK ? c : NULL;
}

static double seconds(int n, int kind, const ability *with)
{
    double least = INFINITY;

    for (int k = 0; k < 3 && !(k > 0 && least > 2.0); k++) {
        rb_message why = {.text = ""};
        rb_case *c = case_with(n, kind, with, &why);
        rb_case_result result = {0};
        const double start = processor_seconds();
        if (!c || rb_case_solve(rb_case_resolved(c), NULL, NULL, &result, &why) != RB_OK) {
            fprintf(stderr, "bench_abilities: %s\n", why.text);
            exit(70);
        }
        least = fmin(least, processor_seconds() - start);
        rb_case_result_free(&result);
        rb_case_free(c);
    }
    return least;
}

int main(int argc, char **argv)
{
    static const int usual[] = {400, 1600, 6400};
    const int sizes = argc > 1 ? (argc - 1 < MOST_SIZES ? argc - 1 : MOST_SIZES) : 3;
    int n[MOST_SIZES];

    fast_blas(argv);
    for (int k = 0; k < sizes; k++)
        n[k] = argc > 1 ? atoi(argv[k + 1]) : usual[k];
    for (int kind = 0; kind < 4; kind++) {
        double plain[MOST_SIZES];
        printf("\n| %s |", kinds[kind].name);
        for (int k = 0; k < sizes; k++)
            printf(" %s | / plain |", row_count(n[k]).text);
        printf("\n|---|");
        for (int k = 0; k < sizes; k++)
            printf("---|---|");
        printf("\n");
        for (int a = 0; a < ABILITIES; a++) {
            printf("| %s |", abilities[a].name);
            for (int k = 0; k < sizes; k++) {
                const double spent = seconds(n[k], kind, &abilities[a]);
                plain[k] = a == 0 ? spent : plain[k];
                printf(" %s | %.1f |", row_seconds(spent).text, spent / plain[k]);
                fflush(stdout);
            }
            printf("\n");
        }
    }
    return 0;
}
