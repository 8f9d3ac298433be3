/* lanes.h: vectors of four integers or two doubles, as vector types of the compiler that exist on every target. */
#ifndef SUNDER_I_LANES_H
#define SUNDER_I_LANES_H

#include <stdint.h>
#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#define SUNDER_I_LANES 4
typedef uint32_t sunder_i_lanes __attribute__((vector_size(4 * SUNDER_I_LANES)));
typedef int32_t sunder_i_signed_lanes __attribute__((vector_size(4 * SUNDER_I_LANES)));

static inline sunder_i_lanes sunder_i_lanes_at(const uint32_t *v)
{
    sunder_i_lanes l;
    memcpy(&l, v, sizeof l);
    return l;
}

static inline sunder_i_signed_lanes sunder_i_signed_lanes_at(const int32_t *v)
{
    sunder_i_signed_lanes l;
    memcpy(&l, v, sizeof l);
    return l;
}

/* Returns -1 in the lanes where a <= b, else 0. For machines that only compare signed numbers. */
static inline sunder_i_signed_lanes sunder_i_lanes_up_to(sunder_i_lanes a, sunder_i_lanes b)
{
    const uint32_t half = 0x80000000u;
    return (sunder_i_signed_lanes)(a ^ half) <= (sunder_i_signed_lanes)(b ^ half);
}

/* Returns a mask of four bits: bit i is set if lane i is -1, and clear if it is 0. */
static inline uint32_t sunder_i_lanes_set(sunder_i_signed_lanes l)
{
#ifdef __SSE2__
    return (uint32_t)_mm_movemask_ps((__m128)l);
#else
    return (uint32_t)((l[0] & 1) | (l[1] & 2) | (l[2] & 4) | (l[3] & 8));
#endif
}

#define SUNDER_I_DOUBLES 2
typedef double sunder_i_doubles __attribute__((vector_size(8 * SUNDER_I_DOUBLES)));
typedef int64_t sunder_i_double_masks __attribute__((vector_size(8 * SUNDER_I_DOUBLES)));

static inline sunder_i_doubles sunder_i_doubles_at(const double *v)
{
    sunder_i_doubles d;
    memcpy(&d, v, sizeof d);
    return d;
}

static inline uint32_t sunder_i_doubles_set(sunder_i_double_masks m)
{
#ifdef __SSE2__
    return (uint32_t)_mm_movemask_pd((__m128d)m);
#else
    return (uint32_t)((m[0] & 1) | (m[1] & 2));
#endif
}

/* Returns t clamped to [0, 1]; 0 for NaN. Written so that compilers emit no branches. */
static inline double sunder_i_clamped(double t)
{
#ifdef __SSE2__
    return _mm_cvtsd_f64(_mm_min_sd(_mm_max_sd(_mm_set_sd(t), _mm_setzero_pd()), _mm_set_sd(1)));
#else
    return t > 0 ? t < 1 ? t : 1 : 0;
#endif
}

#endif
