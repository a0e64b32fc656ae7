#define _XOPEN_SOURCE 700 /* realpath */
/* Input files as text. */
#include "base/io/tokens.h"
#include "base/io/io.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A pipe does not say how much there is to come. */
static const size_t largest_file = (size_t)1 << 31, largest_from_pipe = (size_t)1 << 28,
                    largest_harmless = (size_t)1 << 26;

char *rb_io_read_all(FILE *file, size_t most, size_t *size)
{
    size_t capacity = 0, got;
    char *text = NULL;
    *size = 0;
    do {
        if (*size + 1 >= capacity) {
            capacity = capacity ? 2 * capacity : 1 << 12;
            char *larger = realloc(text, capacity);
            if (!larger) {
                free(text);
                return NULL;
            }
            text = larger;
        }
        got = fread(text + *size, 1, capacity - *size - 1, file);
        *size += got;
    } while (got && *size <= most);
    if (ferror(file) || *size > most) {
        if (*size > most)
            errno = EFBIG;
        free(text);
        return NULL;
    }
    text[*size] = '\0';
    return text;
}

static rb_status too_large(const char *path, size_t most, rb_message *why)
{
    return rb_fail(why, RB_EFORMAT, "%s: more than %zu MB, expected a text", path, most >> 20);
}

static rb_status cannot_read(const char *path, rb_message *why)
{
    return errno == ENOMEM ? rb_fail(why, RB_ENOMEM, "%s: out of memory", path)
                           : rb_fail(why, RB_ENOENT, "%s: %s", path, strerror(errno));
}

/* UTF-16 behind its byte-order mark, as UTF-8.  RB_EFORMAT: half a character. */
static rb_status from_utf16(const char *path, char **text, size_t *size, rb_message *why)
{
    const unsigned char *from = (const unsigned char *)*text;
    const int high = from[0] == 0xfe ? 0 : 1; /* place of the high byte */
    char *to = malloc(*size / 2 * 3 + 1);     /* at most three bytes for two */
    size_t n = 0;
    unsigned long half = 0; /* of a pair; 0: none is open */
    int broken = *size % 2 != 0;
    if (!to)
        return rb_fail(why, RB_ENOMEM, "%s: out of memory", path);
    for (size_t k = 2; k + 1 < *size && !broken; k += 2) {
        unsigned long c = (unsigned long)from[k + (size_t)high] << 8 | from[k + (size_t)!high];
        const int opens = c >= 0xd800 && c < 0xdc00, closes = c >= 0xdc00 && c < 0xe000;
        broken = (half != 0) != closes;
        if (opens) {
            half = c;
            continue;
        }
        c = closes ? 0x10000 + ((half - 0xd800) << 10) + (c - 0xdc00) : c;
        half = 0;
        const int bytes = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
        static const unsigned char lead[] = {0, 0, 0xc0, 0xe0, 0xf0};
        to[n++] = (char)(lead[bytes] | c >> 6 * (bytes - 1));
        for (int b = bytes - 2; b >= 0; b--)
            to[n++] = (char)(0x80 | (c >> 6 * b & 0x3f));
    }
    to[n] = '\0';
    free(*text);
    *text = to;
    *size = n;
    return broken || half ? rb_fail(why, RB_EFORMAT, "%s: half a character of UTF-16", path)
                          : RB_OK;
}

/* What a file of another format is by its first bytes and the ending of its name, and what reads
 * it; NULL: nothing that is known. */
static const char *known_format(const char *path, const char *text, size_t size)
{
    static const struct {
        const char *begins;
        size_t n;
        const char *ending, *what; /* ending NULL: any */
    } formats[] = {
        {"\x93NUMPY", 6, NULL, "an array of NumPy (.npy); the Python package reads it"},
        {"PK\3\4", 4, ".npz", "arrays of NumPy (.npz); the Python package reads them"},
        {"PK\3\4", 4, ".xlsx", "an Excel workbook; save it as CSV"},
        {"PK\3\4", 4, ".ods", "a spreadsheet; save it as CSV"},
        {"PK\3\4", 4, NULL, "a zip archive; the Python package reads the arrays of NumPy's"},
        {"\xd0\xcf\x11\xe0", 4, NULL, "an Excel workbook; save it as CSV"},
        {"MATLAB 5.0", 10, NULL, "a file of MATLAB (.mat); the Python package reads it"},
        {"\x89HDF", 4, NULL,
         "an HDF5 file; those of FCLib are read by rollbem friction, those of MATLAB 7.3 by the "
         "Python package"},
        {"\x1f\x8b", 2, NULL, "compressed by gzip; unpack it"},
        {"NFG ", 4, NULL, "a game of Gambit (.nfg); the Python package reads it: rollbem.game"}};
    const char *ending = strrchr(path, '.');
    for (size_t k = 0; k < sizeof formats / sizeof *formats; k++)
        if (size >= formats[k].n && memcmp(text, formats[k].begins, formats[k].n) == 0 &&
            (!formats[k].ending || (ending && strcmp(ending, formats[k].ending) == 0)))
            return formats[k].what;
    return NULL;
}

