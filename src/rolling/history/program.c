/* The program of a history: its columns, and the case of each of its steps. */
#include "rolling/case/check.h"
#include "rolling/case/internal.h"
#include "rolling/history/history.h"
#include "rolling/history/internal.h"
#include "rolling/solve/formulation.h"
#include "rolling/results/results.h"

#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#define COLUMN(name, also, unit, is_mean)                                                          \
    {                                                                                              \
#name, also, unit, offsetof(rb_rolling_program, name), offsetof(rb_rolling_case, name),    \
            is_mean                                                                                \
    }

/* The columns of a history: name and other names, unit, the place in a program, the place in a case
 * (SIZE_MAX: none), and whether a step that rolls takes the mean over its way. */
const rb_rolling_program_column rb_rolling_program_columns[RB_ROLLING_PROGRAM_COLUMNS] = {
    {"distance", NULL, "a", offsetof(rb_rolling_program, distance), SIZE_MAX, 0},
    {"time", "t", "s", offsetof(rb_rolling_program, time), SIZE_MAX, 0},
    COLUMN(mu, "friction coefficient|coefficient of friction|cof", "-", 0),
    COLUMN(load, "normal load|normal force|P", "N/mm", 0),
    COLUMN(approach, "delta", "mm", 0),
    COLUMN(shift, NULL, "mm", 0),
    COLUMN(force, "tangential load|tangential force|Q", "N/mm", 0),
    COLUMN(force_ratio, NULL, "-", 0),
    COLUMN(creep, "creepage|xi", "-", 1),
    COLUMN(creep_ratio, NULL, "-", 1),
    COLUMN(bulk_stress, NULL, "MPa", 0),
    COLUMN(bulk_stress_b, NULL, "MPa", 0),
    COLUMN(tilt, NULL, "-", 0),
};

static const double *column_of(const rb_rolling_program *program, int c)
{
    const double *column;
    memcpy(&column, (const char *)program + rb_rolling_program_columns[c].column, sizeof column);
    return column;
}

static void replace(rb_rolling_case *rc, int c, double value)
{
    if (rb_rolling_program_columns[c].value == SIZE_MAX)
        return;
    memcpy((char *)rc + rb_rolling_program_columns[c].value, &value, sizeof value);
}

unsigned rb_rolling_program_varies(const rb_rolling_program *program)
{
    return (program->mu ? RB_VARIES_MU : 0U) | (program->bulk_stress ? RB_VARIES_BULK : 0U) |
           (program->bulk_stress_b ? RB_VARIES_BULK_B : 0U) | (program->tilt ? RB_VARIES_TILT : 0U);
}

/* ---- The case of a step ------------------------------------------------------------ */

int rb_rolling_program_at_rest(const rb_rolling_program *program)
{
    int rows = 0;
    while (rows < program->n && (!program->distance || program->distance[rows] == 0.0))
        rows++;
    return rows;
}

int rb_rolling_program_parts(const rb_rolling_program *program, const rb_rolling_case *rc, int r)
{
    /* A row of a history in time has as many steps as its time step asks; 1e-9: a quotient that is
     * whole but for rounding. */
    if (!program->time || r == 0 || !(rc->time_step > 0.0))
        return 1;
    const double steps = (program->time[r] - program->time[r - 1]) / rc->time_step;
    return (int)fmin(fmax(ceil(steps * (1.0 - 1e-9)), 1.0), RB_ROLLING_MOST_STEPS);
}

/* 1: the case is loaded tangentially at rest, or its bodies are strained. */
static int loads(const rb_rolling_case *at)
{
    if (rb_rolling_is_strained(at))
        return 1;
    if (!isnan(at->force_ratio))
        return at->force_ratio != 0.0;
    if (!isnan(at->force))
        return at->force != 0.0;
    return at->formulation == RB_STATIC && rb_rolling_wanted_shift(at) != 0.0;
}

/* The first row in parts: the bodies are pressed together without friction, and then loaded
 * tangentially, as in a case without a history. */
