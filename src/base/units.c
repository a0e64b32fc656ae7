/* Units as products of powers of a few words, and their factors to mm, N, MPa, s. */
#include "base/units.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Words ------------------------------------------------------------------------- */

enum { LENGTH, FORCE, TIME, TEMPERATURE, ANGLE, MASS, DIMENSIONS };

/* Exponents are counted in halves, for stress intensities in MPa m^0.5.  Powers of ten stay
 * apart, so that they only move the point of a number. */
typedef struct {
    int dimension[DIMENSIONS]; /* twice the exponents of mm, N, s, K, degrees, g */
    int ten;                   /* twice the exponent of ten */
    double up, down;           /* the rest of the factor is up / down */
} product;

/* A word is 10^ten of a dimension (mm, N, s, K, degrees, g), or means a product of other words.
 * prefixes: letters it takes; '+': it also takes their names and a plural s. */
typedef struct {
    const char *name, *means, *prefixes;
    int dimension, ten;
} word;

static const word words[] = {
    {"m", NULL, "numcdk", LENGTH, 3},
    {"metre", "m", "numcdk+", 0, 0},
    {"meter", "m", "numcdk+", 0, 0},
    {"micron", "um", "+", 0, 0},
    {"in", "25.4 mm", "u", 0, 0},
    {"inch", "in", "u", 0, 0},
    {"inches", "in", "u", 0, 0},
    {"ft", "12 in", "", 0, 0},
    {"foot", "ft", "", 0, 0},
    {"feet", "ft", "", 0, 0},
    {"yd", "36 in", "", 0, 0},
    {"mil", "1e-3 in", "+", 0, 0},
    {"thou", "mil", "", 0, 0},
    {"mile", "1609.344 m", "+", 0, 0},
    {"N", NULL, "numkMG", FORCE, 0},
    {"newton", "N", "numkMG+", 0, 0},
    {"dyn", "1e-5 N", "", 0, 0},
    {"kgf", "9.80665 N", "", 0, 0},
    {"kp", "kgf", "", 0, 0},
    {"gf", "1e-3 kgf", "", 0, 0},
    {"tf", "1e3 kgf", "", 0, 0},
    {"lbf", "4.4482216152605 N", "kM", 0, 0},
    {"lb", "lbf", "+", 0, 0},
    {"kip", "1e3 lbf", "+", 0, 0},
    {"pli", "lbf/in", "", 0, 0},
    {"PLI", "pli", "", 0, 0},
    {"Pa", "N/m2", "hkMGT", 0, 0},
    {"pascal", "Pa", "hkMGT+", 0, 0},
    {"bar", "1e5 Pa", "mk", 0, 0},
    {"atm", "101325 Pa", "", 0, 0},
    {"psi", "lbf/in2", "kM", 0, 0},
    {"ksi", "1e3 psi", "", 0, 0},
    {"Msi", "1e6 psi", "", 0, 0},
    {"J", "N m", "numkMG", 0, 0},
    {"joule", "J", "numkMG+", 0, 0},
    {"W", "N m/s", "numkM", 0, 0},
    {"watt", "W", "numkM+", 0, 0},
    {"s", NULL, "num", TIME, 0},
    {"sec", "s", "num+", 0, 0},
    {"second", "s", "num+", 0, 0},
    {"min", "60 s", "", 0, 0},
    {"minute", "min", "+", 0, 0},
    {"h", "60 min", "", 0, 0},
    {"hr", "h", "+", 0, 0},
    {"hour", "h", "+", 0, 0},
    {"Hz", "s^-1", "mkM", 0, 0},
    {"hertz", "Hz", "mkM+", 0, 0},
    {"mph", "mile/h", "", 0, 0},
    {"kph", "km/h", "", 0, 0},
    {"fpm", "ft/min", "", 0, 0},
    {"K", NULL, "", TEMPERATURE, 0},
    {"kelvin", "K", "+", 0, 0},
    {"deg", NULL, "", ANGLE, 0},
    {"degree", "deg", "+", 0, 0},
    {"rad", "57.29577951308232 deg", "mu", 0, 0}, /* 180/pi */
    {"radian", "rad", "+", 0, 0},
    {"g", NULL, "numk", MASS, 0},
    {"gram", "g", "numk+", 0, 0},
    {"%", "1e-2", "", 0, 0},
    {"percent", "1e-2", "", 0, 0},
    {"pct", "1e-2", "", 0, 0},
    {"permille", "1e-3", "", 0, 0},
    {"ppm", "1e-6", "", 0, 0},
};

