/* The table of options: name, section, unit, range, choices, place, default, help.  The functions
 * of rollbem/case.h set a case by name from it; a case that is filled in without them is checked by
 * its ranges (rb_rolling_case_check). */
#ifndef ROLLBEM_SRC_ROLLING_CASE_OPTIONS_H
#define ROLLBEM_SRC_ROLLING_CASE_OPTIONS_H

#include "rolling/history/history.h"
#include "rollbem/case.h"

#include <math.h>
#include <stddef.h>

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

/* An option table, which begins with a heading, and the struct that holds its values. */
typedef struct {
    const rb_option *options;
    int n;
    void *target;
    int *given; /* n: source of each value, see below; NULL: not recorded */
    int *plain; /* n: 1 if the value is a number that was given without a unit,
                   RB_GIVEN_HARDNESS; NULL: not recorded */
} rb_option_set;

/* In `plain`: the value is the modulus of a hardness, in MPa. */
enum { RB_GIVEN_HARDNESS = 2 };

/* Macros for the ranges and rows of an option table: */
#define RB_ANY                                                                                     \
    {                                                                                              \
        -INFINITY, INFINITY, 1, 1                                                                  \
    }
#define RB_ABOVE(x)                                                                                \
    {                                                                                              \
        x, INFINITY, 1, 1                                                                          \
    }
#define RB_FROM(x)                                                                                 \
    {                                                                                              \
        x, INFINITY, 0, 1                                                                          \
    }
#define RB_BETWEEN(x, y)                                                                           \
    {                                                                                              \
        x, y, 1, 1                                                                                 \
    } /* (x, y) */
#define RB_FROM_TO(x, y)                                                                           \
    {                                                                                              \
        x, y, 0, 0                                                                                 \
    } /* [x, y] */
#define RB_ABOVE_UPTO(x, y)                                                                        \
    {                                                                                              \
        x, y, 1, 0                                                                                 \
    } /* (x, y] */

#define RB_GROUP_LINE(section, title)                                                              \
    {                                                                                              \
        .name = section, .kind = RB_OPTION_GROUP, .help = title                                    \
    }
#define RB_NUMBER_LINE(name_, place, unit_, range_, ...)                                           \
    {                                                                                              \
        .name = name_, .kind = RB_OPTION_NUMBER, .offset = place, .unit = unit_, .range = range_,  \
        .help = __VA_ARGS__                                                                        \
    }
#define RB_INTEGER_LINE(name_, place, range_, ...)                                                 \
    {                                                                                              \
        .name = name_, .kind = RB_OPTION_INTEGER, .offset = place, .unit = "", .range = range_,    \
        .help = __VA_ARGS__                                                                        \
    }
#define RB_CHOICE_LINE(name_, place, choices_, ...)                                                \
    {                                                                                              \
        .name = name_, .kind = RB_OPTION_CHOICE, .offset = place, .unit = "", .choices = choices_, \
        .help = __VA_ARGS__                                                                        \
    }
#define RB_FLAG_LINE(name_, place, ...)                                                            \
    {                                                                                              \
        .name = name_, .kind = RB_OPTION_FLAG, .offset = place, .unit = "", .help = __VA_ARGS__    \
    }
#define RB_TEXT_LINE(name_, place, metavar, ...)                                                   \
    {                                                                                              \
        .name = name_, .kind = RB_OPTION_TEXT, .offset = place, .unit = metavar,                   \
        .help = __VA_ARGS__                                                                        \
    }

/* The numbers of wear, members of a struct like rb_rolling_wear; the sliding distance and
 * the cycles are two of it, or `way` both times.  The command line and the library have
 * their ranges from here. */