static void begin_from_nothing(rb_rolling_case *at, int part, int parts)
{
    const rb_rolling_derived d = rb_rolling_derive(at);
    const double shift = rb_rolling_wanted_shift(at);
    /* Half of the parts press, the other half loads. */
    const int presses = loads(at) ? parts / 2 : parts;
    const double pressed = fmin(1.0, (double)part / presses),
                 loaded = part > presses ? (double)(part - presses) / (parts - presses) : 0.0;

    rb_rolling_press_by_load(at);
    at->load = pressed * d.load;
    at->approach = pressed * d.approach;
    if (at->formulation == RB_STATIC && isnan(at->force) && isnan(at->force_ratio))
        at->shift = shift;
    at->shift *= loaded;
    at->force *= loaded;
    at->force_ratio *= loaded;
    at->bulk_stress *= loaded;
    at->bulk_stress_b *= loaded;
}

rb_rolling_case rb_rolling_program_row(const rb_rolling_program *program, const rb_rolling_case *rc,
                                       int r, int part, int parts)
{
    rb_rolling_case at = *rc;

    /* Linear between the rows; the last part has the numbers of the row to the last digit. */
    for (int c = 0; c < RB_ROLLING_PROGRAM_COLUMNS; c++) {
        const double *x = column_of(program, c);
        if (x)
            replace(&at, c,
                    part == parts || r == 0 ? x[r] : x[r - 1] + (x[r] - x[r - 1]) * part / parts);
    }
    if (r == 0 && part < parts)
        begin_from_nothing(&at, part, parts);
    return at;
}

int rb_rolling_program_steps(const rb_rolling_program *program, const rb_rolling_case *rc, int r,
                             int increments)
{
    const rb_rolling_case at = rb_rolling_program_row(program, rc, r, 1, 1);
    return r == 0 && increments > 1 && loads(&at) ? 2 * increments : increments;
}

/* The last row at or before distance x that has a row behind it; of rows at the same
 * distance, which are at rest, the last one. */
static int row_before(const rb_rolling_program *program, double x)
{
    return (int)gsl_interp_bsearch(program->distance, x, 0, (size_t)program->n - 1);
}

/* Linear between the rows; behind the last one its own. */
static double value_at(const rb_rolling_program *program, const double *column, double x)
{
    const double *d = program->distance;
    const int i = row_before(program, x);

    if (x >= d[program->n - 1])
        return column[program->n - 1];
    if (column[i] == column[i + 1]) /* to the last digit */
        return column[i];
    const double t = (x - d[i]) / (d[i + 1] - d[i]);
    return (1.0 - t) * column[i] + t * column[i + 1];
}

/* Mean between two distances, exact across the rows. */
static double mean_between(const rb_rolling_program *program, const double *column, double from,
                           double to)
{
    /* Trapezia from row to row, which are exact because a column is linear in between. */
    double sum = 0.0, x = from;

    while (x < to) {
        const double end = fmin(to, program->distance[row_before(program, x) + 1]);
        sum += 0.5 * (end - x) * (value_at(program, column, x) + value_at(program, column, end));
        x = end;
    }
    return sum / (to - from);
}

/* The case of a step that rolls from..to: creepages by their mean, because the slip is the integral
 * over the way; everything else at its end. */
rb_rolling_case rb_rolling_program_step(const rb_rolling_program *program,
                                        const rb_rolling_case *rc, double from, double to)
{
    rb_rolling_case at = *rc;

    for (int c = 0; c < RB_ROLLING_PROGRAM_COLUMNS; c++) {
        const double *column = column_of(program, c);
        if (column)
            replace(&at, c,
                    rb_rolling_program_columns[c].is_mean ? mean_between(program, column, from, to)
                                                          : value_at(program, column, to));
    }
    return at;
}

int rb_rolling_program_is_same(const rb_rolling_program *program, int a, int b)
{
    int same = 1;

    for (int c = 0; c < RB_ROLLING_PROGRAM_COLUMNS; c++) {
        const double *x = column_of(program, c);
        if (x && x != program->time)
            same &= fabs(x[a] - x[b]) <= 1e-12 * fmax(fabs(x[a]), fabs(x[b]));
    }
    return same;
}

/* A column mu replaces the coefficient of the case; its largest value sets the scales of
 * friction. */
rb_rolling_case rb_rolling_program_base(const rb_rolling_program *program,
                                        const rb_rolling_case *rc)
{
    rb_rolling_case base = *rc;

    if (program->n > 0 && program->mu)
        base.mu = 0.0;
    for (int r = 0; r < program->n && program->mu; r++)
        base.mu = fmax(base.mu, program->mu[r]);
    return base;
}

