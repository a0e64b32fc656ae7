/* Matrix Market and Siconos' text format: what is read, and what is refused and how. */
#define _XOPEN_SOURCE 700
#include "check.h"
#include "base/io/io.h"
#include "scratch.h"

#include <dirent.h>
#include <unistd.h>

/* A new file each time: ext4 waits for the disk where a file is cut to nothing and
 * written again. */
static void put_bytes(const char *text, size_t n)
{
    remove(path);
    FILE *f = NOT_NULL(fopen(path, "wb"));
    assert_int_equal(fwrite(text, 1, n, f), n);
    fclose(f);
}

static void put(const char *text)
{
    put_bytes(text, strlen(text));
}

/* ---- Valid files ------------------------------------------------------------------ */

/* All hold M = [2 1; 0 3] (columns 2 0, 1 3), q = (-5, -6). */
static const char PLAIN[] = "2 # n\n1 2\n2 1\n-1 -2e5\n";
static const char DENSE[] = "2\n0\n2\n2\n2\t2\n2 0\n1 3\n-5 -6\nMurty (1988), page 1";
static const char BLOCK[] = "2\n1\n2 2\n3\n2\n2\n1 2\n1 2\n3\n3\n0 2 3\n0 1 1\n"
                            "0\n2\n1\n1\n2\n3\n-5 -6 ";
static const char TRIPLET[] = "2\n2\n2\n2\n1\nCSparse Version 3.2.0, 2017\n"
                              "triplet: 2-by-2, nzmax: 9 nnz: 4\n    0 0 : 2\n    0 1 : 0.5\n"
                              "    1 1 : 3\n    0 1 : 0.5\n-5 -6";
static const char COLUMN[] = "2\n2\n2\n2\n2\nCSparse Version 3.2.0, 2017\n"
                             "2-by-2, nzmax: 3 nnz: 3, 1-norm: 4\n"
                             "    col 0 : locations 0 to 0\n      0 : 2\n"
                             "    col 1 : locations 1 to 2\n      0 : 1\n      1 : 3\n-5 -6";
static const char FRICTION[] = "2 1 0 2 2 2 2 2 0 1 3 -5 -6 0.5 1";
static const char SOCLCP[] = "2 2 0 2 2 2 2 2 0 1 3 -5 -6 0 1 2 0.5 0.25";

static void check_matrix(rb_io_matrix *m)
{
    const double want[] = {2.0, 0.0, 1.0, 3.0};
    OWNED(rb_sparse) a;
    CHECK_OK(rb_io_matrix_to_sparse(m, &a));
    double y[2], x[2] = {1.0, 10.0};
    rb_sparse_apply(1.0, &a, x, 0.0, y);
    CHECK_ABS(y[0], 12.0, 0.0, "sparse product");
    CHECK_ABS(y[1], 30.0, 0.0, "sparse product");
    CHECK_OK(rb_io_matrix_to_dense(m));
    CHECK_OK(rb_io_matrix_to_dense(m));
    for (int k = 0; k < 4; k++)
        CHECK_ABS(m->dense[k], want[k], 0.0, "entry %d", k);
}

TEST(every_storage_gives_the_same_lcp)
{
    const char *texts[] = {DENSE, BLOCK, TRIPLET, COLUMN};
    for (int k = 0; k < 4; k++) {
        OWNED(rb_io_lcp) p;
        rb_io_siconos_kind kind;
        put(texts[k]);
        CHECK_OK(rb_io_siconos_guess(path, &kind, &message));
        assert_int_equal(kind, RB_IO_SICONOS_LCP);
        CHECK_OK(rb_io_siconos_read_lcp(path, &p, &message));
        assert_int_equal(p.n, 2);
        CHECK_ABS(p.q[0], -5.0, 0.0, "q");
        CHECK_ABS(p.q[1], -6.0, 0.0, "q");
        check_matrix(&p.M);
        rb_io_lcp_free(&p);
    }
}

TEST(friction_and_cones)
{
    OWNED(rb_io_friction) f;
    OWNED(rb_io_soclcp) s;
    rb_io_siconos_kind kind;
    put(FRICTION);
    CHECK_OK(rb_io_siconos_guess(path, &kind, NULL));
    assert_int_equal(kind, RB_IO_SICONOS_FRICTION);
    CHECK_OK(rb_io_siconos_read_friction(path, 0, &f, NULL));
    assert_int_equal(f.dimension, 2);
    assert_int_equal(f.contacts, 1);
    CHECK_ABS(f.mu[0], 0.5, 0.0, "mu");
    CHECK_ABS(f.q[1], -6.0, 0.0, "q");
    check_matrix(&f.W);
    put(SOCLCP);
    CHECK_OK(rb_io_siconos_guess(path, &kind, NULL));
    assert_int_equal(kind, RB_IO_SICONOS_SOCLCP);
    CHECK_OK(rb_io_siconos_read_soclcp(path, &s, NULL));
    assert_int_equal(s.cones, 2);
    assert_int_equal(s.start[1], 1);
    CHECK_ABS(s.tau[1], 0.25, 0.0, "tau");
    check_matrix(&s.M);
}

