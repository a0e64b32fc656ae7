/* An independent judge of what rollbem prints: it shares no source with the library and
 * reads only what the program wrote.  From the printed tractions it computes loads, laws
 * of contact and friction, and on half-planes also the displacements again, by Flamant's
 * integrals in long double.
 *
 *     checker [--table FILE] [--summary FILE] [--controls FILE] RESULT.json
 *
 * RESULT.json: of the same command with --json.  --table: its traction table; --summary:
 * its standard error; --controls: the table given to --history.  One line for each law
 * that is violated; exit 1 when there is one, 2 when a file cannot be read. */
#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
static int violations;

/* One line for each law: the first place where it is violated. */
static void violated(const char *law, const char *format, ...)
{
    static const char *told[200];
    va_list args;
    violations++;
    for (int k = 0; k < 200; k++) {
        if (told[k] && strcmp(told[k], law) == 0)
            return;
        if (!told[k]) {
            told[k] = law;
            break;
        }
    }
    va_start(args, format);
    printf("%s: ", law);
    vprintf(format, args);
    putchar('\n');
    va_end(args);
}

static void cannot(const char *what, const char *name)
{
    fprintf(stderr, "checker: cannot %s %s\n", what, name);
    exit(2);
}

/* |got - want| <= tol; NAN is equal to nothing. */
static void expect(const char *law, double got, double want, double tol)
{
    if (!(fabs(got - want) <= tol))
        violated(law, "%.17g, expected %.17g (difference %.2g, allowed %.2g)", got, want,
                 got - want, tol);
}

/* ---- What the program wrote -------------------------------------------------------- */

enum { X, H, GAP, P, Q, UN, UT, SHIFT, SLIP, ZONE, COLUMNS };
static const char *const column_names[COLUMNS] = {"x_mm",  "h_mm",  "gap_mm",   "p_MPa", "q_MPa",
                                                  "un_mm", "ut_mm", "shift_mm", "slip",  "zone"};
enum { SEPARATED, STICK, SLIP_NEGATIVE, SLIP_POSITIVE, YIELD_NEGATIVE, YIELD_POSITIVE };

typedef struct {
    int n;
    double *column[COLUMNS];
} table;

/* A body of the case; young = 0: rigid.  young, poisson: of the first layer, if it has some. */
typedef struct {
    double young, poisson, radius, datum;
    int halfplane;
    int layers;
    double *layer;                   /* layers x thickness, young, poisson; owned */
    double base_young, base_poisson; /* below them; base_young = 0: rigid */
} body;

typedef struct {
    const json_t *inputs, *summary;
    const json_t *worn, *plastic; /* per element, or NULL */
    body a, b;
    double mu, modulus, radius; /* largest coefficient of friction, E*, combined R */
    double period;              /* NAN: one contact alone */
    double last_mu;             /* of the law, in the last row of a history */
    double *mu_of;              /* of every element, by the friction law */
    int moves;                  /* 1: the law depends on the state */
    int surface_normals;
    enum { STATIC, STEADY, TRANSIENT } formulation;
    int steps; /* 1: a static history or a transient */
} contact;

static double *doubles(size_t n)
{
    double *x = calloc(n ? n : 1, sizeof *x);
    if (!x)
        cannot("find memory for", "a table");
    return x;
}

