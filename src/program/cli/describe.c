/* Descriptions of the commands for other programs, made from the option tables: manual
 * pages, completions of three shells, pages of the reference. */
#include "analysis/crack/crack_case.h"
#include "analysis/sensitivity/sensitivity.h"
#include "program/cli/describe.h"
#include "program/cli/find.h"

#include "program/report/report.h"

#include <ctype.h>
#include <string.h>

static int takes_file(const rb_option *o)
{
    return o->file != RB_FILE_NONE || (o->kind == RB_OPTION_CHOICE && o->path);
}

/* Characters of `special` with `before` in front of them. */
static void print_escaped(const char *text, const char *special, const char *before)
{
    for (; *text; text++) {
        if (strchr(special, *text))
            fputs(before, stdout);
        putchar(*text);
    }
}

/* A character, or what stands for it where that is not NULL. */
static void print_character(char c, const char *instead)
{
    if (instead)
        fputs(instead, stdout);
    else
        putchar(c);
}

/* In single quotes, which a shell leaves as they are. */
static void print_quoted(const char *text)
{
    for (; *text; text++)
        print_character(*text, *text == '\'' ? "'\\''" : NULL);
}

static void print_choices(const rb_option *o)
{
    for (const rb_choice *c = o->choices; c && c->name; c++)
        printf("%s%s", c == o->choices ? "" : " ", c->name);
}

/* What may stand behind an option: its choices, or the names of which it takes one or several. */
static const struct {
    const char *option;
    enum { OF_EXAMPLES, OF_RESULTS, OF_SLOPES, OF_NUMBERS, OF_OPTIONS } names;
} named[] = {{"example", OF_EXAMPLES},
             {"results", OF_RESULTS},
             {"show", OF_RESULTS},
             {"derivatives", OF_SLOPES},
             {"smooth-derivatives", OF_SLOPES},
             {"minimise", OF_SLOPES},
             {"maximise", OF_SLOPES},
             {"subject", OF_SLOPES},
             {"tolerance", OF_NUMBERS},
             {"fit", OF_NUMBERS},
             {"over", OF_NUMBERS},
             {"family", OF_OPTIONS},
             {"vary-1", OF_OPTIONS},
             {"vary-2", OF_OPTIONS},
             {"vary-3", OF_OPTIONS},
             {"vary-4", OF_OPTIONS}};

enum { NAMED = sizeof named / sizeof *named };

static int kind_of_names(const rb_option *o)
{
    int k = 0;
    while (k < NAMED && (o->choices || strcmp(named[k].option, o->name) != 0))
        k++;
    return k < NAMED ? (int)named[k].names : -1;
}

static int has_values(const rb_option *o)
{
    return o->kind != RB_OPTION_FLAG && (o->choices || kind_of_names(o) >= 0);
}

static void print_examples(void)
{
    char name[80], about[1000];
    for (int k = 0; cli_example_about(k, name, sizeof name, about, sizeof about); k++)
        printf(" %s", strchr(name, ' ') + 1); /* behind --example */
}

static void print_values(const cli_spec *spec, const rb_option *o)
{
    const rb_rolling_results *const tables[] = {
        &rb_rolling_solution_scalars, &rb_rolling_maxima_scalars, &rb_rolling_bond_scalars,
        &rb_rolling_maxima_b_scalars, &rb_rolling_bond_b_scalars, &rb_case_crack_scalars};
    const int names = kind_of_names(o), slopes = names == OF_SLOPES;
    if (names < 0)
        print_choices(o);
    else if (names == OF_EXAMPLES)
        print_examples();
    for (int t = 0; (slopes || names == OF_RESULTS) && t < 6; t++)
        for (int k = 0; k < tables[t]->n; k++)
            if (!slopes || rb_sensitivity_has(&tables[t]->row[k]))
                printf(" %s", tables[t]->row[k].name);
    for (int k = 0; names >= OF_NUMBERS && k < spec->sets[0].n; k++) {
        const rb_option *of = &spec->sets[0].options[k];
        const int is_number = of->kind == RB_OPTION_NUMBER;
        if (cli_takes(spec, of) &&
            (is_number || (names == OF_OPTIONS && of->kind != RB_OPTION_GROUP)))
            printf(" %s", of->name);
    }
}

