/* Covering arrays: few rows in which every pair (or triple) of values of any two (three)
 * factors stands side by side.  Greedy, one row after the other, with a fixed seed. */
#ifndef ROLLBEM_TESTS_COVERING_H
#define ROLLBEM_TESTS_COVERING_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { COVERING_FACTORS = 32, COVERING_OPEN = -1 };

typedef struct {
    int factors, strength; /* strength 2: pairs, 3: triples */
    int levels[COVERING_FACTORS];
    /* 1: no row may have these values together; open factors are COVERING_OPEN */
    int (*forbidden)(const int *row);
    /* 1: a row takes this value only where nothing else covers it (it costs time) */
    int (*rare)(int factor, int level);
    /* 1: this pair or triple need not be covered; the others of the row are open */
    int (*spared)(const int *row);

    /* state */
    int first[COVERING_FACTORS + 1]; /* number of the first value of a factor */
    unsigned char *covered;          /* by the numbers of the two or three values */
    uint64_t random;
    int unreachable; /* tuples that the forbidden ones exclude */
    int tuples;
} covering;

static inline int covering_random(covering *c, int below)
{
    c->random = c->random * 6364136223846793005u + 1442695040888963407u;
    return (int)((c->random >> 33) % (unsigned)below);
}

static inline size_t covering_size(const covering *c)
{
    const size_t values = (size_t)c->first[c->factors];
    return c->strength == 2 ? values * values : values * values * values;
}

static inline void covering_start(covering *c)
{
    c->first[0] = 0;
    for (int f = 0; f < c->factors; f++)
        c->first[f + 1] = c->first[f] + c->levels[f];
    c->covered = calloc(covering_size(c), 1);
    c->random = 20061;
    c->unreachable = c->tuples = 0;
}

/* The place of the values that row has at factors f < g < h (h not read for pairs). */
static inline unsigned char *covering_place(const covering *c, const int *row, int f, int g, int h)
{
    const size_t values = (size_t)c->first[c->factors];
    size_t at = (size_t)(c->first[f] + row[f]) * values + (size_t)(c->first[g] + row[g]);
    if (c->strength == 3)
        at = at * values + (size_t)(c->first[h] + row[h]);
    return &c->covered[at];
}

/* How many tuples with factor k, all of them set in row, are not covered; mark: they are
 * from now on. */
static inline int covering_count(const covering *c, const int *row, int k, int mark)
{
    int set[COVERING_FACTORS], n = 0, count = 0;
    for (int f = 0; f < c->factors; f++)
        if (f != k && row[f] != COVERING_OPEN)
            set[n++] = f;
    for (int i = 0; i < n; i++)
        for (int j = c->strength == 2 ? i : i + 1; j < (c->strength == 2 ? i + 1 : n); j++) {
            int f = set[i], g = set[j], h = k;
            if (c->strength == 2) {
                f = set[i] < k ? set[i] : k;
                g = set[i] < k ? k : set[i];
            } else if (k < f) {
                h = g, g = f, f = k;
            } else if (k < g) {
                h = g, g = k;
            }
            unsigned char *place = covering_place(c, row, f, g, h);
            count += !*place;
            *place |= (unsigned char)mark;
        }
    return count;
}

/* The value of factor k that covers most; COVERING_OPEN: all are forbidden. */
static inline int covering_best(covering *c, int *row, int k)
{
    int best = COVERING_OPEN, most = -1, equal = 1;
    for (int v = 0; v < c->levels[k]; v++) {
        row[k] = v;
        if (c->rare(k, v) || c->forbidden(row))
            continue;
        const int count = covering_count(c, row, k, 0);
        equal = count == most ? equal + 1 : 1;
        if (count > most || (count == most && covering_random(c, equal) == 0))
            best = v, most = count > most ? count : most;
    }
    row[k] = best;
    return best;
}

/* Sets the open factors of row in random order; the number of tuples it covers anew, or
 * -1 where the forbidden ones leave nothing. */
static inline int covering_complete(covering *c, int *row)
{
    int order[COVERING_FACTORS], n = 0, fresh = 0;
    for (int f = 0; f < c->factors; f++)
        if (row[f] == COVERING_OPEN)
            order[n++] = f;
    for (int i = n - 1; i > 0; i--) {
        const int j = covering_random(c, i + 1), f = order[i];
        order[i] = order[j];
        order[j] = f;
    }
    for (int i = 0; i < n; i++) {
        if (covering_best(c, row, order[i]) == COVERING_OPEN)
            return -1;
        fresh += covering_count(c, row, order[i], 0);
    }
    return fresh;
}

/* The best of some completions of `seed`; 0: none is allowed. */
static inline int covering_row(covering *c, const int *seed, int *row)
{
    enum { CANDIDATES = 16, TRIES = 160 };
    int most = -1, found = 0;
    for (int k = 0; k < TRIES && found < CANDIDATES; k++) {
        int trial[COVERING_FACTORS];
        memcpy(trial, seed, sizeof trial);
        const int fresh = covering_complete(c, trial);
        found += fresh >= 0;
        if (fresh > most) {
            most = fresh;
            memcpy(row, trial, sizeof trial);
        }
    }
    return most >= 0;
}

/* Visits every row of the array. */
static inline void covering_visit(covering *c, void (*visit)(const int *row))
{
    const int triples = c->strength == 3;
    covering_start(c);
    for (int f = 0; f < c->factors; f++)
        for (int g = f + 1; g < c->factors; g++)
            for (int h = triples ? g + 1 : g; h < (triples ? c->factors : g + 1); h++)
                for (int v = 0; v < c->levels[f] * c->levels[g] * (triples ? c->levels[h] : 1);
                     v++) {
                    int seed[COVERING_FACTORS], row[COVERING_FACTORS];
                    for (int k = 0; k < COVERING_FACTORS; k++)
                        seed[k] = COVERING_OPEN;
                    seed[f] = v % c->levels[f];
                    seed[g] = v / c->levels[f] % c->levels[g];
                    if (triples)
                        seed[h] = v / (c->levels[f] * c->levels[g]);
                    if (*covering_place(c, seed, f, g, h) || c->forbidden(seed) || c->spared(seed))
                        continue;
                    if (!covering_row(c, seed, row)) {
                        c->unreachable++;
                        continue;
                    }
                    for (int k = 0; k < c->factors; k++)
                        c->tuples += covering_count(c, row, k, 1);
                    visit(row);
                }
    free(c->covered);
}

#endif