static double number(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

static const char *word(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

static table table_from_json(const json_t *object)
{
    table t = {(int)json_array_size(json_object_get(object, "x_mm")), {NULL}};
    for (int j = 0; j < COLUMNS; j++) {
        const json_t *list = json_object_get(object, column_names[j]);
        t.column[j] = doubles((size_t)t.n);
        if ((int)json_array_size(list) != t.n)
            violated("JSON table", "%s has %zu entries, x_mm %d", column_names[j],
                     json_array_size(list), t.n);
        for (int i = 0; i < t.n; i++) {
            const json_t *value = json_array_get(list, (size_t)i);
            t.column[j][i] = json_is_number(value) ? json_number_value(value) : NAN;
        }
    }
    return t;
}

/* The numbers of a line; how many. */
static int numbers_of(const char *line, double *value, int room)
{
    int n = 0;
    char *end;
    while (n < room) {
        value[n] = strtod(line, &end);
        if (end == line)
            break;
        line = end;
        n++;
    }
    return n;
}

/* Rows of numbers among # lines; header: the line of names, the last # line where there
 * is none. */
typedef struct {
    int rows, columns;
    double *x; /* row by row */
    char header[1000];
} rows;

static rows rows_from_file(const char *path)
{
    enum { WIDEST = 64 };
    static char line[20000];
    double value[WIDEST];
    rows r = {0, 0, NULL, ""};
    int named = 0;
    FILE *file = fopen(path, "r");
    if (!file)
        cannot("read", path);
    while (fgets(line, sizeof line, file)) {
        const char *text = line + strspn(line, "# \t");
        if (line[0] == '#' || numbers_of(text, value, 1) == 0) {
            if (named)
                continue;
            named = line[0] != '#';
            snprintf(r.header, sizeof r.header, "%.*s", (int)strcspn(text, "\n"), text);
            continue;
        }
        const int n = numbers_of(line, value, WIDEST);
        if (r.columns && n != r.columns)
            violated(path, "row %d has %d numbers, expected %d", r.rows + 1, n, r.columns);
        r.columns = r.columns ? r.columns : n;
        r.x = realloc(r.x, (size_t)(r.rows + 1) * (size_t)r.columns * sizeof *r.x);
        if (!r.x)
            cannot("find memory for", path);
        memcpy(r.x + (size_t)r.rows * (size_t)r.columns, value, (size_t)r.columns * sizeof *value);
        r.rows++;
    }
    fclose(file);
    return r;
}

/* Where `name` stands among the tab-separated or blank-separated names; -1: nowhere. */
static int column_of(const char *header, const char *name)
{
    int at = 0;
    for (const char *p = header; *p; at++) {
        const size_t n = strcspn(p, " \t");
        if (n == strlen(name) && strncmp(p, name, n) == 0)
            return at;
        p += n;
        p += strspn(p, " \t");
    }
    return -1;
}

static table table_from_file(const char *path)
{
    const rows r = rows_from_file(path);
    table t = {r.rows, {NULL}};
    for (int j = 0; j < COLUMNS; j++) {
        const int k = column_of(r.header, column_names[j]);
        if (k != j)
            violated("table", "%s: column %d is not %s", path, j + 1, column_names[j]);
        t.column[j] = doubles((size_t)t.n);
        for (int i = 0; i < t.n && j < r.columns; i++)
            t.column[j][i] = r.x[i * r.columns + j];
    }
    free(r.x);
    return t;
}

static void table_free(table *t)
{
    for (int j = 0; j < COLUMNS; j++)
        free(t->column[j]);
}

/* ---- The case ---------------------------------------------------------------------- */

/* The option `name` of a body. */
static const char *of_body(const char *name, const char *suffix)
{
    static char key[40];
    snprintf(key, sizeof key, "%s%s", name, suffix);
    return key;
}

/* Thin discs: E (1 + 2 nu)/(1 + nu)^2 and nu/(1 + nu) stand for E and nu. */
static void make_thin(double *young, double *poisson)
{
    *young *= (1.0 + 2.0 * *poisson) / pow(1.0 + *poisson, 2.0);
    *poisson /= 1.0 + *poisson;
}

/* The rows of --layers, or the one of --layer-thickness. */
static void read_layers(const json_t *inputs, const char *suffix, body *b)
{
    const char *own = word(inputs, of_body("layers", suffix)),
               *path =
                   json_is_true(json_object_get(inputs, "similar")) ? word(inputs, "layers") : own;
    const double thickness = number(inputs, of_body("layer-thickness", suffix));
    if (path[0]) {
        const rows file = rows_from_file(path);
        if (file.columns != 3)
            violated("layers", "%s has %d columns", path, file.columns);
        b->layers = file.columns == 3 ? file.rows : 0;
        b->layer = file.x;
        b->young = file.x[1];
        b->poisson = file.x[2];
    } else if (thickness > 0.0) {
        b->layers = 1;
        b->layer = doubles(3);
        b->layer[0] = thickness;
        b->layer[1] = b->young;
        b->layer[2] = b->poisson;
    }
    const char *of = path == own ? suffix : "";
    b->base_young = number(inputs, of_body("base-young", of));
    b->base_poisson = number(inputs, of_body("base-poisson", of));
    if (isnan(b->base_young))
        b->base_young = 0.0;
}

static body body_of(const json_t *inputs, const char *suffix)
{
    body b = {.young = number(inputs, of_body("young", suffix)),
              .poisson = number(inputs, of_body("poisson", suffix)),
              .radius = number(inputs, of_body("radius", suffix)),
              .datum = number(inputs, of_body("datum", suffix)),
              .halfplane = strcmp(word(inputs, of_body("support", suffix)), "halfplane") == 0};
    if (isnan(b.young))
        b.young = 0.0;
    read_layers(inputs, suffix, &b);
    if (b.young > 0.0 && strcmp(word(inputs, "plane"), "stress") == 0) {
        make_thin(&b.young, &b.poisson);
        make_thin(&b.base_young, &b.base_poisson);
        for (int k = 0; k < b.layers; k++)
            make_thin(&b.layer[3 * k + 1], &b.layer[3 * k + 2]);
    }
    if (isnan(b.radius))
        b.radius = INFINITY;
    return b;
}

/* The depth of zero displacement: 2R/e unless given; a plane takes A's radius. */
static void resolve_datum(body *b, double radius)
{
    if (isnan(b->datum))
        b->datum = 2.0 * (isinf(b->radius) ? radius : fabs(b->radius)) / exp(1.0);
}

/* ---- Friction laws ----------------------------------------------------------------- */

/* Number k of an option that takes several; 0: there are not so many. */
static double listed(const json_t *inputs, const char *key, size_t k)
{
    const json_t *value = json_object_get(inputs, key);
    if (json_is_array(value))
        value = json_array_get(value, k);
    else if (k > 0)
        return 0.0;
    return json_is_number(value) ? json_number_value(value) : 0.0;
}

static int is_law(const json_t *inputs, const char *name)
{
    return strcmp(word(inputs, "friction-law"), name) == 0;
}

static int is_table_law(const json_t *inputs)
{
    return !is_law(inputs, "constant") && !is_law(inputs, "exponential") &&
           !is_law(inputs, "rational") && !is_law(inputs, "linear");
}

/* mu at x, by straight lines between the rows of the file. */
static double mu_of_table(const json_t *inputs, double x)
{
    static rows file;
    if (!file.rows)
        file = rows_from_file(word(inputs, "friction-law"));
    const double *row = file.x, *last = file.x + 2 * (file.rows - 1);
    if (x <= row[0])
        return row[1];
    if (x >= last[0])
        return last[1];
    while (x > row[2])
        row += 2;
    return row[1] + (row[3] - row[1]) * (x - row[0]) / (row[2] - row[0]);
}

static double largest_mu(const json_t *inputs, double mu)
{
    if (is_table_law(inputs)) {
        const rows file = rows_from_file(word(inputs, "friction-law"));
        mu = 0.0;
        for (int k = 0; k < file.rows; k++)
            mu = fmax(mu, file.x[2 * k + 1]);
        free(file.x);
    }
    for (size_t k = 0; k < 2; k++)
        mu += fmax(0.0, listed(inputs, "mu-fall", k));
    return mu + fmax(0.0, listed(inputs, "mu-heat", 0));
}

/* mu where A slides at v [mm/s] and the surface has the temperature T. */
static double mu_by_law(const contact *c, double x, double v, double T)
{
    const json_t *inputs = c->inputs;
    double mu = is_table_law(inputs) ? mu_of_table(inputs, x) : c->last_mu;
    for (size_t k = 0; k < 2; k++) {
        const double m = listed(inputs, "mu-fall", k);
        const double s = m != 0.0 ? v / listed(inputs, "slip-scale", k) : 0.0;
        mu += m * (is_law(inputs, "exponential") ? pow(2.0, -s)
                   : is_law(inputs, "linear")    ? fmax(0.0, 1.0 - s / 2.0)
                   : k == 0                      ? 1.0 / (1.0 + s)
                                                 : 1.0 / (1.0 + s * s));
    }
    if (listed(inputs, "mu-heat", 0) != 0.0)
        mu +=
            listed(inputs, "mu-heat", 0) *
            fmin(1.0, fmax(0.0, (T - listed(inputs, "mu-heat", 1)) / listed(inputs, "mu-heat", 2)));
    return mu;
}

/* The last row of a history, or the options themselves. */
static double wanted(const contact *c, const rows *controls, const char *column, const char *key)
{
    const int j = controls ? column_of(controls->header, column) : -1;
    if (j >= 0 && controls->rows > 0)
        return controls->x[(controls->rows - 1) * controls->columns + j];
    return number(c->inputs, key);
}

/* Complete elliptic integrals K and E of the modulus e, by the arithmetic-geometric mean. */
static void elliptic(double e, double *K, double *E)
{
    double a = 1.0, b = sqrt((1.0 - e) * (1.0 + e)), c = e, sum = 0.5 * e * e, power = 0.5;
    for (int i = 0; i < 40; i++) {
        c = 0.5 * (a - b);
        const double next = 0.5 * (a + b);
        b = sqrt(a * b);
        a = next;
        power *= 2.0;
        sum += power * c * c;
    }
    *K = 0.5 * pi / a;
    *E = *K * (1.0 - sum);
}

/* Curvatures of Hertz's ellipse along its short and its long semi-axis s and l, times
 * E* l/p0 (Johnson 4.25). */
static void curvatures(double s_over_l, double *steep, double *flat)
{
    const double e = sqrt((1.0 - s_over_l) * (1.0 + s_over_l));
    double K, E;
    elliptic(e, &K, &E);
    *flat = e < 1e-4 ? 0.5 * pi : 2.0 * s_over_l * (K - E) / (e * e);
    *steep = e < 1e-4 ? 0.5 * pi : 2.0 * s_over_l * (E / (s_over_l * s_over_l) - K) / (e * e);
}

/* The radius E* a/(2 p0) of the strip through the middle of the ellipse; 0: there is none. */
static double strip_radius(const contact *c)
{
    const double second = number(c->inputs, "transverse-radius"),
                 second_b = number(c->inputs, "transverse-radius-b"),
                 load = number(c->inputs, "wheel-load"), along = 1.0 / c->radius,
                 across = (isnan(second) ? 0.0 : 1.0 / second) +
                          (isnan(second_b) ? 0.0 : 1.0 / second_b);
    double low = -16.0, high = 0.0, steep, flat;
    if (isnan(load))
        return 0.0;
    for (int i = 0; i < 100; i++) {
        const double middle = 0.5 * (low + high);
        curvatures(exp(middle), &steep, &flat);
        *(flat / steep < fmin(along, across) / fmax(along, across) ? &low : &high) = middle;
    }
    const double ratio = exp(0.5 * (low + high));
    curvatures(ratio, &steep, &flat);
    /* p0 l/E* from the curvature, p0 s l = 3 P/(2 pi) */
    const double slope = fmax(along, across) / steep; /* p0/(E* l) */
    const double l = cbrt(1.5 * load / (pi * ratio * slope * c->modulus));
    const double a = along >= across ? ratio * l : l;
    return a / (2.0 * slope * l);
}

static contact contact_of(const json_t *root, const rows *controls)
{
    contact c = {.inputs = json_object_get(root, "inputs"),
                 .summary = json_object_get(root, "summary")};
    const char *formulation = word(c.inputs, "formulation");
    c.a = body_of(c.inputs, "");
    c.b = body_of(c.inputs, "-b");
    c.period = number(c.inputs, "period");
    if (strcmp(word(c.inputs, "gap"), "wave") == 0) /* its crest's */
        c.a.radius = pow(c.period / (2.0 * pi), 2.0) / number(c.inputs, "amplitude");
    resolve_datum(&c.a, c.a.radius);
    resolve_datum(&c.b, c.a.radius);
    c.last_mu = wanted(&c, controls, "mu", "mu");
    c.mu = largest_mu(c.inputs, c.last_mu);
    double compliance = (1.0 - c.a.poisson * c.a.poisson) / c.a.young;
    if (c.b.young > 0.0)
        compliance += (1.0 - c.b.poisson * c.b.poisson) / c.b.young;
    c.modulus = 1.0 / compliance;
    c.radius = 1.0 / (1.0 / c.a.radius + (c.b.young > 0.0 ? 1.0 / c.b.radius : 0.0));
    const double strip = strip_radius(&c);
    c.radius = strip > 0.0 ? strip : c.radius;
    c.surface_normals = strcmp(word(c.inputs, "normals"), "surface") == 0;
    c.formulation = strcmp(formulation, "steady") == 0      ? STEADY
                    : strcmp(formulation, "transient") == 0 ? TRANSIENT
                                                            : STATIC;
    c.steps = c.formulation == TRANSIENT || word(c.inputs, "history")[0] ||
              number(c.inputs, "increments") > 1.0;
    return c;
}

static double largest(int n, const double *x)
{
    double most = 0.0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(x[i]));
    return most;
}

/* A residual of 1e-10 of the scaled problem, as a length: p0 on one element presses the
 * surface by that. */
static double length_scale(const contact *c, const table *t)
{
    const double h = largest(t->n, t->column[H]);
    return largest(t->n, t->column[P]) * h / c->modulus * (1.0 + log(1.0 + c->a.radius / h));
}

static double tolerance(const contact *c)
{
    const double tol = number(c->inputs, "tol"), reached = number(c->summary, "residual");
    return 10.0 * fmax(isnan(tol) ? 1e-10 : tol, isnan(reached) ? 0.0 : fmin(reached, 1e-8));
}

/* ---- Laws, element by element ------------------------------------------------------ */

static void check_elements(const table *t)
{
    const double *x = t->column[X], *h = t->column[H];
    for (int i = 0; i < t->n; i++)
        for (int j = 0; j < COLUMNS; j++)
            if (!isfinite(t->column[j][i]))
                violated("finite", "%s of element %d is no number", column_names[j], i + 1);
    for (int i = 0; i < t->n; i++)
        if (!(h[i] > 0.0))
            violated("mesh", "length of element %d is %g", i + 1, h[i]);
    for (int i = 1; i < t->n; i++)
        if (!(x[i] > x[i - 1]))
            violated("mesh", "element %d does not follow element %d", i + 1, i);
}

/* Signorini: p >= 0, gap >= 0, one of them 0. */
static void check_contact(const contact *c, const table *t)
{
    const double *p = t->column[P], *gap = t->column[GAP], *zone = t->column[ZONE];
    const double eps = tolerance(c), length = eps * length_scale(c, t);
    for (int i = 0; i < t->n; i++) {
        if (p[i] < 0.0)
            violated("p >= 0", "element %d: %g", i + 1, p[i]);
        if (gap[i] < -length)
            violated("gap >= 0", "element %d: %g (allowed %.2g)", i + 1, gap[i], length);
        if (p[i] > 0.0 && fabs(gap[i]) > length)
            violated("p gap = 0", "element %d: p = %g, gap = %g (allowed %.2g)", i + 1, p[i],
                     gap[i], length);
        if ((p[i] > 0.0) != (zone[i] != SEPARATED))
            violated("zone", "element %d: p = %g, zone %g", i + 1, p[i], zone[i]);
    }
    double whole = 0.0; /* of a period, whose ends are one place */
    for (int i = 0; i < t->n; i++)
        whole += t->column[H][i];
    if (strcmp(word(c->inputs, "mesh"), "punch") == 0) /* the punch ends there */
        return;
    if (t->n > 0 && (p[0] > 0.0 || p[t->n - 1] > 0.0) && !(whole >= c->period * (1.0 - 1e-9)))
        violated("ends", "the contact reaches an end of the potential contact");
}

static int has_second_slip(const contact *c)
{
    return strcmp(word(c->inputs, "slip-operator"), "second") == 0;
}

static int is_fitted(const contact *c)
{
    return strcmp(word(c->inputs, "mesh"), "fitted") == 0;
}

/* For the law: upstream slip of fitted elements is that half-way to the next one, and the straight
 * line through two of them has the slip of the element. */
static double slip_at(const contact *c, const table *t, int i)
{
    const double *x = t->column[X], *slip = t->column[SLIP];

    if (c->formulation != STEADY || !is_fitted(c) || i == 0)
        return slip[i];
    const double next = i + 1 < t->n ? x[i + 1] : x[i] + t->column[H][i];
    return slip[i - 1] + (slip[i] - slip[i - 1]) * (x[i] - x[i - 1]) / (next - x[i - 1]);
}

/* The coefficients by the law, from the printed slip and temperatures; with memory of a
 * transient, or of more than a step at rest, only their range is known. */
static void check_law(contact *c, const table *t, const json_t *object, const rows *controls)
{
    const json_t *printed = json_object_get(object, "mu");
    const json_t *warmth = json_object_get(object, "temperature_K");
    const double T0 = number(c->inputs, "temperature"), V = number(c->inputs, "speed");
    const double d = listed(c->inputs, "memory", 0), s0 = listed(c->inputs, "memory", 1);
    const int heats = listed(c->inputs, "mu-heat", 0) != 0.0;
    const int is_one = is_law(c->inputs, "constant") && !heats;
    const int follows_way = controls && column_of(controls->header, "mu") >= 0;
    /* particles may remember what the history had before */
    const double most = largest_mu(c->inputs, number(c->inputs, "mu"));
    const double falls = listed(c->inputs, "mu-fall", 0) + listed(c->inputs, "mu-fall", 1);
    c->moves = c->formulation != STATIC ? heats || falls != 0.0 : d > 0.0 && falls != 0.0;
    double ahead = 0.0;
    c->mu_of = doubles((size_t)t->n);
    if ((printed != NULL) == (is_one && !follows_way))
        violated("friction law", "the column mu does not follow --friction-law");
    for (int i = t->n - 1; i >= 0; i--) {
        const double x = t->column[X][i];
        const int open = c->formulation == STATIC || t->column[ZONE][i] == SEPARATED;
        const double v = open ? 0.0 : V * fabs(slip_at(c, t, i));
        const double T = open ? T0 : json_number_value(json_array_get(warmth, (size_t)i));
        double mu = mu_by_law(c, x, v, T);
        c->mu_of[i] = !printed ? mu : json_number_value(json_array_get(printed, (size_t)i));
        if (c->mu_of[i] < 0.0 || c->mu_of[i] > most * (1.0 + 1e-12))
            violated("friction law", "element %d: mu = %g", i + 1, c->mu_of[i]);
        if (d > 0.0 && c->moves && c->formulation == STATIC) {
            if (c->mu_of[i] < c->last_mu * (1.0 - 1e-12))
                violated("friction law", "element %d: mu = %g below the kinetic one", i + 1,
                         c->mu_of[i]);
            const int slips = t->column[ZONE][i] != SEPARATED && t->column[ZONE][i] != STICK;
            if (slips) /* at once kinetic but for what it has slid */
                mu = c->last_mu + falls * exp(-fabs(t->column[SHIFT][i]) / d);
        }
        if (d > 0.0 && c->moves && (c->formulation == TRANSIENT || c->steps))
            continue;
        const double now = mu;
        if (d > 0.0 && c->moves && !open) {
            const int touches = i + 1 < t->n && t->column[ZONE][i + 1] != SEPARATED;
            const double next = i + 1 < t->n ? t->column[X][i + 1] - x : t->column[H][i];
            const double own = fabs(t->column[SLIP][i]);
            const double mean =
                has_second_slip(c) && touches ? 0.5 * (own + fabs(t->column[SLIP][i + 1])) : own;
            const double part = fmax(V * mean, s0 > 0.0 ? s0 : 1.0) * next / V / d;
            const double from = (has_second_slip(c) || is_fitted(c)) && touches ? ahead : now;
            mu = (c->mu_of[i + 1 < t->n ? i + 1 : i] - from) * exp(-part) + now -
                 (now - from) * (part > 1e-4 ? -expm1(-part) / part : 1.0 - 0.5 * part);
        }
        ahead = now; /* what the coefficient tends to */
        /* proven is the friction that it makes */
        const double part = t->column[P][i] / largest(t->n, t->column[P]);
        expect("friction law", c->mu_of[i], mu,
               1e-8 * c->mu + (part > 0.0 ? tolerance(c) * c->mu / part : 0.0));
    }
}

/* Coulomb: |q| <= mu p, stick without slip, slip against the friction. */
static void check_friction(const contact *c, const table *t)
{
    const double *p = t->column[P], *q = t->column[Q], *shift = t->column[SHIFT];
    const double *slip = t->column[SLIP], *zone = t->column[ZONE];
    const double eps = tolerance(c), length = eps * length_scale(c, t);
    const double stress = eps * fmax(c->mu, 1e-3) * largest(t->n, p);
    for (int i = 0; i < t->n; i++) {
        const double bound = c->mu_of[i] * p[i];
        if (fabs(q[i]) > bound + stress)
            violated("Coulomb", "element %d: |q| = %.17g, mu p = %.17g", i + 1, fabs(q[i]), bound);
        if (zone[i] == STICK && fabs(shift[i]) > length)
            violated("stick", "element %d slips by %g (allowed %.2g)", i + 1, shift[i], length);
        if (zone[i] == SLIP_NEGATIVE && (fabs(q[i] + bound) > stress || shift[i] < -length))
            violated("slip", "element %d, zone 2: q = %g, mu p = %g, shift %g", i + 1, q[i], bound,
                     shift[i]);
        if (zone[i] == SLIP_POSITIVE && (fabs(q[i] - bound) > stress || shift[i] > length))
            violated("slip", "element %d, zone 3: q = %g, mu p = %g, shift %g", i + 1, q[i], bound,
                     shift[i]);
        if (c->formulation != STATIC && slip[i] * shift[i] < 0.0)
            violated("slip", "element %d: %g against a shift of %g", i + 1, slip[i], shift[i]);
    }
}

/* What the interface has yielded at element i, and the part of this step in it: steady, u
 * follows the material by the difference of the local slip (theory-rolling.md 4.10). */
static double yielded_at(const contact *c, int n, int i)
{
    return i < n ? json_number_value(json_array_get(c->plastic, (size_t)i)) : 0.0;
}

static double plastic_slip(const contact *c, int n, int i)
{
    const char *of = word(c->inputs, "slip-operator");
    const double u = yielded_at(c, n, i), next = yielded_at(c, n, i + 1);
    if (c->formulation == STATIC)
        return u;
    return strcmp(of, "second") == 0 ? 1.5 * u - 2.0 * next + 0.5 * yielded_at(c, n, i + 2)
                                     : u - next;
}

/* The interface yields at its yield stress, hardened or softened by what has yielded, and
 * slip takes what is left of the shift. */
static void check_yield(const contact *c, const table *t)
{
    const double *q = t->column[Q], *shift = t->column[SHIFT], *zone = t->column[ZONE];
    const double tau = number(c->inputs, "yield-stress"), k = number(c->inputs, "hardening");
    const double eps = tolerance(c), length = 10.0 * eps * length_scale(c, t);
    const double stress = eps * fmax(c->mu, 1e-3) * largest(t->n, t->column[P]) + fabs(k) * length;
    int yields = 0;
    if ((c->plastic == NULL) != (isnan(tau) != 0))
        violated("plastic_mm", "the column does not follow --yield-stress");
    for (int i = 0; i < t->n && c->plastic; i++) {
        const double yield = fmax(tau + k * yielded_at(c, t->n, i), 0.0);
        const double plastic = c->steps ? NAN : plastic_slip(c, t->n, i);
        const int slips = zone[i] == SLIP_NEGATIVE || zone[i] == SLIP_POSITIVE;
        yields += zone[i] >= YIELD_NEGATIVE;
        if (fabs(q[i]) > yield + stress)
            violated("yield stress", "element %d: |q| = %.17g, bound %.17g", i + 1, fabs(q[i]),
                     yield);
        if (zone[i] >= YIELD_NEGATIVE &&
            (fabs(fabs(q[i]) - yield) > stress ||
             (zone[i] == YIELD_NEGATIVE ? -shift[i] : shift[i]) > length))
            violated("yield", "element %d, zone %g: q = %g, bound %g, shift %g", i + 1, zone[i],
                     q[i], yield, shift[i]);
        if (zone[i] != SEPARATED && (plastic < -length || plastic > fabs(shift[i]) + length))
            violated("plastic slip", "element %d: %g of a shift of %g", i + 1, plastic, shift[i]);
        if (!slips && zone[i] != SEPARATED && fabs(plastic - fabs(shift[i])) > length)
            violated("plastic slip", "element %d does not slip: %g of a shift of %g", i + 1,
                     plastic, shift[i]);
        if (plastic > length && fabs(fabs(q[i]) - yield) > stress)
            violated("plastic slip", "element %d: %g below the yield stress", i + 1, plastic);
    }
    if (c->plastic)
        expect("yield", number(c->summary, "yield"), yields, 0.0);
}

/* ---- Sums and counts --------------------------------------------------------------- */

typedef struct {
    double P, Q;
    int contact, stick, slip, first, last; /* loaded elements */
    double stick_from, stick_to;
} sums;

/* Half of an element's extent along x: on a wheel elements are chords of the circle. */
static double half_extent(const contact *c, double x, double h)
{
    if (c->a.halfplane)
        return 0.5 * h;
    const double R = c->a.radius, middle = sqrt(R * R - 0.25 * h * h); /* of the chord */
    return 0.5 * h * sqrt(1.0 - x * x / (middle * middle));
}

/* With surface normals p and q are turned by the angle of the circle at x. */
static sums sums_of(const contact *c, const table *t)
{
    sums s = {.first = -1, .last = -1, .stick_from = NAN, .stick_to = NAN};
    for (int i = 0; i < t->n; i++) {
        const double x = t->column[X][i], h = t->column[H][i], p = t->column[P][i];
        const double q = t->column[Q][i], zone = t->column[ZONE][i];
        const double sine = c->surface_normals ? x / c->a.radius : 0.0;
        const double cosine = sqrt(1.0 - sine * sine);
        s.P += h * (p * cosine + q * sine);
        s.Q += h * (q * cosine - p * sine);
        s.contact += zone != SEPARATED;
        s.stick += zone == STICK;
        s.slip += zone > STICK;
        if (zone == STICK && isnan(s.stick_from))
            s.stick_from = x - half_extent(c, x, h);
        if (zone == STICK)
            s.stick_to = x + half_extent(c, x, h);
        if (p > 0.0 && s.first < 0)
            s.first = i;
        if (p > 0.0)
            s.last = i;
    }
    return s;
}

static void expect_count(const contact *c, const char *key, int want)
{
    if (number(c->summary, key) != want)
        violated(key, "%g, the table has %d", number(c->summary, key), want);
}

/* NAN where the table has none. */
static void expect_same(const contact *c, const char *key, double want, double tol)
{
    const double got = number(c->summary, key);
    if (isnan(want) && isnan(got))
        return;
    expect(key, got, want, tol);
}

/* An edge lies between the middle of the first open element and the inner end of the last
 * loaded one. */
static void check_edges(const contact *c, const table *t, const sums *s)
{
    const double *x = t->column[X], *h = t->column[H];
    const double from = number(c->summary, "contact_from");
    const double to = number(c->summary, "contact_to");
    const double a = number(c->summary, "half_width"), tiny = 1e-12 * c->a.radius;
    if (s->first > 0 &&
        !(from >= x[s->first - 1] - tiny && from <= x[s->first] + 0.5 * h[s->first] + tiny))
        violated("contact_from", "%g, first loaded element at %g", from, x[s->first]);
    if (s->last >= 0 && s->last + 1 < t->n &&
        !(to <= x[s->last + 1] + tiny && to >= x[s->last] - 0.5 * h[s->last] - tiny))
        violated("contact_to", "%g, last loaded element at %g", to, x[s->last]);
    if (s->first >= 0)
        expect("half_width", a, 0.5 * (to - from), 1e-12 * fabs(a) + tiny);
}

/* The largest pressure that elements show.  Between unlike bodies the last two that stick and the
 * first that slips beside them err by a few per cent (theory-solvers.md, E4). */
static double largest_shown(const contact *c, const table *t)
{
    const double *zone = t->column[ZONE];
    const int alike = c->a.young == c->b.young && c->a.poisson == c->b.poisson;
    double most = 0.0;
    for (int i = 0; i < t->n; i++) {
        int beside = 0;
        for (int j = i - 1; j <= i + 1; j++)
            for (int k = j - 1; k <= j + 1; k += 2)
                beside |=
                    j >= 0 && k >= 0 && j < t->n && k < t->n && zone[j] == STICK && zone[k] > STICK;
        if (alike || !beside)
            most = fmax(most, t->column[P][i]);
    }
    return most;
}

static void check_sums(const contact *c, const table *t)
{
    const sums s = sums_of(c, t);
    const double p0 = largest_shown(c, t), most = largest(t->n, t->column[P]);
    const double peak = number(c->summary, "max_pressure");
    expect_same(c, "normal_load", s.P, 1e-12 * s.P);
    expect_same(c, "tangential_load", s.Q, 1e-12 * s.P * fmax(c->mu, 1.0));
    expect_count(c, "contact", s.contact);
    expect_count(c, "stick", s.stick);
    expect_count(c, "slip", s.slip);
    const double tiny = 1e-9 * largest(t->n, t->column[H]);
    expect_same(c, "stick_from", s.stick_from, tiny);
    expect_same(c, "stick_to", s.stick_to, tiny);
    /* the vertex of a parabola through three elements, or the pressure at a limit of stick */
    if (!(peak >= p0 * (1.0 - 1e-12) && peak >= 0.9 * most && peak <= 1.2 * most))
        violated("max_pressure", "%g, the largest of the table is %g", peak, p0);
    check_edges(c, t, &s);
}

static int has_memory(const json_t *inputs, const char *suffix)
{
    char key[40];
    snprintf(key, sizeof key, "relaxation-time%s", suffix);
    const json_t *time = json_object_get(inputs, key);
    return json_is_number(time) || json_is_array(time);
}

/* The force ratio is that to mu P, of elements that differ at rest to all they carry. */
static void check_ratios(const contact *c, const table *t)
{
    const double P_ = number(c->summary, "normal_load");
    const double Q_ = number(c->summary, "tangential_load");
    double a = isfinite(c->radius) ? sqrt(4.0 * P_ * c->radius / (pi * c->modulus)) : NAN;
    const int relaxes =
        c->formulation != STATIC && (has_memory(c->inputs, "") || has_memory(c->inputs, "-b"));
    if (c->period > 0.0) /* Westergaard's, of a wave */
        a = strcmp(word(c->inputs, "gap"), "wave") == 0
                ? c->period / pi *
                      asin(sqrt(fmin(1.0, P_ / (pi * c->modulus * number(c->inputs, "amplitude")))))
                : fmin(a, 0.5 * c->period);
    if (number(c->inputs, "interlayer-normal") > 0.0 || relaxes) {
        /* theirs by formula, to a few per cent of what carries */
        a = number(c->summary, "hertz_half_width");
        if (P_ > 0.0 && !(a > 0.0))
            violated("hertz_half_width", "%g", a);
    } else
        expect_same(c, "hertz_half_width", a, 1e-9 * a);
    if (c->mu > 0.0) {
        const double ratio = number(c->summary, "creepage") * c->radius / (c->mu * a);
        double most = c->moves ? c->mu * P_ : 0.0;
        for (int i = 0; i < t->n && !c->moves; i++)
            most += c->surface_normals ? 0.0 : c->mu_of[i] * t->column[P][i] * t->column[H][i];
        if (c->surface_normals && !c->moves) /* turned tractions carry P */
            most = c->mu_of[0] * P_;
        if (!c->surface_normals || is_law(c->inputs, "constant"))
            expect_same(c, "force_ratio", Q_ / most, 1e-12);
        expect_same(c, "creep_ratio", ratio, 1e-9 * fabs(ratio));
        if (fabs(Q_) > c->mu * P_ * (1.0 + 1e-9) && !c->surface_normals)
            violated("Coulomb", "|Q| = %g, mu P = %g", fabs(Q_), c->mu * P_);
    } else if (!isnan(number(c->summary, "force_ratio")) ||
               !isnan(number(c->summary, "creep_ratio")))
        violated("ratios", "of a case without friction are not null");
}

/* ---- Heat -------------------------------------------------------------------------- */

static double input(const contact *c, const char *key, double otherwise)
{
    const double x = number(c->inputs, key);
    return isnan(x) ? otherwise : x;
}

/* Equally warm in contact, warmest within it, no heat far upstream. */
static void check_heat(const contact *c, const table *t, const json_t *object)
{
    const json_t *a = json_object_get(object, "temperature_K");
    const json_t *b = json_object_get(object, "temperature_b_K");
    const double conductivity = number(c->inputs, "conductivity");
    const double most = number(c->summary, "max_temperature");
    if ((conductivity > 0.0) != (a != NULL) || (a != NULL) != (b != NULL))
        violated("temperature", "columns do not follow --conductivity");
    if (!a || !b || violations)
        return;
    /* All sticks: what there is comes from the slip beside the edges, of either sign. */
    if (!(number(c->summary, "dissipation") > 0.0))
        return;
    const double T_a = number(c->inputs, "temperature");
    const double T_b = input(c, "temperature-b", T_a);
    const double rise = fabs(most - fmin(T_a, T_b)) + fabs(T_a - T_b);
    double warmest = -INFINITY;
    for (int i = 0; i < t->n; i++) {
        const double one = json_number_value(json_array_get(a, (size_t)i));
        const double other = json_number_value(json_array_get(b, (size_t)i));
        if (!(fmin(one, other) >= fmin(T_a, T_b) - 1e-6 * rise - 1e-12))
            violated("temperature", "element %d is colder than both bodies: %g", i + 1,
                     fmin(one, other));
        if (t->column[ZONE][i] == SEPARATED)
            continue;
        warmest = fmax(warmest, one);
        if (fabs(one - other) > 1e-9 * (rise + fabs(T_a)))
            violated("temperature", "element %d: %g and %g in contact", i + 1, one, other);
    }
    /* 1e-12 K: the rounding of a contact that sticks, as above */
    if (!(most >= warmest - 1e-12 * fabs(warmest) && most <= warmest + 0.2 * rise + 1e-12))
        violated("max_temperature", "%g, the largest in contact is %g", most, warmest);
    const double diffusivity = conductivity / number(c->inputs, "heat-capacity");
    const double peclet =
        number(c->inputs, "speed") * number(c->summary, "half_width") / (2 * diffusivity);
    expect_same(c, "peclet", peclet, 1e-9 * peclet);
}

/* ---- What was asked for ------------------------------------------------------------ */

/* NAN under a given approach. */
static double wanted_load(const contact *c, const rows *controls)
{
    const double half_width = number(c->inputs, "half-width");
    const double load = wanted(c, controls, "load", "load");
    return isnan(load) ? pi * c->modulus * half_width * half_width / (4.0 * c->radius) : load;
}

static void check_normal_control(const contact *c, const rows *controls)
{
    const double approach = wanted(c, controls, "approach", "approach");
    const double load = wanted_load(c, controls);
    if (!isnan(load))
        expect("wanted load", number(c->summary, "normal_load"), load, 1e-10 * load);
    else if (!isnan(approach))
        expect("wanted approach", number(c->summary, "approach"), approach, 1e-12 * approach);
}

static void check_tangential_control(const contact *c, const rows *controls)
{
    const double load = number(c->summary, "normal_load");
    const double shift = wanted(c, controls, "shift", "shift");
    const double force = wanted(c, controls, "force", "force");
    const double force_ratio = wanted(c, controls, "force_ratio", "force-ratio");
    const double xi = number(c->summary, "creepage");
    const int column = controls && (column_of(controls->header, "creep") >= 0 ||
                                    column_of(controls->header, "creep_ratio") >= 0);
    if (!isnan(shift) && c->formulation == STATIC)
        expect("wanted shift", number(c->summary, "tangential_shift"), shift, 1e-12 * fabs(shift));
    if (!isnan(force) && c->mu > 0.0)
        expect("wanted force", number(c->summary, "tangential_load"), force,
               1e-10 * fmax(c->mu * load, fabs(force)) + (c->surface_normals ? 1e-8 * load : 0.0));
    if (!isnan(force_ratio) && c->mu > 0.0)
        expect("wanted force ratio", number(c->summary, "force_ratio"), force_ratio, 1e-10);
    if (column) /* of a step it is the mean between two rows */
        return;
    const double creep = number(c->inputs, "creep");
    const double creep_ratio = number(c->inputs, "creep-ratio");
    if (!isnan(creep))
        expect("wanted creepage", xi, creep, 1e-12 * fabs(creep));
    /* of steps the half-width is that of the largest load, here it is the last one's */
    if (!isnan(creep_ratio) && !controls && !(c->steps && isnan(wanted_load(c, NULL))))
        expect("wanted creep ratio", number(c->summary, "creep_ratio"), creep_ratio,
               1e-8 * fabs(creep_ratio));
}

/* ---- Kinematics -------------------------------------------------------------------- */

/* g_0 where a formula gives it; NAN where a table has a part in it. */
static double initial_gap(const contact *c, double x)
{
    const char *gap = word(c->inputs, "gap");
    if (word(c->inputs, "irregularity")[0])
        return NAN;
    if (strcmp(gap, "parabola") == 0)
        return x * x / (2.0 * c->radius);
    if (strcmp(gap, "wave") == 0)
        return number(c->inputs, "amplitude") *
               (1.0 - cos(2.0 * acos(-1.0) * x / number(c->inputs, "period")));
    if (strcmp(gap, "exact") != 0)
        return NAN;
    const double A = c->a.radius, B = c->b.radius;
    const double of_a = x * x / (A + sqrt(A * A - x * x));
    if (!(c->b.young > 0.0) || isinf(B))
        return of_a;
    const double of_b = x * x / (fabs(B) + sqrt(B * B - x * x));
    return B < 0.0 ? of_a - of_b : of_a + of_b; /* a bore curves as A does */
}

/* The member of the second-order differences that theory-rolling.md 4.7 takes. */
static const double EDGE = 0.0740956;

/* A third body's own part of the slip has t = 1 (theory-rolling.md 4.10): what that adds. */
static double local_slip(const contact *c, const table *t, int i)
{
    const double *q = t->column[Q], s = 1.0 - EDGE;
    return number(c->inputs, "interlayer-tangential") * 0.25 * s *
           (-q[i - 1] + 3.0 * q[i] - 3.0 * q[i + 1] + q[i + 2]);
}

/* What bulk stresses strain A more than B, homogeneous half-planes. */
static double bulk_strain(const contact *c)
{
    const int thin = strcmp(word(c->inputs, "plane"), "stress") == 0;
    double strain = 0.0;
    for (int b = 0; b < 2; b++) {
        const double stress = json_number_value(
                         json_object_get(c->inputs, b ? "bulk-stress-b" : "bulk-stress")),
                     E = number(c->inputs, b ? "young-b" : "young"),
                     nu = number(c->inputs, b ? "poisson-b" : "poisson");
        if (stress != 0.0)
            strain += (b ? -stress : stress) * (thin ? 1.0 : 1.0 - nu * nu) / E;
    }
    return strain;
}

/* Gap and slip from the printed displacements. */
static void check_kinematics(const contact *c, const table *t)
{
    const double *x = t->column[X], *un = t->column[UN], *ut = t->column[UT];
    const double delta = number(c->summary, "approach");
    const double rounding = 1e-13 * (largest(t->n, un) + largest(t->n, ut) + delta);
    const double length = tolerance(c) * length_scale(c, t) + rounding, strain = bulk_strain(c);
    for (int i = 0; i < t->n; i++) {
        const double worn = json_number_value(json_array_get(c->worn, (size_t)i));
        const double tilt = number(c->summary, "tilt");
        const double g0 = initial_gap(c, x[i]) + worn - (isnan(tilt) ? 0.0 : tilt * x[i]);
        if (!isnan(g0) && !c->surface_normals)
            expect("gap = g0 + un - approach", t->column[GAP][i], g0 + un[i] - delta, length);
    }
    if (c->steps || c->surface_normals)
        return;
    for (int i = 0; i + 1 < t->n; i++) {
        const double dx = x[i + 1] - x[i];
        if (c->formulation == STATIC) {
            const double xi = number(c->summary, "creepage");
            const double rigid = number(c->summary, "tangential_shift");
            /* the last digit of a rigid shift may be all that the surface yields */
            expect("shift = shift + ut", t->column[SHIFT][i], rigid + ut[i] + strain * x[i],
                   length + 1e-15 * fabs(rigid));
            expect("slip (12)", t->column[SLIP][i], xi - strain - (ut[i + 1] - ut[i]) / dx,
                   length / dx + 1e-12 * fabs(xi));
        } else {
            const double xi = number(c->summary, "creepage") - strain;
            const char *of = json_string_value(json_object_get(c->inputs, "slip-operator"));
            const int second = of && strcmp(of, "second") == 0;
            if (!second)
                expect("shift = xi dx - (ut' - ut)", t->column[SHIFT][i],
                       xi * dx + ut[i] - ut[i + 1], length + 1e-12 * fabs(xi) * dx);
            else if (i > 0 && i + 2 < t->n) /* the ends need displacements not printed */
                expect("shift = xi dx + A_t ut", t->column[SHIFT][i],
                       xi * dx + (1.0 - EDGE) / 4.0 * ut[i - 1] + (3.0 + 3.0 * EDGE) / 4.0 * ut[i] -
                           (5.0 + 3.0 * EDGE) / 4.0 * ut[i + 1] + (1.0 + EDGE) / 4.0 * ut[i + 2] +
                           local_slip(c, t, i),
                       3.0 * length + 1e-12 * fabs(xi) * dx);
            expect("slip = shift/dx", t->column[SLIP][i], t->column[SHIFT][i] / dx, length / dx);
        }
    }
}

/* ---- Flamant: the displacements of half-planes again ------------------------------- */

static long double y_ln_y(long double y)
{
    return y == 0.0L ? 0.0L : y * logl(fabsl(y));
}

/* Clausen's integral -int ln|2 sin(t/2)| dt from 0 to x, by its series about 0 with the zeta
 * function of 2 k. */
static long double clausen(long double x)
{
    enum { TERMS = 32 };
    static long double zeta[TERMS + 1];
    const long double two_pi = 2.0L * acosl(-1.0L), y = remainderl(x, two_pi), part = y / two_pi;
    long double power = 1.0L, sum = 1.0L - (y == 0.0L ? 0.0L : logl(fabsl(y)));
    for (int k = 1; k <= TERMS && zeta[TERMS] == 0.0L; k++) {
        for (int n = 1000; n >= 1 && k > 2; n--)
            zeta[k] += powl((long double)n, -2.0L * k);
        zeta[k] += k == 1 ? two_pi * two_pi / 24.0L : k == 2 ? powl(two_pi, 4) / 1440.0L : 0.0L;
    }
    for (int k = 1; k <= TERMS; k++) {
        power *= part * part;
        sum += zeta[k] * power / (k * (2.0L * k + 1.0L));
    }
    return y * sum;
}

/* Displacements under p and q of table t at the abscissa x: for each body
 * -2 (1 - nu^2)/(pi E) int ln(|x - s|/d) ds of the same direction, +-c int sgn(x - s) ds
 * of the other one, c = (1 - 2 nu)(1 + nu)/(2E), B with the opposite sign of c. */
static void flamant(const contact *c, const table *t, double x, long double *un, long double *ut)
{
    const body *const bodies[] = {&c->a, &c->b};
    *un = *ut = 0.0L;
    for (int i = 0; i < t->n; i++) {
        const long double h = t->column[H][i], p = t->column[P][i], q = t->column[Q][i];
        if (p == 0.0L && q == 0.0L)
            continue;
        const long double from = t->column[X][i] - 0.5L * h, to = from + h;
        const long double L = c->period, from_x = x - from, to_x = x - to;
        long double log_integral = y_ln_y(from_x) - y_ln_y(to_x) - h;
        long double sign_integral = fabsl(from_x) - fabsl(to_x);
        if (L > 0.0L) { /* of all periods: Clausen's function, and the saw */
            log_integral = -L / (2.0L * pi) *
                           (clausen(2.0L * pi * from_x / L) - clausen(2.0L * pi * to_x / L));
            sign_integral -= (from_x * from_x - to_x * to_x) / L;
        }
        for (int k = 0; k < 2; k++) {
            const long double E = bodies[k]->young, nu = bodies[k]->poisson;
            if (E == 0.0L)
                continue;
            const long double direct =
                -2.0L * (1.0L - nu * nu) / (pi * E) *
                (log_integral - (L > 0.0L ? 0.0L : h * logl(bodies[k]->datum)));
            const long double cross = (k == 0 ? 1.0L : -1.0L) * (1.0L - 2.0L * nu) * (1.0L + nu) /
                                      (2.0L * E) * sign_integral;
            *un += direct * p + cross * q;
            *ut += direct * q - cross * p;
        }
    }
}

static int are_elastic_halfplanes(const contact *c)
{
    return c->a.halfplane && (c->b.young == 0.0 || c->b.halfplane) && !has_memory(c->inputs, "") &&
           !has_memory(c->inputs, "-b");
}

static void check_flamant(const contact *c, const table *t)
{
    const double size = largest(t->n, t->column[UN]) + largest(t->n, t->column[UT]);
    if (!are_elastic_halfplanes(c) || c->a.layers || c->b.layers)
        return;
    for (int i = 0; i < t->n; i++) {
        long double un, ut;
        flamant(c, t, t->column[X][i], &un, &ut);
        un += number(c->inputs, "interlayer-normal") * t->column[P][i];
        ut += number(c->inputs, "interlayer-tangential") * t->column[Q][i];
        expect("un by Flamant", t->column[UN][i], (double)un, 1e-11 * size);
        expect("ut by Flamant", t->column[UT][i], (double)ut, 1e-11 * size);
    }
}

/* ---- Waves: the displacements of bonded layers again ------------------------------- */

/* Under exp(ikx), y into the body: u_x = i U/k, u_y = W/k, s_xy = i X, s_yy = Y.  The compliance
 * C, (U, W) = -C (X, Y), of a half-plane. */
static void halfplane_compliance(double young, double poisson, double C[2][2])
{
    const double direct = 2.0 * (1.0 - poisson * poisson) / young;
    C[0][0] = C[1][1] = direct;
    C[0][1] = C[1][0] = direct * (1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson));
}

