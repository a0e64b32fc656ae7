/* Options times regimes: every pair of values of the factors below is run in 40 turns (every
 * triple by make test-all) and judged by tests/checker.c, which shares no code with the
 * library. */
#define _DEFAULT_SOURCE   /* MAP_ANONYMOUS */
#define _XOPEN_SOURCE 700 /* nftw */
#include "cli_run.h"
#include "covering.h"
#include "rolling/case/case.h"
#include "lcp/friction/friction.h"

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>

/* ---- Factors ----------------------------------------------------------------------- */

enum {
    PLANE,
    SUPPORT,
    BODY_B,
    SURFACE,
    REGIME,
    MESH,
    SLIP,
    NEAR_FIELD,
    NORMALS,
    SIZE,
    ZONE,
    NORMAL,
    TANGENTIAL,
    GAP,
    IRREGULARITY,
    WORN,
    PERIOD,
    INTERLAYER,
    TILT,
    BULK,
    MU,
    LAW,
    SHAPE,
    HEAT,
    SOLVER,
    FORM,
    OUTPUT,
    FACTORS
};

typedef struct {
    const char *name, *arguments;
} level;

enum { LEVELS = 40 };

/* option: the choices of that option are levels, behind those named here.  Where the
 * arguments depend on other factors (controls, histories, shapes), case_arguments() makes
 * them. */
static const struct {
    const char *name, *option;
    level level[LEVELS]; /* behind the last one: no name */
} factors[FACTORS] = {
    {"plane", "plane", {{NULL, NULL}}},
    {"support", "support", {{NULL, NULL}}},
    {"body-b",
     NULL,
     {{"rigid", ""},
      {"similar", "--similar"},
      {"dissimilar", "--young-b 200000 --poisson-b 0.28"},
      {"cylinder", "--young-b 200000 --poisson-b 0.28 --radius-b 80"},
      {"bore", "--young-b 200000 --poisson-b 0.28 --radius-b -80"},
      {"hub", "--young-b 200000 --radius-b 80 --support-b hub"},
      {"arc", "--similar --radius-b 50 --support-b arc"}}},
    {"surface",
     NULL,
     {{"plain", ""},
      {"layer", "--layer-thickness 2"},
      {"on-elastic", "--layer-thickness 2 --base-young 20000 --base-poisson 0.2"},
      {"smooth", "--layer-thickness 2 --layer-base smooth"},
      {"smooth-elastic",
       "--layer-thickness 2 --layer-base smooth --base-young 20000 --base-poisson 0.2"},
      {"stack", "--layers layers.txt --base-young 20000 --base-poisson 0.2"},
      {"relaxing", "--relaxation-time 0.01,0.1 --relaxation-ratio 1,0.5"},
      {"cover", "--cover-thickness 4"},
      {"cover-elastic", "--cover-thickness 4 --core-young 200000"},
      {"b-layer", "--layer-thickness-b 2"},
      {"b-stack", "--layers-b layers.txt"},
      {"b-cover", "--cover-thickness-b 4 --core-young-b 200000"},
      {"b-relaxing", "--relaxation-time-b 0.01 --relaxation-ratio-b 1"}}},
    {"regime",
     NULL,
     {{"static", "--formulation static"},
      {"steady", "--formulation steady"},
      {"transient", "--formulation transient --distance 0.4"},
      {"steps", "--formulation transient --distance 0.6 --steps 2"},
      {"increments", "--formulation static --increments 3"},
      {"static-history", "--formulation static --history controls.txt"},
      {"transient-history", "--formulation transient --history controls.txt"}}},
    {"mesh", "mesh", {{"default", ""}}},
    {"slip", "slip-operator", {{"default", ""}}},
    {"near-field", "near-field", {{NULL, NULL}}},
    {"normals", "normals", {{NULL, NULL}}},
    {"size",
     NULL,
     {{"odd", ""},
      {"even", ""},
      {"hierarchical", "--contact-elements 16"},
      {"transforms", "--contact-elements 1500"}}},
    {"zone", NULL, {{"auto", ""}, {"given", "--zone 2"}}},
    {"normal", NULL, {{"approach", ""}, {"load", ""}, {"half-width", "--half-width 1"}}},
    {"tangential",
     NULL,
     {{"none", ""},
      {"creep", ""},
      {"creep-ratio", ""},
      {"force", ""},
      {"force-ratio", ""},
      {"free-axle", "--free-axle"},
      {"shift", ""}}},
    {"gap", "gap", {{"file", "--gap gap.txt"}, {"smoothed", "--gap gap.txt --gap-smoothing 1e-5"}}},
    {"irregularity", NULL, {{"none", ""}, {"flat", "--irregularity flat.txt"}}},
    {"worn", NULL, {{"none", ""}, {"scar", "--worn worn.txt"}}},
    {"period", NULL, {{"none", ""}, {"given", "--period 30"}}},
    {"interlayer",
     NULL,
     {{"none", ""},
      {"tangential", "--interlayer-tangential 4e-6"},
      {"both", "--interlayer-normal 2e-6 --interlayer-tangential 1e-6"},
      {"hardening", "--interlayer-tangential 1e-6 --yield-stress 40 --hardening 1e5"},
      {"softening", "--yield-stress 200 --hardening -2000"}}},
    {"tilt", NULL, {{"none", ""}, {"given", "--tilt 1e-3"}}},
    {"bulk", NULL, {{"none", ""}, {"both", "--bulk-stress 60 --bulk-stress-b -25"}}},
    {"mu",
     NULL,
     {{"0", "--mu 0"}, {"1e-3", "--mu 1e-3"}, {"0.3", ""}, {"3", "--mu 3"}, {"way", ""}}},
    {"law",
     NULL,
     {{"constant", ""},
      {"file", "--friction-law mu.txt"},
      {"exponential",
       "--friction-law exponential --mu-fall 0.1,0.05 --slip-scale 40,4 --speed 3000"},
      {"rational", "--friction-law rational --mu-fall 0.1,0.05 --slip-scale 20,5 --speed 3000"},
      {"linear", "--friction-law linear --mu-fall 0.1 --slip-scale 50 --speed 3000"},
      {"memory", "--friction-law exponential --mu-fall 0.1 --slip-scale 20 --speed 3000 "
                 "--memory 0.01,2"},
      {"heat", "--mu-heat 0.05,0,100"},
      {"both", "--friction-law linear --mu-fall 0.1 --slip-scale 50 --mu-heat "
               "-0.0005,300,100 --memory 0.01"}}},
    {"shape", NULL, {{"default", ""}, {"other", ""}}},
    {"heat",
     NULL,
     {{"none", ""},
      {"alike", "--conductivity 50 --heat-capacity 3.5 --speed 3000"},
      {"unlike", "--conductivity 50 --heat-capacity 3.5 --temperature 300 --speed 3000 "
                 "--conductivity-b 20 --heat-capacity-b 2 --temperature-b 280"}}},
    {"solver", "solver", {{"cone", ""}}}, /* one after the other */
    {"form", "lcp-form", {{NULL, NULL}}},
    {"output",
     NULL,
     {{"json", "--json"},
      {"output", "--output out.tsv"},
      {"bare", "--header bare"},
      {"png", "--plot out.png --json"},
      {"svg", "--plot out.svg --json"},
      {"pdf", "--plot out.pdf --json"},
      {"tex", "--plot out.tex --json"},
      {"dump", "--dump out --json"},
      {"trace", "--trace"},
      {"dump-trace", "--dump out --trace"},
      {"fclib", "--fclib out.hdf5 --json"},
      {"history-table", "--history-table out.history --json"},
      {"history-plot", "--history-plot out.svg --json"},
      {"history-frames", "--history-plot out.gif --json"},
      {"snapshots", "--snapshots out --every 2 --progress"},
      {"error", "--error"},
      {"accuracy", "--accuracy 0.2 --json"},
      {"stress-vtk", "--grid 7x5 --vtk out.vtu --json"},
      {"stress-points", "--points points.txt"},
      {"stress-fringes", "--grid 7x5 --fringes out.svg --json"},
      {"curve", "--json"},
      {"curve-plot", "--plot out.svg --json"},
      {"sweep", "--vary-1 'young 80000 94500' --jobs 1"},
      {"derivatives", "--derivatives=all --json"}}}};

