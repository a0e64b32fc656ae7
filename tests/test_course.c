/* The course, docs/course: its blocks print what the pages show, every number of the
 * sentences stands in such a block, every link leads somewhere, every picture is drawn.
 * Run from the project's root; B: the build directory. */
#include "pages.h"

#include <glob.h>
#include <unistd.h>

enum { LESSONS = 13, PAGES = 4, EXERCISES = 5, MAX_NUMBERS = 40000 };

static char folder[] = "/tmp/rollbem-course-XXXXXX";
static glob_t lessons, solutions;
static char *pages[PAGES] = {/* with their exercise and its solution */
                             "docs/course/half-plane.md", "docs/course/kinematics.md",
                             "docs/course/complementarity.md", "docs/course/boundary-elements.md"};

TEST(blocks_print_what_the_pages_show)
{
    assert_int_equal(lessons.gl_pathc, LESSONS);
    assert_int_equal(solutions.gl_pathc, LESSONS);
    char *page[2 * LESSONS + PAGES]; /* each lesson before its solutions */
    size_t n = 0;
    for (size_t k = 0; k < LESSONS; k++)
        if (is_in_turn((int)k, 8)) {
            page[n++] = lessons.gl_pathv[k];
            page[n++] = solutions.gl_pathv[k];
        }
    for (size_t k = 0; k < PAGES; k++)
        if (is_in_turn((int)k, 4))
            page[n++] = pages[k];
    assert_int_equal(run_pages(page, n, 1, 1, folder), 0);
}

/* The test above leaves them out where they cannot be run; this one says so. */
TEST(blocks_in_python_are_run)
{
    if (!python_of_pages()) {
        print_message("blocks in Python are left out: no NumPy here (apt-get install "
                      "python3-numpy), "
                      "or a library with sanitizers\n");
        skip();
    }
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
            if (end && is_figure(p.text, s, end) && !has_number(all, x, unit > 0.0 ? unit : 1e-9)) {
                print_error("%s: %.*s is printed by no block: ...%.*s\n", page, (int)(end - s), s,
                            60, s);
                wrong++;
            }
            s = end ? end : s + 1;
        }
    }
    return wrong;
}

TEST(numbers_of_the_sentences_are_printed_by_a_block)
{
    static numbers all;
    int wrong = 0;
    for (size_t k = 0; k < lessons.gl_pathc; k++) {
        all.n = 0;
        collect_page(&all, lessons.gl_pathv[k]);
        collect_page(&all, solutions.gl_pathv[k]);
        wrong += count_unfounded(&all, lessons.gl_pathv[k]);
        wrong += count_unfounded(&all, solutions.gl_pathv[k]);
    }
    for (size_t k = 0; k < PAGES; k++) {
        all.n = 0;
        collect_page(&all, pages[k]);
        wrong += count_unfounded(&all, pages[k]);
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
    FILE *file = NOT_NULL(fopen(path, "w"));
    for (char *pair = strtok(pairs, "&"); pair; pair = strtok(NULL, "&")) {
        char *value = NOT_NULL(strchr(pair, '='));
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
        fail_msg("%s: the link %s ends with code %d", page, fragment, code);
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
            const int missing = built
                                    ? run("test -s %s/pictures/%s", folder, strrchr(built, '/') + 1)
                                    : run("cd $(dirname %s) && test -e %s", page, target);
            if (missing)
                fail_msg("%s: %s leads nowhere", page, target);
        }
    }
    return of_the_page;
}

TEST(links_and_pictures_are_there)
{
    /* which make has drawn, for the site too */
    assert_int_equal(
        run("D=docs/course/pictures; B=%s/build; if [ $B/course/.drawn -nt $D ] && "
            "[ $B/course/.drawn -nt $B/rollbem ]; then ln -s build/course %s/pictures; "
            "else ROLLBEM=$B/rollbem $D %s/pictures; fi",
            folder, folder, folder),
        0);
    for (size_t k = 0; k < lessons.gl_pathc; k++) {
        assert_true(check_links(lessons.gl_pathv[k]) >= 1);
        check_links(solutions.gl_pathv[k]);
    }
    for (size_t k = 0; k < PAGES; k++)
        check_links(pages[k]);
    check_links("docs/course/README.md");
    check_links("docs/course/lecturers.md");
    check_links("docs/glossary.md");
}

TEST(lessons_have_all_their_parts)
{
    static char text[MAX_TEXT];
    static const char *wanted[] = {"**Aim.**",         "](../../build/course/", "\n## The command",
                                   "\n## What to see", "\n## On the page",      "\n## Exercises"};
    assert_int_equal(lessons.gl_pathc, LESSONS);
    assert_int_equal(solutions.gl_pathc, LESSONS);
    for (size_t k = 0; k < lessons.gl_pathc; k++) {
        assert_string_equal(strrchr(lessons.gl_pathv[k], '/'), strrchr(solutions.gl_pathv[k], '/'));
        slurp(lessons.gl_pathv[k], text);
        for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
            if (!strstr(text, wanted[i]))
                fail_msg("%s: without %s", lessons.gl_pathv[k], wanted[i]);
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
    if (!mkdtemp(folder) || glob("docs/course/[0-9]*.md", 0, NULL, &lessons) ||
        glob("docs/course/solutions/[0-9]*.md", 0, NULL, &solutions))
        return -1;
    return link_folder(folder);
}

static int remove_folder(void **state)
{
    globfree(&lessons);
    globfree(&solutions);
    return run("rm -rf %s", folder);
}

RUN_TESTS(make_folder, remove_folder)