enum { WORDS = sizeof words / sizeof *words };

static const struct {
    char letter;
    const char *name;
    int ten;
} prefixes[] = {{'n', "nano", -9}, {'u', "micro", -6}, {'m', "milli", -3}, {'c', "centi", -2},
                {'d', "deci", -1}, {'h', "hecto", 2},  {'k', "kilo", 3},   {'M', "mega", 6},
                {'G', "giga", 9},  {'T', "tera", 12}};

enum { PREFIXES = sizeof prefixes / sizeof *prefixes };

/* ---- Products ---------------------------------------------------------------------- */

static const product one = {{0}, 0, 1.0, 1.0};

static int same_dimensions(const product *u, const product *v)
{
    return memcmp(u->dimension, v->dimension, sizeof u->dimension) == 0;
}

/* u times v, or over it. */
static void multiply(product *u, const product *v, int over)
{
    for (int k = 0; k < DIMENSIONS; k++)
        u->dimension[k] += over ? -v->dimension[k] : v->dimension[k];
    u->ten += over ? -v->ten : v->ten;
    u->up *= over ? v->down : v->up;
    u->down *= over ? v->up : v->down;
}

/* u to the power of halves/2; 0: an exponent is then no half. */
static int raise(product *u, int halves)
{
    product power = one, root = *u;
    int *of[DIMENSIONS + 1] = {&root.ten};
    if (halves % 2 != 0) {
        for (int k = 0; k < DIMENSIONS; k++)
            of[k + 1] = &root.dimension[k];
        for (int k = 0; k <= DIMENSIONS; k++) {
            if (*of[k] % 2 != 0)
                return 0;
            *of[k] /= 2;
        }
        root.up = sqrt(u->up);
        root.down = sqrt(u->down);
        multiply(&power, &root, halves < 0);
    }
    for (int k = 0; k < abs(halves) / 2; k++)
        multiply(&power, u, halves < 0);
    *u = power;
    return 1;
}

/* A text that is read; folds: capitals do not matter; below: all behind a / stands under it, so
 * that N/mm K is N/(mm K); named: a word has been read; joined: two that are written as one. */
typedef struct {
    const char *at;
    int folds, below, trusted, named, joined;
} reader;

static int read_product(reader *r, int inside, product *u);

/* What the words mean themselves is read as it stands. */
static int meaning(const word *w, product *u)
{
    if (w->means) {
        reader r = {.at = w->means, .trusted = 1};
        return read_product(&r, 0, u);
    }
    *u = one;
    u->dimension[w->dimension] = 2;
    u->ten = 2 * w->ten;
    return 1;
}

static int same_text(const char *a, const char *b, size_t n, int folds)
{
    for (size_t k = 0; k < n; k++)
        if (a[k] != b[k] &&
            !(folds && tolower((unsigned char)a[k]) == tolower((unsigned char)b[k])))
            return 0;
    return 1;
}

/* The power of ten of the n letters before a word, if it takes them: "", k, kilo. */
static int read_prefix(const word *w, const char *text, size_t n, int folds, int *ten)
{
    int found = n == 0;
    *ten = 0;
    for (int p = 0; p < PREFIXES && n > 0; p++) {
        const char letter[] = {prefixes[p].letter, '\0'};
        const char *as = n == 1 ? letter : prefixes[p].name;
        if (strchr(w->prefixes, letter[0]) && (n == 1 || strchr(w->prefixes, '+')) &&
            strlen(as) == n && same_text(text, as, n, folds)) {
            *ten = prefixes[p].ten;
            found++;
        }
    }
    return found;
}

