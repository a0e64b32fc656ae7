/* The course, docs/course: every ```sh and ```octave block of its pages is run, the
 * ```text block after it is what it prints, every number of the sentences stands in such
 * a block, every link leads somewhere, every picture is drawn.  Run from the project's
 * root; B: the build directory. */
#include "check.h"

#include <ctype.h>
#include <glob.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LESSONS = 10, EXERCISES = 5, MAX_NUMBERS = 40000, MAX_TEXT = 200000 };

static char folder[] = "/tmp/rollbem-course-XXXXXX";
static glob_t lessons, solutions;
static int have_octave;

static int run(const char *format, ...)
{
    char command[4000];
    va_list args;
    va_start(args, format);
    vsnprintf(command, sizeof command, format, args);
    va_end(args);
    const int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void slurp(const char *path, char text[MAX_TEXT])
{
    FILE *file = fopen(path, "r");
    if (!file)
        print_error("%s: cannot be read\n", path);
    assert_non_null(file);
    const size_t n = fread(text, 1, MAX_TEXT - 1, file);
    text[n] = '\0';
    assert_true(feof(file) && n + 1 < MAX_TEXT);
    fclose(file);
}

/* A part of a page: prose (language "") or the inside of a fenced block. */
typedef struct {
    char language[20];
    const char *text;
    size_t length;
    int line;
} part;

/* The part that begins at *at; 0 at the end of the page. */
static int next_part(const char **at, int *line, part *p)
{
    const char *s = *at;
    if (!*s)
        return 0;
    p->language[0] = '\0';
    if (strncmp(s, "```", 3) == 0) {
        sscanf(s + 3, "%19[a-z]", p->language);
        s = strchr(s, '\n') + 1;
        ++*line;
    }
    const int fenced = s != *at;
    p->text = s;
    p->line = *line;
    while (*s && strncmp(s, "```", 3) != 0) {
        const char *end = strchr(s, '\n');
        assert_non_null(end);
        s = end + 1;
        ++*line;
    }
    p->length = (size_t)(s - p->text);
    if (fenced) {
        if (strncmp(s, "```\n", 4) != 0)
            print_error("line %d: a block without end\n", p->line);
        assert_int_equal(strncmp(s, "```\n", 4), 0);
        s += 4;
        ++*line;
    }
    *at = s;
    return 1;
}

static int is_blank(const part *p)
{
    return strspn(p->text, " \n") >= p->length;
}

/* The number that begins at `s`, no part of a name such as p0 or B10: its value, the unit
 * of its last digit (0 for integers below 1000, which are counts) and its end; NULL if
 * none. */
static const char *number_at(const char *text, const char *s, double *value, double *unit)
{
    const char *digits = s + (*s == '-' || *s == '+');
    if (!isdigit((unsigned char)*digits) ||
        (s > text && (isalnum((unsigned char)s[-1]) || strchr("_.", s[-1]))))
        return NULL;
    char *end;
    *value = strtod(s, &end);
    int decimals = 0, places = 0;
    const char *c = digits;
    for (; c < end && (isdigit((unsigned char)*c) || *c == '.'); c++) {
        places += *c != '.';
        decimals += decimals > 0 && *c != '.';
        if (*c == '.')
            decimals = 1;
    }
    if (end > digits && end[-1] == '.') /* the full stop of a sentence */
        end--;
    const int exponent = c < end ? atoi(c + 1) : 0;
    *unit = decimals || exponent || places > 3
                ? pow(10.0, exponent - (decimals ? decimals - 1 : 0))
                : 0.0;
    return end;
}

/* Whether one line is like another: words equal, numbers within a unit of the last digit
 * that the page shows; what is below 1e-9 is rounding, and rounding decides ties, so that
 * counts of iterations from 50 on may differ by three in a hundred. */
static int lines_agree(const char *got, const char *wanted)
{
    const char *g = got, *w = wanted;
    for (;;) {
        while (*g == ' ' || *g == '\t')
            g++;
        while (*w == ' ' || *w == '\t')
            w++;
        double x, y, unit, ignored;
        const char *end_g = number_at(got, g, &x, &ignored),
                   *end_w = number_at(wanted, w, &y, &unit);
        if (end_g && end_w) {
            const int rounding = fabs(x) < 1e-9 && fabs(y) < 1e-9;
            const double slack = unit > 0.0        ? 1.0001 * unit
                                 : fabs(y) >= 50.0 ? 0.03 * fabs(y)
                                                   : 0.0;
            if (!rounding && !(fabs(x - y) <= slack))
                return 0;
            g = end_g;
            w = end_w;
        } else if (*g != *w)
            return 0;
        else if (!*g)
            return 1;
        else
            g++, w++;
    }
}

/* The next line of a text that is not empty, without its end; NULL after the last one. */
static char *next_line(char **text)
{
    *text += strspn(*text, "\n");
    if (!**text)
        return NULL;
    char *line = *text;
    *text += strcspn(line, "\n");
    if (**text)
        *(*text)++ = '\0';
    return line;
}

/* 0, or 1 and a message: a line "..." of the page stands for any lines. */
static int differs(const char *page, const part *shown, char *got)
{
    static char wanted[MAX_TEXT];
    snprintf(wanted, sizeof wanted, "%.*s", (int)shown->length, shown->text);
    char *w = wanted, *want, *have = NULL;
    int any = 0;
    while ((want = next_line(&w))) {
        if (strcmp(want, "...") == 0) {
            any = 1;
            continue;
        }
        do
            have = next_line(&got);
        while (any && have && !lines_agree(have, want));
        any = 0;
        if (!have || !lines_agree(have, want)) {
            print_error("%s:%d shows '%s', printed is '%s'\n", page, shown->line, want,
                        have ? have : "nothing");
            return 1;
        }
    }
    have = any ? NULL : next_line(&got);
    if (have)
        print_error("%s:%d: printed besides: '%s'\n", page, shown->line, have);
    return have != NULL;
}

/* Runs the blocks of a page, in order, in the test's folder.  How many print something
 * else than the page shows. */
static int run_page(const char *page)
{
    static char text[MAX_TEXT], got[MAX_TEXT];
    char path[100];
    const char *at = text;
    int line = 1, blocks = 0, wrong = 0, printed = 0;
    part p;
    slurp(page, text);
    while (next_part(&at, &line, &p)) {
        if (!p.language[0]) {
            printed = printed && is_blank(&p);
            continue;
        }
        if (strcmp(p.language, "text") == 0) {
            if (printed)
                wrong += differs(page, &p, got);
            continue;
        }
        const int by_octave = strcmp(p.language, "octave") == 0;
        assert_true(by_octave || strcmp(p.language, "sh") == 0);
        blocks++;
        printed = !by_octave || have_octave;
        if (!printed)
            continue;
        snprintf(path, sizeof path, "%s/snippet", folder);
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fwrite(p.text, 1, p.length, file);
        assert_int_equal(fclose(file), 0);
        const int code =
            run("cd %s && %s snippet >printed 2>%s", folder,
                by_octave ? "octave --no-gui --no-init-file --quiet" : "sh -e",
                by_octave ? "errors" : "&1");
        snprintf(path, sizeof path, "%s/printed", folder);
        slurp(path, got);
        if (code)
            print_error("%s:%d ends with code %d: %s\n", page, p.line, code, got);
        assert_int_equal(code, 0);
    }
    assert_true(blocks >= 1);
    return wrong;
}

static void blocks_print_what_the_pages_show(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t k = 0; k < lessons.gl_pathc; k++) {
        wrong += run_page(lessons.gl_pathv[k]);
        wrong += run_page(solutions.gl_pathv[k]);
    }
    assert_int_equal(wrong, 0);
    if (!have_octave)
        print_message("no octave: its blocks are left out\n");
}