/* Options that other factors give, and those whose one value stands for all; units:
 * tests/test_units.c. */
static const char options_elsewhere[] =
    " units similar max-pressure young-b poisson-b radius-b support-b formulation distance steps "
    "history"
    " zone approach load half-width shift creep creep-ratio force force-ratio mu friction-law"
    " mu-fall slip-scale memory mu-heat poisson arc hub-ratio datum arc-b hub-ratio-b datum-b"
    " tol contact-elements outer-elements error accuracy radius young irregularity increments"
    " cover-thickness core-young core-poisson cover-thickness-b core-young-b core-poisson-b"
    " layer-thickness base-young base-poisson relaxation-time time-step relaxation-ratio speed"
    " layers layers-b layer-thickness-b base-young-b base-poisson-b relaxation-time-b "
    "relaxation-ratio-b"
    " free-axle gap-smoothing conductivity heat-capacity temperature conductivity-b heat-capacity-b"
    " temperature-b worn interlayer-normal interlayer-tangential yield-stress hardening"
    " bulk-stress bulk-stress-b tilt moment wheel-load strips layer-base layer-base-b"
    " transverse-radius transverse-radius-b period amplitude fretting cycle ";

static level levels[FACTORS][LEVELS];
static int level_n[FACTORS];

static void add_level(int f, const char *name, const char *arguments)
{
    assert_true(level_n[f] + 1 < LEVELS);
    levels[f][level_n[f]++] = (level){name, arguments};
}

/* "--option choice"; kept until the program ends. */
static const char *argument_of(const char *option, const char *choice)
{
    static char room[4000];
    static size_t used;
    char *text = room + used;
    used += (size_t)snprintf(text, sizeof room - used, "--%s %s", option, choice) + 1;
    assert_true(used < sizeof room);
    return text;
}

static void add_choices(int f)
{
    const rb_option *o = rb_case_option(factors[f].option);
    assert_non_null(o);
    for (const rb_choice *c = o->choices; c->name; c++)
        add_level(f, c->name, argument_of(o->name, c->name));
}

static void set_levels(void)
{
    for (int f = 0; f < FACTORS; f++) {
        for (const level *l = factors[f].level; l < factors[f].level + LEVELS && l->name; l++)
            add_level(f, l->name, l->arguments);
        if (factors[f].option)
            add_choices(f);
    }
}

static const char *name_of(const int *row, int factor)
{
    return row[factor] == COVERING_OPEN ? "" : levels[factor][row[factor]].name;
}

static int is(const int *row, int factor, const char *name)
{
    return strcmp(name_of(row, factor), name) == 0;
}

static int starts(const int *row, int factor, const char *start)
{
    return strncmp(name_of(row, factor), start, strlen(start)) == 0;
}

/* ---- What does not go together ----------------------------------------------------- */

/* Names as "factor=level"; "level*": all that start so; "level|level": a conflict for each.
 * reason: part of the line that refuses it, or NULL: the program takes it, and the net leaves
 * it out because it costs time or means something else.  The fourth value is no part of the
 * conflict: what the command that is refused has too, lest another refusal comes first. */
typedef struct {
    const char *value[4], *reason;
} conflict;

#define RELAXING "surface=relaxing|b-relaxing"
#define YIELDING "interlayer=hardening|softening"
#define HALFPLANE_ONLY "for the support halfplane only"
#define SMOOTH_GAP "needs a parabola or circle as gap"

