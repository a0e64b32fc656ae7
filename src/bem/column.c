/* The columns of H and G that belong to one element (B2, B3), in blocks of points.  Far blocks need
 * a short series, near points the closed form; each step is a loop of its own over the block, which
 * compilers turn into vectors. */
#include "bem/column.h"

#include <stdlib.h>
#include <string.h>
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

/* Points in one vector loop; in the widest vector. */
enum { BLOCK = 32, EIGHT = 8 };

void rb_points_free(rb_points *points)
{
    free(points->x);
    *points = (rb_points){0};
}

rb_status rb_points_make(int n, const double *x, const double *y, rb_points *points)
{
    const size_t blocks = ((size_t)n + BLOCK - 1) / BLOCK, padded = blocks * BLOCK;
    *points = (rb_points){.n = n, .x = rb_alloc(2 * padded + 3 * blocks, 1)};
    if (!points->x)
        return RB_ENOMEM;
    points->y = points->x + padded;
    points->circle = points->y + padded;
    for (size_t i = 0; i < padded; i++) {
        points->x[i] = x[i < (size_t)n ? i : (size_t)n - 1];
        points->y[i] = y[i < (size_t)n ? i : (size_t)n - 1];
    }
    for (size_t b = 0; b < blocks; b++) {
        /* Centre and radius of a circle about one block of points. */
        const double *px = points->x + b * BLOCK;
        const double *py = points->y + b * BLOCK;
        double *circle = points->circle + 3 * b;
        double cx = 0.0, cy = 0.0, r = 0.0;
        for (int i = 0; i < BLOCK; i++) {
            cx += px[i] / BLOCK;
            cy += py[i] / BLOCK;
        }
        for (int i = 0; i < BLOCK; i++)
            r = fmax(r, hypot(px[i] - cx, py[i] - cy));
        circle[0] = cx;
        circle[1] = cy;
        circle[2] = r;
    }
    return RB_OK;
}

/* The columns of one block of points. */
typedef double rb_buffer[4][2 * BLOCK];

/* Stores past the caches: the matrix is not read before it is complete, and a plain store
 * would fetch every line first.  Only where the column begins at a line of 8: lines in
 * two pieces cost more than they save. */
typedef void stream_line(double *to, const double *from);

RB_INLINE void stream(double *to, const double *from, int count, stream_line *line)
{
    int i = 0;
    if ((uintptr_t)to % 64 == 0)
        for (; i + 8 <= count; i += 8)
            line(to + i, from + i);
    memcpy(to + i, from + i, (size_t)(count - i) * sizeof *to);
}

/* The columns of points i ... i + count - 1. */
RB_INLINE void send(rb_buffer buffer, int count, int i, double *const out[4], stream_line *line)
{
    for (int c = 0; c < 4; c++)
        if (out[c])
            stream(out[c] + 2 * i, buffer[c], 2 * count, line);
}

/* What rb_view_angles holds, for the points of a block; over = 2a/(W rho), ln W from k
 * and s. */
typedef double rb_lane[BLOCK];
typedef struct {
    rb_lane X, d, rho, Z_re, Z_im, W, over, q, Lam, Th, M, k, s;
} rb_seen_block;

RB_INLINE rb_view_angles kept(const rb_seen_block *b, int i)
{
    return (rb_view_angles){.X = b->X[i],
                            .d = b->d[i],
                            .rho = b->rho[i],
                            .Z_re = b->Z_re[i],
                            .Z_im = b->Z_im[i],
                            .W = b->W[i],
                            .q = b->q[i],
                            .Lam = b->Lam[i],
                            .Th = b->Th[i],
                            .M = b->M[i]};
}

RB_INLINE void put_H(const rb_influence *v, rb_buffer buffer, int i)
{
    buffer[0][i] = v->Hxx;
    buffer[0][i + 1] = v->Hyx;
    buffer[1][i] = v->Hxy;
    buffer[1][i + 1] = v->Hyy;
}

RB_INLINE void put_G(const rb_influence *v, rb_buffer buffer, int i)
{
    buffer[2][i] = v->Gxx;
    buffer[2][i + 1] = buffer[3][i] = v->Gxy;
    buffer[3][i + 1] = v->Gyy;
}

/* The distances of a block of points from the element (kernels.h), one array each, so that the loop
 * is vectorised. */
