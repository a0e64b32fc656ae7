/* The public interface: what the headers declare is what the shared library exports, and
 * the headers serve C++ too.  Run from the project's root. */
#include "check.h"

#include <ctype.h>
#include <dirent.h>
#include <unistd.h>

enum { MOST = 2000, WORD = 80 };

typedef struct {
    int n;
    char name[MOST][WORD];
} names;

static int has(const names *all, const char *name)
{
    for (int k = 0; k < all->n; k++)
        if (strcmp(all->name[k], name) == 0)
            return 1;
    return 0;
}

static void add(names *all, const char *name)
{
    if (has(all, name))
        return;
    assert_true(all->n < MOST);
    snprintf(all->name[all->n++], WORD, "%s", name);
}

static char *file_text(const char *path)
{
    static char text[200000];
    FILE *file = NOT_NULL(fopen(path, "r"));
    const size_t size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    assert_true(size < sizeof text - 1);
    text[size] = '\0';
    return text;
}

/* The text of a header without comments. */
static char *header_text(const char *path)
{
    char *text = file_text(path);
    for (char *open = strstr(text, "/*"); open; open = strstr(open, "/*")) {
        char *close = NOT_NULL(strstr(open, "*/"));
        memset(open, ' ', (size_t)(close + 2 - open));
    }
    return text;
}

/* Every function rb_...( and every variable behind extern. */
static void add_declared(const char *path, names *all)
{
    const char *text = header_text(path);
    char word[WORD];

    for (const char *at = strstr(text, "rb_"); at; at = strstr(at + 1, "rb_")) {
        size_t length = 0;
        if (at > text && (isalnum((unsigned char)at[-1]) || at[-1] == '_'))
            continue;
        while (isalnum((unsigned char)at[length]) || at[length] == '_')
            length++;
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        const char *line = at;
        while (line > text && line[-1] != ';' && line[-1] != '}' && line[-1] != '{')
            line--;
        while (isspace((unsigned char)*line))
            line++;
        const int is_type = strncmp(line, "typedef", 7) == 0;
        const int is_extern =
            strncmp(line, "extern", 6) == 0 && strchr(";,[", at[length + strspn(at + length, " ")]);
        if (!is_type && (at[length] == '(' || is_extern))
            add(all, word);
    }
}

static void declared(names *all)
{
    DIR *folder = NOT_NULL(opendir("include/rollbem"));
    char path[300];

    for (const struct dirent *e = readdir(folder); e; e = readdir(folder)) {
        const char *dot = strrchr(e->d_name, '.');
        snprintf(path, sizeof path, "include/rollbem/%.200s", e->d_name);
        if (dot && strcmp(dot, ".h") == 0)
            add_declared(path, all);
    }
    closedir(folder);
}

static const char *build_folder(void)
{
    const char *B = getenv("B");
    return B ? B : "build";
}

static void exported(names *all)
{
    char command[300], line[400], name[WORD], kind;

    snprintf(command, sizeof command, "nm -D --defined-only %s/librollbem.so", build_folder());
    FILE *nm = NOT_NULL(popen(command, "r"));
    while (fgets(line, sizeof line, nm))
        if (sscanf(line, "%*x %c %79s", &kind, name) == 2 && name[0] != '.') /* OpenMP's */
            add(all, name);
    assert_int_equal(pclose(nm), 0);
}

/* They add names of their own, and want to be linked first. */
static void skip_under_sanitizers(void)
{
    if (SANITIZED)
        skip();
}

TEST(exports_are_the_headers)
{
    static names in_headers, in_library;
    int strange = 0;

    skip_under_sanitizers();
    declared(&in_headers);
    exported(&in_library);
    assert_in_range(in_headers.n, 100, 200);
    for (int k = 0; k < in_library.n; k++)
        if (!has(&in_headers, in_library.name[k])) {
            print_error("%s is exported and in no header\n", in_library.name[k]);
            strange++;
        }
    for (int k = 0; k < in_headers.n; k++)
        if (!has(&in_library, in_headers.name[k])) {
            print_error("%s is declared and not exported\n", in_headers.name[k]);
            strange++;
        }
    assert_int_equal(strange, 0);
}

static int lines_of(const char *text)
{
    int lines = 0;
    for (const char *at = strchr(text, '\n'); at; at = strchr(at + 1, '\n'))
        lines++;
    return lines;
}

