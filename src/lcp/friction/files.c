/* Between friction problems and the files of other projects. */
#include "lcp/friction/internal.h"

#include "base/io/io.h"
#include "base/io/io_fclib.h"

#include <stdlib.h>

/* K of a file that is symmetric but for digits lost on the way becomes its symmetric part. */
static rb_status symmetrise(rb_friction_problem *p)
{
    const double rounding = 1e-8, lost = 1e-4;
    double difference = 0.0, largest = 0.0;
    rb_triplets t = {.rows = p->K.rows, .cols = p->K.cols};
    rb_sparse half = {0};
    if (p->form != RB_FRICTION_GLOBAL || p->K.rows != p->K.cols)
        return RB_OK;
    rb_status s = rb_friction_sparse_asymmetry(&p->K, &difference, &largest);
    if (s != RB_OK || !(difference > rounding * largest && difference <= lost * largest))
        return s; /* what is worse is refused with its size */
    for (int j = 0; j < p->K.cols; j++)
        for (int k = p->K.p[j]; k < p->K.p[j + 1]; k++) {
            rb_triplets_add(&t, p->K.i[k], j, 0.5 * p->K.x[k]);
            rb_triplets_add(&t, j, p->K.i[k], 0.5 * p->K.x[k]);
        }
    s = rb_sparse_from_triplets(&t, &half);
    rb_triplets_free(&t);
    if (s == RB_OK) {
        rb_sparse_free(&p->K);
        p->K = half;
        p->asymmetry = difference / largest;
    }
    return s;
}

static rb_status read_fclib(const char *path, rb_friction_problem *problem, rb_message *why)
{
    rb_io_fclib file;
    rb_message detail = {.text = ""};
    rb_status s = rb_io_fclib_read(path, &file, why);
    if (s != RB_OK)
        return s;
    /* Moves what a problem without constraints has of the file. */
    rb_friction_problem *p = problem;
    *p = (rb_friction_problem){.form = file.global ? RB_FRICTION_GLOBAL : RB_FRICTION_LOCAL_SPARSE,
                               .dimension = file.spacedim,
                               .contacts = file.contacts,
                               .mu = file.mu,
                               .Ws = file.W,
                               .q = file.q,
                               .dofs = file.global ? file.M.rows : 0,
                               .K = file.M,
                               .H = file.H,
                               .f = file.f,
                               .w = file.w};
    file.W = file.M = file.H = (rb_sparse){0};
    file.mu = file.q = file.f = file.w = NULL;
    if (file.contacts == 0) {
        rb_io_fclib_free(&file);
        return RB_OK;
    }
    s = symmetrise(p);
    const double asymmetry = p->asymmetry; /* what follows makes problems of their own */
    if (s == RB_OK && file.rolling)
        s = rb_friction_split_rolling(problem, file.mu_r, &detail);
    if (s == RB_OK && file.rolling)
        file.G.rows = problem->dofs; /* constraints do not hold the motions added */
    if (s == RB_OK && file.constraints)
        s = file.global ? rb_friction_eliminate(problem, &file.G, file.b, &detail)
                        : rb_friction_eliminate_local(problem, &file.V, &file.R, file.s, &detail);
    problem->asymmetry = asymmetry;
    rb_io_fclib_free(&file);
    if (s == RB_EINVAL)
        return rb_fail(why, RB_EFORMAT, "%s: %s", path, detail.text);
    return s == RB_ENOMEM ? rb_fail(why, s, "%s: out of memory", path) : s;
}

/* Below this share of entries a dense W is kept sparse. */
#define SPARSE_FILL 0.5

