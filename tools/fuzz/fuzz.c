#include "fuzz.h"

#include "base/io/child.h"

#include <hdf5.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const fuzz_target fuzz_targets[] = {{"ini", fuzz_ini},
                                    {"options", fuzz_options},
                                    {"gap", fuzz_gap},
                                    {"history", fuzz_history},
                                    {"table", fuzz_table},
                                    {"study", fuzz_study},
                                    {"resume", fuzz_resume},
                                    {"check", fuzz_check},
                                    {"siconos", fuzz_siconos},
                                    {"matrix-market", fuzz_matrix_market},
                                    {"lcp-text", fuzz_lcp_text},
                                    {"fclib", fuzz_fclib},
                                    {"contact", fuzz_contact},
                                    {"lemke", fuzz_lemke},
                                    {"friction", fuzz_friction},
                                    {"handle", fuzz_handle},
                                    {"", NULL}};

static char folder[] = "/tmp/rollbem-fuzz-XXXXXX";

int fuzz_begin(void)
{
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

void fuzz_end(void)
{
    char command[60];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (chdir("/") != 0 || system(command) != 0)
        fprintf(stderr, "%s cannot be removed\n", folder);
}

void fuzz_require(int holds, const char *property)
{
    if (holds)
        return;
    fprintf(stderr, "does not hold: %s\n", property);
    abort();
}

void fuzz_require_reason(rb_status s, const rb_message *why)
{
    const size_t n = strnlen(why->text, sizeof why->text);
    fuzz_require(s >= RB_EHELPER && s <= RB_INTERRUPTED, "a status is a known one");
    fuzz_require(n < sizeof why->text, "a message ends");
    fuzz_require(s == RB_OK || n > 0, "a refusal says why");
    fuzz_require(s == RB_OK || !strchr(why->text, '\n'), "a refusal is one line");
}

void fuzz_write(const char *name, const void *data, size_t size)
{
    FILE *file = fopen(name, "wb");
    const int written = file && fwrite(data, 1, size, file) == size && fclose(file) == 0;
    fuzz_require(written, "the working folder has room");
}

/* The name and the bytes that fuzz_keep was given last. */
static struct {
    const char *name;
    const void *data;
    size_t size;
} kept;

void fuzz_keep(const char *name, const void *data, size_t size)
{
    kept.name = name;
    kept.data = data;
    kept.size = size;
}

/* The linker puts __wrap_fopen in the place of fopen (FUZZ_WRAP of the Makefile). */
FILE *__real_fopen(const char *path, const char *mode);
FILE *__wrap_fopen(const char *path, const char *mode);

FILE *__wrap_fopen(const char *path, const char *mode)
{
    if (!kept.name || mode[0] != 'r' || strcmp(path, kept.name) != 0)
        return __real_fopen(path, mode);
    /* a stream that is read from does not write to its memory */
    return fmemopen((void *)(uintptr_t)kept.data, kept.size, "r");
}

/* With FUZZ_IN_PROCESS, HDF5 works in this process: a process for each file takes a
 * hundred times as long.  Where HDF5 crashes, so does this process then. */
rb_status __real_rb_io_in_child(const char *name, io_work *work, const void *context, char **bytes,
                                size_t *size, rb_message *why);
rb_status __wrap_rb_io_in_child(const char *name, io_work *work, const void *context, char **bytes,
                                size_t *size, rb_message *why);

/* What the end of a process would close. */
static void close_files(void)
{
    hid_t id[64];
    ssize_t n;
    while ((n = H5Fget_obj_ids(H5F_OBJ_ALL, H5F_OBJ_ALL & ~H5F_OBJ_FILE, 64, id)) > 0)
        while (n > 0)
            H5Oclose(id[--n]);
    n = H5Fget_obj_ids(H5F_OBJ_ALL, H5F_OBJ_FILE, 64, id);
    while (n > 0)
        H5Fclose(id[--n]);
}

rb_status __wrap_rb_io_in_child(const char *name, io_work *work, const void *context, char **bytes,
                                size_t *size, rb_message *why)
{
    const char *here = getenv("FUZZ_IN_PROCESS");
    if (!here || !*here)
        return __real_rb_io_in_child(name, work, context, bytes, size, why);
    *bytes = NULL;
    FILE *out = open_memstream(bytes, size);
    fuzz_require(out != NULL, "there is memory");
    const rb_status s = work(out, context, why);
    fclose(out);
    close_files();
    if (s != RB_OK) {
        free(*bytes);
        *bytes = NULL;
    }
    return s;
}

char *fuzz_read(const char *name, size_t *size)
{
    FILE *file = fopen(name, "rb");
    fuzz_require(file != NULL, "the file is there");
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char *text = calloc(*size + 1, 1);
    fuzz_require(text && fread(text, 1, *size, file) == *size, "the file can be read");
    fclose(file);
    return text;
}

char *fuzz_text(const uint8_t *data, size_t size)
{
    char *text = calloc(size + 1, 1);
    fuzz_require(text != NULL, "there is memory");
    if (size > 0)
        memcpy(text, data, size);
    return text;
}

int fuzz_byte(fuzz_bytes *b)
{
    return b->at < b->end ? *b->at++ : 0;
}

int fuzz_choice(fuzz_bytes *b, int n)
{
    return fuzz_byte(b) % n;
}

double fuzz_number(fuzz_bytes *b)
{
    static const double special[] = {
        0.0,     -0.0,     0.5,   1.0 / 3.0,   1e-300, -1e300,
        1e300,   5e-324,   1e-16, 1.0 + 1e-15, 1e8,    -1e-8,
        1.7e308, -1.7e308, 1e-12, 1e154,       -1e154, 2.2250738585072014e-308};
    enum { SPECIAL = sizeof special / sizeof special[0] };
    const int kind = fuzz_byte(b);
    if (kind < 200)
        return (kind - 100) / 4.0;
    if (kind < 200 + SPECIAL)
        return special[kind - 200];
    if (kind < 240)
        return pow(10.0, kind - 229) * (fuzz_byte(b) - 128);
    double x = 0.0;
    uint8_t raw[sizeof x];
    for (size_t k = 0; k < sizeof raw; k++)
        raw[k] = (uint8_t)fuzz_byte(b);
    memcpy(&x, raw, sizeof x);
    return isfinite(x) ? x : 1.0;
}
