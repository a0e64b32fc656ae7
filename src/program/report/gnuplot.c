/* Pictures by gnuplot: script on its stdin, picture from its stdout, so that no file name
 * ever enters a script or a shell. */
#include "program/report/internal.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

/* ---- The program ------------------------------------------------------------------- */

/* A file without a name that gnuplot does not inherit. */
static FILE *temporary(void)
{
    FILE *file = tmpfile();
    if (file)
        fcntl(fileno(file), F_SETFD, FD_CLOEXEC);
    return file;
}

static rb_status no_temporary(rb_message *why)
{
    return errno == ENOMEM ? rb_fail(why, RB_ENOMEM, "out of memory")
                           : rb_fail(why, RB_EWRITE, "temporary file: %s", strerror(errno));
}

/* -d: without the start-up files of the machine and of the user.  From its standard input
 * gnuplot reads byte by byte, a system call for each; from a file of any name it reads in
 * blocks. */
static int spawn(FILE *script, FILE *picture, FILE *errors, pid_t *pid)
{
    char *const argv[] = {"gnuplot", "-d", "/dev/stdin", NULL};
    posix_spawn_file_actions_t actions;
    int e = posix_spawn_file_actions_init(&actions);
    if (e)
        return e;
    e = posix_spawn_file_actions_adddup2(&actions, fileno(script), 0);
    if (!e)
        e = posix_spawn_file_actions_adddup2(&actions, fileno(picture), 1);
    if (!e)
        e = posix_spawn_file_actions_adddup2(&actions, fileno(errors), 2);
    if (!e) {
        /* Whatever else is open, by the caller of the library too, is none of gnuplot's
         * business. */
        enum { MOST = 4096 }; /* a limit of a thousand million is not unheard of */
        const long limit = sysconf(_SC_OPEN_MAX);
        e = 0;
        for (int fd = 3; !e && fd < MOST && (limit < 0 || fd < limit); fd++)
            if (fcntl(fd, F_GETFD) >= 0)
                e = posix_spawn_file_actions_addclose(&actions, fd);
    }
    if (!e)
        e = posix_spawnp(pid, argv[0], &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    return e;
}

static rb_status missing(int e, rb_message *why)
{
    if (e == ENOENT)
        return rb_fail(why, RB_EHELPER,
                       "gnuplot is not installed; pictures need it (package gnuplot-nox)");
    if (e == ENOMEM)
        return rb_fail(why, RB_ENOMEM, "gnuplot does not start: out of memory");
    return rb_fail(why, RB_EHELPER, "gnuplot does not start: %s", strerror(e));
}

static rb_status wait_for(pid_t pid, double seconds, FILE *errors, rb_message *why)
{
    const struct timespec pause = {.tv_nsec = 2000000};
    const double end = rb_seconds() + seconds;
    int status;
    pid_t ended;
    while ((ended = waitpid(pid, &status, WNOHANG)) == 0 && rb_seconds() < end)
        nanosleep(&pause, NULL);
    if (ended == 0) {
        kill(pid, SIGKILL);
        waitpid(pid, &status, 0);
        return rb_fail(why, RB_EHELPER, "gnuplot took longer than %g s", seconds);
    }
    if (ended < 0)
        return rb_fail(why, RB_EHELPER, "gnuplot: %s", strerror(errno));
    /* posix_spawn may report a missing program only by this exit status */
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        return missing(ENOENT, why);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        /* The line that says what was wrong comes last, after the lines it points at; below it
         * stands how many frames a .gif has. */
        char line[200], last[200] = "no message";
        rewind(errors);
        while (fgets(line, sizeof line, errors)) {
            line[strcspn(line, "\n")] = '\0';
            if (line[strspn(line, " ^")] && !strstr(line, "frames in animation"))
                memcpy(last, line, sizeof last);
        }
        return rb_fail(why, RB_EHELPER, "gnuplot failed: %s", last);
    }
    return RB_OK;
}

/* ---- The picture ------------------------------------------------------------------- */