/* From the compliance of the lower face of a slice to that of the upper one: the state there is
 * exp(-A eta) times that below, by the series of a slice that is thin against the wave. */
static void add_slices(double young, double poisson, double eta, double C[2][2])
{
    const double G = young / (2.0 * (1.0 + poisson)), c = poisson / (1.0 - poisson),
                 m = (1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson));
    const int slices = (int)ceil(eta / 0.5), terms = 16;
    const double A[4][4] = {{0.0, -1.0, 1.0 / G, 0.0},
                            {c, 0.0, 0.0, m / G},
                            {2.0 * G / (1.0 - poisson), 0.0, 0.0, -c},
                            {0.0, 0.0, 1.0, 0.0}};
    double T[4][4] = {{0.0}}, power[4][4] = {{0.0}};
    for (int i = 0; i < 4; i++)
        T[i][i] = power[i][i] = 1.0;
    for (int n = 1; n <= terms; n++) {
        double next[4][4] = {{0.0}};
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                for (int k = 0; k < 4; k++)
                    next[i][j] -= power[i][k] * A[k][j] * (eta / slices) / n;
        memcpy(power, next, sizeof power);
        for (int i = 0; i < 16; i++)
            T[i / 4][i % 4] += power[i / 4][i % 4];
    }
    for (int n = 0; n < slices; n++) {
        double up[2][2], tractions[2][2];
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                up[i][j] = T[i][2 + j] - T[i][0] * C[0][j] - T[i][1] * C[1][j];
                tractions[i][j] = T[2 + i][2 + j] - T[2 + i][0] * C[0][j] - T[2 + i][1] * C[1][j];
            }
        const double det = tractions[0][0] * tractions[1][1] - tractions[0][1] * tractions[1][0];
        for (int i = 0; i < 2; i++) {
            C[i][0] = -(up[i][0] * tractions[1][1] - up[i][1] * tractions[1][0]) / det;
            C[i][1] = -(up[i][1] * tractions[0][0] - up[i][0] * tractions[0][1]) / det;
        }
    }
}

