/* How much room has a feature on the side of one of its parts? Straight on from the middle of the feature's box through
 * the part's point it is asked which line comes first, and how far that is from the point, up to sunder_side_reach(). A
 * line farther off counts as at that distance, and so does the case that the point is the middle itself. The reach
 * depends on the feature's box alone: the side of a feature is the same for all limits of moves. The reach is computed
 * in doubles, and of ends of lines that are none the nearest doubles count; the rest is exact. */
#include "displacement/layer/side_cut.h"

#include "shape/shape.h"

/* From p on along d, where the line from a to b is met, in parts of d; false where it is not, beyond p. */
static bool meet(sunder_i_arena *m, sunder_i_rational_point p, sunder_i_rational_point d, sunder_i_rational_point a,
                 sunder_i_rational_point b, sunder_i_ratio *at)
{
    const sunder_i_rational_point u = sunder_i_rational_sub(m, b, a), v = sunder_i_rational_sub(m, a, p);
    /* With denominators u.w = U, v.w = V, d.w = D: d x u / (D U), v x u / (V U), v x d / (V D). */
    const sunder_i_big den = sunder_i_rational_cross(m, d, u), along = sunder_i_rational_cross(m, v, u),
                       across = sunder_i_rational_cross(m, v, d);
    const int sign = sunder_i_big_sign(den);
    if (sign == 0) return false; /* along the way: its ends are those of other lines, or of none */
    sunder_i_ratio x = {sunder_i_big_mul(m, along, d.w), sunder_i_big_mul(m, den, v.w)},
                   y = {sunder_i_big_mul(m, across, u.w), sunder_i_big_mul(m, den, v.w)};
    if (sign < 0) {
        x = (sunder_i_ratio){sunder_i_big_neg(x.num), sunder_i_big_neg(x.den)};
        y = (sunder_i_ratio){sunder_i_big_neg(y.num), sunder_i_big_neg(y.den)};
    }
    *at = x;
    return sunder_i_big_sign(x.num) > 0 && sunder_i_big_sign(y.num) >= 0 && sunder_i_big_cmp(y.num, y.den) <= 0;
}

static sunder_i_ratio times(sunder_i_arena *m, sunder_i_ratio a, sunder_i_ratio b)
{
    return (sunder_i_ratio){sunder_i_big_mul(m, a.num, b.num), sunder_i_big_mul(m, a.den, b.den)};
}

double sunder_side_reach(const double box[4]) { return 2 * ((box[2] - box[0]) + (box[3] - box[1])); }

sunder_i_ratio sunder_i_side_room(sunder_i_side_cut *cut, sunder_i_rational_point point,
                                  const sunder_i_side *const *line, size_t n, double reach)
{
    sunder_i_arena *m = &cut->arena;
    const double *box = cut->shape->box;
    const double low[2] = {box[0], box[1]}, high[2] = {box[2], box[3]};
    sunder_i_rational_point middle =
        sunder_i_rational_add(m, sunder_i_side_cut_point(cut, low), sunder_i_side_cut_point(cut, high));
    middle.w = sunder_i_big_shl(m, middle.w, 1);
    const sunder_i_rational_point d = sunder_i_rational_sub(m, point, middle);
    const sunder_i_ratio square = {sunder_i_rational_dot(m, d, d), sunder_i_big_mul(m, d.w, d.w)};
    const sunder_i_ratio far = sunder_i_side_cut_in_units(cut, reach, 1);
    sunder_i_ratio room = times(m, far, far);
    for (size_t k = 0; k < n && !m->failed; k++) {
        sunder_i_ratio at;
        const sunder_i_rational_point a = sunder_i_side_cut_point(cut, line[k]->from),
                                      b = sunder_i_side_cut_point(cut, line[k]->to);
        if (!meet(m, point, d, a, b, &at)) continue;
        at = times(m, times(m, at, at), square);
        if (sunder_i_ratio_cmp(m, at, room) < 0) room = at;
    }
    return room;
}
