/* Parts of reports by themselves: cells, studies, files of matrices and of ParaView. */
#include "cases.h"
#include "case_words.h"
#include "base/io/io.h"
#include "program/report/report.h"

#include <dirent.h>

/* What is in a file, in static storage. */
static char *content(FILE *file)
{
    static char text[100000];
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    return text;
}

/* ---- Cells ------------------------------------------------------------------------- */

/* A cell that a reader would split or skip stands in quotes. */
TEST(cells_are_quoted_where_needed)
{
    static const struct {
        const char *text, *cell;
    } cells[] = {{"plain", "plain"},           {"", "\"\""},     {"two words", "\"two words\""},
                 {"a,b", "\"a,b\""},           {"#1", "\"#1\""}, {"say \"x\"", "\"say \"\"x\"\"\""},
                 {"tab\there", "tab\\x09here"}};
    for (int csv = 0; csv < 2; csv++)
        for (size_t k = 0; k < sizeof cells / sizeof *cells; k++) {
            const rb_report_style style = {.format = csv ? RB_REPORT_CSV : RB_REPORT_TSV,
                                           .bare = 1};
            FILE *file = tmpfile();
            char want[100];
            rb_report_cells c = rb_report_cells_begin(file, &style, "");
            rb_report_cell_whole(&c, 7);
            rb_report_cell_text(&c, cells[k].text);
            rb_report_cell_number(&c, NAN);
            rb_report_cells_end_row(&c);
            snprintf(want, sizeof want, csv ? "7,%s,\n" : "7\t%s\tNaN\n", cells[k].cell);
            assert_string_equal(content(file), want);
            fclose(file);
        }
}

/* ---- Notes ------------------------------------------------------------------------- */

typedef struct {
    rb_rolling_case rc;
    rb_rolling_solution s;
    rb_rolling_patch patch[2];
} noted;

/* A steady case of a half-plane with R = 50 mm of which nothing has to be said. */
static void quiet(noted *n)
{
    memset(n, 0, sizeof *n);
    n->rc = rolling_case("support halfplane radius 50 creep 1e-3");
    n->rc.formulation = n->s.formulation = RB_STEADY;
    n->s.creep_ratio = 0.5;
    n->s.creepage = 1e-3;
    n->s.contact = 6;
    n->s.stick = 3;
    n->s.patch = n->patch;
    n->s.patches = 1;
    n->s.half_width = 1.0;
}

/* The first patch ends at `to`, the second one lies between from and last. */
static void two_patches(noted *n, double half_width, double to, double from, double last)
{
    n->s.patches = 2;
    n->s.half_width = half_width;
    n->patch[0].to = to;
    n->patch[1] = (rb_rolling_patch){.from = from, .to = last};
}

static void slide_by_force(noted *n)
{
    set(&n->rc, "creep nan force-ratio 1");
    n->s.stick = 0;
}

static void dissipate(noted *n, double power)
{
    n->s.normal_load = 100.0;
    n->s.dissipation = power;
}

static void check_note(noted *n, const char *want, const char *changes)
{
    if (n->s.patches == 1)
        n->patch[0] = (rb_rolling_patch){.from = -n->s.half_width, .to = n->s.half_width};
    const rb_rolling_note_list list = rb_rolling_find_notes(&n->rc, &n->s);
    if (list.n != (want != NULL) || (want && !strstr(list.text[0], want)))
        fail_msg("%s: %d notes: %s; wanted: %s", changes, list.n, list.n ? list.text[0] : "",
                 want ? want : "none");
}

