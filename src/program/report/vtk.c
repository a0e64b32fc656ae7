/* XML files of the Visualization Toolkit, which ParaView reads: .vti (ImageData) and .vtu
 * (UnstructuredGrid); arrays inline in base64, each behind its size in bytes. */
#include "program/report/internal.h"

#include <stdint.h>
#include <string.h>

rb_status rb_report_vtk_kind_of(const char *path, rb_report_vtk_kind *kind, rb_message *why)
{
    const char *end = strrchr(path, '.');
    if (end && strcmp(end, ".vti") == 0)
        *kind = RB_REPORT_VTI;
    else if (end && strcmp(end, ".vtu") == 0)
        *kind = RB_REPORT_VTU;
    else
        return rb_fail(why, RB_EINVAL, "expected a name ending in .vti or .vtu, got '%s'", path);
    return RB_OK;
}

rb_status rb_report_vtk_check(rb_report_vtk_kind kind, const rb_report_stress *s, rb_message *why)
{
    if (kind == RB_REPORT_VTI && s->nx == 0)
        return rb_fail(why, RB_EINVAL, ".vti holds regular grids; for points use .vtu");
    if (kind == RB_REPORT_VTI &&
        !rb_rolling_body_can(s->of_b ? &s->rc->b : &s->rc->a, RB_BODY_FLAT))
        return rb_fail(why, RB_EINVAL,
                       ".vti holds regular grids, that of a wheel follows its surface; use .vtu");
    return RB_OK;
}

/* ---- Arrays ------------------------------------------------------------------------ */

static void write_base64(FILE *out, size_t n, const unsigned char *bytes)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        const size_t left = n - i;
        const unsigned long word = (unsigned long)bytes[i] << 16 |
                                   (left > 1 ? (unsigned long)bytes[i + 1] << 8 : 0) |
                                   (left > 2 ? bytes[i + 2] : 0);
        fputc(digits[word >> 18 & 63], out);
        fputc(digits[word >> 12 & 63], out);
        fputc(left > 1 ? digits[word >> 6 & 63] : '=', out);
        fputc(left > 2 ? digits[word & 63] : '=', out);
    }
}

static void write_array(FILE *out, const char *type, const char *name, int components, size_t bytes,
                        const void *data)
{
    const uint64_t size = bytes;
    fprintf(out, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"binary\">",
            type, name, components);
    write_base64(out, sizeof size, (const unsigned char *)&size);
    write_base64(out, bytes, data);
    fputs("</DataArray>\n", out);
}

/* ---- The points that are written --------------------------------------------------- */

typedef struct {
    const rb_report_stress *s;
    int n, cells;           /* points inside the body; cells between them */
    int *number;            /* s->n: new numbers of the points, -1 outside */
    double *work;           /* 6 n: for one array at a time */
    int32_t *corner, *ends; /* of the cells: points, and where those of each end */
    uint8_t *kind;          /* of the cells */
} selection;

/* A cell is a quadrilateral of a grid whose corners are all inside, or a single point. */
static void add_cell(selection *v, int corners, const int32_t *corner)
{
    enum { VERTEX = 1, QUADRILATERAL = 9 };
    memcpy(v->corner + corners * v->cells, corner, (size_t)corners * sizeof *corner);
    v->kind[v->cells++] = corners == 4 ? QUADRILATERAL : VERTEX;
    v->ends[v->cells - 1] = corners * v->cells;
}

/* ---- Point data -------------------------------------------------------------------- */

static void write_point_data(FILE *out, selection *v)
{
    enum { FIRST_SCALAR = 6 }; /* behind x, y and the tensor */
    fputs("<PointData Scalars=\"max_shear\" Tensors=\"stress\">\n", out);
    for (int j = FIRST_SCALAR; j < rb_rolling_stress_scalars.n; j++) {
        const rb_rolling_result *r = &rb_rolling_stress_scalars.row[j];
        if (!rb_rolling_has_result(r, v->s->rc, 0))
            continue;
        for (int k = 0, m = 0; k < v->s->n; k++)
            if (v->number[k] >= 0)
                v->work[m++] = rb_rolling_number(r, &v->s->at[k]);
        write_array(out, "Float64", r->name, 1, sizeof(double) * (size_t)v->n, v->work);
    }
    /* ParaView's order of a symmetric tensor: xx, yy, zz, xy, yz, xz. */
    double *to = v->work;
    for (int k = 0; k < v->s->n; k++) {
        const rb_rolling_stress *at = &v->s->at[k];
        if (v->number[k] < 0)
            continue;
        const double six[] = {at->sxx, at->syy, at->szz, at->sxy, 0.0, 0.0};
        memcpy(to, six, sizeof six);
        to += 6;
    }
    write_array(out, "Float64", "stress", 6, sizeof(double) * 6 * (size_t)v->n, v->work);
    fputs("</PointData>\n", out);
}

