/* Numbers with square roots, exactly: sums of integers times products of the roots r_0, r_1, ... where the square of
 * r_i is such a number over the roots before it. They cover every expression in a few nested square roots, up to a
 * denominator that the holder keeps.
 *
 * Part k of a number is the coefficient of the product of the roots whose bits are set in k. The roots need not be
 * independent over the rationals: signs are right all the same. Results live in the arena, as those of big.h do; a
 * failed allocation sets arena->failed and yields zero. */
#ifndef SUNDER_I_SURD_H
#define SUNDER_I_SURD_H

#include "number/ball.h"

#define SUNDER_I_SURD_ROOTS 4

typedef struct sunder_i_surd {
    int height;               /* over the roots 0 .. height - 1 */
    const sunder_i_big *part; /* [2^height] */
} sunder_i_surd;

typedef struct sunder_i_roots {
    int n;
    sunder_i_surd square[SUNDER_I_SURD_ROOTS]; /* > 0, of height at most i */
} sunder_i_roots;

sunder_i_surd sunder_i_surd_big(sunder_i_arena *arena, sunder_i_big v);
/* The root of `square`: an integer if it is one, else one root more (n < SUNDER_I_SURD_ROOTS). False if negative. */
bool sunder_i_surd_root(sunder_i_arena *arena, sunder_i_roots *roots, sunder_i_surd square, sunder_i_surd *out);

sunder_i_surd sunder_i_surd_add(sunder_i_arena *arena, sunder_i_surd a, sunder_i_surd b);
sunder_i_surd sunder_i_surd_sub(sunder_i_arena *arena, sunder_i_surd a, sunder_i_surd b);
sunder_i_surd sunder_i_surd_scale(sunder_i_arena *arena, sunder_i_surd a, sunder_i_big f);
sunder_i_surd sunder_i_surd_shl(sunder_i_arena *arena, sunder_i_surd a, unsigned long shift);
sunder_i_surd sunder_i_surd_mul(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a, sunder_i_surd b);

/* Its value, from the topmost bits of its parts. */
sunder_i_ball sunder_i_surd_ball(const sunder_i_roots *roots, sunder_i_surd a);
int sunder_i_surd_sign(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a);
/* An integer within 2 of a * 2^bits. */
sunder_i_big sunder_i_surd_scaled(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a,
                                  unsigned long bits);

/* Makes room in *to for the roots of `from` too (those that are there already are shared): root i of `from` is root
 * place[i] of the result. False if there are too many. */
bool sunder_i_roots_join(sunder_i_arena *arena, sunder_i_roots *to, const sunder_i_roots *from,
                         int place[SUNDER_I_SURD_ROOTS]);
/* A number over the roots of `from`, over those of the joined ones. */
sunder_i_surd sunder_i_surd_lift(sunder_i_arena *arena, sunder_i_surd a, const int place[SUNDER_I_SURD_ROOTS]);

#endif