static const conflict conflicts[] = {
    {{"normals=surface", "support=halfplane"}, "a half-plane has the obstacle's"},
    {{"normals=surface", "body-b!rigid"}, "with a rigid plane only"},
    {{"regime=transient*|steps|steady", "tangential=shift"}, "rolling is driven by"},
    {{"regime=transient*|steps|increments|static-history", "mesh=fitted|aligned|punch"},
     "a computation with steps needs equal elements"},
    {{"mesh=punch", "regime=steady"}, "it needs bodies at rest, in one step"},
    {{"mesh=punch", "gap=parabola|exact"}, "a table of the punch"},
    {{"mesh=punch", "gap=wave"}, NULL},
    {{"mesh=punch", "support!halfplane"}, NULL},
    {{"mesh=punch", "body-b=hub|arc"}, NULL},
    {{"mesh=punch", "zone=given"}, "leave --zone out"},
    {{"slip=second", "regime!steady"}, "only for steady rolling"},
    {{"slip=second", "mesh=fitted"}, "only for equal elements"},
    {{"slip=second", "mesh=punch"}, NULL}, /* steady and at rest */
    {{"surface=layer|on-elastic|smooth*|stack", "support!halfplane", NULL, "shape=default"},
     HALFPLANE_ONLY},
    {{"surface=relaxing", "support=arc", "regime=steady"}, "cannot turn"},
    {{RELAXING, "support!halfplane", "regime=transient*|steps"}, HALFPLANE_ONLY},
    {{RELAXING, "body-b=hub|arc", "regime=transient*|steps"}, HALFPLANE_ONLY},
    {{RELAXING, "body-b=arc", "regime=steady"}, "cannot turn"},
    {{RELAXING, "regime=static|increments"}, "needs --history"},
    {{RELAXING, "regime=transient*|steps|static-history", "gap=file|smoothed"}, SMOOTH_GAP},
    {{RELAXING, "regime=transient*|steps|static-history", "worn=scar"}, SMOOTH_GAP},
    {{RELAXING, "irregularity=flat"}, SMOOTH_GAP},
    {{RELAXING, "regime=static-history", "output=error"}, "has no error bars"},
    {{"surface=b-layer|b-cover|b-relaxing", "body-b=rigid"}, "body B is rigid"},
    {{"surface=b-stack", "body-b!rigid"}, "leave one of them out"}, /* its own moduli */
    {{"surface=b-stack", "normals=surface"}, "with a rigid plane only"},
    {{"surface=stack|b-stack", "plane=stress"}, "several layers are in plane strain"},
    {{"surface=stack", "shape=other"}, "the first row of --layers says it"},
    {{"surface=stack", "output=sweep"}, "the first row of --layers says it"},
    {{"surface=b-layer", "body-b=hub|arc"}, HALFPLANE_ONLY},
    {{"surface=layer|on-elastic|smooth*|stack", "body-b=arc"}, HALFPLANE_ONLY},
    {{"surface=b-cover", "body-b=similar|dissimilar|cylinder|bore|arc"},
     "its core holds the wheel"},
    {{"surface=cover*", "support!hub"}, "its core holds the wheel"},
    /* --similar copies what A has */
    {{"surface=cover*", "body-b=similar|arc"}, "its core holds the wheel"},
    {{"surface=layer|smooth", "support=halfplane", "shape=other"}, "displacement is absolute"},
    {{"surface=smooth*", "regime=transient*|steps|increments"},
     "it needs steady rolling, or bodies at rest in one step"},
    {{"surface=smooth*", "regime=static-history"}, "nothing holds the layer from step to step"},
    {{"surface=smooth*", "regime=static", "tangential=shift", "mu=0.3"}, "a shift means nothing"},
    {{"surface=b-layer", "shape=other"}, "displacement is absolute"},
    /* fifty chords of the shape cut so thick a core */
    {{"surface=cover*|b-cover", "shape=other"}, NULL},
    {{"surface=cover*|b-cover", "size=hierarchical"}, NULL},
    /* its points and grid, but not the picture, whose fringes take long */
    {{"surface=layer|on-elastic|smooth*|stack", "output=stress-fringes"}, NULL},
    {{"output=curve-plot", "mu=0"}, "no curve to draw at mu = 0"},
    {{"law=file", "mu=3"}, "the table of --friction-law has the coefficients"},
    {{"law=file", "mu=way", "regime=static-history|transient-history"},
     "a column mu cannot be combined"},
    {{"law=heat|both", "heat=none", NULL, "output=json"}, "needs temperatures"},
    {{"law=exponential|rational|linear", "regime=static|increments|static-history"},
     "needs a sliding distance"},
    /* what falls is more than so little friction */
    {{"law!constant", "mu=0|1e-3"}, NULL},
    {{"law!constant", RELAXING}, NULL}, /* two speeds */
    /* a search for the force and an iteration for each creepage */
    {{"law!constant", "size=transforms", "tangential!creep"}, NULL},
    {{"law!constant", "size=transforms", "surface!plain"}, NULL}, /* half a minute */
    {{"law!constant", "solver=cone"}, NULL},
    {{"irregularity=flat", "regime=static|steady|increments|static-history"},
     "only for transient rolling"},
    {{"tangential=free-axle", "regime!steady"}, "it needs steady rolling"},
    {{"tangential=free-axle", "mu=0"}, "only friction turns it"},
    {{"heat!none", RELAXING}, NULL}, /* two speeds */
    {{"heat!none", "surface=layer|on-elastic|smooth*|stack|b-layer|b-stack|cover*|b-cover"},
     "it needs homogeneous elastic bodies"},
    {{"heat!none", "regime=static|increments|static-history"}, "friction heats bodies that roll"},
    {{"heat=unlike", "regime=transient*|steps"}, "both bodies must have the same temperature"},
    {{"mu=0", "tangential=creep-ratio|force-ratio"}, "no meaning at mu = 0"},
    {{"output=history*|snapshots", "regime=static|steady"}, "for --formulation transient"},
    {{"output=accuracy", "regime=transient*|steps|increments|static-history"},
     "static and steady cases without steps"},
    {{"output=trace|dump-trace", "solver=newton|cone"}, "only --solver lemke pivots"},
    {{"output=curve*", "regime!steady"}, "a curve needs steady rolling"},
    {{"output=curve*", "tangential!none"}, "a curve varies it from --from"},
    {{"size=transforms", "output=fclib"}, "dense"},
    {{"tilt=given", "regime=steady|transient*|steps"}, "it needs bodies at rest"},
    {{"tilt=given", "support!halfplane"}, "it needs elastic half-planes"},
    {{"tilt=given", "body-b=hub|arc"}, "it needs elastic half-planes"},
    {{"tilt=given", RELAXING}, NULL},
    {{"gap=wave", "period=none"}, "needs --period and --amplitude"},
    {{"gap=wave", "body-b=cylinder|bore"}, "a wave lies on a plane"},
    {{"gap=wave", "body-b=hub|arc"}, NULL},
    {{"period=given", "regime=steady|transient*|steps"}, "it needs bodies at rest"},
    {{"period=given", "support!halfplane"}, "it needs half-planes of one elastic material"},
    {{"period=given", "body-b=hub|arc"}, "it needs half-planes of one elastic material"},
    {{"period=given", "surface=stack|b-stack"}, "it needs half-planes of one elastic material"},
    {{"period=given", "surface=relaxing|b-relaxing|cover*|b-cover"}, NULL},
    {{"period=given", "mesh=fitted|aligned"}, "equal elements only"},
    {{"period=given", "mesh=punch"}, NULL}, /* a wave is no table */
    {{"period=given", "normal=half-width"}, "Hertz's is that of one contact"},
    {{"period=given", "gap=exact"}, "needs --gap parabola, wave"},
    {{"period=given", "gap=file|smoothed"}, "must be one period long"},
    {{"period=given", "worn=scar"}, "put it into a table of the gap"},
    {{"period=given", "irregularity=flat"}, NULL},
    {{"period=given", "tilt=given"}, "neighbours hold the surface level"},
    {{"period=given", "bulk=both"}, NULL},
    {{"period=given", "shape=other"}, "displacements are those from the mean line"},
    {{"period=given", "output=stress*"}, "contacts that repeat themselves"},
    {{"period=given", "output=derivatives"}, "with a period not known"},
    {{"bulk=both", "body-b=rigid", NULL, "surface!b-stack"}, "a rigid body B is not strained"},
    {{"bulk=both", "support!halfplane"}, "it needs half-planes of one elastic material"},
    {{"bulk=both", "body-b=hub|arc"}, "it needs half-planes of one elastic material"},
    {{"bulk=both", "surface!plain", "body-b!rigid"},
     "it needs half-planes of one elastic material"},
    {{YIELDING, "law=exponential|rational|linear|memory|heat|both"}, "not with a law that follows"},
    {{YIELDING, "solver=cone"}, "solves Coulomb's law only"},
    {{YIELDING, "output=fclib"}, "Coulomb's cones alone"},
    /* more than the layer carries, or not the only answer */
    {{"interlayer=softening", "tangential=force*"}, NULL},
    /* a minute of meshes, on each of which other elements yield first */
    {{"interlayer=softening", "output=accuracy"}, NULL},
    /* a minute of GMRES; of the transforms its other rows are enough */
    {{"output=derivatives", "size=transforms", "regime!steady"}, NULL},
    {{"output=derivatives", "size=transforms", "surface!plain"}, NULL},
    {{"output=sweep", "regime=transient*|steps|static-history"}, "a study"},
    /* hysteresis is more than so little friction turns: a refusal of its own, whose line
     * tests/test_rolling_memory.c knows */
    {{"tangential=free-axle", "mu=1e-3", RELAXING}, NULL},
    /* with the surface's normals pressure is a part of Q, -M/R of it, and that is more
     * than so little friction makes up for */
    {{"normals=surface", "mu=1e-3", "surface=relaxing"}, NULL},
    /* meant for half-planes and equal elements */
    {{"size=transforms", "support!halfplane"}, NULL},
    {{"size=transforms", "body-b=hub|arc"}, NULL},
    {{"size=transforms", "mesh=fitted|punch"}, NULL},
    {{"size=transforms", "solver=lemke|cone"}, NULL},
    {{"size=transforms", "output=trace|dump*|accuracy|stress-fringes"}, NULL},
    /* friction reached step by step: 10 s and more; test_large does it */
    {{"size=transforms", "mu=3"}, NULL},
    {{"size=transforms", "output=error", "regime=transient*"}, NULL},
    {{"size=transforms", "surface!plain", "regime!steady"}, NULL},
    {{"size=transforms", "surface!plain", "mesh=aligned"}, NULL},
    /* a matrix of so many elements takes long */
    {{"size=transforms", "interlayer!none"}, NULL},
    /* without a wheel there is no boundary */
    {{"size=hierarchical", "support=halfplane"}, NULL},
    {{"size=hierarchical", "output=dump*|stress*|error|accuracy|sweep"}, NULL},
    {{"near-field!auto", "support=halfplane", "body-b=rigid|similar|dissimilar|cylinder|bore"},
     "it needs a wheel"},
    {{"near-field!auto", "support=halfplane", "body-b=hub"}, NULL},
};

