/* The layers of docs/architecture.md: a folder of src/ includes public headers of folders
 * below it and its own private ones.  Run from the project's root. */
#include "check.h"

#include <dirent.h>
#include <string.h>

/* A folder and the public headers (without rollbem/ and .h) that it may include. */
static const struct {
    const char *folder, *headers;
} layers[] = {
    {"base", " base blas sparse units "},
    {"lcp", " base blas lcp "},
    {"bem", " base blas sparse bem "},
    {"io", " base sparse io io_fclib io_contact "},
    {"contact", " base lcp contact "},
    {"friction", " base blas sparse io io_fclib lcp contact friction "},
    {"fem", " base blas sparse friction fem "},
    {"rolling", " base blas bem lcp contact rolling closed_forms "},
    {"case", " base io contact rolling case "},
    {"api", " base blas sparse io lcp contact friction rolling case api "},
    {"verify", " base bem rolling closed_forms verify "},
    {"report", " base blas sparse units bem lcp contact io friction fem rolling "
               "closed_forms case report "
               "report_fem "},
};

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
    snprintf(word, sizeof word, " %s ", name);
    if (strcmp(folder, "rollbem") != 0 || !strstr(headers, word))
        fail_msg("%s:%d: %s may not include %s/%s.h", path, number, own, folder, name);
}

static int check_file(const char *path, const char *own, const char *headers)
{
    char line[400];
    int lines = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        check_line(path, ++lines, line, own, headers);
    fclose(file);
    return lines;
}

static void folders_look_down_only(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof layers / sizeof *layers; k++) {
        char folder[80];
        int lines = 0;
        snprintf(folder, sizeof folder, "src/%s", layers[k].folder);
        DIR *d = opendir(folder);
        assert_non_null(d);
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(folders_look_down_only)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
