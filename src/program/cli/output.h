/* Where the results of a command go: every file whole or not at all. */
#ifndef ROLLBEM_CLI_OUTPUT_H
#define ROLLBEM_CLI_OUTPUT_H

#include "program/cli/cli.h"
#include "program/cli/rows.h"
#include "program/report/report.h"

enum { CLI_OUTPUT_OPTIONS_MAX = 12 };

/* Rows of an option table for a style that stands there. */
extern const rb_choice cli_formats[], cli_headers[];
#define CLI_JSON_LINE(style)                                                                       \
    RB_FLAG_LINE("json", style + offsetof(rb_report_style, format), "JSON instead of the table",   \
                 .common = 1)
#define CLI_HEADER_LINE(style)                                                                     \
    RB_CHOICE_LINE("header", style + offsetof(rb_report_style, bare), cli_headers,                 \
                   "of a table with tabs: # lines below the names, or the names alone")
#define CLI_STYLE_LINES(style)                                                                     \
    CLI_JSON_LINE(style),                                                                          \
        RB_CHOICE_LINE("format", style + offsetof(rb_report_style, format), cli_formats,           \
                       "of the results: a table with tabs, with commas, JSON, or what a "          \
                       "terminal shows"),                                                          \
        CLI_HEADER_LINE(style)

#define CLI_OUTPUT_LINE(output)                                                                    \
    RB_TEXT_LINE("output", output, "FILE",                                                         \
                 "file for the table or JSON, written completely or not at all",                   \
                 .unset = "standard output", .file = RB_FILE_WRITTEN, .common = 1)

/* How pictures are drawn. */
typedef struct {
    int size;           /* rb_report_picture_size */
    const char *script; /* where gnuplot's script goes too; NULL: nowhere */
    const char *own;    /* file with a template instead of the program's; NULL: none */
} cli_pictures;

extern const rb_choice cli_picture_sizes[];
#define CLI_PICTURE_LINES(pictures)                                                                \
    RB_CHOICE_LINE("plot-size", pictures + offsetof(cli_pictures, size), cli_picture_sizes,        \
                   "of the pictures: a column or the page of a paper, or a slide"),                \
        RB_TEXT_LINE("plot-script", pictures + offsetof(cli_pictures, script), "FILE",             \
                     "also write the picture's gnuplot script with its data, for changes by "      \
                     "hand",                                                                       \
                     .unset = "none", .file = RB_FILE_WRITTEN),                                    \
        RB_TEXT_LINE("plot-template", pictures + offsetof(cli_pictures, own), "FILE",              \
                     "gnuplot commands that draw the picture from its table and titles, instead "  \
                     "of the program's",                                                           \
                     .unset = "none", .file = RB_FILE_READ)

/* A picture by the name of its file. */
#define CLI_PICTURE_LINE(name, place, what)                                                        \
    RB_TEXT_LINE(name, place, "FILE", what ": " RB_REPORT_KINDS, .unset = "none",                  \
                 .file = RB_FILE_PICTURE)

#define CLI_PLOT_LINES(plot, pictures)                                                             \
    RB_TEXT_LINE("plot", plot, "FILE", "picture: " RB_REPORT_KINDS " (by gnuplot)",                \
                 .unset = "none", .file = RB_FILE_PICTURE, .common = 1),                           \
        CLI_PICTURE_LINES(pictures)

typedef struct {
    rb_report_style style; /* of tables; JSON: the results whole */
    int quiet, cite;
    const char *output, *plot;
    cli_pictures pictures;
    int given[CLI_OUTPUT_OPTIONS_MAX];
} cli_output;

/* Section [output]: form of the results, --output, --plot and how if the command draws,
 * --quiet, --cite, --dimensionless of a command that draws and has scales. */
rb_option_set cli_output_set(cli_output *o, int draws, int has_scales);

/* 1: the results are abbreviated: standard output is a terminal, and nobody has asked for
 * a form of the results, or --format is brief. */
int cli_reader_is_person(void);
/* A table with tabs on a terminal that has to hold so many other lines too; text:
 * changed. */
rb_status cli_show_table(char *text, int summary);

/* Prints lines on standard error; where it is a terminal, none is wider, and the table
 * that follows leaves room for them. */
typedef void cli_lines(FILE *out, const void *context);
void cli_print_lines(cli_lines *print, const void *context);
/* The papers of that run, likewise; solution NULL: none. */
void cli_print_citations(const rb_rolling_case *rc, const rb_rolling_solution *solution);

/* The file that the option of that name asks for; NULL: none. */
const char *cli_option_path(const cli_spec *spec, const char *name);

/* Before the work: refuses what the options of spec name and cannot be written, pictures
 * of an unknown kind, and files that would be written over while they are inputs or
 * another option's output; sizes and scripts of pictures that are not asked for. */
cli_exit cli_check_files(const cli_spec *spec, const cli_args *args);

/* Writes what context is.  RB_EWRITE: errno says why where out has failed, otherwise the
 * message, which is empty before. */
typedef rb_status cli_write(FILE *out, const void *context, rb_message *why);
typedef rb_status cli_draw(FILE *out, rb_report_canvas canvas, const void *context,
                           rb_message *why);

/* Opens, writes and commits; path NULL: standard output. */
rb_status cli_write_to(const char *path, cli_write *write, const void *context, rb_message *why);
/* The same, its failure printed. */
cli_exit cli_write_file(const char *path, cli_write *write, const void *context);
/* The same for a picture, that --option asked for; path NULL: nothing to draw. */
cli_exit cli_draw_file(const cli_pictures *pictures, const char *option, const char *path,
                       cli_draw *draw, const void *context);

/* Problems from files, solved one after the other into one table or one JSON text. */
typedef struct {
    const rb_report_style *style;
    const char *columns, *conventions;
    cli_exit (*solve)(void *context, const char *file); /* adds to what follows */
    void *context;
    cli_rows rows;
} cli_problems;

/* All operands, also after one that fails; the largest exit code of them. */
cli_exit cli_solve_problems(cli_problems *p, const cli_args *args, const char *output);

/* A note on a file, on standard error. */
void cli_note(const char *file, const char *format, ...) RB_PRINTF(2, 3);
/* Notes on what all solutions of a file may lack, where `what` (bases, states) were tried:
 * those within rounding only, those that only singular ones have, and undecided ones. */
void cli_note_enumeration(const char *file, const char *what, int solutions, int nearby,
                          int singular_only, int undecided, int tried);

#endif
