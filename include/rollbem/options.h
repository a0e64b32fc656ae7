/* The values of a case whose options are set by name (case.h). */
#ifndef ROLLBEM_OPTIONS_H
#define ROLLBEM_OPTIONS_H

#include "rollbem/base.h"
#include "rollbem/rolling.h"

RB_PUBLIC_BEGIN

/* Numbers separated by commas: as many as a body has relaxation times. */
enum { RB_NUMBERS_MAX = RB_ROLLING_TERMS };

typedef struct {
    int n;
    double value[RB_NUMBERS_MAX];
} rb_numbers;

/* ---- The options of a case ------------------------------------------------------- */

/* Viscoelasticity as given by the user: the first number of each list, and the whole
 * list. */
typedef struct {
    double time, ratio;
    rb_numbers times, ratios;
} rb_case_memory;

/* Parameters of friction laws as given by the user: the first number of each list, and
 * the whole list. */
typedef struct {
    double fall, slip_scale, memory, heat;
    rb_numbers falls, slip_scales, memories, heats;
} rb_case_law;

/* The values of a case after rb_case_resolve. */
typedef struct {
    rb_rolling_case rc;
    rb_rolling_derived derived; /* what follows from rc */
    const char *gap_file;       /* profile of the initial gap, or NULL */
    double gap_smoothing;       /* standard deviation of its noise [length] */
    int similar;                /* B has A's material, layer, cover and viscoelasticity */
    double young_b, poisson_b, radius_b;
    double conductivity_b, heat_capacity_b, temperature_b;
    rb_case_memory memory_a, memory_b;
    rb_numbers mus;            /* all values of mu; more than one only for curves */
    const char *friction_file; /* table of the friction law, or NULL */
    rb_case_law law;
    const char *layers_file, *layers_file_b; /* stacks of layers, or NULL */
    const char *irregularity_file;           /* or NULL */
    const char *worn_file;                   /* or NULL */
    const char *history_file;                /* or NULL */
    rb_rolling_program program;              /* the history of that file; n = 0: none */
    double cycle; /* the first of its rows that --cycle names, and both */
    rb_numbers cycles;
    int error;       /* 1: estimate discretisation errors */
    double accuracy; /* refine until the errors are below this; 0: no refinement */
    rb_units units;  /* units of arguments without a unit and of printed results; a case file
                        names its own units.  The values in this struct are in mm, N, MPa */
} rb_resolved_case;

RB_PUBLIC_END

#endif
