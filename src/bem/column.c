#include "bem/column.h"

#include <stdlib.h>
#include <string.h>
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

enum { BLOCK = 32, CHUNK = 256 }; /* points in one vector loop; in one buffer */

void rb_points_free(rb_points *points)
{
    free(points->x);
    *points = (rb_points){0};
}

/* Centre and radius of a circle about one block of points. */
static void enclose(const double *x, const double *y, double circle[3])
{
    double cx = 0.0, cy = 0.0, r = 0.0;
    for (int i = 0; i < BLOCK; i++) {
        cx += x[i] / BLOCK;
        cy += y[i] / BLOCK;
    }
    for (int i = 0; i < BLOCK; i++)
        r = fmax(r, hypot(x[i] - cx, y[i] - cy));
    circle[0] = cx;
    circle[1] = cy;
    circle[2] = r;
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
    for (size_t b = 0; b < blocks; b++)
        enclose(points->x + b * BLOCK, points->y + b * BLOCK, points->circle + 3 * b);
    return RB_OK;
}

/* Stores past the caches: the matrix is not read before it is complete, and a plain store
 * would fetch every line first.  Whole lines of 8, as soon as they are there, so that
 * they drain while the next block is computed; returns how far it came. */
typedef void stream_line(double *to, const double *from);

RB_INLINE int stream(double *to, const double *from, int sent, int ready,
                     stream_line *line)
{
    for (; sent + 8 <= ready; sent += 8)
        line(to + sent, from + sent);
    return sent;
}

/* Doubles before the first whole line. */
static int head(const double *to)
{
    return (int)((64 - (uintptr_t)to % 64) % 64 / sizeof *to);
}

/* One block of points; buffer: four columns of 2 CHUNK. */
typedef double rb_buffer[4][2 * CHUNK];

typedef struct {
    double X[BLOCK], d[BLOCK], square_re[BLOCK], square_im[BLOCK], dot[BLOCK],
        cross[BLOCK], W[BLOCK], over_W[BLOCK], a_over_rho[BLOCK], Lam[BLOCK], Th[BLOCK],
        log_W[BLOCK];
} rb_seen_block;

RB_INLINE void keep(const rb_seen *v, rb_seen_block *b, int i)
{
    b->X[i] = v->X;
    b->d[i] = v->d;
    b->square_re[i] = v->square_re;
    b->square_im[i] = v->square_im;
    b->dot[i] = v->dot;
    b->cross[i] = v->cross;
    b->W[i] = v->W;
    b->over_W[i] = v->over_W;
    b->a_over_rho[i] = v->a_over_rho;
    b->log_W[i] = v->log_W;
}

RB_INLINE rb_seen kept(const rb_seen_block *b, int i)
{
    rb_seen v;
    v.X = b->X[i];
    v.d = b->d[i];
    v.square_re = b->square_re[i];
    v.square_im = b->square_im[i];
    v.dot = b->dot[i];
    v.cross = b->cross[i];
    v.W = b->W[i];
    v.over_W = b->over_W[i];
    v.a_over_rho = b->a_over_rho[i];
    v.Lam = b->Lam[i];
    v.Th = b->Th[i];
    v.log_W = b->log_W[i];
    return v;
}

RB_INLINE void put(const rb_influence *v, int with_G, rb_buffer buffer, int i)
{
    buffer[0][i] = v->Hxx;
    buffer[0][i + 1] = v->Hyx;
    buffer[1][i] = v->Hxy;
    buffer[1][i + 1] = v->Hyy;
    if (with_G) {
        buffer[2][i] = v->Gxx;
        buffer[2][i + 1] = buffer[3][i] = v->Gxy;
        buffer[3][i + 1] = v->Gyy;
    }
}

/* y = x where chosen = 1, y where it is 0: no branch. */
RB_INLINE void choose(double chosen, double x, double *y)
{
    *y = chosen * x + (1.0 - chosen) * *y;
}

/* What the far form is not good for, at the near points of a block. */
RB_INLINE void mend_near(const rb_element *e, const double *x, const double *y,
                         int with_G, rb_seen_block *b)
{
    double near[BLOCK];
    for (int i = 0; i < BLOCK; i++)
        near[i] = rb_is_far(e, x[i], y[i]) ? 0.0 : 1.0;
    for (int i = 0; i < BLOCK; i++) {
        const rb_seen v = kept(b, i);
        choose(near[i], rb_Lam_near(e->a, &v), &b->Lam[i]);
    }
    for (int i = 0; i < BLOCK; i++) {
        const rb_seen v = kept(b, i);
        choose(near[i], rb_Th_near(&v), &b->Th[i]);
    }
    for (int i = 0; i < BLOCK; i++) {
        choose(near[i], 1.0 / b->W[i], &b->over_W[i]);
        if (with_G)
            choose(near[i], rb_log(b->W[i]), &b->log_W[i]);
    }
}