/* 1: the n letters are one word.  Letters that are several words, such as mn for mN and MN where
 * capitals do not matter, are none. */
static int find_word(const char *text, size_t n, int folds, product *u)
{
    const word *found = NULL;
    int ten = 0, ways = 0, shift;
    for (const word *w = words; w < words + WORDS; w++)
        for (size_t plural = 0; plural < (strchr(w->prefixes, '+') ? 2 : 1); plural++) {
            const size_t length = strlen(w->name) + plural, at = n - length;
            if (length > n || !same_text(text + at, w->name, length - plural, folds) ||
                (plural && !same_text(text + n - 1, "s", 1, folds)))
                continue;
            const int all = read_prefix(w, text, at, folds, &shift);
            ways += all;
            found = all ? w : found;
            ten = all ? shift : ten;
        }
    if (ways != 1 || !meaning(found, u))
        return 0;
    u->ten += 2 * ten;
    return 1;
}

/* As find_word, or two of them without anything between: Nm, mK. */
static int find_words(reader *r, const char *text, size_t n, product *u)
{
    product second;
    if (find_word(text, n, r->folds, u))
        return 1;
    for (size_t k = 1; k < n && !r->folds; k++)
        if (find_word(text, k, 0, u) && find_word(text + k, n - k, 0, &second)) {
            multiply(u, &second, 0);
            r->joined = 1;
            return 1;
        }
    return 0;
}

/* Twice the exponent behind a word or a bracket: 2, -1, ^2, ^0.5, ^(1/2), ^-1; without one 2. 0: it
 * is none. */
static int read_exponent(reader *r)
{
    const char *at = r->at;
    const int caret = *at == '^', bracket = caret && at[1] == '(';
    at += caret + bracket;
    if (!isdigit((unsigned char)at[*at == '-']) && !(caret && *at == '.'))
        return caret ? 0 : 2;
    char *end;
    double exponent = caret ? rb_read_number(at, &end) : (double)strtol(at, &end, 10);
    /* a half, as 3/2 */
    if ((caret || exponent == 1.0) && end[0] == '/' && end[1] == '2' &&
        !isalnum((unsigned char)end[2])) {
        exponent /= 2.0;
        end += 2;
    }
    if (bracket && *end++ != ')')
        return 0;
    r->at = end;
    const double halves = 2.0 * exponent;
    return halves == floor(halves) && fabs(halves) < 20.0 ? (int)halves : 0;
}

/* A number: of people 1 or a power of ten, or any below the line: kN/12mm. */
static int read_factor_number(reader *r, int over, product *u)
{
    char *end;
    const double x = rb_read_number(r->at, &end);
    const char *power = memchr(r->at, 'e', (size_t)(end - r->at));
    const int is_power = r->at[0] == '1' && (end == r->at + 1 || power == r->at + 1);
    if (!(x > 0.0) || !isfinite(x) || !(is_power || over || r->trusted))
        return 0;
    *u = one;
    if (is_power)
        u->ten = power ? 2 * atoi(power + 1) : 0;
    else
        u->up = x;
    r->at = end;
    return abs(u->ten) < 200;
}

static int read_factor(reader *r, int over, product *u)
{
    const char *from = r->at;
    if (*from == '(') {
        r->at++;
        if (!read_product(r, 1, u) || *r->at++ != ')')
            return 0;
    } else if (*from == '\1' || strncmp(from, "sqrt(", 5) == 0) { /* a root */
        r->at += *from == '\1' ? 1 : 4;
        return read_factor(r, over, u) && raise(u, 1);
    } else if (isdigit((unsigned char)*from)) {
        return read_factor_number(r, over, u);
    } else {
        while (isalpha((unsigned char)*r->at) || *r->at == '%')
            r->at++;
        r->named = 1;
        if (r->at == from || !find_words(r, from, (size_t)(r->at - from), u))
            return 0;
    }
    const int halves = read_exponent(r);
    return halves != 0 && raise(u, halves);
}

