/* FCLib files: written and read back in the three layouts, the traps of files found in
 * the wild, and every way in which a file can be wrong. */
#define _GNU_SOURCE
#include "check.h"
#include "failing_call.h"
#include "lcp/friction/friction.h"
#include "base/io/io_fclib.h"
#include "scratch.h"

#include <hdf5.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>

/* The clock that HDF5 would note: another one in every process. */
int gettimeofday(struct timeval *restrict now, void *restrict zone)
{
    (void)zone;
    *now = (struct timeval){.tv_sec = getpid()};
    return 0;
}

/* Unsymmetric, with an empty column and an entry per layout that tells rows from columns. */
static void small_local(rb_io_fclib *p)
{
    int row[] = {0, 1, 0, 3, 2, 5, 4, 0}, col[] = {0, 1, 5, 3, 2, 5, 4, 3};
    double x[] = {1.0, 2.0, -0.5, 3.0, 4.0, 5.0, 6.0, 0.25};
    *p = (rb_io_fclib){.spacedim = 3,
                       .contacts = 2,
                       .q = rb_alloc(6, 1),
                       .mu = rb_alloc(2, 1),
                       .r = rb_alloc(6, 1)};
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 6, .cols = 6, .nz = 8, .row = row, .col = col, .x = x}, &p->W));
    for (int k = 0; k < 6; k++)
        p->q[k] = k - 2.5, p->r[k] = 0.1 * k;
    p->mu[0] = 0.3, p->mu[1] = 0.0;
}

static void small_global(rb_io_fclib *p)
{
    int row[] = {0, 1, 2, 0, 1}, col[] = {0, 1, 2, 1, 0};
    double x[] = {2.0, 2.0, 5.0, -1.0, -1.0}, one[] = {1.0, 1.0};
    int hrow[] = {0, 2}, hcol[] = {0, 1};
    *p = (rb_io_fclib){.global = 1,
                       .spacedim = 2,
                       .contacts = 1,
                       .f = rb_alloc(3, 1),
                       .w = rb_alloc(2, 1),
                       .mu = rb_alloc(1, 1),
                       .v = rb_alloc(3, 1)};
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 3, .cols = 3, .nz = 5, .row = row, .col = col, .x = x}, &p->M));
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 3, .cols = 2, .nz = 2, .row = hrow, .col = hcol, .x = one}, &p->H));
    p->f[0] = -1.0, p->f[2] = 0.1, p->w[1] = 0.5, p->mu[0] = 0.3, p->v[2] = 7.0;
}

static void same_sparse(const rb_sparse *a, const rb_sparse *b)
{
    assert_int_equal(a->rows, b->rows);
    assert_int_equal(a->cols, b->cols);
    assert_memory_equal(a->p, b->p, ((size_t)a->cols + 1) * sizeof *a->p);
    assert_memory_equal(a->i, b->i, (size_t)a->p[a->cols] * sizeof *a->i);
    assert_memory_equal(a->x, b->x, (size_t)a->p[a->cols] * sizeof *a->x);
}

TEST(what_is_written_is_read_in_every_layout)
{
    for (int layout = RB_IO_FCLIB_TRIPLET; layout <= RB_IO_FCLIB_CSR; layout++) {
        if (!is_in_turn(layout, 3))
            continue;
        rb_io_fclib p, back;
        small_local(&p);
        CHECK_OK(rb_io_fclib_write(path, &p, (rb_io_fclib_layout)layout, "t", NULL, &message));
        CHECK_OK(rb_io_fclib_read(path, &back, &message));
        assert_int_equal(back.global, 0);
        assert_int_equal(back.spacedim, 3);
        assert_int_equal(back.contacts, 2);
        same_sparse(&p.W, &back.W);
        assert_memory_equal(p.q, back.q, 6 * sizeof *p.q);
        assert_memory_equal(p.mu, back.mu, 2 * sizeof *p.mu);
        assert_memory_equal(p.r, back.r, 6 * sizeof *p.r);
        assert_null(back.u);
        rb_io_fclib_free(&back);
        rb_io_fclib_free(&p);

        small_global(&p);
        CHECK_OK(rb_io_fclib_write(path, &p, (rb_io_fclib_layout)layout, NULL, "d", &message));
        CHECK_OK(rb_io_fclib_read(path, &back, &message));
        assert_int_equal(back.global, 1);
        same_sparse(&p.M, &back.M);
        same_sparse(&p.H, &back.H);
        assert_memory_equal(p.f, back.f, 3 * sizeof *p.f);
        assert_memory_equal(p.w, back.w, 2 * sizeof *p.w);
        assert_memory_equal(p.v, back.v, 3 * sizeof *p.v);
        rb_io_fclib_free(&back);
        rb_io_fclib_free(&p);
    }
}

