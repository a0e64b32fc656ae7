#include "bem/column.h"

#include <stdlib.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

enum { BLOCK = 16, CHUNK = 128 }; /* points in one vector loop; in one streamed piece */

void rb_points_free(rb_points *points)
{
    free(points->x);
    points->x = points->y = NULL;
}

rb_status rb_points_make(int n, const double *x, const double *y, rb_points *points)
{
    const size_t padded = ((size_t)n + BLOCK - 1) / BLOCK * BLOCK;
    *points = (rb_points){.n = n, .x = rb_alloc(padded, 2)};
    if (!points->x)
        return RB_ENOMEM;
    points->y = points->x + padded;
    for (size_t i = 0; i < padded; i++) {
        points->x[i] = x[i < (size_t)n ? i : (size_t)n - 1];
        points->y[i] = y[i < (size_t)n ? i : (size_t)n - 1];
    }
    return RB_OK;
}

/* Past the caches: the matrix is not read before it is complete, and a plain store would
 * fetch every line first. */
static void stream(double *to, const double *from, int n)
{
    int i = 0;
#ifdef __SSE2__
    for (; i < n && (uintptr_t)(to + i) % 16; i++)
        to[i] = from[i];
    for (; i + 2 <= n; i += 2)
        _mm_stream_pd(to + i, _mm_loadu_pd(from + i));
#endif
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
        rb_turn_far(e->a, &v);
        rb_integrate_H(k, e, &v, &out);
        if (with_G)
            rb_integrate_G(k, e, &v, &out);
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
        rb_turn_near(e->a, &v);
        rb_turn_far(e->a, &far);
        v.over_W = is_far ? far.over_W : v.over_W;
        v.Lam = is_far ? far.Lam : v.Lam;
        v.Th = is_far ? far.Th : v.Th;
        rb_integrate_H(k, e, &v, &out);
        if (with_G)
            rb_integrate_G(k, e, &v, &out);
        put(&out, with_G, buffer, 2 * (at + i));
    }
}

RB_INLINE int all_far(const rb_element *e, const double *x, const double *y)
{
    int far = 1;
    for (int i = 0; i < BLOCK; i++)
        far &= rb_is_far(e, x[i], y[i]);
    return far;
}

static void put_self(const rb_constants *k, const rb_element *e, rb_buffer buffer, int i)
{
    rb_influence out;
    rb_integrate_self(k, e, &out);
    put(&out, 1, buffer, 2 * i);
}

RB_INLINE void fill(const rb_constants *k, const rb_element *e, int self,
                    const rb_points *points, double *const out[4])
{
    const int with_G = out[2] || out[3];
    rb_buffer buffer;
    for (int first = 0; first < points->n; first += CHUNK) {
        const int count = points->n - first < CHUNK ? points->n - first : CHUNK;
        for (int at = 0; at < count; at += BLOCK) {
            const double *x = points->x + first + at, *y = points->y + first + at;
            if (!all_far(e, x, y))
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
                stream(out[c] + 2 * first, buffer[c], 2 * count);
    }
}

static void fill_plain(const rb_constants *k, const rb_element *e, int self,
                       const rb_points *points, double *const out[4])
{
    fill(k, e, self, points, out);
}

static const rb_column_variant plain = {"plain", fill_plain};

#if defined(__x86_64__) && defined(__GNUC__)
#ifdef __clang__
#define AVX512 "avx512f,avx512dq,avx512vl"
#else
#define AVX512 "avx512f,avx512dq,avx512vl,prefer-vector-width=512"
#endif

__attribute__((target("avx2"))) static void fill_avx2(const rb_constants *k,
                                                      const rb_element *e, int self,
                                                      const rb_points *points,
                                                      double *const out[4])
{
    fill(k, e, self, points, out);
}

__attribute__((target(AVX512))) static void fill_avx512(const rb_constants *k,
                                                        const rb_element *e, int self,
                                                        const rb_points *points,
                                                        double *const out[4])
{
    fill(k, e, self, points, out);
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
