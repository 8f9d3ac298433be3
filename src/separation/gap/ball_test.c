/* ball_test.c: tests the gap from a side by the highest bits of a point, in ball arithmetic. If coordinates span the
 * range of doubles, exact numbers have ten thousand bits, and nearly all comparisons are clear. */
#include "separation/gap/gap.h"

#include "predicate/rational_point.h"

typedef struct rough_vector {
    sunder_i_ball x, y;
} rough_vector;

static rough_vector over_denominator(sunder_i_ball x, sunder_i_ball y, sunder_i_big w)
{
    if (sunder_i_big_is_one(w)) return (rough_vector){x, y};
    const sunder_i_ball b = sunder_i_ball_big(w);
    return (rough_vector){sunder_i_ball_div(x, b), sunder_i_ball_div(y, b)};
}

static rough_vector rough_point(sunder_i_rational_point v)
{
    return over_denominator(sunder_i_ball_big(v.x), sunder_i_ball_big(v.y), v.w);
}

static sunder_i_ball ball_dot(rough_vector u, rough_vector v)
{
    return sunder_i_ball_add(sunder_i_ball_mul(u.x, v.x), sunder_i_ball_mul(u.y, v.y));
}

static sunder_i_ball ball_cross(rough_vector u, rough_vector v)
{
    return sunder_i_ball_sub(sunder_i_ball_mul(u.x, v.y), sunder_i_ball_mul(u.y, v.x));
}

static int ball_cmp(sunder_i_ball a, sunder_i_ball b) { return sunder_i_ball_sign(sunder_i_ball_sub(a, b)); }

/* Compares the distance of a point from a side with the gap; d is the vector of the side, and v the vector from its
 * first vertex to the point. *order, *inward and *flat become the results of sunder_i_gap_cmp_side(). Returns false if
 * the bits do not decide. */
static bool decide_side(const sunder_i_gap_problem *p, rough_vector v, rough_vector d, int *order, bool *inward,
                        bool *flat)
{
    const sunder_i_ball square = ball_dot(d, d), along = ball_dot(v, d), height = ball_cross(d, v);
    const sunder_i_ball gap = sunder_i_ball_shift(sunder_i_ball_big(p->gap), -(long)p->gap_bits);
    const sunder_i_ball limit = sunder_i_ball_mul(gap, gap);
    const int turn = sunder_i_ball_sign(height), before = sunder_i_ball_sign(along);
    *inward = turn > 0;
    *flat = false;
    if (!turn || !before) return false;
    if (before < 0) {
        *order = ball_cmp(ball_dot(v, v), limit);
    } else {
        const int beyond = ball_cmp(along, square);
        *flat = beyond < 0;
        *order = *flat ? ball_cmp(sunder_i_ball_mul(height, height), sunder_i_ball_mul(limit, square)) : beyond;
    }
    return *order != 0;
}

/* Returns the vector from c to the point; the difference is computed exactly before it is rounded, since the two may be
 * close to each other. */
static rough_vector exact_way(sunder_i_arena *a, const sunder_i_surd_point *at, sunder_i_rational_point c)
{
    const sunder_i_surd x =
        sunder_i_surd_sub(a, sunder_i_surd_scale(a, at->x, c.w), sunder_i_surd_big(a, sunder_i_times(a, c.x, at->w)));
    const sunder_i_surd y =
        sunder_i_surd_sub(a, sunder_i_surd_scale(a, at->y, c.w), sunder_i_surd_big(a, sunder_i_times(a, c.y, at->w)));
    return over_denominator(sunder_i_surd_ball(&at->roots, x), sunder_i_surd_ball(&at->roots, y),
                            sunder_i_times(a, at->w, c.w));
}

bool sunder_i_gap_roughly_side(const sunder_i_gap_problem *problem, const sunder_i_subsum *subsum, uint32_t k,
                               const sunder_i_surd_point *at, int *order, bool *inward, bool *flat)
{
    const sunder_i_lattice *l = &problem->operands->placed.lattice;
    sunder_i_arena *a = &problem->operands->placed.lattice.arena;
    if (a->failed) return false;
    const sunder_i_rational_point corner = sunder_i_rational_get(a, l, subsum->corner[k]);
    const rough_vector c = rough_point(corner), d = rough_point(sunder_i_rational_get(a, l, subsum->side[k]));
    const rough_vector t =
        over_denominator(sunder_i_surd_ball(&at->roots, at->x), sunder_i_surd_ball(&at->roots, at->y), at->w);
    const rough_vector v = {sunder_i_ball_sub(t.x, c.x), sunder_i_ball_sub(t.y, c.y)};
    if (decide_side(problem, v, d, order, inward, flat)) return true;
    const rough_vector way = exact_way(a, at, corner);
    return !a->failed && decide_side(problem, way, d, order, inward, flat);
}
