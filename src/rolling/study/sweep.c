/* Parameter studies: cases are distributed one by one to a pool of processes, and rows
 * are passed on in order. */
#include "rolling/study/study.h"

#include <stdlib.h>

/* Rows that may wait for an earlier case: what a study of any length needs of memory. */
enum { WINDOW = 1 << 14 };

rb_status rb_rolling_sweep_by(const rb_rolling_sweep *sweep, rb_rolling_pool *pool, rb_message *why)
{
    /* given: cases handed out, finished: their rows too; given - finished <= window */
    const int window = sweep->count < WINDOW ? sweep->count : WINDOW;
    /* of the k-th case at k modulo window */
    rb_rolling_row *row = calloc((size_t)window + 1, sizeof *row), next;
    char *arrived = calloc((size_t)window + 1, sizeof *arrived);
    int given = 0, finished = 0;
    rb_status s = row && arrived
                      ? RB_OK
                      : rb_fail(why, RB_ENOMEM, "sweep: out of memory for %d rows", window);

    while (s == RB_OK && finished < sweep->count) {
        int number;
        for (int idle = pool->idle(pool);
             s == RB_OK && idle > 0 && given < sweep->count && given - finished < window; idle--)
            s = pool->submit(pool, sweep->first + given++);
        const int collected = s == RB_OK ? pool->collect(pool, 5, &number, &next) : 0;
        if (collected > 0) {
            row[(number - sweep->first) % window] = next;
            arrived[(number - sweep->first) % window] = 1;
        }
        s = collected < 0 ? (rb_status)collected : s;
        /* Hands on the rows that are next in order. */
        while (s == RB_OK && finished < given && arrived[finished % window]) {
            const int k = finished++;
            arrived[k % window] = 0;
            if (sweep->see(sweep->first + k, &row[k % window], sweep->context))
                s = RB_INTERRUPTED;
        }
        if (s == RB_OK && sweep->tick && sweep->tick(finished, sweep->context))
            s = RB_INTERRUPTED;
        if (s == RB_INTERRUPTED)
            rb_fail(why, s, "interrupted after case %d", sweep->first + finished);
        else if (s != RB_OK)
            rb_fail(why, s, "sweep: cannot replace a lost process");
    }
    pool->stop(pool);
    free(arrived);
    free(row);
    return s;
}

rb_status rb_rolling_sweep_run(const rb_rolling_sweep *sweep, rb_message *why)
{
    rb_rolling_pool *pool;
    const rb_status s = rb_rolling_pool_start(sweep, &pool, why);

    return s == RB_OK ? rb_rolling_sweep_by(sweep, pool, why) : s;
}
