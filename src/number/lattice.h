/* The lattice: all coordinates of one problem, without loss.
 *
 * Finite doubles are dyadic rationals, so the coordinates of a problem are integer multiples of one power of two. Taken
 * from an origin near the features, map coordinates fit in 60 bits almost always. Two kinds of numbers stand on a
 * lattice, and both are an int64_t: a *plain* integer, below 2^61 in magnitude, is itself. Anything else (a longer
 * integer, or a corner of a repaired shape, which is the crossing of two lattice segments and has a denominator) is a
 * *handle* of a ratio of big integers in the lattice's pool. No denominator is common to anything.
 *
 * On a *narrow* lattice all numbers are plain, and every predicate runs in native and fixed-width integers without
 * asking. Elsewhere the predicates look at the numbers they are given: plain ones go the same way, and only what has
 * handles among its operands is put to a floating-point filter, and then to big integers. Code above this folder does
 * not see the difference: it holds points as sunder_i_point and asks the functions of predicate/ about them. Off narrow
 * lattices no code outside number/ and predicate/ may do arithmetic on the fields of a point; equality of handles means
 * nothing either.
 *
 * Value of a number n: n * 2^exponent + origin, where the origin is a double that the holder of the points keeps (each
 * operand may have its own; few significant bits, so that sums of origins are exact).
 *
 * A lattice is not shared between threads: it owns the pool of ratios and the operation counters. */
#ifndef SUNDER_I_LATTICE_H
#define SUNDER_I_LATTICE_H

#include "number/ratio.h"
#include "sunder.h"

#include <math.h>
#include <string.h>

#define SUNDER_I_NARROW_BITS 60 /* |coordinate| and |sum of two operands' coordinates| < 2^60 on a narrow lattice */
#define SUNDER_I_PLAIN_BITS 61  /* |plain number| < 2^61: differences of such coordinates are plain too */

typedef struct sunder_i_point {
    int64_t x, y; /* plain, or handles */
} sunder_i_point;

/* A ratio of the pool, and the nearest double in the units of sunder_i_approx(). */
typedef struct sunder_i_pooled {
    sunder_i_ratio ratio;
    double value;
} sunder_i_pooled;

typedef struct sunder_i_lattice {
    bool narrow; /* all numbers are plain */
    bool small;  /* all doubles that it was made for are plain, less their origins */
    bool pooled; /* no number is made plain (for tests, which ask the longest rung of the ladder so) */
    long exponent;
    double scale;           /* 2^-exponent where that is a normal double, else 0 */
    int approx_shift;       /* sunder_i_approx() divides by 2^approx_shift; 0 on a narrow lattice */
    sunder_i_arena arena;   /* pool and results; arena.failed is the sticky error of everything on it */
    sunder_i_arena scratch; /* of one predicate or construction at a time */
    sunder_i_pooled *pool;  /* by handle */
    size_t pool_n, pool_capacity;
    sunder_counts counts;
} sunder_i_lattice;

static inline bool sunder_i_is_plain(int64_t n) { return n > INT64_MIN / 2; }

/* All of these numbers: a handle among them makes the least one negative beyond all plain ones. */
static inline bool sunder_i_point_is_plain(sunder_i_point a) { return sunder_i_is_plain(a.x < a.y ? a.x : a.y); }

/* What a lattice has to hold: gathered over all operands, then the lattice is chosen. */
typedef struct sunder_i_extent {
    bool any;
    double low[2], high[2]; /* exact bounds of dyadic operands */
    int low_bit;            /* every coordinate is a multiple of 2^low_bit */
} sunder_i_extent;

/* Adds n points x0 y0 x1 y1 ..., all finite. A zeroed extent is the empty one. */
void sunder_i_extent_add(sunder_i_extent *extent, const double *xy, size_t n);
/* The exponent of the lowest set bit of v (finite); INT_MAX for zero. */
int sunder_i_low_bit(double v);
/* ldexp(1, e), without a call where that is a normal double. */
static inline double sunder_i_power_of_two(long e)
{
    if (e < -1022 || e > 1023) return ldexp(1, e < -2000 ? -2000 : e > 2000 ? 2000 : (int)e);
    const uint64_t bits = (uint64_t)(e + 1023) << 52;
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

/* The origin for coordinates in [low, high]: a double with at most 20 significant bits near the middle, a multiple of
 * the unit 2^bit, or zero where the range reaches down to that scale anyway. */
double sunder_i_lattice_origin(double low, double high, int bit);
/* A lattice that holds the given extents, each taken from an origin of its own if relative is true: the origin is in
 * origins[i], a multiple of the unit near the middle of extent i (zeroes if relative is false). Small if sums of one
 * coordinate of each extent stay below 2^60, and then narrow; with `force_wide` all numbers are pooled (for tests). */
void sunder_i_lattice_init(sunder_i_lattice *lattice, const sunder_i_extent *extents, size_t n, bool relative,
                           double (*origins)[2], bool force_wide);
/* From now on numbers that are not plain may come: the lattice is not narrow any more. */
void sunder_i_lattice_admit_ratios(sunder_i_lattice *lattice);
void sunder_i_lattice_free(sunder_i_lattice *lattice);

/* The double v, a multiple of the unit, less the origin o, as a number. */
int64_t sunder_i_lattice_int(sunder_i_lattice *lattice, double v, double o);
/* n points x0 y0 x1 y1 ..., less that origin. */
void sunder_i_lattice_points(sunder_i_lattice *lattice, const double *xy, size_t n, const double origin[2],
                             sunder_i_point *out);
/* A big integer as a number; it is kept, not copied. On a narrow lattice it must be plain. */
int64_t sunder_i_lattice_big(sunder_i_lattice *lattice, sunder_i_big v);
/* The same of num / den, den > 0, not on narrow lattices. */
int64_t sunder_i_lattice_ratio(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den);
/* A handle of num / den, den > 0, even where that is a plain number. */
int64_t sunder_i_lattice_pool(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den, double value);
/* A number as a ratio; plain ones are made on that arena. The lattice stays as it is. */
sunder_i_ratio sunder_i_lattice_read(sunder_i_arena *arena, const sunder_i_lattice *lattice, int64_t n);
/* A number that is an integer, on the lattice's arena. */
sunder_i_big sunder_i_lattice_get(sunder_i_lattice *lattice, int64_t n);
/* Close to n / 2^approx_shift: error at most half an ulp of the largest magnitude on the lattice. Always finite. */
static inline double sunder_i_approx(const sunder_i_lattice *lattice, int64_t n)
{
    if (!sunder_i_is_plain(n)) return lattice->pool[n - INT64_MIN].value;
    return lattice->approx_shift ? ldexp((double)n, -lattice->approx_shift) : (double)n;
}
/* What the cross product of two differences in those units may be off by where they underflow, besides what is relative
 * to them: each is off by half of 2^-1074 then, times another below 2^502, and a sum has a few such terms. */
#define SUNDER_I_APPROX_UNDERFLOW 0x1p-560

/* Temporaries on the scratch arena live between these two; they nest. A failure there is one of the lattice. */
sunder_i_mark sunder_i_lattice_begin(sunder_i_lattice *lattice);
void sunder_i_lattice_end(sunder_i_lattice *lattice, sunder_i_mark mark);

#endif