/* Factors with blanks, points, stars, hyphens or slashes between; inside: up to a bracket. */
static int read_product(reader *r, int inside, product *u)
{
    int factors = 0, over = 0, line = 0;
    *u = one;
    while (*r->at && !(inside && *r->at == ')')) {
        if (*r->at == '/') {
            if (line)
                return 0;
            over = line = 1;
            r->at++;
        } else if (strchr(" .*-", *r->at)) {
            r->at++;
        } else {
            product factor;
            if (!read_factor(r, over, &factor))
                return 0;
            multiply(u, &factor, over);
            over = r->below && over;
            line = 0;
            factors++;
        }
    }
    return factors > 0 && !line;
}

/* One spelling of those that people type; 0: too long. */
static int respell(const char *name, size_t length, char *to, size_t size)
{
    static const char *const spelling[][2] = {{"²", "^2"},
                                              {"³", "^3"},
                                              {"⁻¹", "^-1"},
                                              {"⁻²", "^-2"},
                                              {"·", " "},
                                              {"×", " "},
                                              {"μ", "u"},
                                              {"µ", "u"},
                                              {"√", "\1"},
                                              {"°", "deg"},
                                              {"‰", "permille"},
                                              {"**", "^"},
                                              {"−", "-"},
                                              {" per ", "/"},
                                              {"per cent", "%"},
                                              /* Latin-1 */ {"\xb2", "^2"},
                                              {"\xb3", "^3"},
                                              {"\xb5", "u"},
                                              {"\xb0", "deg"}};
    const char *end = name + length;
    size_t n = 0;
    while (name < end) {
        size_t from = 1, many = 1;
        const char *as = name;
        for (size_t k = 0; k < sizeof spelling / sizeof *spelling; k++) {
            const size_t bytes = strlen(spelling[k][0]);
            if (bytes > (size_t)(end - name) || memcmp(name, spelling[k][0], bytes) != 0)
                continue;
            from = bytes;
            as = spelling[k][1];
            many = strlen(as);
            break;
        }
        if (n + many + 1 > size)
            return 0;
        memcpy(to + n, as, many);
        n += many;
        name += from;
    }
    to[n] = '\0';
    return 1;
}

/* Reads a unit; with `like` it must have its dimensions, and without, letters that are two words
 * are none.  folds: letters that are all large or all small may stand for others. */
static int read_unit(const char *name, size_t length, const product *like, int folds, product *u)
{
    char text[120];
    if (!respell(name, length, text, sizeof text))
        return 0;
    int large = 0, small = 0;
    for (const char *c = text; *c; c++) {
        large |= isupper((unsigned char)*c) != 0;
        small |= islower((unsigned char)*c) != 0;
    }
    /* as it stands before letters of any size; N/mm K is N/(mm K) before (N/mm) K */
    for (int way = 0; way < (folds && large != small ? 4 : 2); way++) {
        reader r = {.at = text, .folds = way >= 2, .below = way % 2 == 0};
        if (read_product(&r, 0, u) && r.named && (like ? same_dimensions(u, like) : !r.joined))
            return 1;
    }
    return 0;
}

/* ---- Kinds and systems ------------------------------------------------------------- */

