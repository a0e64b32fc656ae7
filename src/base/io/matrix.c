/* Matrices in files: Matrix Market, dense and sparse. */
#include "base/io/io.h"
#include "base/io/readers.h"

#include <limits.h>
#include <stdlib.h>

void rb_io_matrix_free(rb_io_matrix *m)
{
    free(m->dense);
    rb_triplets_free(&m->entries);
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
    const rb_triplets *t = &m->entries;
    for (int k = 0; k < t->nz; k++)
        d.dense[(size_t)t->row[k] + (size_t)t->col[k] * (size_t)m->rows] += t->x[k];
    rb_io_matrix_free(m);
    *m = d;
    return RB_OK;
}

rb_status rb_io_matrix_to_sparse(const rb_io_matrix *m, rb_sparse *a)
{
    return m->dense ? rb_sparse_from_dense(m->rows, m->cols, m->dense, m->rows, a)
                    : rb_sparse_from_triplets(&m->entries, a);
}

/* ---- Matrix Market ----------------------------------------------------------------- */

static const char BANNER[] = "%%MatrixMarket matrix array real general";

rb_status rb_io_matrix_market_write(const char *path, rb_io_dense m, const char *comment,
                                    rb_message *why)
{
    if (m.rows < 0 || m.cols < 0 || m.ld < m.rows)
        return rb_fail(why, RB_EINVAL, "%s: a matrix of %d by %d with leading dimension %d", path,
                       m.rows, m.cols, m.ld);
    rb_io_writer w;
    const rb_status s = rb_io_writer_open(path, &w, why);
    if (s != RB_OK)
        return s;
    void *before = rb_locale_begin();
    fprintf(w.file, "%s\n", BANNER);
    if (comment)
        fprintf(w.file, "%% %s\n", comment);
    fprintf(w.file, "%d %d\n", m.rows, m.cols);
    for (int j = 0; j < m.cols; j++)
        for (int i = 0; i < m.rows; i++)
            fprintf(w.file, "%.17g\n", m.x[(size_t)i + (size_t)j * (size_t)m.ld]);
    rb_locale_end(before);
    return rb_io_writer_commit(&w, why);
}

/* Files that hold real matrices: "row column value" lines (coordinate), or all entries column
 * by column (array); of symmetric ones the lower triangle alone is written, of skew-symmetric
 * ones without the diagonal, which is 0. */
void rb_io_read_matrix_market(io_tokens *t, rb_io_matrix *m)
{
    *m = (rb_io_matrix){0};
    /* The banner and the comment lines. */
    int known = rb_io_tokens_take(t, "%%MatrixMarket") && rb_io_tokens_take(t, "matrix");
    const int coordinate = rb_io_tokens_take(t, "coordinate");
    known = known && (coordinate || rb_io_tokens_take(t, "array")) &&
            (rb_io_tokens_take(t, "real") || rb_io_tokens_take(t, "integer"));
    const int skew = rb_io_tokens_take(t, "skew-symmetric"),
              symmetric = skew || rb_io_tokens_take(t, "symmetric");
    if (!known || !(symmetric || rb_io_tokens_take(t, "general")))
        rb_io_tokens_fail(t, "expected the line '%%%%MatrixMarket matrix array|coordinate "
                             "real|integer general|symmetric|skew-symmetric'");
    while (rb_io_tokens_more(t) && *t->at == '%')
        rb_io_tokens_skip_line(t);
    m->rows = rb_io_tokens_int(t, 0, INT_MAX, "rows");
    m->cols = rb_io_tokens_int(t, 0, INT_MAX, "columns");
    if (t->status == RB_OK && (m->rows == 0) != (m->cols == 0))
        rb_io_tokens_fail(t, "a matrix of %d by %d has no entries", m->rows, m->cols);
    if (t->status == RB_OK && symmetric && m->rows != m->cols)
        rb_io_tokens_fail(t, "a symmetric matrix of %d by %d", m->rows, m->cols);
    const size_t rows = (size_t)m->rows, cols = (size_t)m->cols;
    if (coordinate) {
        const int most = symmetric ? INT_MAX / 2 : INT_MAX;
        const int count = rb_io_tokens_int(t, 0, most, "number of entries");
        m->entries = (rb_triplets){.rows = m->rows, .cols = m->cols};
        if (rb_io_tokens_room_for(t, (size_t)count, 3, "entries") &&
            rb_triplets_reserve(&m->entries, (size_t)count << symmetric) != RB_OK)
            t->status = rb_fail(t->why, RB_ENOMEM, "%s: out of memory for matrix", t->path);
        for (int k = 0; t->status == RB_OK && k < count; k++) {
            const int i = rb_io_tokens_int(t, 1, m->rows, "row") - 1;
            const int j = rb_io_tokens_int(t, 1, m->cols, "column") - 1;
            const double x = rb_io_tokens_real(t, "value");
            if (t->status == RB_OK && skew && i == j && x != 0.0)
                rb_io_tokens_fail(t, "a skew-symmetric matrix has no diagonal, got %g in row %d", x,
                                  i + 1);
            rb_triplets_add(&m->entries, i, j, x);
            if (symmetric && i != j)
                rb_triplets_add(&m->entries, j, i, skew ? -x : x);
        }
    } else if (symmetric) {
        if (rb_io_tokens_room_for(t, rows, (skew ? cols - 1 : cols + 1) / 2, "matrix") &&
            !(m->dense = rb_alloc(rows, cols)))
            t->status = rb_fail(t->why, RB_ENOMEM, "%s: out of memory for matrix", t->path);
        for (size_t j = 0; t->status == RB_OK && j < cols; j++) {
            const size_t first = j + (skew ? 1 : 0); /* below the diagonal, or on it */
            double *column = m->dense + j * rows;
            if (skew)
                column[j] = 0.0;
            rb_io_tokens_reals(t, rows - first, column + first, "column of the triangle");
            for (size_t i = first; i < rows; i++)
                m->dense[j + i * rows] = skew ? -column[i] : column[i];
        }
    } else {
        m->dense = rb_io_tokens_alloc(t, rows, cols, "matrix");
        rb_io_tokens_reals(t, rows * cols, m->dense, "matrix");
    }
    if (t->status == RB_OK && rb_io_tokens_more(t))
        rb_io_tokens_fail(t, "expected the end of the file after the last number");
    if (t->status != RB_OK)
        rb_io_matrix_free(m);
}

rb_status rb_io_matrix_market_read(const char *path, rb_io_matrix *m, rb_message *why)
{
    io_tokens t;
    rb_io_tokens_open(path, &t, why);
    rb_io_read_matrix_market(&t, m);
    rb_io_tokens_close(&t);
    return t.status;
}
