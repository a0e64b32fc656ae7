/* Friction problems in the HDF5 files of FCLib, read in a process of its own. */
#include "base/io/io_fclib.h"

#include "base/io/child.h"
#include "base/io/io.h"

#include <hdf5.h>

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MATRICES = 6, VECTORS = 10, SOLUTION = 7 /* the first vector of it */ };

static const char *const MATRIX[MATRICES] = {"M", "H", "W", "G", "V", "R"},
                         *const VECTOR[VECTORS] = {"mu", "f", "w", "q", "mu_r",
                                                   "b",  "s", "r", "u", "v"};

/* All arrays of a problem, for what is done to each of them alike. */
typedef struct {
    rb_sparse *matrix[MATRICES];
    double **vector[VECTORS];
    int length[VECTORS];
} arrays;

static arrays arrays_of(rb_io_fclib *p)
{
    const int m = p->contacts * p->spacedim;
    return (arrays){
        .matrix = {&p->M, &p->H, &p->W, &p->G, &p->V, &p->R},
        .vector = {&p->mu, &p->f, &p->w, &p->q, &p->mu_r, &p->b, &p->s, &p->r, &p->u, &p->v},
        .length = {p->contacts, p->M.rows, m, m, p->contacts, p->constraints, p->constraints, m, m,
                   p->M.rows}};
}

void rb_io_fclib_free(rb_io_fclib *problem)
{
    if (!problem)
        return;
    const arrays all = arrays_of(problem);
    for (int k = 0; k < MATRICES; k++)
        rb_sparse_free(all.matrix[k]);
    for (int k = 0; k < VECTORS; k++)
        free(*all.vector[k]);
    *problem = (rb_io_fclib){0};
}

int rb_io_is_hdf5(const char *path)
{
    static const unsigned char signature[] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char head[sizeof signature];
    const int fd = open(path, O_RDONLY);
    if (fd < 0)
        return 0;
    const ssize_t got = read(fd, head, sizeof head);
    close(fd);
    return got == (ssize_t)sizeof head && !memcmp(head, signature, sizeof head);
}

/* ---- Reading ----------------------------------------------------------------------- */

/* Deflate makes at most so many bytes of one, and no array has more than that allows: the
 * memory for a file is bounded by its size. */
static const double EXPANSION = 1032.0;

typedef struct {
    const char *path;
    hid_t file;
    double most; /* bytes of an array, entries of a matrix's side */
    rb_message *why;
    int *unknown; /* 1: HDF5 could not tell whether something is there */
    int *linked;  /* 1: something is there by a link that could lead to another file */
} reader;

/* Every link on the way to name is there (H5Lexists wants them one by one), and each of
 * them is of this file: external links open others, and so can symbolic ones. */
static int exists(const reader *in, const char *name)
{
    char part[160];
    H5L_info_t link;
    const size_t length = strlen(name);
    for (size_t k = 1; k <= length; k++) {
        if (name[k] != '/' && name[k] != '\0')
            continue;
        snprintf(part, sizeof part, "%.*s", (int)k, name);
        const htri_t there = H5Lexists(in->file, part, H5P_DEFAULT);
        if (there < 0)
            *in->unknown = 1;
        if (there <= 0)
            return 0;
        if (H5Lget_info(in->file, part, &link, H5P_DEFAULT) < 0)
            *in->unknown = 1;
        else if (link.type != H5L_TYPE_HARD)
            *in->linked = 1;
        if (*in->unknown || *in->linked)
            return 0;
    }
    return 1;
}

/* The whole array, its length in n; type: what to convert to.  It must lie in this file, which
 * is large enough for it. */
