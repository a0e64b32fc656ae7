/* rollbem crack: stress intensities of a crack in body B under the passing contact. */
#include "program/cli/case.h"
#include "program/cli/interrupt.h"

#include <jansson.h>
#include <stddef.h>

typedef struct {
    double at; /* options */
    const char *open, *orbit;
    int states;
    rb_case_crack_result result;
} crack_run;

#define PLACE(member) offsetof(crack_run, member)

/* Behind those of the crack. */
static const rb_option options[] = {
    CLI_PICTURE_LINE("plot-crack", PLACE(open),
                     "picture of the crack with its faces moved apart, magnified; one that grows "
                     "has the faces of its first length and the way of its tip"),
    RB_NUMBER_LINE("at", PLACE(at), "a", RB_ANY, "position of the contact in that picture"),
    CLI_PICTURE_LINE("orbit", PLACE(orbit), "picture of K_II over K_I in the last pass"),
    RB_FLAG_LINE("states", PLACE(states),
                 "with --json: opening, sliding, tractions and zone of every node of the faces at "
                 "every position, and the contact, which rollbem check needs"),
};
enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Solves a case and moves its contact over a crack in body B, position by\n"
    "position; the faces of the crack open, stick and slip with friction. Prints one\n"
    "row per position: K_I and K_II at the tip, the open and the sticking length,\n"
    "and the pressure of a fluid. The unit of lengths of the crack and of positions\n"
    "is the half-width of the contact (Hertz's for its load). The body of the crack\n"
    "is a half-plane; the crack does not change the contact unless --coupled is\n"
    "given. The contact of a static or steady case moves over the crack unchanged;\n"
    "that of a transient is at --from plus the rolled distance; that of a static\n"
    "history stays at --from.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] =
    CLI_CASE_NOTES "Example: rollbem crack --similar --support halfplane --half-width 1 --mu 0 \\\n"
                   "           --crack-angle 30 --plot crack.png\n";

static cli_exit check_crack(cli_case_run *run)
{
    const crack_run *own = run->own;
    const rb_case_crack *crack = rb_case_crack_of(run->words);
    rb_message why = {.text = ""};
    const rb_status s = rb_case_crack_check(run->c, crack, &why);
    if (s != RB_OK)
        return cli_case_refused(run->words, s, &why);
    if (own->states && (run->o.style.format != RB_REPORT_JSON || run->c->units != RB_UNITS_MM))
        return cli_case_refuse(run->words, "states", "with --json and in mm, N, MPa only");
    return crack->unloaded && (run->o.plot || own->orbit)
               ? cli_case_refuse(run->words, run->o.plot ? "plot" : "orbit",
                                 "--unloaded has no positions to draw over")
               : CLI_CONTINUE;
}

static int is_interrupted(int step, int steps, void *context)
{
    (void)step, (void)steps, (void)context;
    return cli_interrupted();
}

static rb_status solve_crack_case(cli_case_run *run, rb_message *why)
{
    crack_run *own = run->own;
    rb_case_crack_result *r = &own->result;
    const rb_crack_observer observer = {is_interrupted, NULL};
    cli_interrupts_catch();
    const rb_status s =
        rb_case_crack_solve(run->c, rb_case_crack_of(run->words), &observer, r, why);
    cli_interrupts_leave();
    rb_case_crack_convert(r, run->c->units);
    run->solution = r->contact.solution.n > 0 ? &r->contact.solution : NULL;
    run->of_steps = r->contact.of_steps;
    run->printable = s == RB_OK || (s == RB_INTERRUPTED && r->history.n > 0);
    return s;
}

/* ---- Print ------------------------------------------------------------------------- */

static void fill_in(const cli_case_run *run, rb_report_document *d)
{
    const crack_run *own = run->own;
    d->crack = &own->result;
    d->faces = own->states;
}

static rb_status write_table(FILE *out, const cli_case_run *run)
{
    return rb_report_crack_table(out, &((const crack_run *)run->own)->result, run->notes,
                                 cli_command_line(), &run->o.style);
}

static rb_status draw_crack(FILE *out, rb_report_canvas canvas, const void *context,
                            rb_message *why)
{
    const crack_run *own = ((const cli_case_run *)context)->own;
    return rb_report_crack_picture(out, canvas, &own->result, why);
}

static rb_status draw_orbit(FILE *out, rb_report_canvas canvas, const void *context,
                            rb_message *why)
{
    const crack_run *own = ((const cli_case_run *)context)->own;
    return rb_report_crack_orbit(out, canvas, &own->result, why);
}

static rb_status draw_open(FILE *out, rb_report_canvas canvas, const void *context, rb_message *why)
{
    const crack_run *own = ((const cli_case_run *)context)->own;
    return rb_report_crack_open(out, canvas, &own->result, own->at, why);
}

static const cli_case_file files[] = {{"plot", .draw = draw_crack},
                                      {"plot-crack", .draw = draw_open},
                                      {"orbit", .draw = draw_orbit},
                                      {NULL, NULL, NULL}};

static void summarise_crack(FILE *out, const cli_case_run *run)
{
    rb_report_crack_summary(out, &((const crack_run *)run->own)->result, cli_is_coloured(stderr));
}

static void ask_crack(const cli_case_run *run, json_t **members)
{
    rb_report_json_set(members, "crack", json_true());
    rb_report_json_set(members, "faces", json_boolean(((const crack_run *)run->own)->states));
}

static const cli_case_need needs[] = {{"at", "plot-crack"}, {NULL, NULL}};

static const cli_case_command command = {
    .synopsis = "rollbem crack [OPTION...] [CASE.ini]",
    .about = about,
    .notes = notes,
    .purpose = RB_CASE_CRACK,
    .options = options,
    .option_n = OPTIONS,
    .takes_crack = 1,
    .files = files,
    .needs = needs,
    .check = check_crack,
    .solve = solve_crack_case,
    .table = write_table,
    .document = fill_in,
    .asked = ask_crack,
    .summarise = summarise_crack,
};

cli_exit cli_crack_asks(int argc, char **argv, rb_case *words, int *case_files, json_t **asked)
{
    crack_run own = {0};
    return cli_case_asks(&command, &own, argc, argv, words, case_files, asked);
}

int cli_crack(int argc, char **argv)
{
    crack_run own = {0};
    const cli_exit code = cli_case_run_command(&command, &own, argc, argv);
    rb_case_crack_free(&own.result);
    return code;
}
