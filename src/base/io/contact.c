/* Input files of CONTACT: which lines a case has follows from its control digits. */
#include "base/io/io_contact.h"

#include "base/io/io.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

typedef struct {
    const char *path;
    char *at; /* the next line */
    int line;
    rb_status status; /* of the first error */
    rb_message *why;
} reading;

/* ---- Lines ------------------------------------------------------------------------- */

/* What the next line that is neither blank nor a comment begins with; "": there is none. */
static char *find_line(reading *r)
{
    for (;;) {
        char *line = r->at + strspn(r->at, " \t\r");
        if (*line && *line != '%' && *line != '\n')
            return line;
        line += strcspn(line, "\n");
        if (!*line)
            return line;
        r->at = line + 1;
        r->line++;
    }
}

/* That line, ended; NULL: there is none. */
static char *next_line(reading *r)
{
    char *line = find_line(r);
    const size_t n = strcspn(line, "\n");
    if (n == 0)
        return NULL;
    r->line++;
    r->at = line + n + (line[n] == '\n');
    line[n] = '\0';
    return line;
}

static void skip_line(reading *r)
{
    if (r->status == RB_OK)
        next_line(r);
}

/* A line at which a case begins: the module, and behind it a comment.  Elsewhere the comment
 * has to be the word module. */
static int is_module_line(const char *line, int begins, int *module)
{
    line += strspn(line, " \t");
    const char *comment = line + 1 + strspn(line + 1, " \t\r");
    if (!isdigit((unsigned char)*line) || (comment == line + 1 && *comment && *comment != '\n'))
        return 0;
    *module = *line - '0';
    return strncasecmp(comment, "module", 6) == 0 ||
           (begins && !isdigit((unsigned char)*comment) && !strchr("+-.", *comment)) ||
           (begins && (!*comment || *comment == '\n'));
}

static void fail(reading *r, const char *names, const char *got)
{
    if (r->status == RB_OK)
        r->status = rb_fail(r->why, RB_EFORMAT, "%s:%d: expected %s, got '%.60s'", r->path, r->line,
                            names, got ? got : "the end of the file");
}

/* The next n numbers to the places of `to`, of one line or more; what stands behind them is
 * a comment.  A d behind an angle says degrees, and *degrees; D is Fortran's exponent.
 * NULL, as a place or for all: skipped. */
static void read_numbers(reading *r, int n, double *const *to, const char *names, int *degrees)
{
    const char *line = r->status == RB_OK ? next_line(r) : NULL, *at = line ? line : "";
    for (int k = 0; k < n && r->status == RB_OK; k++) {
        char *end;
        while (*at == '%' || *at == '\0' || *at == '\r') { /* they go on below */
            at = next_line(r);
            if (!at) {
                fail(r, names, line);
                return;
            }
        }
        const double value = rb_read_number(at, &end);
        if (end == at || !isfinite(value)) {
            fail(r, names, line);
            return;
        }
        if (to && to[k])
            *to[k] = value;
        if (degrees && k == 0)
            *degrees = *end == 'd';
        at = end + (*end == 'd') + strspn(end + (*end == 'd'), " \t,");
    }
}

/* x as the whole number that the names are. */
static int whole(reading *r, double x, const char *names)
{
    if (fabs(x) <= 1e9 && x == floor(x))
        return (int)x;
    if (r->status == RB_OK)
        r->status = rb_fail(r->why, RB_EFORMAT, "%s:%d: %s: expected whole numbers, got %g",
                            r->path, r->line, names, x);
    return 0;
}

/* Control digits to the places of `to`, the last one to the last; those that are not
 * written are 0.  NULL: not kept. */
static void read_digits(reading *r, int n, int *const *to, const char *names)
{
    char *line = r->status == RB_OK ? next_line(r) : NULL;
    const int length = line ? (int)strspn(line, "0123456789") : 0;
    if (r->status != RB_OK)
        return;
    if (length == 0 || length > n + 2) {
        fail(r, names, line);
        return;
    }
    for (int k = 0; k < n; k++)
        if (to[k])
            *to[k] = k < n - length ? 0 : line[length - n + k] - '0';
}