/* By five numbers at the head; -1: of no kind. */
TEST(kinds_are_told_by_their_sizes)
{
    static const struct {
        const char *head;
        int kind;
    } all[] = {{"4 0 4 4 0", RB_IO_SICONOS_LCP},
               {"4 2 4 4 0", RB_IO_SICONOS_LCP},
               {"4 3 4 4 0", -1},
               {"2 1 0 2 2", RB_IO_SICONOS_FRICTION},
               {"3 5 2 15 15", RB_IO_SICONOS_FRICTION},
               {"3 5 3 15 15", -1},
               {"4 1 0 4 4", RB_IO_SICONOS_SOCLCP},
               {"3 2 1 3 3", RB_IO_SICONOS_SOCLCP},
               {"3 2 1 7 7", RB_IO_SICONOS_FRICTION_GLOBAL},
               {"2 2 1 7 7", RB_IO_SICONOS_FRICTION_GLOBAL},
               {"4 2 1 7 7", -1},
               {"3 2 1 0 0", -1},
               {"5 2 0 10 10", RB_IO_SICONOS_ROLLING},
               {"1 1 2 1 2 3 4 5 6", RB_IO_SICONOS_MIXED}, /* two rows of three */
               {"1 1 2 1 2 3 4 5", -1},
               {"1 1 1 0.5 0 1", RB_IO_SICONOS_MIXED},
               {"1 1 3 1 2 3 4 5 6 7 8 9", -1},
               {"3 2 1 7 8", -1}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_io_siconos_kind kind = RB_IO_SICONOS_LCP;
        put(all[k].head);
        const rb_status s = rb_io_siconos_guess(path, &kind, NULL);
        if (s != (all[k].kind < 0 ? RB_EFORMAT : RB_OK) || (s == RB_OK && (int)kind != all[k].kind))
            fail_msg("%s: status %d, kind %d", all[k].head, s, (int)kind);
    }
}

/* Blocks of one and two rows and columns, of which one is not stored. */
TEST(blocks_of_other_sizes_are_in_their_places)
{
    static const double want[] = {1, 0, 0, 2, 4, 5, 3, 6, 7};
    OWNED(rb_io_lcp) p;
    put("3\n1\n3 3\n3\n2\n2\n1 3\n1 3\n3\n3\n0 2 3\n0 1 1\n"
        "0\n1\n1\n2 3\n2\n4 5 6 7\n-1 -2 -3");
    CHECK_OK(rb_io_siconos_read_lcp(path, &p, NULL));
    CHECK_OK(rb_io_matrix_to_dense(&p.M));
    for (int k = 0; k < 9; k++)
        CHECK_ABS(p.M.dense[k], want[k], 0.0, "entry %d", k);
}

/* ---- Refusals --------------------------------------------------------------------- */

typedef rb_status reader(void);

static reader read_with_q, read_game, read_as_dense;
static char second[sizeof path + 2]; /* another file beside the first */

static void put_second(const char *text)
{
    snprintf(second, sizeof second, "%s-q", path);
    FILE *f = fopen(second, "wb");
    fputs(text, f);
    fclose(f);
}

static rb_status read_lcp(void)
{
    OWNED(rb_io_lcp) p;
    const rb_status s = rb_io_siconos_read_lcp(path, &p, &message);
    if (s != RB_OK)
        assert_null(p.q);
    return s;
}

static rb_status read_any_lcp(void)
{
    OWNED(rb_io_lcp) p;
    const rb_status s = rb_io_lcp_read(path, NULL, &p, &message);
    if (s != RB_OK)
        assert_null(p.q);
    return s;
}

static rb_status read_friction(void)
{
    OWNED(rb_io_friction) p;
    return rb_io_siconos_read_friction(path, 0, &p, &message);
}

static rb_status read_soclcp(void)
{
    OWNED(rb_io_soclcp) p;
    return rb_io_siconos_read_soclcp(path, &p, &message);
}

/* One contact in space on three of four degrees of freedom, as Siconos writes it. */
static const char GLOBAL[] =
    "3\n1\n2\n4\n4\n1\nCSparse Version 3.2.0\ntriplet: 4-by-4, nzmax: 4 nnz: 4\n"
    " 0 0 : 2\n 1 1 : 3\n 2 2 : 4\n 3 3 : 5\n"
    "0\n4\n3\n4\t3\n 1 0 0 0\n 0 0 1 0\n 0 0 0 1\n"
    "-9.81 0 3 0\n0 0.5 0\n0.4\n";

TEST(global_friction_problems)
{
    OWNED(rb_io_friction) g;
    rb_io_siconos_kind kind;
    OWNED(rb_sparse) H;
    put(GLOBAL);
    CHECK_OK(rb_io_siconos_guess(path, &kind, NULL));
    assert_int_equal(kind, RB_IO_SICONOS_FRICTION_GLOBAL);
    CHECK_OK(rb_io_siconos_read_friction(path, 1, &g, NULL));
    assert_int_equal(g.M.rows, 4);
    assert_int_equal(g.H.cols, 3);
    CHECK_ABS(g.f[0], -9.81, 0.0, "f");
    CHECK_ABS(g.w[1], 0.5, 0.0, "w");
    CHECK_ABS(g.mu[0], 0.4, 0.0, "mu");
    CHECK_OK(rb_io_matrix_to_sparse(&g.H, &H));
    const int row[] = {0, 2, 3};
    for (int j = 0; j < 3; j++) {
        assert_int_equal(H.p[j], j);
        assert_int_equal(H.i[j], row[j]);
    }
}