/* What the surface of a body yields more at the wave number k > 0 than a half-plane of the first
 * layer's material whose waves are cut off below 1/thickness. */
static void wave_of_layers(const body *b, double k, double rest[2][2])
{
    double C[2][2] = {{0.0}}, first[2][2], above = 0.0;
    int deepest = 0; /* what lies deeper than 45/k is not felt */
    for (; deepest < b->layers && above < 45.0 / k; deepest++)
        above += b->layer[3 * deepest];
    if (above >= 45.0 / k)
        halfplane_compliance(b->layer[3 * deepest - 2], b->layer[3 * deepest - 1], C);
    else if (b->base_young > 0.0)
        halfplane_compliance(b->base_young, b->base_poisson, C);
    for (int j = deepest - 1; j >= 0; j--)
        add_slices(b->layer[3 * j + 1], b->layer[3 * j + 2], fmin(k * b->layer[3 * j], 60.0), C);
    halfplane_compliance(b->young, b->poisson, first);
    for (int i = 0; i < 4; i++)
        rest[i / 2][i % 2] = C[i / 2][i % 2] + expm1(-k * b->layer[0]) * first[i / 2][i % 2];
}

/* Adds the displacements of one body with layers; sign: -1 of B, whose tangent is mirrored. */
static void add_layers(const body *b, double sign, const table *t, double *un, double *ut)
{
    static const double node[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                  0.9602898564975363},
                        weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                    0.1012285362903763}; /* of Gauss */
    const double *x = t->column[X], *h = t->column[H], *p = t->column[P], *q = t->column[Q],
                 d = b->layer[0], wide = fmax(fabs(x[0]), fabs(x[t->n - 1])) + h[0];
    double first[2][2], height = 0.0, rest[2][2];
    halfplane_compliance(b->young, b->poisson, first);
    for (int k = 0; k < b->layers; k++)
        height += b->layer[3 * k];
    /* the half-plane without the waves that are longer than d */
    for (int j = 0; j < t->n; j++)
        for (int i = 0; i < t->n; i++)
            for (int end = 0; end < 2; end++) {
                const double s = x[j] - x[i] + (end ? -0.5 : 0.5) * h[i], of = end ? -1.0 : 1.0,
                             ln = 0.5 * s * log1p(d * d / (s * s)) + d * atan(s / d),
                             turn = 0.5 * pi * fabs(s) - s * atan(s / d) +
                                    0.5 * d * log1p(s * s / (d * d));
                un[j] += of * (first[1][1] * ln * p[i] + sign * first[0][1] * turn * q[i]) / pi;
                ut[j] += of * (first[0][0] * ln * q[i] - sign * first[0][1] * turn * p[i]) / pi;
            }
    for (double k = 1e-13 / height, to; k < 40.0 / d; k = to) {
        to = fmin(2.0 * k, k + 3.0 / (2.0 * wide));
        for (int g = 0; g < 8; g++) {
            const double at = 0.5 * (k + to) + (g < 4 ? -0.5 : 0.5) * (to - k) * node[g % 4],
                         part = 0.5 * (to - k) * weight[g % 4] / (pi * at);
            double sum[2][2] = {{0.0}}; /* of p and q: cosines, sines */
            for (int i = 0; i < t->n; i++) {
                const double length = 2.0 * sin(0.5 * at * h[i]) / at, cosine = cos(at * x[i]),
                             sine = sin(at * x[i]);
                sum[0][0] += p[i] * length * cosine;
                sum[0][1] += p[i] * length * sine;
                sum[1][0] += q[i] * length * cosine;
                sum[1][1] += q[i] * length * sine;
            }
            wave_of_layers(b, at, rest);
            for (int j = 0; j < t->n; j++) {
                const double c = cos(at * x[j]), s = sin(at * x[j]);
                un[j] += part * (rest[1][1] * (c * sum[0][0] + s * sum[0][1]) +
                                 sign * rest[0][1] * (s * sum[1][0] - c * sum[1][1]));
                ut[j] += part * (rest[0][0] * (c * sum[1][0] + s * sum[1][1]) -
                                 sign * rest[0][1] * (s * sum[0][0] - c * sum[0][1]));
            }
        }
    }
}