/* The levels of a factor that a value of a conflict names, as a set of bits. */
typedef struct {
    int factor; /* -1: of no value */
    uint64_t levels;
} condition;

enum { MOST_CONFLICTS = 400 };
static struct {
    condition value[4];
    const char *reason;
} parsed[MOST_CONFLICTS];
static int parsed_n;

/* "factor=level", "factor!level": the choice-th level of those between bars; how many these are. */
static int parse(const char *value, int choice, condition *c)
{
    const size_t n = strcspn(value, "=!");
    const char *wanted = value + n + 1;
    int choices = 1;
    for (const char *bar = wanted; (bar = strchr(bar, '|')); choices++)
        if (++bar && choices <= choice)
            wanted = bar;
    const size_t length = strcspn(wanted, "|"), start = length - (wanted[length - 1] == '*');
    c->levels = 0;
    for (c->factor = 0; c->factor < FACTORS; c->factor++)
        if (strlen(factors[c->factor].name) == n && strncmp(factors[c->factor].name, value, n) == 0)
            break;
    if (c->factor == FACTORS) {
        print_error("no factor in %s\n", value);
        exit(1);
    }
    for (int v = 0; v < level_n[c->factor]; v++) {
        const char *name = levels[c->factor][v].name;
        const int same =
            strncmp(name, wanted, start) == 0 && (start < length || strlen(name) == length);
        if (same == (value[n] == '='))
            c->levels |= UINT64_C(1) << v;
    }
    return choices;
}

static void parse_conflicts(void)
{
    for (size_t k = 0; k < sizeof conflicts / sizeof *conflicts; k++)
        for (int choice = 0, choices = 1; choice < choices; choice++) {
            assert_true(parsed_n < MOST_CONFLICTS);
            int left = choice;
            choices = 1;
            for (int j = 0; j < 4; j++) {
                condition *c = &parsed[parsed_n].value[j];
                const char *value = conflicts[k].value[j];
                const int n = value ? parse(value, 0, c) : 1;
                c->factor = value ? c->factor : -1;
                if (value)
                    parse(value, left % n, c);
                left /= n;
                choices *= n;
            }
            parsed[parsed_n++].reason = conflicts[k].reason;
        }
}

static int holds(const condition *c, const int *row)
{
    return row[c->factor] != COVERING_OPEN && c->levels >> row[c->factor] & 1;
}

static int conflict_holds(const condition c[3], const int *row)
{
    for (int k = 0; k < 3 && c[k].factor >= 0; k++)
        if (!holds(&c[k], row))
            return 0;
    return 1;
}

static int excused = -1; /* the conflict that is wanted */

static int forbidden(const int *row)
{
    for (int k = 0; k < parsed_n; k++)
        if (k != excused && conflict_holds(parsed[k].value, row))
            return 1;
    return 0;
}

static int triples(void)
{
    return getenv("ROLLBEM_TEST_ALL") != NULL;
}

/* Levels that take a second or more: by pairs they meet two other factors only. */
static const struct {
    int factor;
    const char *name;
    int meets[2];
} costly[] = {
    {SIZE, "hierarchical", {BODY_B, REGIME}},
    {OUTPUT, "stress-fringes", {SUPPORT, GAP}},
};

enum { COSTLY = sizeof costly / sizeof costly[0] };

static int rare(int factor, int value)
{
    for (int k = 0; k < COSTLY; k++)
        if (factor == costly[k].factor && strcmp(levels[factor][value].name, costly[k].name) == 0)
            return 1;
    return 0;
}

static int spared(const int *row)
{
    int others = 0;
    for (int k = 0; k < COSTLY; k++)
        for (int f = 0; f < FACTORS && is(row, costly[k].factor, costly[k].name); f++)
            others += row[f] != COVERING_OPEN && f != costly[k].factor && f != costly[k].meets[0] &&
                      f != costly[k].meets[1];
    return others > 0;
}

/* ---- The command line of a row ----------------------------------------------------- */

/* Far below mu P of every case. */
static double force_of(const int *row)
{
    return is(row, MU, "way") ? 18.0 : 60.0 * strtod(name_of(row, MU), NULL);
}

static int has_history(const int *row)
{
    return starts(row, REGIME, "static-") || starts(row, REGIME, "transient-");
}

static int has_steps(const int *row)
{
    return !is(row, REGIME, "static") && !is(row, REGIME, "steady");
}

/* Through steps, under a table of the gap or a worn profile, derivatives are those on elements that
 * do not move, whatever the output. */
static int elements_stay(const int *row)
{
    return has_steps(row) && !starts(row, OUTPUT, "curve") && is(row, ZONE, "auto") &&
           !is(row, SIZE, "transforms") &&
           (is(row, WORN, "scar") || is(row, GAP, "file") || is(row, GAP, "smoothed"));
}

static int relaxes(const int *row)
{
    return is(row, SURFACE, "relaxing") || is(row, SURFACE, "b-relaxing");
}

/* Values that grow from a third to all of the last one. */
static void write_controls(const int *row)
{
    const int rolls = is(row, REGIME, "transient-history");
    struct {
        const char *name;
        double last;
    } column[5];
    int n = 0;
    if (rolls)
        column[n].name = "distance", column[n++].last = 0.0;
    else if (relaxes(row))
        column[n].name = "time", column[n++].last = 0.0;
    if (is(row, NORMAL, "load"))
        column[n].name = "load", column[n++].last = 800.0;
    if (is(row, NORMAL, "approach"))
        column[n].name = "approach", column[n++].last = 0.04;
    if (is(row, TANGENTIAL, "force"))
        column[n].name = "force", column[n++].last = force_of(row);
    else if (is(row, TANGENTIAL, "force-ratio"))
        column[n].name = "force_ratio", column[n++].last = -0.4;
    else if (is(row, TANGENTIAL, "creep") && rolls)
        column[n].name = "creep", column[n++].last = 2e-3;
    else if (is(row, TANGENTIAL, "creep-ratio") && rolls)
        column[n].name = "creep_ratio", column[n++].last = 0.4;
    else if (!rolls)
        column[n].name = "shift", column[n++].last = 2e-3;
    if (is(row, MU, "way")) /* falls while the others grow */
        column[n].name = "mu", column[n++].last = 0.3;

    FILE *file = fopen("controls.txt", "w");
    assert_non_null(file);
    for (int j = 0; j < n; j++)
        fprintf(file, "%s%s", column[j].name, j + 1 < n ? " " : "\n");
    for (int k = 1; k <= 3; k++)
        for (int j = 0; j < n; j++)
            fprintf(file, "%g%s",
                    j == 0 && rolls                     ? 0.2 * (k - 1)
                    : j == 0 && relaxes(row)            ? 0.02 * (k - 1)
                    : strcmp(column[j].name, "mu") == 0 ? column[j].last * (6 - k) / 3
                                                        : column[j].last * k / 3,
                    j + 1 < n ? " " : "\n");
    assert_int_equal(fclose(file), 0);
}

