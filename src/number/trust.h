/* What determinants on a narrow lattice are made of, and how far doubles are believed.
 *
 * All filters and native predicates of sums go through these few words, so that a benchmark can build the library a
 * second time with another header of this name, which computes in doubles and believes all of them
 * (tests/bench/naive/): the difference is what exactness costs. */
#ifndef SUNDER_I_TRUST_H
#define SUNDER_I_TRUST_H

#include "number/wide.h"

/* A determinant of two vectors, or their dot product. */
typedef sunder_i_i128 sunder_i_det;

static inline int sunder_i_det_sign(sunder_i_det v) { return sunder_i_i128_sign(v); }
/* To the nearest double. */
static inline double sunder_i_det_double(sunder_i_det v) { return sunder_i_i128_double(v); }
static inline sunder_i_i128 sunder_i_det_i128(sunder_i_det v) { return v; }

/* What a double may be off by, of which that bound was derived. */
#define SUNDER_I_DOUBT(bound) (bound)
/* May numbers that doubles do not tell apart differ? */
#define SUNDER_I_DOUBLES_MAY_ERR 1

#endif
