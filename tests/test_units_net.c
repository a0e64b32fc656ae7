/* Every option and every result that has a unit, in mm, SI and inch: each command line below is
 * run with the same quantities as plain numbers of each system, with a unit behind each number,
 * and from a case file, and all numbers of its JSON are compared.  A part of the lines per run
 * (make test-all: all). */
#include "cli_run.h"
#include "rolling/case/case.h"
#include "analysis/crack/crack.h"
#include "base/units.h"

#include <ctype.h>

/* {unit value} is a number in mm, N, MPa; ~ stands for the options of a steel half-plane. */
static const char *const lines[] = {
    "~ --load {N/mm 712} --datum {mm 120} --datum-b {mm 90} --shift {mm 0.002} --zone {mm 1.25}",
    "~ --load {N/mm 712} --force {N/mm 90} --error",
    "--radius {mm 46.5} --young {MPa 94500} --approach {mm 2.5} --shift {mm 0.3} --arc 40 "
    "--contact-elements 20",
    "~ --half-width {mm 0.6} --formulation steady --creep-ratio 0.4 --interlayer-normal "
    "{mm/MPa 2e-6} --interlayer-tangential {mm/MPa 3e-6}",
    "~ --approach {mm 0.001} --mu 1000 --formulation steady --creep 1e-5 --mesh uniform "
    "--interlayer-normal {mm/MPa 0.01} --interlayer-tangential {mm/MPa 0.01}",
    "~ --load {N/mm 500} --formulation steady --creep 1e-3 --mesh uniform --yield-stress {MPa 90} "
    "--hardening {MPa/mm 400}",
    "--support halfplane --radius {mm 46.5} --young {MPa 205000} --young-b {MPa 90000} "
    "--poisson-b 0.35 --radius-b {mm 300} --load {N/mm 500} --formulation steady --creep 1e-3 "
    "--contact-elements 20 --error",
    "--support halfplane --radius {mm 46.5} --young {MPa 2000} --layer-thickness {mm 2} "
    "--base-young {MPa 205000} --similar --layer-thickness-b {mm 3} --base-young-b {MPa 150000} "
    "--load {N/mm 50} --mu 0.2 --shift {mm 1e-4} --contact-elements 20",
    "--support hub --radius {mm 46.5} --young {MPa 20} --poisson 0.45 --cover-thickness {mm 6} "
    "--core-young {MPa 2000} --load {N/mm 5} --mu 0.2 --contact-elements 16",
    "--support hub --support-b hub --radius {mm 46.5} --radius-b {mm 60} --young {MPa 20} "
    "--poisson 0.45 --young-b {MPa 40} --poisson-b 0.4 --cover-thickness-b {mm 6} --core-young-b "
    "{MPa 2000} --load {N/mm 5} --mu 0.2 --contact-elements 16",
    "~ --load {N/mm 500} --formulation steady --creep 4e-3 --speed {mm/s 20000} --friction-law "
    "exponential --mu-fall 0.1 --slip-scale {mm/s 50}",
    "~ --load {N/mm 500} --formulation steady --creep 4e-3 --speed {mm/s 20000} --conductivity 50 "
    "--heat-capacity 3.6 --temperature 20",
    "~ --load {N/mm 50} --young {MPa 10} --formulation steady --free-axle --speed {mm/s 100} "
    "--relaxation-time 0.01 --relaxation-ratio 1 --mesh uniform",
    "~ --load {N/mm 500} --formulation transient --force {N/mm -80} --distance 0.5",
    "~ --load {N/mm 500} --formulation transient --creep 1e-3 --distance 0.3 --friction-law "
    "exponential --mu-fall 0.1 --slip-scale {mm/s 50} --speed {mm/s 20000} --memory {mm 0.001}",
    "~ --load {N/mm 500} --shift {mm 0.001} --increments 3 --error",
    "~ --gap {gap} --load {N/mm 100} --gap-smoothing {mm 1e-7}",
    "~ --worn {worn} --load {N/mm 100}",
    "--support halfplane --young {MPa 205000} --poisson 0.3 --gap {gap} --mesh punch --mu 0.2 "
    "--load "
    "{N/mm 900} --moment {N 40} --force {N/mm 30} --contact-elements 20",
    "--support halfplane --radius {mm 46.5} --young {MPa 2000} --layer-thickness {mm 2} "
    "--layer-base smooth --base-young {MPa 205000} --load {N/mm 50} --mu 0.2 --formulation steady "
    "--force {N/mm 2} --contact-elements 20",
    "--support halfplane --radius {mm 46.5} --young 60ShoreA --layer-thickness {mm 2} --layer-base "
    "smooth --load {N/mm 1} --mu 0.2 --force {N/mm 0.05} --contact-elements 20",
    "~ --max-pressure {MPa 900} --shift {mm 1e-4}",
    "~ --gap parabola --wheel-load {N 100000} --transverse-radius {mm 300} --transverse-radius-b "
    "{mm 2000}",
    "~ --gap parabola --wheel-load {N 100000} --transverse-radius {mm 300} --strips 3 "
    "--formulation "
    "steady --creep 1e-3 --contact-elements 20",
    "~ --load {N/mm 500} --shift {mm 1e-3} --bulk-stress {MPa 40} --bulk-stress-b {MPa -20}",
    "~ --load {N/mm 500} --moment {N 30} --shift {mm 1e-4}",
    "--support halfplane --young {MPa 205000} --poisson 0.3 --gap wave --period {mm 1} --amplitude "
    "{mm 1e-3} --mu 0.2 --load {N/mm 300} --force {N/mm 20} --contact-elements 20",
    "--support halfplane --radius {mm 46.5} --layers {layers} --base-young {MPa 205000} "
    "--base-poisson 0.3 --load {N/mm 50} --mu 0.2 --shift {mm 1e-4} --contact-elements 20",
    "~ --formulation transient --distance 0.2 --irregularity {flat} --load {N/mm 100} --creep 0",
    "~ --friction-law {law} --load {N/mm 100} --shift {mm 1e-4}",
    "~ --history {history}",
    "~ --history {frets} --fretting --mu 0.3 --contact-elements 20",
    "~ --history {frets} --fretting --cycle 2,4 --mu 0.3 --contact-elements 24 --error",
    "sweep ~ --history {frets} --fretting --contact-elements 20 --vary-1 'mu 0.3 0.5' --results "
    "swt_max,ruiz_1_max,slip_range_max,fretting_work_max,swt_max_at",
    "~ --history {bulk} --mu 0.3 --contact-elements 20",
    "stress --support hub --support-b hub --radius {mm 46.5} --radius-b {mm 60} --young {MPa "
    "205000} --poisson 0.3 --similar --load {N/mm 500} --mu 0.2 --contact-elements 16 --whole "
    "--body b --grid 5x4",
    "~ --load {N/mm 500} --derivatives=max_pressure,approach --shift {mm 0.001}",
    "~ --load {N/mm 500} --tolerance radius=1%,load={N/mm 10} --shift {mm 0.001} "
    "--contact-elements 40",
    "curve ~ --load {N/mm 500} --points 3 --error",
    "curve ~ --load {N/mm 50} --young {MPa 10} --over speed --from {mm/s 10} --to {mm/s 1000} "
    "--points 2 --free-axle --relaxation-time 0.01 --relaxation-ratio 1",
    "curve ~ --load {N/mm 500} --points 3 --derivatives=tangential_load:load --tolerance "
    "load={N/mm 10}",
    "stress ~ --load {N/mm 500} --shift {mm 1e-3} --depth {mm 1.5} --grid 4x3 --error",
    "stress ~ --load {N/mm 500} --shift {mm 1e-3} --points {points} --shakedown --yield-shear "
    "{MPa 300}",
    "stress --support halfplane --young {MPa 205000} --poisson 0.3 --tractions {tractions} "
    "--points {points}",
    "stress --support halfplane --radius {mm 46.5} --layers {layers} --base-young {MPa 205000} "
    "--base-poisson 0.3 --load {N/mm 50} --mu 0.2 --shift {mm 1e-4} --contact-elements 20 --grid "
    "3x3",
    "wear ~ --load {N/mm 500} --slide {mm 1e5} --wear-coefficient {1/MPa 1e-10} --wear-steps 2",
    "wear ~ --load {N/mm 500} --shift {mm 0.002} --cycles 1e5 --wear-coefficient {1/MPa 1e-10} "
    "--wear-steps 2 --quarter 4",
    "wear ~ --radius-b {mm 80} --load {N/mm 500} --formulation steady --creep-ratio 0.5 --cycles "
    "1e6 --wear-coefficient {1/MPa 1e-10} --wear-steps 2 --wear-share 0.5",
    "crack ~ --half-width {mm 1} --mu 0.3 --shift {mm 1e-3} --crack-length 0.5 --contact-elements "
    "30 --from -2 --to "
    "2 --crack-elements 20",
    "crack ~ --half-width {mm 1} --mu 0.1 --crack-length 0.5 --crack-angle 60 --fluid pressure "
    "--crack-elements 20",
    "crack ~ --half-width {mm 1} --mu 0.1 --crack-length 0.5 --crack-angle 60 --remote-stress "
    "{MPa 50} --crack-elements 20 --paris {paris 1e-9},3 --threshold {MPa.mm^0.5 0.5} --grow-to "
    "0.6 "
    "--grow-steps 2",
    "design ~ --load {N/mm 100} --mu 0 --minimise max_pressure --over radius={mm 30}:{mm 90}",
    "design ~ --load {N/mm 100} --mu 0 --maximise normal_load --over load={N/mm 50}:{N/mm 5000} "
    "--subject 'max_pressure<={MPa 900},half_width>={mm 0.1}'",
    "fit {data} ~ --fit load,mu --bounds load={N/mm 100}:{N/mm 900} --start load={N/mm 400}",
    "fit {data} ~ --load {N/mm 500} --fit mu,interlayer-tangential --contact-elements 24",
    "sweep ~ --vary-1 'load {N/mm 100} {N/mm 200}' --vary-2 'radius {mm 40}:{mm 60}:2' --results "
    "max_shear",
    "sweep ~ --cases {cases}",
};