TEST(one_triangle_of_m_is_completed)
{
    rb_io_fclib p, back;
    for (int lower = 0; lower < 2; lower++) {
        small_global(&p);
        OWNED(rb_sparse) full = p.M;
        int row[] = {0, 1, 2, lower}, col[] = {0, 1, 2, !lower};
        double x[] = {2.0, 2.0, 5.0, -1.0};
        CHECK_OK(rb_sparse_from_triplets(
            &(rb_triplets){.rows = 3, .cols = 3, .nz = 4, .row = row, .col = col, .x = x}, &p.M));
        CHECK_OK(rb_io_fclib_write(path, &p, RB_IO_FCLIB_TRIPLET, "", "", &message));
        CHECK_OK(rb_io_fclib_read(path, &back, &message));
        same_sparse(&full, &back.M);
        rb_io_fclib_free(&back);
        rb_io_fclib_free(&p);
    }
}

/* Replaces (or adds) an integer array, or a double array, of the file. */
static void overwrite(const char *name, hid_t type, int n, const void *values)
{
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    const hsize_t size = (hsize_t)n;
    if (H5Lexists(file, name, H5P_DEFAULT) > 0)
        H5Ldelete(file, name, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &size, NULL);
    const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(set >= 0);
    assert_true(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    H5Dclose(set);
    H5Sclose(space);
    H5Fclose(file);
}

static void set_int(const char *name, int value)
{
    overwrite(name, H5T_NATIVE_INT, 1, &value);
}

static void fresh_local(void)
{
    OWNED(rb_io_fclib) p;
    small_local(&p);
    CHECK_OK(rb_io_fclib_write(path, &p, RB_IO_FCLIB_CSC, "", "", NULL));
}

static void fresh_global(void)
{
    OWNED(rb_io_fclib) p;
    small_global(&p);
    CHECK_OK(rb_io_fclib_write(path, &p, RB_IO_FCLIB_TRIPLET, "", "", NULL));
}

static void refused(const char *words)
{
    rb_io_fclib p;
    CHECK_STATUS(rb_io_fclib_read(path, &p, &message), RB_EFORMAT);
    if (!strstr(message.text, words) || !strstr(message.text, path))
        fail_msg("'%s' lacks '%s'", message.text, words);
    assert_null(p.W.p);
}

/* A local problem with another array there. */
static void refused_with(const char *name, hid_t type, hsize_t n, const void *values,
                         const char *part)
{
    fresh_local();
    overwrite(name, type, n, values);
    refused(part);
}

TEST(sizes_and_indices_are_checked)
{
    const int p_down[] = {0, 3, 1, 3, 5, 6, 8}, p_long[] = {0, 1, 2, 3, 4, 5, 900};
    const int i_far[] = {0, 1, 2, 3, 4, 5, 6, 0};
    const double few[] = {1.0};
    fresh_local();
    set_int("/fclib_local/spacedim", 5);
    refused("spacedim is 5");
    set_int("/fclib_local/spacedim", 4);
    refused("spacedim is 4");
    fresh_local();
    set_int("/fclib_local/W/m", 5);
    refused("W");
    fresh_local();
    set_int("/fclib_local/W/m", -3);
    refused("-3 x 6");
    fresh_local();
    set_int("/fclib_local/W/nz", -7);
    refused("nz = -7");
    fresh_local();
    set_int("/fclib_local/W/nz", 800);
    refused("expected 800");
    refused_with("/fclib_local/W/p", H5T_NATIVE_INT, 7, p_down, "does not increase");
    refused_with("/fclib_local/W/p", H5T_NATIVE_INT, 7, p_long, "expected 900");
    refused_with("/fclib_local/W/i", H5T_NATIVE_INT, 8, i_far, "index out of range");
    refused_with("/fclib_local/vectors/q", H5T_NATIVE_DOUBLE, 1, few, "expected 6");
    refused_with("/fclib_local/vectors/mu", H5T_NATIVE_DOUBLE, 1, few, "expected 2");
    const int p_below[] = {0, 1, 2, 3, 4, 5, -8}, p_first[] = {-1, 1, 2, 3, 4, 5, 8},
              p_beyond[] = {0, 9, 2, 3, 4, 5, 8}, p_equal[] = {0, 0, 0, 0, 0, 8, 8};
    refused_with("/fclib_local/W/p", H5T_NATIVE_INT, 7, p_first, "W/p does not increase");
    refused_with("/fclib_local/W/p", H5T_NATIVE_INT, 7, p_beyond, "W/p does not increase");
    fresh_local();
    overwrite("/fclib_local/W/p", H5T_NATIVE_INT, 7, p_equal); /* empty columns */
    OWNED(rb_io_fclib) gathered;
    CHECK_OK(rb_io_fclib_read(path, &gathered, NULL));
    assert_int_equal(gathered.W.p[4], 0);
    fresh_local();
    set_int("/fclib_local/W/nz", -3);
    refused("W is 6 x 6 with nz = -3");
    fresh_local();
    set_int("/fclib_local/W/n", 0);
    refused("W is 6 x 0 with nz = -1");
    fresh_local();
    set_int("/fclib_local/W/m", 1 << 29);
    refused("W is 536870912 x 6 with nz = -1");
    fresh_local();
    set_int("/fclib_local/W/n", 1 << 29);
    refused("W is 6 x 536870912 with nz = -1");
    fresh_local();
    overwrite("/fclib_local_rolling", H5T_NATIVE_INT, 1, p_down);
    refused("rolling friction in the local form is not supported");
    refused_with("/fclib_local/W/p", H5T_NATIVE_INT, 7, p_below, "W/p ends in -8");
    refused_with("/fclib_local/W/m", H5T_NATIVE_INT, 0, p_below, "/W/m is empty");
    fresh_local();
    set_int("/fclib_local/spacedim", 2);
    refused("expected 3"); /* three contacts have three mu */

    rb_io_fclib p;
    small_local(&p);
    CHECK_OK(rb_io_fclib_write(path, &p, RB_IO_FCLIB_TRIPLET, "", "", NULL));
    set_int("/fclib_local/W/n", 7);
    refused("W is 6 x 7");
    set_int("/fclib_local/W/m", 7);
    refused("7 contact rows are no multiple of 3");
    rb_io_fclib_free(&p);
    fresh_global();
    set_int("/fclib_global/H/m", 4);
    refused("M is 3 x 3 and H is 4 x 2");
    fresh_global();
    set_int("/fclib_global/M/n", 4);
    refused("M is 3 x 4 and H is 3 x 2");
    const double upper_alone[] = {2.0, -1.0, 2.0, 5.0};
    const int rows[] = {0, 0, 1, 2}, columns[] = {0, 1, 1, 2};
    fresh_global(); /* a triangle, but of no square matrix */
    overwrite("/fclib_global/M/x", H5T_NATIVE_DOUBLE, 4, upper_alone);
    overwrite("/fclib_global/M/i", H5T_NATIVE_INT, 4, rows);
    overwrite("/fclib_global/M/p", H5T_NATIVE_INT, 4, columns);
    set_int("/fclib_global/M/nz", 4);
    set_int("/fclib_global/M/n", 4);
    refused("M is 3 x 4 and H is 3 x 2");
    /* nzmax beyond what is stored does not matter */
    fresh_local();
    set_int("/fclib_local/W/nzmax", 900);
    OWNED(rb_io_fclib) back;
    CHECK_OK(rb_io_fclib_read(path, &back, NULL));
    assert_int_equal(back.W.p[6], 8);
}

/* u = W r + V l + q, V' r + R l + s = 0 with one constraint; entries of R: 0 or 1 */
static void small_constrained(rb_io_fclib *p, int entries)
{
    int at[] = {0, 3}, zero[] = {0, 0};
    double x[] = {2.0, -1.0};
    small_local(p);
    p->constraints = 1;
    p->s = rb_alloc(1, 1);
    p->s[0] = 0.5;
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 6, .cols = 1, .nz = 2, .row = at, .col = zero, .x = x}, &p->V));
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 1, .cols = 1, .nz = entries, .row = zero, .col = zero, .x = x},
        &p->R));
}

