/* root.h: the square root of an integer divided by an integer, as doubles. */
#ifndef SUNDER_I_ROOT_H
#define SUNDER_I_ROOT_H

#include "number/big.h"
#include "number/wide.h"

/* Sets *nearest to the double nearest to sqrt(n) / w * 2^exponent, w > 0, and *down to the greatest double that is not
 * greater. */
void sunder_i_root(sunder_i_arena *a, sunder_i_big n, sunder_i_big w, long exponent, double *nearest, double *down);

/* Sets *nearest and *down as sunder_i_root() does, by doubles only, for n <= 2^107 and w <= 2^53. Returns false if the
 * rounding is uncertain, or if |exponent| > 400. */
bool sunder_i_quick_root(sunder_i_u128 n, int64_t w, long exponent, double *nearest, double *down);

#endif