enum { LINES = sizeof lines / sizeof *lines };

static const char steel[] = "--similar --support halfplane --radius {mm 46.5} --young {MPa 205000} "
                            "--poisson 0.3 --contact-elements 20";

/* Tables by their names: a heading and rows with the units of their columns. */
static const struct {
    const char *name, *heading, *unit[3], *rows;
} tables[] = {
    {"gap", "x gap", {"mm", "mm"}, "-2 .04 -1 .01 -.5 .0025 0 0 .5 .0025 1 .01 2 .04"},
    {"worn", "x depth", {"mm", "mm"}, "-.2 0 -.1 .0004 0 .0005 .1 .0004 .2 0"},
    {"flat", "x gap", {"mm", "mm"}, "-.3 0 0 .001 .3 0"},
    {"law", "x mu", {"mm", "-"}, "-.2 .2 0 .3 .2 .2"},
    {"tractions", "x p q", {"mm", "MPa", "MPa"}, "-1 0 0 0 100 40 1 0 0"},
    {"points", "x y", {"mm", "mm"}, "0 .5 .1 .3"},
    {"layers", "thickness young poisson", {"mm", "MPa", "-"}, "2 2000 .3 1 9000 .4"},
    {"history", "load shift", {"N/mm", "mm"}, "100 0 200 .0005 150 -.0002"},
    {"frets", "load force", {"N/mm", "N/mm"}, "200 0 200 30 200 -30 200 30"},
    {"bulk", "load bulk_stress", {"N/mm", "MPa"}, "200 0 200 30 200 -30"},
    {"cases", "load young", {"N/mm", "MPa"}, "100 205000 200 190000"},
    {"data", "creep force", {"-", "N/mm"}, "-5e-4 50 -1e-3 88 -2e-3 132 -3e-3 146 -5e-3 150"}};