/* ---- Checks ------------------------------------------------------------------------ */

rb_status rb_rolling_program_check_base(const rb_rolling_program *program,
                                        const rb_rolling_case *rc, rb_message *why)
{
    rb_rolling_case pressed = *rc;
    const double *column = program->load ? program->load : program->approach;
    double most = 0.0;

    /* a gap with a shape of its own has no approach unless one is given, and the usual one of a
     * parabola would close a period: here a column says it */
    if ((rb_rolling_gap_has_shape(rc) || rc->period > 0.0) && isnan(rc->load) &&
        isnan(rc->approach) && column) {
        for (int r = 0; r < program->n; r++)
            most = fmax(most, column[r]);
        if (most > 0.0)
            *(program->load ? &pressed.load : &pressed.approach) = most;
    }
    return rb_rolling_case_check(&pressed, why);
}

/* A row may lift the bodies apart; what else it asks for is then checked as under a small load. */
rb_status rb_rolling_program_check_case(const rb_rolling_case *rc, rb_message *why)
{
    const int unloaded = rc->load == 0.0, lifted = isnan(rc->load) && rc->approach <= 0.0;
    rb_rolling_case touching = *rc;

    if (unloaded && rc->force != 0.0 && !isnan(rc->force))
        return rb_refuse(why, "force",
                         "without a load there is no friction; expected 0, "
                         "got %g",
                         rc->force);
    /* everything else as under some load */
    if (unloaded)
        touching.load = rb_rolling_hertz_load(rc, 1e-3 * rb_rolling_radius(rc));
    if (lifted)
        touching.approach = 1e-6 * rb_rolling_radius(rc);
    if (lifted && rc->force != 0.0 && !isnan(rc->force))
        return rb_refuse(why, "force",
                         "bodies that do not touch have no friction; expected "
                         "0, got %g",
                         rc->force);
    return rb_rolling_case_check(&touching, why);
}

rb_status rb_rolling_program_check(const rb_rolling_program *program, const rb_rolling_case *rc,
                                   rb_message *why)
{
    const rb_rolling_formulation formulation = rc->formulation;
    const double *d = program->distance;
    int touches = 0;

    if (program->n < 1)
        return rb_refuse(why, "history", "expected 1 row or more");
    if (formulation == RB_STEADY)
        return rb_refuse(why, "history", "steady rolling has none");
    if (formulation == RB_TRANSIENT && !program->distance)
        return rb_refuse(why, "history", "transient rolling needs a column distance");
    if (formulation == RB_STATIC && program->distance)
        return rb_refuse(why, "history",
                         "a column distance is for transient rolling; static "
                         "contact does not roll");
    if (program->time && formulation == RB_TRANSIENT)
        return rb_refuse(why, "history",
                         "a column time is for static contact; rolling needs a "
                         "column distance and a speed");
    if (program->time && !rb_rolling_relaxes(rc))
        return rb_refuse(why, "history",
                         "a column time is for viscoelastic bodies, see --relaxation-time");
    if (program->mu && rc->friction.law == RB_FRICTION_table)
        return rb_refuse(why, "history",
                         "a column mu cannot be combined with a table of friction over x");
    for (int c = 0; c < RB_ROLLING_PROGRAM_COLUMNS; c++)
        for (int r = 0; column_of(program, c) && r < program->n; r++)
            if (!isfinite(column_of(program, c)[r]))
                return rb_refuse_row(why, "history", r + 1, "%s is not a number",
                                     rb_rolling_program_columns[c].name);
    if (formulation == RB_STATIC && rb_rolling_relaxes(rc)) {
        const double *t = program->time;
        double steps = 0.0;

        if (!t)
            return rb_refuse(why, "history",
                             "static contact of viscoelastic bodies needs a column time");
        if (t[0] != 0.0)
            return rb_refuse_row(why, "history", 1,
                                 "expected time 0, when the bodies are pressed together, got %g",
                                 t[0]);
        for (int r = 1; r < program->n; r++) {
            if (t[r] < t[r - 1])
                return rb_refuse_row(why, "history", r + 1,
                                     "time %g is before that of the row before", t[r]);
            steps += rb_rolling_program_parts(program, rc, r);
        }
        if (!(steps <= RB_ROLLING_MOST_STEPS))
            return rb_refuse(why, "time-step", "%g s makes %.3g steps; expected at most %g",
                             rc->time_step, steps, (double)RB_ROLLING_MOST_STEPS);
    }
    if (d && d[0] != 0.0)
        return rb_refuse_row(why, "history", 1,
                             "expected distance 0, where the contact starts from rest, got %g",
                             d[0]);
    for (int r = 1; r < program->n && d; r++) {
        if (d[r] < d[r - 1])
            return rb_refuse_row(why, "history", r + 1,
                                 "distance %g is less than in the row before", d[r]);
        if (d[r] > 0.0 && d[r] == d[r - 1])
            return rb_refuse_row(why, "history", r + 1,
                                 "distance %g twice; a jump needs two rows a little apart", d[r]);
    }
    for (int r = 0; r < program->n; r++) {
        const rb_rolling_case at = rb_rolling_program_row(program, rc, r, 1, 1);
        rb_message reason = {.text = ""};
        rb_status s = rb_rolling_program_check_case(&at, &reason);
        if (at.load < 0.0)
            s = rb_refuse(&reason, "load", "expected a number >= 0, got %g", at.load);
        if (s != RB_OK)
            return s == RB_EINVAL ? rb_refuse_row(why, "history", r + 1, "%s", reason.text)
                                  : rb_fail(why, s, "history: row %d: %.200s", r + 1, reason.text);
        touches |= !(at.load == 0.0 || (isnan(at.load) && at.approach <= 0.0));
    }
    if (!touches)
        return rb_refuse(why, "history", "no row presses the bodies together");
    return RB_OK;
}