/* ---- A case ------------------------------------------------------------------------ */

/* from: left end of the first element, whichever way it is told. */
static void read_grid(reading *r, rb_io_contact_case *c)
{
    double x[6] = {0};
    double *const to[] = {x, x + 1, x + 2, x + 3, x + 4, x + 5};
    if (c->digit.D < 2)
        return;
    read_numbers(r, 1, to, "IPOTCN", NULL);
    c->potential = whole(r, x[0], "IPOTCN");
    if (c->potential == 0 || c->potential > 4) {
        char got[16];
        snprintf(got, sizeof got, "%d", c->potential);
        fail(r, "IPOTCN from 1 to 4, or negative", got);
    }
    read_numbers(r, c->potential > 0 || c->potential == -6 ? 6 : 5, to, "MX, MY and the grid",
                 NULL);
    if (r->status == RB_OK) {
        c->mx = whole(r, x[0], "MX");
        c->my = whole(r, x[1], "MY");
    }
    if (r->status != RB_OK)
        return;
    memcpy(c->hertz, x + 2, sizeof c->hertz);
    c->from = x[2];
    if (c->potential == 1 || c->potential == 3) {
        c->dx = x[4];
        c->dy = x[5];
    } else if (c->potential > 0) {
        const int ends = c->potential == 2; /* else midpoints of the outermost */
        c->dx = (x[4] - x[2]) / (c->mx - !ends);
        c->dy = (x[5] - x[3]) / (c->my - !ends);
    }
    if (c->potential >= 3)
        c->from -= c->dx / 2;
    if (c->mx < 1 || c->my < 1 ||
        (c->potential > 0 && (!isfinite(c->from) || !(c->from + c->mx * c->dx > c->from))))
        fail(r, "MX, MY >= 1 and DX > 0", "another grid");
}

static void read_gap(reading *r, rb_io_contact_case *c)
{
    double base = 0.0, plan = 0.0, heights = 0.0, *b = c->b;
    if (c->digit.Z < 2 || c->potential < 0)
        return;
    read_numbers(r, 2, (double *[]){&base, &plan}, "IBASE, IPLAN", NULL);
    c->base = whole(r, base, "IBASE");
    c->plan = whole(r, plan, "IPLAN");
    if (c->base == 1)
        read_numbers(r, 6, (double *[]){b, b + 1, b + 2, b + 3, b + 4, b + 5}, "B1, ..., B6", NULL);
    if (c->base == 2) {
        read_numbers(r, 5, (double *[]){&heights, &c->centre, &c->radius, NULL, NULL},
                     "NN, XM, RX1, Y1, DY1", NULL);
        read_numbers(r, whole(r, heights, "NN"), NULL, "the NN heights", NULL);
    }
    if (c->base == 3)
        read_numbers(r, 8, NULL, "the numbers of IBASE = 3", NULL);
    if (c->base == 9)
        read_numbers(r, c->mx * c->my, NULL, "the heights of all elements", NULL);
    if (c->plan == 2 || c->plan == 3)
        read_numbers(r, c->plan == 2 ? 6 : 8, NULL, "the numbers of IPLAN", NULL);
}

