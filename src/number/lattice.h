/* lattice.h: the lattice: represents all coordinates of one problem exactly.
 *
 * Finite doubles are dyadic rationals, so that the coordinates of a problem are integer multiples of one power of two.
 * Relative to an origin near the features, map coordinates nearly always fit in 60 bits. There are two kinds of numbers
 * on a lattice, both represented by an int64_t: a *plain* integer, below 2^61 in magnitude, is itself. Any other number
 * (a longer integer, or a coordinate of a repaired shape's vertex, which is the intersection of two lattice segments
 * and has a denominator) is a *handle* of a ratio of big integers in the lattice's pool. There is no common
 * denominator.
 *
 * On a *narrow* lattice all numbers are plain, and every predicate uses native and fixed-width integers without tests.
 * Otherwise the predicates test the given numbers: plain ones are treated in the same way, and only operations with
 * handles among the operands use a floating-point filter, and then big integers. Code outside number/ and predicate/
 * does not depend on the difference: it has points as sunder_i_point and calls the functions of predicate/. On lattices
 * that are not narrow, no other code may compute with the fields of a point; equality of handles has no meaning either.
 *
 * The value of a number n is n * 2^exponent + origin, where the origin is a double that is stored with the points (each
 * operand may have its own; it has few significant bits, so that sums of origins are exact).
 *
 * A lattice must not be used by several threads at once: it owns the pool of ratios and the operation counters. */
#ifndef SUNDER_I_LATTICE_H
#define SUNDER_I_LATTICE_H

#include "number/ratio.h"
#include "sunder_base.h"

#include <math.h>
#include <string.h>

#define SUNDER_I_NARROW_BITS 60 /* |coordinate| and |sum of two operands' coordinates| < 2^60 on a narrow lattice */
#define SUNDER_I_PLAIN_BITS 61  /* |plain number| < 2^61: differences of such coordinates are plain, too */

typedef struct sunder_i_point {
    int64_t x, y; /* plain numbers, or handles */
} sunder_i_point;

/* A ratio of the pool, and the nearest double in the units of sunder_i_approx(). */
typedef struct sunder_i_pooled {
    sunder_i_ratio ratio;
    double value;
} sunder_i_pooled;

typedef struct sunder_i_lattice {
    bool narrow; /* all numbers are plain */
    bool small;  /* all doubles for which it was made, minus their origins, are plain */
    bool pooled; /* no number is made plain (for tests of the big-integer code) */
    long exponent;
    double scale;           /* 2^-exponent if that is a normal double, else 0 */
    int approx_shift;       /* sunder_i_approx() divides by 2^approx_shift; 0 on a narrow lattice */
    sunder_i_arena arena;   /* memory for the pool and results; every function on the lattice sets arena.failed if out
                             * of memory */
    sunder_i_arena scratch; /* memory for one predicate or construction at a time */
    sunder_i_pooled *pool;  /* indexed by handle - INT64_MIN */
    size_t pool_n, pool_capacity;
    sunder_counts counts;
} sunder_i_lattice;

static inline bool sunder_i_is_plain(int64_t n) { return n > INT64_MIN / 2; }

/* Returns true if both coordinates are plain: a handle among them makes the lesser one more negative than all plain
 * ones. */
static inline bool sunder_i_point_is_plain(sunder_i_point a) { return sunder_i_is_plain(a.x < a.y ? a.x : a.y); }

/* The requirements for a lattice: they are collected over all operands, then the lattice is chosen. */
typedef struct sunder_i_extent {
    bool any;
    double low[2], high[2]; /* exact bounds of dyadic operands */
    int low_bit;            /* every coordinate is a multiple of 2^low_bit */
} sunder_i_extent;

/* Adds n points x0 y0 x1 y1 ..., all finite. An extent of zeros is the empty one. */
void sunder_i_extent_add(sunder_i_extent *extent, const double *xy, size_t n);
/* Returns the exponent of the lowest set bit of v (finite); INT_MAX for zero. */
int sunder_i_low_bit(double v);
/* Returns 2^e; without a call to ldexp() if that is a normal double. */
static inline double sunder_i_power_of_two(long e)
{
    if (e < -1022 || e > 1023) return ldexp(1, e < -2000 ? -2000 : e > 2000 ? 2000 : (int)e);
    const uint64_t bits = (uint64_t)(e + 1023) << 52;
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

/* Returns the origin for coordinates in [low, high]: a double with at most 20 significant bits near the middle, a
 * multiple of the unit 2^bit, or zero if the range extends down to that scale anyway. */
double sunder_i_lattice_origin(double low, double high, int bit);
/* Makes a lattice that represents the given extents, each relative to an origin of its own if `relative`: origins[i]
 * becomes a multiple of the unit near the middle of extent i (zeros if not `relative`). The lattice is small if sums of
 * one coordinate of each extent are below 2^60, and then narrow; with `force_wide` all numbers are pooled (for
 * tests). */
void sunder_i_lattice_init(sunder_i_lattice *lattice, const sunder_i_extent *extents, size_t n, bool relative,
                           double (*origins)[2], bool force_wide);
/* Permits numbers that are not plain: the lattice is no longer narrow. */
void sunder_i_lattice_admit_ratios(sunder_i_lattice *lattice);
void sunder_i_lattice_free(sunder_i_lattice *lattice);

/* Returns the number of the double v, a multiple of the unit, minus the origin o. */
int64_t sunder_i_lattice_int(sunder_i_lattice *lattice, double v, double o);
/* Converts n points x0 y0 x1 y1 ..., minus the origin. */
void sunder_i_lattice_points(sunder_i_lattice *lattice, const double *xy, size_t n, const double origin[2],
                             sunder_i_point *out);
/* Returns the number of a big integer, which is stored without a copy. On a narrow lattice it must be plain. */
int64_t sunder_i_lattice_big(sunder_i_lattice *lattice, sunder_i_big v);
/* Returns the number of num / den, den > 0; not on narrow lattices. */
int64_t sunder_i_lattice_ratio(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den);
/* Returns a handle of num / den, den > 0, even if that is a plain number; `value`: the nearest double in the units of
 * sunder_i_approx(). */
int64_t sunder_i_lattice_pool(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den, double value);
/* Returns a number as a ratio; plain ones are allocated in `arena`. The lattice does not change. */
sunder_i_ratio sunder_i_lattice_read(sunder_i_arena *arena, const sunder_i_lattice *lattice, int64_t n);
/* Returns a number that is an integer, in the lattice's arena. */
sunder_i_big sunder_i_lattice_get(sunder_i_lattice *lattice, int64_t n);
/* Returns an approximation of n / 2^approx_shift: the error is at most half an ulp of the largest magnitude on the
 * lattice. Always finite. */
static inline double sunder_i_approx(const sunder_i_lattice *lattice, int64_t n)
{
    if (!sunder_i_is_plain(n)) return lattice->pool[n - INT64_MIN].value;
    return lattice->approx_shift ? ldexp((double)n, -lattice->approx_shift) : (double)n;
}
/* The absolute error of the cross product of two differences in those units by underflow, in addition to its relative
 * error: each difference has an error of half of 2^-1074 then, times another below 2^502, and a sum has a few such
 * terms. */
#define SUNDER_I_APPROX_UNDERFLOW 0x1p-560

/* Temporary numbers in the scratch arena are allocated between these two calls, which may be nested. A failure there is
 * one of the lattice. */
sunder_i_mark sunder_i_lattice_begin(sunder_i_lattice *lattice);
void sunder_i_lattice_end(sunder_i_lattice *lattice, sunder_i_mark mark);

#endif
