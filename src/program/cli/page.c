/* rollbem page: writes the page for browsers, which opens with a given case. */
#include "program/cli/case.h"
#include "program/cli/output.h"
#include "base/io/io.h"
#include "program/report/report.h"

#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    const char *page, *output;
    int given[3];
} page_options;

#define PLACE(member) offsetof(page_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("output", "Output"),
    RB_TEXT_LINE("page", PLACE(page), "FILE", "the page as `make page` builds it",
                 .unset = "the one beside the program, or in share/rollbem beside its folder",
                 .file = RB_FILE_READ),
    RB_TEXT_LINE("output", PLACE(output), "FILE", "file to write, completely or not at all",
                 .unset = "standard output", .file = RB_FILE_WRITTEN),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS == 3, "given");

static const char about[] =
    "Writes the page for browsers, one HTML file that opens without a network, so\n"
    "that it opens with this case.\n\n" CLI_CASE_SIGNS;

static const char notes[] =
    CLI_CASE_NOTES "Example: rollbem page --mu 0.3 --creep 0.1 --output lecture.html\n";

/* ---- The page as it is built ------------------------------------------------------- */

/* Where the case goes: what web/page.html holds, and what stands for no case. */
static const char marker[] = "<script type=\"application/json\" id=\"carried\">",
                  no_case[] = "null";
/* And where the page says what it does not take. */
static const char limits_marker[] = "<script type=\"application/json\" id=\"limits\">";

typedef struct {
    char *text, *place; /* the page, and where the case goes in it */
    json_t *limits;     /* what it does not take */
} built_page;

/* The caller frees it, also after a refusal. */
static cli_exit read_page(const char *given, built_page *p)
{
    /* Beside the program as it is built, or where `make install` puts it. */
    static const char *const places[] = {"rollbem.html", "../share/rollbem/rollbem.html"};
    const char *path = given;
    char program[3000], place[3200];
    size_t size;
    rb_message why = {.text = ""};
    const ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
    program[n > 0 ? n : 0] = '\0';
    for (size_t k = 0; k < sizeof places / sizeof *places && !path && n > 0; k++) {
        snprintf(place, sizeof place, "%.*s/%s", (int)(strrchr(program, '/') - program), program,
                 places[k]);
        if (access(place, R_OK) == 0)
            path = place;
    }
    if (!path)
        return cli_fail(CLI_NOINPUT, "page: rollbem.html is neither beside the program nor in "
                                     "share/rollbem; `make page` builds it, --page FILE names it");
    const rb_status s = rb_io_read_text(path, &p->text, &size, &why);
    if (s != RB_OK)
        return cli_say(s, &why);
    char *at = strstr(p->text, marker), *limits = strstr(p->text, limits_marker);
    if (limits)
        p->limits = json_loads(limits + strlen(limits_marker), JSON_DISABLE_EOF_CHECK, NULL);
    if (!at || strncmp(at + strlen(marker), no_case, strlen(no_case)) != 0 || !p->limits)
        return cli_fail(CLI_DATA, "%s: expected the page of `make page`", path);
    p->place = at + strlen(marker);
    return CLI_CONTINUE;
}

/* ---- The case ---------------------------------------------------------------------- */

/* A page that would open with a refusal is not written. */
static cli_exit refuse_beyond(rb_case *c, const json_t *limits)
{
    const json_t *left_out = json_object_get(limits, "left_out");
    const json_t *largest = json_object_get(limits, "largest");
    const rb_option_set set = rb_case_options(c);
    char buffer[64];
    for (int k = 0; k < set.n; k++) {
        const char *name = set.options[k].name;
        if (set.options[k].kind == RB_OPTION_GROUP || !rb_case_given(c, name))
            continue;
        for (size_t i = 0; i < json_array_size(left_out); i++) {
            const char *other = json_string_value(json_array_get(left_out, i));
            if (other && strcmp(other, name) == 0)
                return cli_fail(CLI_USAGE, "--%s: not in the page, use the program", name);
        }
        const json_t *most = json_object_get(largest, name);
        const char *text = rb_option_text(&set.options[k], set.target, buffer);
        if (most && strtod(text, NULL) > json_number_value(most))
            return cli_fail(CLI_USAGE, "--%s: the page goes up to %g, use the program for %s", name,
                            json_number_value(most), text);
    }
    return CLI_CONTINUE;
}

typedef struct {
    const char *text, *place; /* of the page */
    const char *carried;      /* JSON */
} filled_page;

static rb_status write_page(FILE *out, const void *context, rb_message *why)
{
    const filled_page *p = context;
    (void)why;
    fwrite(p->text, 1, (size_t)(p->place - p->text), out);
    for (const char *c = p->carried; *c; c++)
        if (*c == '<') /* no text may end the element that holds it */
            fputs("\\u003c", out);
        else
            putc(*c, out);
    fputs(p->place + strlen(no_case), out);
    return rb_report_flush(out);
}

int cli_page(int argc, char **argv)
{
    page_options o = {0};
    cli_args args = {0};
    rb_case *c = cli_case_create(RB_CASE_SINGLE);
    if (!c)
        return CLI_INTERNAL;
    const cli_spec spec = {
        .synopsis = "rollbem page [OPTION...] [CASE.ini]",
        .about = about,
        .notes = notes,
        .sets = {rb_case_options(c), {options, OPTIONS, &o, o.given, NULL}, cli_example_set()},
        .set_n = 3};
    cli_exit code = cli_case_parse(&spec, argc, argv, c, &args);
    const rb_option_set set = rb_case_options(c);
    for (int k = 0; k < set.n && code == CLI_CONTINUE; k++)
        if (rb_option_path(&set.options[k], set.target)) /* it opens without any other file */
            code = cli_fail(CLI_USAGE, "--%s: names a file, which the page cannot contain",
                            set.options[k].name);
    if (code == CLI_CONTINUE) {
        built_page page = {0};
        code = read_page(o.page, &page);
        if (code == CLI_CONTINUE)
            code = refuse_beyond(c, page.limits);
        if (code == CLI_CONTINUE) {
            /* The options that are given, name by name, as text of a case file. */
            json_t *all = json_object();
            char buffer[64];
            for (int k = 0; k < set.n; k++)
                if (set.options[k].kind != RB_OPTION_GROUP && rb_case_given(c, set.options[k].name))
                    rb_report_json_set(
                        &all, set.options[k].name,
                        json_string(rb_option_text(&set.options[k], set.target, buffer)));
            char *carried = all ? json_dumps(all, JSON_COMPACT) : NULL;
            const filled_page p = {page.text, page.place, carried};
            code = carried ? cli_write_file(o.output, write_page, &p)
                           : cli_fail(CLI_INTERNAL, "out of memory");
            free(carried);
            json_decref(all);
        }
        free(page.text);
        json_decref(page.limits);
    }
    cli_args_free(&args);
    rb_case_free(c);
    return code;
}
