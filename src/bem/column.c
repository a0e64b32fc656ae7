#include "bem/column.h"

#include <stdlib.h>
#include <string.h>
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

enum { BLOCK = 16, CHUNK = 128 }; /* points in one vector loop; in one streamed piece */

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
 * would fetch every line first.  Whole lines of 8 at a time. */
typedef void stream_line(double *to, const double *from);

RB_INLINE void stream(double *to, const double *from, int n, stream_line *line)
{
    int i = 0;
    for (; i < n && (uintptr_t)(to + i) % 64; i++)
        to[i] = from[i];
    for (; i + 8 <= n; i += 8)
        line(to + i, from + i);
    for (; i < n; i++)
        to[i] = from[i];
}

/* One block of points; buffer: four columns of 2 CHUNK. */
typedef double rb_buffer[4][2 * CHUNK];

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

RB_INLINE void far_block(const rb_constants *k, const rb_element *e, const double *x,
                         const double *y, int with_G, rb_buffer buffer, int at)
{
    for (int i = 0; i < BLOCK; i++) {
        rb_influence out;
        rb_seen v = rb_see(e, x[i], y[i]);
        rb_turn_far(e->a, with_G, &v);
        rb_integrate_H(k, e->a, &v, &out);
        if (with_G)
            rb_integrate_G(k, e->a, &v, &out);
        put(&out, with_G, buffer, 2 * (at + i));
    }
}

/* Both forms, and of each point the one that suits it: no result depends on neighbours.
 */
RB_INLINE void mixed_block(const rb_constants *k, const rb_element *e, const double *x,
                           const double *y, int with_G, rb_buffer buffer, int at)
{
    for (int i = 0; i < BLOCK; i++) {
        rb_influence out;
        rb_seen v = rb_see(e, x[i], y[i]), far = v;
        const int is_far = rb_is_far(e, x[i], y[i]);
        rb_turn_near(e->a, with_G, &v);
        rb_turn_far(e->a, with_G, &far);
        v.over_W = is_far ? far.over_W : v.over_W;
        v.Lam = is_far ? far.Lam : v.Lam;
        v.Th = is_far ? far.Th : v.Th;
        if (with_G)
            v.log_W = is_far ? far.log_W : v.log_W;
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

RB_INLINE void fill(const rb_constants *k, const rb_element *e, int self,
                    const rb_points *points, double *const out[4], stream_line *line)
{
    const int with_G = out[2] || out[3];
    rb_buffer buffer;
    for (int first = 0; first < points->n; first += CHUNK) {
        const int count = points->n - first < CHUNK ? points->n - first : CHUNK;
        for (int at = 0; at < count; at += BLOCK) {
            const double *x = points->x + first + at, *y = points->y + first + at;
            if (!all_far(e, points->circle + 3 * ((first + at) / BLOCK)))
                mixed_block(k, e, x, y, with_G, buffer, at);
            else if (with_G)
                far_block(k, e, x, y, 1, buffer, at);
            else
                far_block(k, e, x, y, 0, buffer, at);
        }
        if (self >= first && self < first + count)
            put_self(k, e, buffer, self - first);
        for (int c = 0; c < 4; c++)
            if (out[c])
                stream(out[c] + 2 * first, buffer[c], 2 * count, line);
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
