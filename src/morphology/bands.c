/* A band: a segment plus a convex piece, as a convex polygon of at most two corners more than the piece. */
#include "morphology/morphology.h"

#include "predicate/rational_point.h"

/* Does the side turn left from the direction u, or run along it? The half-open half-circle counter-clockwise from u. */
static bool is_far(sunder_i_arena *arena, sunder_i_rational_point u, sunder_i_rational_point side)
{
    const int turn = sunder_i_big_sign(sunder_i_rational_cross(arena, u, side));
    return turn ? turn > 0 : sunder_i_big_sign(sunder_i_rational_dot(arena, u, side)) > 0;
}

/* Sides that turn left from ab are moved to b, the others stay at a. A side parallel to ab and what joins both places
 * make one straight side with a corner inside, which the map allows. Where a is b no side turns left, and the band is
 * the piece at a. */
size_t sunder_i_band(sunder_i_arena *s, const sunder_i_structuring_element *p, size_t first, size_t end,
                     sunder_i_rational_point a, sunder_i_rational_point b, sunder_i_rational_point *out)
{
    const sunder_i_rational_point u = sunder_i_rational_sub(s, b, a);
    size_t n = 0;
    bool before = is_far(s, u, p->side[end - 1]);
    for (size_t i = first; i < end; i++) {
        const bool after = is_far(s, u, p->side[i]);
        out[n++] = sunder_i_rational_add(s, before ? b : a, p->corner[i]);
        if (after != before) out[n++] = sunder_i_rational_add(s, after ? b : a, p->corner[i]);
        before = after;
    }
    return n;
}