static double mean(int n, const double *x)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += x[i] / n;
    return sum;
}

/* On an elastic base, and of a homogeneous body beside the layers, a constant is free (the datum).
 */
static void check_layers(const contact *c, const table *t)
{
    enum { MOST = 200 };
    const body *const bodies[] = {&c->a, &c->b};
    const double size = largest(t->n, t->column[UN]) + largest(t->n, t->column[UT]);
    int is_free = 0;
    if (!are_elastic_halfplanes(c) || !(c->a.layers || c->b.layers) || t->n > MOST ||
        !isnan(c->period) || strcmp(word(c->inputs, "layer-base"), "smooth") == 0 ||
        strcmp(word(c->inputs, "layer-base-b"), "smooth") == 0)
        return;
    double *u = doubles(4 * (size_t)t->n), *own = u + 2 * t->n;
    for (int k = 0; k < 2; k++) {
        contact alone = *c;
        (k ? &alone.a : &alone.b)->young = 0.0;
        is_free |= bodies[k]->young > 0.0 && (!bodies[k]->layers || bodies[k]->base_young > 0.0);
        if (bodies[k]->layers)
            add_layers(bodies[k], k ? -1.0 : 1.0, t, u, u + t->n);
        for (int i = 0; i < t->n && !bodies[k]->layers && bodies[k]->young > 0.0; i++) {
            long double un, ut;
            flamant(&alone, t, t->column[X][i], &un, &ut);
            u[i] += (double)un;
            u[t->n + i] += (double)ut;
        }
    }
    for (int i = 0; i < t->n; i++) {
        u[i] += number(c->inputs, "interlayer-normal") * t->column[P][i];
        u[t->n + i] += number(c->inputs, "interlayer-tangential") * t->column[Q][i];
        own[i] = t->column[UN][i];
        own[t->n + i] = t->column[UT][i];
    }
    for (int k = 0; k < 2; k++) {
        double *want = u + k * t->n, *got = own + k * t->n,
               shift = is_free ? mean(t->n, got) - mean(t->n, want) : 0.0;
        for (int i = 0; i < t->n; i++)
            expect(k ? "ut by waves" : "un by waves", got[i], want[i] + shift, 1e-9 * size);
    }
    free(u);
}

