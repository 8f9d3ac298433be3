/* Lengths: the root of an integer over another, as doubles. */
#ifndef SUNDER_I_ROOT_H
#define SUNDER_I_ROOT_H

#include "number/big.h"
#include "number/wide.h"

/* sqrt(n) / w * 2^exponent, w > 0: the nearest double, and the greatest that is no more. */
void sunder_i_root(sunder_i_arena *a, sunder_i_big n, sunder_i_big w, long exponent, double *nearest, double *down);

/* Computes the same with doubles, for n <= 2^107 and w <= 2^53. Returns false if they leave a doubt. */
bool sunder_i_quick_root(sunder_i_u128 n, int64_t w, long exponent, double *nearest, double *down);

#endif
