#include "rollbem/io.h"
#include "io/tokens.h"

#include <ctype.h>
#include <limits.h>
#include <stdlib.h>

void rb_io_matrix_free(rb_io_matrix *m)
{
    free(m->dense);
    free(m->row);
    free(m->col);
    free(m->x);
    *m = (rb_io_matrix){0};
}

rb_status rb_io_matrix_to_dense(rb_io_matrix *m)
{
    if (m->dense)
        return RB_OK;
    rb_io_matrix d = {.rows = m->rows, .cols = m->cols};
    d.dense = rb_alloc((size_t)m->rows, (size_t)m->cols);
    if (!d.dense)
        return RB_ENOMEM;
    for (int k = 0; k < m->nz; k++)
        d.dense[(size_t)m->row[k] + (size_t)m->col[k] * (size_t)m->rows] += m->x[k];
    rb_io_matrix_free(m);
    *m = d;
    return RB_OK;
}

/* The nonzeros of a dense matrix, as triplets unless x is NULL; returns their number. */
static size_t nonzeros(const rb_io_matrix *m, int *row, int *col, double *x)
{
    size_t nz = 0;
    for (int j = 0; j < m->cols; j++)
        for (int i = 0; i < m->rows; i++) {
            const double value = m->dense[(size_t)i + (size_t)j * (size_t)m->rows];
            if (value == 0.0)
                continue;
            if (x) {
                row[nz] = i;
                col[nz] = j;
                x[nz] = value;
            }
            nz++;
        }
    return nz;
}

rb_status rb_io_matrix_to_sparse(const rb_io_matrix *m, rb_sparse *a)
{
    if (!m->dense)
        return rb_sparse_from_triplets(m->rows, m->cols, m->nz, m->row, m->col, m->x, a);
    const size_t nz = nonzeros(m, NULL, NULL, NULL);
    int *row = rb_alloc_int(nz), *col = rb_alloc_int(nz);
    double *x = rb_alloc(nz, 1);
    rb_status s = RB_ENOMEM;
    if (nz <= INT_MAX && row && col && x) {
        nonzeros(m, row, col, x);
        s = rb_sparse_from_triplets(m->rows, m->cols, (int)nz, row, col, x, a);
    }
    free(row);
    free(col);
    free(x);
    return s;
}

/* ---- Matrix Market ------------------------------------------------------------------
 */

static const char BANNER[] = "%%MatrixMarket matrix array real general";

rb_status rb_io_matrix_market_write(const char *path, int rows, int cols, const double *x,
                                    int ld, const char *comment, rb_message *why)
{
    if (rows < 0 || cols < 0 || ld < rows)
        return rb_fail(why, RB_EINVAL,
                       "%s: a matrix of %d by %d with leading dimension %d", path, rows,
                       cols, ld);
    rb_io_writer w;
    const rb_status s = rb_io_writer_open(path, &w, why);
    if (s != RB_OK)
        return s;
    fprintf(w.file, "%s\n", BANNER);
    if (comment)
        fprintf(w.file, "%% %s\n", comment);
    fprintf(w.file, "%d %d\n", rows, cols);
    for (int j = 0; j < cols; j++)
        for (int i = 0; i < rows; i++)
            fprintf(w.file, "%.17g\n", x[(size_t)i + (size_t)j * (size_t)ld]);
    return rb_io_writer_commit(&w, why);
}

/* The banner, in any case of letters, and the comment lines. */
static void read_head(io_tokens *t)
{
    if (t->status != RB_OK)
        return;
    const size_t length = sizeof BANNER - 1;
    int same = (size_t)(t->end - t->at) > length;
    for (size_t i = 0; same && i < length; i++)
        same = tolower((unsigned char)t->at[i]) == tolower((unsigned char)BANNER[i]);
    if (!same)
        rb_io_tokens_fail(t, "expected the line '%s'", BANNER);
    while (rb_io_tokens_more(t) && *t->at == '%')
        rb_io_tokens_skip_line(t);
}

rb_status rb_io_matrix_market_read(const char *path, rb_io_matrix *m, rb_message *why)
{
    io_tokens t;
    *m = (rb_io_matrix){0};
    rb_io_tokens_open(path, &t, why);
    read_head(&t);
    m->rows = rb_io_tokens_int(&t, 0, INT_MAX, "rows");
    m->cols = rb_io_tokens_int(&t, 0, INT_MAX, "columns");
    if (t.status == RB_OK && (m->rows == 0) != (m->cols == 0))
        rb_io_tokens_fail(&t, "a matrix of %d by %d has no entries", m->rows, m->cols);
    m->dense = rb_io_tokens_alloc(&t, (size_t)m->rows, (size_t)m->cols, "matrix");
    rb_io_tokens_reals(&t, (size_t)m->rows * (size_t)m->cols, m->dense, "matrix");
    if (t.status == RB_OK && rb_io_tokens_more(&t))
        rb_io_tokens_fail(&t, "expected the end of the file after the last number");
    if (t.status != RB_OK)
        rb_io_matrix_free(m);
    rb_io_tokens_close(&t);
    return t.status;
}