/* ---- Dissipation and error bars ---------------------------------------------------- */

static void check_power(const contact *c, const table *t, const json_t *list)
{
    const double D = number(c->summary, "dissipation");
    const double p0 = largest(t->n, t->column[P]);
    const double largest_slip = largest(t->n, t->column[SLIP]);
    double sum = 0.0, size = 0.0, summed = 0.0;
    if (c->formulation == STATIC) {
        if (!isnan(D))
            violated("dissipation", "of static contact is not null");
        return;
    }
    for (int i = 0; i < t->n; i++) {
        const double power = json_number_value(json_array_get(list, (size_t)i));
        sum += power * t->column[H][i];
        summed += fabs(power) * t->column[H][i];
        size += fabs(t->column[SLIP][i] * t->column[Q][i]) * t->column[H][i];
        /* of a steady state it is shared between neighbours, whatever their signs */
        if (c->formulation == TRANSIENT && power < -1e-9 * p0 * largest_slip)
            violated("friction power", "element %d gives %g", i + 1, power);
    }
    /* where nearly all sticks, all of it is lost between the midpoints, whose slip is
     * zero: then it is the rounding of the sum that counts */
    expect("dissipation", D, sum, 1e-11 * size + 1e-14 * (p0 + summed));
}

/* The work per rolled way of the pressure on the slope of the worn profile, which stays
 * in its place while the bodies roll through. */
static double work_of_profile(const contact *c, const table *t)
{
    double work = 0.0;
    for (int i = 0; c->worn && i + 1 < t->n; i++)
        work += 0.5 * (t->column[P][i] + t->column[P][i + 1]) *
                (json_number_value(json_array_get(c->worn, (size_t)i + 1)) -
                 json_number_value(json_array_get(c->worn, (size_t)i)));
    return work;
}

static int is_flat(const json_t *inputs, const char *support)
{
    return strcmp(word(inputs, support), "halfplane") == 0;
}

static double smallest_step(const table *t)
{
    double least = INFINITY;
    for (int i = 1; i < t->n; i++)
        least = fmin(least, t->column[X][i] - t->column[X][i - 1]);
    return least;
}

/* The longest element in contact as a part of the half-width. */
static double coarseness(const contact *c, const table *t)
{
    double longest = 0.0;
    for (int i = 0; i < t->n; i++)
        if (t->column[P][i] > 0.0)
            longest = fmax(longest, t->column[H][i]);
    return longest / number(c->summary, "half_width");
}

/* What the creepage feeds per rolled way: slip and friction meet as in the dissipation,
 * whose mean of two tractions gives q the way between its neighbours. */
static double fed_by_creepage(const contact *c, const table *t)
{
    const double *x = t->column[X], *q = t->column[Q];
    const int second = strcmp(word(c->inputs, "slip-operator"), "second") == 0;
    double fed = 0.0;
    for (int i = 1; i + 1 < t->n; i++)
        fed -= q[i] * (second ? t->column[H][i] : 0.5 * (x[i + 1] - x[i - 1]));
    return fed * (number(c->summary, "creepage") - bulk_strain(c));
}