/* In short loops, whose steps are independent: in one long one each result would wait for
 * the last, and the processor does not look far enough ahead to fill the time. */
RB_INLINE void integrate_block(const rb_constants *k, const rb_element *e,
                               const double *x, const double *y, int far, int with_G,
                               rb_buffer buffer, int at)
{
    rb_seen_block b;
    for (int i = 0; i < BLOCK; i++) {
        rb_seen v = rb_see(e, x[i], y[i]);
        v.log_W = 0.0;
        rb_divide_far(e->a, with_G, &v);
        keep(&v, &b, i);
    }
    for (int i = 0; i < BLOCK; i++) {
        rb_seen v = kept(&b, i);
        rb_turn_far(e->a, &v);
        b.Lam[i] = v.Lam;
        b.Th[i] = v.Th;
    }
    if (!far)
        mend_near(e, x, y, with_G, &b);
    for (int i = 0; i < BLOCK; i++) {
        rb_influence out;
        const rb_seen v = kept(&b, i);
        rb_integrate_H(k, e->a, &v, &out);
        if (with_G)
            rb_integrate_G(k, e->a, &v, &out);
        put(&out, with_G, buffer, 2 * (at + i));
    }
}

/* Every point of the block lies in its circle: one comparison for all. */
RB_INLINE int all_far(const rb_element *e, const double circle[3])
{
    const double reach = 20.0 * e->a + circle[2], dx = e->mx - circle[0],
                 dy = e->my - circle[1];
    return dx * dx + dy * dy > 1.000001 * (reach * reach);
}

static void put_self(const rb_constants *k, const rb_element *e, rb_buffer buffer, int i)
{
    rb_influence out;
    rb_integrate_self(k, e->a, &out);
    put(&out, 1, buffer, 2 * i);
}

RB_INLINE void fill_block(const rb_constants *k, const rb_element *e, int self,
                          const rb_points *points, int first, int at, int with_G,
                          rb_buffer buffer)
{
    const int i = first + at;
    const int far = all_far(e, points->circle + 3 * (i / BLOCK));
    integrate_block(k, e, points->x + i, points->y + i, far, with_G, buffer, at);
    if (self >= i && self < i + BLOCK)
        put_self(k, e, buffer, self - first);
}

/* Points first ... first + count - 1. */
RB_INLINE void fill_chunk(const rb_constants *k, const rb_element *e, int self,
                          const rb_points *points, int first, int count,
                          double *const out[4], int with_G, stream_line *line)
{
    rb_buffer buffer;
    int start[4], sent[4];
    for (int c = 0; c < 4; c++)
        start[c] = sent[c] = out[c] ? head(out[c] + 2 * first) : 0;
    for (int at = 0; at < count; at += BLOCK) {
        const int ready = 2 * (at + BLOCK < count ? at + BLOCK : count);
        fill_block(k, e, self, points, first, at, with_G, buffer);
        for (int c = 0; c < 4; c++)
            if (out[c])
                sent[c] = stream(out[c] + 2 * first, buffer[c], sent[c], ready, line);
    }
    for (int c = 0; c < 4; c++) {
        for (int i = 0; out[c] && i < start[c] && i < 2 * count; i++)
            out[c][2 * first + i] = buffer[c][i];
        for (int i = sent[c]; out[c] && i < 2 * count; i++)
            out[c][2 * first + i] = buffer[c][i];
    }
}

RB_INLINE void fill(const rb_constants *k, const rb_element *e, int self,
                    const rb_points *points, double *const out[4], stream_line *line)
{
    for (int first = 0; first < points->n; first += CHUNK) {
        const int count = points->n - first < CHUNK ? points->n - first : CHUNK;
        if (out[2] || out[3])
            fill_chunk(k, e, self, points, first, count, out, 1, line);
        else
            fill_chunk(k, e, self, points, first, count, out, 0, line);
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
#define AVX512                                                                           \
    __attribute__((target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")))
#endif
#define AVX2 __attribute__((target("avx2")))

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
    static const rb_column_variant avx512 = {"AVX-512", fill_avx512},
                                   avx2 = {"AVX2", fill_avx2};
    const rb_column_variant *found[3];
    int n = 0;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        found[n++] = &avx512;
    if (__builtin_cpu_supports("avx2"))
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