static rb_status read_array(const reader *in, const char *name, hid_t type, size_t size, int *n,
                            void **values)
{
    const hid_t set = exists(in, name) ? H5Dopen2(in->file, name, H5P_DEFAULT) : -1;
    *n = 0;
    *values = NULL;
    if (set < 0)
        return rb_fail(in->why, RB_EFORMAT, "%s: no %s", in->path, name);
    const hid_t space = H5Dget_space(set), layout = H5Dget_create_plist(set),
                stored = H5Dget_type(set);
    const hssize_t points = H5Sget_simple_extent_npoints(space); /* or negative */
    const int outside = H5Pget_layout(layout) == H5D_VIRTUAL || H5Pget_external_count(layout) != 0;
    const double bytes = (double)points * (double)H5Tget_size(stored);
    rb_status s = RB_OK;
    H5Sclose(space);
    H5Pclose(layout);
    H5Tclose(stored);
    *n = (int)points;
    if ((uint64_t)points >= 1 << 30)
        s = rb_fail(in->why, RB_EFORMAT, "%s: %s: unreadable size", in->path, name);
    else if (outside)
        s = rb_fail(in->why, RB_EFORMAT, "%s: %s is kept in another file", in->path, name);
    else if (bytes > in->most)
        s = rb_fail(in->why, RB_EFORMAT,
                    "%s: %s has %g bytes: a file of this size holds at most %g", in->path, name,
                    bytes, in->most);
    else if (!(*values = malloc(size * (size_t)*n + 1)))
        s = RB_ENOMEM;
    else if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *values) < 0)
        s = rb_fail(in->why, RB_EFORMAT, "%s: %s cannot be read (truncated?)", in->path, name);
    H5Dclose(set);
    if (s != RB_OK) {
        free(*values);
        *values = NULL;
    }
    return s;
}

static rb_status read_int(const reader *in, const char *group, const char *name, int *value)
{
    char full[160];
    int n;
    void *values;
    snprintf(full, sizeof full, "%s/%s", group, name);
    rb_status s = read_array(in, full, H5T_NATIVE_INT, sizeof(int), &n, &values);
    if (s == RB_OK && n < 1)
        s = rb_fail(in->why, RB_EFORMAT, "%s: %s is empty", in->path, full);
    if (s == RB_OK)
        *value = *(int *)values;
    free(values);
    return s;
}

static rb_status read_values(const reader *in, const char *group, const char *name, hid_t type,
                             int least, void **values)
{
    char full[160];
    int n;
    snprintf(full, sizeof full, "%s/%s", group, name);
    const rb_status s = read_array(in, full, type, H5Tget_size(type), &n, values);
    if (s == RB_OK && n < least)
        return rb_fail(in->why, RB_EFORMAT, "%s: %s: expected %d %s, got %d", in->path, full, least,
                       least == 1 ? "entry" : "entries", n);
    return s;
}

static rb_status read_ints(const reader *in, const char *group, const char *name, int least,
                           int **values)
{
    return read_values(in, group, name, H5T_NATIVE_INT, least, (void **)values);
}

static rb_status read_doubles(const reader *in, const char *group, const char *name, int least,
                              double **values)
{
    return read_values(in, group, name, H5T_NATIVE_DOUBLE, least, (void **)values);
}

