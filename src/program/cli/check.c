/* rollbem check: results verified without the solver. */
#include "program/cli/case.h"
#include "program/cli/wait.h"
#include "base/io/io.h"
#include "program/certificate/certificate.h"
#include "program/report/report.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const char about[] =
    "Checks results of `rollbem` in JSON or as a table. The problem is built again\n"
    "from `inputs`, or from the command line in the comments of a table, on the\n"
    "printed elements and with the printed tractions, approach and creepage; the\n"
    "result is written again from them and compared member by member, notes\n"
    "included. Besides, the laws of contact and friction are judged from the\n"
    "tractions alone. Prints valid, or what is violated and by how much.\n"
    "A table has no approach and creepage; the values that fit its gaps and slips\n"
    "best are used.\n"
    "Histories are checked step by step if they were written with --states, cracks\n"
    "position by position. Solved again are free rolling for free_creepage, the\n"
    "other solutions of --all-solutions, and where the mouth of a crack closes.\n"
    "A table of derivatives has no state and cannot be checked: take --json.\n"
    "Not checked: iterations, seconds, names of the processor's kernels, and what\n"
    "takes other meshes: how large error bars are.\n"
    "Refused: histories without states; cracks without states, or growing; error\n"
    "bars of steps, stress and cracks; curves; units other than mm, N, MPa; CSV.\n"
    "A result may come from an untrusted source: files that it names (a gap, a\n"
    "history) are read only if they are regular files of at most 64 MB in its folder\n"
    "or below, unless --any-folder is given, and no message quotes their content.\n"
    "\n"
    "Exit codes: 0 valid; 1 violated, or not proved; 65 cannot be checked; 66 no such file; 70 out "
    "of\n"
    "memory.";

static cli_exit print_verdict(const char *path, rb_status s, const rb_certificate_outcome *found,
                              const rb_message *why)
{
    if (s != RB_OK)
        return cli_fail(s == RB_ENOMEM ? CLI_INTERNAL : CLI_DATA, "%s", why->text);
    if (found->violations == 0)
        printf("%s: valid: %d numbers computed again, residual %.2g%s\n", path, found->numbers,
               found->residual, found->bars ? "; error bars are taken as stated" : "");
    const int unproved =
        found->prove && (!found->proof.proved || found->proof.steps_proved < found->proof.steps);
    if (found->prove) {
        char text[400] = "not proved: it has no state of a contact";
        if (found->proof.asked)
            rb_report_contact_proof_text(&found->proof, text, sizeof text);
        if (found->proof.proved)
            rb_append(text, sizeof text, "; those stored within %.2g", found->proof.stored_within);
        printf("%s: %s\n", path, text);
    }
    return found->violations || unproved ? CLI_UNSOLVED : CLI_OK;
}

/* The command that a result is of, where it is not `rollbem` itself; or NULL. */
static const char *other_command(const char *word)
{
    const char *name;
    for (int k = 0; word && (name = cli_command_name(k)); k++)
        if (strcmp(name, word) == 0)
            return name;
    return NULL;
}

/* A case that reads regular files of bounded size alone, in the folder or below it; folder NULL:
 * in any.  Returns NULL without memory. */
static rb_case *confined(rb_case_purpose purpose, const char *folder)
{
    rb_case *words = cli_case_create(purpose);
    if (words)
        rb_case_confine(words, folder);
    return words;
}

/* The path of the first member of a result that is not as it was asked for; "": all are.  path:
 * written. */
static const char *not_as_asked(const json_t *asked, const json_t *printed, const char *above,
                                char *path, size_t size)
{
    const char *key;
    json_t *want;
    json_object_foreach((json_t *)asked, key, want)
    {
        const json_t *value = json_object_get(printed, key);
        char own[100];
        snprintf(own, sizeof own, "%s%.60s", above, key);
        const int same = json_is_false(want)  ? !value
                         : json_is_true(want) ? value != NULL
                         : json_is_real(want)
                             ? fabs(json_number_value(value) - json_real_value(want)) <=
                                   1e-9 * fabs(json_real_value(want))
                         : json_is_object(want) && strcmp(key, "uncertain_inputs") != 0
                             ? value != NULL
                             : json_equal(value, want);
        if (!same) {
            snprintf(path, size, "%s", own);
            return path;
        }
        if (json_is_object(want) && json_is_object(value)) {
            char prefix[110];
            snprintf(prefix, sizeof prefix, "%s.", own);
            if (*not_as_asked(want, value, prefix, path, size))
                return path;
        }
    }
    return "";
}