static const char *const system_names[] = {"mm", "si", "inch"};

/* Writes table k in a system. */
static void write_table(int k, rb_units units, const char *path)
{
    FILE *file = NOT_NULL(fopen(path, "w"));
    const char *at = tables[k].rows;
    const int columns = tables[k].unit[2] ? 3 : 2;
    double x;
    int n = 0, used;
    fprintf(file, "%s\n", tables[k].heading);
    while (sscanf(at, "%lf%n", &x, &used) == 1) {
        fprintf(file, "%.17g%c", rb_unit_shown(units, tables[k].unit[n], x),
                n == columns - 1 ? '\n' : ' ');
        n = (n + 1) % columns;
        at += used;
    }
    fclose(file);
}

/* How the numbers of a line are written. */
typedef enum { PLAIN, SPELT } manner;

/* The line in a system; PLAIN: without units; SPELT: each number has the unit of the next system.
 * Tables are files in the units of the line. */
static void write_line(const char *line, rb_units units, manner how, char *to, size_t size)
{
    char whole[2000] = "", what[40];
    const char *tilde = strchr(line, '~');
    double x;
    int used;
    rb_append(whole, sizeof whole, "%.*s%s%s", tilde ? (int)(tilde - line) : (int)strlen(line),
              line, tilde ? steel : "", tilde ? tilde + 1 : "");
    to[0] = '\0';
    for (const char *at = whole; *at;) {
        const char *open = strchr(at, '{');
        rb_append(to, size, "%.*s", open ? (int)(open - at) : (int)strlen(at), at);
        if (!open)
            break;
        at = strchr(open, '}') + 1;
        if (sscanf(open, "{%39[^ }] %lf}%n", what, &x, &used) >= 2) {
            const rb_units spelt = (rb_units)((units + 1) % 3);
            const int plain = how == PLAIN;
            char number[40];
            if (strcmp(what, "paris") == 0) { /* C of da/dN = C dK^3, in the units of the line */
                const double K = rb_unit_shown(units, "MPa.mm^0.5", 1.0);
                rb_append(to, size, "%.17g", x * rb_unit_shown(units, "mm", 1.0) / (K * K * K));
                continue;
            }
            snprintf(number, sizeof number, "%.17g", rb_unit_shown(plain ? units : spelt, what, x));
            const char *unit = plain ? "" : rb_unit_name(spelt, what);
            rb_append(to, size, "%s%s", number, unit + (*unit == '1')); /* 1e-16/Pa */
            continue;
        }
        for (size_t k = 0; k < sizeof tables / sizeof *tables; k++)
            if (strncmp(open + 1, tables[k].name, strlen(tables[k].name)) == 0) {
                char path[60];
                snprintf(path, sizeof path, "%s-%s.txt", tables[k].name, system_names[units]);
                write_table((int)k, units, path);
                rb_append(to, size, "%s", path);
            }
    }
}