/* 1: several of them stand between commas. */
static int takes_list(const rb_option *o)
{
    return kind_of_names(o) >= OF_RESULTS && kind_of_names(o) <= OF_NUMBERS;
}

/* ---- Manual pages ------------------------------------------------------------------ */

/* Text for troff: a line that begins with blanks is an example and stays as it is. */
static void print_troff(const char *text)
{
    int example = 0;
    while (*text) {
        const size_t n = strcspn(text, "\n");
        const int indented = *text == ' ';
        if (n == 0)
            fputs(".PP\n", stdout);
        if (indented != example)
            puts(indented ? ".PP\n.nf" : ".fi\n.PP");
        example = indented;
        if (n > 0 && (*text == '.' || *text == '\''))
            fputs("\\&", stdout);
        for (size_t k = 0; k < n; k++)
            print_character(text[k], text[k] == '\\' ? "\\e" : text[k] == '-' ? "\\-" : NULL);
        if (n > 0)
            putchar('\n');
        text += n + (text[n] == '\n');
    }
    if (example)
        puts(".fi");
}

static void print_upper(const char *text)
{
    for (; *text; text++)
        putchar(toupper((unsigned char)*text));
}

static void print_man(const cli_spec *spec)
{
    char command[24], values[120], text[600];
    const char *dash = *cli_command_of(spec, command) ? "-" : "";
    fputs(".TH ROLLBEM", stdout);
    fputs(dash, stdout);
    print_upper(command);
    printf(" 1 \"\" \"rollbem %s\"\n.SH NAME\nrollbem%s%s \\- ", RB_VERSION, dash, command);
    print_troff(cli_command_help(command));
    puts(".SH SYNOPSIS");
    print_troff(spec->synopsis);
    puts(".SH DESCRIPTION");
    print_troff(spec->about);
    for (cli_option at = {0}; cli_next_option(spec, &at);) {
        if (at.is_first) {
            fputs(".SH OPTIONS: ", stdout);
            print_upper(at.group->help);
            printf("\nIn case files: section \\fB[%s]\\fR.\n", at.group->name);
        }
        cli_option_metavar(at.option, values, sizeof values);
        cli_option_text(at.option, at.target, text, sizeof text);
        fputs(".TP\n\\fB\\-\\-", stdout);
        print_escaped(at.option->name, "-", "\\");
        fputs("\\fR\\fI", stdout);
        print_escaped(values, "-", "\\");
        puts("\\fR");
        print_troff(text);
    }
    if (spec->notes) {
        puts(".SH NOTES");
        print_troff(spec->notes);
    }
    printf(".SH SEE ALSO\n%s", *command ? ".BR rollbem (1)\n" : "");
    for (int k = 0; !*command && cli_command_name(k); k++)
        printf(".BR rollbem\\-%s (1)%s\n", cli_command_name(k), cli_command_name(k + 1) ? "," : "");
}

/* ---- Pages of the reference -------------------------------------------------------- */

static void print_code_block(const char *text)
{
    printf("\n```text\n%s%s```\n", text, text[strlen(text) - 1] == '\n' ? "" : "\n");
}

static void print_markdown(const cli_spec *spec)
{
    char command[24], values[120], text[600];
    cli_command_of(spec, command);
    printf("# rollbem%s%s\n\n%s\n", *command ? " " : "", command, cli_command_help(command));
    print_code_block(spec->synopsis);
    print_code_block(spec->about);
    for (cli_option at = {0}; cli_next_option(spec, &at);) {
        if (at.is_first)
            printf("\n## %s `[%s]`\n\n| option | meaning |\n|---|---|\n", at.group->help,
                   at.group->name);
        cli_option_metavar(at.option, values, sizeof values);
        cli_option_text(at.option, at.target, text, sizeof text);
        printf("| `--%s%s` | ", at.option->name, values);
        print_escaped(text, "|*_<", "\\");
        puts(" |");
    }
    if (spec->notes)
        print_code_block(spec->notes);
}

