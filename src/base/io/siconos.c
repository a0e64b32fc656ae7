/* The text format of Siconos' test problems, as read off its files and their README. */
#include "base/io/io.h"
#include "base/io/readers.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { DENSE, BLOCKS, SPARSE };
enum { TRIPLETS = 1, COLUMNS = 2 };

static int ok(const io_tokens *t)
{
    return t->status == RB_OK;
}

/* ---- Matrices ---------------------------------------------------------------------- */

static void alloc_triplets(io_tokens *t, size_t nz, rb_io_matrix *m)
{
    if (nz > INT_MAX)
        rb_io_tokens_fail(t, "matrix: more than %d entries", INT_MAX);
    m->entries = (rb_triplets){.rows = m->rows,
                               .cols = m->cols,
                               .capacity = (int)nz,
                               .row = rb_io_tokens_alloc_int(t, nz, "matrix"),
                               .col = rb_io_tokens_alloc_int(t, nz, "matrix"),
                               .x = rb_io_tokens_alloc(t, nz, 1, "matrix")};
}

/* n integers, increasing (by step at least) from low; the last is total. */
static int *read_increasing(io_tokens *t, int n, int low, int step, int total, const char *what)
{
    int *x = rb_io_tokens_alloc_int(t, (size_t)n, what);
    for (int i = 0; ok(t) && i < n; i++)
        x[i] = rb_io_tokens_int(t, i ? x[i - 1] + step : low, total, what);
    if (ok(t) && (n ? x[n - 1] : 0) != total)
        rb_io_tokens_fail(t, "%s: expected the last to be %d", what, total);
    return x;
}

typedef struct {
    int count, rows, cols;  /* blocks; rows and columns of blocks */
    int *row_end, *col_end; /* cumulated sizes */
    int *first, *column;    /* compressed rows of blocks */
} blocks;

static int extent(const int *end, int i)
{
    return end[i] - (i ? end[i - 1] : 0);
}

static void read_block(io_tokens *t, const blocks *b, int i, int k, rb_io_matrix *m)
{
    const int j = b->column[k], rows = extent(b->row_end, i), cols = extent(b->col_end, j);
    const int row = b->row_end[i] - rows, col = b->col_end[j] - cols;
    rb_io_tokens_int(t, k, k, "number of the block");
    rb_triplets *e = &m->entries;
    rb_io_tokens_reals(t, (size_t)rows * (size_t)cols, e->x + e->nz, "block");
    for (int c = 0; c < cols; c++)
        for (int r = 0; r < rows; r++) {
            e->row[e->nz] = row + r;
            e->col[e->nz++] = col + c;
        }
}