static rb_status read_global(void)
{
    OWNED(rb_io_friction) g;
    return rb_io_siconos_read_friction(path, 1, &g, &message);
}

static rb_status read_market(void)
{
    OWNED(rb_io_matrix) m;
    return rb_io_matrix_market_read(path, &m, &message);
}

static rb_status guess(void)
{
    rb_io_siconos_kind kind;
    return rb_io_siconos_guess(path, &kind, &message);
}

static void check_refused(reader *read, const char *text, const char *words)
{
    put(text);
    message.text[0] = 0;
    CHECK_STATUS(read(), RB_EFORMAT);
    if (!strstr(message.text, words) || strncmp(message.text, path, strlen(path)))
        fail_msg("expected '%s' after the path in: %s", words, message.text);
}

TEST(what_is_wrong_is_named_with_its_line)
{
    check_refused(read_lcp, "", ":1: n: expected an integer >= 1, the file ends");
    check_refused(read_lcp, "abc", ":1: n: expected an integer >= 1, got 'abc'");
    check_refused(read_lcp, "0 0 0 0", "n: expected an integer >= 1");
    check_refused(read_lcp, "-3", "got '-3'");
    check_refused(read_lcp, "99999999999999999999", "got '99999999999999999999'");
    check_refused(read_lcp, "2.5", "got '2.5'");
    check_refused(read_global, "2 1 0 3 4", ":1: columns of the matrix: expected 3, got '4'");
    check_refused(read_global, "2 1 0 1 1 1 1 5\n0 1 3", ":2: columns of the matrix");
    check_refused(read_global, "2 1 0 1 1 1 1 5\n0 1 2 1 2 1 0\n3\n0 0", ":4: mu: expected 1");
    check_refused(read_lcp, "2\n\n7", ":3: storage of the matrix: expected an integer from 0 to 2");
    check_refused(read_lcp, "2 0 2 3", "columns of the matrix: expected 2, got '3'");
    check_refused(read_lcp, "2 0 2 2 2 1", "columns of the dense matrix");
    check_refused(read_lcp, "2 0 2 2 2 2\n1 2\n3 x\n5 6",
                  ":3: matrix, number 4: expected a finite number, got 'x'");
    check_refused(read_lcp, "2 0 2 2 2 2\n1 2 3 4\n5", "q: expected 2 numbers");
    check_refused(read_lcp, "2 0 2 2 2 2\n1 2 3 4\n5      ",
                  "q, number 2: expected a finite number, the file ends");
    check_refused(read_lcp, "2 0 2 2 2 2 1 2 3 nan 5 6", "got 'nan'");
    check_refused(read_lcp, "2 0 2 2 2 2 1 2 3 -inf 5 6", "got '-inf'");
    check_refused(read_lcp, "2 0 2 2 2 2 1 2 3 1e999 5 6", "got '1e999'");
    check_refused(read_lcp, "2 0 2 2 2 2 1 2 3 4;5 5 6", "got '4;5'");
    check_refused(read_lcp, "2000000000 0 2000000000 2000000000 2000000000 2000000000 1",
                  "room for");
    check_refused(read_friction, "2 715827883", /* three of each are no int */
                  "number of contacts: expected an integer from 0 to 715827882");
    check_refused(read_friction, "3 715827882 0",
                  "rows of the matrix: expected 2147483646, the file ends");
    check_refused(read_friction, "4 1", "dimension: expected an integer from 2 to 3");
    check_refused(read_friction, "2 1 0 2 2 2 2 2 0 1 3 -5 -6 0.5 2", "after the last number");
    check_refused(read_friction, "2 1 0 2 2 2 2 2 0 1 3 -5 -6 0.5 1 1", "end of the file");
    check_refused(read_soclcp, "2 3", "number of cones: expected an integer from 1 to 2");
    check_refused(read_soclcp, "2 2 0 2 2 2 2 2 0 1 3 -5 -6 0 2 2 0.5 0.25", "start of the cones");
    check_refused(read_soclcp, "2 2 0 2 2 2 2 2 0 1 3 -5 -6 1 1 2 0.5 0.25", "start of the cones");
    check_refused(read_soclcp, "2 2 0 2 2 2 2 2 0 1 3 -5 -6 0 1 2 0.5 0.25 7",
                  "after the last number: expected an integer from 0 to 1, got '7'");
    check_refused(guess, "5 5 5 5 5", "no known kind");
    check_refused(guess, "2 1 0 2", "size at the head: expected an integer >= 0");
}

