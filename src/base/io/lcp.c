/* Linear complementarity problems and vectors: the kind of file is told by its content. */
#include "base/io/readers.h"

#include <ctype.h>
#include <limits.h>
#include <stdlib.h>
#include <strings.h>

static int is_market(const io_tokens *t)
{
    static const char banner[] = "%%MatrixMarket";
    return t->text && !strncasecmp(t->text, banner, sizeof banner - 1);
}

/* Words of the text, which stays at its beginning. */
static size_t count_words(io_tokens *t)
{
    size_t count = 0;
    for (; rb_io_tokens_more(t); count++)
        while (t->at < t->end && !isspace((unsigned char)*t->at))
            t->at++;
    rb_io_tokens_rewind(t);
    return count;
}

/* ---- Vectors ---------------------------------------------------------------------- */

static rb_status read_vector(const char *path, int n, const char *what, int infinite, double **x,
                             rb_message *why)
{
    io_tokens t;
    *x = NULL;
    rb_io_tokens_open(path, &t, why);
    t.infinite = infinite;
    if (is_market(&t)) {
        rb_io_matrix m;
        rb_io_read_matrix_market(&t, &m);
        if (t.status == RB_OK && (m.rows != n || m.cols != 1))
            rb_io_tokens_fail(&t, "%s: expected a matrix of %d by 1, got %d by %d", what, n, m.rows,
                              m.cols);
        if (t.status == RB_OK && rb_io_matrix_to_dense(&m) != RB_OK)
            t.status = rb_fail(t.why, RB_ENOMEM, "%s: out of memory for %s", t.path, what);
        if (t.status == RB_OK) {
            *x = m.dense;
            m.dense = NULL;
        }
        rb_io_matrix_free(&m);
    } else if (t.status == RB_OK) {
        rb_io_tokens_blank_comments(&t);
        const size_t count = count_words(&t);
        if (count != (size_t)n)
            rb_io_tokens_fail(&t, "%s: expected %d number%s, got %zu", what, n, rb_plural(n),
                              count);
        *x = rb_io_tokens_alloc(&t, (size_t)n, 1, what);
        rb_io_tokens_reals(&t, (size_t)n, *x, what);
    }
    if (t.status != RB_OK) {
        free(*x);
        *x = NULL;
    }
    rb_io_tokens_close(&t);
    return t.status;
}

rb_status rb_io_vector_read(const char *path, int n, const char *what, double **x, rb_message *why)
{
    return read_vector(path, n, what, 0, x, why);
}

rb_status rb_io_bounds_read(const char *path, int n, const char *what, double **x, rb_message *why)
{
    return read_vector(path, n, what, 1, x, why);
}

/* ---- Problems ---------------------------------------------------------------------- */

/* A matrix row by row; column-major, NULL after a failure. */
static double *read_rows(io_tokens *t, int m, int n, const char *name)
{
    double *row = rb_io_tokens_alloc(t, (size_t)n, 1, name);
    double *x = rb_io_tokens_alloc(t, (size_t)m, (size_t)n, name);
    for (int i = 0; t->status == RB_OK && i < m; i++) {
        char what[40];
        snprintf(what, sizeof what, "%s, row %d", name, i + 1);
        rb_io_tokens_reals(t, (size_t)n, row, what);
        for (int j = 0; j < n; j++)
            x[(size_t)i + (size_t)j * (size_t)m] = row[j];
    }
    free(row);
    return x;
}

/* 1 + n + n^2 words, or n on a line of its own and the first row of M on another. */
static int looks_plain(io_tokens *t)
{
    const size_t words = count_words(t);
    int line[3] = {0};
    const int n = rb_io_tokens_int(t, 1, 1 << 30, "n");
    line[0] = t->line;
    for (int k = 1; k < 3; k++) {
        rb_io_tokens_real(t, "M");
        line[k] = t->line;
    }
    const int fits = n > 0 && words == 1 + (size_t)n * ((size_t)n + 1);
    const int rows = t->status == RB_OK && line[0] < line[1] && line[1] == line[2];
    rb_io_tokens_rewind(t);
    return fits || rows;
}