/* A matrix of that size; rows 0: as many as the file says. */
static void read_matrix(io_tokens *t, int rows, int cols, rb_io_matrix *m)
{
    const int storage = rb_io_tokens_int(t, DENSE, SPARSE, "storage of the matrix");
    m->rows = rb_io_tokens_int(t, rows ? rows : 1, rows ? rows : INT_MAX, "rows of the matrix");
    cols = cols ? cols : m->rows;
    m->cols = rb_io_tokens_int(t, cols, cols, "columns of the matrix");
    if (!ok(t))
        return;
    if (storage == DENSE) {
        rb_io_tokens_int(t, m->rows, m->rows, "rows of the dense matrix");
        rb_io_tokens_int(t, m->cols, m->cols, "columns of the dense matrix");
        m->dense = rb_io_tokens_alloc(t, (size_t)m->rows, (size_t)m->cols, "matrix");
        rb_io_tokens_reals(t, (size_t)m->rows * (size_t)m->cols, m->dense, "matrix");
    } else if (storage == BLOCKS) {
        blocks b = {0};
        b.count = rb_io_tokens_int(t, 0, INT_MAX, "number of blocks");
        b.rows = rb_io_tokens_int(t, 0, m->rows, "rows of blocks");
        b.cols = rb_io_tokens_int(t, 0, m->cols, "columns of blocks");
        b.row_end = read_increasing(t, b.rows, 1, 1, m->rows, "cumulated block sizes");
        b.col_end = read_increasing(t, b.cols, 1, 1, m->cols, "cumulated block sizes");
        if (ok(t)) {
            rb_io_tokens_int(t, b.rows + 1, b.rows + 1, "length of the first index");
            rb_io_tokens_int(t, b.count, b.count, "length of the second index");
            b.first = read_increasing(t, b.rows + 1, 0, 0, b.count, "first index");
            b.column = rb_io_tokens_alloc_int(t, (size_t)b.count, "second index");
            for (int k = 0; ok(t) && k < b.count; k++)
                b.column[k] = rb_io_tokens_int(t, 0, b.cols - 1, "second index");
        }
        if (ok(t)) {
            /* More than INT_MAX: too many, and not all of them counted. */
            size_t nz = 0;
            for (int i = 0; i < b.rows; i++)
                for (int k = b.first[i]; k < b.first[i + 1] && nz <= INT_MAX; k++)
                    nz += (size_t)extent(b.row_end, i) * (size_t)extent(b.col_end, b.column[k]);
            alloc_triplets(t, nz, m);
        }
        for (int i = 0; ok(t) && i < b.rows; i++)
            for (int k = b.first[i]; ok(t) && k < b.first[i + 1]; k++)
                read_block(t, &b, i, k, m);
        free(b.row_end);
        free(b.col_end);
        free(b.first);
        free(b.column);
    } else {
        /* A version line, then "[triplet: ]3-by-3, nzmax: 4 nnz: 3[, 1-norm: 3.5]". */
        char size[60];
        const int origin = rb_io_tokens_int(t, TRIPLETS, COLUMNS, "origin of the sparse matrix");
        snprintf(size, sizeof size, "%d-by-%d,", m->rows, m->cols);
        if (ok(t) && rb_io_tokens_more(t)) /* the version */
            rb_io_tokens_skip_line(t);
        if (origin == TRIPLETS)
            rb_io_tokens_word(t, "triplet:");
        rb_io_tokens_word(t, size);
        rb_io_tokens_word(t, "nzmax:");
        rb_io_tokens_int(t, 0, INT_MAX, "nzmax");
        rb_io_tokens_word(t, "nnz:");
        const int nz = rb_io_tokens_int(t, 0, INT_MAX, "nnz");
        rb_io_tokens_skip_line(t);
        alloc_triplets(t, (size_t)nz, m);
        if (origin == TRIPLETS) {
            /* "i j : value" */
            while (ok(t) && m->entries.nz < nz) {
                const int i = rb_io_tokens_int(t, 0, m->rows - 1, "row");
                const int j = rb_io_tokens_int(t, 0, m->cols - 1, "column");
                rb_io_tokens_word(t, ":");
                rb_triplets_add(&m->entries, i, j, rb_io_tokens_real(t, "value"));
            }
        } else {
            /* "i : value" below "col j : locations a to b" */
            rb_triplets *e = &m->entries;
            for (int j = 0; ok(t) && j < m->cols; j++) {
                rb_io_tokens_word(t, "col");
                rb_io_tokens_int(t, j, j, "column");
                rb_io_tokens_word(t, ":");
                rb_io_tokens_word(t, "locations");
                rb_io_tokens_int(t, e->nz, e->nz, "location");
                rb_io_tokens_word(t, "to");
                const int last = rb_io_tokens_int(t, e->nz - 1, nz - 1, "location");
                while (ok(t) && e->nz <= last) {
                    const int i = rb_io_tokens_int(t, 0, m->rows - 1, "row");
                    rb_io_tokens_word(t, ":");
                    rb_triplets_add(e, i, j, rb_io_tokens_real(t, "value"));
                }
            }
            if (ok(t) && e->nz != nz)
                rb_io_tokens_fail(t, "sparse matrix: expected %d %s, got %d", nz,
                                  nz == 1 ? "entry" : "entries", e->nz);
        }
    }
}

static double *read_vector(io_tokens *t, int n, const char *what)
{
    double *x = rb_io_tokens_alloc(t, (size_t)n, 1, what);
    rb_io_tokens_reals(t, (size_t)n, x, what);
    return x;
}

/* ---- Problems ---------------------------------------------------------------------- */

