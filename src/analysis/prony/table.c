/* Measured moduli from a table. */
#include "analysis/prony/prony.h"
#include "base/io/io.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_math.h>

enum { FREQUENCY, OMEGA, OMEGA_TOO, STORAGE, LOSS, TANGENT, COLUMNS };

#define OPTIONAL RB_IO_COLUMN_OPTIONAL
static const rb_io_column known[COLUMNS] = {
    [FREQUENCY] = {"frequency", "freq|f|frequenz", "Hz", OPTIONAL},
    [OMEGA] = {"omega", "angular frequency|circular frequency|ang frequency|w|kreisfrequenz",
               "rad/s", OPTIONAL},
    [OMEGA_TOO] = {"frequency", "freq|f|frequenz", "rad/s", OPTIONAL},
    [STORAGE] = {"storage_modulus", "storage|E'|E storage|speichermodul", "MPa",
                 RB_IO_COLUMN_NEEDED},
    [LOSS] = {"loss_modulus", "E''|E loss|verlustmodul", "MPa", OPTIONAL},
    [TANGENT] = {"tan_delta", "tan d|tan δ|loss factor|damping factor|verlustfaktor", "-",
                 OPTIONAL}};

/* A factor of 2 pi is never guessed. */
static rb_status check_headings(const char *path, const rb_io_table *t, rb_message *why)
{
    for (int j = 0; t->name && j < t->columns; j++) {
        const char *heading = t->name[j];
        for (int k = FREQUENCY; k <= OMEGA_TOO; k++) {
            const rb_io_table one = {.columns = 1, .name = &t->name[j]};
            if (rb_io_table_has(&one, &known[k]) && !strstr(heading, "Hz") &&
                !strstr(heading, "hertz") && !strstr(heading, "Hertz") && !strstr(heading, "rad"))
                return rb_fail(why, RB_EFORMAT,
                               "%s: column '%.60s': expected its unit, Hz or rad/s, as "
                               "frequency_Hz or omega_rad/s",
                               path, heading);
        }
    }
    if (!t->name)
        return rb_fail(why, RB_EFORMAT,
                       "%s: expected names of the columns: frequency_Hz or omega_rad/s, "
                       "storage_modulus, and tan_delta or loss_modulus",
                       path);
    return RB_OK;
}

static rb_status check_rows(const char *path, const rb_io_table *t, const rb_prony_data *d,
                            const char *loss, rb_message *why)
{
    for (int i = 0; i < d->n; i++) {
        const struct {
            const char *name;
            double x;
            int positive;
        } number[] = {{"frequency", d->omega[i], 1},
                      {"storage_modulus", d->storage[i], 1},
                      {loss, d->loss[i], 0}};
        for (size_t k = 0; k < sizeof number / sizeof *number; k++)
            if (!isfinite(number[k].x) || number[k].x < 0.0 ||
                (number[k].positive && number[k].x == 0.0))
                return rb_fail(why, RB_EFORMAT, "%s:%d: %s: expected a number %s 0, got %g", path,
                               t->line[i], number[k].name,
                               number[k].positive ? ">" : ">=", number[k].x);
    }
    return d->n >= 3
               ? RB_OK
               : rb_fail(why, RB_EFORMAT, "%s: expected 3 frequencies or more, got %d", path, d->n);
}

static rb_status assign(const char *path, rb_units units, rb_io_table *t, rb_prony_data *d,
                        rb_message *why)
{
    const double *x[COLUMNS];
    rb_status s = check_headings(path, t, why);
    if (s == RB_OK)
        s = rb_io_table_assign(path, t, COLUMNS, known, units, x, why);
    if (s != RB_OK)
        return s;
    const int frequencies = !!x[FREQUENCY] + !!x[OMEGA] + !!x[OMEGA_TOO];
    if (frequencies != 1)
        return rb_fail(why, RB_EFORMAT,
                       "%s: expected one column of frequencies, frequency_Hz or omega_rad/s, "
                       "got %d",
                       path, frequencies);
    if (!x[LOSS] == !x[TANGENT])
        return rb_fail(why, RB_EFORMAT, "%s: expected one of tan_delta and loss_modulus, got %s",
                       path, x[LOSS] ? "both" : "neither");
    const double *omega = x[OMEGA] ? x[OMEGA] : x[OMEGA_TOO] ? x[OMEGA_TOO] : x[FREQUENCY];
    const double *loss = x[LOSS] ? x[LOSS] : x[TANGENT];
    double *to_omega = t->x + (omega - t->x), *to_loss = t->x + (loss - t->x);
    *d = (rb_prony_data){t->rows, omega, x[STORAGE], loss};
    s = check_rows(path, t, d, x[LOSS] ? "loss_modulus" : "tan_delta", why);
    for (int i = 0; i < d->n && s == RB_OK; i++) {
        if (x[FREQUENCY])
            to_omega[i] *= 2.0 * M_PI;
        if (x[TANGENT])
            to_loss[i] *= x[STORAGE][i];
    }
    return s;
}

rb_status rb_prony_read(const char *path, rb_units units, rb_io_table *t, rb_prony_data *d,
                        rb_message *why)
{
    rb_status s = rb_io_table_read(path, t, why);
    if (s == RB_OK)
        s = assign(path, units, t, d, why);
    if (s != RB_OK)
        rb_io_table_free(t);
    return s;
}