/* The units of a system, by what they stand for; and what a refusal lists. */
static const struct {
    const char *kind, *name[3], *known;
} kinds[] = {
    {"mm", {"mm", "m", "in"}, "mm, m, cm, um, nm, km, in, ft, mil, thou"},
    {"mm2", {"mm2", "m2", "in2"}, "mm2, m2, um2, in2"},
    {"MPa",
     {"MPa", "Pa", "psi"},
     "MPa, Pa, kPa, GPa, bar, N/mm2, N/m2, GN/m2, kgf/mm2, psi, ksi, Mpsi"},
    {"N/mm",
     {"N/mm", "N/m", "lbf/in"},
     "N/mm, N/m, N/cm, kN/m, kN/mm, MN/m, kgf/mm, lbf/in, lbf/ft, kip/in, or over a width as "
     "100kN/12mm"},
    {"N", {"N", "N", "lbf"}, "N, kN, MN, kgf, lbf, kip, N mm/mm"},
    {"mm/s", {"mm/s", "m/s", "in/s"}, "mm/s, m/s, m/min, km/h, in/s, ft/s, ft/min, mph"},
    {"mm/MPa", {"mm/MPa", "m/Pa", "in/psi"}, "mm/MPa, um/MPa, mm3/N, m/Pa, in/psi"},
    {"MPa/mm", {"MPa/mm", "Pa/m", "psi/in"}, "MPa/mm, N/mm3, MPa/um, GPa/mm, Pa/m, GPa/m, psi/in"},
    {"1/MPa",
     {"1/MPa", "1/Pa", "1/psi"},
     "1/MPa, 1/Pa, 1/GPa, mm2/N, m2/N, mm3/(N m), mm3/Nm, m3/(N m), mm3/J, um3/J, 1/psi, in2/lbf"},
    {"MPa.mm^0.5",
     {"MPa.mm^0.5", "Pa.m^0.5", "psi.in^0.5"},
     "MPa.mm^0.5, N/mm^1.5, MPa.m^0.5, Pa.m^0.5, psi.in^0.5, ksi.in^0.5"},
    {"MPa.N/mm", {"MPa.N/mm", "Pa.N/m", "psi.lbf/in"}, "MPa.N/mm, Pa.N/m, psi.lbf/in"},
    {"s", {"s", "s", "s"}, "s, ms, us, min, h"},
    {"degrees", {"degrees", "degrees", "degrees"}, "degrees, deg, rad"},
    {"W/(m K)",
     {"W/(m K)", "W/(m K)", "W/(m K)"},
     "W/(m K), kW/(m K), W/(mm K), W/(cm K), N/(s K)"},
    {"MJ/(m3 K)",
     {"MJ/(m3 K)", "MJ/(m3 K)", "MJ/(m3 K)"},
     "MJ/(m3 K), kJ/(m3 K), J/(m3 K), J/(cm3 K), MPa/K"},
    {"K", {"K", "K", "K"}, "K"},
    {"Hz", {"Hz", "Hz", "Hz"}, "Hz, kHz; or rad/s"},
    {"rad/s", {"rad/s", "rad/s", "rad/s"}, "rad/s; or Hz"},
};

enum { KINDS = sizeof kinds / sizeof *kinds };

/* The place of a kind in the table; KINDS: it is none. */
static int kind_of(const char *unit)
{
    int k = 0;
    while (k < KINDS && strcmp(kinds[k].kind, unit) != 0)
        k++;
    return k;
}

const char *rb_unit_name(rb_units system, const char *unit)
{
    const int k = kind_of(unit);
    return k < KINDS ? kinds[k].name[system] : unit;
}

const char *rb_unit_list(const char *unit)
{
    const int k = kind_of(unit);
    return k < KINDS ? kinds[k].known : NULL;
}

/* What a kind is a product of; 0: its numbers have no unit that others could stand for. */
static int product_of(const char *kind, product *u)
{
    *u = one;
    return strcmp(kind, "-") == 0 || strcmp(kind, "1") == 0 ||
           (kind_of(kind) < KINDS && read_unit(kind, strlen(kind), NULL, 0, u));
}