RB_INLINE void see_block(const rb_element *e, const double *x, const double *y, rb_seen_block *b)
{
    const double length = e->a + e->a;
    for (int i = 0; i < BLOCK; i++) {
        const rb_view_angles v = rb_see(e, x[i], y[i]);
        b->X[i] = v.X;
        b->d[i] = v.d;
        b->rho[i] = v.rho;
        b->Z_re[i] = v.Z_re;
        b->Z_im[i] = v.Z_im;
        b->W[i] = v.W;
        b->over[i] = length / (v.W * v.rho);
    }
}

/* ln W in two parts: exponent and the argument of the series, which G joins later. */
RB_INLINE void split_log_block(rb_seen_block *b)
{
    for (int i = 0; i < BLOCK; i++) {
        const double m = rb_log_split(b->W[i], &b->k[i]);
        b->s[i] = (m - 1.0) / (m + 1.0);
    }
}

/* Lam, Th and M of all points by the series for distant ones; near points are mended afterwards. */
RB_INLINE void turn_far_block(double a, int terms, int with_G, rb_seen_block *b)
{
    for (int i = 0; i < BLOCK; i++) {
        rb_view_angles v = kept(b, i);
        rb_turn_far(a, terms, b->over[i] * b->W[i], &v);
        b->q[i] = v.d * (b->over[i] * b->rho[i]);
        b->Lam[i] = v.Lam;
        b->Th[i] = v.Th;
        if (with_G)
            b->M[i] = v.M;
    }
}

RB_INLINE int any_within(double reach2, const double *rho)
{
    int64_t near = 0;
    for (int i = 0; i < EIGHT; i++)
        near |= rho[i] > reach2 ? 0 : 1;
    return near != 0;
}

/* What the series is not good for, at the near points among eight.  From its own midpoint
 * an element is seen under -pi: then the free term 1/2 stands in H.  A number stored
 * apart would hold up the vectors that are read behind it. */
RB_INLINE void mend_near(double a, double reach2, int first, int self, int with_G, rb_seen_block *b)
{
    const double pi = 3.14159265358979323846;
    for (int i = first; i < first + EIGHT; i++) {
        const rb_view_angles v = kept(b, i);
        const double Lam = rb_Lam_near(a, &v);
        b->Lam[i] = b->rho[i] > reach2 ? v.Lam : Lam;
    }
    for (int i = first; i < first + EIGHT; i++) {
        const rb_view_angles v = kept(b, i);
        const double Th = rb_Th_near(a, &v), from_self = (double)(i - self);
        const double turn = from_self == 0.0 ? -pi : Th;
        b->Th[i] = b->rho[i] > reach2 ? v.Th : turn;
        b->q[i] = (a + a) * v.d / v.W;
    }
    for (int i = first; with_G && i < first + EIGHT; i++) {
        const rb_view_angles v = kept(b, i);
        const double M = rb_M_near(a, &v);
        b->M[i] = b->rho[i] > reach2 ? v.M : M;
    }
}

RB_INLINE void mend_near_block(double a, int self, int with_G, rb_seen_block *b)
{
    const double reach = rb_far.reach * a, reach2 = reach * reach;
    for (int first = 0; first < BLOCK; first += EIGHT)
        if (any_within(reach2, b->rho + first))
            mend_near(a, reach2, first, self, with_G, b);
}

RB_INLINE void put_H_block(const rb_constants *k, const rb_seen_block *b, rb_buffer buffer)
{
    for (int i = 0; i < BLOCK; i++) {
        rb_influence out;
        const rb_view_angles v = kept(b, i);
        rb_integrate_H(k, &v, &out);
        put_H(&out, buffer, 2 * i);
    }
}

RB_INLINE void put_G_block(const rb_constants *k, double a, const rb_seen_block *b,
                           rb_buffer buffer)
{
    for (int i = 0; i < BLOCK; i++) {
        rb_influence out;
        rb_view_angles v = kept(b, i);
        v.log_W = rb_log_join(b->k[i], b->s[i]);
        rb_integrate_G(k, a, &v, &out);
        put_G(&out, buffer, 2 * i);
    }
}

/* An element that is integrated over, and whether G is wanted beside H. */
typedef struct {
    const rb_constants *k;
    const rb_element *e;
    int with_G;
} source;

/* In short loops, whose steps are independent: in one long one each result would wait for
 * the last, and the processor does not look far enough ahead to fill the time. */