static rb_status read_text(const char *path, int utf16, char **text, size_t *size, rb_message *why)
{
    struct stat st, null;
    *text = NULL;
    FILE *file = fopen(path, "rb");
    if (!file)
        return cannot_read(path, why);
    const int known = fstat(fileno(file), &st) == 0;
    /* Of the devices terminals end, and /dev/null is empty. */
    if (known &&
        (S_ISBLK(st.st_mode) || (S_ISCHR(st.st_mode) && !isatty(fileno(file)) &&
                                 !(stat("/dev/null", &null) == 0 && null.st_rdev == st.st_rdev)))) {
        fclose(file);
        return rb_fail(why, RB_EFORMAT, "%s: a device, expected a file or a pipe", path);
    }
    const size_t most = known && !S_ISREG(st.st_mode) ? largest_from_pipe : largest_file;
    errno = 0;
    if (known && S_ISDIR(st.st_mode))
        errno = EISDIR;
    else
        *text = rb_io_read_all(file, most, size);
    if (!*text && errno == EFBIG) {
        fclose(file);
        return too_large(path, most, why);
    }
    rb_status s = *text ? RB_OK : cannot_read(path, why);
    fclose(file);
    if (s == RB_OK && *size >= 2 &&
        (memcmp(*text, "\xff\xfe", 2) == 0 || memcmp(*text, "\xfe\xff", 2) == 0))
        s = utf16 ? from_utf16(path, text, size, why)
                  : rb_fail(why, RB_EFORMAT, "%s: UTF-16 text, expected ASCII or UTF-8", path);
    const char *format = s == RB_OK ? known_format(path, *text, *size) : NULL;
    if (format)
        s = rb_fail(why, RB_EFORMAT, "%s: expected text, got %s", path, format);
    /* What is no text is said to be none, before anything takes it for malformed numbers. */
    const char *zero = s == RB_OK ? memchr(*text, '\0', *size) : NULL;
    if (zero) {
        int line = 1;
        for (const char *c = *text; c < zero; c++)
            line += *c == '\n';
        s = rb_fail(why, RB_EFORMAT, "%s:%d: a zero byte, expected text", path, line);
    }
    if (s == RB_OK && strncmp(*text, "\xef\xbb\xbf", 3) == 0) /* some editors' mark */
        memset(*text, ' ', 3);
    if (s != RB_OK) {
        free(*text);
        *text = NULL;
    }
    return s;
}

rb_status rb_io_read_text(const char *path, char **text, size_t *size, rb_message *why)
{
    return read_text(path, 0, text, size, why);
}

rb_status rb_io_read_spreadsheet(const char *path, char **text, size_t *size, rb_message *why)
{
    return read_text(path, 1, text, size, why);
}

rb_status rb_io_check_harmless(const char *path, const char *folder, rb_message *why)
{
    struct stat st;
    if (stat(path, &st) != 0)
        return cannot_read(path, why);
    if (!S_ISREG(st.st_mode))
        return rb_fail(why, RB_EFORMAT, "%s: expected a regular file", path);
    if ((unsigned long long)st.st_size > largest_harmless)
        return too_large(path, largest_harmless, why);
    if (!folder)
        return RB_OK;
    /* The canonical path of the folder is the beginning of that of the file. */
    char *file = realpath(path, NULL), *above = file ? realpath(folder, NULL) : NULL;
    rb_status s = RB_OK;
    if (!file || !above)
        s = cannot_read(file ? folder : path, why);
    else {
        size_t n = strlen(above);
        while (n > 0 && above[n - 1] == '/')
            n--;
        if (strncmp(file, above, n) != 0 || file[n] != '/')
            s = rb_fail(why, RB_EFORMAT, "%s: not in the folder %s", path, folder);
    }
    free(file);
    free(above);
    return s;
}