/* ---- What has which unit ----------------------------------------------------------- */

static const char *const kinds[] = {"mm",     "mm2",   "MPa",        "N/mm",   "N",       "mm/s",
                                    "mm/MPa", "1/MPa", "MPa.mm^0.5", "MPa/mm", "MPa.N/mm"};

/* A column's name in the other system; *unit: NULL without one. */
static const char *heading_in(const char *name, rb_units units, const char **unit, char text[120])
{
    *unit = NULL;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        const size_t n = strlen(name), m = strlen(kinds[k]);
        if (n > m + 1 && name[n - m - 1] == '_' && strcmp(name + n - m, kinds[k]) == 0) {
            *unit = kinds[k];
            snprintf(text, 120, "%.*s%s", (int)(n - m), name, rb_unit_name(units, kinds[k]));
            return text;
        }
    }
    snprintf(text, 120, "%s", name);
    return text;
}

static const char *now; /* the line that is compared */

static const char *unit_of_option(const char *name)
{
    char own[80];
    snprintf(own, sizeof own, "%s", name);
    for (char *c = own; *c; c++)
        *c = *c == '_' ? '-' : *c;
    const rb_option *o = rb_case_option(own);
    for (int k = 0; !o && k < rb_case_crack_options_n; k++)
        if (strcmp(rb_case_crack_options[k].name, own) == 0)
            o = &rb_case_crack_options[k];
    return !o ? NULL : o->kind == RB_OPTION_NUMBER ? o->unit : "";
}