/* The factor of the unit `name` to a kind. */
static int find_factor(const char *name, size_t length, const char *kind, int folds,
                       rb_unit_factor *to)
{
    product like, u;
    if (!product_of(kind, &like) || !read_unit(name, length, &like, folds, &u))
        return 0;
    multiply(&u, &like, 1);
    /* half a power of ten is a root of 1000 */
    const int odd = u.ten % 2 != 0;
    *to = (rb_unit_factor){(u.ten - (odd ? 3 : 0)) / 2, u.up * (odd ? sqrt(1000.0) : 1.0), u.down};
    return 1;
}

int rb_unit_is_known(const char *name)
{
    product u;
    return read_unit(name, strlen(name), NULL, 0, &u);
}

/* ---- Numbers ----------------------------------------------------------------------- */

/* x 10^power as if x had been typed with the point elsewhere. */
static double move_point(double x, int power)
{
    char digits[40], moved[60];
    if (power == 0 || x == 0.0 || !isfinite(x))
        return x;
    rb_format(digits, sizeof digits, "%.14e", x);
    if (rb_read_number(digits, NULL) != x)
        rb_format(digits, sizeof digits, "%.16e", x);
    char *exponent = strchr(digits, 'e');
    *exponent = '\0';
    snprintf(moved, sizeof moved, "%se%d", digits, atoi(exponent + 1) + power);
    return rb_read_number(moved, NULL);
}

double rb_unit_times(const rb_unit_factor *f, double x)
{
    return move_point(x, f->power) * f->up / f->down;
}

double rb_unit_over(const rb_unit_factor *f, double x)
{
    return move_point(x * f->down / f->up, -f->power);
}

int rb_unit_of_system(rb_units system, const char *unit, rb_unit_factor *f)
{
    *f = (rb_unit_factor){0, 1.0, 1.0};
    const int k = system == RB_UNITS_MM || !unit ? KINDS : kind_of(unit);
    return k < KINDS && strcmp(kinds[k].name[system], unit) != 0 &&
           find_factor(kinds[k].name[system], strlen(kinds[k].name[system]), unit, 0, f);
}

double rb_unit_shown(rb_units system, const char *unit, double x)
{
    rb_unit_factor f;
    return rb_unit_of_system(system, unit, &f) ? rb_unit_over(&f, x) : x;
}

double rb_unit_stored(rb_units system, const char *unit, double x)
{
    rb_unit_factor f;
    return rb_unit_of_system(system, unit, &f) ? rb_unit_times(&f, x) : x;
}

/* ---- Lines for people -------------------------------------------------------------- */

enum { LINE_NUMBERS = 32 };

/* A number of a line; unit: where its unit begins, NULL: it has none, or shares the next one's. */
typedef struct {
    const char *at, *end, *unit;
    size_t length; /* of the unit */
    rb_unit_factor factor;
    int converts;
} line_number;

/* The unit behind a number, " mm" or ") mm", as far as the system has another one for it. */
static void find_unit(rb_units system, line_number *n)
{
    char unit[20];
    const char *at = n->end + (*n->end == ')');
    if (*at++ != ' ')
        return;
    n->length = strspn(at, "MPaNm/s12");
    if (n->length == 0 || n->length >= sizeof unit || isalnum((unsigned char)at[n->length]) ||
        (at[n->length] && strchr("^(", at[n->length])) ||
        (at[n->length] == '.' && isalnum((unsigned char)at[n->length + 1])))
        return;
    snprintf(unit, sizeof unit, "%.*s", (int)n->length, at);
    n->converts = rb_unit_of_system(system, unit, &n->factor);
    n->unit = n->converts ? at : NULL;
}

/* Whether two numbers share the unit of the second one: "1 to 2 mm", "1 and 2 mm", "(1, 2) mm". */
static int share_unit(const line_number *n, const line_number *next)
{
    static const char *const between[] = {" to ", " and ", ", "};
    for (size_t k = 0; k < sizeof between / sizeof *between; k++)
        if ((size_t)(next->at - n->end) == strlen(between[k]) &&
            strncmp(n->end, between[k], strlen(between[k])) == 0)
            return *between[k] == ' ' || *next->end == ')';
    return 0;
}