/* Every rb_... and RB_... of a text. */
static void add_words(const char *text, names *all)
{
    char word[WORD];
    for (const char *at = text; *at; at++) {
        size_t length = 0;
        if ((at > text && (isalnum((unsigned char)at[-1]) || at[-1] == '_')) ||
            (strncmp(at, "rb_", 3) != 0 && strncmp(at, "RB_", 3) != 0))
            continue;
        while (isalnum((unsigned char)at[length]) || at[length] == '_')
            length++;
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        add(all, word);
    }
}

/* Who has only the installed headers finds there whatever their comments name. */
TEST(comments_name_what_is_declared)
{
    static names in_code, in_all;
    char path[300];
    int strange = 0;

    DIR *folder = NOT_NULL(opendir("include/rollbem"));
    for (const struct dirent *e = readdir(folder); e; e = readdir(folder)) {
        snprintf(path, sizeof path, "include/rollbem/%.200s", e->d_name);
        if (!strstr(e->d_name, ".h"))
            continue;
        add_words(file_text(path), &in_all);
        add_words(header_text(path), &in_code);
    }
    closedir(folder);
    assert_in_range(in_code.n, 300, MOST - 1);
    for (int k = 0; k < in_all.n; k++)
        if (!has(&in_code, in_all.name[k])) {
            print_error("%s is named and not declared\n", in_all.name[k]);
            strange++;
        }
    assert_int_equal(strange, 0);
}

/* What docs/library.md says of them: the functions of each header, their sum, the lines. */
TEST(library_md_counts_the_headers)
{
    static char page[200000];
    static names of_header;
    char header[WORD], path[300];
    int functions, sum = 0, lines = 0, rows = 0, said_sum = 0, said_lines = 0;

    strcpy(page, file_text("docs/library.md"));
    assert_int_equal(sscanf(NOT_NULL(strstr(page, "what a caller needs: ")),
                            "what a caller needs: %d functions, on fewer than %d", &said_sum,
                            &said_lines),
                     2);
    for (const char *at = strstr(page, "\n| `"); at; at = strstr(at + 1, "\n| `")) {
        if (sscanf(at, "\n| `%70[a-z.]` | %d |", header, &functions) != 2)
            continue;
        snprintf(path, sizeof path, "include/rollbem/%s", header);
        of_header.n = 0;
        add_declared(path, &of_header);
        if (of_header.n != functions)
            print_error("%s has %d functions\n", header, of_header.n);
        assert_int_equal(of_header.n, functions);
        sum += functions;
        rows++;
    }
    assert_int_equal(rows, 10);
    assert_int_equal(sum, said_sum);
    assert_true(said_sum <= 160 && said_lines <= 2000);

    DIR *folder = NOT_NULL(opendir("include/rollbem"));
    for (const struct dirent *e = readdir(folder); e; e = readdir(folder)) {
        snprintf(path, sizeof path, "include/rollbem/%.200s", e->d_name);
        if (strstr(e->d_name, ".h"))
            lines += lines_of(file_text(path));
    }
    closedir(folder);
    assert_in_range(lines, said_lines - 200, said_lines - 1);
}

TEST(one_header_has_them_all)
{
    assert_int_equal(system("cd include && for h in rollbem/*.h; do [ $h = rollbem/rollbem.h ] || "
                            "grep -q \"include \\\"$h\\\"\" rollbem/rollbem.h || exit 1; done"),
                     0);
}

/* A C++ program with every header, linked to the shared library, solves a case. */
TEST(headers_serve_cxx)
{
    char command[900];

    skip_under_sanitizers();
    if (system("g++ --version >/dev/null 2>&1") != 0)
        skip();
    snprintf(command, sizeof command,
             "{ ls include/rollbem | sed 's|.*|#include <rollbem/&>|'; cat <<'END'\n"
             "int main()\n"
             "{\n"
             "    rb_api *a = rb_api_create();\n"
             "    const int ok = rb_api_set(a, \"contact-elements\", \"12\") == RB_OK &&\n"
             "                   rb_api_solve(a) == RB_OK && rb_version() != nullptr;\n"
             "    rb_api_free(a);\n"
             "    return ok ? 0 : 1;\n"
             "}\n"
             "END\n"
             "} > %s/tests/cxx.cpp && g++ -std=c++11 -Wall -Wextra -Wpedantic -Werror "
             "-Iinclude -o %s/tests/cxx %s/tests/cxx.cpp %s/librollbem.so && "
             "ln -sf ../librollbem.so %s/tests/librollbem.so.0 && "
             "LD_LIBRARY_PATH=%s/tests %s/tests/cxx",
             build_folder(), build_folder(), build_folder(), build_folder(), build_folder(),
             build_folder(), build_folder());
    assert_int_equal(system(command), 0);
}

RUN_TESTS(NULL, NULL)