/* The unit of a number by its name and where it stands; "": it has none. */
static const char *unit_of(const char *name, const char *path)
{
    static const char *const others[][2] = {{"depth", "mm"},
                                            {"largest", "MPa"},
                                            {"fringe", "MPa"},
                                            {"yield-shear", "MPa"},
                                            {"slide", "mm"},
                                            {"cycle_work", "N"},
                                            {"wear-coefficient", "1/MPa"},
                                            {"half_width", "mm"},
                                            {"crack_length", "mm"},
                                            {"span", "mm"},
                                            {"peak", "mm"},
                                            {"residual_gap", "mm"},
                                            {"residual_slip", "mm"},
                                            {"residual_friction", "MPa"},
                                            {"x", "mm"},
                                            {"y", "mm"},
                                            {"step", "mm"},
                                            {"shear_yield", "MPa"},
                                            {"yield_shear", "MPa"},
                                            {"noise", "N/mm"},
                                            {"residuals", "N/mm"},
                                            {"fitted", "N/mm"},
                                            {"band", "N/mm"}};
    char own[80];
    snprintf(own, sizeof own, "%s", name);
    if (strstr(path, "/inputs") && (strcmp(own, "from") == 0 || strcmp(own, "to") == 0))
        return strstr(now, "--over speed") ? "mm/s" : "";
    if (strstr(path, "/inputs") && unit_of_option(name))
        return unit_of_option(name);
    if (strstr(path, "/wear") && strcmp(own, "way") == 0)
        return strstr(now, "--slide") ? "mm" : "";
    if (strstr(path, "/wear") && strcmp(own, "work") == 0)
        return strstr(now, "--slide") || strstr(now, "steady") ? "N/mm" : "N";
    if (strstr(path, "/wear") && rb_rolling_find_result(&rb_rolling_wear_columns, own))
        return rb_rolling_find_result(&rb_rolling_wear_columns, own)->unit;
    for (size_t k = 0; k < sizeof others / sizeof *others; k++)
        if (strcmp(others[k][0], own) == 0)
            return others[k][1];
    const rb_rolling_result_table *t = rb_rolling_result_tables;
    for (; t->name; t++) {
        const rb_rolling_result *r = rb_rolling_find_result(t->results, own);
        if (r)
            return r->unit ? r->unit : "";
    }
    rb_rolling_maximum_result bond;
    int k_of, part, of_b;
    if (rb_rolling_find_bond_number(own, &k_of, &part, &of_b))
        return rb_rolling_describe_maximum(k_of, part, of_b, &bond)->unit;
    const rb_rolling_results *crack[] = {&rb_case_crack_scalars, &rb_case_crack_columns,
                                         &rb_case_crack_growth_columns};
    for (int k = 0; k < 3; k++) {
        const rb_rolling_result *r = rb_rolling_find_result(crack[k], own);
        if (r)
            return r->unit ? r->unit : "";
    }
    const char *option = unit_of_option(name);
    return option ? option : "";
}

static int counted, wrong; /* numbers that have a unit; that differ */

#define SAY(...) (wrong++ < 6 ? print_error(__VA_ARGS__) : (void)0)

static void compare_numbers(const json_t *a, const json_t *b, const char *path, const char *unit,
                            const char *by, rb_units units, double scale)
{
    const double x = json_number_value(a), y = json_number_value(b);
    const double factor = unit ? rb_unit_shown(units, unit, 1.0) : 1.0,
                 over = by ? rb_unit_shown(units, by, 1.0) : 1.0;
    const double wanted = x * factor / over;
    counted += factor != over;
    if (!(fabs(y - wanted) <= 2e-6 * fmax(fabs(wanted), scale * fabs(factor / over))))
        SAY("%s: %.12g %s, want %.12g\n", path, y, unit ? rb_unit_name(units, unit) : "", wanted);
}

/* Members that belong to a run. */
static int is_own(const char *name)
{
    static const char *const own[] = {
        "command",      "seconds",       "input_hash",        "notes",
        "units",        "iterations",    "residual",          "system",
        "load_error",   "conventions",   "evaluations",       "sentences",
        "correlation",  "steps",         "K_II_max_at",       "uncertain_inputs",
        "residual_gap", "residual_slip", "residual_friction", "force_balance",
        "power_balance"};
    for (size_t k = 0; k < sizeof own / sizeof *own; k++)
        if (strcmp(own[k], name) == 0)
            return 1;
    return 0;
}