typedef struct {
    int n;
    double x[MAX_NUMBERS];
} numbers;

static void collect(numbers *all, const char *text, size_t length)
{
    double x, unit;
    for (const char *s = text; s < text + length;) {
        const char *end = number_at(text, s, &x, &unit);
        if (end) {
            assert_true(all->n < MAX_NUMBERS);
            all->x[all->n++] = fabs(x);
        }
        s = end ? end : s + 1;
    }
}

/* Numbers of all blocks of a page, and of the files that a comment "<!-- numbers: FILE
 * -->" names. */
static void collect_page(numbers *all, const char *page)
{
    static char text[MAX_TEXT], other[MAX_TEXT];
    const char *at = text;
    int line = 1;
    part p;
    slurp(page, text);
    while (next_part(&at, &line, &p))
        if (p.language[0])
            collect(all, p.text, p.length);
    for (const char *s = text; (s = strstr(s, "<!-- numbers: ")); s++) {
        char name[100];
        assert_int_equal(sscanf(s, "<!-- numbers: %99s", name), 1);
        slurp(name, other);
        collect(all, other, strlen(other));
    }
}

static int has_number(const numbers *all, double x, double unit)
{
    for (int i = 0; i < all->n; i++)
        if (fabs(all->x[i] - fabs(x)) <= 0.5001 * unit + 1e-12 * fabs(x))
            return 1;
    return 0;
}

