/* Which columns of the tableau are brought up to date, and when. */
#include "lcp/lemke.h"

#include <math.h>

/* A column that fewer pivots have passed by is formed on the spot.  Where it is farther
 * behind than FAR, the way is long enough for the largest company. */
enum { PATIENCE = 20, FAR = 64 };

/* The columns that come along, by the ratios of the rows of their complements. */
typedef struct {
    int count, room;
    int *column;
    double *ratio;
} company;

static void admit(company *k, int column, double ratio)
{
    if (k->count == k->room && ratio >= k->ratio[k->count - 1])
        return;
    int j = k->count < k->room ? k->count++ : k->room - 1;
    for (; j > 0 && k->ratio[j - 1] > ratio; j--) {
        k->ratio[j] = k->ratio[j - 1];
        k->column[j] = k->column[j - 1];
    }
    k->ratio[j] = ratio;
    k->column[j] = column;
}

/* Who is wanted next: when a basic variable leaves, its complement enters, and the rows
 * with the least ratios are the next to leave.  The last driving column still stands in
 * l->a; that its step has been taken changes all ratios alike. */
static void choose(const lemke *l, int wanted, company *k)
{
    const double *a = l->a, *q = l->t.q;
    admit(k, wanted, -1.0);
    for (int i = 0; i < l->n; i++) {
        if (a[i] >= 0.0 || l->t.basis[i] == 2 * l->n)
            continue;
        const int place = l->t.place[rb_lcp_complement(l->n, l->t.basis[i])];
        if (place < 0 && -1 - place != wanted)
            admit(k, -1 - place, fmax(q[i], 0.0) / -a[i]);
    }
}

void rb_lcp_lemke_prepare(lemke *l, int column)
{
    lcp_tableau *t = &l->t;
    const int behind = rb_lcp_tableau_behind(t, column);
    if (behind <= PATIENCE)
        return;
    const int room = behind > FAR || t->group < PATIENCE ? t->group : PATIENCE;
    company k = {0, room, l->near, l->other};
    choose(l, column, &k);
    rb_lcp_tableau_advance(t, k.count, k.column);
}

void rb_lcp_lemke_prepare_alone(lemke *l, int column)
{
    if (rb_lcp_tableau_behind(&l->t, column) > PATIENCE)
        rb_lcp_tableau_advance(&l->t, 1, &column);
}