#define RB_WEAR_LINES(PLACE, SLIDE, CYCLES)                                                        \
    RB_NUMBER_LINE("wear-coefficient", PLACE(coefficient), "1/MPa", RB_ABOVE(0),                   \
                   "K: worn volume per load and sliding distance, or per work, mm3/(N mm)",        \
                   .unset = "none: it must be given"),                                             \
        RB_NUMBER_LINE("wear-share", PLACE(share), "-", RB_FROM_TO(0, 1),                          \
                       "fraction of K that wears B: in the contact (fretting), along its "         \
                       "track (A slides) or at its radius (rolling)"),                             \
        RB_NUMBER_LINE("slide", PLACE(SLIDE), "mm", RB_ABOVE(0),                                   \
                       "static: total distance by which A slides over B, towards +x",              \
                       .unset = "A frets, or rolls"),                                              \
        RB_NUMBER_LINE("cycles", PLACE(CYCLES), "-", RB_ABOVE(0),                                  \
                       "static: fretting cycles between the shift or force and its opposite; "     \
                       "steady: turns of the wheel"),                                              \
        RB_INTEGER_LINE("wear-steps", PLACE(steps), RB_FROM_TO(1, 1000000),                        \
                        "number of steps; each is implicit and stable for any length"),            \
        RB_INTEGER_LINE("quarter", PLACE(increments), RB_FROM_TO(1, 100000),                       \
                        "number of increments per quarter of a fretting cycle")

/* Numbers of a fit and of a design, which the command line and the library refuse alike. */
#define RB_FIT_SIGMA_LINE(place)                                                                   \
    RB_NUMBER_LINE("sigma", place, "-", RB_ABOVE(0),                                               \
                   "standard deviation of the measured forces, in their units; a column "          \
                   "sigma gives one for each",                                                     \
                   .unset = "from the residuals")
#define RB_FIT_LEVEL_LINE(place)                                                                   \
    RB_NUMBER_LINE("level", place, "-", RB_BETWEEN(0, 1), "of the intervals (Student's)")
#define RB_DESIGN_SPAN_LINE(place)                                                                 \
    RB_NUMBER_LINE("span", place, "mm", RB_ABOVE(0),                                               \
                   "half-width of the span of pressure_ripple, about x = 0",                       \
                   .unset = "all elements")
#define RB_DESIGN_EVALUATIONS_LINE(place)                                                          \
    RB_INTEGER_LINE("evaluations", place, RB_FROM_TO(1, 100000), "solved cases at most")

/* Describes the allowed values of an option: "a number >= 0", "lemke, newton or auto".
 * Returns text. */
const char *rb_option_expected(const rb_option *option, char *text, size_t size);

/* 1: the value of the option in this target is a length in mm (`lengths` above). */
int rb_option_is_length(const rb_option *option, const void *target);

/* 1: the number is in the range of the option. */
int rb_option_in_range(const rb_option *option, double value);
/* RB_EINVAL where it is not: "young: expected a number > 0, got -1". */
rb_status rb_rolling_check_option(const rb_option *option, double value, rb_message *why);

/* ---- The options of a case ------------------------------------------------------- */

/* Numbers separated by commas: as many as a body has relaxation times. */
enum { RB_NUMBERS_MAX = RB_ROLLING_TERMS };

typedef struct {
    int n;
    double value[RB_NUMBERS_MAX];
} rb_numbers;

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
struct rb_resolved_case {
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
};

/* Options with a common bit exclude each other. */
enum {
    RB_ONE_NORMAL = 1,
    RB_ONE_CREEPAGE = 2,
    RB_ONE_LOADING = 4,
    RB_ONE_YOUNG_B = 8,
    RB_ONE_POISSON_B = 16,
    RB_ONE_FRICTION = 32,
    RB_ONE_TILT = 64
};

enum { RB_CASE_OPTIONS_MAX = 128 };

/* All options and headings of a case, in the order of the help; their offsets refer to
 * rb_resolved_case. */
extern const rb_option rb_case_table[];
extern const int rb_case_table_n;
/* Of --units. */
extern const rb_choice rb_case_systems[];

/* 1: the body is of a kind that has this option of a body: base-young of a layer. */
int rb_option_applies(const rb_option *option, const rb_rolling_body *body);

#endif