/* Two digits with a decimal point, or three: what is measured, not counted.  Years in
 * brackets, and numbers of sections, are neither. */
static int is_figure(const char *text, const char *s, const char *end)
{
    int digits = 0, point = 0;
    for (const char *c = s; c < end && !strchr("eE", *c); c++) {
        digits += isdigit((unsigned char)*c) && (digits || *c != '0');
        point |= *c == '.';
    }
    if (s > text && s[-1] == '(' && digits == 4 && !point)
        return 0;
    if (s - text > 8 && strncmp(s - 8, "section", 7) == 0)
        return 0;
    return digits >= (point ? 2 : 3);
}

/* Figures of the prose that no block has; link targets and comments are no prose. */
static int count_unfounded(const numbers *all, const char *page)
{
    static char text[MAX_TEXT];
    const char *at = text;
    int line = 1, wrong = 0;
    part p;
    slurp(page, text);
    while (next_part(&at, &line, &p)) {
        if (p.language[0])
            continue;
        for (const char *s = p.text; s < p.text + p.length;) {
            double x, unit;
            if (strncmp(s, "](", 2) == 0) {
                s = strchr(s, ')');
                continue;
            }
            if (strncmp(s, "<!--", 4) == 0) {
                s = strstr(s, "-->");
                continue;
            }
            const char *end = number_at(p.text, s, &x, &unit);
            if (end && is_figure(p.text, s, end) &&
                !has_number(all, x, unit > 0.0 ? unit : 1e-9)) {
                print_error("%s: %.*s is printed by no block: ...%.*s\n", page,
                            (int)(end - s), s, 60, s);
                wrong++;
            }
            s = end ? end : s + 1;
        }
    }
    return wrong;
}

static void numbers_of_the_sentences_are_printed_by_a_block(void **state)
{
    (void)state;
    static numbers all;
    int wrong = 0;
    for (size_t k = 0; k < lessons.gl_pathc; k++) {
        all.n = 0;
        collect_page(&all, lessons.gl_pathv[k]);
        collect_page(&all, solutions.gl_pathv[k]);
        wrong += count_unfounded(&all, lessons.gl_pathv[k]);
        wrong += count_unfounded(&all, solutions.gl_pathv[k]);
    }
    assert_int_equal(wrong, 0);
}

/* The options that a link to the page holds, as a case file that the program solves. */
static void check_link_to_the_page(const char *page, const char *fragment)
{
    static const char *views[] = {"contact", "roll", "below", "step", "take"};
    char path[100], pairs[2000];
    int viewed = 0;
    snprintf(path, sizeof path, "%s/link.ini", folder);
    snprintf(pairs, sizeof pairs, "%s", fragment);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (char *pair = strtok(pairs, "&"); pair; pair = strtok(NULL, "&")) {
        char *value = strchr(pair, '=');
        assert_non_null(value);
        *value++ = '\0';
        if (strcmp(pair, "view") != 0)
            fprintf(file, "%s = %s\n", pair, value);
        else
            for (size_t k = 0; k < sizeof views / sizeof views[0]; k++)
                viewed |= strcmp(value, views[k]) == 0;
    }
    assert_int_equal(fclose(file), 0);
    const int code = run("%s/build/rollbem %s >/dev/null 2>&1", folder, path);
    if (code || !viewed)
        print_error("%s: the link %s ends with code %d\n", page, fragment, code);
    assert_int_equal(code, 0);
    assert_true(viewed);
}

