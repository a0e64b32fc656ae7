/* Between friction problems and the files of other projects. */
#include "friction/internal.h"

#include "rollbem/io_fclib.h"

#include <stdlib.h>
#include <string.h>

static rb_status copy_vector(size_t n, const double *from, double **to)
{
    *to = rb_alloc(n, 1);
    if (!*to)
        return RB_ENOMEM;
    if (n)
        memcpy(*to, from, n * sizeof *from);
    return RB_OK;
}

/* Takes over the arrays of the file. */
static void adopt_fclib(rb_io_fclib *file, rb_friction_problem *p)
{
    *p = (rb_friction_problem){.form = file->global ? RB_FRICTION_GLOBAL
                                                    : RB_FRICTION_LOCAL_SPARSE,
                               .dimension = file->spacedim,
                               .contacts = file->contacts,
                               .mu = file->mu,
                               .Ws = file->W,
                               .q = file->q,
                               .dofs = file->global ? file->M.rows : 0,
                               .K = file->M,
                               .H = file->H,
                               .f = file->f,
                               .w = file->w};
    free(file->r);
    free(file->u);
    free(file->v);
    *file = (rb_io_fclib){0};
}

static rb_status read_fclib(const char *path, rb_friction_problem *problem,
                            rb_message *why)
{
    rb_io_fclib file;
    const rb_status s = rb_io_fclib_read(path, &file, why);
    if (s == RB_OK)
        adopt_fclib(&file, problem);
    return s;
}

rb_status rb_friction_read(const char *path, rb_friction_problem *problem,
                           rb_message *why)
{
    *problem = (rb_friction_problem){0};
    rb_message detail = {""};
    rb_status s = read_fclib(path, problem, why);
    if (s != RB_OK)
        return s;
    s = rb_friction_problem_check(problem, &detail);
    if (s == RB_OK)
        return s;
    rb_friction_problem_free(problem);
    return s == RB_EINVAL ? rb_fail(why, RB_EFORMAT, "%s: %s", path, detail.text) : s;
}

static rb_status describe(const rb_friction_problem *p, rb_io_fclib *file)
{
    const int m = p->dimension * p->contacts;
    *file = (rb_io_fclib){.global = p->form == RB_FRICTION_GLOBAL,
                          .spacedim = p->dimension,
                          .contacts = p->contacts};
    rb_status s = copy_vector((size_t)p->contacts, p->mu, &file->mu);
    if (s == RB_OK && p->form == RB_FRICTION_LOCAL_DENSE)
        s = rb_sparse_from_dense(m, m, p->W, m, &file->W);
    if (s == RB_OK && p->form == RB_FRICTION_LOCAL_SPARSE)
        s = rb_sparse_copy(&p->Ws, &file->W);
    if (p->form != RB_FRICTION_GLOBAL)
        return s == RB_OK ? copy_vector((size_t)m, p->q, &file->q) : s;
    if (s == RB_OK)
        s = rb_sparse_copy(&p->K, &file->M);
    if (s == RB_OK)
        s = rb_sparse_copy(&p->H, &file->H);
    if (s == RB_OK)
        s = copy_vector((size_t)p->dofs, p->f, &file->f);
    return s == RB_OK ? copy_vector((size_t)m, p->w, &file->w) : s;
}

rb_status rb_friction_write(const char *path, const rb_friction_problem *p,
                            const double *r, const double *u, const double *v,
                            const char *title, rb_message *why)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    rb_io_fclib file;
    rb_status s = describe(p, &file);
    if (s == RB_OK && r)
        s = copy_vector(m, r, &file.r);
    if (s == RB_OK && u)
        s = copy_vector(m, u, &file.u);
    if (s == RB_OK && v && file.global)
        s = copy_vector((size_t)p->dofs, v, &file.v);
    if (s == RB_OK)
        s = rb_io_fclib_write(path, &file, RB_IO_FCLIB_CSC, title, "written by rollbem",
                              why);
    rb_io_fclib_free(&file);
    return s;
}