/* The note (NULL: none) of the quiet case with these changes. */
#define NOTED(want, ...)                                                                           \
    do {                                                                                           \
        noted n;                                                                                   \
        rb_rolling_case *rc = &n.rc;                                                               \
        rb_rolling_solution *s = &n.s;                                                             \
        quiet(&n);                                                                                 \
        (void)rc, (void)s;                                                                         \
        __VA_ARGS__;                                                                               \
        check_note(&n, want, #__VA_ARGS__);                                                        \
    } while (0)

/* Each note on both sides of its condition. */
TEST(notes_of_large_strains_begin_where_they_should)
{
    static const char inaccurate[] = "large for linear elasticity",
                      broken[] = "far beyond linear elasticity";
    NOTED(NULL, );
    NOTED(NULL, s->approach = 50.0 * 0.0199);
    NOTED(inaccurate, s->approach = 50.0 * 0.0201);
    NOTED(inaccurate, s->approach = 50.0 * 0.0999);
    NOTED(broken, s->approach = 50.0 * 0.1001);
    NOTED(NULL, s->half_width = 50.0 * 0.0999);
    NOTED(inaccurate, s->half_width = 50.0 * 0.1001);
    NOTED(inaccurate, s->half_width = 50.0 * 0.2999);
    NOTED(broken, s->half_width = 50.0 * 0.3001);
    /* two narrow patches far apart, the second of them wide, the first, and of a small cylinder */
    NOTED(NULL, two_patches(&n, 40.0, 1.0, 30.0, 31.0));
    NOTED(inaccurate, two_patches(&n, 40.0, 1.0, 20.0, 31.0));
    NOTED(inaccurate, two_patches(&n, 1.0, 11.0, 30.0, 31.0));
    NOTED(NULL, two_patches(&n, 4.0, 0.1, 3.0, 3.1); rc->a.radius = 5.0);
}

TEST(notes_of_what_is_given_begin_where_they_should)
{
    static const char enters[] = "does not change the tractions",
                      angle[] = "depends on the angle of the wheel";
    NOTED("rolls at creepage 0", rc->creep = NAN);
    NOTED(NULL, set(rc, "creep nan creep-ratio 0.5"));
    NOTED(NULL, set(rc, "creep nan force 1"));
    NOTED(NULL, set(rc, "creep nan free-axle"));
    NOTED(enters, set(rc, "formulation static"));
    NOTED(NULL, set(rc, "formulation static creep nan"));
    NOTED(angle, set(rc, "support arc arc 30"));
    NOTED(NULL, set(rc, "support hub"));
    NOTED("in radians, write --arc 1.99rad",
          set(rc, "formulation static creep nan support arc arc 1.99"));
    NOTED(NULL, set(rc, "formulation static creep nan support arc arc 2"));
}

TEST(notes_of_friction_begin_where_they_should)
{
    static const char sliding[] = "The whole contact slides: the creepage is not unique";
    NOTED("The interface yields", s->yielding = 1);
    NOTED(sliding, slide_by_force(&n));
    NOTED(NULL, slide_by_force(&n); s->stick = 1);
    NOTED(NULL, slide_by_force(&n); s->contact = 0);
    NOTED(NULL, slide_by_force(&n); rc->mu = 0.0);
    NOTED(NULL, slide_by_force(&n); s->formulation = RB_STATIC);
    NOTED(NULL, slide_by_force(&n); set(rc, "friction-law exponential mu-fall 0.1 slip-scale 1"));
    NOTED(sliding, slide_by_force(&n); set(rc, "force-ratio nan force 30"));
    NOTED(NULL, s->kappa = 0.95);
    NOTED("(kappa = 0.96) that", s->kappa = 0.96);
    NOTED(NULL, s->slip_violations = 2); /* of rolling nothing is said */
    NOTED(NULL, set(rc, "formulation static creep nan"); s->slip_violations = 2);
}

TEST(notes_of_elements_begin_where_they_should)
{
    static const char shorter[] = "which the force drives, is shorter than an element";
    NOTED("equal ones were used", s->equal_instead = 1);
    /* below zero, by more than rounding */
    NOTED("The dissipation, -1e-09 N/mm, is below zero", dissipate(&n, -1e-9));
    NOTED(NULL, dissipate(&n, -1e-11));
    /* where elements are aligned, or cannot be */
    NOTED("take more of them or --mesh aligned.", dissipate(&n, -1e-9); set(rc, "mesh uniform"));
    NOTED("take more of them.", dissipate(&n, -1e-9); set(rc, "mesh aligned"));
    /* where the force drives nothing, or something slips, it is right */
    NOTED(shorter, s->force_ratio = -0.0011);
    NOTED(NULL, s->force_ratio = 0.0009);
    NOTED(NULL, s->force_ratio = -0.0011; s->slipping = 1);
}

/* ---- Studies ----------------------------------------------------------------------- */

enum { MOST = 200 };

/* A study of so many x and y, in the order of the cases, and what it shows. */
static rb_report_study study_of(int nx, int ny, int with_y, double *room)
{
    double *x = room, *y = room + MOST, *value = room + 2 * MOST;
    for (int k = 0; k < nx * ny; k++) {
        x[k] = 1.0 + k % nx;
        y[k] = 10.0 * (1 + k / nx);
        value[k] = x[k] * y[k];
    }
    return (rb_report_study){.n = nx * ny,
                             .x = {"load", "N/mm", x, NULL},
                             .y = {"mu", "", with_y ? y : NULL, NULL},
                             .shown = {"max_pressure", "MPa", value, NULL}};
}

TEST(studies_that_make_no_picture_are_named)
{
    static double room[3 * MOST];
    static const struct {
        int nx, ny, with_y, map, place; /* place: of the x that is changed to `to`; or -1 */
        double to;
        const char *why; /* NULL: it can be drawn */
    } studies[] = {{3, 2, 1, 0, -1, 0.0, NULL},
                   {3, 2, 1, 1, -1, 0.0, NULL},
                   {3, 1, 0, 0, -1, 0.0, NULL},
                   {3, 2, 1, 0, 2, 2.0,
                    "cases 2 and 3 have the same load and mu: more options vary than the picture "
                    "shows"},
                   {3, 1, 0, 0, 2, 1.0,
                    "cases 1 and 3 have the same load: more options vary than the picture shows"},
                   {2, 17, 1, 0, -1, 0.0, "17 values of mu: at most 16 curves are drawn"},
                   {2, 16, 1, 0, -1, 0.0, NULL},
                   {1, 2, 1, 0, -1, 0.0, "a curve needs two values of load; mu = 10 has one"},
                   {1, 1, 0, 0, -1, 0.0, "a curve needs two values of load"},
                   {3, 1, 0, 1, -1, 0.0, "a map needs two options with two values or more"},
                   {3, 1, 1, 1, -1, 0.0, "a map needs two options with two values or more"},
                   {1, 3, 1, 1, -1, 0.0, "a map needs two options with two values or more"},
                   {3, 2, 1, 1, 5, 9.0,
                    "a map needs a case for every pair of load and mu; those with mu = 20 are "
                    "others "
                    "than those with mu = 10"}};
    for (size_t k = 0; k < sizeof studies / sizeof *studies; k++) {
        rb_report_study s = study_of(studies[k].nx, studies[k].ny, studies[k].with_y, room);
        rb_message why = {.text = ""};
        if (studies[k].place >= 0)
            room[studies[k].place] = studies[k].to;
        const rb_status status = rb_report_study_check(&s, studies[k].map, &why);
        CHECK_STATUS(status, studies[k].why ? RB_EINVAL : RB_OK);
        assert_string_equal(why.text, studies[k].why ? studies[k].why : "");
    }
    rb_report_study ragged = study_of(3, 2, 1, room); /* three of one, two of the other */
    ragged.n = 5;
    rb_message why = {.text = ""};
    CHECK_STATUS(rb_report_study_check(&ragged, 1, &why), RB_EINVAL);
    CHECK_OK(rb_report_study_check(&ragged, 0, &why));
    alloc_fail_after(0);
    const rb_status s = rb_report_study_check(&ragged, 0, &why);
    alloc_succeed();
    CHECK_STATUS(s, RB_ENOMEM);
    assert_string_equal(why.text, "out of memory for 5 cases");
}

static const char *drawn(const rb_report_study *s, int map)
{
    const rb_report_canvas canvas = {.kind = RB_REPORT_SVG, .script = 1};
    FILE *out = tmpfile();
    CHECK_OK(rb_report_study_picture(out, canvas, s, map, &message));
    const char *script = content(out);
    fclose(out);
    return script;
}

/* Colours between few values, labels in the middle of the contours; a result that is the
 * same in all cases has one colour and no contours. */
TEST(maps_suit_the_number_of_cases)
{
    static double room[3 * MOST];
    rb_report_study s = study_of(3, 2, 1, room);
    const char *script = drawn(&s, 1);
    assert_non_null(strstr(script, "between_x = 27\nbetween_y = 40\n"));
    assert_non_null(strstr(script, "level_step = 10.0\nlevel_first = 20.0\n"));
    assert_non_null(strstr(script, "$numbers << EOD\nx y level\n1.66666667 11.6666667 20\n"));
    assert_non_null(
        strstr(script, "$table << EOD\nx y value\n1 10 10\n2 10 20\n3 10 30\n\n1 20 20\n"));
    s = study_of(90, 2, 1, room);
    script = drawn(&s, 1);
    assert_non_null(strstr(script, "between_x = 1\nbetween_y = 40\n"));
    for (int zero = 0; zero < 2; zero++) { /* the same but for rounding, or zero */
        for (int k = 0; k < s.n; k++)
            room[2 * MOST + k] = zero ? 0.0 : 4.0 * (1.0 + 1e-15 * (k % 3));
        for (int map = 0; map < 2; map++) {
            script = drawn(&s, map);
            double from, to;
            assert_int_equal(sscanf(NOT_NULL(strstr(script, "v_from = ")),
                                    "v_from = %lf v_to = %lf", &from, &to),
                             2);
            CHECK_REL(from, zero ? -1.0 : 3.6, 1e-12, "from");
            CHECK_REL(to, zero ? 1.0 : 4.4, 1e-12, "to");
            assert_non_null(strstr(script, "flat = 1\n"));
            assert_null(strstr(script, "$numbers << EOD"));
        }
    }
    for (int k = 0; k < s.n; k++)
        room[2 * MOST + k] = 1e-16 * (k % 3);
    s.rounding = 3e-16; /* about zero */
    assert_non_null(strstr(drawn(&s, 1), "all 0 but for rounding"));
    assert_non_null(strstr(drawn(&s, 1), "v_from = -1.0\nv_to = 1.0\n"));
    s.rounding = 1e-16;
    assert_non_null(strstr(drawn(&s, 1), "flat = 0\n"));
    s.rounding = 0.0;
    for (int k = 0; k < s.n; k++)
        room[2 * MOST + k] = 0.0;
    room[2 * MOST] = 1e-8; /* beside zero that is a difference */
    assert_non_null(strstr(drawn(&s, 1), "flat = 0\n"));
    assert_non_null(strstr(drawn(&s, 0), "flat = 0\n"));
}

/* A curve for each value of the other option; a power of ten stands beside the unit. */
TEST(curves_suit_the_number_of_cases)
{
    static double room[3 * MOST];
    for (int many = 0; many < 2; many++) {
        rb_report_study s = study_of(many ? 25 : 24, 2, 1, room);
        const char *script = drawn(&s, 0);
        assert_non_null(strstr(script, many ? "first = ' 0 25'\nlast = ' 24 49'\n"
                                            : "first = ' 0 24'\nlast = ' 23 47'\n"));
        assert_non_null(strstr(script, "name1 = '10'\n"));
        assert_non_null(strstr(script, "v_label = 'max pressure  [MPa]'\n"));
        assert_non_null(strstr(script, "x_label = 'load  [N/mm]'\n"));
    }
    rb_report_study s = study_of(3, 1, 0, room);
    room[2 * MOST] = -2e5;
    s.shown.unit = "";
    const char *script = drawn(&s, 0);
    assert_non_null(strstr(script, "v_label = 'max pressure  [10^{5}]'\n"));
    assert_non_null(strstr(script, "v_unit = 100000.0\n"));
    assert_non_null(strstr(script, "v_from = -"));
    assert_non_null(strstr(script, "y_name = ''\n"));
    room[2 * MOST] = 0.01;
    for (int k = 1; k < 3; k++) {
        room[k] = pow(10.0, k);
        room[2 * MOST + k] = 0.02 * k;
    }
    s.shown.unit = "MPa";
    script = drawn(&s, 0);
    assert_non_null(strstr(script, "v_label = 'max pressure  [10^{-2} MPa]'\n"));
    assert_non_null(strstr(script, "v_unit = 0.01\n"));
    assert_non_null(strstr(script, "x_step = 0.0\n"));
}

/* ---- Files ------------------------------------------------------------------------- */

TEST(vtk_files_are_known_by_their_names)
{
    static const char *const none[] = {"a", "a.vtk", ".", "vti", "a.vti.gz"};
    rb_report_vtk_kind kind;
    CHECK_OK(rb_report_vtk_kind_of("a.b.vti", &kind, &message));
    assert_int_equal(kind, RB_REPORT_VTI);
    CHECK_OK(rb_report_vtk_kind_of(".vtu", &kind, &message));
    assert_int_equal(kind, RB_REPORT_VTU);
    for (size_t k = 0; k < sizeof none / sizeof *none; k++) {
        CHECK_SAYS(rb_report_vtk_kind_of(none[k], &kind, &message), RB_EINVAL,
                   "expected a name ending in .vti or .vtu");
    }
}

static void solve_words(const words *w, rb_case_result *result)
{
    held_case *c = case_of(RB_CASE_SINGLE, w, NULL, 0.0);
    CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, result, &message));
}