RB_INLINE void integrate_block(const source *s, const double *x, const double *y, int terms,
                               int self, rb_buffer buffer)
{
    const double a = s->e->a;
    rb_seen_block b;
    see_block(s->e, x, y, &b);
    if (s->with_G)
        split_log_block(&b);
    turn_far_block(a, terms, s->with_G, &b);
    if (terms == rb_far.terms)
        mend_near_block(a, self, s->with_G, &b);
    put_H_block(s->k, &b, buffer);
    if (s->with_G)
        put_G_block(s->k, a, &b, buffer);
}

/* All points of the block, which lie in its circle, are beyond that many half-lengths. */
RB_INLINE int all_beyond(double reach, const rb_element *e, const double circle[3])
{
    const double r = reach * e->a + circle[2], dx = e->mx - circle[0], dy = e->my - circle[1];
    return dx * dx + dy * dy > 1.000001 * (r * r);
}

/* Points i ... i + BLOCK - 1, of which `self` is the element's own. */
RB_INLINE void fill_block(const source *s, const rb_points *points, int i, int self,
                          rb_buffer buffer)
{
    const double *x = points->x + i, *y = points->y + i, *circle = points->circle + 3 * (i / BLOCK);
    if (all_beyond(rb_farthest.reach, s->e, circle))
        integrate_block(s, x, y, rb_farthest.terms, -1, buffer);
    else if (all_beyond(rb_farther.reach, s->e, circle))
        integrate_block(s, x, y, rb_farther.terms, -1, buffer);
    else
        integrate_block(s, x, y, rb_far.terms, self - i, buffer);
}

RB_INLINE void fill(const rb_constants *k, const rb_element *e, int self, const rb_points *points,
                    double *const out[4], stream_line *line)
{
    const int with_G = out[2] || out[3];
    for (int i = 0; i < points->n; i += BLOCK) {
        rb_buffer buffer;
        const int count = points->n - i < BLOCK ? points->n - i : BLOCK;
        if (with_G)
            fill_block(&(source){k, e, 1}, points, i, self, buffer);
        else
            fill_block(&(source){k, e, 0}, points, i, self, buffer);
        if (count == BLOCK)
            send(buffer, BLOCK, i, out, line);
        else
            send(buffer, count, i, out, line);
    }
}

#if defined(__x86_64__) && defined(__GNUC__)
RB_INLINE void line_sse2(double *to, const double *from)
{
    for (int i = 0; i < 8; i += 2)
        _mm_stream_pd(to + i, _mm_loadu_pd(from + i));
}
#define PLAIN_LINE line_sse2
#else
RB_INLINE void line_plain(double *to, const double *from)
{
    memcpy(to, from, 8 * sizeof *to);
}
#define PLAIN_LINE line_plain
#endif

static void fill_plain(const rb_constants *k, const rb_element *e, int self,
                       const rb_points *points, double *const out[4])
{
    fill(k, e, self, points, out, PLAIN_LINE);
}

static const rb_column_variant plain = {"plain", fill_plain};

#if defined(__x86_64__) && defined(__GNUC__)
#ifdef __clang__
#define AVX512 __attribute__((target("avx512f,avx512dq,avx512vl")))
#else
#define AVX512 __attribute__((target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")))
#endif
#define AVX2 __attribute__((target("avx2,fma")))

AVX2 RB_INLINE void line_avx2(double *to, const double *from)
{
    _mm256_stream_pd(to, _mm256_loadu_pd(from));
    _mm256_stream_pd(to + 4, _mm256_loadu_pd(from + 4));
}

AVX512 RB_INLINE void line_avx512(double *to, const double *from)
{
    _mm512_stream_pd(to, _mm512_loadu_pd(from));
}

AVX2 static void fill_avx2(const rb_constants *k, const rb_element *e, int self,
                           const rb_points *points, double *const out[4])
{
    fill(k, e, self, points, out, line_avx2);
}

AVX512 static void fill_avx512(const rb_constants *k, const rb_element *e, int self,
                               const rb_points *points, double *const out[4])
{
    fill(k, e, self, points, out, line_avx512);
}

const rb_column_variant *rb_column_variant_get(int i)
{
    static const rb_column_variant avx512 = {"AVX-512", fill_avx512}, avx2 = {"AVX2", fill_avx2};
    const rb_column_variant *found[3];
    int n = 0;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        found[n++] = &avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        found[n++] = &avx2;
    found[n++] = &plain;
    return i >= 0 && i < n ? found[i] : NULL;
}
#else
const rb_column_variant *rb_column_variant_get(int i)
{
    return i == 0 ? &plain : NULL;
}
#endif
