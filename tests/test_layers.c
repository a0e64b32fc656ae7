/* The layers of docs/architecture.md: a folder of src/ includes public headers of folders
 * below it and its own private ones, and its files call each other in no circle.  Tests
 * include public headers, unless their program is marked.  Run from the project's root. */
#include "check.h"

#include <dirent.h>
#include <unistd.h>

/* A folder and the public headers (without rollbem/ and .h) that it may include. */
static const struct {
    const char *folder, *headers;
} layers[] = {
    {"base", " base blas sparse units "},
    {"lcp", " base blas lcp "},
    {"bem", " base blas sparse bem "},
    {"io", " base sparse io io_fclib io_contact "},
    {"contact", " base lcp contact "},
    {"crack", " base lcp bem contact crack "},
    {"friction", " base blas sparse io io_fclib lcp contact friction "},
    {"fem", " base blas sparse friction fem "},
    {"rolling", " base blas units bem lcp contact rolling options closed_forms "},
    {"results", " base blas units bem lcp contact rolling options closed_forms "},
    {"history", " base blas units bem lcp contact rolling options closed_forms "},
    {"study", " base blas units bem lcp contact rolling options closed_forms "},
    {"sensitivity", " base blas contact rolling sensitivity "},
    {"case", " base units io contact crack rolling options sensitivity case "},
    {"design", " base rolling sensitivity case design "},
    {"api", " base blas sparse io lcp contact crack friction rolling closed_forms "
            "sensitivity case design api "},
    {"verify", " base bem crack rolling closed_forms verify "},
    {"report", " base blas sparse units bem lcp contact crack io friction fem rolling "
               "closed_forms sensitivity case design report "
               "report_fem "},
    {"certificate", " contact crack io case report certificate "},
};

/* Each may include the internal.h of the one before it, which includes that below it. */
static const char *const rooms[] = {"rolling", "results", "history", "study"};

/* The name between the quotes of an #include "FOLDER/NAME.h", split in two. */
static int included(const char *line, char folder[40], char name[40])
{
    return sscanf(line, "#include \"%39[^/\"]/%39[^.\"].h\"", folder, name) == 2;
}

static void check_line(const char *path, int number, const char *line, const char *own,
                       const char *headers)
{
    char folder[40], name[40], word[44];
    if (!included(line, folder, name) || strcmp(folder, own) == 0)
        return;
    /* the rooms above rolling share what rolling's files share */
    if (strcmp(name, "internal") == 0)
        for (size_t k = 1; k < sizeof rooms / sizeof *rooms; k++)
            if (strcmp(own, rooms[k]) == 0 && strcmp(folder, rooms[k - 1]) == 0)
                return;
    snprintf(word, sizeof word, " %s ", name);
    if (strcmp(folder, "rollbem") != 0 || !strstr(headers, word))
        fail_msg("%s:%d: %s may not include %s/%s.h", path, number, own, folder, name);
}

static int check_file(const char *path, const char *own, const char *headers)
{
    char line[400];
    int lines = 0;
    FILE *file = NOT_NULL(fopen(path, "r"));
    while (fgets(line, sizeof line, file))
        check_line(path, ++lines, line, own, headers);
    fclose(file);
    return lines;
}

TEST(folders_look_down_only)
{
    for (size_t k = 0; k < sizeof layers / sizeof *layers; k++) {
        char folder[80];
        int lines = 0;
        snprintf(folder, sizeof folder, "src/%s", layers[k].folder);
        DIR *d = NOT_NULL(opendir(folder));
        for (const struct dirent *e = readdir(d); e; e = readdir(d)) {
            const char *dot = strrchr(e->d_name, '.');
            char path[400];
            snprintf(path, sizeof path, "%s/%.250s", folder, e->d_name);
            if (dot && (strcmp(dot, ".c") == 0 || strcmp(dot, ".h") == 0))
                lines += check_file(path, layers[k].folder, layers[k].headers);
        }
        closedir(d);
        assert_true(lines > 0);
    }
}

