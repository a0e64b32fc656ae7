/* The layers of docs/contributing.md: a folder of src/, or examples/fem, includes public headers of
 * folders below it and its own private ones, and its files call each other in no circle.  Tests
 * include public headers, unless their program is marked.  Run from the project's root. */
#include "check.h"

#include <dirent.h>
#include <unistd.h>

/* A folder and the headers, public or doors (without folder and .h), that it may include. */
static const struct {
    const char *folder, *headers;
} layers[] = {
    {"base", " base blas sparse units "},
    {"base/io", " base units sparse io io_fclib io_contact "},
    {"bem", " base sizes blas gmres sparse bem "},
    {"bem/mesh", " bem boundary "},
    {"bem/layers", " blas bem "},
    {"bem/products", " blas sizes bem "},
    {"bem/hierarchical", " base blas bem boundary "},
    {"lcp/lemke", " base sizes blas lcp "},
    {"lcp/portfolio", " base sizes blas lcp "},
    {"lcp/proof", " base lcp "},
    {"lcp/contact", " base sizes gmres lcp contact "},
    {"lcp/friction", " base sizes blas sparse io io_fclib lcp contact friction "},
    {"rolling/case", " base sizes units io io_contact bem boundary rolling options case "},
    {"rolling/body", " base sizes blas units bem boundary lcp contact rolling options "},
    {"rolling/solve", " base sizes blas units bem lcp contact rolling options "},
    {"rolling/stress", " bem rolling "},
    {"rolling/results", " base units rolling "},
    {"rolling/notes", " base units bem rolling "},
    {"rolling/history", " base blas units bem lcp contact rolling options "},
    {"rolling/study", " base blas units bem lcp contact rolling options "},
    {"rolling", " base sizes units bem contact rolling options "},
    {"analysis/crack", " base lcp bem contact crack rolling case "},
    {"analysis/sensitivity", " derivatives base blas contact rolling options sensitivity case "},
    {"analysis/fit", " derivatives base io contact rolling options sensitivity case "},
    {"analysis/design", " derivatives base rolling sensitivity case "},
    {"analysis/prony", " base io lcp "},
    {"program/api", " base blas sparse io lcp contact crack friction rolling "
                    "sensitivity case api "},
    {"program/verify", " base bem crack rolling "},
    {"program/report", " base blas sparse units bem lcp contact crack io friction rolling "
                       "sensitivity case "},
    {"program/certificate", " contact crack io case "},
    {"examples/fem", " base sparse friction report "},
};

/* What rooms show each other besides: a folder, and a private header of another that it may
 * include. */
static const struct {
    const char *folder, *header;
} shared[] = {
    {"lcp/portfolio", "lcp/lemke/lemke"},
    {"lcp/portfolio", "lcp/proof/bounds"},
    {"lcp/portfolio", "lcp/proof/exact"},
    {"lcp/portfolio", "lcp/proof/farkas"},
    {"lcp/portfolio", "lcp/proof/linear"},
    {"lcp/lemke", "lcp/proof/farkas"},
    {"lcp/proof", "lcp/lemke/lemke"},
    {"lcp/proof", "lcp/lemke/scale"},
    {"lcp/friction", "lcp/proof/absent"},
    {"lcp/friction", "lcp/proof/bounds"},
    {"lcp/friction", "lcp/portfolio/enumerate"},
    {"rolling/solve", "rolling/case/closed_forms"},
    {"rolling/study", "rolling/case/closed_forms"},
    {"rolling/body", "rolling/case/closed_forms"},
    {"program/certificate", "program/report/report"},
    {"analysis/crack", "rolling/case/words"},
    {"analysis/sensitivity", "rolling/case/words"},
    {"analysis/fit", "rolling/case/words"},
    {"examples/fem", "program/report/internal"},
};

/* What the folders of one room include of each other besides: a folder, and headers of the others,
 * each named for its topic. */
static const struct {
    const char *part, *headers;
} parts[] = {
    {"bem", " hierarchical/given hierarchical/hierarchical hierarchical/skeleton layers/layer "
            "layers/ring "},
    {"bem/mesh", " internal "},
    {"bem/layers", " internal surface "},
    {"bem/products", " internal layers/layer surface wheel "},
    {"bem/hierarchical", " column incompressible internal kernels "},
    {"rolling/case", " body/body body/gap body/internal body/mesh history/history rolling "
                     "notes/notes solve/law solve/pressed solve/resolution "},
    {"rolling/body", " case/check case/derived case/inputs case/internal solve/model "
                     "solve/variant "},
    {"rolling/solve", " body/body body/far_field body/former_place body/gap body/internal "
                      "body/interpolant body/mesh body/perturbation body/surface case/derived "
                      "case/check case/ellipse case/inputs case/internal notes/note "
                      "results/columns results/results stress/field stress/stress study/study "},
    {"rolling/stress", " body/body body/internal body/surface case/internal results/columns "
                       "results/results solve/given_tractions solve/heat solve/model "
                       "solve/patches "},
    {"rolling/results", " case/ellipse case/inputs case/internal history/history solve/solution "
                        "stress/stress study/study "},
    {"rolling/notes", " body/internal body/interpolant body/mesh case/ellipse case/inputs "
                      "case/internal results/results solve/law solve/patches "
                      "solve/resolution solve/solution solve/zone "},
    {"rolling/history",
     " body/body body/former_place body/internal body/mesh body/surface case/derived "
     "case/check case/inputs case/internal results/columns results/results solve/cycle "
     "solve/formulation solve/heat solve/law solve/law_iteration solve/model solve/patches "
     "solve/power solve/resolution solve/solution solve/variant solve/zone stress/field "
     "stress/stress "},
    {"rolling/study", " body/body body/mesh case/check case/derived case/ellipse case/internal "
                      "history/history history/internal history/wear notes/notes "
                      "results/columns solve/fit solve/formulation solve/law "
                      "solve/law_iteration solve/model solve/patches solve/resolution "
                      "solve/power solve/solution solve/zone stress/stress "},
    {"rolling", " body/body body/gap case/derived history/history history/wear notes/notes "
                "results/results solve/formulation solve/law_iteration solve/model "
                "solve/pressed solve/resolution solve/solution solve/temperature "
                "solve/variant solve/zone stress/stress study/study "},
};

