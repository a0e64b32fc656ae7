/* Input files of CONTACT: which lines a case has follows from its control digits. */
#include "rollbem/io_contact.h"

#include "rollbem/io.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

static int is_module_line(const char *line, int *module)
{
    int n = 0;
    return sscanf(line, "%d%n", module, &n) == 1 &&
           strncmp(line + n + strspn(line + n, " \t"), "MODULE", 6) == 0;
}

static void fail(reading *r, const char *names, const char *got)
{
    if (r->status == RB_OK)
        r->status = rb_fail(r->why, RB_EFORMAT, "%s:%d: expected %s, got '%.60s'", r->path, r->line,
                            names, got ? got : "the end of the file");
}

/* The next n numbers, of one line or more; what stands behind them is a comment.  A d
 * behind an angle says degrees, and *degrees; D is Fortran's exponent.  x NULL: they are
 * skipped. */
static void read_numbers(reading *r, int n, double *x, const char *names, int *degrees)
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
        if (x)
            x[k] = value;
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

/* The last n of the control digits, the rest of x is 0. */
static void read_digits(reading *r, int n, int *x, const char *names)
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
        x[k] = k < n - length ? 0 : line[length - n + k] - '0';
}

/* ---- A case ------------------------------------------------------------------------ */

static void read_control(reading *r, rb_io_contact_digits *d)
{
    int x[8] = {0};
    read_digits(r, 6, x, "the digits P-B-T-N-F-S");
    *d = (rb_io_contact_digits){.P = x[0], .B = x[1], .T = x[2], .N = x[3], .F = x[4], .S = x[5]};
    read_digits(r, 7, x, "the digits L-D-C-M-Z-E");
    d->V = x[0];
    d->L = x[1];
    d->D = x[2];
    d->C = x[3];
    d->M = x[4];
    d->Z = x[5];
    d->E = x[6];
    read_digits(r, 8, x, "the digits X-H-G-I-A-O-W-R");
    d->X = x[0];
    d->H = x[1];
    d->G = x[2];
    d->R = x[7];
    if (d->X > 0 && r->status == RB_OK)
        next_line(r); /* of debugging */
}

static void read_iteration(reading *r, rb_io_contact_case *c)
{
    const int G = c->digit.G;
    double x[5] = {0};
    if (G != 1)
        read_numbers(r, 5, x, "MAXGS, MAXIN, MAXNR, MAXOUT, EPS", NULL);
    if (G == 4) {
        read_numbers(r, 2, x, "INISLP, OMGSLP", NULL);
        c->start = x[0];
    } else if (G == 2 || G == 3) {
        read_numbers(r, 4, x, "OMEGAH, OMEGAS, INISLP, OMGSLP", NULL);
        c->start = x[2];
    } else if (G > 4 && r->status == RB_OK) {
        next_line(r);
    }
}

static void read_friction(reading *r, rb_io_contact_case *c)
{
    double x[5] = {0};
    c->law = c->digit.L == 1 ? c->law : c->digit.L;
    if (c->digit.L == 0) {
        read_numbers(r, 2, x, "FSTAT, FKIN", NULL);
        c->fstat = x[0];
        c->fkin = x[1];
    } else if (c->digit.L > 1) {
        read_numbers(r, 5, x, "the coefficients of the friction law", NULL);
        c->fkin = x[0];
        c->fstat = c->digit.L <= 4 ? x[0] + x[1] + x[3] : x[0];
        for (int k = 0; k < 2; k++) {
            c->fall[k] = x[1 + 2 * k];
            c->slip_scale[k] = x[2 + 2 * k];
        }
        read_numbers(r, 2, x, "MEMDST, MEM_S0", NULL);
        c->memory = x[0];
        c->memory_slip = x[1];
    }
}

static void read_material(reading *r, rb_io_contact_case *c)
{
    double x[4] = {0};
    int degrees = 0;
    if (c->digit.C < 2)
        return;
    if (c->digit.T >= 2) {
        read_numbers(r, 3, x, "CHI, DQ, VELOC", &degrees);
        c->chi = degrees ? x[0] : x[0] * 180.0 / 3.14159265358979323846;
        c->dq = x[1];
        c->velocity = x[2];
    }
    read_numbers(r, 4, x, "POISS(1), POISS(2), GG(1), GG(2)", NULL);
    memcpy(c->poisson, x, sizeof c->poisson);
    memcpy(c->shear, x + 2, sizeof c->shear);
    if (c->digit.M > 0)
        read_numbers(r, 4, x, "the line of the material", NULL);
    if (c->digit.M == 1) {
        memcpy(c->ratio, x, sizeof c->ratio);
        memcpy(c->time, x + 2, sizeof c->time);
    } else if (c->digit.M == 4) {
        c->layer_shear = x[0];
        c->layer = x[1];
        c->yield = x[2];
        c->hardening = x[3];
    }
}