/* Tests of what a caller cannot reach stand in programs of their own. */
TEST(marked_programs_alone_look_inside)
{
    int marked = 0;
    DIR *d = NOT_NULL(opendir("tests"));
    for (const struct dirent *e = readdir(d); e; e = readdir(d)) {
        const char *dot = strrchr(e->d_name, '.');
        char path[300], line[400], folder[40], name[40];
        if (!dot || (strcmp(dot, ".c") != 0 && strcmp(dot, ".h") != 0))
            continue;
        if (strncmp(e->d_name, "test_inside_", 12) == 0) {
            marked++;
            continue;
        }
        snprintf(path, sizeof path, "tests/%s", e->d_name);
        FILE *file = NOT_NULL(fopen(path, "r"));
        while (fgets(line, sizeof line, file))
            if (included(line, folder, name)) {
                char header[100];
                snprintf(header, sizeof header, "src/%s/%s.h", folder, name);
                if (strcmp(folder, "..") != 0 && access(header, R_OK) == 0)
                    fail_msg("%s may not include %s/%s.h", path, folder, name);
            }
        fclose(file);
    }
    closedir(d);
    assert_in_range(marked, 1, 25);
}

/* ---- Calls between files ----------------------------------------------------------- */

enum { FILES = 400, SYMBOLS = 10000, WORD = 120 };

static struct {
    int files, symbols;
    char file[FILES][WORD], symbol[SYMBOLS][WORD];
    int owner[SYMBOLS];       /* the file that defines it */
    char calls[FILES][FILES]; /* directly, then by way of others */
} all;

/* Its number; -1: an object whose source is gone. */
static int file_number(const char *object)
{
    char source[WORD];
    const char *at = strstr(object, "src/");
    if (!at || strstr(at, "src/mpi/"))
        return -1;
    snprintf(source, sizeof source, "%.*sc", (int)strlen(at) - 1, at);
    for (int k = all.files - 1; k >= 0; k--)
        if (strcmp(all.file[k], source) == 0)
            return k;
    if (access(source, R_OK) != 0)
        return -1;
    assert_true(all.files < FILES);
    strcpy(all.file[all.files], source);
    return all.files++;
}

static int owner_of(const char *symbol)
{
    for (int k = 0; k < all.symbols; k++)
        if (strcmp(all.symbol[k], symbol) == 0)
            return all.owner[k];
    return -1;
}

/* Each symbol that an object defines (first round) or wants (second round). */
static void read_symbols(int round)
{
    char command[200], line[600], object[WORD], symbol[WORD], kind;
    const char *build = getenv("B");
    snprintf(command, sizeof command, "nm -A -P %s/src/*/*.o", build ? build : "build");
    FILE *nm = NOT_NULL(popen(command, "r"));
    while (fgets(line, sizeof line, nm)) {
        if (sscanf(line, "%119[^:]: %119s %c", object, symbol, &kind) != 3)
            continue;
        const int file = file_number(object), wants = kind == 'U';
        if (file < 0 || wants != round || (!wants && !strchr("TDRBV", kind)))
            continue;
        if (!wants) {
            assert_true(all.symbols < SYMBOLS);
            strcpy(all.symbol[all.symbols], symbol);
            all.owner[all.symbols++] = file;
        } else if (owner_of(symbol) >= 0) {
            all.calls[file][owner_of(symbol)] = 1;
        }
    }
    assert_int_equal(pclose(nm), 0);
}

static void close_calls(void)
{
    for (int k = 0; k < all.files; k++)
        for (int i = 0; i < all.files; i++)
            for (int j = 0; all.calls[i][k] && j < all.files; j++)
                all.calls[i][j] |= all.calls[k][j];
}

/* A file and its helper may call each other; more than two in a circle may not. */
TEST(files_call_each_other_in_no_circle)
{
    int longest = 0;
    read_symbols(0);
    read_symbols(1);
    assert_true(all.files > 100 && all.symbols > 500);
    close_calls();
    for (int i = 0; i < all.files; i++) {
        int others = 0;
        for (int j = 0; j < all.files; j++)
            others += j != i && all.calls[i][j] && all.calls[j][i];
        if (others > 1)
            print_error("%s: in a circle of %d files\n", all.file[i], others + 1);
        longest = others > longest ? others : longest;
    }
    assert_true(longest <= 1);
}

RUN_TESTS(NULL, NULL)