/* What is wrong with the command line that a result quotes, in text; "": nothing.  RB_ENOMEM. */
static rb_status fault_of_command(const json_t *root, char **argv, int argc, const char *folder,
                                  char *text, size_t size)
{
    const char *other = other_command(argv[1]);
    const int is_stress = other && strcmp(other, "stress") == 0,
              is_crack = other && strcmp(other, "crack") == 0;
    char path[120] = "";
    int files = 0;
    json_t *asked = NULL;

    *text = '\0';
    if (other && !is_stress && !is_crack) {
        snprintf(text, size, "it is another command's");
        return RB_OK;
    }
    /* Of a case whose JSON this is. */
    rb_case *words = confined(is_crack    ? RB_CASE_CRACK
                              : is_stress ? RB_CASE_STRESS
                                          : RB_CASE_SINGLE,
                              folder);
    if (!words)
        return RB_ENOMEM;
    const cli_exit code = is_crack    ? cli_crack_asks(argc - 1, argv + 1, words, &files, &asked)
                          : is_stress ? cli_stress_asks(argc - 1, argv + 1, words, &files, &asked)
                                      : cli_solve_asks(argc, argv, words, &files, &asked);
    json_t *inputs = code == CLI_CONTINUE ? rb_report_json_inputs(words) : NULL;
    const int no_memory = code == CLI_INTERNAL || (code == CLI_CONTINUE && !(inputs && asked));
    const int can_tell =
        files == 0 && !no_memory; /* case files may have changed, or be elsewhere */
    if (can_tell && code != CLI_CONTINUE)
        snprintf(text, size, "it is not a command line of rollbem");
    else if (can_tell && !json_equal(inputs, json_object_get(root, "inputs")))
        snprintf(text, size, "it has other inputs than `inputs`");
    else if (can_tell && *not_as_asked(asked, root, "", path, sizeof path))
        snprintf(text, size, "%s is not what it asks for", path);
    json_decref(inputs);
    json_decref(asked);
    rb_case_free(words);
    return no_memory ? RB_ENOMEM : RB_OK;
}

/* Jansson 2.14 cuts a text that it has no memory for and reads on. */
static int memory_was_refused;

static void *noting_malloc(size_t size)
{
    void *memory = malloc(size);
    memory_was_refused |= !memory;
    return memory;
}

static cli_exit check_json(const char *path, const char *text, size_t size, const char *folder,
                           int prove)
{
    rb_certificate_outcome found = {.prove = prove};
    rb_message why = {.text = ""};
    json_error_t error;
    memory_was_refused = 0;
    json_set_alloc_funcs(noting_malloc, free);
    json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    json_set_alloc_funcs(malloc, free);
    if (memory_was_refused) {
        json_decref(root);
        return cli_say(RB_ENOMEM, &why);
    }
    if (!json_is_object(root)) {
        json_decref(root);
        return cli_fail(CLI_DATA, "%s:%d: expected the JSON of a result: %s", path,
                        root ? 1 : error.line, root ? "no object" : error.text);
    }
    rb_case *words =
        confined(json_object_get(root, "crack") ? RB_CASE_CRACK : RB_CASE_SINGLE, folder);
    rb_status s = words ? rb_certificate_check(stdout, path, root, words, &found, &why) : RB_ENOMEM;
    if (s == RB_OK) {
        /* The command line that the result quotes against its inputs. */
        const char *quoted = json_string_value(json_object_get(root, "command"));
        char fault[200] = "it is not a command line of rollbem";
        if (quoted && strncmp(quoted, "rollbem", 7) == 0 && strchr(" ", quoted[7])) {
            char *line = strdup(quoted + 7);
            int argc;
            char **argv = line ? cli_split_line(line, &argc) : NULL;
            const int kept = cli_keep_failures(1);
            s = argv ? fault_of_command(root, argv, argc, folder, fault, sizeof fault) : RB_ENOMEM;
            cli_keep_failures(kept);
            free(argv);
            free(line);
        }
        if (s != RB_OK)
            rb_fail(&why, s, "%s: out of memory", path);
        else if (*fault) {
            printf("%s: violated: command: %s\n", path, fault);
            found.violations++;
        }
    }
    rb_case_free(words);
    json_decref(root);
    return print_verdict(path, s, &found, &why);
}

