/* Where an error stands: the line of the case file, the argument or the row of a table that gave
 * what is refused. */
#include "rolling/case/words.h"
#include "base/units.h"

#include <string.h>

rb_status rb_case_refuse_option(const rb_case *c, const rb_option *o, const char *reason,
                                rb_message *why)
{
    char buffer[400];
    const int by = c->given[o - rb_case_table];
    return rb_fail(why, by > 0 ? RB_EFORMAT : RB_EINVAL, "%s: %s",
                   rb_option_source(o, by, c->path, buffer, sizeof buffer), reason);
}

rb_status rb_case_refuse_given(const rb_case *c, const char *name, const char *reason,
                               rb_message *why)
{
    return rb_case_given(c, name) ? rb_case_refuse_option(c, rb_case_option(name), reason, why)
                                  : RB_OK;
}

rb_status rb_case_refuse_by(const rb_case *c, size_t n, const rb_case_rule *rules, rb_message *why)
{
    for (size_t k = 0; k < n; k++) {
        const rb_status s = rules[k].has_no_meaning
                                ? rb_case_refuse_given(c, rules[k].option, rules[k].reason, why)
                                : RB_OK;
        if (s != RB_OK)
            return s;
    }
    return RB_OK;
}

/* An option and where its value comes from; of NULL: none. */
typedef struct {
    const rb_option *of;
    int given;
} source;

static source given_in(const rb_option_set *set, const char *name)
{
    for (int k = 0; k < set->n; k++)
        if (set->given && set->given[k] && strcmp(set->options[k].name, name) == 0)
            return (source){&set->options[k], set->given[k]};
    return (source){NULL, 0};
}

/* Where an option of the case, of its crack or of the command is given. */
static source source_of(const rb_case *c, const char *name)
{
    const rb_option_set crack = {rb_case_crack_options, rb_case_crack_options_n, NULL,
                                 (int *)c->crack.given, NULL};
    source found = {rb_case_option(name), rb_case_given(c, name)};
    if (!found.given)
        found = given_in(&crack, name);
    for (int k = 0; k < c->commands && !found.given; k++)
        found = given_in(&c->command[k], name);
    return found;
}

void rb_case_also_locate(rb_case *c, const rb_option_set *set)
{
    if (!set)
        c->commands = 0;
    else if (c->commands < (int)(sizeof c->command / sizeof *c->command))
        c->command[c->commands++] = *set;
}

/* The first given one of the options that a refusal is about, or that of A which an option of B
 * follows. */
static source blamed(const rb_case *c, const rb_message *why)
{
    char name[sizeof why->about];
    for (int of_a = 0; of_a < 2; of_a++)
        for (const char *list = why->about; (list = rb_next_word(list, name, sizeof name));) {
            const size_t n = strlen(name);
            if (of_a && n > 2 && strcmp(name + n - 2, "-b") == 0)
                name[n - 2] = '\0';
            const source found = source_of(c, name);
            if (found.given)
                return found;
        }
    return (source){NULL, 0};
}

/* The table that the value of this option is read from; NULL: none is. */
static const case_table *table_of(const rb_case *c, const rb_option *o)
{
    static const char *const names[CASE_TABLES] = {
        [CASE_HISTORY] = "history",           [CASE_GAP] = "gap",
        [CASE_IRREGULARITY] = "irregularity", [CASE_WORN] = "worn",
        [CASE_FRICTION] = "friction-law",     [CASE_LAYERS] = "layers",
        [CASE_LAYERS_B] = "layers-b"};
    for (int k = 0; k < CASE_TABLES; k++)
        if (c->table[k].path && strcmp(o->name, names[k]) == 0)
            return &c->table[k];
    return NULL;
}

rb_status rb_case_locate(const rb_case *c, rb_status s, rb_message *why)
{
    if (s == RB_OK || !why) /* what succeeds leaves no text, nor need one have been set */
        return s;
    rb_unit_translate(c->words.units, why->text, sizeof why->text);
    if (s != RB_EINVAL)
        return s;
    const rb_message said = *why;
    const source by = blamed(c, &said);
    const case_table *t = by.of ? table_of(c, by.of) : NULL;
    char place[400];
    if (t && said.row >= 1 && said.row <= t->table.rows)
        return rb_fail(why, RB_EFORMAT, "%s:%d: %s", t->path, t->table.line[said.row - 1],
                       said.text + said.rest);
    if (t)
        return rb_fail(why, RB_EFORMAT, "%s: %s", t->path, said.text);
    if (by.of)
        return rb_fail(why, by.given > 0 ? RB_EFORMAT : s, "%s: %s",
                       rb_option_source(by.of, by.given, c->path, place, sizeof place),
                       said.text + said.rest);
    if (!*c->path)
        return s;
    for (int i = 0; i < rb_case_table_n; i++)
        if (c->given[i] < 0) /* of the command line: the error need not stand in the file */
            return s;
    return rb_fail(why, RB_EFORMAT, "%s: %s", c->path, said.text);
}