static void fresh_constrained(void)
{
    OWNED(rb_io_fclib) p;
    small_constrained(&p, 1);
    CHECK_OK(rb_io_fclib_write(path, &p, RB_IO_FCLIB_CSC, "", "", NULL));
}

static void drop(const char *name)
{
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Ldelete(file, name, H5P_DEFAULT) >= 0);
    H5Fclose(file);
}

TEST(constraints_are_whole_or_refused)
{
    rb_io_fclib p;
    const double few[] = {1.0};
    fresh_constrained();
    CHECK_OK(rb_io_fclib_read(path, &p, NULL));
    assert_int_equal(p.constraints, 1);
    CHECK_ABS(p.V.x[1], -1.0, 0.0, "V");
    CHECK_ABS(p.R.x[0], 2.0, 0.0, "R");
    CHECK_ABS(p.s[0], 0.5, 0.0, "s");
    rb_io_fclib_free(&p);
    drop("/fclib_local/R");
    refused("no /fclib_local/R/m");
    drop("/fclib_local/vectors/s");
    refused("no /fclib_local/R/m");
    fresh_constrained();
    drop("/fclib_local/V");
    drop("/fclib_local/R");
    refused("no /fclib_local/V/m");
    drop("/fclib_local/vectors/s"); /* no constraints at all */
    CHECK_OK(rb_io_fclib_read(path, &p, NULL));
    assert_int_equal(p.constraints, 0);
    rb_io_fclib_free(&p);
    fresh_constrained();
    drop("/fclib_local/V");
    drop("/fclib_local/vectors/s");
    refused("no /fclib_local/V/m");
    fresh_constrained();
    drop("/fclib_local/V");
    refused("no /fclib_local/V/m");
    fresh_constrained();
    drop("/fclib_local/vectors/s");
    refused("no /fclib_local/vectors/s");
    fresh_constrained();
    set_int("/fclib_local/V/m", 7);
    refused("/fclib_local/V is 7 x 1, expected 6 x 1");
    fresh_constrained();
    set_int("/fclib_local/R/m", 2);
    refused("/fclib_local/R is 2 x 1, expected 1 x 1");
    fresh_constrained();
    const int two[] = {0, 1, 1};
    set_int("/fclib_local/R/n", 2);
    overwrite("/fclib_local/R/p", H5T_NATIVE_INT, 3, two);
    refused("/fclib_local/R is 1 x 2, expected 1 x 1");
    OWNED(rb_io_fclib) g;
    small_global(&g);
    CHECK_OK(rb_io_fclib_write(path, &g, RB_IO_FCLIB_CSR, "", "", NULL));
    overwrite("/fclib_global/vectors/b", H5T_NATIVE_DOUBLE, 1, few);
    refused("no /fclib_global/G/m");
}