TEST(blocks_and_columns_must_fit)
{
    check_refused(read_lcp, "2 1 2 2 1 1 1 3 2 2 1 0 1 0 0 1 2 3 4 -5 -6",
                  "cumulated block sizes: expected an integer from 1 to 2, got '3'");
    check_refused(read_lcp, "2 1 2 2 1 1 1 1 2 2 1 0 1 0 0 1 2 3 4 -5 -6",
                  "expected the last to be 2");
    check_refused(read_lcp, "2 1 2 2 1 1 1 2 2 3 1 0 1 0", "length of the first index");
    check_refused(read_lcp, "2 1 2 2 1 1 1 2 2 2 1 0 2 0 0 1 2 3 4 -5 -6", "first index");
    check_refused(read_lcp, "2 1 2 2 1 1 1 2 2 2 1 0 1 1 0 1 2 3 4 -5 -6", "second index");
    check_refused(read_lcp, "2 1 2 2 1 1 1 2 2 2 1 0 1 0 1 1 2 3 4 -5 -6",
                  "number of the block: expected 0, got '1'");
    check_refused(read_lcp, "2 2 2 2 3", "origin");
    check_refused(read_lcp, "2 2 2 2 1\nCSparse\ntriplet: 3-by-2, nzmax: 1 nnz: 1\n0 0 : 1\n1 1",
                  "expected 2-by-2,");
    check_refused(read_lcp, "2 2 2 2 1\nCSparse\ntriplet: 2-by-2, nzmax: 1 nnz: 1\n0 2 : 1\n1 1",
                  ":4: column: expected an integer from 0 to 1, got '2'");
    check_refused(read_lcp,
                  "2 2 2 2 2\nCSparse\n2-by-2, nzmax: 1 nnz: 1,\n"
                  "col 0 : locations 0 to 5\n0 : 1\n1 1",
                  ":4: location");
    check_refused(read_lcp,
                  "2 2 2 2 2\nCSparse\n2-by-2, nzmax: 1 nnz: 1,\n"
                  "col 0 : locations 0 to 1\n0 : 1\n1 : 1\n1 1",
                  ":4: location: expected an integer from -1 to 0, got '1'");
    check_refused(read_lcp,
                  "2 2 2 2 2\nCSparse\n2-by-2, nzmax: 1 nnz: 2,\n"
                  "col 0 : locations 0 to 0\n0 : 1\ncol 1 : locations 1 to 0\n1 1",
                  "expected 2 entries, got 1");
    check_refused(read_lcp,
                  "2 2 2 2 2\nCSparse\n2-by-2, nzmax: 1 nnz: 1,\n"
                  "col 0 : locations 0 to 0\n2 : 1\ncol 1 : locations 1 to 0\n1 1",
                  ":5: row: expected an integer from 0 to 1, got '2'");
}

/* Files of a few bytes that speak of gigabytes, or of sizes whose sums and products are
 * no integers any more. */
TEST(absurd_sizes_are_refused)
{
    check_refused(read_market, "%%MatrixMarket matrix array real general\n2147483647 0\n",
                  ":2: a matrix of 2147483647 by 0 has no entries");
    check_refused(read_market, "%%MatrixMarket matrix array real general\n0 2147483647\n",
                  "a matrix of 0 by 2147483647 has no entries");
    check_refused(read_lcp, "2147483647 1 2147483647 2147483647 1 2147483647 2147483647 1",
                  "room for");
    check_refused(read_soclcp,
                  "2147483647 2147483647 2 2147483647 2147483647 1\nCSparse\n"
                  "triplet: 2147483647-by-2147483647, nzmax: 0 nnz: 0\n1",
                  "room for");
    /* 64 blocks of 2^29 x 2^29 entries: 2^64 in all */
    char text[2000] = "1073741824 1 1073741824 1073741824\n64 2 2 "
                      "536870912 1073741824 536870912 1073741824 3 64 0 64 64";
    for (int k = 0; k < 64; k++)
        strcat(text, " 0");
    strcat(text, " 0 1 2 3 4 5 6 7 8 9");
    check_refused(read_lcp, text, "more than 2147483647 entries");
}

/* Every file cut short is refused (a comment may be cut), and no file with one byte
 * changed does worse than that. */
TEST(damaged_files_are_refused_or_read)
{
    const char *texts[] = {DENSE, BLOCK, TRIPLET, COLUMN, FRICTION, SOCLCP, BLOCK, PLAIN};
    reader *read[] = {read_lcp,      read_lcp,    read_lcp,     read_lcp,
                      read_friction, read_soclcp, read_any_lcp, read_any_lcp};
    const char bytes[] = {'0', '9', '-', ' ', '\n', 'e', 0, '\xff', ':', '7'};
    for (int k = 0; k < 8; k++) {
        const size_t n = strlen(texts[k]);
        SCRATCH char *text = strdup(texts[k]);
        for (size_t i = 0; i < n; i++) {
            put_bytes(text, i);
            const rb_status cut = read[k]();
            /* the first words of a file by blocks alone are a plain file */
            if (i + 4 < n && texts[k] != DENSE && k != 6)
                CHECK_STATUS(cut, RB_EFORMAT);
            for (size_t b = 0; b < sizeof bytes; b++) {
                text[i] = bytes[b];
                put_bytes(text, n);
                const rb_status s = read[k]();
                assert_true(s == RB_OK || s == RB_EFORMAT);
            }
            text[i] = texts[k][i];
        }
    }
}

TEST(missing_files_and_folders)
{
    rb_io_lcp p;
    CHECK_SAYS(rb_io_siconos_read_lcp("/nowhere/at all", &p, &message), RB_ENOENT,
               "/nowhere/at all");
    CHECK_STATUS(rb_io_siconos_read_lcp("/tmp", &p, &message), RB_ENOENT);
}