/* A cylinder with a little waviness. */
static void write_gap(void)
{
    FILE *file = fopen("gap.txt", "w");
    assert_non_null(file);
    for (int i = -150; i <= 150; i++) {
        const double x = 0.04 * i;
        fprintf(file, "%.10g %.10g\n", x, x * x / 100.0 + 1e-4 * cos(3.0 * x));
    }
    assert_int_equal(fclose(file), 0);
}

static const char *command_of(const int *row)
{
    return starts(row, OUTPUT, "stress")  ? "stress"
           : starts(row, OUTPUT, "curve") ? "curve"
           : is(row, OUTPUT, "sweep")     ? "sweep"
                                          : "";
}

/* Creepage is judged by mu a/R: where mu is a thousandth, its error falls so slowly that
 * an accuracy which other rows reach soon takes minutes.  These have error bars alone. */
static const char *output_of(const int *row)
{
    return is(row, OUTPUT, "accuracy") && is(row, MU, "1e-3")
               ? "--error --json"
               : levels[OUTPUT][row[OUTPUT]].arguments;
}

/* Few elements, for a row costs what they cost.  Error bars compare with half of them,
 * of which an aligned mesh, which some rows have without its name, needs twelve. */
static void add_size(const int *row, char *text, size_t size)
{
    const int compares = is(row, OUTPUT, "error") || is(row, OUTPUT, "accuracy");
    const int cover = starts(row, SURFACE, "cover") || is(row, SURFACE, "b-cover");
    const int least = compares ? 24 : 14;
    if (is(row, SIZE, "odd") || is(row, SIZE, "even"))
        snprintf(text + strlen(text), size - strlen(text), " --contact-elements %d",
                 least + is(row, SIZE, "odd"));
    if (is(row, SIZE, "hierarchical")) /* 1500 elements of a boundary: a hub has its own */
        snprintf(text + strlen(text), size - strlen(text), " --outer-elements %d",
                 is(row, SUPPORT, "hub") && !is(row, BODY_B, "arc") ? 1150 : 1500);
    else if (cover && !compares)
        snprintf(text + strlen(text), size - strlen(text), " --outer-elements 100");
    else if (is(row, SIZE, "odd") && !is(row, SUPPORT, "halfplane") && !compares)
        snprintf(text + strlen(text), size - strlen(text), " --outer-elements 50");
}

/* Options of the bodies that are there. */
static void add_shape(const int *row, char *text, size_t size)
{
    if (!is(row, SHAPE, "other"))
        return;
    snprintf(text + strlen(text), size - strlen(text), " --poisson 0.4%s --tol 1e-9%s%s",
             is(row, SUPPORT, "arc")   ? " --arc 60"
             : is(row, SUPPORT, "hub") ? " --hub-ratio 0.5"
                                       : " --datum 70",
             is(row, BODY_B, "hub")     ? " --hub-ratio-b 0.4"
             : is(row, BODY_B, "arc")   ? " --arc-b 45"
             : is(row, BODY_B, "rigid") ? ""
                                        : " --datum-b 60",
             is(row, BODY_B, "hub") ? " --poisson-b 0.2" : "");
}

static int rows; /* the number of the row at hand, from 1 on */

/* The cone solvers take turns; their "auto" and "lemke" are other solvers here. */
static const char *cone_solver_of_row(void)
{
    int n;
    const rb_friction_solver *cone = rb_friction_solvers(&n);
    for (int turn = rows;; turn++) {
        const char *name = cone[turn % n].name;
        if (strcmp(name, "auto") != 0 && strcmp(name, "lemke") != 0)
            return name;
    }
}

/* The case; output not included. */
static void case_arguments(const int *row, char *text, size_t size)
{
    text[0] = '\0';
    for (int f = 0; f < OUTPUT; f++)
        if (levels[f][row[f]].arguments[0])
            snprintf(text + strlen(text), size - strlen(text), " %s", levels[f][row[f]].arguments);
    if (is(row, GAP, "wave"))
        snprintf(text + strlen(text), size - strlen(text), " --amplitude 2");
    add_size(row, text, size);
    add_shape(row, text, size);
    if (relaxes(row))
        snprintf(text + strlen(text), size - strlen(text), " %s",
                 is(row, REGIME, "static-history") ? "--time-step 0.008" : "--speed 100");
    if (is(row, SOLVER, "cone"))
        snprintf(text + strlen(text), size - strlen(text), " --solver %s", cone_solver_of_row());
    if (starts(row, OUTPUT, "curve"))
        snprintf(text + strlen(text), size - strlen(text),
                 is(row, MU, "0") ? " --points 4 --over creep --from 0 --to 4e-3" : " --points 4");
    const size_t at = strlen(text);
    if (has_history(row)) {
        write_controls(row);
        if (is(row, REGIME, "transient-history"))
            return;
    } else if (is(row, NORMAL, "approach"))
        snprintf(text + at, size - at, " --approach 0.04");
    else if (is(row, NORMAL, "load"))
        snprintf(text + at, size - at, " --load 800");
    const size_t end = strlen(text);
    if (is(row, TANGENTIAL, "creep"))
        snprintf(text + end, size - end, " --creep 0.002");
    else if (is(row, TANGENTIAL, "creep-ratio"))
        snprintf(text + end, size - end, " --creep-ratio -0.4");
    else if (has_history(row))
        return;
    else if (is(row, TANGENTIAL, "force"))
        snprintf(text + end, size - end, " --force %g", force_of(row));
    else if (is(row, TANGENTIAL, "force-ratio"))
        snprintf(text + end, size - end, " --force-ratio -0.4");
    else if (is(row, TANGENTIAL, "shift"))
        snprintf(text + end, size - end, " --shift 0.002");
}

/* ---- Runs -------------------------------------------------------------------------- */

enum { CODE_LINE = 64, CODE_FILE = 65 }; /* refused on the command line, in a file */

static int failures, failed_solves;
static char line_of_row[2000]; /* the command at hand */

static void complain(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char text[2000];
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    print_error("%s\n    %s\n", line_of_row, text);
    failures++;
}

/* Splits line at blanks; 'a b' is one word. */
static int words(char *line, char **word, int room)
{
    int n = 0;
    for (char *p = line; *p && n + 1 < room;) {
        p += strspn(p, " ");
        if (!*p)
            break;
        const char *stop = *p == '\'' ? "'" : " ";
        p += *p == '\'';
        word[n++] = p;
        p += strcspn(p, stop);
        if (*p)
            *p++ = '\0';
    }
    word[n] = NULL;
    return n;
}