static rb_status read_matrix(const reader *in, const char *root, const char *name, rb_sparse *a)
{
    char group[80];
    int m, n, nz;
    snprintf(group, sizeof group, "%s/%s", root, name);
    rb_status s = read_int(in, group, "m", &m);
    if (s == RB_OK)
        s = read_int(in, group, "n", &n);
    if (s == RB_OK)
        s = read_int(in, group, "nz", &nz);
    if (s != RB_OK)
        return s;
    if (m < 1 || n < 1 || fmax(m, n) > fmin(in->most, 1 << 28) || nz < -2)
        return rb_fail(in->why, RB_EFORMAT, "%s: %s is %d x %d with nz = %d", in->path, group, m, n,
                       nz);
    /* Triplet: i holds rows and p columns, as CSparse writes them (fclib.h says the
     * opposite). nzmax may exceed what is stored. */
    const int lines = nz == -1 ? n : m;
    int *p = NULL, *i = NULL, *wide = NULL;
    double *x = NULL;
    s = read_ints(in, group, "p", nz < 0 ? lines + 1 : nz, &p);
    const int entries = nz < 0 && s == RB_OK ? p[lines] : nz;
    if (s == RB_OK && entries < 0)
        s = rb_fail(in->why, RB_EFORMAT, "%s: %s/p ends in %d", in->path, group, entries);
    if (s == RB_OK)
        s = read_ints(in, group, "i", entries, &i);
    if (s == RB_OK)
        s = read_doubles(in, group, "x", entries, &x);
    if (s == RB_OK && nz < 0) {
        /* Pointers of compressed columns (rows) -> a column (row) number per entry. */
        wide = rb_alloc_int((size_t)entries);
        s = wide ? RB_OK : RB_ENOMEM;
    }
    for (int j = 0; wide && j < lines && s == RB_OK; j++)
        if (p[j] < 0 || p[j] > p[j + 1] || p[j + 1] > entries)
            s = rb_fail(in->why, RB_EFORMAT, "%s: %s/p does not increase", in->path, group);
        else
            for (int k = p[j]; k < p[j + 1]; k++)
                wide[k] = j;
    if (s == RB_OK) {
        const rb_triplets t = {.rows = m,
                               .cols = n,
                               .nz = entries,
                               .row = nz == -2 ? wide : i,
                               .col = nz == -2   ? i
                                      : nz == -1 ? wide
                                                 : p,
                               .x = x};
        s = rb_sparse_from_triplets(&t, a);
        if (s == RB_EINVAL)
            s = rb_fail(in->why, RB_EFORMAT, "%s: %s: index out of range for %d x %d", in->path,
                        group, m, n);
    }
    free(x);
    free(wide);
    free(i);
    free(p);
    return s;
}

/* Only one triangle is stored: add the other. */
static rb_status complete_symmetric(rb_sparse *a)
{
    int below = 0, above = 0;
    for (int j = 0; j < a->cols; j++)
        for (int k = a->p[j]; k < a->p[j + 1]; k++) {
            below |= a->i[k] > j;
            above |= a->i[k] < j;
        }
    if (below == above || a->rows != a->cols)
        return RB_OK;
    rb_triplets t = {.rows = a->rows, .cols = a->cols};
    rb_sparse full = {0};
    for (int j = 0; j < a->cols; j++)
        for (int k = a->p[j]; k < a->p[j + 1]; k++) {
            rb_triplets_add(&t, a->i[k], j, a->x[k]);
            if (a->i[k] != j)
                rb_triplets_add(&t, j, a->i[k], a->x[k]);
        }
    const rb_status s = rb_sparse_from_triplets(&t, &full);
    rb_triplets_free(&t);
    if (s == RB_OK) {
        rb_sparse_free(a);
        *a = full;
    }
    return s;
}

static int has(const reader *in, const char *root, const char *name)
{
    char path[80];
    snprintf(path, sizeof path, "%s/%s", root, name);
    return exists(in, path);
}

/* A vector of the group, at least as long as it has to be in this problem. */
static rb_status read_vector(const reader *in, const char *group, const char *name, rb_io_fclib *p)
{
    const arrays all = arrays_of(p);
    int k = 0;
    while (strcmp(VECTOR[k], name) != 0)
        k++;
    return read_doubles(in, group, name, all.length[k], all.vector[k]);
}

/* A matrix of constraints, a column for each; those of a problem have equally many. */
static rb_status read_columns(const reader *in, const char *root, const char *name, int rows,
                              int *count, rb_sparse *a)
{
    const rb_status s = read_matrix(in, root, name, a);
    if (s == RB_OK && (a->rows != rows || (*count && a->cols != *count)))
        return rb_fail(in->why, RB_EFORMAT, "%s: %s/%s is %d x %d, expected %d x %d", in->path,
                       root, name, a->rows, a->cols, rows, *count ? *count : a->cols);
    if (s == RB_OK)
        *count = a->cols;
    return s;
}