TEST(short_memory_is_reported)
{
    static const char ARRAY[] = "%%MatrixMarket matrix array real symmetric\n2 2\n1 2 3\n",
                      ENTRIES[] = "%%MatrixMarket matrix coordinate real general\n"
                                  "2 2 2\n1 1 1\n2 2 3\n",
                      COLUMN_Q[] = "%%MatrixMarket matrix coordinate real general\n"
                                   "2 1 2\n1 1 5\n2 1 -6\n";
    const char *texts[] = {DENSE, BLOCK, TRIPLET, COLUMN,  FRICTION, SOCLCP,
                           BLOCK, PLAIN, ARRAY,   ENTRIES, ARRAY,    "1 1 2 3"};
    reader *read[] = {read_lcp,      read_lcp,      read_lcp,     read_lcp,
                      read_friction, read_soclcp,   read_any_lcp, read_any_lcp,
                      read_as_dense, read_as_dense, read_with_q,  read_game};
    put_second(COLUMN_Q);
    for (int k = 0; k < 12; k++) {
        put(texts[k]);
        for (int i = 0;; i++) {
            alloc_fail_after(i);
            const rb_status s = read[k]();
            const int refused = alloc_failed();
            alloc_succeed();
            if (!refused) {
                CHECK_OK(s);
                break;
            }
            if (s != RB_OK) /* stdio copes without its buffer */
                CHECK_STATUS(s, RB_ENOMEM);
        }
    }
    unlink(second);
}

/* ---- Matrix Market ----------------------------------------------------------------- */

TEST(market_gives_back_the_same_numbers)
{
    const double x[] = {0.1 + 0.2, -0.0, 1e-300, NAN, 2.0, M_PI, 1e300, NAN};
    OWNED(rb_io_matrix) m;
    CHECK_OK(rb_io_matrix_market_write(path, (rb_io_dense){3, 2, x, 4}, "a comment", &message));
    CHECK_OK(rb_io_matrix_market_read(path, &m, &message));
    assert_int_equal(m.rows, 3);
    assert_int_equal(m.cols, 2);
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 3; i++)
            CHECK_ABS(m.dense[i + 3 * j], x[i + 4 * j], 0.0, "entry %d, %d", i, j);
}

/* Of skew-symmetric ones the triangle below the diagonal is written. */
TEST(skew_symmetric_markets_are_read)
{
    static const char *const files[] = {
        "%%MatrixMarket matrix array real skew-symmetric\n3 3\n1 2 3\n",
        "%%MatrixMarket matrix coordinate real skew-symmetric\n3 3 4\n2 1 1\n3 1 2\n3 2 3\n"
        "1 1 0\n"};
    static const double want[] = {0, 1, 2, -1, 0, 3, -2, -3, 0}; /* columns */
    for (int k = 0; k < 2; k++) {
        OWNED(rb_io_matrix) m;
        put(files[k]);
        CHECK_OK(rb_io_matrix_market_read(path, &m, &message));
        CHECK_OK(rb_io_matrix_to_dense(&m));
        for (int i = 0; i < 9; i++)
            CHECK_ABS(m.dense[i], want[i], 0.0, "file %d, entry %d", k, i);
    }
    check_refused(read_market,
                  "%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n2 2 3\n",
                  "a skew-symmetric matrix has no diagonal, got 3 in row 2");
    check_refused(read_market, "%%MatrixMarket matrix array real skew-symmetric\n2 2\n1 2\n",
                  "end of the file");
}

/* The four kinds give the same matrix. */
TEST(market_kinds)
{
    static const char *const files[] = {
        "%%MatrixMarket matrix array real general\n2 2\n4 -1 -1 3\n",
        "%%MatrixMarket MATRIX Array Integer Symmetric\n% c\n2 2\n4 -1 3\n",
        "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 4\n2 1 -1\n1 2 -1\n2 "
        "2 3\n",
        "%%MatrixMarket matrix coordinate integer symmetric\n2 2 3\n1 1 4\n2 1 -1\n2 2 "
        "3\n"};
    const double want[] = {4.0, -1.0, -1.0, 3.0};
    for (int k = 0; k < 4; k++) {
        OWNED(rb_io_matrix) m;
        put(files[k]);
        CHECK_OK(rb_io_matrix_market_read(path, &m, &message));
        CHECK_OK(rb_io_matrix_to_dense(&m));
        for (int i = 0; i < 4; i++)
            CHECK_ABS(m.dense[i], want[i], 0.0, "file %d, entry %d", k, i);
    }
}

/* What Siconos writes of other kinds, and what stands behind q. */
TEST(other_kinds_of_siconos_are_named)
{
    static const char LCP[] = "2 0 2 2 2 2 2 0 1 3 -5 -6";
    static const struct {
        const char *behind, *words;
    } all[] = {{" 0 0 1 1", "a relay problem of Siconos, expected an LCP"},
               {" 7", "expected the end of the file or a comment after q, got 1 number"},
               {" 7 8 9\nMurty 1988", "after q, got 3 numbers"}};
    char text[100];
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        snprintf(text, sizeof text, "%s%s", LCP, all[k].behind);
        check_refused(read_any_lcp, text, all[k].words);
    }
    snprintf(text, sizeof text, "%s\nMurty 1988", LCP);
    put(text);
    CHECK_OK(read_any_lcp());
    check_refused(read_any_lcp, "1 1 2\n1 2\n3 4\n5 6\n", "a mixed LCP (MLCP) of Siconos");
    check_refused(read_any_lcp, "5 1 0 5 5", "a problem of rolling friction of Siconos");
}