void rb_io_lcp_free(rb_io_lcp *p)
{
    rb_io_matrix_free(&p->M);
    free(p->q);
    *p = (rb_io_lcp){0};
}

/* How many numbers stand here, before a word or the end. */
static size_t count_numbers(io_tokens *t)
{
    size_t n = 0;
    for (; rb_io_tokens_more(t); n++) {
        char *end;
        rb_read_number(t->at, &end);
        if (end == t->at || !strchr(" \t\r\n", *end)) /* or the zero behind the text */
            break;
        t->at = end;
    }
    return n;
}

void rb_io_read_siconos_lcp(io_tokens *t, rb_io_lcp *p)
{
    *p = (rb_io_lcp){0};
    p->n = rb_io_tokens_int(t, 1, INT_MAX, "n");
    read_matrix(t, p->n, p->n, &p->M);
    p->q = read_vector(t, p->n, "q");
    const size_t left = ok(t) ? count_numbers(t) : 0;
    if (left == 2 * (size_t)p->n)
        rb_io_tokens_fail(t, "a relay problem of Siconos, expected an LCP: behind q stand its "
                             "bounds; give them to an LCP as --lower and --upper");
    else if (left > 0)
        rb_io_tokens_fail(t, "expected the end of the file or a comment after q, got %zu number%s",
                          left, rb_plural((long long)left));
    if (!ok(t))
        rb_io_lcp_free(p);
}

rb_status rb_io_siconos_read_lcp(const char *path, rb_io_lcp *p, rb_message *why)
{
    io_tokens t;
    rb_io_tokens_open(path, &t, why);
    rb_io_read_siconos_lcp(&t, p);
    rb_io_tokens_close(&t);
    return t.status;
}

void rb_io_friction_free(rb_io_friction *p)
{
    rb_io_matrix_free(&p->W);
    rb_io_matrix_free(&p->M);
    rb_io_matrix_free(&p->H);
    free(p->q);
    free(p->f);
    free(p->w);
    free(p->mu);
    *p = (rb_io_friction){0};
}

/* Some files end with one more token, 0 or 1. */
static void expect_end(io_tokens *t)
{
    if (ok(t) && rb_io_tokens_more(t))
        rb_io_tokens_int(t, 0, 1, "after the last number");
    if (ok(t) && rb_io_tokens_more(t))
        rb_io_tokens_fail(t, "expected the end of the file after the last number");
}

/* Behind mu of a friction problem; of rolling friction stands mu_r there. */
static void expect_end_of_friction(io_tokens *t, int contacts)
{
    io_tokens behind = *t;
    if (ok(t) && contacts > 1 && count_numbers(&behind) == (size_t)contacts &&
        !rb_io_tokens_more(&behind))
        rb_io_tokens_fail(t,
                          "a problem of rolling friction of Siconos, with mu_r behind mu; rolling "
                          "friction is read from files of FCLib");
    expect_end(t);
}

rb_status rb_io_siconos_read_friction(const char *path, int global, rb_io_friction *p,
                                      rb_message *why)
{
    io_tokens t;
    *p = (rb_io_friction){.global = global};
    rb_io_tokens_open(path, &t, why);
    p->dimension = rb_io_tokens_int(&t, 2, 3, "dimension");
    p->contacts = rb_io_tokens_int(&t, 0, INT_MAX / 3, "number of contacts");
    const int m = p->dimension * p->contacts;
    if (ok(&t) && m == 0) { /* what follows are sizes of 0 */
        rb_io_tokens_close(&t);
        return RB_OK;
    }
    if (global) {
        read_matrix(&t, 0, 0, &p->M);
        if (ok(&t))
            read_matrix(&t, p->M.rows, m, &p->H);
        p->f = read_vector(&t, p->M.rows, "q");
        p->w = read_vector(&t, m, "b");
    } else {
        read_matrix(&t, m, m, &p->W);
        p->q = read_vector(&t, m, "q");
    }
    p->mu = read_vector(&t, p->contacts, "mu");
    expect_end_of_friction(&t, p->contacts);
    if (!ok(&t))
        rb_io_friction_free(p);
    rb_io_tokens_close(&t);
    return t.status;
}

