/* Parameter studies: cases are distributed one by one to a pool of processes, and rows
 * are passed on in order. */
#include "study/internal.h"

#include <stdlib.h>

/* Rows that may wait for an earlier case: what a study of any length needs of memory. */
enum { WINDOW = 1 << 14 };

typedef struct {
    const rb_rolling_sweep *sweep;
    rb_rolling_pool *pool;
    int given, seen; /* cases handed out, rows seen; given - seen <= window */
    int window;
    rb_rolling_row *row; /* window: row of the k-th case at k modulo window */
    char *came;          /* window */
} study_state;

static rb_status collect(study_state *r)
{
    rb_rolling_row row;
    int k;
    const int came = r->pool->collect(r->pool, 5, &k, &row);

    if (came <= 0)
        return (rb_status)came;
    const int place = (k - r->sweep->first) % r->window;
    r->row[place] = row;
    r->came[place] = 1;
    return RB_OK;
}

/* Hands on the rows that are next in order. */
static rb_status see_finished(study_state *r)
{
    const rb_rolling_sweep *sweep = r->sweep;

    while (r->seen < r->given && r->came[r->seen % r->window]) {
        const int k = r->seen++, place = k % r->window;
        r->came[place] = 0;
        if (sweep->see(sweep->first + k, &r->row[place], sweep->context))
            return RB_INTERRUPTED;
    }
    if (sweep->tick && sweep->tick(r->seen, sweep->context))
        return RB_INTERRUPTED;
    return RB_OK;
}

static rb_status supervise(study_state *r, rb_message *why)
{
    rb_status s = RB_OK;

    while (s == RB_OK && r->seen < r->sweep->count) {
        const rb_rolling_sweep *sweep = r->sweep;

        for (int idle = r->pool->idle(r->pool);
             s == RB_OK && idle > 0 && r->given < sweep->count && r->given - r->seen < r->window;
             idle--)
            s = r->pool->submit(r->pool, sweep->first + r->given++);
        if (s == RB_OK)
            s = collect(r);
        if (s == RB_OK)
            s = see_finished(r);
    }
    if (s == RB_INTERRUPTED)
        return rb_fail(why, s, "interrupted after case %d", r->sweep->first + r->seen);
    return s == RB_OK ? s : rb_fail(why, s, "sweep: cannot replace a lost process");
}

rb_status rb_rolling_sweep_by(const rb_rolling_sweep *sweep, rb_rolling_pool *pool, rb_message *why)
{
    study_state r = {.sweep = sweep, .pool = pool};

    r.window = sweep->count < WINDOW ? sweep->count : WINDOW;
    r.row = calloc((size_t)r.window + 1, sizeof *r.row);
    r.came = calloc((size_t)r.window + 1, sizeof *r.came);
    const rb_status s = r.row && r.came
                            ? supervise(&r, why)
                            : rb_fail(why, RB_ENOMEM, "sweep: out of memory for %d rows", r.window);
    pool->stop(pool);
    free(r.came);
    free(r.row);
    return s;
}

rb_status rb_rolling_sweep_run(const rb_rolling_sweep *sweep, rb_message *why)
{
    rb_rolling_pool *pool;
    const rb_status s = rb_rolling_pool_start(sweep, &pool, why);

    return s == RB_OK ? rb_rolling_sweep_by(sweep, pool, why) : s;
}