static const char *root_of(const rb_io_fclib *p)
{
    return p->rolling ? "/fclib_global_rolling" : p->global ? "/fclib_global" : "/fclib_local";
}

static rb_status read_file(const reader *in, rb_io_fclib *p)
{
    if (exists(in, "/fclib_local_rolling"))
        return rb_fail(in->why, RB_EFORMAT,
                       "%s: rolling friction in the local form is not supported, only in "
                       "the global one",
                       in->path);
    p->rolling = exists(in, "/fclib_global_rolling");
    p->global = p->rolling || (!exists(in, "/fclib_local") && exists(in, "/fclib_global"));
    const char *root = root_of(p);
    if (!exists(in, root))
        return rb_fail(in->why, RB_EFORMAT, "%s: HDF5, but holds no FCLib problem", in->path);
    char vectors[60], columns_of[60];
    int height = 1, columns;
    snprintf(vectors, sizeof vectors, "%s/vectors", root);
    snprintf(columns_of, sizeof columns_of, "%s/%s", root, p->global ? "H" : "W");
    /* The columns of H or W: without any there is no contact, and nothing to solve. */
    rb_status s = read_int(in, columns_of, "n", &columns);
    if (s == RB_OK && !p->global)
        s = read_int(in, columns_of, "m", &height);
    if (s != RB_OK || (columns == 0 && (p->global || height == 0)))
        return s == RB_OK ? read_int(in, root, "spacedim", &p->spacedim) : s;
    /* The matrices, */
    if (p->global) {
        s = read_matrix(in, root, "M", &p->M);
        if (s == RB_OK)
            s = complete_symmetric(&p->M);
        if (s == RB_OK)
            s = read_matrix(in, root, "H", &p->H);
        if (s == RB_OK && (p->M.rows != p->M.cols || p->M.rows != p->H.rows))
            s = rb_fail(in->why, RB_EFORMAT, "%s: M is %d x %d and H is %d x %d", in->path,
                        p->M.rows, p->M.cols, p->H.rows, p->H.cols);
    } else {
        s = read_matrix(in, root, "W", &p->W);
        if (s == RB_OK && p->W.rows != p->W.cols)
            s = rb_fail(in->why, RB_EFORMAT, "%s: W is %d x %d", in->path, p->W.rows, p->W.cols);
    }
    /* the contacts, */
    const int rows = p->global ? p->H.cols : p->W.rows;
    if (s == RB_OK)
        s = read_int(in, root, "spacedim", &p->spacedim);
    if (s == RB_OK && (p->rolling ? p->spacedim != 5 : p->spacedim != 2 && p->spacedim != 3))
        s = rb_fail(in->why, RB_EFORMAT, "%s: spacedim is %d, expected %s", in->path, p->spacedim,
                    p->rolling ? "5" : "2 or 3");
    if (s == RB_OK && rows % p->spacedim)
        s = rb_fail(in->why, RB_EFORMAT, "%s: %d contact rows are no multiple of %d", in->path,
                    rows, p->spacedim);
    if (s != RB_OK)
        return s;
    p->contacts = rows / p->spacedim;
    s = read_vector(in, vectors, "mu", p);
    if (s == RB_OK && p->rolling)
        s = read_vector(in, vectors, "mu_r", p);
    if (s == RB_OK)
        s = read_vector(in, vectors, p->global ? "f" : "q", p);
    if (s == RB_OK && p->global)
        s = read_vector(in, vectors, "w", p);
    /* constraints: M v = H r + G l + f, G' v + b = 0 or u = W r + V l + q, V' r + R l + s = 0, */
    if (s == RB_OK && p->global && (has(in, root, "G") || has(in, vectors, "b"))) {
        s = read_columns(in, root, "G", p->M.rows, &p->constraints, &p->G);
        if (s == RB_OK)
            s = read_vector(in, vectors, "b", p);
    } else if (s == RB_OK && !p->global &&
               (has(in, root, "V") || has(in, root, "R") || has(in, vectors, "s"))) {
        s = read_columns(in, root, "V", p->W.rows, &p->constraints, &p->V);
        if (s == RB_OK)
            s = read_columns(in, root, "R", p->constraints, &p->constraints, &p->R);
        if (s == RB_OK)
            s = complete_symmetric(&p->R);
        if (s == RB_OK)
            s = read_vector(in, vectors, "s", p);
    }
    /* and what is there of a solution; v: of the global form alone. */
    for (int k = SOLUTION; k < VECTORS - !p->global && s == RB_OK; k++)
        if (has(in, "/solution", VECTOR[k]))
            s = read_vector(in, "/solution", VECTOR[k], p);
    return s;
}

