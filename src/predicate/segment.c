/* segment.c: two segments: how they meet, and their distance. */
#include "predicate/narrow.h"
#include "predicate/rational_point.h"

/* Returns true if c is on the closed segment ab; c must be on the line ab (or a == b). */
static bool is_within_ends(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c)
{
    /* On a line the lexicographic order is monotone. */
    return sunder_i_point_cmp(l, a, c) * sunder_i_point_cmp(l, b, c) <= 0;
}

/* Returns how the point c meets the closed segment ab, which may be a point. */
static sunder_i_meeting point_meets(sunder_i_lattice *l, sunder_i_point c, sunder_i_point a, sunder_i_point b)
{
    if (sunder_i_point_equal(l, a, c) || sunder_i_point_equal(l, b, c)) return SUNDER_I_ENDS_EQUAL;
    if (sunder_i_orient(l, a, b, c) != 0 || !is_within_ends(l, a, b, c)) return SUNDER_I_APART;
    return sunder_i_point_equal(l, a, b) ? SUNDER_I_APART : SUNDER_I_END_INSIDE;
}

/* Returns how two segments of positive length on one line meet. */
static sunder_i_meeting collinear_meet(sunder_i_lattice *l, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                       sunder_i_point d)
{
    /* Sorts the ends of each lexicographically, which is an order along the line. */
    if (sunder_i_point_cmp(l, a, b) > 0) {
        const sunder_i_point t = a;
        a = b;
        b = t;
    }
    if (sunder_i_point_cmp(l, c, d) > 0) {
        const sunder_i_point t = c;
        c = d;
        d = t;
    }
    const int bc = sunder_i_point_cmp(l, b, c), da = sunder_i_point_cmp(l, d, a);
    if (bc < 0 || da < 0) return SUNDER_I_APART;
    return bc == 0 || da == 0 ? SUNDER_I_ENDS_EQUAL : SUNDER_I_OVERLAP;
}

sunder_i_meeting sunder_i_segments_meet(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                        sunder_i_point d)
{
    if (sunder_i_point_equal(lattice, a, b)) return point_meets(lattice, a, c, d);
    if (sunder_i_point_equal(lattice, c, d)) return point_meets(lattice, c, a, b);
    const int oc = sunder_i_orient(lattice, a, b, c), od = sunder_i_orient(lattice, a, b, d);
    if (oc == 0 && od == 0) return collinear_meet(lattice, a, b, c, d);
    if (oc * od > 0) return SUNDER_I_APART;
    const int oa = sunder_i_orient(lattice, c, d, a), ob = sunder_i_orient(lattice, c, d, b);
    if (oa * ob > 0) return SUNDER_I_APART;
    if (oc && od && oa && ob) return SUNDER_I_CROSS;
    return (oc == 0 || od == 0) && (oa == 0 || ob == 0) ? SUNDER_I_ENDS_EQUAL : SUNDER_I_END_INSIDE;
}

/* ---- The squared distance of a point and a segment, compared with gap^2 ---- */

static int narrow_distance_cmp(sunder_i_point p, sunder_i_point a, sunder_i_point b, int64_t gap)
{
    const sunder_i_point u = sunder_i_narrow_sub(b, a), ap = sunder_i_narrow_sub(p, a), bp = sunder_i_narrow_sub(p, b);
    const sunder_i_det limit = (sunder_i_det)gap * (sunder_i_det)gap;
    sunder_i_det square;
    if (sunder_i_narrow_dot(ap, u) <= 0)
        square = sunder_i_narrow_dot(ap, ap);
    else if (sunder_i_narrow_dot(bp, u) >= 0)
        square = sunder_i_narrow_dot(bp, bp);
    else {
        const sunder_i_i128 cross = sunder_i_narrow_cross(u, ap);
        return sunder_i_cmp_products(cross, cross, limit, sunder_i_narrow_dot(u, u));
    }
    return (square > limit) - (square < limit);
}

/* Compares the distance of points with denominators of their own: the squares are compared over the product of the
 * denominators. */
static int wide_distance_cmp(sunder_i_lattice *l, sunder_i_point p, sunder_i_point a, sunder_i_point b, int64_t gap)
{
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point at = sunder_i_rational_get(m, l, p), u = sunder_i_rational_diff(m, l, b, a);
    const sunder_i_rational_point ap = sunder_i_rational_sub(m, at, sunder_i_rational_get(m, l, a));
    const sunder_i_rational_point bp = sunder_i_rational_sub(m, at, sunder_i_rational_get(m, l, b));
    const sunder_i_ratio g = sunder_i_lattice_read(m, l, gap);
    sunder_i_big square, over; /* square / over is the squared distance */
    if (sunder_i_big_sign(sunder_i_rational_dot(m, ap, u)) <= 0) {
        square = sunder_i_rational_dot(m, ap, ap);
        over = sunder_i_big_mul(m, ap.w, ap.w);
    } else if (sunder_i_big_sign(sunder_i_rational_dot(m, bp, u)) >= 0) {
        square = sunder_i_rational_dot(m, bp, bp);
        over = sunder_i_big_mul(m, bp.w, bp.w);
    } else {
        /* The denominator of u cancels. */
        const sunder_i_big cross = sunder_i_rational_cross(m, u, ap);
        square = sunder_i_big_mul(m, cross, cross);
        over = sunder_i_big_mul(m, sunder_i_rational_dot(m, u, u), sunder_i_big_mul(m, ap.w, ap.w));
    }
    const int c = sunder_i_big_cmp(sunder_i_times(m, square, sunder_i_big_mul(m, g.den, g.den)),
                                   sunder_i_big_mul(m, sunder_i_big_mul(m, g.num, g.num), over));
    l->counts.exact_fallbacks++;
    sunder_i_lattice_end(l, mark);
    return c;
}

static int point_distance_cmp(sunder_i_lattice *l, sunder_i_point p, sunder_i_point a, sunder_i_point b, int64_t gap)
{
    l->counts.comparisons++;
    const bool plain = sunder_i_point_is_plain(p) && sunder_i_point_is_plain(a) && sunder_i_point_is_plain(b) &&
                       sunder_i_is_plain(gap);
    return l->narrow || plain ? narrow_distance_cmp(p, a, b, gap) : wide_distance_cmp(l, p, a, b, gap);
}

int sunder_i_segment_distance_cmp(sunder_i_lattice *lattice, sunder_i_point a, sunder_i_point b, sunder_i_point c,
                                  sunder_i_point d, int64_t gap)
{
    const bool zero_gap = sunder_i_int_cmp(lattice, gap, 0) == 0;
    if (sunder_i_segments_meet(lattice, a, b, c, d) != SUNDER_I_APART) return zero_gap ? 0 : -1;
    if (zero_gap) return 1;
    /* The segments are disjoint: the least distance is that of an end of one to the other. */
    int least = point_distance_cmp(lattice, a, c, d, gap);
    const sunder_i_point end[3] = {b, c, d};
    for (int i = 0; i < 3 && least >= 0; i++) {
        const int s =
            i == 0 ? point_distance_cmp(lattice, end[i], c, d, gap) : point_distance_cmp(lattice, end[i], a, b, gap);
        if (s < least) least = s;
    }
    return least;
}