/* Program and words; its streams go to files.  The exit code, 128 + the signal.  What
 * counts is time of the processor, which others may want as well. */
static int run(const char *file, const char *arguments, const char *to, const char *errors)
{
    enum { SECONDS = 300 };
    char line[2500], *word[100];
    snprintf(line, sizeof line, "%s %s", file, arguments);
    words(line, word, 100);
    int status;
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit most = {SECONDS, SECONDS};
        setrlimit(RLIMIT_CPU, &most);
        alarm(6 * SECONDS); /* what waits for ever */
        const int o = open(to, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        const int e = open(errors, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (o < 0 || e < 0 || dup2(o, 1) < 0 || dup2(e, 2) < 0)
            _exit(126);
        execv(word[0], word);
        _exit(127);
    }
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

static long size_of(const char *path)
{
    struct stat st;
    return stat(path, &st) == 0 ? (long)st.st_size : -1;
}

/* Nothing on stdout and one line on stderr: how a refusal looks. */
static int is_refusal(const char *to, const char *errors)
{
    slurp(errors, err, sizeof err);
    const char *end = strchr(err, '\n');
    return size_of(to) == 0 && strncmp(err, "rollbem: ", 9) == 0 && end && !end[1];
}

/* ---- Files ------------------------------------------------------------------------- */

static int ends_with(const char *path, const char *end)
{
    const size_t n = strlen(path), m = strlen(end);
    return n >= m && strcmp(path + n - m, end) == 0;
}

/* The first and the last bytes of a whole file of its kind. */
static void check_whole(const char *path)
{
    static const struct {
        const char *extension, *head, *tail;
    } kinds[] = {{".png", "\x89PNG\r\n\x1a\n", "IEND\xae\x42\x60\x82"},
                 {".svg", "<?xml", "</svg>"},
                 {".pdf", "%PDF-", "%%EOF"},
                 {".eps", "%!PS-Adobe-", "%%EOF"},
                 {".tex", "% Needs \\use", "gnuplot variables"},
                 {".gif", "GIF89a", ";"},
                 {".vtu", "<?xml", "</VTKFile>"},
                 {".hdf5", "\x89HDF\r\n\x1a\n", ""},
                 {".tsv", "", ""}, /* the checker reads it */
                 {"out.history", "distance_a\t", ""},
                 {".mtx", "%%MatrixMarket", ""}};
    char head[16] = "", tail[32] = "";
    FILE *file = fopen(path, "rb");
    if (!file) {
        complain("%s was not written", path);
        return;
    }
    const size_t head_n = fread(head, 1, sizeof head, file);
    size_t tail_n =
        fseek(file, -(long)sizeof tail, SEEK_END) == 0 ? fread(tail, 1, sizeof tail, file) : 0;
    fclose(file);
    while (tail_n > 0 && tail[tail_n - 1] == '\n')
        tail_n--;
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        const size_t h = strlen(kinds[k].head), t = strlen(kinds[k].tail);
        if (ends_with(path, kinds[k].extension) &&
            (head_n < h || tail_n < t || memcmp(head, kinds[k].head, h) != 0 ||
             memcmp(tail + tail_n - t, kinds[k].tail, t) != 0))
            complain("%s is not whole", path);
    }
}

static int is_known(const char *name, const int *row)
{
    static const char *const ours[] = {"json",         "json.err",    "out.table", "table.err",
                                       "verdict",      "verdict.err", "flat.txt",  "worn.txt",
                                       "controls.txt", "gap.txt",     "mu.txt",    "points.txt",
                                       "layers.txt",   "again",       "again.err"};
    for (size_t k = 0; k < sizeof ours / sizeof ours[0]; k++)
        if (strcmp(name, ours[k]) == 0)
            return 1;
    return strncmp(name, "out", 3) == 0 &&
           strstr(levels[OUTPUT][row[OUTPUT]].arguments, name) != NULL;
}

/* What lies in the folder afterwards: only what was asked for, and that whole. */
static void check_files(const char *folder_name, const int *row)
{
    struct dirent *d;
    char path[700];
    DIR *dir = opendir(folder_name);
    if (!dir)
        return;
    while ((d = readdir(dir))) {
        if (strcmp(d->d_name, ".") == 0 || strcmp(d->d_name, "..") == 0)
            continue;
        const int top = strcmp(folder_name, ".") == 0;
        snprintf(path, sizeof path, top ? "%.0s%s" : "%s/%s", folder_name, d->d_name);
        if (top && !is_known(d->d_name, row))
            complain("%s was left behind", path);
        if (top && strcmp(d->d_name, "out") == 0)
            check_files("out", row);
        else if (!top || strncmp(d->d_name, "out.", 4) == 0)
            if (strcmp(path, "out.table") != 0)
                check_whole(path);
    }
    closedir(dir);
}

/* Files that the command names must be there. */
static void check_written(const int *row)
{
    char line[300], *word[20];
    snprintf(line, sizeof line, "%s", levels[OUTPUT][row[OUTPUT]].arguments);
    const int n = words(line, word, 20);
    for (int k = 0; k < n; k++)
        if (strncmp(word[k], "out", 3) == 0 && size_of(word[k]) <= 0)
            complain("%s was not written", word[k]);
}

/* A starting `rm` would take longer than many a case. */
static int remove_below(const char *path, const struct stat *st, int type, struct FTW *where)
{
    (void)st;
    (void)type;
    return where->level == 0 ? 0 : remove(path);
}

static void empty_folder(void)
{
    assert_int_equal(nftw(".", remove_below, 16, FTW_DEPTH | FTW_PHYS), 0);
    write_gap();
    write_file("worn.txt", "-0.9 0\n-0.3 2e-4\n0.2 3e-4\n0.8 0\n");
    write_file("flat.txt", "0.8 0\n1 4e-5\n1.2 1e-4\n1.4 4e-5\n1.6 0\n");
    write_file("mu.txt", "-0.8 0.3\n-0.3 0.2\n0.1 0.25\n0.9 0.15\n");
    write_file("points.txt", "0 0.5\n0.3 0.8\n-1 1.2\n");
    write_file("layers.txt", "0.4 90000 0.1\n0.3 30000 0.4\n1.3 60000 0.25\n");
}

/* ---- A row ------------------------------------------------------------------------- */

static char checker[700], differences[700], calls[700];

/* table: the first run printed one. */
static void check_verdict(const int *row, int table)
{
    char arguments[300];
    snprintf(arguments, sizeof arguments, "%s %s %s json",
             !table                      ? ""
             : is(row, OUTPUT, "output") ? "--table out.tsv"
                                         : "--table out.table",
             command_of(row)[0] ? "" : "--summary table.err",
             has_history(row) ? "--controls controls.txt" : "");
    const int code = run(checker, arguments, "verdict", "verdict.err");
    slurp("verdict", out, sizeof out);
    slurp("verdict.err", err, sizeof err);
    if (code > 1 || err[0])
        complain("the checker ends with %d: %s", code, err);
    for (char *line = strtok(out, "\n"); line; line = strtok(NULL, "\n"))
        complain("%s", line);
}

/* Solutions of rows, and those that have a matrix and are not proved. */
static int proofs, unproved;

/* What `rollbem check --prove` says of the JSON in the folder: valid, or why it cannot be
 * checked; and whether it is proved. It has a formula of its own for hysteresis, of every body and
 * support. */
static void check_certificate(const int *row)
{
    static const char *const reasons[] = {"error bars take solutions on other meshes",
                                          "its last state depends on the steps before it",
                                          "results with 'curve'"};
    /* a proof of every step of 1500 elements takes minutes */
    const int is_long = is(row, SIZE, "transforms") && has_steps(row);
    int code =
        run(program, is_long ? "check json" : "check --prove json", "verdict", "verdict.err");
    slurp("verdict", out, sizeof out);
    slurp("verdict.err", err, sizeof err);
    proofs += strstr(out, "proved") != NULL;
    if (code == 1 && strstr(out, "json: valid") && !strstr(out, "violated")) {
        code = 0; /* of a few an element may be on the border of two zones */
        if (!strstr(out, "too many elements")) {
            unproved++;
            print_message("%s\n%s\n", line_of_row, out);
        }
    }
    int known = 0;
    for (size_t k = 0; k < sizeof reasons / sizeof *reasons; k++)
        known |= strstr(err, reasons[k]) != NULL;
    if (code != 0 && !(code == 65 && known))
        complain("rollbem check ends with %d: %.400s%.400s", code, out, err);
}

/* Of what has none: friction that depends on the state, or yields, without matrices; a
 * history whose unit is found. */
static int has_no_derivatives(const char *errors)
{
    static const char *const reasons[] = {"needs matrices", "give a load"};
    for (size_t k = 0; k < sizeof reasons / sizeof *reasons; k++)
        if (strstr(errors, reasons[k]))
            return 1;
    return 0;
}

/* Against differences of solutions, in a process of its own: every sixth input; of
 * transforms against the same state with a matrix.  A flexibility by transforms is known to
 * 1e-12 or so; a boundary of 1500 elements is compressed. */
static void check_derivatives(const int *row, const char *the_case)
{
    char arguments[2000];
    const char *bound = is(row, SIZE, "hierarchical") && has_steps(row) ? "1e-7"
                        : is(row, SIZE, "transforms")                   ? "3e-8"
                                                                        : "1e-8";
    snprintf(arguments, sizeof arguments, "%d 6 %s%s", rows % 6, bound, the_case);
    const int code = run(differences, arguments, "verdict", "verdict.err");
    slurp("verdict", out, sizeof out);
    slurp("verdict.err", err, sizeof err);
    if (code > 1 && !has_no_derivatives(err))
        complain("the differences end with %d: %s", code, err);
    if (out[0])
        complain("%s", out);
}

/* What else the library computes from this case, in a process of its own; of derivatives of
 * one step every third row has some.  The checker judges no digit of it: fewer elements
 * outside the contact are enough. */
static void check_calls(const int *row, const char *the_case)
{
    static const char *const kinds[] = {"smooth", "exact", "stress", "stress", "stress", "stress"};
    const int wheel =
        !is(row, SUPPORT, "halfplane") || is(row, BODY_B, "hub") || is(row, BODY_B, "arc");
    const int cover = starts(row, SURFACE, "cover") || is(row, SURFACE, "b-cover");
    char arguments[2000];
    if (starts(row, OUTPUT, "curve") || is(row, SIZE, "transforms") ||
        is(row, SIZE, "hierarchical")) /* "--points" is none of the case; large ones take long */
        return;
    snprintf(arguments, sizeof arguments, "%s %s%s%s", kinds[rows % 6], the_case,
             is(row, OUTPUT, "error") ? " --error" : "",
             wheel && !cover && !has_steps(row) ? " --outer-elements 50" : "");
    const int code = run(calls, arguments, "verdict", "verdict.err");
    slurp("verdict", out, sizeof out);
    slurp("verdict.err", err, sizeof err);
    if (code != 0 || out[0] || err[0])
        complain("the calls end with %d: %.1000s%.400s", code, out, err);
}

/* Cone solvers may fail, but say so; what there is, is printed. */
static int may_fail(const int *row)
{
    /* and an accuracy may be out of reach; under large friction no path is promised to
     * lead through an interface that softens (theory-rolling.md 4.12) */
    return is(row, SOLVER, "cone") || is(row, OUTPUT, "accuracy") ||
           (is(row, INTERLAYER, "softening") && is(row, MU, "3"));
}

/* The status, after the number and the varied value, of every row of a study that is not
 * solved. */
static int all_unsolved_are(rb_status status, const char *table)
{
    char text[4000];
    int unsolved = 0, others = 0, s;
    FILE *file = fopen(table, "r");

    assert_non_null(file);
    while (fgets(text, sizeof text, file))
        if (sscanf(text, "%*d %*s %d", &s) == 1 && s != RB_OK)
            *(s == (int)status ? &unsolved : &others) += 1;
    fclose(file);
    return unsolved > 0 && others == 0;
}

/* The contact may outgrow a zone that is given, which then is said: along a curve or a
 * study, by large friction and in a bore, which make it
 * wider. */
static int outgrows_zone(const int *row, const char *errors)
{
    if (!is(row, ZONE, "given"))
        return 0;
    if (is(row, OUTPUT, "sweep"))
        return all_unsolved_are(RB_ZONE, "out.table");
    return (starts(row, OUTPUT, "curve") || is(row, MU, "3") || is(row, BODY_B, "bore")) &&
           (strstr(errors, "zone: the contact is not within the potential contact") ||
            strstr(errors, "the contact reaches the end of the potential contact"));
}

/* Within every step of an input an element of a boundary may come or go; then there is no
 * derivative by it. */
static int changes_boundary(const int *row, const char *errors)
{
    return is(row, OUTPUT, "derivatives") && has_steps(row) &&
           strstr(errors, "derivatives: the elements outside the contact change with");
}

static void check_failure(const int *row, int code, const char *errors)
{
    slurp(errors, err, sizeof err);
    const char *line = strstr(err, "rollbem: ");
    for (const char *next = line; next; next = strstr(next + 1, "\nrollbem: "))
        line = next;
    if (code != 1 || !(may_fail(row) || outgrows_zone(row, err) || changes_boundary(row, err)))
        complain("exit code %d: ...%s", code, err + (strlen(err) > 400) * (strlen(err) - 400));
    else if (!line && !strstr(err, "; not solved: ")) /* a study counts them */
        complain("exit code 1 without a reason: %s", err);
    failed_solves++;
}

/* The command with its output, which JSON may be; where it is not, once more as JSON for
 * the checker. */
static void check_row(const int *row)
{
    char the_case[1500], arguments[2000];
    const char *output = output_of(row);
    const char *command = command_of(row);
    /* what the output option changes in the result itself, JSON must have too */
    const char *behind = is(row, OUTPUT, "error")            ? output
                         : strstr(output, "--trace")         ? "--trace"
                         : strstr(output, "--points points") ? output
                                                             : "";
    empty_folder();
    case_arguments(row, the_case, sizeof the_case);
    snprintf(line_of_row, sizeof line_of_row, "rollbem %s%s %s", command, the_case, output);
    snprintf(arguments, sizeof arguments, "%s%s %s", command, the_case, output);
    const int code = run(program, arguments, "out.table", "table.err");
    if (is(row, OUTPUT, "derivatives") && code == CODE_LINE &&
        is_refusal("out.table", "table.err") && has_no_derivatives(err))
        return;
    check_calls(row, the_case);
    if (code != 0) {
        check_failure(row, code, "table.err");
        return;
    }
    if (is(row, OUTPUT, "derivatives") || (elements_stay(row) && rows % 3 == 0))
        check_derivatives(row, the_case);
    check_written(row);
    check_files(".", row);
    if (is(row, OUTPUT, "sweep"))
        return;
    if (strstr(output, "--json")) {
        assert_int_equal(rename("out.table", "json"), 0);
        check_verdict(row, 0);
        check_certificate(row);
        return;
    }
    snprintf(arguments, sizeof arguments, "%s%s %s%s --json --quiet", command, the_case, behind,
             has_steps(row) && !command[0] ? " --states" : "");
    const int again = run(program, arguments, "json", "json.err");
    if (again != 0)
        check_failure(row, again, "json.err");
    else {
        check_verdict(row, !command[0]);
        check_certificate(row);
    }
}

/* The rows are shared out to processes, each with a folder of its own: who has ended one
 * takes the next one that nobody has, because some take a hundred times as long as
 * others. */
static int (*all_rows)[COVERING_FACTORS], all_n, all_room;
static atomic_int *rows_taken; /* by all of them, in shared memory */

static void keep_row(const int *row)
{
    if (all_n == all_room) {
        all_room = 2 * all_room + 256;
        all_rows = realloc(all_rows, (size_t)all_room * sizeof *all_rows);
        assert_non_null(all_rows);
    }
    memcpy(all_rows[all_n++], row, sizeof *all_rows);
}

static covering array_of(int strength)
{
    covering c = {.factors = FACTORS,
                  .strength = strength,
                  .forbidden = forbidden,
                  .rare = rare,
                  .spared = spared};
    memcpy(c.levels, level_n, sizeof level_n);
    return c;
}

/* ---- Tests ------------------------------------------------------------------------- */

/* A new option must become a factor or be named. */
TEST(test_every_option_is_a_factor)
{
    int n;
    const rb_option *options = rb_case_describe(&n);
    for (int i = 0; i < n; i++) {
        int known = options[i].kind == RB_OPTION_GROUP;
        for (int f = 0; f < FACTORS; f++)
            known |= factors[f].option && strcmp(factors[f].option, options[i].name) == 0;
        char word[60];
        snprintf(word, sizeof word, " %s ", options[i].name);
        known |= strstr(options_elsewhere, word) != NULL;
        if (!known)
            fail_msg("--%s is in no factor", options[i].name);
    }
}

/* A row with exactly that conflict. */
static int row_with(covering *c, int k, int *row)
{
    int seed[COVERING_FACTORS];
    for (int f = 0; f < COVERING_FACTORS; f++)
        seed[f] = COVERING_OPEN;
    for (int j = 0; j < 4; j++) {
        const condition *wanted = &parsed[k].value[j];
        if (wanted->factor < 0)
            continue;
        for (int v = 0; v < level_n[wanted->factor] && !holds(wanted, seed); v++)
            if (wanted->levels >> v & 1)
                seed[wanted->factor] = v;
    }
    return covering_row(c, seed, row);
}

/* What the net leaves out because the program refuses it, it does refuse, in one line. */
TEST(test_every_conflict_is_refused)
{
    char the_case[1500], arguments[2000];
    int row[COVERING_FACTORS];
    covering c = array_of(2);
    covering_start(&c);
    for (int k = 0; k < parsed_n; k++) {
        if (!parsed[k].reason || !is_in_turn(k, 8))
            continue;
        excused = k;
        c.random = 20061; /* whatever conflicts come before */
        assert_true(row_with(&c, k, row));
        excused = -1;
        empty_folder();
        case_arguments(row, the_case, sizeof the_case);
        snprintf(arguments, sizeof arguments, "%s%s %s", command_of(row), the_case,
                 levels[OUTPUT][row[OUTPUT]].arguments);
        snprintf(line_of_row, sizeof line_of_row, "rollbem %.1900s", arguments);
        const int code = run(program, arguments, "out.table", "table.err");
        if (!is_refusal("out.table", "table.err") || (code != CODE_LINE && code != CODE_FILE) ||
            !strstr(err, parsed[k].reason))
            complain("exit code %d, want a line with '%s': %s", code, parsed[k].reason, err);
        check_files(".", row);
    }
    free(c.covered);
    assert_int_equal(failures, 0);
}

/* What a worker found, through a pipe. */
typedef struct {
    int failures, failed_solves, proofs, unproved;
} findings;

enum { TURNS = 40 }; /* parts of the rows, one in each run */

static void work(int worker, int result)
{
    char name[40];
    snprintf(name, sizeof name, "worker-%d", worker);
    if (mkdir(name, 0777) != 0 || chdir(name) != 0)
        _exit(1);
    failures = 0;
    setenv("OMP_NUM_THREADS", "1", 1); /* there is a worker for every processor */
    for (int row; (row = atomic_fetch_add(rows_taken, 1)) < all_n;)
        if (is_in_turn(row, TURNS)) {
            rows = row + 1; /* counted from 1 on */
            check_row(all_rows[row]);
        }
    const findings found = {failures, failed_solves, proofs, unproved};
    const int whole = write(result, &found, sizeof found) == (ssize_t)sizeof found;
    fflush(NULL);
    _exit(!whole);
}

TEST(test_every_combination)
{
    findings all = {0};
    int ends[2], status;
    covering c = array_of(triples() ? 3 : 2);

    covering_visit(&c, keep_row);
    assert_int_equal(pipe(ends), 0);
    rows_taken =
        mmap(NULL, sizeof *rows_taken, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(rows_taken != MAP_FAILED);
    const int workers = (int)fmin(fmax(1.0, (double)sysconf(_SC_NPROCESSORS_ONLN)), 16.0);
    for (int k = 0; k < workers; k++)
        if (fork() == 0)
            work(k, ends[1]);
    for (int k = 0; k < workers; k++) {
        findings found;
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
        assert_int_equal(read(ends[0], &found, sizeof found), sizeof found);
        all.failures += found.failures;
        all.failed_solves += found.failed_solves;
        all.proofs += found.proofs;
        all.unproved += found.unproved;
    }
    print_message("%d of %d solutions are proved\n", all.proofs - all.unproved, all.proofs);
    CHECK_MAX(all.unproved, 1.0 + 0.01 * all.proofs, "solutions that are not proved");
    print_message("%d rows%s cover %d %s; %d contain a conflict; %d rows ended with exit code 1\n",
                  all_n, triples() ? "" : ", a part of them in each turn,", c.tuples,
                  triples() ? "triples" : "pairs", c.unreachable, all.failed_solves);
    free(all_rows);
    assert_int_equal(all.failures, 0);
}

static int enter(void **state)
{
    const int entered = enter_folder(state);
    const char *slash = strrchr(program, '/');
    snprintf(checker, sizeof checker, "%.*s/tests/checker", (int)(slash - program), program);
    snprintf(differences, sizeof differences, "%.*s/tests/differences", (int)(slash - program),
             program);
    snprintf(calls, sizeof calls, "%.*s/tests/calls", (int)(slash - program), program);
    set_levels();
    parse_conflicts();
    return entered;
}

RUN_TESTS(enter, leave_folder)