/* ---- The case's own program -------------------------------------------------------- */

rb_status rb_rolling_program_of_case(const rb_rolling_case *rc, rb_arena *memory,
                                     rb_rolling_program *program)
{
    /* A case without a table is a history, too: count increments that press, count that load, and
     * of a transient one row to the end of its distance. */
    const int rolls = rc->formulation == RB_TRANSIENT;
    const int count = rc->increments > 1 ? rc->increments : 1;
    const rb_rolling_derived d = rb_rolling_derive(rc);
    const double most = isnan(d.load) ? d.approach : d.load;
    const size_t rows = 2 * (size_t)count + 1; /* at most */
    double *distance = rb_arena_doubles(memory, rows, 1),
           *normal = rb_arena_doubles(memory, rows, 1),
           *loading = rb_arena_doubles(memory, rows, 1), *bulk = rb_arena_doubles(memory, rows, 2),
           last;

    if (memory->failed)
        return RB_ENOMEM;
    *program = (rb_rolling_program){.distance = rolls ? distance : NULL};
    *(isnan(d.load) ? &program->approach : &program->load) = normal;
    /* The tangential control that loads the contact at rest: its column and last value. A
     * transient that is driven by its creepage starts without a force. */
    if (!isnan(rc->force_ratio)) {
        program->force_ratio = loading;
        last = rc->force_ratio;
    } else {
        if (!isnan(rc->force) || rc->formulation == RB_TRANSIENT) {
            program->force = isnan(rc->force) ? NULL : loading;
            last = isnan(rc->force) ? 0.0 : rc->force;
        } else {
            program->shift = loading;
            last = rb_rolling_wanted_shift(rc);
        }
    }
    const int is_strained = rb_rolling_is_strained(rc),
              loaded = (last != 0.0 || is_strained) && count > 1;
    if (is_strained) { /* in phase with the force or shift */
        program->bulk_stress = bulk;
        program->bulk_stress_b = bulk + rows;
    }
    program->n = count + (loaded ? count : 0) + rolls;
    /* part: of the tangential loading, 0 while the bodies are being pressed together. */
    for (int r = 0; r < program->n; r++) {
        normal[r] = r < count ? most * (r + 1) / count : most;
        const double part = !loaded || r >= 2 * count ? 1.0
                            : r < count               ? 0.0
                                                      : (double)(r + 1 - count) / count;
        loading[r] = !loaded || r >= 2 * count ? last
                     : r < count               ? 0.0
                                               : last * (r + 1 - count) / count;
        bulk[r] = part * rc->bulk_stress;
        bulk[(size_t)r + rows] = part * rc->bulk_stress_b;
    }
    if (rolls)
        distance[program->n - 1] = rc->distance;
    return RB_OK;
}