/* Also a matrix without an entry, and each vector of a solution by itself. */
TEST(constraints_are_read_as_written_in_every_layout)
{
    for (int layout = RB_IO_FCLIB_TRIPLET; layout <= RB_IO_FCLIB_CSR; layout++) {
        if (!is_in_turn(layout, 3))
            continue;
        rb_io_fclib p, back;
        small_constrained(&p, 0);
        p.u = p.r; /* u alone */
        p.r = NULL;
        CHECK_OK(rb_io_fclib_write(path, &p, (rb_io_fclib_layout)layout, "", "", &message));
        CHECK_OK(rb_io_fclib_read(path, &back, &message));
        assert_int_equal(back.constraints, 1);
        same_sparse(&p.V, &back.V);
        same_sparse(&p.R, &back.R);
        assert_non_null(back.R.i);
        assert_non_null(back.R.x);
        assert_memory_equal(p.s, back.s, sizeof *p.s);
        assert_memory_equal(p.u, back.u, 6 * sizeof *p.u);
        assert_null(back.r);
        assert_null(back.v);
        rb_io_fclib_free(&back);
        rb_io_fclib_free(&p);

        int row[] = {1, 2}, zero[] = {0, 0};
        double x[] = {3.0, -4.0};
        small_global(&p);
        p.constraints = 1;
        p.b = rb_alloc(1, 1);
        p.b[0] = 0.75;
        free(p.v);
        p.v = NULL;
        CHECK_OK(rb_sparse_from_triplets(
            &(rb_triplets){.rows = 3, .cols = 1, .nz = 2, .row = row, .col = zero, .x = x}, &p.G));
        CHECK_OK(rb_io_fclib_write(path, &p, (rb_io_fclib_layout)layout, "", "", &message));
        CHECK_OK(rb_io_fclib_read(path, &back, &message));
        same_sparse(&p.G, &back.G);
        CHECK_ABS(back.b[0], 0.75, 0.0, "b");
        assert_null(back.r);
        assert_null(back.u);
        assert_null(back.v);
        rb_io_fclib_free(&back);
        rb_io_fclib_free(&p);
    }
}