/* Every table of results. */
static void print_results(const cli_spec *spec)
{
    const rb_rolling_result_table *t;
    (void)spec;
    puts("# Results\n\nBy the names that JSON, tables, studies and the package for Python use.");
    for (int j = 0; (t = rb_case_result_table(j)); j++) {
        printf("\n## %s\n\n| name | unit | meaning |\n|---|---|---|\n", t->title);
        for (int k = 0; k < t->results->n; k++) {
            const rb_rolling_result *r = &t->results->row[k];
            printf("| `%s` | %s | ", r->name, r->unit ? r->unit : "");
            print_escaped(r->meaning, "|*_<", "\\");
            puts(" |");
        }
    }
}

/* ---- Completions ------------------------------------------------------------------- */

static void bash_command(const cli_spec *spec)
{
    char command[24];
    printf("    %s)\n        case $previous in\n", *cli_command_of(spec, command) ? command : "*");
    for (cli_option at = {0}; cli_next_option(spec, &at);) {
        if (at.option->kind == RB_OPTION_FLAG)
            continue;
        printf("        --%s) values=\"", at.option->name);
        print_values(spec, at.option);
        printf("\" kind=%s ;;\n", takes_file(at.option) ? "file" : "word");
    }
    fputs("        esac\n        options=\"", stdout);
    for (cli_option at = {0}; cli_next_option(spec, &at);)
        printf(" --%s", at.option->name);
    puts("\"\n        ;;");
}

static void zsh_command(const cli_spec *spec)
{
    char command[24];
    printf("    %s)\n        _arguments \\\n", *cli_command_of(spec, command) ? command : "*");
    for (cli_option at = {0}; cli_next_option(spec, &at);) {
        const rb_option *o = at.option;
        printf("            '--%s%s[", o->name, o->kind == RB_OPTION_FLAG ? "" : "=");
        for (const char *c = o->help; *c; c++) {
            if (strchr("[]:\\", *c))
                putchar('\\');
            print_character(*c, *c == '\'' ? "'\\''" : NULL);
        }
        fputs("]", stdout);
        if (o->kind != RB_OPTION_FLAG)
            fputs(takes_file(o) ? ":file:_files" : ":value:", stdout);
        if (!takes_file(o) && has_values(o)) {
            fputs(takes_list(o) ? "_values -s , name" : "(", stdout);
            print_values(spec, o);
            fputs(takes_list(o) ? "" : ")", stdout);
        }
        puts("' \\");
    }
    puts("            '--help[this text]' '--usage[the options on a few lines]' '--version' "
         "'*:file:_files'\n        ;;");
}

static void fish_command(const cli_spec *spec)
{
    char command[24];
    cli_command_of(spec, command);
    for (cli_option at = {0}; cli_next_option(spec, &at);) {
        const rb_option *o = at.option;
        if (*command)
            printf("complete -c rollbem -n '__fish_seen_subcommand_from %s'", command);
        else
            fputs("complete -c rollbem -n __rollbem_solves", stdout);
        printf(" -l %s", o->name);
        if (o->kind != RB_OPTION_FLAG)
            fputs(takes_file(o) ? " -r" : " -x", stdout);
        if (has_values(o)) {
            fputs(takes_list(o) ? " -a '(__rollbem_list" : " -a '", stdout);
            print_values(spec, o);
            fputs(takes_list(o) ? ")'" : "'", stdout);
        }
        fputs(" -d '", stdout);
        print_quoted(o->help);
        puts("'");
    }
}

/* ---- The schema of --json --------------------------------------------------------- */

static const struct {
    const char *name;
    void (*print)(const cli_spec *spec);
} forms[] = {{"man", print_man},           {"results", print_results}, {"markdown", print_markdown},
             {"bash", bash_command},       {"zsh", zsh_command},       {"fish", fish_command},
             {"search", cli_find_options}, {"holder", cli_find_holder}};

enum { FORMS = sizeof forms / sizeof *forms };

cli_exit cli_describe(const cli_spec *spec, const char *form)
{
    if (strcmp(form, "schema") == 0) {
        const rb_message why = {.text = ""};
        const rb_status s = rb_report_json_write(stdout, rb_report_json_schema());
        /* what could not be written is said by main */
        return s == RB_ENOMEM ? cli_say(s, &why) : CLI_OK;
    }
    for (int k = 0; k < FORMS; k++)
        if (strcmp(forms[k].name, form) == 0) {
            forms[k].print(spec);
            return CLI_OK;
        }
    return CLI_CONTINUE;
}

