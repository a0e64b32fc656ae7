/* Files of problems: Siconos' text, Matrix Market, plain text, FCLib, CONTACT's input. */
#include "fuzz.h"
#include "base/io/io.h"
#include "base/io/io_contact.h"
#include "lcp/friction/friction.h"
#include "rollbem/sparse.h"
#include "rolling/case/case.h"

#include <math.h>
#include <stdlib.h>

static const char file[] = "input";

static void require_finite(const double *x, int n, const char *property)
{
    for (int k = 0; k < n; k++)
        fuzz_require(isfinite(x[k]), property);
}

static void require_matrix(rb_io_matrix *m)
{
    rb_sparse a = {0};
    const rb_triplets *t = &m->entries;
    fuzz_require((m->rows > 0) == (m->cols > 0), "a matrix has rows and columns, or none");
    for (int k = 0; !m->dense && k < t->nz; k++)
        fuzz_require(t->row[k] >= 0 && t->row[k] < m->rows && t->col[k] >= 0 && t->col[k] < m->cols,
                     "entries lie in the matrix");
    /* a few numbers may name the size of a matrix that has no room as a dense one */
    if ((double)m->rows * m->cols > 1e6)
        return;
    fuzz_require(rb_io_matrix_to_sparse(m, &a) == RB_OK, "a matrix becomes sparse");
    rb_sparse_free(&a);
    fuzz_require(rb_io_matrix_to_dense(m) == RB_OK, "a matrix becomes dense");
}

static void read_friction(rb_friction_file kind)
{
    rb_friction_problem p = {0};
    rb_message why = {.text = ""}, again = {.text = ""};
    const rb_status s = rb_friction_read_as(file, kind, &p, &why);
    fuzz_require_reason(s, &why);
    if (s == RB_OK && p.contacts > 0)
        fuzz_require(rb_friction_problem_check(&p, &again) == RB_OK,
                     "a problem that is read is a problem");
    rb_friction_problem_free(&p);
}

void fuzz_siconos(const uint8_t *data, size_t size)
{
    rb_io_lcp lcp;
    rb_message why = {.text = ""};
    fuzz_keep(file, data, size);
    const rb_status s = rb_io_siconos_read_lcp(file, &lcp, &why);
    fuzz_require_reason(s, &why);
    if (s == RB_OK) {
        require_matrix(&lcp.M);
        require_finite(lcp.q, lcp.n, "q is finite");
    }
    rb_io_lcp_free(&lcp);
    for (rb_friction_file kind = RB_FRICTION_FILE_SICONOS; kind <= RB_FRICTION_FILE_SICONOS_GLOBAL;
         kind++)
        if (kind != RB_FRICTION_FILE_SICONOS_SOCLCP)
            read_friction(kind);
    rb_friction_soclcp_data cones = {0};
    rb_message other = {.text = ""};
    fuzz_require_reason(rb_friction_soclcp_read(file, &cones, &other), &other);
    rb_friction_soclcp_data_free(&cones);
    rb_io_siconos_kind guess;
    rb_message third = {.text = ""};
    fuzz_require_reason(rb_io_siconos_guess(file, &guess, &third), &third);
}

void fuzz_matrix_market(const uint8_t *data, size_t size)
{
    rb_io_matrix m;
    rb_message why = {.text = ""};
    fuzz_keep(file, data, size);
    const rb_status s = rb_io_matrix_market_read(file, &m, &why);
    fuzz_require_reason(s, &why);
    if (s == RB_OK) {
        require_matrix(&m);
        if (m.dense)
            require_finite(m.dense, m.rows * m.cols, "a matrix is finite");
    }
    rb_io_matrix_free(&m);
}

void fuzz_lcp_text(const uint8_t *data, size_t size)
{
    rb_io_lcp p;
    rb_io_bimatrix game;
    double *x = NULL;
    rb_message why = {.text = ""}, of_game = {.text = ""}, of_bounds = {.text = ""},
               of_both = {.text = ""};
    fuzz_keep(file, data, size);
    rb_status s = rb_io_lcp_read(file, NULL, &p, &why);
    fuzz_require_reason(s, &why);
    if (s == RB_OK) {
        require_matrix(&p.M);
        require_finite(p.q, p.n, "q is finite");
    }
    rb_io_lcp_free(&p);
    fuzz_require_reason(rb_io_lcp_read(file, file, &p, &of_both), &of_both);
    rb_io_lcp_free(&p);
    s = rb_io_bimatrix_read(file, &game, &of_game);
    fuzz_require_reason(s, &of_game);
    if (s == RB_OK)
        require_finite(game.A, game.m * game.n, "payoffs are finite");
    rb_io_bimatrix_free(&game);
    s = rb_io_bounds_read(file, 3, "bounds", &x, &of_bounds);
    fuzz_require_reason(s, &of_bounds);
    fuzz_require((s == RB_OK) == (x != NULL), "bounds are there or refused");
    free(x);
}

void fuzz_fclib(const uint8_t *data, size_t size)
{
    static const char head[] = {(char)0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    fuzz_write(file, data, size);
    if (size >= sizeof head) /* what is no HDF5 is refused at once */
        read_friction(RB_FRICTION_FILE_FCLIB);
    read_friction(RB_FRICTION_FILE_ANY);
}

void fuzz_contact(const uint8_t *data, size_t size)
{
    rb_io_contact_case *cases = NULL;
    int n = 0;
    rb_message why = {.text = ""};
    fuzz_keep(file, data, size);
    const rb_status s = rb_io_contact_read(file, &n, &cases, &why);
    fuzz_require_reason(s, &why);
    for (int k = 0; s == RB_OK && k < n; k++) {
        rb_case_contact c;
        rb_case_from_contact(&cases[k], &c);
        fuzz_require(c.runs || c.left_out[0], "a case that is left out says why");
        fuzz_require(!c.runs || (isfinite(c.from) && c.from < c.to),
                     "a case that runs has elements");
    }
    free(cases);
}