/* ---- Files ------------------------------------------------------------------------- */

static void write_head(FILE *out, const char *type)
{
    const uint16_t one = 1;
    const int little = *(const unsigned char *)&one;
    fprintf(out,
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"%s\" version=\"1.0\" byte_order=\"%s\" header_type=\"UInt64\">\n",
            type, little ? "LittleEndian" : "BigEndian");
}

static void write_image(FILE *out, selection *v)
{
    const rb_report_stress *s = v->s;
    const rb_rolling_stress *first = &s->at[0], *last = &s->at[s->n - 1];
    write_head(out, "ImageData");
    fprintf(out,
            "<ImageData WholeExtent=\"0 %d 0 %d 0 0\" Origin=\"%.17g %.17g 0\" Spacing=\"%.17g "
            "%.17g 1\">\n<Piece Extent=\"0 %d 0 %d 0 0\">\n",
            s->nx - 1, s->ny - 1, first->x, first->y, (last->x - first->x) / (s->nx - 1),
            (last->y - first->y) / (s->ny - 1), s->nx - 1, s->ny - 1);
    write_point_data(out, v);
    fputs("</Piece>\n</ImageData>\n</VTKFile>\n", out);
}

static void write_grid(FILE *out, selection *v)
{
    const size_t cells = (size_t)v->cells, corners = cells ? (size_t)v->ends[cells - 1] : 0;
    write_head(out, "UnstructuredGrid");
    fprintf(out, "<UnstructuredGrid>\n<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n", v->n,
            v->cells);
    write_point_data(out, v);
    double *to = v->work;
    for (int k = 0; k < v->s->n; k++)
        if (v->number[k] >= 0) {
            *to++ = v->s->at[k].x;
            *to++ = v->s->at[k].y;
            *to++ = 0.0;
        }
    fputs("<Points>\n", out);
    write_array(out, "Float64", "Points", 3, sizeof(double) * 3 * (size_t)v->n, v->work);
    fputs("</Points>\n<Cells>\n", out);
    write_array(out, "Int32", "connectivity", 1, sizeof *v->corner * corners, v->corner);
    write_array(out, "Int32", "offsets", 1, sizeof *v->ends * cells, v->ends);
    write_array(out, "UInt8", "types", 1, cells, v->kind);
    fputs("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", out);
}

rb_status rb_report_vtk(FILE *out, rb_report_vtk_kind kind, const rb_report_stress *s)
{
    const size_t n = (size_t)s->n;
    rb_arena scratch = {0};
    selection v = {.s = s,
                   .number = rb_arena_ints(&scratch, n),
                   .work = rb_arena_doubles(&scratch, n, 6),
                   .corner = rb_arena_zeros(&scratch, 4 * n, sizeof *v.corner),
                   .ends = rb_arena_zeros(&scratch, n, sizeof *v.ends),
                   .kind = rb_arena_zeros(&scratch, n, sizeof *v.kind)};
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    void *before = rb_locale_begin();
    for (int k = 0; k < s->n; k++)
        v.number[k] = rb_report_stress_is_inside(s, k) ? v.n++ : -1;
    for (int32_t k = 0; k < v.n && s->nx == 0; k++)
        add_cell(&v, 1, &k);
    for (int j = 0; j + 1 < s->ny; j++)
        for (int i = 0; i + 1 < s->nx; i++) {
            const int *at = v.number + i + j * s->nx;
            const int32_t corner[] = {at[0], at[1], at[s->nx + 1], at[s->nx]};
            if (corner[0] >= 0 && corner[1] >= 0 && corner[2] >= 0 && corner[3] >= 0)
                add_cell(&v, 4, corner);
        }
    (kind == RB_REPORT_VTI ? write_image : write_grid)(out, &v);
    rb_locale_end(before);
    return rb_arena_done(&scratch, rb_report_flush(out));
}
