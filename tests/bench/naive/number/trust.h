/* Replaces src/number/trust.h in a library that computes determinants in doubles and trusts every result. Its results
 * are right if coordinates are small integers, for which no decisive operation is rounded, and not otherwise. */
#ifndef SUNDER_I_TRUST_H
#define SUNDER_I_TRUST_H

#include "number/wide.h"

typedef double sunder_i_det;

static inline int sunder_i_det_sign(sunder_i_det v) { return (v > 0) - (v < 0); }
static inline double sunder_i_det_double(sunder_i_det v) { return v; }
static inline sunder_i_i128 sunder_i_det_i128(sunder_i_det v) { return (int64_t)v; }

#define SUNDER_I_DOUBT(bound) 0.0
#define SUNDER_I_DOUBLES_MAY_ERR 0

#endif