/* What a kind is called, and how a whole picture of it begins and ends, line ends apart. */
static const struct {
    const char *ending, *begin, *end;
    size_t end_size;
} kinds[] = {[RB_REPORT_PNG] = {".png", "\x89PNG\r\n\x1a\n", "IEND\xae\x42\x60\x82", 8},
             [RB_REPORT_SVG] = {".svg", "<?xml", "</svg>", 6},
             [RB_REPORT_PDF] = {".pdf", "%PDF-", "%%EOF", 5},
             [RB_REPORT_EPS] = {".eps", "%!PS-Adobe-", "%%EOF", 5},
             [RB_REPORT_TEX] = {".tex", "\\begin{tikz", "gnuplot variables", 17},
             [RB_REPORT_GIF] = {".gif", "GIF89a", ";", 1}};

/* gnuplot does not say that its output could not be written. */
static int is_whole(FILE *picture, rb_report_picture_kind kind)
{
    char head[16] = "", tail[20];
    rewind(picture);
    if (fread(head, 1, strlen(kinds[kind].begin), picture) == 0 ||
        strcmp(head, kinds[kind].begin) != 0 || fseek(picture, -(long)sizeof tail, SEEK_END) != 0 ||
        fread(tail, 1, sizeof tail, picture) != sizeof tail)
        return 0;
    size_t n = sizeof tail;
    while (n > 0 && strchr("\r\n", tail[n - 1]))
        n--;
    const size_t size = kinds[kind].end_size;
    return n >= size && memcmp(tail + n - size, kinds[kind].end, size) == 0;
}

static rb_status copy(FILE *picture, FILE *out)
{
    char buffer[1 << 14];
    size_t n;
    while ((n = fread(buffer, 1, sizeof buffer, picture)) > 0 && fwrite(buffer, 1, n, out) == n)
        ;
    return ferror(picture) || ferror(out) ? RB_EWRITE : RB_OK;
}

rb_status rb_report_gnuplot(FILE *script, rb_report_picture_kind kind, double seconds, FILE *out,
                            rb_message *why)
{
    FILE *picture = temporary(), *errors = picture ? temporary() : NULL;
    rb_status s = RB_OK;
    if (!errors || fflush(script) != 0 || ferror(script))
        s = no_temporary(why);
    else {
        pid_t pid;
        rewind(script);
        const int e = spawn(script, picture, errors, &pid);
        s = e ? missing(e, why) : wait_for(pid, seconds, errors, why);
        if (s == RB_OK && !is_whole(picture, kind))
            s = rb_fail(why, RB_EWRITE,
                        "gnuplot wrote a part of the picture only (is the disk full?)");
    }
    if (s == RB_OK) {
        rewind(picture);
        s = (kind == RB_REPORT_TEX ? rb_report_tex : copy)(picture, out);
        if (s == RB_EWRITE)
            rb_fail(why, s, "cannot write: %s", strerror(errno));
        else if (s != RB_OK)
            rb_fail(why, s, "out of memory");
    }
    if (errors)
        fclose(errors);
    if (picture)
        fclose(picture);
    return s;
}

/* ---- Kinds and shapes -------------------------------------------------------------- */

rb_status rb_report_picture_kind_of(const char *path, rb_report_picture_kind *kind, rb_message *why)
{
    const size_t n = strlen(path);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (n > 4 && strcmp(path + n - 4, kinds[k].ending) == 0) {
            *kind = (rb_report_picture_kind)k;
            return RB_OK;
        }
    return rb_fail(
        why, RB_EINVAL,
        "expected a name ending in " RB_REPORT_KINDS " (of a history also .gif), got '%s'", path);
}

enum { SHAPES = 4 };

#define ON_WHITE " background '#ffffff' enhanced"
/* PDF and EPS are the same page. */
#define ON_PAPER                                                                                   \
    "DejaVu Sans", ON_WHITE, "in", 1, {10, 12, 13.33, 13.33}, {7.5, 5, 7.5, 7.5},                  \
        {21, 19, 20, 20}, {1.6, 1.6, 1.5, 1.5}, 21

/* Each shape in its own size: width and height in `unit`, of which an inch has so many.
 * The key needs its font named: svg would take a larger one.  LaTeX sets the letters of its
 * document, of this size. */