/* ---- HDF5 in a process of its own -------------------------------------------------- */

/* It crashes where memory is short and on damaged files, and says of both the same. */

static herr_t look_for_memory(unsigned n, const H5E_error2_t *error, void *found)
{
    (void)n;
    if (error->maj_num == H5E_RESOURCE || error->min_num == H5E_NOSPACE ||
        error->min_num == H5E_CANTALLOC)
        *(int *)found = 1;
    return 0;
}

/* Called by HDF5 for each of its errors, which it would print otherwise. */
static herr_t note_error(hid_t stack, void *no_memory)
{
    return H5Ewalk2(stack, H5E_WALK_DOWNWARD, look_for_memory, no_memory);
}

/* ---- From the child to the parent -------------------------------------------------- */

/* An array as it lies in memory, where there is one: written as it is, or read into memory of
 * its own, NULL after a failure. */
static void *pass(FILE *f, int reads, int *ok, void *x, size_t size, size_t n)
{
    if (!x)
        return NULL;
    if (!reads) {
        *ok &= fwrite(x, size, n, f) == n;
        return x;
    }
    void *own = *ok ? malloc(size * n + 1) : NULL;
    *ok = own && fread(own, size, n, f) == n;
    return own;
}

/* The problem and all its arrays; when it is read, the pointers of the child tell which there
 * are.  0: not all of them. */
static int pass_problem(FILE *f, int reads, rb_io_fclib *p)
{
    int ok = 1;
    if ((reads ? fread(p, sizeof *p, 1, f) : fwrite(p, sizeof *p, 1, f)) != 1) {
        *p = (rb_io_fclib){0};
        return 0;
    }
    const arrays all = arrays_of(p);
    for (int k = 0; k < MATRICES; k++) {
        rb_sparse *a = all.matrix[k];
        a->p = pass(f, reads, &ok, a->p, sizeof *a->p, (size_t)a->cols + 1);
        const size_t entries = a->p && ok ? (size_t)a->p[a->cols] : 0;
        a->i = pass(f, reads, &ok, a->i, sizeof *a->i, entries);
        a->x = pass(f, reads, &ok, a->x, sizeof *a->x, entries);
    }
    for (int k = 0; k < VECTORS; k++)
        *all.vector[k] = pass(f, reads, &ok, *all.vector[k], sizeof(double), (size_t)all.length[k]);
    return ok;
}

static rb_status read_in_child(FILE *out, const void *path, rb_message *why)
{
    rb_io_fclib p = {0};
    int no_memory = 0, unknown = 0, linked = 0;
    struct stat file = {0};
    stat(path, &file);
    H5PLset_loading_state(0); /* filters are its own, none is loaded */
    if (H5Eset_auto2(H5E_DEFAULT, note_error, &no_memory) < 0) /* its first call */
        no_memory = 1;
    const reader in = {path,
                       H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT),
                       EXPANSION * (double)file.st_size,
                       why,
                       &unknown,
                       &linked};
    rb_status s = in.file < 0
                      ? rb_fail(why, RB_EFORMAT, "%s: HDF5 cannot open it (truncated?)", in.path)
                      : read_file(&in, &p);
    if (s == RB_OK && unknown)
        s = rb_fail(why, RB_EFORMAT, "%s: HDF5 cannot search it (truncated?)", in.path);
    if (linked)
        s = rb_fail(why, RB_EFORMAT, "%s: has links, which are not followed", in.path);
    void *probe = malloc(1 << 16); /* it may not even have had room for its errors */
    if (no_memory || s == RB_ENOMEM || !probe)
        return rb_fail(why, RB_ENOMEM, "%s: out of memory", in.path);
    free(probe);
    if (s != RB_OK)
        return s;
    pass_problem(out, 0, &p); /* what is missing, the parent notices */
    return RB_OK;
}