void rb_io_soclcp_free(rb_io_soclcp *p)
{
    rb_io_matrix_free(&p->M);
    free(p->q);
    free(p->start);
    free(p->tau);
    *p = (rb_io_soclcp){0};
}

rb_status rb_io_siconos_read_soclcp(const char *path, rb_io_soclcp *p, rb_message *why)
{
    io_tokens t;
    *p = (rb_io_soclcp){0};
    rb_io_tokens_open(path, &t, why);
    p->n = rb_io_tokens_int(&t, 1, INT_MAX, "n");
    p->cones = rb_io_tokens_int(&t, 1, p->n, "number of cones");
    read_matrix(&t, p->n, p->n, &p->M);
    p->q = read_vector(&t, p->n, "q");
    if (ok(&t)) /* then n numbers have been read, and n + 1 is an int */
        p->start = read_increasing(&t, p->cones + 1, 0, 1, p->n, "start of the cones");
    p->tau = read_vector(&t, p->cones, "tau");
    expect_end(&t);
    if (!ok(&t))
        rb_io_soclcp_free(p);
    rb_io_tokens_close(&t);
    return t.status;
}

/* ---- Kinds ------------------------------------------------------------------------- */

/* Mixed: n, m, rows, and rows (n + m + 1) numbers: A, B, C, D, a, b. */
static int is_mixed(io_tokens *t, const int head[3])
{
    const double numbers = 3.0 + (double)head[2] * ((double)head[0] + head[1] + 1.0);
    if (head[0] < 1 || head[1] < 1 || head[2] < head[1] || head[2] > head[0] + head[1])
        return 0;
    rb_io_tokens_rewind(t);
    return (double)count_numbers(t) == numbers && !rb_io_tokens_more(t);
}

/* LCP: n, storage, n, n.  Friction: d, contacts, storage, m, m with m = d contacts.
 * SOCLCP: n, cones, storage, n, n.  Global friction: d, contacts, storage, n, n. */
int rb_io_siconos_kind_at(io_tokens *t)
{
    enum { SIZES = 5 };
    int head[SIZES];
    for (int i = 0; i < SIZES; i++) {
        const int before = ok(t);
        head[i] = rb_io_tokens_int(t, 0, INT_MAX, "size at the head");
        if (i >= 3 && before && !ok(t)) { /* perhaps its sizes end with the third number */
            const int mixed = is_mixed(t, head);
            if (!mixed)
                t->status = RB_EFORMAT;
            return mixed ? RB_IO_SICONOS_MIXED : -1;
        }
    }
    if (!ok(t))
        return -1;
    const int matrix = head[2] <= SPARSE && head[3] == head[4];
    if (head[1] <= SPARSE && head[2] == head[0] && head[3] == head[0])
        return RB_IO_SICONOS_LCP;
    if (matrix && (head[0] == 2 || head[0] == 3) && head[3] == (long long)head[0] * head[1])
        return RB_IO_SICONOS_FRICTION;
    if (matrix && head[0] == 5 && head[3] == 5LL * head[1])
        return RB_IO_SICONOS_ROLLING;
    if (matrix && head[3] == head[0] && head[3] > 0)
        return RB_IO_SICONOS_SOCLCP;
    if (matrix && (head[0] == 2 || head[0] == 3) && head[3] > 0)
        return RB_IO_SICONOS_FRICTION_GLOBAL;
    const int line = t->line; /* the last size's, which the message names */
    if (is_mixed(t, head))
        return RB_IO_SICONOS_MIXED;
    t->line = line;
    return -1;
}

rb_status rb_io_siconos_guess(const char *path, rb_io_siconos_kind *kind, rb_message *why)
{
    io_tokens t;
    rb_io_tokens_open(path, &t, why);
    const int found = rb_io_siconos_kind_at(&t);
    if (ok(&t) && found < 0)
        rb_io_tokens_fail(&t, "the sizes at the head are of no known kind of problem");
    else if (ok(&t))
        *kind = (rb_io_siconos_kind)found;
    rb_io_tokens_close(&t);
    return t.status;
}