static const words wheels = {{"contact-elements 6 outer-elements 24 support hub support-b hub "
                              "similar yes radius-b 60 load 100 solver lemke"}};
static const words planes = {
    {"contact-elements 6 support halfplane load 100 similar yes solver lemke"}};

typedef struct {
    const char *folder;
    const rb_rolling_model *model;
} dump_job;

static int files_in(const char *folder)
{
    int n = 0;
    DIR *dir = opendir(folder);
    for (const struct dirent *e; dir && (e = readdir(dir)) != NULL;)
        n += e->d_name[0] != '.';
    if (dir)
        closedir(dir);
    return n;
}

static rb_status dump(void *context)
{
    const dump_job *j = context;
    rb_message why = {.text = ""};
    FILE *lines = tmpfile();
    rb_status s = rb_report_dump(j->folder, j->model, &why);
    if (s != RB_OK)
        assert_int_equal(files_in(j->folder), 0);
    if (s == RB_OK)
        s = rb_report_trace(lines, j->folder, j->model, &why);
    if (s != RB_OK)
        assert_non_null(strstr(why.text, "out of memory"));
    fclose(lines);
    return s;
}

/* All files or none, and none of an older dump. */
TEST(matrices_are_written_all_or_none)
{
    char folder[] = "/tmp/rollbem-dump-XXXXXX", command[100];
    assert_non_null(mkdtemp(folder));
    OWNED(rb_case_result) two = {0}, flat = {0};
    solve_words(&wheels, &two);
    solve_words(&planes, &flat);
    dump_job j = {folder, &two.model};
    CHECK_OK(rb_report_dump(folder, &two.model, &message));
    assert_int_equal(files_in(folder), 12); /* two meshes, H, G; contact, F; LCP: four */
    CHECK_OK(rb_report_dump(folder, &flat.model, &message));
    assert_int_equal(files_in(folder), 6);
    assert_true(alloc_fail_every_call(dump, &j) > 10);
    CHECK_SAYS(rb_report_dump("/dev/null/d", &flat.model, &message), RB_EWRITE,
               "/dev/null/d: cannot write");
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

RUN_TESTS(NULL, NULL)
