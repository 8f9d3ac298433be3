/* box.h: boxes: closed, with sides parallel to the axes, as four doubles xmin, ymin, xmax, ymax. */
#ifndef SUNDER_I_BOX_H
#define SUNDER_I_BOX_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* Makes the empty box: it meets no other box, and the hull of it and another box is that box. */
static inline void sunder_i_box_clear(double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
}

/* *out becomes the box of the segment ab. */
static inline void sunder_i_box_of_segment(const double a[2], const double b[2], double out[4])
{
    for (int k = 0; k < 2; k++) {
        out[k] = a[k] < b[k] ? a[k] : b[k];
        out[k + 2] = a[k] < b[k] ? b[k] : a[k];
    }
}

/* Enlarges the box to the least one that contains it and the box from `low` to `high`. Without branches, since branch
 * prediction fails here. */
static inline void sunder_i_box_widen(double box[4], const double low[2], const double high[2])
{
#ifdef __SSE2__
    _mm_storeu_pd(box, _mm_min_pd(_mm_loadu_pd(low), _mm_loadu_pd(box)));
    _mm_storeu_pd(box + 2, _mm_max_pd(_mm_loadu_pd(high), _mm_loadu_pd(box + 2)));
#else
    for (int k = 0; k < 2; k++) {
        box[k] = low[k] < box[k] ? low[k] : box[k];
        box[k + 2] = high[k] > box[k + 2] ? high[k] : box[k + 2];
    }
#endif
}

/* The same for a point, and for another box. */
static inline void sunder_i_box_include(double box[4], const double at[2]) { sunder_i_box_widen(box, at, at); }
static inline void sunder_i_box_join(double box[4], const double other[4])
{
    sunder_i_box_widen(box, other, other + 2);
}

static inline bool sunder_i_box_meet(const double a[4], const double b[4])
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

/* sunder_i_box_meet() without branches, for many boxes for which branch prediction fails. */
static inline bool sunder_i_box_meet_any(const double a[4], const double b[4])
{
#ifdef __SSE2__
    const __m128d a_before_b = _mm_cmple_pd(_mm_loadu_pd(a), _mm_loadu_pd(b + 2)),
                  b_before_a = _mm_cmple_pd(_mm_loadu_pd(b), _mm_loadu_pd(a + 2));
    return _mm_movemask_pd(_mm_and_pd(a_before_b, b_before_a)) == 3;
#else
    return (a[0] <= b[2]) & (b[0] <= a[2]) & (a[1] <= b[3]) & (b[1] <= a[3]);
#endif
}

/* Returns true if the boxes are within `reach` of each other along both axes. */
static inline bool sunder_i_box_near(const double a[4], const double b[4], double reach)
{
    return a[0] <= b[2] + reach && b[0] <= a[2] + reach && a[1] <= b[3] + reach && b[1] <= a[3] + reach;
}

/* Returns true if the point (x, y) is within `reach` of the box along both axes, or if a coordinate is NaN. */
static inline bool sunder_i_box_near_point(const double box[4], double x, double y, double reach)
{
#ifdef __SSE2__
    const __m128d at = _mm_set_pd(y, x), by = _mm_set1_pd(reach);
    const __m128d below = _mm_cmplt_pd(at, _mm_sub_pd(_mm_loadu_pd(box), by)),
                  above = _mm_cmpgt_pd(at, _mm_add_pd(_mm_loadu_pd(box + 2), by));
    return _mm_movemask_pd(_mm_or_pd(below, above)) == 0;
#else
    return !((x < box[0] - reach) | (x > box[2] + reach) | (y < box[1] - reach) | (y > box[3] + reach));
#endif
}

/* *out becomes the Minkowski sum of two boxes. */
static inline void sunder_i_box_sum(const double a[4], const double b[4], double out[4])
{
    for (int k = 0; k < 4; k++) out[k] = a[k] + b[k];
}

/* Returns true if the point (x, y) is within `reach` of the Minkowski sum of the two boxes along both axes. */
static inline bool sunder_i_box_sum_near_point(const double a[4], const double b[4], double x, double y, double reach)
{
    double sum[4];
    sunder_i_box_sum(a, b, sum);
    return sunder_i_box_near_point(sum, x, y, reach);
}

/* *out becomes the distance of the box from the origin along each axis. */
static inline void sunder_i_box_distance(const double box[4], double out[2])
{
#ifdef __SSE2__ /* without branches, which compilers insert */
    const __m128d low = _mm_loadu_pd(box), high = _mm_loadu_pd(box + 2), none = _mm_setzero_pd();
    _mm_storeu_pd(out, _mm_max_pd(_mm_max_pd(low, _mm_sub_pd(none, high)), none));
#else
    for (int k = 0; k < 2; k++) {
        const double beyond = box[k] > -box[k + 2] ? box[k] : -box[k + 2];
        out[k] = beyond > 0 ? beyond : 0;
    }
#endif
}

/* Returns the next double downwards, or (up) upwards, like nextafter(): adjacent doubles of one sign have adjacent bit
 * patterns. */
static inline double sunder_i_box_step(double x, bool up)
{
    uint64_t bits;
    if (!(fabs(x) > 0x1p-1000 && fabs(x) < 0x1p1000)) return nextafter(x, up ? INFINITY : -INFINITY);
    memcpy(&bits, &x, sizeof bits);
    bits += (x > 0) == up ? 1 : UINT64_MAX;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* *out becomes the box enlarged by `reach` on each side; a step to the next double outward covers the rounding of the
 * sum. */
static inline void sunder_i_box_grow(const double box[4], double reach, double out[4])
{
    out[0] = sunder_i_box_step(box[0] - reach, false);
    out[1] = sunder_i_box_step(box[1] - reach, false);
    out[2] = sunder_i_box_step(box[2] + reach, true);
    out[3] = sunder_i_box_step(box[3] + reach, true);
}

#endif
