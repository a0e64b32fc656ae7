/* Pages of documentation: their ```sh, ```python and ```octave blocks are run, and the
 * ```text block right after one is what it prints. */
#ifndef ROLLBEM_TESTS_PAGES_H
#define ROLLBEM_TESTS_PAGES_H

#include "check.h"

#include <ctype.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MAX_TEXT = 200000 };

static inline int run(const char *format, ...)
{
    char command[4000];
    va_list args;
    va_start(args, format);
    vsnprintf(command, sizeof command, format, args);
    va_end(args);
    const int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static inline void slurp(const char *path, char text[MAX_TEXT])
{
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("%s: cannot be read", path);
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
static inline int next_part(const char **at, int *line, part *p)
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
        const char *end = NOT_NULL(strchr(s, '\n'));
        s = end + 1;
        ++*line;
    }
    p->length = (size_t)(s - p->text);
    if (fenced) {
        if (strncmp(s, "```\n", 4) != 0)
            fail_msg("line %d: a block without end", p->line);
        s += 4;
        ++*line;
    }
    *at = s;
    return 1;
}

static inline int is_blank(const part *p)
{
    return strspn(p->text, " \n") >= p->length;
}

/* The number that begins at `s`, no part of a name such as p0 or B10: its value, the unit
 * of its last digit (0 for integers below 1000, which are counts) and its end; NULL if
 * none. */
static inline const char *number_at(const char *text, const char *s, double *value, double *unit)
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
    *unit = decimals || exponent || places > 3 ? pow(10.0, exponent - (decimals ? decimals - 1 : 0))
                                               : 0.0;
    return end;
}

/* Whether one line is like another: words equal, numbers within a unit of the last digit
 * that the page shows; what is below 1e-9 is rounding, and rounding decides ties, so that
 * counts of iterations from 50 on may differ by three in a hundred. */
