/* Points of a wide lattice as pairs of big integers. */
#ifndef SUNDER_I_WIDE_VECTOR_H
#define SUNDER_I_WIDE_VECTOR_H

#include "number/lattice.h"

typedef struct sunder_i_vector {
    sunder_i_big x, y;
} sunder_i_vector;

static inline sunder_i_vector sunder_i_wide_get(sunder_i_lattice *l, sunder_i_point a)
{
    return (sunder_i_vector){sunder_i_lattice_get(l, a.x), sunder_i_lattice_get(l, a.y)};
}

static inline sunder_i_vector sunder_i_wide_diff(sunder_i_lattice *l, sunder_i_point b, sunder_i_point a)
{
    const sunder_i_vector u = sunder_i_wide_get(l, b), v = sunder_i_wide_get(l, a);
    return (sunder_i_vector){sunder_i_big_sub(&l->arena, u.x, v.x), sunder_i_big_sub(&l->arena, u.y, v.y)};
}

static inline sunder_i_big sunder_i_wide_cross(sunder_i_lattice *l, sunder_i_vector u, sunder_i_vector v)
{
    return sunder_i_big_sub(&l->arena, sunder_i_big_mul(&l->arena, u.x, v.y), sunder_i_big_mul(&l->arena, u.y, v.x));
}

static inline sunder_i_big sunder_i_wide_dot(sunder_i_lattice *l, sunder_i_vector u, sunder_i_vector v)
{
    return sunder_i_big_add(&l->arena, sunder_i_big_mul(&l->arena, u.x, v.x), sunder_i_big_mul(&l->arena, u.y, v.y));
}

/* Intermediates of a predicate are dropped when it has its sign. */
static inline void sunder_i_wide_drop(sunder_i_lattice *l, sunder_i_mark mark)
{
    if (!l->arena.failed) sunder_i_arena_release(&l->arena, mark);
}

#endif
