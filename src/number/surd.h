/* surd.h: numbers with square roots, exactly: sums of integers times products of the roots r_0, r_1, ..., where the
 * square of r_i is such a number over the previous roots. They represent every expression with a few nested square
 * roots, up to a denominator that is stored elsewhere.
 *
 * Part k of a number is the coefficient of the product of the roots whose bits are set in k. The roots need not be
 * independent over the rationals: signs are correct anyway. Results are allocated in the arena, as those of big.h; a
 * failed allocation sets arena->failed and gives zero. */
#ifndef SUNDER_I_SURD_H
#define SUNDER_I_SURD_H

#include "number/ball.h"

#define SUNDER_I_SURD_ROOTS 4

typedef struct sunder_i_surd {
    int height;               /* the number of roots: 0 .. height - 1 */
    const sunder_i_big *part; /* [2^height] */
} sunder_i_surd;

typedef struct sunder_i_roots {
    int n;
    sunder_i_surd square[SUNDER_I_SURD_ROOTS]; /* > 0, of height at most i */
} sunder_i_roots;

sunder_i_surd sunder_i_surd_big(sunder_i_arena *arena, sunder_i_big v);
/* *out becomes the root of `square`: an integer if `square` is the square of one, else a new root is added (roots->n <
 * SUNDER_I_SURD_ROOTS). Returns false if `square` is negative. */
bool sunder_i_surd_root(sunder_i_arena *arena, sunder_i_roots *roots, sunder_i_surd square, sunder_i_surd *out);

sunder_i_surd sunder_i_surd_add(sunder_i_arena *arena, sunder_i_surd a, sunder_i_surd b);
sunder_i_surd sunder_i_surd_sub(sunder_i_arena *arena, sunder_i_surd a, sunder_i_surd b);
sunder_i_surd sunder_i_surd_scale(sunder_i_arena *arena, sunder_i_surd a, sunder_i_big f);
sunder_i_surd sunder_i_surd_shl(sunder_i_arena *arena, sunder_i_surd a, unsigned long shift);
sunder_i_surd sunder_i_surd_mul(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a, sunder_i_surd b);

/* Returns the value as a ball, from the leading bits of its parts. */
sunder_i_ball sunder_i_surd_ball(const sunder_i_roots *roots, sunder_i_surd a);
int sunder_i_surd_sign(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a);
/* Returns an integer whose difference from a * 2^bits is below 2. */
sunder_i_big sunder_i_surd_scaled(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a,
                                  unsigned long bits);

/* Adds the roots of `from` to *to (those that exist there already are shared): root i of `from` becomes root place[i]
 * of *to. Returns false if there are too many. */
bool sunder_i_roots_join(sunder_i_arena *arena, sunder_i_roots *to, const sunder_i_roots *from,
                         int place[SUNDER_I_SURD_ROOTS]);
/* Returns a number over the roots of `from` as a number over the joined roots. */
sunder_i_surd sunder_i_surd_lift(sunder_i_arena *arena, sunder_i_surd a, const int place[SUNDER_I_SURD_ROOTS]);

#endif