rb_status rb_io_fclib_read(const char *path, rb_io_fclib *problem, rb_message *why)
{
    char *bytes;
    size_t size;
    *problem = (rb_io_fclib){0};
    if (access(path, R_OK) != 0)
        return rb_fail(why, RB_ENOENT, "%s: %s", path, strerror(errno));
    if (!rb_io_is_hdf5(path))
        return rb_fail(why, RB_EFORMAT, "%s: not an HDF5 file", path);
    rb_status s = rb_io_in_child(path, read_in_child, path, &bytes, &size, why);
    /* HDF5 also calls a file bad after some allocations that fail; a file that is bad, it
     * refuses again */
    if (s == RB_EFORMAT)
        s = rb_io_in_child(path, read_in_child, path, &bytes, &size, why);
    FILE *in = s == RB_OK ? fmemopen(bytes, size, "rb") : NULL;
    if (s == RB_OK && !(in && pass_problem(in, 1, problem))) {
        rb_io_fclib_free(problem);
        s = rb_fail(why, RB_ENOMEM, "%s: out of memory", path);
    }
    if (in)
        fclose(in);
    free(bytes);
    return s;
}

/* ---- Writing ----------------------------------------------------------------------- */

/* Called by HDF5 for each of its errors, so that no call is asked whether it failed; a
 * call with what an earlier one did not give is one more error. */
static herr_t note_failure(hid_t stack, void *failed)
{
    (void)stack;
    *(int *)failed = 1;
    return 0;
}

/* n values, or a text of n characters. */
static void write_set(hid_t parent, const char *name, hid_t type, hid_t space, int n,
                      const void *values)
{
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(properties, 0); /* the same numbers give the same bytes */
    const hid_t set = H5Dcreate2(parent, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    if (n)
        H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(set);
    H5Pclose(properties);
    H5Sclose(space);
}

static void write_array(hid_t parent, const char *name, hid_t type, int n, const void *values)
{
    const hsize_t size = (hsize_t)n;
    write_set(parent, name, type, H5Screate_simple(1, &size, NULL), n, values);
}

static void write_int(hid_t parent, const char *name, int value)
{
    write_array(parent, name, H5T_NATIVE_INT, 1, &value);
}

static void write_text(hid_t parent, const char *name, const char *text)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, strlen(text) + 1);
    write_set(parent, name, type, H5Screate(H5S_SCALAR), 1, text);
    H5Tclose(type);
}

static rb_status write_matrix(hid_t parent, const char *name, const rb_sparse *a,
                              rb_io_fclib_layout layout)
{
    static const int NZ[] = {[RB_IO_FCLIB_CSC] = -1, [RB_IO_FCLIB_CSR] = -2};
    const int entries = a->p[a->cols], triplets = layout == RB_IO_FCLIB_TRIPLET;
    rb_sparse t = {0};
    int *column = NULL;
    rb_status s = RB_OK;
    if (triplets) { /* a column number per entry */
        column = rb_alloc_int((size_t)entries);
        s = column ? RB_OK : RB_ENOMEM;
        for (int j = 0; column && j < a->cols; j++)
            for (int k = a->p[j]; k < a->p[j + 1]; k++)
                column[k] = j;
    } else if (layout == RB_IO_FCLIB_CSR)
        s = rb_sparse_transpose(a, &t);
    if (s == RB_OK) {
        const rb_sparse *lines = t.p ? &t : a;
        const hid_t group = H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        write_int(group, "m", a->rows);
        write_int(group, "n", a->cols);
        write_int(group, "nz", triplets ? entries : NZ[layout]);
        write_int(group, "nzmax", entries);
        write_array(group, "p", H5T_NATIVE_INT, triplets ? entries : lines->cols + 1,
                    triplets ? column : lines->p);
        write_array(group, "i", H5T_NATIVE_INT, entries, lines->i);
        write_array(group, "x", H5T_NATIVE_DOUBLE, entries, lines->x);
        H5Gclose(group);
    }
    free(column);
    rb_sparse_free(&t);
    return s;
}