/* The folders are of one room, src/ROOM, whose `own` lists the header FOLDER/NAME among its parts.
 */
static int is_shared_in_room(const char *own, const char *folder, const char *name)
{
    const size_t room = strcspn(own, "/");
    if (strncmp(own, folder, room) != 0 || (folder[room] != '\0' && folder[room] != '/'))
        return 0;
    char header[84];
    snprintf(header, sizeof header, folder[room] ? " %s/%s " : "%s %s ",
             folder[room] ? folder + room + 1 : "", name);
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
        if (strcmp(own, parts[k].part) == 0 && strstr(parts[k].headers, header))
            return 1;
    return 0;
}

/* The name between the quotes of an #include "FOLDER/NAME.h", split in two; FOLDER may be one
 * inside another. */
static int included(const char *line, char folder[40], char name[40])
{
    char path[80];
    if (sscanf(line, "#include \"%79[^.\"].h\"", path) != 1)
        return 0;
    char *slash = strrchr(path, '/');
    if (!slash || slash - path > 39 || strlen(slash) > 39)
        return 0;
    *slash = '\0';
    strcpy(folder, path);
    strcpy(name, slash + 1);
    return 1;
}

/* Of a file src/ROOM/...: base 0, bem and lcp 1, rolling 2, analysis 3, program 4. */
static int height_of(const char *file)
{
    static const char *const rooms[] = {"base", "bem lcp", "rolling", "analysis", "program"};
    char room[120];
    if (sscanf(file, "src/%119[^/]", room) != 1)
        return -1;
    for (int k = 0; k < 5; k++)
        if (strstr(rooms[k], room))
            return k;
    return -1;
}

/* A header by which a folder is used from others: src/a/b/b.h, and few others. */
static int is_door(const char *folder, const char *name)
{
    static const char others[] =
        " base/blas base/gmres base/sizes base/sparse base/units bem/boundary "
        "base/io/io_contact "
        "base/io/io_fclib rolling/case/closed_forms "
        "rolling/case/options rolling/case/rubber "
        "analysis/sensitivity/derivatives "
        "analysis/crack/crack_case analysis/fit/fit_case ";
    const char *slash = strrchr(folder, '/');
    char header[84];
    snprintf(header, sizeof header, " %s/%s ", folder, name);
    return strcmp(slash ? slash + 1 : folder, name) == 0 || strstr(others, header) != NULL;
}

static void check_line(const char *path, int number, const char *line, const char *own,
                       const char *headers)
{
    char folder[40], name[40], word[44];
    if (!included(line, folder, name) || strcmp(folder, own) == 0 ||
        (strcmp(folder, "fem") == 0 && strcmp(own, "examples/fem") == 0))
        return;
    char file[84], own_file[84];
    snprintf(file, sizeof file, "src/%s/", folder);
    snprintf(own_file, sizeof own_file, "src/%s/", own);
    if (is_door(folder, name) && height_of(file) >= 0 && height_of(file) < height_of(own_file))
        return;
    for (size_t k = 0; k < sizeof shared / sizeof *shared; k++) {
        char header[84];
        snprintf(header, sizeof header, "%s/%s", folder, name);
        if (strcmp(own, shared[k].folder) == 0 && strcmp(header, shared[k].header) == 0)
            return;
    }
    if (is_shared_in_room(own, folder, name))
        return;
    snprintf(word, sizeof word, " %s ", name);
    if ((strcmp(folder, "rollbem") != 0 && !is_door(folder, name)) || !strstr(headers, word))
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
        snprintf(folder, sizeof folder, "%s%s",
                 strncmp(layers[k].folder, "examples/", 9) == 0 ? "" : "src/", layers[k].folder);
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

/* Tests include public headers and doors; what a caller cannot reach is tested in programs of their
 * own. */
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
                if (strcmp(folder, "..") != 0 && !is_door(folder, name) &&
                    access(header, R_OK) == 0)
                    fail_msg("%s may not include %s/%s.h", path, folder, name);
            }
        fclose(file);
    }
    closedir(d);
    assert_in_range(marked, 1, 25);
}

/* ---- Calls between files ----------------------------------------------------------- */

enum { FILES = 500, SYMBOLS = 10000, WORD = 120 };

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
    if (!at || strstr(at, "src/program/mpi/"))
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
    snprintf(command, sizeof command, "cd %s && nm -A -P src/*/*.o src/*/*/*.o",
             build ? build : "build");
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

/* What the objects call, whatever they include. */
TEST(rooms_call_down_only)
{
    read_symbols(0);
    read_symbols(1);
    assert_true(all.files > 100 && all.symbols > 500);
    for (int i = 0; i < all.files; i++)
        for (int j = 0; j < all.files; j++) {
            const int from = height_of(all.file[i]), to = height_of(all.file[j]);
            if (!all.calls[i][j] || from < 0 || to < 0 || from > to)
                continue;
            const size_t room = strcspn(all.file[i] + 4, "/") + 4;
            if (from < to || strncmp(all.file[i], all.file[j], room + 1) != 0)
                fail_msg("%s calls %s", all.file[i], all.file[j]);
        }
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
