/* The lattice: all coordinates of one problem as integers, without loss.
 *
 * Finite doubles are dyadic rationals, so the coordinates of a problem are integer multiples of one power of two
 * (repaired shapes add one odd common denominator). Taken from an origin near the features, map coordinates fit in 60
 * bits almost always: that is a *narrow* lattice, on which every predicate runs in native and fixed-width integers.
 * Else the lattice is *wide* and the same predicates run on big integers. Code above this folder does not see the
 * difference: it holds points as sunder_i_point and asks the functions of predicate/ about them. On a wide lattice the
 * two fields of a point are handles, so no code outside number/ and predicate/ may do arithmetic on them; equality of
 * handles means nothing either.
 *
 * Value of a lattice integer n: n * 2^exponent / denominator + origin, where the origin is a double that the holder of
 * the points keeps (each operand may have its own; few significant bits, so that sums of origins are exact).
 *
 * A lattice is not shared between threads: it owns the pool of big integers and the operation counters. */
#ifndef SUNDER_I_LATTICE_H
#define SUNDER_I_LATTICE_H

#include "number/big.h"
#include "number/memory.h"
#include "sunder.h"

#define SUNDER_I_NARROW_BITS 60 /* |coordinate| and |sum of two operands' coordinates| < 2^60 on a narrow lattice */

typedef struct sunder_i_point {
    int64_t x, y; /* the integer (narrow), or a handle (wide) */
} sunder_i_point;

typedef struct sunder_i_lattice {
    bool narrow;
    long exponent;
    double scale;             /* 2^-exponent where that is a normal double, else 0 */
    sunder_i_big denominator; /* odd, > 0; 1 unless a shape was repaired */
    int approx_shift;         /* sunder_i_approx() divides by 2^approx_shift; 0 on a narrow lattice */
    sunder_i_arena arena;     /* pool and wide intermediates; arena.failed is the sticky error of everything on it */
    sunder_i_big *pool;       /* wide: integers by handle */
    size_t pool_n, pool_capacity;
    sunder_operations operations;
} sunder_i_lattice;

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

/* A lattice that holds the given extents, each taken from an origin of its own if relative is true: the origin is in
 * origins[i], a multiple of the unit near the middle of extent i (zeroes if relative is false). Narrow if sums of one
 * coordinate of each extent stay below 2^60; with `force_wide` always wide (for tests). */
void sunder_i_lattice_init(sunder_i_lattice *lattice, const sunder_i_extent *extents, size_t n, bool relative,
                           double (*origins)[2], bool force_wide);
void sunder_i_lattice_free(sunder_i_lattice *lattice);

/* The double v, a multiple of the unit, less the origin o, as a lattice integer. Denominator 1. */
int64_t sunder_i_lattice_int(sunder_i_lattice *lattice, double v, double o);
/* A big integer as a lattice integer. Narrow: it must fit. */
int64_t sunder_i_lattice_big(sunder_i_lattice *lattice, sunder_i_big v);
/* A lattice integer as a big one. */
sunder_i_big sunder_i_lattice_get(sunder_i_lattice *lattice, int64_t n);
int64_t sunder_i_lattice_add(sunder_i_lattice *lattice, int64_t a, int64_t b);
int64_t sunder_i_lattice_sub(sunder_i_lattice *lattice, int64_t a, int64_t b);
int64_t sunder_i_lattice_neg(sunder_i_lattice *lattice, int64_t a);
/* Close to n / 2^approx_shift: error at most half an ulp of the largest magnitude on the lattice. Always finite. */
double sunder_i_approx(const sunder_i_lattice *lattice, int64_t n);

#endif