/* -int p un' dx, a parabola through three neighbours as un. */
static double fed_by_surface(const table *t)
{
    const double *x = t->column[X], *un = t->column[UN];
    double fed = 0.0;
    for (int i = 1; i + 1 < t->n; i++) {
        const double d = x[i] - x[i - 1], e = x[i + 1] - x[i];
        const double slope =
            (un[i + 1] * d * d - un[i - 1] * e * e + un[i] * (e * e - d * d)) / (d * e * (d + e));
        fed -= t->column[P][i] * t->column[H][i] * slope;
    }
    return fed;
}

/* Where nothing slips the dissipation is 0, without what opens beside the edges between
 * midpoints, which the balance has: -lambda times the mean of two tractions. */
static double lost_beside_edges(const contact *c, const table *t)
{
    const int second = strcmp(word(c->inputs, "slip-operator"), "second") == 0;
    double lost = 0.0;
    for (int i = 0; i < t->n; i++)
        if (t->column[ZONE][i] > 1.0)
            return 0.0;
    for (int i = 0; i + 1 < t->n && !second; i++)
        lost -= 0.5 * t->column[SHIFT][i] * (t->column[Q][i] + t->column[Q][i + 1]);
    return lost;
}

/* On a wheel the displaced surface turns with it: per rolled way the lever arms of its
 * tractions feed int (p u_t - q u_n) dx/R.  B is rigid: the displacements are A's. */
static double fed_by_levers(const contact *c, const table *t)
{
    double fed = 0.0;
    for (int i = 0; i < t->n && !c->surface_normals; i++)
        fed += (t->column[P][i] * t->column[UT][i] - t->column[Q][i] * t->column[UN][i]) *
               t->column[H][i] / c->a.radius;
    return fed;
}

/* What creepage, the curvature and a worn profile feed is lost in friction and in the
 * bodies.  The power belongs to the tractions of the contact: with surface normals Q and
 * M/R are forces in other directions, and would miss xi M/R (theory-bodies.md V4). */
static void check_energy(const contact *c, const table *t)
{
    const double lost = number(c->summary, "dissipation") + number(c->summary, "hysteresis") +
                        lost_beside_edges(c, t);
    const double creepage = fed_by_creepage(c, t), surface = fed_by_surface(t);
    const int wheels =
        !is_flat(c->inputs, "support") || (c->b.young > 0.0 && !is_flat(c->inputs, "support-b"));
    const double *p = t->column[P], *h = t->column[H], *x = t->column[X];
    double by_curvature = work_of_profile(c, t), size = 0.0, P_ = 0.0;
    for (int i = 0; i < t->n; i++) {
        by_curvature += x[i] * p[i] * h[i] / c->radius;
        size += fabs(x[i]) * p[i] * h[i] / c->radius;
        P_ += p[i] * h[i];
    }
    const int relaxes = has_memory(c->inputs, "") || has_memory(c->inputs, "-b");
    /* of slopes of un */
    const double rounding = 1e-10 * (fabs(creepage) + size) +
                            1e-14 * P_ * largest(t->n, t->column[UN]) / smallest_step(t);
    if (number(c->summary, "hysteresis") < 0.0)
        violated("hysteresis", "is %g", number(c->summary, "hysteresis"));
    if (wheels) {
        /* of the elastic part, and of the edges, the error of the elements is left */
        const double bound = fmin(0.1, 0.02 + coarseness(c, t));
        /* an arc is clamped: it does not turn with what rolls */
        if (!(c->b.young > 0.0) && strcmp(word(c->inputs, "support"), "arc") != 0 &&
            (relaxes || coarseness(c, t) < 0.1))
            expect("energy of a wheel", lost, creepage + surface + fed_by_levers(c, t),
                   bound * (size + fabs(creepage)) + rounding);
        return;
    }
    if (relaxes)
        expect("energy of the surfaces", lost, creepage + surface, rounding);
    /* the edges of the contact are what is lost: of second order in the elements, of
     * which three in contact are all edge */
    const double edges = fmin(0.05, 3.0 * pow(coarseness(c, t), 2.0));
    if (strcmp(word(c->inputs, "gap"), "parabola") == 0 &&
        (relaxes ? coarseness(c, t) < 0.5 : coarseness(c, t) < 0.1))
        expect("energy", lost, creepage + by_curvature, edges * size + rounding);
}

/* Equilibrium about both axles, from the tractions alone: as what turns each of them. */
static void check_torques(const contact *c, double moment, double force, double size)
{
    const double radius[] = {c->a.radius, c->b.radius};
    expect("torque_a", number(c->summary, "torque_a"), moment + force * radius[0],
           1e-11 * (size + c->mu * number(c->summary, "normal_load") * radius[0]));
    if (!isfinite(radius[1])) {
        if (json_object_get(c->summary, "torque_b"))
            violated("torque_b", "of a plane is no result");
        return;
    }
    expect("torque_b", number(c->summary, "torque_b"),
           copysign(1.0, radius[1]) * (moment - force * radius[1]),
           1e-11 * (size + c->mu * number(c->summary, "normal_load") * fabs(radius[1])));
}

/* M, its ratio, the torques, and the energy of bodies that relax. */
static void check_resistance(const contact *c, const table *t)
{
    const double M = number(c->summary, "resistance_moment");
    const double lag = number(c->summary, "hysteresis");
    const double P_ = number(c->summary, "normal_load");
    double moment = 0.0, size = 0.0;
    if (c->formulation == STATIC) {
        const int tilted = !isnan(number(c->summary, "tilt"));
        for (int i = 0; i < t->n; i++) {
            moment += t->column[X][i] * t->column[P][i] * t->column[H][i];
            size += fabs(t->column[X][i]) * t->column[P][i] * t->column[H][i];
        }
        if (isnan(M) == tilted || !isnan(lag))
            violated("resistance_moment", "of static contact is %g", M);
        if (tilted)
            expect("resistance_moment", M, moment, 1e-11 * size);
        return;
    }
    for (int i = 0; i < t->n; i++) {
        const double x = t->column[X][i];
        const double sine = c->surface_normals ? x / c->a.radius : 0.0;
        const double upwards = t->column[P][i] * sqrt(1.0 - sine * sine) + t->column[Q][i] * sine;
        moment += x * upwards * t->column[H][i];
        size += fabs(x * upwards) * t->column[H][i];
    }
    expect("resistance_moment", M, moment, 1e-12 * size);
    check_torques(c, moment, number(c->summary, "tangential_load"), size);
    expect_same(c, "resistance_ratio", M / (P_ * c->radius), 1e-12);
    if (c->formulation != STEADY)
        return;
    if (!has_memory(c->inputs, "") && !has_memory(c->inputs, "-b") && lag != 0.0)
        violated("hysteresis", "of elastic bodies is %g", lag);
    if (strcmp(word(c->inputs, "yield-stress"), "none") == 0) /* plastic work is no slip */
        check_energy(c, t);
    const json_t *axle = json_object_get(c->inputs, "free-axle");
    if (json_is_true(axle))
        expect("free axle", number(c->summary, "torque_a"), 0.0,
               1e-10 * c->mu * P_ * c->a.radius + 1e-15 * P_ * number(c->summary, "half_width"));
}

static void check_errors(const contact *c)
{
    const char *key;
    json_t *value;
    json_object_foreach(json_object_get(c->summary, "errors"), key, value)
    {
        const double bar = json_number_value(value), of = number(c->summary, key);
        if (json_is_number(value) && !(bar >= 0.0))
            violated("error bar", "of %s is %g", key, bar);
        /* a coarser mesh may have no stick */
        if (json_is_null(value) && !isnan(of) && strncmp(key, "stick", 5) != 0)
            violated("error bar", "of %s = %g is missing", key, of);
    }
}

/* ---- Table and summary say what the JSON says -------------------------------------- */

/* Digit for digit; Fourier transforms may round differently from run to run. */
static void check_table(const contact *c, const table *json, const char *path)
{
    table t = table_from_file(path);
    const int rounded = strcmp(word(c->summary, "flexibility"), "transforms") == 0;
    if (t.n != json->n)
        violated("table", "%d rows, JSON has %d", t.n, json->n);
    for (int j = 0; j < COLUMNS; j++) {
        const double tol = rounded ? 10.0 * tolerance(c) * largest(t.n, t.column[j]) : 0.0;
        for (int i = 0; i < t.n && i < json->n; i++)
            if (!(fabs(t.column[j][i] - json->column[j][i]) <= tol))
                violated("table", "%s of element %d: %.17g, in JSON %.17g", column_names[j], i + 1,
                         t.column[j][i], json->column[j][i]);
    }
    table_free(&t);
}

static char *text_of(const char *path)
{
    FILE *file = fopen(path, "r");
    char *text = calloc(1, 200001);
    if (!file || !text)
        cannot("read", path);
    text[fread(text, 1, 200000, file)] = '\0';
    fclose(file);
    return text;
}

/* Numbers of the lines for people, by the words before them; they have 5 digits or more,
 * and what is small against `beside` is printed as 0. */
static void check_summary(const contact *c, const char *path)
{
    static const struct {
        const char *line, *before, *key, *beside;
    } said[] = {{"\n  load ", "P = ", "normal_load", NULL},
                {"\n  load ", ", Q = ", "tangential_load", "normal_load"},
                {"\n  load ", "Q/(mu P) = ", "force_ratio", NULL},
                {"\n  contact ", "contact ", "contact_from", NULL},
                {"\n  contact ", "... ", "contact_to", NULL},
                {"\n  contact ", "p0 = ", "max_pressure", NULL},
                {"\n  contact ", "approach ", "approach", NULL},
                {"\n  shift ", "shift ", "tangential_shift", NULL},
                {"\n  creepage ", "xi = ", "creepage", NULL},
                {"\n  creepage ", "xi R/(mu a) = ", "creep_ratio", NULL},
                {"\n  creepage ", "free rolling at ", "free_creepage", "creepage"},
                {"\n  power ", "power ", "dissipation", NULL},
                {"\n  elements ", ": ", "stick", NULL},
                {"\n  elements ", "stick, ", "slip", NULL},
                {"\n  elements ", "; stick ", "stick_from", NULL}};
    char *text = text_of(path);
    for (size_t k = 0; k < sizeof said / sizeof said[0]; k++) {
        char *line = strstr(text, said[k].line); /* "\n  load ..." */
        if (!line) {
            if (k == 0)
                violated("summary", "says nothing of the load");
            continue;
        }
        char room[400];
        snprintf(room, sizeof room, "%.*s", (int)strcspn(line + 1, "\n"), line + 1);
        const char *at = strstr(room, said[k].before);
        double want = number(c->summary, said[k].key);
        /* "N touch without friction, " are among those that slip in JSON, and stand before both */
        const char *touch = strstr(room, " touch without friction, ");
        if (touch && strcmp(said[k].key, "stick") == 0)
            at = strstr(touch, " stick, ") ? touch + strlen(" touch without friction") : NULL;
        if (touch && strcmp(said[k].key, "slip") == 0) {
            const double touching = strtod(strstr(room, ": ") + 2, NULL);
            if (!at && touching != want)
                violated("summary", "%g touch, in JSON %g slip", touching, want);
            want -= touching;
        }
        if (!at)
            continue;
        double tol = 6e-5 * fabs(want) + 1e-12;
        if (said[k].beside)
            tol += 2e-9 * fabs(number(c->summary, said[k].beside));
        const double got = strtod(at + strlen(said[k].before), NULL);
        if (!(fabs(got - want) <= tol))
            violated("summary", "%s = %g, in JSON %.17g", said[k].key, got, want);
    }
    free(text);
}

