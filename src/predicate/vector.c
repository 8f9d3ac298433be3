#include "predicate/vector.h"

bool sunder_i_is_one(sunder_i_big a) { return a.size == 1 && a.limb[0] == 1; }

static bool equal(sunder_i_big a, sunder_i_big b)
{
    return a.size == b.size && (a.limb == b.limb || sunder_i_big_cmp(a, b) == 0);
}

sunder_i_vector sunder_i_vector_get(sunder_i_arena *arena, const sunder_i_lattice *l, sunder_i_point a)
{
    const sunder_i_ratio x = sunder_i_lattice_read(arena, l, a.x), y = sunder_i_lattice_read(arena, l, a.y);
    if (equal(x.den, y.den)) return (sunder_i_vector){x.num, y.num, x.den};
    /* One of the two is an integer, or they were made apart. */
    return (sunder_i_vector){sunder_i_times(arena, x.num, y.den), sunder_i_times(arena, y.num, x.den),
                             sunder_i_times(arena, x.den, y.den)};
}

sunder_i_vector sunder_i_vector_sub(sunder_i_arena *arena, sunder_i_vector u, sunder_i_vector v)
{
    if (equal(u.w, v.w))
        return (sunder_i_vector){sunder_i_big_sub(arena, u.x, v.x), sunder_i_big_sub(arena, u.y, v.y), u.w};
    return (sunder_i_vector){
        sunder_i_big_sub(arena, sunder_i_times(arena, u.x, v.w), sunder_i_times(arena, v.x, u.w)),
        sunder_i_big_sub(arena, sunder_i_times(arena, u.y, v.w), sunder_i_times(arena, v.y, u.w)),
        sunder_i_times(arena, u.w, v.w)};
}

sunder_i_vector sunder_i_vector_diff(sunder_i_arena *arena, const sunder_i_lattice *l, sunder_i_point b,
                                     sunder_i_point a)
{
    return sunder_i_vector_sub(arena, sunder_i_vector_get(arena, l, b), sunder_i_vector_get(arena, l, a));
}

/* x and y as integers in *x, *y, where w divides both. */
static bool divides(sunder_i_arena *arena, sunder_i_big w, sunder_i_big *x, sunder_i_big *y)
{
    const sunder_i_big p = sunder_i_big_div_floor(arena, *x, w), q = sunder_i_big_div_floor(arena, *y, w);
    if (arena->failed || sunder_i_big_cmp(sunder_i_big_mul(arena, p, w), *x) != 0 ||
        sunder_i_big_cmp(sunder_i_big_mul(arena, q, w), *y) != 0)
        return false;
    *x = p;
    *y = q;
    return true;
}

sunder_i_point sunder_i_vector_put(sunder_i_lattice *l, sunder_i_vector u)
{
    sunder_i_arena *arena = &l->arena;
    /* Both corners of a side may stand over one crossing, and what they differ by is then a lattice vector. */
    const bool whole = sunder_i_is_one(u.w) || divides(&l->scratch, u.w, &u.x, &u.y);
    const sunder_i_big x = sunder_i_big_copy(arena, u.x), y = sunder_i_big_copy(arena, u.y);
    if (whole) return (sunder_i_point){sunder_i_lattice_big(l, x), sunder_i_lattice_big(l, y)};
    const sunder_i_big w = sunder_i_big_copy(arena, u.w);
    return (sunder_i_point){sunder_i_lattice_ratio(l, x, w), sunder_i_lattice_ratio(l, y, w)};
}