static void texts_of(hid_t file, const char *name, char *text, size_t size)
{
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(set);
    memset(text, 0, size);
    assert_true(H5Tget_size(type) < size);
    assert_true(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) >= 0);
    H5Tclose(type);
    H5Dclose(set);
}

static void ints_of(hid_t file, const char *name, int n, int *x)
{
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
    assert_int_equal(H5Sget_simple_extent_npoints(space), n);
    assert_true(H5Dread(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, x) >= 0);
    H5Sclose(space);
    H5Dclose(set);
}

/* What other programs look for: the texts, the sign of nz, and what p holds. */
TEST(files_are_as_the_format_says)
{
    static const int nz[] = {5, -1, -2}, length[] = {5, 4, 4};
    static const int p[][5] = {{0, 0, 1, 1, 2}, {0, 2, 4, 5}, {0, 2, 4, 5}};
    for (int layout = RB_IO_FCLIB_TRIPLET; layout <= RB_IO_FCLIB_CSR; layout++) {
        if (!is_in_turn(layout, 3))
            continue;
        OWNED(rb_io_fclib) problem;
        char text[40];
        int x[8];
        small_global(&problem);
        CHECK_OK(rb_io_fclib_write(path, &problem, (rb_io_fclib_layout)layout,
                                   layout ? "a title" : NULL, layout ? NULL : "words", NULL));
        const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
        texts_of(file, "/fclib_global/info/title", text, sizeof text);
        assert_string_equal(text, layout ? "a title" : "");
        texts_of(file, "/fclib_global/info/description", text, sizeof text);
        assert_string_equal(text, layout ? "" : "words");
        texts_of(file, "/fclib_global/info/math_info", text, sizeof text);
        assert_string_equal(text, "");
        ints_of(file, "/fclib_global/M/nz", 1, x);
        assert_int_equal(x[0], nz[layout]);
        ints_of(file, "/fclib_global/M/nzmax", 1, x);
        assert_int_equal(x[0], 5);
        ints_of(file, "/fclib_global/M/p", length[layout], x);
        assert_memory_equal(x, p[layout], (size_t)length[layout] * sizeof *x);
        ints_of(file, "/fclib_global/spacedim", 1, x);
        assert_int_equal(x[0], 2);
        assert_true(H5Lexists(file, "/solution", H5P_DEFAULT) > 0);
        assert_int_equal(H5Lexists(file, "/solution/r", H5P_DEFAULT), 0);
        H5Fclose(file);
    }
    char *bytes[2];
    for (int k = 0; k < 2; k++) {
        bytes[k] = calloc(100000, 1);
        fresh_local();
        FILE *f = fopen(path, "rb");
        assert_true(fread(bytes[k], 1, 100000, f) < 100000);
        fclose(f);
    }
    assert_memory_equal(bytes[0], bytes[1], 100000);
    free(bytes[0]);
    free(bytes[1]);
}