static const struct {
    const char *terminal, *font_name, *options, *unit;
    double inch, width[SHAPES], height[SHAPES], font[SHAPES], line[SHAPES], key_font;
} looks[] = {{"pngcairo",
              "DejaVu Sans",
              ON_WHITE,
              "",
              300,
              {1600, 1800, 1920, 1920},
              {1200, 750, 1080, 1080},
              {24, 20, 24, 24},
              {2.2, 2.2, 2.0, 2.0},
              24},
             {"svg",
              "DejaVu Sans",
              ON_WHITE,
              "",
              96,
              {1000, 1200, 1280, 1280},
              {750, 500, 720, 720},
              {18, 14, 18, 18},
              {1.5, 1.5, 1.4, 1.4},
              15},
             {"pdfcairo", ON_PAPER},
             {"epscairo", ON_PAPER},
             {"tikz",
              "",
              "",
              "in",
              1,
              {4.75, 6, 6, 6},
              {3.56, 2.5, 3.375, 3.375},
              {6.5, 6, 6.5, 6.5},
              {0.8, 0.8, 0.8, 0.8},
              6.5},
             {"gif animate delay 25 loop 0",
              "DejaVu Sans",
              ON_WHITE,
              "",
              96,
              {800, 1000, 1000, 1000},
              {600, 417, 563, 563},
              {12, 12, 12, 12},
              {1.2, 1.2, 1.2, 1.2},
              12}};

/* Sizes that are asked for: width, 0: that of a screen; letters are so much larger, as a
 * part of the width, than in the shape's own size (alike: in four thirds, so that they
 * are as large in every picture); width over height, 0: the shape's.  In a column panels
 * that are side by side elsewhere lie below each other. */
static const struct {
    double inches, letters, ratio[SHAPES];
    int alike;
} sizes[] = {[RB_REPORT_85MM] = {85 / 25.4, 1.65, {1.0, 0.82, 1.0, 0.6}, 1},
             [RB_REPORT_170MM] = {170 / 25.4, 1.0, {0.0}, 0},
             [RB_REPORT_SLIDE] = {0.0, 0.85, {16.0 / 9.0, 16.0 / 9.0, 16.0 / 9.0, 16.0 / 9.0}, 1}};

typedef struct {
    double width, height, letters; /* letters: against those of the shape's own size */
} extent;

static extent extent_of(rb_report_canvas canvas, rb_report_shape shape)
{
    const double width = looks[canvas.kind].width[shape];
    const double height = looks[canvas.kind].height[shape];
    if (canvas.size == RB_REPORT_OWN_SIZE)
        return (extent){width, height, 1.0};
    const double inches = sizes[canvas.size].inches;
    const double wanted = inches > 0.0 ? inches * looks[canvas.kind].inch
                                       : looks[canvas.kind].width[RB_REPORT_SCREEN];
    const double ratio = sizes[canvas.size].ratio[shape];
    const int like = sizes[canvas.size].alike ? RB_REPORT_FOUR_THIRDS : (int)shape;
    return (extent){wanted, ratio > 0.0 ? wanted / ratio : wanted * height / width,
                    sizes[canvas.size].letters * wanted / looks[canvas.kind].width[like] *
                        looks[canvas.kind].font[like] / looks[canvas.kind].font[shape]};
}

double rb_report_key_font(rb_report_canvas canvas)
{
    return looks[canvas.kind].key_font * extent_of(canvas, RB_REPORT_FOUR_THIRDS).letters;
}

int rb_report_zone(const rb_rolling_solution *s, int i)
{
    const int frictionless = s->mu ? s->mu[i] == 0.0 : isnan(s->force_ratio);
    return frictionless && s->zone[i] != RB_ZONE_SEPARATED ? RB_REPORT_FRICTIONLESS : s->zone[i];
}

void rb_report_letters_in(rb_report_canvas canvas, rb_report_shape shape, double font,
                          double letters[2])
{
    const extent e = extent_of(canvas, shape);
    const double points = strcmp(looks[canvas.kind].unit, "in") == 0 ? 72.0 : 1.0;
    letters[0] = e.width * points / font;
    letters[1] = e.height * points / font;
}

double rb_report_width_over_height(rb_report_canvas canvas, rb_report_shape shape)
{
    const extent e = extent_of(canvas, shape);
    return e.width / e.height;
}

rb_report_place rb_report_place_of(rb_report_canvas canvas)
{
    return canvas.size == RB_REPORT_85MM ? (rb_report_place){0, 0.065, 0.045}
                                         : (rb_report_place){1, 0.0, 0.0};
}