/* ---- A whole completion ------------------------------------------------------------ */

static void print_commands(const char *between)
{
    for (int k = 0; cli_command_name(k); k++)
        printf("%s%s", k ? between : "", cli_command_name(k));
}

static cli_exit bash_completion(void)
{
    fputs("# rollbem for bash: source this file, or keep it in bash-completion's folder\n"
          "_rollbem() {\n"
          "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
          "    local command=${COMP_WORDS[1]} options= values= kind=\n"
          "    # bash takes --name=value apart\n"
          "    [ \"$current\" = = ] && current=\n"
          "    [ \"$previous\" = = ] && previous=${COMP_WORDS[COMP_CWORD-2]}\n"
          "    case $command in\n",
          stdout);
    const cli_exit code = cli_describe_all("bash", 0);
    fputs("    esac\n"
          "    [ \"$command\" = help ] && options= values=\"",
          stdout);
    print_commands(" ");
    fputs("\" kind=word\n"
          "    options=\"$options --help --usage --version\"\n"
          "    [ \"$COMP_CWORD\" -eq 1 ] && options=\"$options ",
          stdout);
    print_commands(" ");
    fputs("\"\n"
          "    if [ -n \"$kind\" ]; then\n"
          "        # one name, or several between commas\n"
          "        local before=\n"
          "        [[ $current == *,* ]] && before=${current%,*},\n"
          "        COMPREPLY=($(compgen -P \"$before\" -W \"$values\" -- \"${current##*,}\"))\n"
          "        [ \"$kind\" = file ] && COMPREPLY+=($(compgen -f -- \"$current\"))\n"
          "    elif [[ $current == -* || $COMP_CWORD -eq 1 ]]; then\n"
          "        COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
          "    fi\n"
          "}\n"
          "complete -o default -F _rollbem rollbem\n",
          stdout);
    return code;
}

static cli_exit zsh_completion(void)
{
    fputs("#compdef rollbem\n"
          "_rollbem() {\n"
          "    local command=$words[2]\n"
          "    if (( CURRENT == 2 )); then\n"
          "        compadd -- ",
          stdout);
    print_commands(" ");
    fputs("\n    fi\n    case $command in\n", stdout);
    fputs("    help)\n        compadd -- ", stdout);
    print_commands(" ");
    fputs("\n        ;;\n", stdout);
    const cli_exit code = cli_describe_all("zsh", 0);
    fputs("    esac\n}\n_rollbem \"$@\"\n", stdout);
    return code;
}

static cli_exit fish_completion(void)
{
    fputs("# rollbem for fish\nfunction __rollbem_solves\n"
          "    not __fish_seen_subcommand_from ",
          stdout);
    print_commands(" ");
    puts("\nend\n"
         "# names behind those that stand before a comma already\n"
         "function __rollbem_list\n"
         "    set -l word (commandline -ct | string replace -r '^--[^=]*=' '')\n"
         "    set -l before (string match -r '^.*,' -- $word)\n"
         "    for name in $argv\n"
         "        echo \"$before$name\"\n"
         "    end\n"
         "end");
    for (int k = 0; cli_command_name(k); k++) {
        printf("complete -c rollbem -n __fish_use_subcommand -a %s -d '", cli_command_name(k));
        print_quoted(cli_command_help(cli_command_name(k)));
        puts("'");
    }
    fputs("complete -c rollbem -n '__fish_seen_subcommand_from help' -f -a '", stdout);
    print_commands(" ");
    puts("'");
    return cli_describe_all("fish", 1);
}

cli_exit cli_complete(const char *shell)
{
    static const struct {
        const char *name;
        cli_exit (*print)(void);
    } shells[] = {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}};
    for (size_t k = 0; k < sizeof shells / sizeof *shells; k++)
        if (strcmp(shells[k].name, shell) == 0)
            return shells[k].print();
    return CLI_CONTINUE;
}
