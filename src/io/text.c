/* Input files as text. */
#include "io/tokens.h"
#include "rollbem/io.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

char *rb_io_read_all(FILE *file, size_t *size)
{
    size_t room = 0, got;
    char *text = NULL;
    *size = 0;
    do {
        if (*size + 1 >= room) {
            room = room ? 2 * room : 1 << 12;
            char *larger = realloc(text, room);
            if (!larger) {
                free(text);
                return NULL;
            }
            text = larger;
        }
        got = fread(text + *size, 1, room - *size - 1, file);
        *size += got;
    } while (got);
    if (ferror(file)) {
        free(text);
        return NULL;
    }
    text[*size] = '\0';
    return text;
}

static rb_status cannot_read(const char *path, rb_message *why)
{
    return errno == ENOMEM ? rb_fail(why, RB_ENOMEM, "%s: out of memory", path)
                           : rb_fail(why, RB_ENOENT, "%s: %s", path, strerror(errno));
}

/* What is no text is said to be none, before anything takes it for malformed numbers. */
static rb_status check_text(const char *path, const char *text, size_t size,
                            rb_message *why)
{
    if (size >= 2 &&
        (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "\xfe\xff", 2) == 0))
        return rb_fail(why, RB_EFORMAT, "%s: UTF-16 text, expected ASCII or UTF-8", path);
    const char *zero = memchr(text, '\0', size);
    if (!zero)
        return RB_OK;
    int line = 1;
    for (const char *c = text; c < zero; c++)
        line += *c == '\n';
    return rb_fail(why, RB_EFORMAT, "%s:%d: a zero byte, expected text", path, line);
}

rb_status rb_io_read_text(const char *path, char **text, size_t *size, rb_message *why)
{
    struct stat st;
    *text = NULL;
    FILE *file = fopen(path, "rb");
    if (!file)
        return cannot_read(path, why);
    if (fstat(fileno(file), &st) == 0 && S_ISDIR(st.st_mode))
        errno = EISDIR;
    else
        *text = rb_io_read_all(file, size);
    rb_status s = *text ? check_text(path, *text, *size, why) : cannot_read(path, why);
    fclose(file);
    if (s == RB_OK && strncmp(*text, "\xef\xbb\xbf", 3) == 0) /* some editors' mark */
        memset(*text, ' ', 3);
    if (s != RB_OK) {
        free(*text);
        *text = NULL;
    }
    return s;
}