/* Opens the file for a change of one array, which is deleted. */
static hid_t without(const char *name)
{
    fresh_local();
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Ldelete(file, name, H5P_DEFAULT) >= 0);
    return file;
}

static void put_set(hid_t file, const char *name, hsize_t size, hid_t properties)
{
    const hid_t space = H5Screate_simple(1, &size, NULL);
    const hid_t set =
        H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    assert_true(set >= 0);
    H5Dclose(set);
    H5Sclose(space);
    H5Pclose(properties);
    H5Fclose(file);
}

/* What would open a second file is refused, whether that file is there or not. */
TEST(nothing_is_read_of_another_file)
{
    static const char q[] = "/fclib_local/vectors/q";
    hid_t file = without(q);
    assert_true(H5Lcreate_external("/etc/passwd", "/x", file, q, H5P_DEFAULT, H5P_DEFAULT) >= 0);
    H5Fclose(file);
    refused("has links");
    file = without("/fclib_local/W/i");
    assert_true(H5Lcreate_soft("/fclib_local/W/p", file, "/fclib_local/W/i", H5P_DEFAULT,
                               H5P_DEFAULT) >= 0);
    H5Fclose(file);
    refused("has links");
    file = without("/fclib_local");
    assert_true(H5Lcreate_external(path, "/fclib_local", file, "/fclib_local", H5P_DEFAULT,
                                   H5P_DEFAULT) >= 0);
    H5Fclose(file);
    refused("has links");
    hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(properties, "/etc/passwd", 0, 48);
    put_set(without(q), q, 6, properties);
    refused("kept in another file");
    const hsize_t six = 6;
    const hid_t space = H5Screate_simple(1, &six, NULL);
    properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_virtual(properties, space, "/etc/passwd", "/x", space);
    H5Sclose(space);
    put_set(without(q), q, 6, properties);
    refused("kept in another file");
}

/* Small files that claim many entries: arrays that were never written, and a matrix of
 * many columns with few entries. */
TEST(memory_is_bounded_by_the_size_of_the_file)
{
    static const char q[] = "/fclib_local/vectors/q";
    const hsize_t chunk = 1 << 16;
    char wanted[100];
    struct stat file;
    put_set(without(q), q, 1 << 29, H5Pcreate(H5P_DATASET_CREATE));
    assert_int_equal(stat(path, &file), 0);
    snprintf(wanted, sizeof wanted, "has 4.29497e+09 bytes: a file of this size holds at most %g",
             1032.0 * (double)file.st_size);
    refused(wanted);
    hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(properties, 1, &chunk);
    put_set(without(q), q, 1 << 29, properties);
    refused("has 4.29497e+09 bytes: a file of this size holds at most");
    fresh_local();
    set_int("/fclib_local/W/nz", 1);
    set_int("/fclib_local/W/m", 1 << 27);
    set_int("/fclib_local/W/n", 1 << 27);
    refused("134217728 x 134217728");
    put_set(without(q), q, 1 << 30, H5Pcreate(H5P_DATASET_CREATE));
    refused("/fclib_local/vectors/q: unreadable size");
}

TEST(other_files_are_refused)
{
    rb_io_fclib p;
    CHECK_STATUS(rb_io_fclib_read("/nowhere/x.hdf5", &p, &message), RB_ENOENT);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(file);
    refused("no FCLib problem");
    fresh_local();
    FILE *f = fopen(path, "r+b");
    fseek(f, 0, SEEK_END);
    const long size = ftell(f);
    fclose(f);
    for (long cut = size - 1; cut > 8; cut = cut * 2 / 3) {
        assert_int_equal(truncate(path, cut), 0);
        CHECK_STATUS(rb_io_fclib_read(path, &p, &message), RB_EFORMAT);
    }
    assert_int_equal(truncate(path, 3), 0);
    refused("not an HDF5 file");
    assert_int_equal(rb_io_is_hdf5(path), 0);
    assert_int_equal(rb_io_is_hdf5("/nowhere/x.hdf5"), 0);
    assert_int_equal(rb_io_is_hdf5("/tmp"), 0);
    fresh_local();
    assert_int_equal(rb_io_is_hdf5(path), 1);
    CHECK_STATUS(
        rb_io_fclib_write("/nowhere/x.hdf5", &(rb_io_fclib){0}, RB_IO_FCLIB_CSC, "", "", &message),
        RB_EWRITE);
    rb_io_fclib_free(NULL);
}