/* ---- Tables ------------------------------------------------------------------------ */

static cli_exit check_table(const char *path, const char *text, const char *folder, int prove)
{
    rb_certificate_outcome found = {.prove = prove};
    rb_message why = {.text = ""};
    char *line = NULL;
    const rb_status found_line = rb_report_table_command(text, &line);
    if (found_line == RB_ENOMEM)
        return cli_say(found_line, &why);
    if (found_line != RB_OK)
        return cli_fail(CLI_DATA,
                        "%s: cannot be checked: expected the JSON of a result, or a "
                        "table with its comments ('# rollbem ...')",
                        path);
    rb_case *words = confined(RB_CASE_SINGLE, folder);
    json_t *asked = NULL;
    int argc, files;
    char **argv = words ? cli_split_line(line, &argc) : NULL;
    cli_exit code = CLI_INTERNAL;
    if (words && !argv)
        cli_fail(code, "%s: out of memory", path);
    if (argv) {
        /* The case is that of the command line that the table quotes. */
        const char *other = other_command(argv[1]);
        const int kept = cli_keep_failures(1);
        code = other ? CLI_DATA : cli_solve_asks(argc, argv, words, &files, &asked);
        json_decref(asked);
        cli_keep_failures(kept);
        if (other)
            cli_fail(code,
                     "%s: cannot be checked: a table of rollbem %s (only tables of "
                     "single cases can)",
                     path, other);
        else if (code != CLI_CONTINUE)
            code = cli_fail(code == CLI_INTERNAL ? code : CLI_DATA,
                            "%s: cannot be checked: the command line in its comments: %s", path,
                            cli_kept_failure());
    }
    free(argv);
    free(line);
    if (code == CLI_CONTINUE)
        code =
            print_verdict(path, rb_certificate_check_table(stdout, path, text, words, &found, &why),
                          &found, &why);
    rb_case_free(words);
    return code;
}

/* ---- Command ----------------------------------------------------------------------- */

typedef struct {
    int any_folder, prove;
} check_options;

static const rb_option options[] = {
    RB_FLAG_LINE("any-folder", offsetof(check_options, any_folder),
                 "also read files that a result names outside its folder"),
    RB_FLAG_LINE("prove", offsetof(check_options, prove),
                 "also prove, without solving, that the discrete problem has a solution with the "
                 "stored zones, and that the stored tractions are near to it"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static cli_exit check_file(const char *path, const check_options *o)
{
    char *text = NULL;
    size_t size;
    rb_message why = {.text = ""};
    const rb_status s = rb_io_read_text(path, &text, &size, &why);
    if (s != RB_OK)
        return cli_say(s, &why);
    /* The folder of the file. */
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    const char first = text[strspn(text, " \t\r\n")];
    cli_exit code = CLI_INTERNAL;
    const char *within = o->any_folder ? NULL : folder;
    cli_wait_begin();
    if (!folder)
        code = cli_fail(code, "%s: out of memory", path);
    else
        code = first == '{' || first == '[' ? check_json(path, text, size, within, o->prove)
                                            : check_table(path, text, within, o->prove);
    cli_wait_end();
    free(folder);
    free(text);
    return code;
}

int cli_check(int argc, char **argv)
{
    check_options o = {0};
    int given[OPTIONS] = {0};
    const cli_spec spec = {.synopsis = "rollbem check [OPTION...] RESULT.json|TABLE...",
                           .about = about,
                           .sets = {{options, OPTIONS, &o, given, NULL}},
                           .set_n = 1};
    cli_args args = {0};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands == 0)
        code = cli_fail(CLI_USAGE, "check: expected a file that `rollbem` wrote");
    else if (code == CLI_CONTINUE) {
        code = CLI_OK;
        for (int k = 0; k < args.operands; k++) {
            const cli_exit one = check_file(args.operand[k], &o);
            code = one > code ? one : code;
        }
    }
    cli_args_free(&args);
    return code;
}