static rb_status read_siconos(const char *path, int global, rb_friction_problem *p, rb_message *why)
{
    rb_io_friction file;
    rb_status s = rb_io_siconos_read_friction(path, global, &file, why);
    if (s != RB_OK)
        return s;
    const double m = (double)file.dimension * file.contacts;
    *p = (rb_friction_problem){.form = global ? RB_FRICTION_GLOBAL : RB_FRICTION_LOCAL_SPARSE,
                               .dimension = file.dimension,
                               .contacts = file.contacts,
                               .mu = file.mu,
                               .q = file.q,
                               .dofs = file.M.rows,
                               .f = file.f,
                               .w = file.w};
    file.mu = file.q = file.f = file.w = NULL;
    s = global ? rb_io_matrix_to_sparse(&file.M, &p->K) : rb_io_matrix_to_sparse(&file.W, &p->Ws);
    if (s == RB_OK && global)
        s = rb_io_matrix_to_sparse(&file.H, &p->H);
    else if (s == RB_OK && p->Ws.p[p->Ws.cols] > SPARSE_FILL * m * m) {
        rb_sparse_free(&p->Ws);
        s = rb_io_matrix_to_dense(&file.W);
        p->form = RB_FRICTION_LOCAL_DENSE;
        p->W = file.W.dense;
        file.W.dense = NULL;
    }
    if (s == RB_OK)
        s = symmetrise(p);
    rb_io_friction_free(&file);
    return s == RB_OK ? s : rb_fail(why, s, "%s: out of memory", path);
}

/* With as many degrees of freedom as rows of contacts the head fits both forms: the local
 * one is tried first, and its message counts where neither fits. */
static rb_status read_text(const char *path, rb_friction_problem *problem, rb_message *why)
{
    rb_message other = {.text = ""};
    const rb_status s = read_siconos(path, 0, problem, why);
    const rb_status t = s == RB_EFORMAT ? read_siconos(path, 1, problem, &other) : s;
    if (t == RB_ENOMEM && s == RB_EFORMAT)
        return rb_fail(why, t, "%s", rb_status_reason(t, &other));
    if (t == RB_OK && why) /* nothing is wrong with the file */
        why->text[0] = '\0';
    return t == RB_OK ? t : s;
}

rb_status rb_friction_file_kind(const char *path, rb_friction_file *kind, rb_message *why)
{
    rb_io_siconos_kind text = RB_IO_SICONOS_FRICTION;
    if (rb_io_is_hdf5(path)) {
        *kind = RB_FRICTION_FILE_FCLIB;
        return RB_OK;
    }
    const rb_status s = rb_io_siconos_guess(path, &text, why);
    if (s == RB_OK && text == RB_IO_SICONOS_LCP)
        return rb_fail(why, RB_EFORMAT, "%s: a linear complementarity problem: see 'rollbem lcp'",
                       path);
    if (s == RB_OK && (text == RB_IO_SICONOS_MIXED || text == RB_IO_SICONOS_ROLLING))
        return rb_fail(
            why, RB_EFORMAT, "%s: %s", path,
            text == RB_IO_SICONOS_MIXED
                ? "a mixed linear complementarity problem (MLCP) of Siconos, expected a "
                  "friction problem"
                : "a problem of rolling friction (RFC3D) of Siconos; rolling friction is "
                  "read from files of FCLib");
    *kind = text == RB_IO_SICONOS_SOCLCP            ? RB_FRICTION_FILE_SICONOS_SOCLCP
            : text == RB_IO_SICONOS_FRICTION_GLOBAL ? RB_FRICTION_FILE_SICONOS_GLOBAL
                                                    : RB_FRICTION_FILE_SICONOS;
    return s;
}

rb_status rb_friction_read_as(const char *path, rb_friction_file kind, rb_friction_problem *problem,
                              rb_message *why)
{
    *problem = (rb_friction_problem){0};
    rb_message detail = {.text = ""};
    rb_status s = RB_OK;
    if (kind == RB_FRICTION_FILE_ANY)
        s = rb_friction_file_kind(path, &kind, why);
    if (s == RB_OK && kind == RB_FRICTION_FILE_SICONOS_SOCLCP)
        s = rb_fail(why, RB_EFORMAT, "%s: a problem on cones, not one of friction", path);
    if (s == RB_OK)
        s = kind == RB_FRICTION_FILE_FCLIB            ? read_fclib(path, problem, why)
            : kind == RB_FRICTION_FILE_SICONOS_GLOBAL ? read_siconos(path, 1, problem, why)
                                                      : read_text(path, problem, why);
    if (s == RB_OK && problem->contacts > 0) /* without any it is solved */
        s = rb_friction_problem_check(problem, &detail);
    if (s == RB_EINVAL)
        s = rb_fail(why, RB_EFORMAT, "%s: %s", path, detail.text);
    if (s != RB_OK)
        rb_friction_problem_free(problem);
    return s;
}

