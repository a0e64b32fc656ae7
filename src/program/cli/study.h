/* A parameter study: what varies in it (study_vary.c), its results (study_results.c), its table
 * (study_table.c) and the file that keeps it (study_output.c), its pictures (study_picture.c). */
#ifndef ROLLBEM_CLI_STUDY_H
#define ROLLBEM_CLI_STUDY_H

#include "program/cli/output.h"
#include "analysis/sensitivity/derivatives.h"
#include "rolling/case/case.h"
#include "base/io/io.h"

#include <inttypes.h>

enum { VARIED_MAX = 4, COLUMNS_MAX = 64, RESULTS_MAX = 128 };
enum { STUDY_HEADING = RB_CASE_SLOPE_HEADING };

typedef struct {
    const char *vary[VARIED_MAX], *cases, *output, *results;
    const char *tolerance, *derivatives;
    int sample, seed;
    const char *plot, *map, *over, *family, *show;
    cli_pictures pictures;
    rb_report_style style;
    int jobs, restart, progress, quiet, cite;
    int given[32];
} study_options;

/* Columns of one factor vary together: one option of a --vary, or those of the cases. */
typedef struct {
    char name[40], heading[40]; /* creep-ratio, creep_ratio */
    const rb_option *option;    /* of a case or of a crack; NULL: a label, which the table keeps */
    cli_exit bad;               /* of a value that is refused */
    int factor;
    const double *value; /* one per row of the factor; NAN of a word */
    char *const *word;   /* the same: halfplane, none, a label; NULL of a number; NULL: all are
                            numbers */
} study_column;

/* A column behind the status: a number, or its error bar. */
typedef struct {
    const rb_rolling_result *r;
    enum { OF_SOLUTION, OF_STRESS, OF_STRESS_B, OF_CRACK, OF_BOND } of;
    int is_error;
    int bond; /* which of the numbers of bonds */
} study_result;

typedef struct {
    const rb_case *base;
    rb_case *one; /* the current case: a copy of base with other numbers */
    const study_options *o;
    const char *file;            /* the case file; NULL: none */
    const rb_option_set *own;    /* the options of a study, whose values are in o */
    const rb_option_set *cracks; /* those of a crack of base */
    int has_crack; /* 1: one of them is given or varies, the contact passes over a crack */
    study_column column[COLUMNS_MAX];
    int columns, factors, cases;
    int rows[VARIED_MAX + 2]; /* of each factor */
    double *owned[VARIED_MAX];
    char **owned_words[VARIED_MAX]; /* owned_n each; NULL: none */
    size_t owned_n[VARIED_MAX];
    double *sampled;                              /* of --sample: columns of cases each; owned */
    double sum[RESULTS_MAX], square[RESULTS_MAX]; /* of their results, less the first */
    double first_result[RESULTS_MAX];
    int summed;
    rb_io_table table;
    study_result result[RESULTS_MAX];
    int results;
    rb_rolling_bond_number bond[RB_ROW_BONDS];       /* that are chosen */
    rb_rolling_maximum_result bond_of[RB_ROW_BONDS]; /* their descriptions */
    int bonds;
    rb_case_slopes slopes;         /* columns behind those of the results; n = 0: none */
    int over, family;              /* columns of the pictures; -1: none */
    int points;                    /* 1: the cases of the picture are on no grid */
    int drawn_column, band_column; /* of the result and of its error or deviation; band 0: none */
    double *drawn, *band; /* of every case: what the pictures show; NULL: no picture, no band */
    double largest;       /* result in the unit of the one that is drawn */
    uint64_t fingerprint; /* of all inputs */
    FILE *out;
    char *text; /* what it has, where it is memory for a terminal; owned */
    size_t size;
    int lost;            /* 1: no memory for a number of JSON */
    int complete;        /* 1: every row has come */
    struct json_t *list; /* of each column's list; with --format json alone */
    rb_io_writer w;      /* out is its file: CSV and JSON */
    const char *path;    /* of the file that keeps the rows; NULL: stdout, a device */
    long whole;          /* its length up to the last row that reached it whole */
    int created;         /* 1: there was no such file */
    int worst;           /* exit code so far */
    int unsolved, no_memory, first;
    int unsolved_case;              /* the first that may be solved again to say why; 0: none */
    rb_rolling_study_notes notes;   /* on the cases that came in this run */
    uint64_t noted, found;          /* kinds of notes that the file has; those before a row of it
                                       that is still to come */
    double start, shown, told_next; /* seconds; of the last one from the start */
    double spent;                   /* seconds of the whole study */
    int ran;                        /* cases of this run */
} study;

