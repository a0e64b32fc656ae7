/* The options of a case as one table: name, section, unit, range, choices, place,
 * default, help.  The functions of case.h set a case by name from it; a case that is
 * filled in without them is checked by its ranges (rb_rolling_case_check). */
#ifndef ROLLBEM_OPTIONS_H
#define ROLLBEM_OPTIONS_H

#include "rollbem/base.h"
#include "rollbem/rolling.h"

#include <math.h>
#include <stddef.h>

RB_PUBLIC_BEGIN

/* ---- Options --------------------------------------------------------------------- */

typedef enum {
    RB_OPTION_GROUP,   /* no option: a heading; name is the section, help the title */
    RB_OPTION_NUMBER,  /* double */
    RB_OPTION_INTEGER, /* int */
    RB_OPTION_CHOICE,  /* int (an enum) */
    RB_OPTION_FLAG,    /* int: yes or no */
    RB_OPTION_TEXT     /* const char * */
} rb_option_kind;

typedef struct {
    double from, to;
    int from_open, to_open; /* 1: the end itself is not allowed */
} rb_range;

/* Numbers separated by commas: as many as a body has relaxation times. */
enum { RB_NUMBERS_MAX = RB_ROLLING_TERMS };

typedef struct {
    int n;
    double value[RB_NUMBERS_MAX];
} rb_numbers;

/* How the program uses the file that an option names. */
typedef enum {
    RB_FILE_NONE, /* the option names no file */
    RB_FILE_READ,
    RB_FILE_WRITTEN,
    RB_FILE_PICTURE, /* written; the ending of the name gives the format */
    RB_FILE_FOLDER   /* a folder into which files are written */
} rb_option_file;

/* One option: its name, its allowed values, and the place of its value in the struct that
 * the table describes. */
typedef struct {
    const char *name; /* --name, and the key in a case file */
    rb_option_kind kind;
    size_t offset;    /* of the value in the set's target */
    const char *unit; /* "mm"; "" for none; for a text its placeholder in the help */
    rb_range range;   /* numbers and integers; texts: of a count in them */
    const char *word; /* numbers: a word that is allowed instead of a number and means
                         word_value, or NULL */
    double word_value;
    size_t list; /* numbers: if not 0, several numbers separated by commas are allowed; all
                    are stored at this offset (rb_numbers), and the first is the value */
    const rb_choice *choices; /* an entry with name NULL ends the list */
    size_t path;              /* choices: if not 0, any other word is a name; it is stored at this
                                 offset (const char *), and the value is path_value */
    int path_value;
    const char *path_name; /* placeholder of this name in the help: FILE, NAME */
    rb_option_file file;   /* texts, and choices with another word */
    unsigned excludes;     /* bit mask; of options with a common bit only one may be given */
    int frozen;     /* numbers: 1: a number of the mesh, the steps or the solver; there are no
                       derivatives with respect to it */
    int modulus;    /* numbers: 1: Young's modulus, also given as a hardness, 60ShoreA */
    size_t lengths; /* numbers in another unit than one of length, as half-widths are: if
                       not 0, a length with a unit may be given as well; it is stored in
                       mm, and sets length_bit of the int at this offset */
    int length_bit;
    const char *alone;    /* texts: value if the option is given without one, that is, if the
                             next argument is an option, a file, or has a dot or slash; NULL:
                             a value is required */
    size_t into;          /* number of a case: its place in rb_rolling_case if this is not
                             `offset`; 0: it is */
    size_t of_a;          /* number of body B: place in rb_rolling_case of A's value, which it has
                             if none is given; 0: none */
    int if_similar;       /* 1: only with the option `similar` */
    const char *unset;    /* help: text shown as the default; NULL: the value itself */
    const char *one_only; /* reason in the error message for several numbers; NULL: the
                             general message */
    int common;           /* 1: shown at the beginning of --help */
    const char *help;
} rb_option;

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
    int error;                               /* 1: estimate discretisation errors */
    double accuracy; /* refine until the errors are below this; 0: no refinement */
    rb_units units;  /* units of arguments without a unit and of printed results; a case file
                        names its own units.  The values in this struct are in mm, N, MPa */
} rb_resolved_case;

RB_PUBLIC_END

#endif
