/* Prony series of the creep compliance from measured moduli, 1/(E' + i E'') = J_g (1 + sum f_k/(1 +
 * i w tau_k)): with given tau_k it is linear in J_g and J_g f_k, which are >= 0. */
#ifndef ROLLBEM_SRC_ANALYSIS_PRONY_PRONY_H
#define ROLLBEM_SRC_ANALYSIS_PRONY_PRONY_H

#include "base/base.h"
#include "base/io/io.h"

/* Measured at one temperature; borrowed. */
typedef struct {
    int n;
    const double *omega;   /* n: angular frequency > 0 [rad/s] */
    const double *storage; /* n: E' > 0 [MPa] */
    const double *loss;    /* n: E'' >= 0 [MPa] */
} rb_prony_data;

enum { RB_PRONY_MOST = 200 };

/* Deviations are those of the complex compliance, over its measured absolute value. */
typedef struct {
    double young; /* E_g, the modulus of the fastest loads [MPa] */
    int terms;
    double time[RB_PRONY_MOST]; /* tau_k [s], rising */
    double ratio[RB_PRONY_MOST];
    int place[RB_PRONY_MOST]; /* of tau_k among the equally spaced ones; -2: of two that are joined
                               */
    double rms, largest;
    int worst;         /* the point of the largest deviation */
    double per_decade; /* spacing of the times from which the terms were chosen */
    int joined;        /* pairs of neighbours that became one term */
    int limited;       /* 1: wider spaced than asked for, by the limit of terms */
} rb_prony_series;

/* Times from 10^-0.5 over the largest frequency to 10^0.5 over the least one, so many per decade;
 * least squares by the linear complementarity problem of their normal equations.  RB_EINVAL: a
 * number out of range, or more than RB_PRONY_MOST times; RB_ENOMEM; those of rb_lcp_lemke. */
rb_status rb_prony_fit(const rb_prony_data *d, double per_decade, rb_prony_series *s,
                       rb_message *why);
/* Two neighbouring terms that stand alone are one that lies between the times: they become one, at
 * the mean of log tau by f, where that makes the rms less.  Three and more are a continuous
 * spectrum, and stay. */
rb_status rb_prony_join(const rb_prony_data *d, rb_prony_series *s, rb_message *why);
/* Both, of at most `most` terms: wider spaced where there are more.  per_decade 0: 2, doubled up to
 * 8 as long as the rms becomes less by a third. */
rb_status rb_prony_solve(const rb_prony_data *d, double per_decade, int most, rb_prony_series *s,
                         rb_message *why);

/* E' and E'' of a series [MPa]. */
void rb_prony_moduli(const rb_prony_series *s, double omega, double *storage, double *loss);
/* The modulus of the slowest loads, E_g/(1 + sum f_k) [MPa]. */
double rb_prony_slow(const rb_prony_series *s);

/* Reads a table with the columns frequency_Hz or omega_rad/s, storage_modulus, and tan_delta or
 * loss_modulus; d points into t, which the caller frees.  RB_EFORMAT, RB_ENOENT, RB_ENOMEM. */
rb_status rb_prony_read(const char *path, rb_units units, rb_io_table *t, rb_prony_data *d,
                        rb_message *why);

#endif