/* The numbers of a line outside single quotes. */
static int find_numbers(rb_units system, const char *line, line_number *n)
{
    int found = 0, quoted = 0;
    for (const char *at = line; *at && found < LINE_NUMBERS;) {
        const int before = at > line ? (unsigned char)at[-1] : ' ';
        char *end = NULL;
        const int begins = strchr(" (", before) != NULL;
        if (*at == '\'' && (quoted || begins)) /* not that of "A's" */
            quoted = !quoted;
        if (!quoted && begins &&
            isdigit((unsigned char)at[*at == '-' ? 1 + (at[1] == '.') : *at == '.']))
            rb_read_number(at, &end);
        if (end && end > at) {
            n[found] = (line_number){.at = at, .end = end};
            find_unit(system, &n[found++]);
        }
        at = end && end > at ? end : at + 1;
    }
    return found;
}

/* x with as many digits as the number has, but for the last of more than six: up to six it may be
 * the largest that is accepted, and is not rounded up. */
static void append_converted(char *said, size_t size, const line_number *n)
{
    enum { FEW = 6 };
    static const double rounding = 1e-8; /* of a number that has more */
    const double x = rb_unit_over(&n->factor, rb_read_number(n->at, NULL));
    const char *at = n->at + strspn(n->at, "-0.");
    int digits = 0;
    for (; at < n->end && *at != 'e'; at++)
        digits += *at != '.';
    rb_append(said, size, "%.*g", digits > FEW ? digits - 1 : FEW,
              digits > FEW ? x : rb_largest_shown(x * (1.0 + rounding)));
}

void rb_unit_translate(rb_units system, char *line, size_t size)
{
    line_number n[LINE_NUMBERS];
    char said[sizeof((rb_message *)0)->text] = "";
    const char *from = line;
    const int numbers = find_numbers(system, line, n);
    for (int i = numbers - 2; i >= 0; i--)
        if (!n[i].converts && n[i + 1].converts && share_unit(&n[i], &n[i + 1])) {
            n[i].converts = 1;
            n[i].factor = n[i + 1].factor;
        }
    for (int i = 0; i < numbers; i++) {
        if (!n[i].converts)
            continue;
        rb_append(said, sizeof said, "%.*s", (int)(n[i].at - from), from);
        append_converted(said, sizeof said, &n[i]);
        from = n[i].end;
        if (n[i].unit) {
            char unit[20];
            snprintf(unit, sizeof unit, "%.*s", (int)n[i].length, n[i].unit);
            rb_append(said, sizeof said, "%.*s%s", (int)(n[i].unit - from), from,
                      rb_unit_name(system, unit));
            from = n[i].unit + n[i].length;
        }
    }
    if (from > line) {
        rb_append(said, sizeof said, "%s", from);
        snprintf(line, size, "%s", said);
    }
}

/* Why the text, whose unit is not one of the kind, is refused. */
static rb_status refuse_unit(const char *text, const char *name, const char *kind, rb_message *why)
{
    product u, like;
    char list[200];
    const int k = kind_of(kind), known = read_unit(name, strlen(name), NULL, 0, &u),
              mass = known && u.dimension[MASS] != 0;
    rb_guess guess = {.word = name};
    if (k == KINDS)
        return known ? rb_fail(why, RB_EINVAL, "a number without a unit, got '%.60s'", text)
                     : RB_EINVAL;
    snprintf(list, sizeof list, "%s", kinds[k].known);
    for (char *at = list, *comma; at; at = comma) {
        comma = strchr(at, ',');
        if (comma) {
            *comma = '\0';
            comma += 2;
        }
        rb_guess_try(&guess, at);
    }
    for (const word *w = words; w < words + WORDS; w++)
        if (product_of(kind, &like) && meaning(w, &u) && same_dimensions(&u, &like))
            rb_guess_try(&guess, w->name);
    if (mass)
        return rb_fail(why, RB_EINVAL,
                       "a number in one of %s; got '%.60s', whose mass needs a density",
                       kinds[k].known, text);
    return rb_fail(why, RB_EINVAL, "a number in one of %s; got '%.60s'%s", kinds[k].known, text,
                   known ? "" : rb_guess_text(&guess, ""));
}

