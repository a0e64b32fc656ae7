/* Lemke's pivots of a solved model, with the names of contact variables. */
#include "program/report/internal.h"

#include "base/io/io.h"
#include "lcp/lcp.h"

#include <stdlib.h>
#include <unistd.h>

typedef struct {
    FILE *out;
    const char *folder; /* NULL: no tableaux */
    const rb_contact_lcp *lcp;
    int n; /* contact elements */
    rb_status status;
    rb_message *why;
} trace;

/* ---- Pivots ------------------------------------------------------------------------ */

static char *path_of(const char *folder, const char *format, int k)
{
    char name[40];
    snprintf(name, sizeof name, format, k);
    return rb_io_join(folder, name);
}

static const char tableau_name[] = "tableau_%d.mtx", basis_name[] = "basis_%d.txt";

void rb_report_remove_tableaux(const char *folder)
{
    int removed = 1;
    for (int k = 1; removed; k++) {
        char *tableau = path_of(folder, tableau_name, k), *basis = path_of(folder, basis_name, k);
        removed = tableau && unlink(tableau) == 0;
        removed |= basis && unlink(basis) == 0;
        free(tableau);
        free(basis);
    }
}

static void write_variables(FILE *file, const trace *t, const char *what, const int *variable,
                            int n)
{
    char name[RB_CONTACT_VARIABLE];
    fprintf(file, "%s", what);
    for (int i = 0; i < n; i++) {
        rb_contact_lcp_variable(t->lcp, t->n, variable[i], name);
        fprintf(file, " %s", name);
    }
    fputc('\n', file);
}

static void each_pivot(const rb_lcp_pivot *p, void *context)
{
    trace *t = context;
    char entering[RB_CONTACT_VARIABLE], leaving[RB_CONTACT_VARIABLE];
    rb_contact_lcp_variable(t->lcp, t->n, p->entering, entering);
    rb_contact_lcp_variable(t->lcp, t->n, p->leaving, leaving);
    fprintf(t->out, "pivot %4d  row %4d  %-12s enters  %-12s leaves  step %-12.5g z0 %.5g\n",
            p->pivot + 1, p->row + 1, entering, leaving, p->ratio, p->z0);
    if (t->folder && t->status == RB_OK) {
        char *path = path_of(t->folder, tableau_name, p->pivot + 1);
        t->status = path ? rb_io_matrix_market_write(
                               path, (rb_io_dense){p->n, p->n + 2, p->tableau, p->n},
                               "basic = last column + columns times nonbasic; their names: "
                               "basis_*.txt",
                               t->why)
                         : rb_fail(t->why, RB_ENOMEM, "out of memory");
        free(path);
    }
    if (t->folder && t->status == RB_OK) {
        /* Which variables the rows and columns of each tableau are. */
        rb_io_writer w;
        char *path = path_of(t->folder, basis_name, p->pivot + 1);
        t->status = path ? rb_io_writer_open(path, &w, t->why)
                         : rb_fail(t->why, RB_ENOMEM, "out of memory");
        free(path);
        if (t->status == RB_OK) {
            write_variables(w.file, t, "rows", p->basis, p->n);
            write_variables(w.file, t, "columns", p->nonbasis, p->n + 1);
            t->status = rb_io_writer_commit(&w, t->why);
        }
    }
}

rb_status rb_report_trace(FILE *out, const char *folder, const rb_rolling_model *model,
                          rb_message *why)
{
    rb_contact_lcp lcp;
    rb_status s = rb_rolling_model_lcp(model, &lcp, why);
    if (s != RB_OK)
        return s;
    if (model->state.solver != RB_SOLVER_LEMKE)
        fputs("the case was solved by another method; Lemke's on the same problem:\n", out);
    trace t = {.out = out, .folder = folder, .lcp = &lcp, .n = model->mesh.n, .why = why};
    const rb_lcp_problem p = {lcp.size, lcp.M, lcp.size, lcp.b};
    rb_lcp_options options = rb_lcp_defaults();
    rb_lcp_info info;
    options.trace = each_pivot;
    options.trace_context = &t;
    options.trace_tableau = folder != NULL;
    double *z = rb_alloc((size_t)lcp.size, 1);
    s = z ? rb_lcp_lemke(&p, &options, z, &info) : RB_ENOMEM;
    if (s < 0)
        rb_fail(why, s, "%s", z ? info.msg.text : "out of memory");
    else {
        if (s != RB_OK)
            fprintf(out, "Lemke's method ends here without a solution: %s\n", rb_status_text(s));
        s = t.status;
    }
    free(z);
    if (s != RB_OK && folder)
        rb_report_remove_tableaux(folder);
    rb_contact_lcp_free(&lcp);
    return s;
}