TEST(market_refusals)
{
    const double x[4] = {0.0};
    check_refused(read_market, "", "MatrixMarket");
    check_refused(read_market, "%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1\n",
                  "array|coordinate real|integer general|symmetric");
    check_refused(read_market, "%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 1\n",
                  ":3: row: expected an integer from 1 to 2, got '3'");
    check_refused(read_market,
                  "%%MatrixMarket matrix coordinate real general\n2 2 2000000000\n1 1 1\n",
                  "entries: expected");
    check_refused(read_market, "%%MatrixMarket matrix array real symmetric\n2 3\n1 1 1\n",
                  "symmetric matrix of 2 by 3");
    check_refused(read_market, "%%MatrixMarket matrix array real general\n% c\n2 x\n",
                  ":3: columns");
    check_refused(read_market, "%%matrixmarket matrix array real general\n1 4\n5\n", "room for 2");
    check_refused(read_market, "%%matrixmarket matrix array real general\n1 1\n5\n6\n",
                  "end of the file");
    CHECK_STATUS(rb_io_matrix_market_write(path, (rb_io_dense){3, 1, x, 2}, NULL, &message),
                 RB_EINVAL);
    CHECK_STATUS(rb_io_matrix_market_write("/nowhere/m", (rb_io_dense){2, 1, x, 2}, NULL, &message),
                 RB_EWRITE);
}

static void check_content(const char *wanted)
{
    char text[200];
    FILE *f = NOT_NULL(fopen(path, "r"));
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    fclose(f);
    assert_string_equal(text, wanted);
}

TEST(market_files_are_written_by_columns)
{
    const double x[] = {1.0, 2.0, NAN, 3.0, 4.0, NAN};
    static const rb_io_dense bad[] = {{-1, 1, NULL, 2}, {1, -1, NULL, 2}, {3, 1, NULL, 2}};
    CHECK_OK(rb_io_matrix_market_write(path, (rb_io_dense){2, 2, x, 3}, "words", NULL));
    check_content("%%MatrixMarket matrix array real general\n% words\n2 2\n1\n2\n3\n4\n");
    CHECK_OK(rb_io_matrix_market_write(path, (rb_io_dense){1, 2, x, 1}, NULL, NULL));
    check_content("%%MatrixMarket matrix array real general\n1 2\n1\n2\n");
    for (int k = 0; k < 3; k++) {
        CHECK_STATUS(rb_io_matrix_market_write(path, bad[k], NULL, &message), RB_EINVAL);
        assert_non_null(strstr(message.text, "with leading dimension 2"));
    }
    CHECK_OK(rb_io_matrix_market_write(path, (rb_io_dense){0, 0, x, 0}, NULL, NULL));
    check_content("%%MatrixMarket matrix array real general\n0 0\n");
}