rb_status rb_unit_read(const char *text, const char *unit, double *value, int *plain,
                       rb_message *why)
{
    char *end;
    rb_unit_factor to;
    if (why)
        why->text[0] = '\0';
    if (*text == '\0' || strchr(" \t\n", *text))
        return RB_EINVAL;
    *value = rb_read_number(text, &end);
    if (end == text || !isfinite(*value))
        return RB_EINVAL;
    *plain = *end == '\0';
    if (*plain)
        return RB_OK;
    /* one with a decimal comma; several numbers are a list */
    if (*end == ',' && isdigit((unsigned char)end[1]) && !strpbrk(end + 1, ",.") &&
        !memchr(text, '.', (size_t)(end - text)))
        return rb_fail(why, RB_EINVAL, "a number with a decimal point, %.*s.%.20s; got '%.60s'",
                       (int)(end - text < 20 ? end - text : 20), text, end + 1, text);
    const char *name = end + strspn(end, " ");
    if (find_factor(name, strlen(name), unit, 0, &to)) {
        *value = rb_unit_times(&to, *value);
        return isfinite(*value) ? RB_OK : RB_EINVAL;
    }
    if (strcmp(name, unit) == 0 && strcmp(unit, "-") != 0)
        return RB_OK;
    /* what does not begin like a unit is no number at all */
    if (!rb_unit_is_known(name) && strpbrk(name, "0123456789+-., ()"))
        return RB_EINVAL;
    return refuse_unit(text, name, unit, why);
}

/* ---- Headings ---------------------------------------------------------------------- */

/* The number of bytes of the heading that spell the name: letters of any size, and blanks, points,
 * _ and - alike; 0: it begins otherwise. */
static size_t spelt(const char *heading, const char *name)
{
    static const char between[] = " _-.";
    const char *at = heading;
    while (*name) {
        if (strchr(between, *name)) {
            name++;
            at += strspn(at, between);
            continue;
        }
        if (tolower((unsigned char)*at) != tolower((unsigned char)*name))
            return 0;
        at++;
        name++;
    }
    return (size_t)(at - heading);
}

rb_status rb_unit_of_heading(const char *heading, const char *name, const char *unit,
                             rb_unit_factor *factor, int *plain)
{
    heading += strspn(heading, " ");
    const size_t n = spelt(heading, name);
    const char *rest = heading + n;
    *plain = 1;
    *factor = (rb_unit_factor){0, 1.0, 1.0};
    if (n == 0 || isalnum((unsigned char)*rest))
        return RB_EINVAL;
    /* the unit between blanks and brackets, behind "in" or a slash */
    static const char before[] = " _-.,:;/([{<", after[] = " _-.,:;)]}>";
    rest += strspn(rest, before);
    if (strncmp(rest, "in ", 3) == 0 && rest[3 + strspn(rest + 3, " ")] != '\0')
        rest += 3 + strspn(rest + 3, " ([");
    size_t length = strlen(rest);
    int open = 0; /* brackets of the unit itself, as in mm3/(N m), stay */
    for (size_t k = 0; k < length; k++)
        open += (rest[k] == '(') - (rest[k] == ')');
    while (length > 0 && strchr(after, rest[length - 1]) && (rest[length - 1] != ')' || open < 0))
        open += rest[--length] == ')';
    if (length == 0 || (length == 1 && strchr("-1", *rest)))
        return RB_OK;
    if (length == strlen(unit) && strncmp(rest, unit, length) == 0) {
        *plain = 0;
        return RB_OK;
    }
    *plain = 0;
    return find_factor(rest, length, unit, 1, factor) ? RB_OK : RB_EFORMAT;
}
