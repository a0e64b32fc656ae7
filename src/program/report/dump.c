/* Writes the matrices of a solution to files. */
#include "program/report/internal.h"

#include "base/io/io.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct {
    const char *folder;
    rb_message *why;
} target;

/* ---- Files ------------------------------------------------------------------------- */

/* All that a dump may write: what an old one has left must not stand beside the new. */
static const char *const names[] = {"contact", "mesh",    "mesh_b", "H",         "H_b",
                                    "G",       "G_b",     "F",      "F_columns", "M",
                                    "b",       "z_scale", "w_scale"};

enum { NAMES = sizeof names / sizeof names[0] };

static char *path_of(const char *folder, const char *name)
{
    char file[40];
    snprintf(file, sizeof file, "%s.mtx", name);
    return rb_io_join(folder, file);
}

static rb_status write_matrix(const target *t, const char *name, rb_io_dense m, const char *comment)
{
    char *path = path_of(t->folder, name);
    const rb_status s = path ? rb_io_matrix_market_write(path, m, comment, t->why)
                             : rb_fail(t->why, RB_ENOMEM, "out of memory");
    free(path);
    return s;
}

static void remove_files(const char *folder)
{
    for (int k = 0; k < NAMES; k++) {
        char *path = path_of(folder, names[k]);
        if (path)
            unlink(path);
        free(path);
    }
    rb_report_remove_tableaux(folder);
}

/* ---- Bodies ------------------------------------------------------------------------ */

/* Boundary elements and influence matrices, where the body has such. */
static rb_status dump_body(const target *t, int of_b, const rb_rolling_model *model)
{
    static const char *const names_of[][3] = {{"mesh", "H", "G"}, {"mesh_b", "H_b", "G_b"}};
    static const char influence[] = "H u = G t; rows x0, y0, x1, y1, ...";
    const rb_rolling_body *body = of_b ? &model->rc->b : &model->rc->a;
    rb_bem_mesh mesh;
    rb_status s = rb_rolling_boundary_mesh(model, of_b, &mesh, t->why);
    if (s != RB_OK || mesh.n == 0) {
        rb_bem_mesh_free(&mesh);
        return s;
    }
    const int elements = mesh.n, n = 2 * elements;
    rb_arena scratch = {0};
    double *x = rb_arena_doubles(&scratch, (size_t)elements, 6),
           *H = rb_arena_doubles(&scratch, (size_t)n, (size_t)n),
           *G = rb_arena_doubles(&scratch, (size_t)n, (size_t)n);
    for (int i = 0; x && i < elements; i++) {
        const double row[] = {mesh.x0[i],
                              mesh.y0[i],
                              mesh.x1[i],
                              mesh.y1[i],
                              mesh.condition[2 * i],
                              mesh.condition[2 * i + 1]};
        for (int j = 0; j < 6; j++)
            x[i + j * elements] = row[j];
    }
    s = scratch.failed
            ? rb_fail(t->why, RB_ENOMEM, "out of memory")
            : rb_bem_assemble(&mesh, rb_rolling_material(model->rc, body), H, G, n, t->why);
    if (s == RB_OK)
        s = write_matrix(t, names_of[of_b][0], (rb_io_dense){elements, 6, x, elements},
                         "boundary elements: x0 y0 x1 y1, condition in x and y (0 traction, 1 "
                         "displacement, 2 contact)");
    if (s == RB_OK)
        s = write_matrix(t, names_of[of_b][1], (rb_io_dense){n, n, H, n}, influence);
    if (s == RB_OK)
        s = write_matrix(t, names_of[of_b][2], (rb_io_dense){n, n, G, n}, influence);
    rb_bem_mesh_free(&mesh);
    return rb_arena_done(&scratch, s);
}

static rb_status dump_all(const target *t, const rb_rolling_model *model)
{
    const rb_rolling_mesh *mesh = &model->mesh;
    const int n = mesh->n, m = n + 1;
    double *x = rb_alloc((size_t)n, 3);

    for (int i = 0; x && i < n; i++) {
        x[i] = mesh->ends[i];
        x[i + n] = mesh->ends[i + 1];
        x[i + 2 * n] = mesh->gap[i];
    }
    rb_status s = x ? write_matrix(t, "contact", (rb_io_dense){n, 3, x, n},
                                   "contact elements: from, to, initial gap")
                    : rb_fail(t->why, RB_ENOMEM, "out of memory");
    free(x);
    if (s == RB_OK)
        s = dump_body(t, 0, model);
    if (s == RB_OK)
        s = dump_body(t, 1, model);
    if (s != RB_OK)
        return s;
    if (!model->bodies.F) {
        /* Of a large contact neither F nor M has been formed.  Four columns hold all of F where
         * its blocks are constant along their diagonals, as those of half-planes are. */
        const int column[] = {0, n - 1, n, 2 * n - 1};
        const size_t rows = 2 * (size_t)m;
        rb_arena scratch = {0};
        double *w = rb_arena_doubles(&scratch, rows, 4),
               *r = rb_arena_doubles(&scratch, 2 * (size_t)n, 1);
        if (scratch.failed)
            return rb_arena_done(&scratch, rb_fail(t->why, RB_ENOMEM, "out of memory"));
        for (int k = 0; k < 4; k++) {
            r[column[k]] = 1.0;
            rb_bem_flexibility_apply(&model->bodies.f, r, w + (size_t)k * rows);
            r[column[k]] = 0.0;
        }
        s = write_matrix(t, "F_columns", (rb_io_dense){2 * m, 4, w, 2 * m},
                         rb_rolling_can(model->rc, RB_BODY_FLAT)
                             ? "columns 1, n, n + 1 and 2n of F, w = F r: its four blocks are "
                               "Toeplitz matrices"
                             : "columns 1, n, n + 1 and 2n of F, w = F r");
        return rb_arena_done(&scratch, s);
    }
    rb_contact_lcp lcp;
    s = rb_rolling_model_lcp(model, &lcp, t->why);
    if (s != RB_OK)
        return s;
    const struct {
        const char *name;
        rb_io_dense m;
        const char *comment;
    } parts[] = {{"F",
                  {2 * m, 2 * n, model->bodies.F, 2 * m},
                  "w = F r: w_N then w_T, each at the contact elements and the one upstream; r_N "
                  "then r_T"},
                 {"M", {lcp.size, lcp.size, lcp.M, lcp.size}, "scaled LCP: w = M z + b"},
                 {"b", {lcp.size, 1, lcp.b, lcp.size}, "scaled LCP: w = M z + b"},
                 {"z_scale", {lcp.size, 1, lcp.z_scale, lcp.size}, "physical z = z_scale z"},
                 {"w_scale", {lcp.size, 1, lcp.w_scale, lcp.size}, "physical w = w_scale w"}};
    for (size_t k = 0; k < sizeof parts / sizeof *parts && s == RB_OK; k++)
        s = write_matrix(t, parts[k].name, parts[k].m, parts[k].comment);
    rb_contact_lcp_free(&lcp);
    return s;
}

rb_status rb_report_dump(const char *folder, const rb_rolling_model *model, rb_message *why)
{
    struct stat before;
    const target t = {folder, why};
    const int there = stat(folder, &before) == 0;
    rb_status s = rb_io_make_folder(folder, why);
    if (s != RB_OK)
        return s;
    remove_files(folder);
    s = dump_all(&t, model);
    if (s != RB_OK) {
        remove_files(folder);
        if (!there)
            rmdir(folder);
    }
    return s;
}