/* unit: of the numbers in a list or below a name; by: of the input of a derivative. */
static void compare(const json_t *a, const json_t *b, const char *path, const char *unit,
                    const char *by, rb_units units, double scale)
{
    char below[400], other[120];
    if (json_is_object(a)) {
        const char *key;
        json_t *value;
        const json_t *said = json_object_get(a, "unit");
        const char *own = json_is_string(said) ? json_string_value(said) : NULL;
        /* where a maximum is flat its place is known to 1e-8 of how far off it is */
        if (json_object_get(a, "x") && json_object_get(a, "y"))
            scale = hypot(json_number_value(json_object_get(a, "x")),
                          json_number_value(json_object_get(a, "y")));
        json_object_foreach((json_t *)a, key, value)
        {
            const char *of_key;
            if (is_own(key))
                continue;
            const char *name = heading_in(key, units, &of_key, other);
            const json_t *in_b = json_object_get(b, name);
            snprintf(below, sizeof below, "%.300s/%.90s", path, key);
            if (!in_b) {
                SAY("%s: no %s\n", below, name);
                continue;
            }
            if (strcmp(key, "unit") == 0) {
                if (own)
                    assert_string_equal(json_string_value(in_b), rb_unit_name(units, own));
                continue;
            }
            const char *end = strrchr(path, '/');
            const int over_x = strstr(path, "/derivatives_over_x/") != NULL,
                      derivative = over_x || strstr(path, "/derivatives/") != NULL;
            if (own && strcmp(own, "1") == 0)
                own = NULL;
            if (!own && json_is_string(json_object_get(a, "result")))
                own = unit_of(json_string_value(json_object_get(a, "result")), "");
            const char *u = of_key       ? of_key
                            : own        ? own
                            : derivative ? unit_of(end + 1, "")
                            : unit && strstr("value errors start low high bound", key)
                                ? unit
                                : unit_of(key, path);
            const char *input = over_x && strcmp(key, "gap") == 0 ? "mm"
                                : derivative                      ? unit_of_option(key)
                                                                  : NULL;
            compare(value, in_b, below, *u ? u : NULL, input && *input ? input : NULL, units,
                    scale);
        }
    } else if (json_is_array(a)) {
        double largest = scale;
        if (json_array_size(a) != json_array_size(b)) {
            SAY("%s: %zu entries, want %zu\n", path, json_array_size(b), json_array_size(a));
            return;
        }
        for (size_t i = 0; i < json_array_size(a); i++)
            largest = fmax(largest, fabs(json_number_value(json_array_get(a, i))));
        for (size_t i = 0; i < json_array_size(a); i++) {
            snprintf(below, sizeof below, "%.300s[%zu]", path, i);
            compare(json_array_get(a, i), json_array_get(b, i), below, unit, by, units, largest);
        }
    } else if (json_is_string(a) && strstr(json_string_value(a), "-mm.txt")) {
        /* the name of a table in the other system */
    } else if (json_is_number(a) && json_is_number(b))
        compare_numbers(a, b, path, unit, by, units, scale);
    else if (!json_equal((json_t *)a, (json_t *)b))
        SAY("%s: another value\n", path);
}

/* ---- The net ----------------------------------------------------------------------- */

static json_t *run_line(const char *line, rb_units units)
{
    const int code = rollbemf("%s --units %s --json --quiet", line, system_names[units]);
    json_t *root = code == 0 ? json_loads(out, 0, NULL) : NULL;
    if (!root)
        fail_msg("exit %d: rollbem %s\n%s", code, line, err);
    return root;
}

/* The options of a line as a case file; the command, and what is no option, in `rest`. */
static void write_case(const char *line, rb_units units, const char *path, char *rest, size_t size)
{
    char copy[2500];
    const char *name[40], *given[40];
    int n = 0;
    rest[0] = '\0';
    snprintf(copy, sizeof copy, "%s", line);
    for (char *at = copy, *word; *at; at += strspn(at, " ")) {
        word = at;
        at += strcspn(at, " ");
        if (*at)
            *at++ = '\0';
        if (strncmp(word, "--", 2) != 0) {
            rb_append(rest, size, "%s ", word);
            continue;
        }
        char *equals = strchr(word, '='), *value = equals ? equals + 1 : NULL;
        if (equals)
            *equals = '\0';
        else if (*at && strncmp(at, "--", 2) != 0) {
            const char quote = *at == '\'' ? '\'' : ' ';
            value = at + (quote != ' ');
            char *end = value + strcspn(value, quote == ' ' ? " " : "'");
            at = end + (*end != '\0');
            *end = '\0';
        }
        int k = 0; /* the last one wins */
        while (k < n && strcmp(name[k], word + 2) != 0)
            k++;
        name[k] = word + 2;
        given[k] = value ? value : "yes";
        n = k == n ? n + 1 : n;
        assert_true(n < 40);
    }
    FILE *file = NOT_NULL(fopen(path, "w"));
    fprintf(file, "units = %s\n", system_names[units]);
    for (int k = 0; k < n; k++)
        fprintf(file, "%s = %s\n", name[k], given[k]);
    fclose(file);
}