/* The vectors from the first to before the last that the problem has. */
static void write_vectors(hid_t parent, const char *name, rb_io_fclib p, int first, int last)
{
    const arrays all = arrays_of(&p);
    const hid_t group = H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    for (int k = first; k < last; k++)
        if (*all.vector[k])
            write_array(group, VECTOR[k], H5T_NATIVE_DOUBLE, all.length[k], *all.vector[k]);
    H5Gclose(group);
}

typedef struct {
    const rb_io_fclib *problem;
    rb_io_fclib_layout layout;
    const char *title, *description;
} contents;

static rb_status write_in_child(FILE *out, const void *context, rb_message *why)
{
    enum { GROWTH = 1 << 20 };
    const contents *c = context;
    rb_status s = RB_OK;
    int failed = 0;
    if (H5Eset_auto2(H5E_DEFAULT, note_failure, &failed) < 0) /* its first call */
        failed = 1;
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (H5Pset_fapl_core(access, GROWTH, 0) < 0)
        failed = 1;
    if (!failed) { /* or H5Fcreate would make a file of that name */
        const hid_t file = H5Fcreate("memory", H5F_ACC_TRUNC, H5P_DEFAULT, access);
        rb_io_fclib p = *c->problem;
        const arrays all = arrays_of(&p);
        const hid_t root = H5Gcreate2(file, root_of(&p), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        const hid_t info = H5Gcreate2(root, "info", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        write_int(root, "spacedim", p.spacedim);
        write_text(info, "title", c->title ? c->title : "");
        write_text(info, "description", c->description ? c->description : "");
        write_text(info, "math_info", "");
        H5Gclose(info);
        write_vectors(root, "vectors", p, 0, SOLUTION);
        for (int k = 0; k < MATRICES && s == RB_OK; k++)
            if (all.matrix[k]->p)
                s = write_matrix(root, MATRIX[k], all.matrix[k], c->layout);
        H5Gclose(root);
        if (p.r || p.u || p.v)
            write_vectors(file, "solution", p, SOLUTION, VECTORS);
        if (s == RB_OK) {
            /* The file in memory: HDF5 touches no disk, where it crashes when that is
             * full. */
            H5Fflush(file, H5F_SCOPE_LOCAL);
            const ssize_t n = H5Fget_file_image(file, NULL, 0);
            void *image = n > 0 ? malloc((size_t)n) : NULL;
            s = image ? RB_OK : RB_ENOMEM;
            if (image && H5Fget_file_image(file, image, (size_t)n) >= 0)
                fwrite(image, 1, (size_t)n, out);
            free(image);
        }
    }
    return failed || s != RB_OK ? rb_fail(why, RB_ENOMEM, "HDF5: out of memory") : RB_OK;
}

rb_status rb_io_fclib_write(const char *path, const rb_io_fclib *problem, rb_io_fclib_layout layout,
                            const char *title, const char *description, rb_message *why)
{
    const contents c = {problem, layout, title, description};
    rb_io_writer w;
    char *image;
    size_t size;
    rb_status s = rb_io_writer_open(path, &w, why);
    if (s != RB_OK)
        return s;
    s = rb_io_in_child(path, write_in_child, &c, &image, &size, why);
    if (s == RB_OK) {
        fwrite(image, 1, size, w.file);
        s = rb_io_writer_commit(&w, why);
    } else {
        rb_io_writer_abandon(&w);
    }
    free(image);
    return s;
}