/* What varies: reads --cases and --vary-1 ...; 0 columns are refused. */
cli_exit cli_study_read(study *st);
/* The same of --sample: a Latin hypercube over the tolerances of the resolved case c. */
cli_exit cli_study_sample(study *st, const rb_case *c);
/* The row of its factor that case k = 0, 1, ... has. */
int cli_study_row(const study *st, const study_column *c, int k);
/* Of case k = 0, 1, ...: its number, or its word; NULL: it is a number. */
double cli_study_value(const study *st, const study_column *c, int k);
const char *cli_study_word(const study *st, const study_column *c, int k);
/* The values of case k in c; resolve afterwards. */
cli_exit cli_study_set_values(const study *st, rb_case *c, int k);
/* The option of a case or of a crack; NULL: there is none. */
const rb_option *cli_study_option(const char *name);
void cli_study_free_columns(study *st);
/* Sets st->one to that case; says nothing of what is wrong with it. */
rb_status cli_study_try_one(study *st, int k, rb_message *why);
/* The first case that is one: of a sample not every case may be. */
int cli_study_first(study *st, const rb_case *c);
/* Refuses what any of the cases would be refused for, before anything is solved; of a
 * sample each case stands for itself. */
cli_exit cli_study_check(study *st);

/* Sets st->result and st->slopes, of the first case: refuses what it does not have. */
cli_exit cli_study_choose_results(study *st);
/* What has to be computed of the stress for a result: bits RB_ROW_... */
unsigned cli_study_stress_of(const study *st, const study_result *of);

/* The table: the number of the case, what varies, the status, the results, derivatives, standard
 * deviations. */
int cli_study_columns(const study *st);
const char *cli_study_column_name(const study *st, int j, char text[STUDY_HEADING]);
/* The same of result j = 0, 1, ... alone; its value in the row of a case. */
const char *cli_study_result_name(const study *st, int j, char text[STUDY_HEADING]);
double cli_study_result_value(const study *st, int j, const rb_rolling_row *row);
/* The line of headings and the # lines below it: so many, of which one is the command line. */
enum { STUDY_HEAD_LINES = 5, STUDY_COMMAND_LINE = 2 };
void cli_study_write_head(const study *st, FILE *out);
/* The first case of a kind of notes has its line in the table before it. */
void cli_study_write_notes(study *st, int k, const rb_rolling_row_notes *said);
/* row: in the units of the study. */
void cli_study_write_row(study *st, int k, const rb_rolling_row *row);
/* The exit code and the counts at the end, for the status of case k. */
void cli_study_count(study *st, int k, rb_status status);
/* 1: the line of a file is a note, or the row of case k as this study writes it, which is kept for
 * the pictures and counted. */
int cli_study_is_note(study *st, const char *line);
int cli_study_is_row(study *st, int k, const char *line, size_t length);

/* Opens standard output or the file, and reads the rows of this study that it has. */
cli_exit cli_study_open(study *st);
/* 1: all rows so far are in the file. */
int cli_study_flush(study *st);
/* What was not written whole is taken back.  Returns `code`, or why it could not be written. */
cli_exit cli_study_close(study *st, cli_exit code);

/* 1: --plot or --map. */
int cli_study_has_pictures(const study *st);
/* The name of the result that they show. */
const char *cli_study_shown(const study *st);
/* Keeps what the pictures show of a number of the table: column j of case k; NAN: not solved. */
void cli_study_keep(study *st, int j, int k, double x);
/* Refuses, before anything is solved, what cannot be drawn. */
cli_exit cli_study_prepare_pictures(study *st);
/* Behind the table, whose exit code is `code`. */
cli_exit cli_study_draw(const study *st, cli_exit code);

#endif