/* from: left end of the first element, whichever way it is told. */
static void read_grid(reading *r, rb_io_contact_case *c)
{
    double x[6] = {0};
    if (c->digit.D < 2)
        return;
    read_numbers(r, 1, x, "IPOTCN", NULL);
    c->potential = whole(r, x[0], "IPOTCN");
    if (c->potential == 0 || c->potential > 4) {
        char got[16];
        snprintf(got, sizeof got, "%d", c->potential);
        fail(r, "IPOTCN from 1 to 4, or negative", got);
    }
    read_numbers(r, c->potential > 0 || c->potential == -6 ? 6 : 5, x, "MX, MY and the grid", NULL);
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
    double x[6] = {0};
    if (c->digit.Z < 2 || c->potential < 0)
        return;
    read_numbers(r, 2, x, "IBASE, IPLAN", NULL);
    c->base = whole(r, x[0], "IBASE");
    c->plan = whole(r, x[1], "IPLAN");
    if (c->base == 1)
        read_numbers(r, 6, c->b, "B1, ..., B6", NULL);
    if (c->base == 2) {
        read_numbers(r, 5, x, "NN, XM, RX1, Y1, DY1", NULL);
        c->centre = x[1];
        c->radius = x[2];
        read_numbers(r, whole(r, x[0], "NN"), NULL, "the NN heights", NULL);
    }
    if (c->base == 3)
        read_numbers(r, 8, NULL, "the numbers of IBASE = 3", NULL);
    if (c->base == 9)
        read_numbers(r, c->mx * c->my, NULL, "the heights of all elements", NULL);
    if (c->plan == 2 || c->plan == 3)
        read_numbers(r, c->plan == 2 ? 6 : 8, NULL, "the numbers of IPLAN", NULL);
}

/* 1: the module goes on with a case that has no line MODULE of its own, R = 0 or 2;
 * behind points below the surface and the like it is not found. */
static int stays(reading *r, const rb_io_contact_case *c)
{
    const rb_io_contact_digits *d = &c->digit;
    int module;
    return d->R % 2 == 0 && d->S < 2 && d->E < 9 && d->V == 0 && c->plan < 4 &&
           isdigit((unsigned char)*find_line(r)) && !is_module_line(r->at, &module);
}

/* What a case has behind what is read here ends at the next line that says MODULE. */
rb_status rb_io_contact_read(const char *path, int *n, rb_io_contact_case **cases, rb_message *why)
{
    reading r = {.path = path, .why = why};
    rb_io_contact_case now = {.potential = 1};
    char *text, *line;
    size_t size;
    int module;
    *n = 0;
    *cases = NULL;
    r.status = rb_io_read_text(path, &text, &size, why);
    if (r.status != RB_OK)
        return r.status;
    r.at = text;
    while (r.status == RB_OK && (line = next_line(&r)) != NULL) {
        if (!is_module_line(line, &module))
            continue;
        if (module == 0)
            break;
        now.line = r.line;
        do {
            rb_io_contact_case *more = realloc(*cases, sizeof *more * (size_t)(*n + 1));
            if (!more) {
                r.status = rb_fail(why, RB_ENOMEM, "%s: out of memory", path);
                break;
            }
            *cases = more;
            now.module = module;
            if (module == 3) {
                double x[4] = {0};
                read_control(&r, &now.digit);
                read_iteration(&r, &now);
                read_numbers(&r, 4, x, "FN or PEN, CKSI or FX, CETA or FY, CPHI", NULL);
                now.normal = x[0];
                now.tangential = x[1];
                now.side = x[2];
                now.spin = x[3];
            }
            if (module == 3 && now.digit.V == 0) { /* else friction stands elsewhere */
                read_friction(&r, &now);
                read_material(&r, &now);
                double x[4] = {0};
                for (int body = 0; body < 2 && now.digit.H == 3; body++)
                    read_numbers(&r, 4, x, "BKTEMP, HEATCP, LAMBDA, DENS", NULL);
                if (now.digit.H == 3 && now.digit.M == 4 && r.status == RB_OK)
                    next_line(&r);
                read_grid(&r, &now);
                read_gap(&r, &now);
            }
            more[(*n)++] = now;
            now.line = r.line + 1;
        } while (r.status == RB_OK && module == 3 && stays(&r, &now));
    }
    if (r.status == RB_OK && *n == 0)
        r.status = rb_fail(why, RB_EFORMAT,
                           "%s: no line such as '3 MODULE': not an input file of CONTACT", path);
    if (r.status != RB_OK) {
        free(*cases);
        *cases = NULL;
        *n = 0;
    }
    free(text);
    return r.status;
}