/* Each word of the head, each size, and what stands behind. */
TEST(market_heads_are_taken_word_by_word)
{
    static const struct {
        const char *text, *words;
    } bad[] = {{"%%MatrixMarket vector array real general\n1 1\n1\n", ":1: expected the line"},
               {"%%MatrixMarket matrix heap real general\n1 1\n1\n", ":1: expected the line"},
               {"%%MatrixMarket matrix array complex general\n1 1\n1\n", ":1: expected the line"},
               {"%%MatrixMarket matrix array real hermitian\n1 1\n1\n", ":1: expected the line"},
               {"%%MatrixMarket matrix array real general\n-1 1\n1\n",
                ":2: rows: expected an integer >= 0, got '-1'"},
               {"%%MatrixMarket matrix coordinate real general\n1 1 -1\n",
                "number of entries: expected an integer >= 0, got '-1'"},
               {"%%MatrixMarket matrix coordinate real symmetric\n1 1 2147483647\n1 1 1",
                "number of entries: expected an integer from 0 to 1073741823"},
               {"%%MatrixMarket matrix coordinate real general\n2 3 2\n1 1 1\n1 4 1\n",
                ":4: column: expected an integer from 1 to 3, got '4'"},
               {"%%MatrixMarket matrix coordinate real general\n2 3 1\n0 1 1\n",
                ":3: row: expected an integer from 1 to 2, got '0'"},
               {"%%MatrixMarket matrix coordinate real general\n2 3 2\n1 1 1.000\n1 1",
                "value: expected a finite number, the file ends"},
               {"%%MatrixMarket matrix coordinate real general\n2 3 2\n1 1 1\n",
                "entries: expected 6 numbers, the rest of the file has room for"},
               {"%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n2",
                ":4: expected the end of the file"},
               {"%%MatrixMarket matrix array real symmetric\n3 3\n1 2 3 4 5 x\n",
                ":3: column of the triangle, number 1: expected a finite number, got 'x'"},
               {"%%MatrixMarket matrix array real symmetric\n30 30\n1 2 3 4 5 x\n",
                "matrix: expected 450 numbers"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        check_refused(read_market, bad[k].text, bad[k].words);
    OWNED(rb_io_matrix) m;
    put("%%MatrixMarket matrix coordinate real general\n2 3 0\n");
    CHECK_OK(rb_io_matrix_market_read(path, &m, &message));
    CHECK_OK(rb_io_matrix_to_dense(&m));
    for (int k = 0; k < 6; k++)
        CHECK_ABS(m.dense[k], 0.0, 0.0, "entry %d", k);
}

static rb_status read_as_dense(void)
{
    OWNED(rb_io_matrix) m;
    rb_status s = rb_io_matrix_market_read(path, &m, &message);
    if (s == RB_OK)
        s = rb_io_matrix_to_dense(&m);
    return s;
}

/* ---- LCPs, vectors, games ---------------------------------------------------------- */

static rb_status read_with_q(void)
{
    OWNED(rb_io_lcp) p;
    const rb_status s = rb_io_lcp_read(path, second, &p, &message);
    if (s == RB_OK) {
        assert_int_equal(p.n, 2);
        CHECK_ABS(p.q[0], 5.0, 0.0, "q");
        CHECK_ABS(p.q[1], -6.0, 0.0, "q");
    } else {
        assert_null(p.q);
    }
    return s;
}

static rb_status read_game(void)
{
    OWNED(rb_io_bimatrix) p;
    const rb_status s = rb_io_bimatrix_read(path, &p, &message);
    if (s != RB_OK)
        assert_true(!p.A && !p.B);
    return s;
}

static void refused_with(reader *read, const char *text, const char *q, const char *words)
{
    put(text);
    put_second(q);
    CHECK_STATUS(read(), RB_EFORMAT);
    if (!strstr(message.text, words))
        fail_msg("expected '%s' in: %s", words, message.text);
}

TEST(kinds_of_lcp_are_told_apart)
{
    static const char M[] = "%%MatrixMarket matrix array real general\n2 2\n1 2 3 4\n",
                      WIDE[] = "%%MatrixMarket matrix array real general\n1 2\n1 2\n";
    static const char *const q[] = {
        "5 -6", "# q\n5 # first\n-6", "%%MatrixMarket matrix array real general\n2 1\n5\n-6\n",
        "%%MatrixMarket matrix coordinate real general\n2 1 2\n2 1 -6\n1 1 5\n"};
    for (int k = 0; k < 4; k++) {
        put(M);
        put_second(q[k]);
        CHECK_OK(read_with_q());
    }
    refused_with(read_with_q, WIDE, "5 6", "M: expected a square matrix, got 1 by 2");
    refused_with(read_with_q, M, "5", "q: expected 2 numbers, got 1");
    refused_with(read_with_q, M, "5 6 7", "q: expected 2 numbers, got 3");
    refused_with(read_with_q, M, "5 inf", "expected a finite number, got 'inf'");
    refused_with(read_with_q, M, WIDE, "q: expected a matrix of 2 by 1, got 1 by 2");
    refused_with(read_with_q, M, M, "q: expected a matrix of 2 by 1, got 2 by 2");
    refused_with(read_with_q, PLAIN, "5 6", "this file holds q itself");
    refused_with(read_any_lcp, M, "", "q is wanted from a file of its own (--q)");
    refused_with(read_any_lcp, FRICTION, "", "a friction problem of Siconos");
    refused_with(read_any_lcp, SOCLCP, "", "a SOCLCP of Siconos, expected an LCP");
    refused_with(read_any_lcp, "1 2 3 4", "", "end of the file after n, n rows of M and");
    refused_with(read_any_lcp, "2\n1 x 3 4\n5 6", "", ":2: M, row 1, number 2");
    refused_with(read_any_lcp, "2\n1 2\n3 x\n5 6", "", ":3: M, row 2, number 2");
    refused_with(read_any_lcp, "-1", "", ":1: n: expected an integer >= 0, got '-1'");
    refused_with(read_any_lcp, "0 1", "", "expected the end of the file after n = 0");
    put("1 2");
    CHECK_STATUS(rb_io_lcp_read(path, NULL, &(rb_io_lcp){0}, NULL), RB_EFORMAT);
    CHECK_STATUS(rb_io_lcp_read("/nowhere/x", NULL, &(rb_io_lcp){0}, &message), RB_ENOENT);
    CHECK_STATUS(rb_io_lcp_read("/nowhere/x", path, &(rb_io_lcp){0}, &message), RB_ENOENT);
    /* the head of a friction problem, but n, n rows of M and q */
    OWNED(rb_io_lcp) p;
    put("2 1 0 2 2 -7 8");
    CHECK_OK(rb_io_lcp_read(path, NULL, &p, &message));
    static const double want[] = {1.0, 2.0, 0.0, 2.0};
    for (int k = 0; k < 4; k++)
        CHECK_ABS(p.M.dense[k], want[k], 0.0, "M, entry %d", k);
    CHECK_ABS(p.q[1], 8.0, 0.0, "q");
    unlink(second);
}

TEST(vectors_are_as_long_as_they_must)
{
    double *x;
    put("1 inf\n-Infinity # no bound");
    CHECK_OK(rb_io_bounds_read(path, 3, "the bounds", &x, &message));
    assert_true(x[0] == 1.0 && x[1] == INFINITY && x[2] == -INFINITY);
    free(x);
    CHECK_STATUS(rb_io_vector_read(path, 3, "the start", &x, &message), RB_EFORMAT);
    assert_non_null(
        strstr(message.text, ":1: the start, number 2: expected a finite number, got 'inf'"));
    assert_null(x);
    put("1 nan");
    CHECK_STATUS(rb_io_bounds_read(path, 2, "the bounds", &x, &message), RB_EFORMAT);
    assert_non_null(strstr(message.text, "expected a number, inf or -inf, got 'nan'"));
    CHECK_STATUS(rb_io_vector_read("/nowhere/x", 1, "x", &x, &message), RB_ENOENT);
    assert_null(x);
    put("0123456789012345678901234567890123456789-more");
    CHECK_STATUS(rb_io_vector_read(path, 1, "x", &x, &message), RB_EFORMAT);
    assert_non_null(strstr(message.text, "got '0123456789012345678901234567890123456789'"));
}

TEST(games_are_two_matrices)
{
    rb_io_bimatrix p;
    put("1, 1 # sizes\n3\n4");
    CHECK_OK(rb_io_bimatrix_read(path, &p, &message));
    assert_true(p.m == 1 && p.n == 1 && p.A[0] == 3.0 && p.B[0] == 4.0);
    rb_io_bimatrix_free(&p);
    put("2 3\n1 2 3\n4 5 6\n7 8 9\n10 11 12\n");
    CHECK_OK(rb_io_bimatrix_read(path, &p, &message));
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 3; j++) {
            CHECK_ABS(p.A[i + 2 * j], 1.0 + 3 * i + j, 0.0, "A");
            CHECK_ABS(p.B[i + 2 * j], 7.0 + 3 * i + j, 0.0, "B");
        }
    rb_io_bimatrix_free(&p);
    check_refused(read_game, "0 1\n1\n1", "m: expected an integer >= 1, got '0'");
    check_refused(read_game, "1 0\n1\n1", "n: expected an integer >= 1, got '0'");
    check_refused(read_game, "1 1\n1\n1\n1",
                  ":4: expected the end of the file after m, n, A and B (1 by 1)");
    check_refused(read_game, "1 2\n1 2\n3 x", ":3: B, row 1, number 2");
    check_refused(read_game, "2 1\n1\nx\n1\n1", ":3: A, row 2");
    CHECK_STATUS(rb_io_bimatrix_read("/nowhere/x", &p, &message), RB_ENOENT);
}

/* ---- Text -------------------------------------------------------------------------- */

TEST(texts_are_told_from_what_is_none)
{
    char *text;
    size_t size;
    put_bytes("\xff\xfe"
              "1\0",
              4);
    CHECK_STATUS(rb_io_read_text(path, &text, &size, &message), RB_EFORMAT);
    assert_non_null(strstr(message.text, ": UTF-16 text, expected ASCII or UTF-8"));
    assert_null(text);
    put_bytes("\xfe\xff\0"
              "1",
              4);
    CHECK_SAYS(rb_io_read_text(path, &text, &size, &message), RB_EFORMAT, "UTF-16");
    put_bytes("1\n2\n\0\n", 6);
    CHECK_STATUS(rb_io_read_text(path, &text, &size, &message), RB_EFORMAT);
    assert_non_null(strstr(message.text, ":3: a zero byte, expected text"));
    put_bytes("\xff", 1);
    CHECK_OK(rb_io_read_text(path, &text, &size, &message));
    assert_int_equal(size, 1);
    free(text);
    put("\xef\xbb\xbf"
        "1 2\n");
    CHECK_OK(rb_io_read_text(path, &text, &size, &message));
    assert_string_equal(text, "   1 2\n");
    free(text);
    CHECK_STATUS(rb_io_read_text("/tmp", &text, &size, &message), RB_ENOENT);
    assert_string_equal(message.text, "/tmp: Is a directory");
    if (access("/proc/self/mem", R_OK) == 0) { /* opens, and cannot be read at 0 */
        CHECK_STATUS(rb_io_read_text("/proc/self/mem", &text, &size, &message), RB_ENOENT);
        assert_string_equal(message.text, "/proc/self/mem: Input/output error");
        assert_null(text);
    }
    enum { LONG = 9000 }; /* more than two of its buffers */
    static char all[LONG + 1];
    memset(all, '7', LONG);
    for (int n = 4094; n <= LONG; n += n < 4098 ? 1 : 2451) {
        put_bytes(all, (size_t)n);
        CHECK_OK(rb_io_read_text(path, &text, &size, &message));
        assert_int_equal(size, (size_t)n);
        assert_memory_equal(text, all, (size_t)n);
        assert_int_equal(text[n], '\0');
        free(text);
    }
}

/* ---- The public collection --------------------------------------------------------- */

static void check_collection(const char *folder, rb_io_siconos_kind kind, reader *read, int least)
{
    char name[1400];
    int files = 0;
    const char *root = outside_data(folder);
    DIR *d = NOT_NULL(opendir(root));
    for (struct dirent *e = readdir(d); e; e = readdir(d)) {
        rb_io_siconos_kind got;
        if (!strstr(e->d_name, ".dat"))
            continue;
        snprintf(name, sizeof name, "%s/%s", root, e->d_name);
        remove(path);
        assert_int_equal(symlink(name, path), 0);
        CHECK_OK(rb_io_siconos_guess(path, &got, &message));
        assert_int_equal(got, kind);
        if (read() != RB_OK)
            fail_msg("%s: %s", name, message.text);
        files++;
    }
    closedir(d);
    assert_true(files >= least);
}

TEST(the_collection_is_read)
{
    check_collection("siconos/lcp", RB_IO_SICONOS_LCP, read_lcp, 9);
    check_collection("siconos/fc2d", RB_IO_SICONOS_FRICTION, read_friction, 5);
    check_collection("siconos/fc3d", RB_IO_SICONOS_FRICTION, read_friction, 7);
    check_collection("siconos/soclcp", RB_IO_SICONOS_SOCLCP, read_soclcp, 1);
}

RUN_TESTS(make_path, remove_path)