static inline int lines_agree(const char *got, const char *wanted)
{
    const char *g = got, *w = wanted;
    for (;;) {
        while (*g == ' ' || *g == '\t')
            g++;
        while (*w == ' ' || *w == '\t')
            w++;
        double x = 0.0, y = 0.0, unit = 0.0, ignored;
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
static inline char *next_line(char **text)
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
static inline int differs(const char *page, const part *shown, char *got)
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

/* Whether a page's Octave blocks can be run. */
static inline int have_octave(void)
{
    static int have = -1;
    if (have < 0)
        have = run("command -v octave >/dev/null") == 0;
    return have;
}

/* The Python that runs a page's blocks, which need NumPy and a library without
 * sanitizers; NULL where there is none. */
static inline const char *python_of_pages(void)
{
    static const char *known[] = {"python3", "/usr/bin/python3"}, *found;
    static int looked = 0;
    const char *build = getenv("B");
    if (looked++)
        return found;
    if (run("nm -D %s/librollbem.so 2>/dev/null | grep -q __asan_init", build ? build : "build") ==
        0)
        return NULL;
    for (size_t k = 0; k < sizeof known / sizeof *known && !found; k++)
        if (run("%s -c 'import numpy; numpy.ndarray' 2>/dev/null", known[k]) == 0)
            found = known[k];
    return found;
}

/* The folder where blocks run holds links to the build folder, the examples, the docs and
 * the Python package. */
static inline int link_folder(const char *folder)
{
    const char *build = getenv("B");
    return run("ln -s \"$(realpath %s)\" %s/build && ln -s \"$(realpath examples)\" "
               "\"$(realpath docs)\" \"$(realpath python)\" %s",
               build ? build : "build", folder, folder);
}

/* Runs blocks of Python, named PAGE-LINE, one after the other in one process: what a
 * block prints goes to the file printed-PAGE-LINE.  Ends with the number of blocks that
 * raise something. */
static inline int run_python(const char *folder, const char *names)
{
    static const char program[] =
        "import contextlib, sys, traceback, warnings\n"
        "warnings.simplefilter('ignore')\n"
        "wrong = 0\n"
        "for name in sys.argv[1:]:\n"
        "    with open('printed-' + name, 'w') as out, contextlib.redirect_stdout(out):\n"
        "        try:\n"
        "            exec(compile(open('block-' + name).read(), 'block', 'exec'), "
        "{'__name__': '__main__'})\n"
        "        except Exception:\n"
        "            wrong += 1\n"
        "            traceback.print_exc(file=out)\n"
        "sys.exit(wrong)\n";
    char path[100];
    snprintf(path, sizeof path, "%s/blocks.py", folder);
    FILE *file = NOT_NULL(fopen(path, "w"));
    fputs(program, file);
    assert_int_equal(fclose(file), 0);
    return run("cd %s && PYTHONPATH=python ROLLBEM_LIBRARY=build/librollbem.so "
               "PYTHONDONTWRITEBYTECODE=1 %s blocks.py%s 2>errors || { cat errors; false; }",
               folder, python_of_pages(), names);
}

static inline int is_in(const part *p, const char *language)
{
    return strcmp(p->language, language) == 0;
}

/* How many headings of sections (## and deeper) a part of prose has. */
static inline int headings_in(const part *p)
{
    int n = p->length > 2 && strncmp(p->text, "##", 2) == 0;
    for (const char *s = p->text; s + 2 < p->text + p->length; s++)
        n += strncmp(s, "\n##", 3) == 0;
    return n;
}

/* Runs the blocks of a page, the k-th one, in the folder: those of the shell and of
 * Octave, in order; the names of those of Python are added to a list.  Of `turns` sections one is
 * run, which needs no file of another one.  How many blocks there are, run or not. */
static inline int run_blocks(const char *page, int k, int turns, const char *folder,
                             char python[MAX_TEXT], int *wrong)
{
    static char text[MAX_TEXT];
    char path[100];
    const char *at = text;
    int line = 1, blocks = 0, section = 0;
    part p;
    slurp(page, text);
    while (next_part(&at, &line, &p)) {
        section += p.language[0] ? 0 : headings_in(&p);
        if (!is_in(&p, "sh") && !is_in(&p, "octave") && !is_in(&p, "python"))
            continue;
        blocks++;
        if (!is_in_turn(section, turns))
            continue;
        snprintf(path, sizeof path, "%s/block-%d-%d", folder, k, p.line);
        FILE *file = NOT_NULL(fopen(path, "w"));
        fwrite(p.text, 1, p.length, file);
        assert_int_equal(fclose(file), 0);
        int code = 0;
        if (is_in(&p, "sh"))
            code = run("cd %s && sh -e block-%d-%d >printed-%d-%d 2>&1 && for f in $(grep -oE -e "
                       "'-(plot|fringes|orbit|map) [a-z-]+[.][a-z]+' block-%d-%d | sed 's/.* //'); "
                       "do [ -s $f ] || exit 99; done",
                       folder, k, p.line, k, p.line, k, p.line);
        else if (is_in(&p, "octave") && have_octave())
            code = run("cd %s && octave --no-gui --no-init-file --quiet block-%d-%d "
                       ">printed-%d-%d 2>errors",
                       folder, k, p.line, k, p.line);
        else if (is_in(&p, "python") && python_of_pages())
            snprintf(python + strlen(python), MAX_TEXT - strlen(python), " %d-%d", k, p.line);
        if (code)
            print_error("%s:%d ends with code %d\n", page, p.line, code);
        *wrong += code != 0;
    }
    return blocks;
}

/* How many blocks of the k-th page have printed something else than it shows. */
static inline int count_different(const char *page, int k, const char *folder)
{
    static char text[MAX_TEXT], got[MAX_TEXT];
    char path[100];
    const char *at = text;
    int line = 1, wrong = 0, printed = 0; /* the line of the block that the next ```text is of */
    part p;
    slurp(page, text);
    while (next_part(&at, &line, &p))
        if (!p.language[0])
            printed = is_blank(&p) ? printed : 0;
        else if (is_in(&p, "text")) {
            snprintf(path, sizeof path, "%s/printed-%d-%d", folder, k, printed);
            if (printed && access(path, F_OK) == 0) {
                slurp(path, got);
                wrong += differs(page, &p, got);
            }
        } else
            printed = p.line;
    return wrong;
}

/* Runs the blocks of pages, each of which has so many at least, those of Python at the
 * end; one of `turns` sections.  How many raise something or print something else than the pages
 * show, or whose picture is not there. */
static inline int run_pages(char *const page[], size_t pages, int least, int turns,
                            const char *folder)
{
    static char python[MAX_TEXT];
    int wrong = 0;
    python[0] = '\0';
    for (size_t k = 0; k < pages; k++)
        assert_true(run_blocks(page[k], (int)k, turns, folder, python, &wrong) >= least);
    if (python[0]) {
        const int raised = run_python(folder, python);
        if (raised)
            print_error("%d blocks of Python raise something\n", raised);
        wrong += raised != 0;
    }
    for (size_t k = 0; k < pages; k++)
        wrong += count_different(page[k], (int)k, folder);
    assert_int_equal(run("rm -f %s/printed-* %s/block-*", folder, folder), 0);
    return wrong;
}

static inline int run_page(char *page, int least, int turns, const char *folder)
{
    return run_pages(&page, 1, least, turns, folder);
}

#endif