TEST(every_line_is_the_same_in_every_system)
{
    char text[2500];
    int all_right = 1;
    for (int k = 0; k < LINES; k++) {
        if (!is_in_turn(k, 8))
            continue;
        write_line(lines[k], RB_UNITS_MM, PLAIN, text, sizeof text);
        held_json *mm = run_line(text, RB_UNITS_MM);
        counted = wrong = 0;
        now = lines[k];
        for (rb_units units = RB_UNITS_SI; units <= RB_UNITS_INCH; units++) {
            write_line(lines[k], units, PLAIN, text, sizeof text);
            held_json *other = run_line(text, units);
            compare(mm, other, system_names[units], NULL, NULL, units, 0.0);
        }
        /* numbers with units of another system than the one that is shown */
        write_line(lines[k], RB_UNITS_MM, SPELT, text, sizeof text);
        held_json *spelt = run_line(text, RB_UNITS_MM);
        compare(mm, spelt, "spelt", NULL, NULL, RB_UNITS_MM, 0.0);
        /* a case file in its own units, shown in mm */
        const int has_texts = strncmp(lines[k], "design", 6) == 0 ||
                              strncmp(lines[k], "fit", 3) == 0 || strstr(lines[k], "--tolerance") ||
                              strstr(lines[k], "--paris");
        for (rb_units units = RB_UNITS_SI; units <= RB_UNITS_INCH && !has_texts; units++) {
            char rest[200];
            write_line(lines[k], units, PLAIN, text, sizeof text);
            write_case(text, units, "case.ini", rest, sizeof rest);
            rb_append(rest, sizeof rest, "case.ini");
            held_json *file = run_line(rest, RB_UNITS_MM);
            compare(mm, file, "file", NULL, NULL, RB_UNITS_MM, 0.0);
        }
        if (counted < 10 || wrong > 0)
            print_error("%d numbers with units, %d wrong: %s\n", counted, wrong, lines[k]);
        all_right &= counted >= 10 && wrong == 0;
    }
    assert_true(all_right);
}

/* A new option with a unit must be added to a line above. */
TEST(every_option_with_a_unit_is_in_a_line)
{
    static const char *const commands[] = {"",      "curve",  "stress", "wear",
                                           "crack", "design", "fit",    "sweep"};
    static char text[sizeof out];
    int missing = 0, options = 0;
    for (size_t c = 0; c < sizeof commands / sizeof *commands; c++) {
        assert_int_equal(rollbemf("%s --help all || \"$R\" %s --help", commands[c], commands[c]),
                         0);
        size_t n = 0;
        for (const char *at = out; *at; at++)
            if (!isspace((unsigned char)*at) || (n > 0 && text[n - 1] != ' '))
                text[n++] = isspace((unsigned char)*at) ? ' ' : *at;
        text[n] = '\0';
        for (char *at = text, *next; (at = strstr(at, " --")); at = next) {
            next = at + 3;
            char name[60], used[80];
            const size_t length = strspn(next, "abcdefghijklmnopqrstuvwxyz0123456789-");
            char *end = strstr(next, " --");
            const char *open;
            int has = 0;
            for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
                char unit[40];
                snprintf(unit, sizeof unit, "[%s]", kinds[k]);
                open = strstr(next, unit);
                has |= open && (!end || open < end);
                snprintf(unit, sizeof unit, "[%s,", kinds[k]);
                open = strstr(next, unit);
                has |= open && (!end || open < end);
            }
            snprintf(name, sizeof name, "%.*s", (int)(length < 59 ? length : 59), next);
            if (!has || next[length] != ' ')
                continue;
            options++;
            snprintf(used, sizeof used, "--%s ", name);
            int is_used = 0;
            for (int k = 0; k < LINES; k++)
                is_used |= strstr(lines[k], used) != NULL || strstr(steel, used) != NULL;
            if (!is_used && strcmp(name, "fringe") != 0 && strcmp(name, "span") != 0) {
                print_error("rollbem %s: --%s is in no line\n", commands[c], name);
                missing++;
            }
        }
    }
    assert_true(options > 40);
    assert_int_equal(missing, 0);
}

RUN_TESTS(enter_folder, leave_folder)