/* ---- Templates --------------------------------------------------------------------- */

/* The files of the folder pictures, line by line. */
static const struct {
    const char *picture, *line;
} templates[] = {
#include "pictures.inc"
};

void rb_report_let(FILE *script, const char *name, double x)
{
    char text[RB_NUMBER_TEXT];

    if (!isfinite(x))
        fprintf(script, "%s = NaN\n", name);
    else { /* gnuplot divides whole numbers as C does */
        rb_number_text(x, text);
        fprintf(script, "%s = %s%s\n", name, text, strpbrk(text, ".e") ? "" : ".0");
    }
}

void rb_report_let_whole(FILE *script, const char *name, int n)
{
    fprintf(script, "%s = %d\n", name, n);
}

void rb_report_let_text(FILE *script, const char *name, const char *format, ...)
{
    char text[4000];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fprintf(script, "%s = '", name);
    for (const char *at = text; *at; at++)
        fprintf(script, *at == '\'' ? "''" : *at == '\n' ? " " : "%c", *at);
    fputs("'\n", script);
}

void rb_report_let_units(FILE *script, rb_units units)
{
    rb_report_let_text(script, "mm", "%s", rb_unit_name(units, "mm"));
    rb_report_let_text(script, "MPa", "%s", rb_unit_name(units, "MPa"));
    rb_report_let_text(script, "N_mm", "%s", rb_unit_name(units, "N/mm"));
}

void rb_report_let_table(FILE *script, const char *name, rb_report_write_table *write,
                         const void *of)
{
    fprintf(script, "$%s << EOD\n", name);
    (void)write(script, of, &(rb_report_style){.bare = 1}); /* the script keeps its errors */
    fputs("EOD\n", script);
}

/* What holds for all templates, a lecturer's too. */
static void write_canvas(FILE *script, rb_report_canvas canvas, rb_report_shape shape)
{
    const extent e = extent_of(canvas, shape);
    const int k = canvas.kind;
    const rb_report_place place = rb_report_place_of(canvas);

    fprintf(
        script,
        "set encoding utf8\nset terminal %s size %.4g%s,%.4g%s font '%s,%.3g' linewidth %.3g%s\n"
        "set tics out nomirror\nset border 3 linecolor rgb '#444444' linewidth 0.7\n",
        looks[k].terminal, e.width, looks[k].unit, e.height, looks[k].unit, looks[k].font_name,
        looks[k].font[shape] * e.letters, looks[k].line[shape] * e.letters, looks[k].options);
    rb_report_let_whole(script, "titled", place.titled);
    rb_report_let_whole(script, "slide", canvas.size == RB_REPORT_SLIDE);
    rb_report_let(script, "right", place.right);
    rb_report_let(script, "up", place.up);
    fprintf(script, "key_font = ',%.3g'\n", rb_report_key_font(canvas));
    /* gnuplot draws markers larger in svg */
    rb_report_let(script, "marker", canvas.kind == RB_REPORT_SVG ? 0.45 : 1.0);
}

static void write_template(FILE *script, const char *picture)
{
    for (size_t k = 0; k < sizeof templates / sizeof *templates; k++)
        if (strcmp(templates[k].picture, picture) == 0)
            fputs(templates[k].line, script);
}

rb_status rb_report_draw(FILE *out, rb_report_canvas canvas, rb_report_shape shape,
                         const char *picture, rb_report_script *inputs, const void *view,
                         rb_message *why)
{
    enum { SECONDS = 120 }; /* the largest picture takes one or two */
    FILE *file = canvas.script ? out : temporary();
    if (!file)
        return no_temporary(why);
    void *before = rb_locale_begin();
    write_canvas(file, canvas, shape);
    inputs(file, canvas, view);
    rb_locale_end(before);
    write_template(file, "common");
    if (canvas.own)
        fputs(canvas.own, file);
    else
        write_template(file, picture);
    if (canvas.script)
        return rb_report_flush(out);
    rb_status s = rb_report_gnuplot(file, canvas.kind, SECONDS, out, why);
    if (s == RB_EHELPER && canvas.own && why && strncmp(why->text, "gnuplot failed", 14) == 0)
        s = RB_EFORMAT; /* a template of ours would be right */
    fclose(file);
    return s;
}
