/* trust.h: the basic operations of determinants on a narrow lattice, and whether doubles are trusted.
 *
 * All filters and native predicates of sums use these few functions and macros, so that a benchmark can build the
 * library a second time with another header of this name, which computes in doubles and trusts all of them
 * (tests/bench/naive/): the difference is the cost of exactness. */
#ifndef SUNDER_I_TRUST_H
#define SUNDER_I_TRUST_H

#include "number/wide.h"

/* A determinant of two vectors, or their dot product. */
typedef sunder_i_i128 sunder_i_det;

static inline int sunder_i_det_sign(sunder_i_det v) { return sunder_i_i128_sign(v); }
/* Returns the nearest double. */
static inline double sunder_i_det_double(sunder_i_det v) { return sunder_i_i128_double(v); }
static inline sunder_i_i128 sunder_i_det_i128(sunder_i_det v) { return v; }

/* The error bound of a double. */
#define SUNDER_I_DOUBT(bound) (bound)
/* Whether numbers that doubles do not distinguish may differ. */
#define SUNDER_I_DOUBLES_MAY_ERR 1

#endif