/* How many links to the page in the browser a page has; all its links lead somewhere. */
static int check_links(const char *page)
{
    static char text[MAX_TEXT];
    int of_the_page = 0;
    slurp(page, text);
    for (const char *s = text; (s = strstr(s, "](")); s++) {
        char target[2000], *fragment;
        assert_int_equal(sscanf(s, "](%1999[^)]", target), 1);
        if ((fragment = strchr(target, '#')))
            *fragment++ = '\0';
        const char *built = strstr(target, "build/");
        if (strncmp(target, "http", 4) == 0 || (!target[0] && fragment))
            continue;
        if (built && strcmp(built, "build/rollbem.html") == 0) {
            of_the_page += fragment != NULL;
            if (fragment)
                check_link_to_the_page(page, fragment);
        } else {
            const int missing =
                built ? run("test -s %s/pictures/%s", folder, strrchr(built, '/') + 1)
                      : run("cd $(dirname %s) && test -e %s", page, target);
            if (missing)
                print_error("%s: %s leads nowhere\n", page, target);
            assert_int_equal(missing, 0);
        }
    }
    return of_the_page;
}

static void links_and_pictures_are_there(void **state)
{
    (void)state;
    assert_int_equal(
        run("ROLLBEM=%s/build/rollbem docs/course/pictures %s/pictures", folder, folder),
        0);
    for (size_t k = 0; k < lessons.gl_pathc; k++) {
        assert_true(check_links(lessons.gl_pathv[k]) >= 1);
        check_links(solutions.gl_pathv[k]);
    }
    check_links("docs/course/README.md");
    check_links("docs/course/lecturers.md");
    check_links("docs/glossary.md");
}

static void lessons_have_all_their_parts(void **state)
{
    (void)state;
    static char text[MAX_TEXT];
    static const char *wanted[] = {"**Aim.**",         "](../../build/course/",
                                   "\n## The command", "\n## What to see",
                                   "\n## On the page", "\n## Exercises"};
    assert_int_equal(lessons.gl_pathc, LESSONS);
    assert_int_equal(solutions.gl_pathc, LESSONS);
    for (size_t k = 0; k < lessons.gl_pathc; k++) {
        assert_string_equal(strrchr(lessons.gl_pathv[k], '/'),
                            strrchr(solutions.gl_pathv[k], '/'));
        slurp(lessons.gl_pathv[k], text);
        for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
            if (!strstr(text, wanted[i]))
                print_error("%s: without %s\n", lessons.gl_pathv[k], wanted[i]);
            assert_non_null(strstr(text, wanted[i]));
        }
        const char *exercises = strstr(text, "\n## Exercises");
        for (int e = 1; e <= EXERCISES; e++) {
            char item[10];
            snprintf(item, sizeof item, "\n%d. ", e);
            assert_non_null(strstr(exercises, item));
        }
        slurp(solutions.gl_pathv[k], text);
        for (int e = 1; e <= EXERCISES; e++) {
            char heading[10];
            snprintf(heading, sizeof heading, "\n## %d ", e);
            assert_non_null(strstr(text, heading));
        }
    }
}

static int make_folder(void **state)
{
    (void)state;
    const char *build = getenv("B");
    have_octave = run("command -v octave >/dev/null") == 0;
    if (!mkdtemp(folder) || glob("docs/course/[0-9]*.md", 0, NULL, &lessons) ||
        glob("docs/course/solutions/[0-9]*.md", 0, NULL, &solutions))
        return -1;
    return run("ln -s \"$(realpath %s)\" %s/build && ln -s \"$(realpath examples)\" "
               "\"$(realpath docs)\" %s",
               build ? build : "build", folder, folder);
}

static int remove_folder(void **state)
{
    (void)state;
    globfree(&lessons);
    globfree(&solutions);
    return run("rm -rf %s", folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lessons_have_all_their_parts),
        cmocka_unit_test(blocks_print_what_the_pages_show),
        cmocka_unit_test(numbers_of_the_sentences_are_printed_by_a_block),
        cmocka_unit_test(links_and_pictures_are_there),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
