/* Plain tables of numbers. */
#include "rollbem/io.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t\r\n,";

typedef struct {
    const char *path;
    int columns, rows, room, line;
    double *x; /* row by row */
    rb_message *why;
} reading;

static rb_status make_room(reading *r)
{
    if (r->rows < r->room)
        return RB_OK;
    const int room = r->room ? 2 * r->room : 64;
    double *x = realloc(r->x, sizeof(double) * (size_t)room * (size_t)r->columns);
    if (!x)
        return rb_fail(r->why, RB_ENOMEM, "%s: out of memory", r->path);
    r->x = x;
    r->room = room;
    return RB_OK;
}

static rb_status read_row(reading *r, char *text)
{
    int n = 0;
    text[strcspn(text, "#")] = '\0';
    for (text += strspn(text, blanks); *text; text += strspn(text, blanks), n++) {
        char *end;
        const double v = strtod(text, &end);
        if (end == text || !isfinite(v) || (*end && !strchr(blanks, *end)))
            return rb_fail(r->why, RB_EFORMAT, "%s:%d: expected a number, got '%.*s'",
                           r->path, r->line, (int)strcspn(text, blanks), text);
        if (n < r->columns)
            r->x[r->rows * r->columns + n] = v;
        text = end;
    }
    if (n == 0)
        return RB_OK;
    if (n != r->columns)
        return rb_fail(r->why, RB_EFORMAT, "%s:%d: expected %d numbers, got %d", r->path,
                       r->line, r->columns, n);
    r->rows++;
    return RB_OK;
}

static rb_status read_rows(reading *r, FILE *file)
{
    char text[1000];
    rb_status s = RB_OK;
    while (s == RB_OK && fgets(text, sizeof text, file)) {
        r->line++;
        if (!strchr(text, '\n') && !feof(file))
            return rb_fail(r->why, RB_EFORMAT, "%s:%d: line too long", r->path, r->line);
        s = make_room(r);
        if (s == RB_OK)
            s = read_row(r, text);
    }
    if (s == RB_OK && ferror(file))
        s = rb_fail(r->why, RB_ENOENT, "%s: %s", r->path, strerror(errno));
    if (s == RB_OK && r->rows == 0)
        s = rb_fail(r->why, RB_EFORMAT, "%s: no numbers", r->path);
    return s;
}

static rb_status by_columns(const reading *r, double **x)
{
    *x = rb_alloc((size_t)r->rows, (size_t)r->columns);
    if (!*x)
        return rb_fail(r->why, RB_ENOMEM, "%s: out of memory", r->path);
    for (int i = 0; i < r->rows; i++)
        for (int j = 0; j < r->columns; j++)
            (*x)[i + j * r->rows] = r->x[i * r->columns + j];
    return RB_OK;
}

rb_status rb_io_read_columns(const char *path, int columns, int *rows, double **x,
                             rb_message *why)
{
    reading r = {.path = path, .columns = columns, .why = why};
    FILE *file = fopen(path, "r");
    *x = NULL;
    if (!file)
        return rb_fail(why, RB_ENOENT, "%s: %s", path, strerror(errno));
    rb_status s = read_rows(&r, file);
    fclose(file);
    if (s == RB_OK)
        s = by_columns(&r, x);
    *rows = s == RB_OK ? r.rows : 0;
    free(r.x);
    return s;
}
