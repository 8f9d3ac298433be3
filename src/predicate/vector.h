/* Points and vectors off the narrow lattices: integers over one denominator. Signs of products are those of the
 * numerators, since denominators are positive. */
#ifndef SUNDER_I_VECTOR_H
#define SUNDER_I_VECTOR_H

#include "number/lattice.h"

/* (x / w, y / w), w > 0. */
typedef struct sunder_i_vector {
    sunder_i_big x, y, w;
} sunder_i_vector;

/* A lattice point; plain numbers are made on that arena. The lattice stays as it is. */
sunder_i_vector sunder_i_vector_get(sunder_i_arena *arena, const sunder_i_lattice *lattice, sunder_i_point a);
/* u - v; where both have one denominator it is that of the difference. */
sunder_i_vector sunder_i_vector_sub(sunder_i_arena *arena, sunder_i_vector u, sunder_i_vector v);
sunder_i_vector sunder_i_vector_diff(sunder_i_arena *arena, const sunder_i_lattice *lattice, sunder_i_point b,
                                     sunder_i_point a);
/* As a point of the lattice, whose arena gets copies. */
sunder_i_point sunder_i_vector_put(sunder_i_lattice *lattice, sunder_i_vector u);

bool sunder_i_is_one(sunder_i_big a);

/* Cross and dot product, times both denominators. */
static inline sunder_i_big sunder_i_vector_cross(sunder_i_arena *arena, sunder_i_vector u, sunder_i_vector v)
{
    return sunder_i_big_sub(arena, sunder_i_big_mul(arena, u.x, v.y), sunder_i_big_mul(arena, u.y, v.x));
}

static inline sunder_i_big sunder_i_vector_dot(sunder_i_arena *arena, sunder_i_vector u, sunder_i_vector v)
{
    return sunder_i_big_add(arena, sunder_i_big_mul(arena, u.x, v.x), sunder_i_big_mul(arena, u.y, v.y));
}

/* a times b where b is a denominator: most are one. */
static inline sunder_i_big sunder_i_times(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    return b.size == 1 && b.limb[0] == 1 ? a : sunder_i_big_mul(arena, a, b);
}

#endif