/* ---- Histories --------------------------------------------------------------------- */

static double last_of(const json_t *list)
{
    const json_t *last = json_array_get(list, json_array_size(list) - 1);
    return json_is_number(last) ? json_number_value(last) : NAN;
}

/* The last step is what the table shows. */
static void check_history(const contact *c, const json_t *history, const rows *controls)
{
    static const char *const same[] = {"approach",    "normal_load", "tangential_load",
                                       "force_ratio", "stick",       "slip"};
    const json_t *distance = json_object_get(history, "distance");
    if (!history) {
        if (c->steps)
            violated("history", "is missing");
        return;
    }
    for (size_t k = 0; k < sizeof same / sizeof same[0]; k++) {
        const json_t *list = json_object_get(history, same[k]);
        const double want = number(c->summary, same[k]);
        if (json_array_size(list) == 0 || (c->mu == 0.0 && k == 3))
            continue;
        if (!isnan(want) || !isnan(last_of(list)))
            expect(same[k], last_of(list), want, 1e-12 * fabs(want));
    }
    for (size_t i = 1; i < json_array_size(distance); i++)
        if (json_number_value(json_array_get(distance, i)) <
            json_number_value(json_array_get(distance, i - 1)))
            violated("history", "step %zu goes back", i + 1);
    const double end = wanted(c, controls, "distance", "distance");
    if (c->formulation == TRANSIENT)
        expect("rolled distance", last_of(distance), end, 1e-9 * end);
}

/* ---- Curves ------------------------------------------------------------------------ */

static double entry(const json_t *object, const char *key, size_t i)
{
    const json_t *value = json_array_get(json_object_get(object, key), i);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

/* With surface normals Q holds a part of the pressure. */
static void check_curve(const json_t *inputs, const json_t *curve, int surface_normals)
{
    const double mu = largest_mu(inputs, number(inputs, "mu"));
    expect("curve, mu", number(curve, "mu"), mu, 1e-12);
    for (size_t i = 0; i < json_array_size(json_object_get(curve, "creepage")); i++) {
        const double P_ = entry(curve, "normal_load", i), Q_ = entry(curve, "tangential_load", i);
        const double ratio = entry(curve, "force_ratio", i);
        const double stick = entry(curve, "stick_ratio", i);
        const double xi = entry(curve, "creepage", i), D = entry(curve, "dissipation", i);
        if (!(P_ > 0.0) || (fabs(Q_) > (mu * (1.0 + 1e-9) + 1e-12) * P_ && !surface_normals))
            violated("curve", "point %zu: P = %g, Q = %g, mu = %g", i + 1, P_, Q_, mu);
        if (mu > 0.0 && !is_table_law(inputs))
            expect("curve, force_ratio", ratio, Q_ / (mu * P_), 1e-12);
        if (!(stick >= 0.0 && stick <= 1.0))
            violated("curve", "point %zu: stick_ratio = %g", i + 1, stick);
        /* steady slip and friction live half an element apart: D >= 0 but for that */
        if (!(D >= -1e-3 * P_ * fmax(fabs(xi), 1e-3)))
            violated("curve", "point %zu: dissipation %g", i + 1, D);
        if (!(entry(curve, "residual", i) <= 1e-8))
            violated("curve", "point %zu: residual %g", i + 1, entry(curve, "residual", i));
    }
}

/* ---- Stress ------------------------------------------------------------------------ */

/* Poisson's ratio at a depth; NAN in a rigid base. */
static double poisson_at(const body *b, double depth)
{
    double bond = 0.0;
    for (int k = 0; k < b->layers; k++)
        if (depth <= (bond += b->layer[3 * k]))
            return b->layer[3 * k + 2];
    return b->layers == 0 ? b->poisson : b->base_young > 0.0 ? b->base_poisson : NAN;
}

/* What follows from the tensor follows from the printed tensor. */
static void check_stress(const json_t *root, const json_t *at)
{
    const json_t *inputs = json_object_get(root, "inputs");
    const int disc = strcmp(word(inputs, "plane"), "stress") == 0;
    const int of_b = strcmp(word(root, "body"), "b") == 0;
    body b = body_of(inputs, of_b ? "-b" : "");
    if (of_b && b.young == 0.0) { /* --similar */
        free(b.layer);
        b = body_of(inputs, "");
    }
    for (size_t i = 0; i < json_array_size(json_object_get(at, "x_mm")); i++) {
        const double xx = entry(at, "sxx_MPa", i), yy = entry(at, "syy_MPa", i);
        const double zz = entry(at, "szz_MPa", i), xy = entry(at, "sxy_MPa", i);
        const double depth = (of_b ? -1.0 : 1.0) * entry(at, "y_mm", i),
                     inside = poisson_at(&b, depth), nu = disc ? 0.0 : inside;
        if (isnan(inside) && !isnan(xx))
            violated("stress", "of point %zu in a rigid base is %g", i + 1, xx);
        if (isnan(xx))
            continue;
        const double mean = 0.5 * (xx + yy), shear = hypot(0.5 * (xx - yy), xy);
        const double third = (xx + yy + zz) / 3.0;
        const double mises =
            sqrt(0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) +
                 3.0 * xy * xy);
        const double tol = 1e-11 * (fabs(xx) + fabs(yy) + fabs(xy)) + 1e-300;
        expect("szz", zz, nu * (xx + yy), tol);
        expect("max_shear", entry(at, "max_shear_MPa", i), shear, tol);
        expect("principal_1", entry(at, "principal_1_MPa", i), mean + shear, tol);
        expect("principal_2", entry(at, "principal_2_MPa", i), mean - shear, tol);
        expect("hydrostatic", entry(at, "hydrostatic_MPa", i), third, tol);
        expect("von_mises", entry(at, "von_mises_MPa", i), mises, tol);
    }
    free(b.layer);
}

/* ---- All together ------------------------------------------------------------------ */

static void check_case(const json_t *root, const char *table_path, const char *summary_path,
                       const rows *controls)
{
    contact c = contact_of(root, controls);
    const json_t *object = json_object_get(root, "table");
    const char *status = word(c.summary, "status");
    table t = table_from_json(object);
    if (isinf(c.a.datum) && t.n > 0) /* a flat punch: of its half-width */
        c.a.datum = (t.column[X][t.n - 1] - t.column[X][0] +
                     0.5 * (t.column[H][0] + t.column[H][t.n - 1])) /
                    exp(1.0);
    c.worn = json_object_get(object, "worn_mm");
    c.plastic = json_object_get(object, "plastic_mm");
    if (!c.worn != !word(c.inputs, "worn")[0])
        violated("worn", "the column does not follow --worn");
    if (strcmp(status, "solved") != 0)
        violated("status", "'%s' with exit code 0", status);
    check_elements(&t);
    check_contact(&c, &t);
    check_law(&c, &t, object, controls);
    check_friction(&c, &t);
    check_yield(&c, &t);
    check_sums(&c, &t);
    check_ratios(&c, &t);
    check_normal_control(&c, controls);
    check_tangential_control(&c, controls);
    check_kinematics(&c, &t);
    check_flamant(&c, &t);
    check_layers(&c, &t);
    check_heat(&c, &t, object);
    check_power(&c, &t, json_object_get(object, "friction_power_MPa"));
    check_resistance(&c, &t);
    check_errors(&c);
    check_history(&c, json_object_get(root, "history"), controls);
    if (table_path)
        check_table(&c, &t, table_path);
    if (summary_path)
        check_summary(&c, summary_path);
    table_free(&t);
    free(c.mu_of);
    free(c.a.layer);
    free(c.b.layer);
}

int main(int argc, char **argv)
{
    const char *table_path = NULL, *summary_path = NULL, *controls_path = NULL;
    json_error_t error;
    rows controls = {0, 0, NULL, ""};
    int k = 1;
    for (; k + 1 < argc; k += 2) {
        if (strcmp(argv[k], "--table") == 0)
            table_path = argv[k + 1];
        else if (strcmp(argv[k], "--summary") == 0)
            summary_path = argv[k + 1];
        else if (strcmp(argv[k], "--controls") == 0)
            controls_path = argv[k + 1];
        else
            cannot("understand", argv[k]);
    }
    if (k >= argc)
        cannot("work without", "a JSON file");
    json_t *root = json_load_file(argv[k], JSON_REJECT_DUPLICATES, &error);
    if (!root)
        cannot("read", argv[k]);
    if (controls_path)
        controls = rows_from_file(controls_path);
    if (strcmp(word(root, "schema"), "rollbem/1") != 0)
        violated("schema", "'%s'", word(root, "schema"));
    if (json_object_get(root, "table"))
        check_case(root, table_path, summary_path, controls_path ? &controls : NULL);
    const json_t *inputs = json_object_get(root, "inputs");
    const json_t *curve = json_object_get(root, "curve");
    if (curve)
        check_curve(inputs, curve, strcmp(word(inputs, "normals"), "surface") == 0);
    if (json_object_get(root, "grid"))
        check_stress(root, json_object_get(root, "grid"));
    if (json_object_get(root, "points"))
        check_stress(root, json_object_get(root, "points"));
    if (!json_object_get(root, "table") && !curve && !json_object_get(root, "grid") &&
        !json_object_get(root, "points"))
        violated("JSON", "has no table, curve or stress");
    free(controls.x);
    json_decref(root);
    return violations > 0;
}
