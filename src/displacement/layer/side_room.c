/* Finds how much room a feature has on the side of one of its parts. A ray runs from the part's point p, away from the
 * middle of the feature's box. The room is the distance from p to the first line that the ray meets, at most
 * sunder_side_reach(). If it meets none, or if p is the middle itself, the room is that greatest distance. The greatest
 * distance depends on the feature's box alone, so the side of a feature is the same for all limits of moves. It is
 * computed in doubles, and ends of lines that are not doubles are rounded; everything else is exact. */
#include "displacement/layer/side_cut.h"

#include "shape/shape.h"

/* Intersects the ray from p in the direction d with the segment ab. Sets *at to the parameter k of the point p + k d, k
 * > 0. Returns false if they do not meet. */
static bool intersect_ray(sunder_i_arena *m, sunder_i_rational_point p, sunder_i_rational_point d,
                          sunder_i_rational_point a, sunder_i_rational_point b, sunder_i_ratio *at)
{
    const sunder_i_rational_point u = sunder_i_rational_sub(m, b, a), v = sunder_i_rational_sub(m, a, p);
    /* The denominators are u.w = U, v.w = V, d.w = D, so d x u has D U, v x u has V U, and v x d has V D. */
    const sunder_i_big den = sunder_i_rational_cross(m, d, u), along = sunder_i_rational_cross(m, v, u),
                       across = sunder_i_rational_cross(m, v, d);
    const int sign = sunder_i_big_sign(den);
    if (sign == 0)
        return false; /* parallel to the ray: an end of it on the ray is an end of another line, too, or of
                                  * none */
    sunder_i_ratio x = {sunder_i_big_mul(m, along, d.w), sunder_i_big_mul(m, den, v.w)},
                   y = {sunder_i_big_mul(m, across, u.w), sunder_i_big_mul(m, den, v.w)};
    if (sign < 0) {
        x = (sunder_i_ratio){sunder_i_big_neg(x.num), sunder_i_big_neg(x.den)};
        y = (sunder_i_ratio){sunder_i_big_neg(y.num), sunder_i_big_neg(y.den)};
    }
    *at = x;
    return sunder_i_big_sign(x.num) > 0 && sunder_i_big_sign(y.num) >= 0 && sunder_i_big_cmp(y.num, y.den) <= 0;
}

static sunder_i_ratio multiply_ratios(sunder_i_arena *m, sunder_i_ratio a, sunder_i_ratio b)
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
    sunder_i_ratio room = multiply_ratios(m, far, far);
    for (size_t k = 0; k < n && !m->failed; k++) {
        sunder_i_ratio at;
        const sunder_i_rational_point a = sunder_i_side_cut_point(cut, line[k]->from),
                                      b = sunder_i_side_cut_point(cut, line[k]->to);
        if (!intersect_ray(m, point, d, a, b, &at)) continue;
        at = multiply_ratios(m, multiply_ratios(m, at, at), square);
        if (sunder_i_ratio_cmp(m, at, room) < 0) room = at;
    }
    return room;
}