rb_status rb_friction_read(const char *path, rb_friction_problem *problem, rb_message *why)
{
    return rb_friction_read_as(path, RB_FRICTION_FILE_ANY, problem, why);
}

/* ---- SOCLCP ------------------------------------------------------------------------ */

void rb_friction_soclcp_data_free(rb_friction_soclcp_data *data)
{
    if (!data)
        return;
    free(data->M);
    free(data->q);
    free(data->size);
    free(data->tau);
    *data = (rb_friction_soclcp_data){0};
}

rb_status rb_friction_soclcp_read(const char *path, rb_friction_soclcp_data *data, rb_message *why)
{
    rb_io_soclcp file = {0};
    *data = (rb_friction_soclcp_data){0};
    rb_status s = rb_io_siconos_read_soclcp(path, &file, why);
    for (int c = 0; s == RB_OK && c < file.cones; c++)
        if (!(file.tau[c] > 0.0))
            s = rb_fail(why, RB_EFORMAT, "%s: slope of cone %d is %g, expected > 0", path, c + 1,
                        file.tau[c]);
    if (s == RB_OK) {
        s = rb_io_matrix_to_dense(&file.M);
        data->size = rb_alloc_int((size_t)file.cones);
        if (!data->size)
            s = RB_ENOMEM;
    }
    if (s == RB_OK) {
        data->M = file.M.dense;
        data->q = file.q;
        data->tau = file.tau;
        file.M.dense = file.q = file.tau = NULL;
        /* S^-1 M S^-1 and S^-1 q, S = tau on the first entry of every cone */
        const size_t n = (size_t)file.n;
        for (int c = 0; c < file.cones; c++) {
            const size_t first = (size_t)file.start[c];
            data->size[c] = file.start[c + 1] - file.start[c];
            if (data->size[c] == 1) /* a half-line has no slope */
                data->tau[c] = 1.0;
            for (size_t i = 0; i < n; i++)
                data->M[i + first * n] /= data->tau[c];
            for (size_t j = 0; j < n; j++)
                data->M[first + j * n] /= data->tau[c];
            data->q[first] /= data->tau[c];
        }
        data->problem =
            (rb_friction_soclcp_problem){file.n, data->M, data->q, file.cones, data->size};
    }
    rb_io_soclcp_free(&file);
    if (s != RB_OK)
        rb_friction_soclcp_data_free(data);
    return s;
}

/* ---- Writing ----------------------------------------------------------------------- */

rb_status rb_friction_write(const char *path, const rb_friction_problem *p,
                            const rb_friction_solution *solution, const char *title,
                            rb_message *why)
{
    const int m = p->dimension * p->contacts, global = p->form == RB_FRICTION_GLOBAL;
    const rb_friction_solution x = solution ? *solution : (rb_friction_solution){0};
    rb_io_fclib file = {.global = global, .spacedim = p->dimension, .contacts = p->contacts};
    const struct {
        const double *from;
        int n;
        double **to;
    } vectors[] = {{p->mu, p->contacts, &file.mu},
                   {global ? NULL : p->q, m, &file.q},
                   {global ? p->f : NULL, p->dofs, &file.f},
                   {global ? p->w : NULL, m, &file.w},
                   {x.r, m, &file.r},
                   {x.u, m, &file.u},
                   {global ? x.v : NULL, p->dofs, &file.v}};
    rb_status s = RB_OK;
    if (p->lengths)
        return rb_fail(why, RB_EINVAL, "%s: rolling friction cannot be written", path);
    for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++)
        if (vectors[k].from && !(*vectors[k].to = rb_copy((size_t)vectors[k].n, vectors[k].from)))
            s = RB_ENOMEM;
    if (s == RB_OK && global)
        s = rb_sparse_copy(&p->K, &file.M);
    if (s == RB_OK)
        s = global                               ? rb_sparse_copy(&p->H, &file.H)
            : p->form == RB_FRICTION_LOCAL_DENSE ? rb_sparse_from_dense(m, m, p->W, m, &file.W)
                                                 : rb_sparse_copy(&p->Ws, &file.W);
    if (s == RB_OK)
        s = rb_io_fclib_write(path, &file, RB_IO_FCLIB_CSC, title, "written by rollbem", why);
    rb_io_fclib_free(&file);
    return s;
}
