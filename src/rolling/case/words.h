/* Declarations shared by the files of src/rolling/case. */
#ifndef ROLLBEM_CASE_INTERNAL_H
#define ROLLBEM_CASE_INTERNAL_H

#include "rolling/case/case.h"
#include "base/io/io.h"

/* A table read from a file that an option names. */
typedef struct {
    rb_io_table table;
    const char *path;    /* file from which it was read; NULL: not read yet */
    rb_units units;      /* units in which it was read */
    int borrowed;        /* 1: owned by the case of which this one is a copy */
    const double *x, *y; /* the columns of a table over x; those of a history in program */
    rb_bem_stack *stack; /* those of layers; owned as the table is */
    rb_rolling_program program;
} case_table;

/* The gap computed from a table; kept as long as table, noise and mesh are the same. */
typedef struct {
    rb_rolling_profile *curve;
    double noise;
    int is_punch, borrowed;
} case_profile;

/* The tables that a case may name. */
enum {
    CASE_HISTORY,
    CASE_GAP,
    CASE_IRREGULARITY,
    CASE_WORN,
    CASE_FRICTION,
    CASE_LAYERS,
    CASE_LAYERS_B,
    CASE_TABLES
};

enum { CASE_CRACK_OPTIONS_MAX = 40 };

/* The crack of a case, as given and as used. */
typedef struct {
    int is_taken; /* 1: the case takes its options */
    rb_case_crack words, resolved;
    int given[CASE_CRACK_OPTIONS_MAX], plain[CASE_CRACK_OPTIONS_MAX];
} case_crack;

struct rb_case {
    rb_case_purpose purpose;
    rb_resolved_case defaults, words,
        resolved;        /* defaults of the purpose; values as given; values as used */
    char path[320];      /* case file, "" without */
    rb_units file_units; /* of numbers without a unit in that file */
    int given[RB_CASE_OPTIONS_MAX], plain[RB_CASE_OPTIONS_MAX];
    case_table table[CASE_TABLES];
    case_profile profile;
    case_crack crack;
    rb_contact_cone_finder *find_cone_solver; /* NULL: there are none */
    int confined;                             /* 1: rb_case_confine was called */
    const char *folder;                       /* of it; borrowed */
    rb_option_set command[2];                 /* rb_case_also_locate: of a command; borrowed */
    int commands;
    char **text; /* copies of values; owned */
    int texts;
};

/* Sets a number of the case in mm, N, MPa; call rb_case_resolve afterwards. */
void rb_case_assign(rb_case *c, const rb_option *o, double value);

/* Copies a text; the copy is freed with c.  NULL: no memory. */
const char *rb_case_keep(rb_case *c, const char *text);

/* Refuses an option if it was given: RB_EFORMAT if it is from the case file, otherwise
 * RB_EINVAL.  RB_OK: it was not given. */
rb_status rb_case_refuse_given(const rb_case *c, const char *name, const char *reason,
                               rb_message *why);

/* The same of an option that is given. */
rb_status rb_case_refuse_option(const rb_case *c, const rb_option *o, const char *reason,
                                rb_message *why);
/* An option that means nothing to a case, where that is so; the first of n that is given is
 * refused. */
typedef struct {
    int has_no_meaning;
    const char *option, *reason;
} rb_case_rule;
rb_status rb_case_refuse_by(const rb_case *c, size_t n, const rb_case_rule *rules, rb_message *why);

/* Reports an error in a file; if c is confined, the message does not contain the content
 * of the file. */
rb_status rb_case_without_content(const rb_case *c, const char *path, rb_status s, rb_message *why);

/* ---- files.c: the tables that a case names ----------------------------------------- */

void rb_case_free_files(rb_case *c);
/* Call it before the given values are used, because the columns of a history may replace
 * some of them. */
rb_status rb_case_read_history(rb_case *c, rb_message *why);
/* What layers of A and of B stand in place of. */
enum { CASE_OF_LAYERS = 3 };
extern const char *const rb_case_of_layers[2][CASE_OF_LAYERS];
/* Reads the layers of a body, and gives it the first one, and all of them if they are several; it
 * has none: nothing. */
rb_status rb_case_read_layers(rb_case *c, int of_b, rb_message *why);
/* Reads gap, irregularity, wear and friction of the resolved case. */
rb_status rb_case_read_files(rb_case *c, rb_message *why);

/* ---- given_bodies.c, purpose.c ------------------------------------------------------ */

/* Both bodies of the resolved case, with their layers. */
rb_status rb_case_resolve_bodies(rb_case *c, rb_message *why);
/* Options that cases of this purpose never take, and values that mean nothing to it. */
rb_status rb_case_check_never_taken(const rb_case *c, rb_message *why);
rb_status rb_case_check_purpose(const rb_case *c, rb_message *why);

/* ---- resolve.c ---------------------------------------------------------------------- */

/* How options that exclude each other are resolved. */
typedef struct {
    const void *defaults; /* a struct like the set's target with the values for options
                             that are reset */
    unsigned alike;       /* bits of `excludes` that are treated as one bit */
    const char *path;     /* of the case file, for messages */
} rb_option_precedence;

rb_option_precedence rb_case_precedence(const rb_case *c);

/* Two given options that share a bit of `excludes` are refused, naming both, unless one
 * is an argument and one comes from the file: then the argument wins and the other
 * returns to its default. */
rb_status rb_option_resolve(const rb_option_set *set, const rb_option_precedence *how,
                            rb_message *why);
/* Resets the options that exclude `option`, whose value comes from another place (by, as
 * in `given`); refused with the reason if rb_option_resolve would refuse both. */
rb_status rb_option_resolve_against(const rb_option_set *set, const rb_option_precedence *how,
                                    const rb_option *option, int by, const char *reason,
                                    rb_message *why);

#endif