/* What every case has: control digits, iteration, motion, friction, material, grid, gap. */
static void read_case(reading *r, rb_io_contact_case *c)
{
    rb_io_contact_digits *d = &c->digit;
    int degrees = 0;
    *d = (rb_io_contact_digits){0};
    read_digits(r, 6, (int *[]){&d->P, &d->B, &d->T, &d->N, &d->F, &d->S},
                "the digits P-B-T-N-F-S");
    read_digits(r, 7, (int *[]){&d->V, &d->L, &d->D, &d->C, &d->M, &d->Z, &d->E},
                "the digits L-D-C-M-Z-E");
    read_digits(r, 8, (int *[]){&d->X, &d->H, &d->G, NULL, NULL, NULL, NULL, &d->R},
                "the digits X-H-G-I-A-O-W-R");
    if (d->X > 0)
        skip_line(r); /* of debugging */
    if (d->G != 1)
        read_numbers(r, 5, NULL, "MAXGS, MAXIN, MAXNR, MAXOUT, EPS", NULL);
    if (d->G == 4)
        read_numbers(r, 2, (double *[]){&c->start, NULL}, "INISLP, OMGSLP", NULL);
    else if (d->G == 2 || d->G == 3)
        read_numbers(r, 4, (double *[]){NULL, NULL, &c->start, NULL},
                     "OMEGAH, OMEGAS, INISLP, OMGSLP", NULL);
    else if (d->G > 4)
        skip_line(r);
    read_numbers(r, 4, (double *[]){&c->normal, &c->tangential, &c->side, &c->spin},
                 "FN or PEN, CKSI or FX, CETA or FY, CPHI", NULL);
    if (d->V != 0) /* friction stands elsewhere */
        return;
    c->law = d->L == 1 ? c->law : d->L;
    if (d->L == 0) {
        read_numbers(r, 2, (double *[]){&c->fstat, &c->fkin}, "FSTAT, FKIN", NULL);
    } else if (d->L == 6) {
        read_numbers(r, 4, (double *[]){&c->fstat, NULL, NULL, NULL}, "FREF, TREF, DFHEAT, DTHEAT",
                     NULL);
        c->fkin = c->fstat;
        read_numbers(r, 2, (double *[]){&c->memory, &c->memory_slip}, "MEMDST, MEM_S0", NULL);
    } else if (d->L > 1) {
        read_numbers(
            r, 5,
            (double *[]){&c->fkin, &c->fall[0], &c->slip_scale[0], &c->fall[1], &c->slip_scale[1]},
            "the coefficients of the friction law", NULL);
        c->fstat = d->L <= 4 ? c->fkin + c->fall[0] + c->fall[1] : c->fkin;
        read_numbers(r, 2, (double *[]){&c->memory, &c->memory_slip}, "MEMDST, MEM_S0", NULL);
    }
    if (d->C >= 2 && d->T >= 2) {
        read_numbers(r, 3, (double *[]){&c->chi, &c->dq, &c->velocity}, "CHI, DQ, VELOC", &degrees);
        c->chi *= degrees ? 1.0 : 180.0 / 3.14159265358979323846;
    }
    if (d->C >= 2)
        read_numbers(r, 4, (double *[]){&c->poisson[0], &c->poisson[1], &c->shear[0], &c->shear[1]},
                     "POISS(1), POISS(2), GG(1), GG(2)", NULL);
    if (d->C >= 2 && d->M > 0)
        read_numbers(r, d->M == 1 || d->M == 4 ? 4 : 1, /* of others no number is kept */
                     d->M == 1 ? (double *[]){&c->ratio[0], &c->ratio[1], &c->time[0], &c->time[1]}
                     : d->M == 4
                         ? (double *[]){&c->layer_shear, &c->layer, &c->yield, &c->hardening}
                         : NULL,
                     "the line of the material", NULL);
    for (int body = 0; body < 2 && d->H == 3; body++)
        read_numbers(r, 4, NULL, "BKTEMP, HEATCP, LAMBDA, DENS", NULL);
    if (d->H == 3 && d->M == 4)
        skip_line(r);
    read_grid(r, c);
    read_gap(r, c);
}

/* 1: all lines of the case are read.  Points below the surface and the like are not. */
static int is_whole(const reading *r, const rb_io_contact_case *c)
{
    const rb_io_contact_digits *d = &c->digit;
    return r->status == RB_OK && d->S < 2 && d->E < 9 && d->V == 0 && c->plan < 4;
}

