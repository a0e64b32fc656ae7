/* XML files of the Visualization Toolkit, which ParaView reads: .vti (ImageData) and .vtu
 * (UnstructuredGrid); arrays inline in base64, each behind its size in bytes. */
#include "report/internal.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
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
    if (kind == RB_REPORT_VTI && !rb_rolling_body_can(&s->rc->a, RB_BODY_FLAT))
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
    int n;         /* points inside the body */
    int *number;   /* s->n: their new numbers, -1 outside */
    double *work;  /* 6 n: for one array at a time */
    int32_t *cell; /* 4 per cell */
    int cells, per_cell;
} selection;

/* ---- Point data -------------------------------------------------------------------- */

static void write_point_data(FILE *out, selection *v)
{
    enum { FIRST_SCALAR = 6 }; /* behind x, y and the tensor */
    fputs("<PointData Scalars=\"max_shear\" Tensors=\"stress\">\n", out);
    for (int j = FIRST_SCALAR; j < rb_rolling_stress_scalars.n; j++) {
        const rb_rolling_result *r = &rb_rolling_stress_scalars.row[j];
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

rb_status rb_report_vtk(FILE *out, rb_report_vtk_kind kind, const rb_report_stress *s)
{
    void *before = rb_locale_begin();
    selection v = {.s = s,
                   .per_cell = s->nx > 0 ? 4 : 1,
                   .number = rb_alloc_int((size_t)s->n),
                   .work = rb_alloc((size_t)s->n, 6),
                   .cell = calloc((size_t)s->n * 4, sizeof *v.cell)};
    rb_status status = v.number && v.work && v.cell ? RB_OK : RB_ENOMEM;
    for (int k = 0; k < s->n && status == RB_OK; k++)
        v.number[k] = rb_report_stress_is_inside(s, k) ? v.n++ : -1;
    /* Cells: quadrilaterals of which all corners are inside, or a vertex per point. */
    for (int k = 0; k < v.n && s->nx == 0; k++)
        v.cell[v.cells++] = k;
    for (int j = 0; j + 1 < s->ny && status == RB_OK; j++)
        for (int i = 0; i + 1 < s->nx; i++) {
            const int *at = v.number + i + j * s->nx;
            const int32_t corner[] = {at[0], at[1], at[s->nx + 1], at[s->nx]};
            if (corner[0] < 0 || corner[1] < 0 || corner[2] < 0 || corner[3] < 0)
                continue;
            memcpy(v.cell + 4 * v.cells++, corner, sizeof corner);
        }
    if (status == RB_OK && kind == RB_REPORT_VTI) {
        const rb_rolling_stress *first = &s->at[0], *last = &s->at[s->n - 1];
        write_head(out, "ImageData");
        fprintf(out,
                "<ImageData WholeExtent=\"0 %d 0 %d 0 0\" Origin=\"%.17g %.17g 0\" Spacing=\"%.17g "
                "%.17g 1\">\n<Piece Extent=\"0 %d 0 %d 0 0\">\n",
                s->nx - 1, s->ny - 1, first->x, first->y, (last->x - first->x) / (s->nx - 1),
                (last->y - first->y) / (s->ny - 1), s->nx - 1, s->ny - 1);
        write_point_data(out, &v);
        fputs("</Piece>\n</ImageData>\n</VTKFile>\n", out);
    } else if (status == RB_OK) {
        write_head(out, "UnstructuredGrid");
        fprintf(out, "<UnstructuredGrid>\n<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n",
                v.n, v.cells);
        write_point_data(out, &v);
        double *to = v.work;
        for (int k = 0; k < v.s->n; k++)
            if (v.number[k] >= 0) {
                *to++ = v.s->at[k].x;
                *to++ = v.s->at[k].y;
                *to++ = 0.0;
            }
        fputs("<Points>\n", out);
        write_array(out, "Float64", "Points", 3, sizeof(double) * 3 * (size_t)v.n, v.work);
        fputs("</Points>\n", out);
        enum { VERTEX = 1, QUADRILATERAL = 9 };
        const size_t n = (size_t)v.cells;
        int32_t *offset = calloc(n ? n : 1, sizeof *offset);
        uint8_t *type = calloc(n ? n : 1, 1);
        status = offset && type ? RB_OK : RB_ENOMEM;
        for (size_t k = 0; k < n && status == RB_OK; k++) {
            offset[k] = (int32_t)(k + 1) * v.per_cell;
            type[k] = v.per_cell == 4 ? QUADRILATERAL : VERTEX;
        }
        if (status == RB_OK) {
            fputs("<Cells>\n", out);
            write_array(out, "Int32", "connectivity", 1, sizeof *v.cell * n * (size_t)v.per_cell,
                        v.cell);
            write_array(out, "Int32", "offsets", 1, sizeof *offset * n, offset);
            write_array(out, "UInt8", "types", 1, n, type);
            fputs("</Cells>\n", out);
        }
        free(offset);
        free(type);
        fputs("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", out);
    }
    free(v.number);
    free(v.work);
    free(v.cell);
    rb_locale_end(before);
    return status == RB_OK ? rb_report_flush(out) : status;
}
