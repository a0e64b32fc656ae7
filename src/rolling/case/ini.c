/* Case files: section by section, key = value, by the tables of options. */
#include "rolling/case/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ini.h>

typedef struct {
    rb_case *c;
    int n;
    const rb_option_set *sets; /* the case's own, and those of the command */
    const char *path;
    const char *at; /* in it: the next line */
    int line;
    rb_status status; /* of the first error */
    rb_message *why;
} ini_state;

/* fgets for inih: counts lines, takes away the indentation (inih would read an indented
 * line as more of the last value) and refuses what does not fit. */
static char *read_line(char *line, int size, void *context)
{
    ini_state *st = context;
    if (st->status != RB_OK || !*st->at)
        return NULL;
    st->line++;
    const size_t n = strcspn(st->at, "\n");
    if (n + 2 > (size_t)size) {
        st->status = rb_fail(st->why, RB_EFORMAT, "%s:%d: line too long", st->path, st->line);
        return NULL;
    }
    const size_t indent = strspn(st->at, " \t");
    snprintf(line, (size_t)size, "%.*s\n", (int)(n - (indent < n ? indent : n)),
             st->at + (indent < n ? indent : n));
    st->at += n + (st->at[n] == '\n');
    return line;
}

static rb_status set_value(const ini_state *st, const rb_option_set *set, int i, const char *value)
{
    char what[400];
    const rb_option *o = &set->options[i];
    const char *kept = rb_case_keep(st->c, value); /* inih's lives until the next line */
    if (!kept)
        return rb_fail(st->why, RB_ENOMEM, "out of memory");
    snprintf(what, sizeof what, "%s:%d: %s", st->path, st->line, o->name);
    if (strstr(value, " #"))
        return rb_fail(st->why, RB_EFORMAT,
                       "%s: a comment after a value begins with ';', got '%.60s'", what, value);
    return rb_option_assign(set, i, st->line, what, kept, st->why) == RB_OK ? RB_OK : RB_EFORMAT;
}

/* The section of an option: that of the group that it stands in, which may have begun in the set
 * before.  The case's own, the first one, begins with a group. */
static const char *section_of(const ini_state *st, const rb_option_set *set, int i)
{
    while (set->options[i].kind != RB_OPTION_GROUP)
        if (i > 0)
            i--;
        else if (set > st->sets)
            i = (--set)->n - 1;
        else
            return "";
    return set->options[i].name;
}

static rb_status set_key(const ini_state *st, const char *section, const char *name,
                         const char *value)
{
    int i, known = *section == '\0';
    rb_guess guess = {.word = name}, near = {.word = section};
    const rb_option_set *set = rb_option_find(st->n, st->sets, name, strlen(name), &i, &guess);
    for (int k = 0; k < st->n; k++)
        for (int j = 0; j < st->sets[k].n && !known; j++) {
            const rb_option *o = &st->sets[k].options[j];
            known = o->kind == RB_OPTION_GROUP && strcmp(o->name, section) == 0;
            if (o->kind == RB_OPTION_GROUP)
                rb_guess_try(&near, o->name);
        }
    if (!known) {
        const char *similar = rb_guess_text(&near, "");
        char sections[300] = "";
        /* else all of those of the case itself, which come first */
        for (int j = 0; j < st->sets->n && !*similar; j++)
            if (st->sets->options[j].kind == RB_OPTION_GROUP)
                rb_append(sections, sizeof sections, "%s%s",
                          *sections ? ", " : "; the sections are ", st->sets->options[j].name);
        return rb_fail(st->why, RB_EFORMAT, "%s:%d: unknown section '%s'%s%s", st->path, st->line,
                       section, similar, sections);
    }
    if (!set)
        return rb_fail(st->why, RB_EFORMAT, "%s:%d: unknown key '%s'%s", st->path, st->line, name,
                       rb_guess_text(&guess, ""));
    const char *wanted = section_of(st, set, i);
    if (*section != '\0' && strcmp(section, wanted) != 0)
        return rb_fail(st->why, RB_EFORMAT, "%s:%d: key '%s' belongs to section [%s], not [%s]",
                       st->path, st->line, name, wanted, section);
    const int before = set->given ? set->given[i] : 0;
    if (before > 0)
        return rb_fail(st->why, RB_EFORMAT, "%s:%d: key '%s' was given before, in line %d",
                       st->path, st->line, name, before);
    if (strcmp(name, "units") == 0) {
        /* The file's numbers are in its own units, whatever an argument wants to see. */
        const int former = set->given[i];
        const rb_units shown = st->c->words.units;
        const rb_status s = set_value(st, set, i, value);
        st->c->file_units = st->c->words.units;
        if (former == RB_GIVEN_ARGUMENT) {
            st->c->words.units = shown;
            set->given[i] = former;
        }
        return s;
    }
    return before == RB_GIVEN_ARGUMENT ? RB_OK : set_value(st, set, i, value);
}

static int handle_key(void *context, const char *section, const char *name, const char *value)
{
    ini_state *st = context; /* behind an error read_line ends the file */
    st->status = set_key(st, section, name, value);
    return st->status == RB_OK;
}

static rb_status read_text(rb_case *c, const char *path, const char *text, int n,
                           const rb_option_set *also, rb_message *why)
{
    if (text[strspn(text, " \t\r\n")] == '{')
        return rb_fail(why, RB_EFORMAT, "%s: expected a case file of lines 'key = value', got JSON",
                       path);
    rb_option_set *sets = calloc((size_t)n + 1, sizeof *sets);
    ini_state st = {.c = c, .n = n + 1, .sets = sets, .path = path, .why = why};
    if (!sets)
        return rb_fail(why, RB_ENOMEM, "out of memory");
    sets[0] = rb_case_options(c);
    if (n > 0)
        memcpy(sets + 1, also, sizeof *sets * (size_t)n);
    snprintf(c->path, sizeof c->path, "%s", path);
    st.at = text;
    const int bad_line = ini_parse_stream(read_line, &st, handle_key, &st);
    if (st.status == RB_OK && bad_line < 0)
        st.status = rb_fail(st.why, RB_ENOMEM, "%s: out of memory", st.path);
    else if (st.status == RB_OK && bad_line)
        st.status = rb_fail(st.why, RB_EFORMAT, "%s:%d: expected [section] or key = value", st.path,
                            bad_line);
    const rb_status s = st.status;
    free(sets);
    return s;
}

rb_status rb_case_read_with(rb_case *c, const char *path, int n, const rb_option_set *also,
                            rb_message *why)
{
    char *text;
    size_t size;
    rb_status s = rb_case_read_input(c, path, &text, &size, why);
    if (s != RB_OK)
        return s;
    s = read_text(c, path, text, n, also, why);
    free(text);
    return rb_case_without_content(c, path, s, why);
}

rb_status rb_case_read(rb_case *c, const char *path, rb_message *why)
{
    return rb_case_read_with(c, path, 0, NULL, why);
}

rb_status rb_case_read_text(rb_case *c, const char *name, const char *text, rb_message *why)
{
    return read_text(c, name, text, 0, NULL, why);
}