/* The sizes at the head of a Siconos file could be the first entries of a plain one.  A
 * plain file is shorter than any dense one of Siconos with that head, and is taken for
 * one by blocks only if every block is in its place. */
static void read_text(io_tokens *t, rb_io_lcp *p)
{
    rb_io_tokens_blank_comments(t);
    const int plain = looks_plain(t), kind = rb_io_siconos_kind_at(t);
    rb_io_tokens_rewind(t);
    if (kind == RB_IO_SICONOS_LCP) {
        rb_io_read_siconos_lcp(t, p);
        if (t->status != RB_EFORMAT || !plain)
            return;
        rb_io_tokens_rewind(t);
    } else if (kind >= 0 && !plain) {
        rb_io_tokens_fail(t, "a %s of Siconos, expected an LCP",
                          kind == RB_IO_SICONOS_SOCLCP    ? "SOCLCP"
                          : kind == RB_IO_SICONOS_MIXED   ? "mixed LCP (MLCP)"
                          : kind == RB_IO_SICONOS_ROLLING ? "problem of rolling friction"
                                                          : "friction problem");
        return;
    }
    /* n, the rows of M, q; an empty problem is 0 alone. */
    const int n = p->n = rb_io_tokens_int(t, 0, INT_MAX, "n");
    if (t->status == RB_OK && n == 0) {
        if (rb_io_tokens_more(t))
            rb_io_tokens_fail(t, "expected the end of the file after n = 0");
        return;
    }
    p->M.rows = p->M.cols = n;
    p->M.dense = read_rows(t, n, n, "M");
    p->q = rb_io_tokens_alloc(t, (size_t)n, 1, "q");
    rb_io_tokens_reals(t, (size_t)n, p->q, "q");
    if (t->status == RB_OK && rb_io_tokens_more(t))
        rb_io_tokens_fail(t, "expected the end of the file after n, n rows of M and q (n = %d)", n);
}

rb_status rb_io_lcp_read(const char *path, const char *q_path, rb_io_lcp *p, rb_message *why)
{
    io_tokens t;
    *p = (rb_io_lcp){0};
    rb_io_tokens_open(path, &t, why);
    if (is_market(&t)) {
        if (!q_path) {
            rb_io_tokens_fail(
                &t, "a Matrix Market file holds M alone: q is wanted from a file of its own (--q)");
        } else {
            rb_io_read_matrix_market(&t, &p->M);
            if (t.status == RB_OK && p->M.rows != p->M.cols)
                rb_io_tokens_fail(&t, "M: expected a square matrix, got %d by %d", p->M.rows,
                                  p->M.cols);
            p->n = p->M.rows;
            if (t.status == RB_OK)
                t.status = rb_io_vector_read(q_path, p->n, "q", &p->q, t.why);
        }
    } else if (t.status == RB_OK && q_path)
        rb_io_tokens_fail(&t, "this file holds q itself: only Matrix Market files do not");
    else if (t.status == RB_OK)
        read_text(&t, p);
    if (t.status != RB_OK)
        rb_io_lcp_free(p);
    rb_io_tokens_close(&t);
    return t.status;
}

/* ---- Games ------------------------------------------------------------------------- */

void rb_io_bimatrix_free(rb_io_bimatrix *p)
{
    free(p->A);
    free(p->B);
    *p = (rb_io_bimatrix){0};
}

rb_status rb_io_bimatrix_read(const char *path, rb_io_bimatrix *p, rb_message *why)
{
    io_tokens t;
    *p = (rb_io_bimatrix){0};
    rb_io_tokens_open(path, &t, why);
    rb_io_tokens_blank_comments(&t);
    p->m = rb_io_tokens_int(&t, 1, INT_MAX, "m");
    p->n = rb_io_tokens_int(&t, 1, INT_MAX, "n");
    p->A = read_rows(&t, p->m, p->n, "A");
    p->B = read_rows(&t, p->m, p->n, "B");
    if (t.status == RB_OK && rb_io_tokens_more(&t))
        rb_io_tokens_fail(&t, "expected the end of the file after m, n, A and B (%d by %d)", p->m,
                          p->n);
    if (t.status != RB_OK)
        rb_io_bimatrix_free(p);
    rb_io_tokens_close(&t);
    return t.status;
}
