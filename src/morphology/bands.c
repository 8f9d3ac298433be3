/* bands.c: a band, the sum of a segment and a convex piece, as a convex polygon with at most two corners more than the
 * piece. */
#include "morphology/morphology.h"

#include "predicate/rational_point.h"

/* A direction: a vector, and if possible a plain vector (integers of few bits) of which it is a positive multiple.
 * Crossings of lattice lines on one of these lines differ by such vectors. */
typedef struct heading {
    sunder_i_rational_point vector;
    sunder_i_point along;
    bool plain;
} heading;

static bool is_plain_big(sunder_i_big a, int64_t *v)
{
    return sunder_i_big_fits_i64(a, v) && *v < (int64_t)1 << SUNDER_I_PLAIN_BITS &&
           *v > -((int64_t)1 << SUNDER_I_PLAIN_BITS);
}

bool sunder_i_heading(sunder_i_arena *arena, sunder_i_rational_point u, sunder_i_point *out)
{
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const sunder_i_big g = sunder_i_big_gcd(arena, u.x, u.y);
    if (g.size && !sunder_i_big_is_one(g)) {
        u.x = sunder_i_big_div_floor(arena, u.x, g);
        u.y = sunder_i_big_div_floor(arena, u.y, g);
    }
    const bool ok = !arena->failed && is_plain_big(u.x, &out->x) && is_plain_big(u.y, &out->y);
    sunder_i_arena_release(arena, mark);
    return ok;
}

/* Returns whether the side turns left from the direction u or has this direction: the half-open half-circle
 * counterclockwise from u. */
static bool is_far(sunder_i_arena *arena, const heading *u, const sunder_i_structuring_element *p, size_t i)
{
    if (u->plain) {
        const sunder_i_point a = u->along, b = p->along[i];
        const sunder_i_i128 turn = (sunder_i_i128)a.x * b.y - (sunder_i_i128)a.y * b.x;
        return turn ? turn > 0 : (sunder_i_i128)a.x * b.x + (sunder_i_i128)a.y * b.y > 0;
    }
    const int turn = sunder_i_rational_cross_sign(arena, u->vector, p->side[i]);
    return turn ? turn > 0 : sunder_i_big_sign(sunder_i_rational_dot(arena, u->vector, p->side[i])) > 0;
}

/* Sides that turn left from ab are translated by b, the others by a. A side parallel to ab and the segment that joins
 * both positions form one straight side with a vertex inside, which the map allows. If a equals b no side turns left,
 * and the band is the piece at a. */
size_t sunder_i_band(sunder_i_arena *arena, const sunder_i_structuring_element *element, size_t first, size_t end,
                     sunder_i_rational_point a, sunder_i_rational_point b, sunder_i_rational_point *out,
                     sunder_i_point *along, bool *known)
{
    heading u = {.vector = sunder_i_rational_sub(arena, b, a)};
    u.plain = element->plain && sunder_i_heading(arena, u.vector, &u.along);
    *known = u.plain;
    size_t n = 0;
    bool before = is_far(arena, &u, element, end - 1);
    for (size_t i = first; i < end; i++) {
        const bool after = is_far(arena, &u, element, i);
        out[n++] = sunder_i_rational_add(arena, before ? b : a, element->corner[i]);
        if (after != before) {
            along[n - 1] = u.along;
            out[n++] = sunder_i_rational_add(arena, after ? b : a, element->corner[i]);
        }
        along[n - 1] = element->along[i];
        before = after;
    }
    return n;
}