TEST(problems_go_through_files)
{
    rb_friction_problem p;
    const double bad[] = {0.3, -1.0};
    fresh_local();
    CHECK_OK(rb_friction_read(path, &p, &message));
    assert_int_equal(p.form, RB_FRICTION_LOCAL_SPARSE);
    assert_int_equal(p.contacts, 2);
    CHECK_OK(
        rb_friction_write(path, &p, &(rb_friction_solution){p.q, p.q, NULL}, "again", &message));
    rb_friction_problem_free(&p);
    CHECK_OK(rb_friction_read(path, &p, &message));
    CHECK_ABS(p.q[5], 2.5, 0.0, "q");
    rb_friction_problem_free(&p);
    overwrite("/fclib_local/vectors/mu", H5T_NATIVE_DOUBLE, 2, bad);
    CHECK_SAYS(rb_friction_read(path, &p, &message), RB_EFORMAT, "mu of contact 2 is -1");
    assert_non_null(strstr(message.text, path));

    OWNED(rb_io_fclib) g;
    small_global(&g);
    CHECK_OK(rb_io_fclib_write(path, &g, RB_IO_FCLIB_CSR, "", "", &message));
    CHECK_OK(rb_friction_read(path, &p, &message));
    assert_int_equal(p.form, RB_FRICTION_GLOBAL);
    assert_int_equal(p.dofs, 3);
    CHECK_OK(rb_friction_write(path, &p, &(rb_friction_solution){.v = p.f}, "again", &message));
    rb_friction_problem_free(&p);
}

TEST(failing_allocations_are_reported)
{
    for (int global = 0; global < 2; global++) {
        rb_io_fclib p;
        if (!is_in_turn(global, 2))
            continue;
        if (global)
            small_global(&p);
        else
            small_local(&p);
        CHECK_OK(rb_io_fclib_write(path, &p, RB_IO_FCLIB_CSR, "", "", NULL));
        rb_io_fclib_free(&p);
        int count = 0;
        for (rb_status s = RB_ENOMEM; s != RB_OK && count < 200; count++) {
            alloc_fail_after(count);
            s = rb_io_fclib_read(path, &p, NULL);
            const int refused_one = alloc_failed();
            alloc_succeed();
            assert_true(s == RB_ENOMEM || (s == RB_OK && !refused_one));
        }
        assert_true(count > 10);
        for (int layout = RB_IO_FCLIB_TRIPLET; layout <= RB_IO_FCLIB_CSR; layout++) {
            rb_status s = RB_ENOMEM;
            for (count = 0; s != RB_OK && count < 50; count++) {
                rb_message why = {.text = ""};
                alloc_fail_after(count);
                s = rb_io_fclib_write(path, &p, (rb_io_fclib_layout)layout, "", "", &why);
                alloc_succeed();
                assert_true(s == RB_OK || (s == RB_ENOMEM && strstr(why.text, "memory")));
            }
            CHECK_OK(s);
            assert_true(count > 5);
        }
        rb_io_fclib_free(&p);
    }
}

TEST(outside_files_are_read)
{
    rb_friction_problem p;
    rb_friction_facts facts;
    CHECK_OK(rb_friction_read(outside_data("fclib/CubeH8.hdf5"), &p, &message));
    assert_int_equal(p.form, RB_FRICTION_GLOBAL);
    assert_int_equal(p.dofs, 162);
    assert_int_equal(p.contacts, 1);
    assert_int_equal(p.K.p[162], 2 * 3168 - 162);
    rb_friction_problem_free(&p);
    CHECK_OK(rb_friction_read(outside_data("fclib/LMGC_100_PR_PerioBox-i00361-60-03000.hdf5"), &p,
                              &message));
    CHECK_OK(rb_friction_examine(&p, 1, &facts));
    assert_int_equal(p.contacts, 60);
    assert_true(facts.rank >= 72 && facts.rank <= 73);
    rb_friction_problem_free(&p);
}

RUN_TESTS(make_path, remove_path)
