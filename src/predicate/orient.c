/* Degree 1 and 2: order, side, cross and dot products, angle. */
#include "predicate/kernel.h"
#include "predicate/wide_vector.h"

static int wide_sign(sunder_i_lattice *l, sunder_i_mark mark, sunder_i_big v)
{
    const int s = sunder_i_big_sign(v);
    l->operations.exact_fallbacks++;
    sunder_i_wide_drop(l, mark);
    return s;
}

int sunder_i_int_cmp(sunder_i_lattice *l, int64_t a, int64_t b)
{
    if (l->narrow) return (a > b) - (a < b);
    return sunder_i_big_cmp(sunder_i_lattice_get(l, a), sunder_i_lattice_get(l, b));
}

int sunder_i_point_cmp(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b)
{
    l->operations.comparisons++;
    const int c = sunder_i_int_cmp(l, a.x, b.x);
    return c ? c : sunder_i_int_cmp(l, a.y, b.y);
}

bool sunder_i_point_equal(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b)
{
    if (l->narrow) return a.x == b.x && a.y == b.y;
    return sunder_i_int_cmp(l, a.x, b.x) == 0 && sunder_i_int_cmp(l, a.y, b.y) == 0;
}

sunder_i_point sunder_i_point_add(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b)
{
    return (sunder_i_point){sunder_i_lattice_add(l, a.x, b.x), sunder_i_lattice_add(l, a.y, b.y)};
}

sunder_i_point sunder_i_point_sub(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b)
{
    return (sunder_i_point){sunder_i_lattice_sub(l, a.x, b.x), sunder_i_lattice_sub(l, a.y, b.y)};
}

sunder_i_point sunder_i_point_neg(sunder_i_lattice *l, sunder_i_point a)
{
    return (sunder_i_point){sunder_i_lattice_neg(l, a.x), sunder_i_lattice_neg(l, a.y)};
}

int sunder_i_orient(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    l->operations.orientation_tests++;
    if (l->narrow) return sunder_i_i128_sign(sunder_i_narrow_orient(a, b, c));
    const sunder_i_mark mark = sunder_i_arena_mark(&l->arena);
    return wide_sign(l, mark, sunder_i_wide_cross(l, sunder_i_wide_diff(l, b, a), sunder_i_wide_diff(l, c, a)));
}

int sunder_i_cross_sign(sunder_i_lattice *l, sunder_i_point u, sunder_i_point v)
{
    l->operations.orientation_tests++;
    if (l->narrow) return sunder_i_i128_sign(sunder_i_narrow_cross(u, v));
    const sunder_i_mark mark = sunder_i_arena_mark(&l->arena);
    return wide_sign(l, mark, sunder_i_wide_cross(l, sunder_i_wide_get(l, u), sunder_i_wide_get(l, v)));
}

int sunder_i_dot_sign(sunder_i_lattice *l, sunder_i_point u, sunder_i_point v)
{
    if (l->narrow) return sunder_i_i128_sign(sunder_i_narrow_dot(u, v));
    const sunder_i_mark mark = sunder_i_arena_mark(&l->arena);
    return wide_sign(l, mark, sunder_i_wide_dot(l, sunder_i_wide_get(l, u), sunder_i_wide_get(l, v)));
}

int sunder_i_half_plane(sunder_i_lattice *l, sunder_i_point u)
{
    int sx, sy;
    if (l->narrow) {
        sx = (u.x > 0) - (u.x < 0);
        sy = (u.y > 0) - (u.y < 0);
    } else {
        sx = sunder_i_big_sign(sunder_i_lattice_get(l, u.x));
        sy = sunder_i_big_sign(sunder_i_lattice_get(l, u.y));
    }
    return sy < 0 || (sy == 0 && sx < 0);
}

int sunder_i_angle_cmp(sunder_i_lattice *l, sunder_i_point u, sunder_i_point v)
{
    const int hu = sunder_i_half_plane(l, u), hv = sunder_i_half_plane(l, v);
    if (hu != hv) return hu < hv ? -1 : 1;
    return -sunder_i_cross_sign(l, u, v);
}
