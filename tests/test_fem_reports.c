/* Pictures and JSON of the finite-element examples: what gnuplot would read of a small
 * wall, bar and truss, against their meshes, displacements and steps. */
#include "check.h"
#include "fem/pictures.h"
#include "small_wall.h"

#include <ctype.h>
#include <unistd.h>

static const rb_report_canvas page = {.kind = RB_REPORT_SVG, .script = 1};
static const rb_report_canvas one_column = {
    .kind = RB_REPORT_SVG, .size = RB_REPORT_85MM, .script = 1};

/* ---- Scripts ----------------------------------------------------------------------- */

/* What was written, in static storage. */
static const char *written(FILE *file)
{
    static char text[400000];
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void check_says(const char *script, const char *part)
{
    if (!strstr(script, part))
        fail_msg("the script has no '%s'", part);
}

/* The numbers of a block of data, `columns` in a line; how many lines. */
static int block(const char *script, const char *name, int columns, int most, double *x)
{
    char begin[40];
    int rows = 0;
    snprintf(begin, sizeof begin, "$%s << EOD\n", name);
    const char *s = strstr(script, begin);
    if (!s)
        fail_msg("no block of data $%s", name);
    for (s += strlen(begin); strncmp(s, "EOD", 3) != 0; s += strcspn(s, "\n") + 1) {
        if (*s == '\n' || isalpha((unsigned char)*s)) /* rows apart, headings */
            continue;
        assert_true(rows < most);
        char *end = (char *)s;
        for (int k = 0; k < columns; k++)
            x[columns * rows + k] = strtod(end, &end);
        assert_int_equal(end[strspn(end, " ")], '\n');
        rows++;
    }
    return rows;
}

/* The number that the template reads by this name. */
static double number_of(const char *script, const char *name)
{
    char begin[40];
    snprintf(begin, sizeof begin, "\n%s = ", name);
    return strtod(NOT_NULL(strstr(script, begin)) + strlen(begin), NULL);
}

/* Is the closed or open line of so many points of [m] among those drawn? */
static int is_drawn(const double *line, int points, const double *drawn, int rows)
{
    for (int k = 0; k + points <= rows; k += points) {
        double off = 0.0;
        for (int i = 0; i < 2 * points; i++)
            off = fmax(off, fabs(drawn[2 * k + i] - line[i]));
        if (off < 1e-5)
            return 1;
    }
    return 0;
}

/* ---- The wall ---------------------------------------------------------------------- */

enum { PRESS = 2, SHEAR = 2, STEPS = 1 + PRESS + SHEAR, POINTS = 2000 };

typedef struct {
    rb_fem_wall_options options;
    rb_fem_wall *wall;
    rb_fem_wall_step step[STEPS];
    double *u;
} solved_wall;

static solved_wall walls[2]; /* elastic, of rigid blocks (under its weight alone) */

static int solve_walls(void **state)
{
    for (int rigid = 0; rigid < 2; rigid++) {
        solved_wall *w = &walls[rigid];
        w->options = small_wall(rigid);
        w->options.press = PRESS;
        w->options.shear = SHEAR;
        if (rb_fem_wall_create(&w->options, &w->wall, NULL) != RB_OK)
            return -1;
        for (int k = 0; k < (rigid ? 1 : STEPS); k++)
            if (rb_fem_wall_advance(w->wall, "nsn-ac", 1e-9, &w->step[k], NULL) != RB_OK)
                return -1;
        w->u = rb_alloc(3, (size_t)rb_fem_wall_mesh(w->wall)->nodes);
        if (!w->u || rb_fem_wall_displacements(w->wall, w->u) != RB_OK)
            return -1;
    }
    return 0;
}

static int free_walls(void **state)
{
    for (int k = 0; k < 2; k++) {
        free(walls[k].u);
        rb_fem_wall_free(walls[k].wall);
    }
    return 0;
}

static const char *draw_wall(const solved_wall *w, rb_report_canvas canvas, int steps)
{
    FILE *out = tmpfile();
    CHECK_OK(rb_fem_picture_wall(out, canvas, w->wall, steps, w->step, &message));
    return written(out);
}

/* The longest displacement in the plane of the front is drawn as at most 0.12 of the
 * height of 0.5 m, by a factor of 1, 2 or 5 times a power of ten. */
static double factor_of(const solved_wall *w)
{
    double longest = 0.0, factor = 1e-3;
    for (int a = 0; a < rb_fem_wall_mesh(w->wall)->nodes; a++)
        longest = fmax(longest, hypot(w->u[3 * a], w->u[3 * a + 2]));
    for (int k = 0; factor * (k % 3 == 1 ? 2.5 : 2.0) * longest <= 0.12 * 0.5; k++)
        factor *= k % 3 == 1 ? 2.5 : 2.0;
    return factor;
}

static void place(const solved_wall *w, double factor, int node, double at[2])
{
    const double *x = rb_fem_wall_mesh(w->wall)->x + 3 * node;
    at[0] = x[0] + factor * w->u[3 * node];
    at[1] = x[2] + factor * w->u[3 * node + 2];
}

/* How many bricks have both nodes: an edge of the front is on a block's outline where
 * two of its bricks do not share it. */
static int bricks_with(const rb_fem_mesh *mesh, int one, int other)
{
    int bricks = 0;
    for (int e = 0; e < mesh->elements; e++) {
        int found = 0;
        for (int k = 0; k < 8; k++)
            found += mesh->node[8 * e + k] == one || mesh->node[8 * e + k] == other;
        bricks += found == 2;
    }
    return bricks;
}

/* Every face of the front, displaced, and the outline of every block. */
TEST(front_of_the_wall_is_drawn)
{
    static double mesh[2 * POINTS], edge[2 * POINTS];
    static const int corner[] = {0, 1, 5, 4, 0}; /* of the front, around it */
    const solved_wall *w = &walls[0];
    const rb_fem_mesh *bricks = rb_fem_wall_mesh(w->wall);
    const char *script = draw_wall(w, page, STEPS);
    const int points = block(script, "mesh", 2, POINTS, mesh);
    const int ends = block(script, "edge", 2, POINTS, edge);
    const double factor = factor_of(w);
    int faces = 0, edges = 0;
    for (int e = 0; e < bricks->elements; e++) {
        const int *node = bricks->node + 8 * e;
        double face[10];
        if (bricks->x[3 * node[0] + 1] != 0.0)
            continue;
        faces++;
        for (int c = 0; c < 5; c++)
            place(w, factor, node[corner[c]], face + 2 * c);
        if (!is_drawn(face, 5, mesh, points))
            fail_msg("the face of brick %d is not drawn", e);
        for (int c = 0; c < 4; c++) {
            const int outer = bricks_with(bricks, node[corner[c]], node[corner[c + 1]]) == 1;
            edges += outer;
            assert_int_equal(is_drawn(face + 2 * c, 2, edge, ends), outer);
        }
    }
    assert_int_equal(points, 5 * faces);
    assert_int_equal(ends, 2 * edges);
    char magnify[40];
    snprintf(magnify, sizeof magnify, "\nmagnify = '%g'\n", factor);
    check_says(script, magnify);
    CHECK_REL(number_of(script, "drift"), 1e3 * w->step[STEPS - 1].drift, 1e-12, "drift");
    CHECK_REL(number_of(script, "compression"), 30.0, 1e-9, "compression");
    CHECK_ABS(number_of(script, "width"), 0.4, 0.0, "width");
    CHECK_ABS(number_of(script, "height"), 0.5, 0.0, "height");
}

/* Blocks that have not moved are drawn as they are. */
TEST(wall_at_rest_is_not_magnified)
{
    static double mesh[2 * POINTS];
    solved_wall still = walls[0];
    double right = 0.0, top = 0.0;
    CHECK_OK(rb_fem_wall_create(&still.options, &still.wall, NULL));
    const char *script = draw_wall(&still, page, 1);
    check_says(script, "\nmagnify = '1'\n");
    const int points = block(script, "mesh", 2, POINTS, mesh);
    for (int k = 0; k < points; k++) {
        right = fmax(right, mesh[2 * k]);
        top = fmax(top, mesh[2 * k + 1]);
    }
    CHECK_ABS(right, 0.4, 0.0, "width");
    CHECK_ABS(top, 0.5, 0.0, "height");
    rb_fem_wall_free(still.wall);
}

TEST(steps_of_the_wall_are_drawn)
{
    const solved_wall *w = &walls[0];
    for (int steps = 1; steps <= STEPS; steps += STEPS - 1) {
        double x[6 * STEPS];
        const char *script = draw_wall(w, page, steps);
        assert_int_equal(block(script, "table", 6, STEPS, x), steps);
        for (int k = 0; k < steps; k++) {
            const rb_fem_wall_step *s = &w->step[k];
            const double want[6] = {s->time, 1e-3 * s->compression, 1e-3 * s->shear, s->stick,
                                    s->slip, s->separated};
            for (int c = 0; c < 6; c++)
                CHECK_REL(x[6 * k + c], want[c], 1e-5, "step %d, column %d", k, c);
        }
    }
}

/* Panels side by side; in a column of print one below the other, without a title: as gnuplot
 * computes them. */
TEST(panels_lie_beside_or_below_each_other)
{
    const solved_wall *w = &walls[0];
    if (system("command -v gnuplot >/dev/null") != 0)
        skip();
    for (int column = 0; column < 2; column++) {
        char name[] = "/tmp/rollbem-panels-XXXXXX", line[200];
        const char *script = draw_wall(w, column ? one_column : page, STEPS);
        double at[3][4]; /* left, right, bottom, top */
        const int fd = mkstemp(name);
        FILE *file = NOT_NULL(fdopen(fd, "w"));
        fprintf(file, "%s\ndo for [k=0:2] { print open_panel(k) }\n", script);
        fclose(file);
        snprintf(line, sizeof line, "gnuplot -d %s 2>&1 >/dev/null", name);
        FILE *said = NOT_NULL(popen(line, "r"));
        for (int k = 0; k < 3; k++)
            assert_int_equal(fscanf(said,
                                    " set lmargin at screen %lf; set rmargin at screen %lf; set "
                                    "bmargin at screen %lf; set tmargin at screen %lf",
                                    &at[k][0], &at[k][1], &at[k][2], &at[k][3]),
                             4);
        assert_int_equal(pclose(said), 0);
        remove(name);
        for (int k = 0; k < 3; k++) {
            assert_true(0.05 < at[k][0] && at[k][0] + 0.3 < at[k][1] && at[k][1] < 0.98);
            assert_true(0.05 < at[k][2] && at[k][2] + 0.13 < at[k][3] && at[k][3] < 0.95);
        }
        for (int k = 1; k < 3; k++) /* room for the ticks between them */
            if (column || k == 2)
                assert_true(at[k][3] + 0.02 < at[k - 1][2]);
            else
                assert_true(at[0][1] + 0.1 < at[k][0] && at[2][0] == at[1][0]);
        CHECK_ABS(number_of(script, "titled"), !column, 0.0, "title");
        CHECK_ABS(number_of(script, "points_step"), 50.0, 0.0, "of 161");
    }
}

TEST(wall_needs_steps_and_memory)
{
    rb_message why = {.text = ""};
    FILE *out = tmpfile();
    CHECK_STATUS(rb_fem_picture_wall(out, page, walls[0].wall, 0, walls[0].step, &why), RB_EINVAL);
    assert_string_equal(why.text, "nothing to draw");
    for (int k = 0; k < 2; k++) {
        alloc_fail_after(k);
        const rb_status s = rb_fem_picture_wall(out, page, walls[k].wall, 1, walls[k].step, &why);
        alloc_succeed();
        CHECK_STATUS(s, RB_ENOMEM);
        assert_string_equal(why.text, "out of memory");
    }
    assert_int_equal(ftell(out), 0);
    fclose(out);
}

/* ---- Bar and truss ----------------------------------------------------------------- */

TEST(bar_and_truss_need_steps)
{
    const rb_fem_model model = {0};
    const rb_fem_history history = {0};
    rb_message why[2] = {{.text = ""}, {.text = ""}};
    FILE *out = tmpfile();
    CHECK_STATUS(rb_fem_picture_bar(out, page, &model, &history, &why[0]), RB_EINVAL);
    CHECK_STATUS(rb_fem_picture_truss(out, page, &model, &history, &why[1]), RB_EINVAL);
    for (int k = 0; k < 2; k++)
        assert_string_equal(why[k].text, "nothing to draw");
    assert_int_equal(ftell(out), 0);
    fclose(out);
}

/* A quarter of the truss: every node of it once in each panel, with its vector where it
 * slips, and at the end where it has moved, if only along one axis. */
TEST(truss_is_drawn_by_its_slips)
{
    enum { NODES = 4, QUARTER = 4 };
    static const char *const names[] = {"upper nodes inside", "upper nodes overhanging"};
    for (int layout = 0; layout < 2; layout++) {
        OWNED(rb_fem_model) model;
        OWNED(rb_fem_history) history;
        CHECK_OK(rb_fem_model_truss((rb_fem_layout)layout, NODES, &model, NULL));
        CHECK_OK(rb_fem_run(&model, "nsn-ac", 1e-9, &history, NULL));
        rb_fem_step *last = &history.step[history.steps - 1];
        for (int i = 0, k = 0; i < model.structure.contacts; i++)
            if (model.mesh.x[3 * i] >= 0.0 && model.mesh.x[3 * i + 1] >= 0.0) {
                last->u[3 * i] = k == 1 ? 2.0 : 0.0; /* [mm] */
                last->u[3 * i + 1] = k == 2 ? -3.0 : 0.0;
                k++;
            }
        FILE *out = tmpfile();
        CHECK_OK(rb_fem_picture_truss(out, page, &model, &history, &message));
        const char *script = written(out);
        check_says(script, names[layout]);
        assert_null(strstr(script, names[1 - layout]));
        double node[6 * 7 * QUARTER]; /* panel, x, y, vector, whether it moves */
        const int nodes = block(script, "table", 6, 7 * QUARTER, node);
        for (int panel = 0; panel <= history.steps; panel++) {
            const rb_fem_step *step = &history.step[panel];
            const double *move = NULL, *first = NULL;
            int slipping = 0, moves = 0, rests = 0;
            for (int k = 0; k < nodes; k++)
                if (node[6 * k] == panel && node[6 * k + 5] != 0.0) {
                    move = node + 6 * k;
                    first = moves++ ? first : move;
                } else
                    rests += node[6 * k] == panel;
            assert_int_equal(moves + rests, QUARTER);
            for (int i = 0; i < model.structure.contacts && step <= last; i++)
                slipping += model.mesh.x[3 * i] >= 0.0 && model.mesh.x[3 * i + 1] >= 0.0 &&
                            step->contact[i] == RB_FEM_SLIP;
            assert_int_equal(moves, panel < history.steps ? slipping : 2);
            if (panel == history.steps) { /* the longest is at most 1.1 cells of 2 m */
                const double scale = first[3] / 2e-3;
                CHECK_REL(move[4], -3e-3 * scale, 1e-8, "vector");
                assert_true(3e-3 * scale <= 2.2 && 3e-3 * scale > 0.8);
            }
        }
    }
}

RUN_TESTS(solve_walls, free_walls)