/* 1: the module goes on with a case that has no line of its module, R = 0 or 2. */
static int stays(reading *r, const rb_io_contact_case *c)
{
    int module;
    return c->digit.R % 2 == 0 && is_whole(r, c) && isdigit((unsigned char)*find_line(r)) &&
           !is_module_line(find_line(r), 0, &module);
}

/* 1: the case takes over values or the state of the case before. */
static int takes_over(const rb_io_contact_case *c)
{
    const rb_io_contact_digits *d = &c->digit;
    return d->L == 1 || d->C < 2 || d->D < 2 || d->Z < 2 || ((d->T == 1 || d->T == 2) && d->P == 0);
}

/* Reads a case of module 3.  before: the values of the last one that was read; lost: 1 behind a
 * case that was not. */
static void read_or_tell(reading *r, const rb_io_contact_case *before, int *lost,
                         rb_io_contact_case *c)
{
    rb_message *why = r->why, own = {.text = ""};
    r->why = &own;
    read_case(r, c);
    r->why = why;
    if (r->status == RB_EFORMAT) {
        /* behind the name of the file, which the reader of the message knows */
        const char *text = strncmp(own.text, r->path, strlen(r->path)) == 0
                               ? own.text + strlen(r->path) + 1
                               : own.text;
        if (why && !why->text[0])
            *why = own;
        *c = *before;
        snprintf(c->unread, sizeof c->unread, "line %.190s", text);
        *lost = 1;
    } else if (*lost && takes_over(c)) {
        snprintf(c->unread, sizeof c->unread, "it takes over values of a case that is not read");
    } else
        *lost = c->digit.V != 0;
}

/* What a case has behind what is read here ends at the next line that says module. */
rb_status rb_io_contact_read(const char *path, int *n, rb_io_contact_case **cases, rb_message *why)
{
    rb_message first = {.text = ""}; /* why the first case that is not read is not */
    reading r = {.path = path, .why = why};
    rb_io_contact_case now = {.potential = 1};
    char *text, *line;
    size_t size;
    int module, begins = 1, lost = 0, read = 0;
    *n = 0;
    *cases = NULL;
    r.status = rb_io_read_text(path, &text, &size, why);
    if (r.status != RB_OK)
        return r.status;
    r.at = text;
    r.why = &first;
    while (r.status == RB_OK && (line = next_line(&r)) != NULL) {
        if (!is_module_line(line, begins, &module)) {
            begins = 0;
            continue;
        }
        if (module == 0)
            break;
        now.line = r.line;
        do {
            rb_io_contact_case *more = realloc(*cases, sizeof *more * (size_t)(*n + 1));
            if (!more) {
                r.status = RB_ENOMEM;
                break;
            }
            *cases = more;
            rb_io_contact_case one = now;
            one.module = module;
            if (module == 3)
                read_or_tell(&r, &now, &lost, &one);
            more[(*n)++] = one;
            read += !one.unread[0];
            begins = module == 3 && !one.unread[0] && is_whole(&r, &one);
            if (r.status == RB_EFORMAT) /* the next line of a module begins another case */
                r.status = RB_OK;
            else {
                now = one;
                now.unread[0] = '\0';
            }
            now.line = r.line + 1;
        } while (r.status == RB_OK && begins && stays(&r, &now));
    }
    if (r.status == RB_ENOMEM)
        rb_fail(why, RB_ENOMEM, "%s: out of memory", path);
    else if (*n == 0)
        r.status = rb_fail(why, RB_EFORMAT,
                           "%s: no line such as '3 MODULE': not an input file of CONTACT", path);
    else if (read == 0)
        r.status = rb_fail(why, RB_EFORMAT, "%s", first.text);
    if (r.status != RB_OK) {
        free(*cases);
        *cases = NULL;
        *n = 0;
    }
    free(text);
    return r.status;
}
