/* carrier.c: tests whether a subsum covers a point of a line, and finds where the line leaves the subsum.
 *
 * A point is a + t d with an exact fraction t and is never constructed: its position relative to a side of a subsum is
 * the sign of A + t B, where A and B are cross products on the lattice, and the line leaves the subsum at t = -A / B.
 * Doubles decide if they exceed their error bound; for subsums with many sides they select the few sides to be tested
 * (fan.h, and by bisection between the vertices farthest on either side of the line). */
#include "separation/obstacle/carrier.h"
#include "base/invariant.h"
#include "separation/obstacle/board.h"
#include "separation/operands/fan.h"

#include <math.h>

/* Converts v to a double with a relative error of at most 2^-52. Converting a 128-bit integer calls a library function,
 * which is rarely necessary. */
static inline double fast_double(sunder_i_i128 v)
{
    const int64_t low = (int64_t)v;
    if (v == low) return (double)low;
    return (double)v;
}

static inline sunder_i_fraction narrow_fraction(sunder_i_i128 num, sunder_i_i128 den)
{
    return (sunder_i_fraction){num, den, fast_double(num) / fast_double(den)};
}

static inline sunder_i_fraction brief_fraction(int64_t num, int64_t den)
{
    return (sunder_i_fraction){num, den, (double)num / (double)den};
}

sunder_i_carrier sunder_i_carrier_make(sunder_i_operands *operands, sunder_i_point a, sunder_i_point d)
{
    const sunder_i_lattice *l = &operands->placed.lattice;
    if (l->narrow)
        return (sunder_i_carrier){a,   {a.x + d.x, a.y + d.y}, d, (double)a.x, (double)a.y, (double)d.x, (double)d.y,
                                  true};
    return (sunder_i_carrier){a,
                              sunder_i_operands_add(operands, a, d),
                              d,
                              sunder_i_approx(l, a.x),
                              sunder_i_approx(l, a.y),
                              sunder_i_approx(l, d.x),
                              sunder_i_approx(l, d.y),
                              sunder_i_point_is_plain(a) && sunder_i_point_is_plain(d)};
}

sunder_i_fraction sunder_i_carrier_foot(sunder_i_operands *operands, const sunder_i_carrier *line)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    if (operands->brief) {
        const int64_t num = -sunder_i_brief_dot(line->a, line->d), den = sunder_i_brief_dot(line->d, line->d);
        if (num <= 0) return (sunder_i_fraction){0, 1, 0};
        if (num >= den) return (sunder_i_fraction){1, 1, 1};
        return brief_fraction(num, den);
    }
    if (line->plain) {
        const sunder_i_i128 num = -sunder_i_narrow_dot(line->a, line->d), den = sunder_i_narrow_dot(line->d, line->d);
        if (num <= 0) return (sunder_i_fraction){0, 1, 0};
        if (num >= den) return (sunder_i_fraction){1, 1, 1};
        return narrow_fraction(num, den);
    }
    const sunder_i_point origin = {0, 0};
    const sunder_i_fraction zero = sunder_i_fraction_int(l, 0), one = sunder_i_fraction_int(l, 1);
    const sunder_i_fraction foot = sunder_i_foot(l, line->a, line->b, origin);
    if (sunder_i_fraction_cmp(l, &foot, &zero) <= 0) return zero;
    return sunder_i_fraction_cmp(l, &foot, &one) >= 0 ? one : foot;
}

int sunder_i_carrier_cmp(sunder_i_operands *operands, const sunder_i_fraction *s, const sunder_i_fraction *t)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    if (s->den == 0 || t->den == 0) return sunder_i_fraction_cmp(l, s, t);
    l->counts.comparisons++;
    const double d = s->value - t->value, bound = 0x1p-49 * (fabs(s->value) + fabs(t->value));
    if (d > bound) return 1;
    if (d < -bound) return -1;
    l->counts.exact_fallbacks++;
    if (operands->brief) /* all numbers are below 2^62 */
        return sunder_i_i128_sign((sunder_i_i128)(int64_t)s->num * (int64_t)t->den -
                                  (sunder_i_i128)(int64_t)t->num * (int64_t)s->den);
    return sunder_i_cmp_products(s->num, t->den, t->num, s->den);
}

/* Computes A and B such that cross(side k, a + t d - corner k) = A + t B, for plain numbers. A and B have degree 2; the
 * sign of A + t B has degree 4. */
static inline void narrow_linear(const sunder_i_carrier *line, const sunder_i_subsum *s, uint32_t k, sunder_i_i128 *a,
                                 sunder_i_i128 *b)
{
    *a = sunder_i_narrow_cross(s->side[k], sunder_i_narrow_sub(line->a, s->corner[k]));
    *b = sunder_i_narrow_cross(s->side[k], line->d);
}

int sunder_i_carrier_side(sunder_i_operands *operands, const sunder_i_carrier *line, const sunder_i_fraction *t,
                          const sunder_i_subsum *subsum, uint32_t k)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    l->counts.orientation_tests++;
    l->counts.exact_fallbacks++;
    if (operands->brief) {
        const int64_t a = sunder_i_brief_cross(subsum->side[k], sunder_i_narrow_sub(line->a, subsum->corner[k]));
        const int64_t b = sunder_i_brief_cross(subsum->side[k], line->d);
        return sunder_i_i128_sign((sunder_i_i128)a * (int64_t)t->den + (sunder_i_i128)b * (int64_t)t->num);
    }
    if (line->plain && subsum->plain && t->den != 0) {
        sunder_i_i128 a, b;
        narrow_linear(line, subsum, k, &a, &b);
        if (b == 0) return sunder_i_i128_sign(a);
        return sunder_i_cmp_products(a, t->den, -b, t->num);
    }
    const sunder_i_hpoint x = sunder_i_hpoint_at(l, line->a, line->b, t);
    return sunder_i_orient_hpoint(l, subsum->corner[k], subsum->corner[k + 1 < subsum->sides ? k + 1 : 0], &x);
}

/* Compares the point with side k in doubles: 1 certainly on its left, -1 certainly on its right, 0 unknown. */
static int side_says(const sunder_i_subsum *s, uint32_t k, double x, double y)
{
    const double v = s->sx[k] * (y - s->cy[k]) - s->sy[k] * (x - s->cx[k]);
    return v > s->bound[k] ? 1 : v < -s->bound[k] ? -1 : 0;
}

/* Compares the point with the diagonal from vertex 0 to vertex k: 1 certainly on its left, -1 certainly on its right, 0
 * unknown. Coordinates have an error of at most
 * e, so the differences u and w have one of 2 e and an ulp, which is far less than e: their cross product has an error
 * of 2 e (|u| + |w|) + 8 e^2, with sums of absolute coordinates, plus its own rounding, which is below e |u|. */
static int diagonal_says(const sunder_i_subsum *s, uint32_t k, double x, double y, double e)
{
    const double u[2] = {s->cx[k] - s->cx[0], s->cy[k] - s->cy[0]}, w[2] = {x - s->cx[0], y - s->cy[0]};
    const double v = u[0] * w[1] - u[1] * w[0];
    const double bound = 4 * e * (fabs(u[0]) + fabs(u[1]) + fabs(w[0]) + fabs(w[1]) + 4 * e);
    return v > bound ? 1 : v < -bound ? -1 : 0;
}

static sunder_i_fan_answer inside_fan(const sunder_i_subsum *s, double x, double y, double e)
{
    const sunder_i_fan fan = sunder_i_fan_at(s->sides, s->cx, s->cy, x, y);
    const uint32_t low = fan.low, high = low + 1;
    const int left = fan.first ? side_says(s, 0, x, y) : diagonal_says(s, low, x, y, e);
    const int right = fan.last ? side_says(s, high, x, y) : -diagonal_says(s, high, x, y, e);
    return sunder_i_fan_says(&fan, (double[3]){-side_says(s, low, x, y), -left, -right}, 0, 0);
}

static bool inside_one_by_one(sunder_i_operands *g, const sunder_i_carrier *line, const sunder_i_fraction *t, double x,
                              double y, const sunder_i_subsum *s)
{
    for (uint32_t k = 0; k < s->sides; k++) {
        const int says = side_says(s, k, x, y);
        if (says < 0 || (says == 0 && sunder_i_carrier_side(g, line, t, s, k) <= 0)) return false;
    }
    return true;
}

/* Returns whether the point is in the interior of the subsum. Exact; doubles are used where they suffice. */
static inline bool inside_subsum(sunder_i_operands *g, const sunder_i_carrier *line, const sunder_i_fraction *t,
                                 double x, double y, const sunder_i_subsum *s)
{
    if (s->sides >= SUNDER_I_SIDES_MANY) {
        const sunder_i_fan_answer where = inside_fan(s, x, y, g->error);
        if (where != SUNDER_I_FAN_DOUBT) return where == SUNDER_I_FAN_INSIDE;
    }
    g->placed.lattice.counts.orientation_tests += s->sides;
    if (s->sides > SUNDER_I_SIDES_IN_A_WORD) return inside_one_by_one(g, line, t, x, y, s);
    uint32_t doubt;
    if (!sunder_i_subsum_may_hold(s, x, y, 1, &doubt)) return false;
    for (; doubt; doubt &= doubt - 1)
        if (sunder_i_carrier_side(g, line, t, s, (uint32_t)__builtin_ctz(doubt)) <= 0) return false;
    return true;
}

/* Returns whether subsum k, whose box is near the point, covers it; false also if out of memory. */
static inline bool covers_near(sunder_i_operands *g, const sunder_i_carrier *line, const sunder_i_fraction *t, double x,
                               double y, size_t k)
{
    sunder_i_subsum *s = g->subsum + k;
    if (!s->sides && !sunder_i_subsum_make(g, s)) return false;
    g->placed.lattice.counts.orientation_tests++;
    return inside_subsum(g, line, t, x, y, s);
}

/* Returns whether subsum k covers the point. */
static inline bool covers_point(sunder_i_operands *g, const sunder_i_carrier *line, const sunder_i_fraction *t,
                                double x, double y, size_t k)
{
    return sunder_i_box_near_point(g->subsum[k].box, x, y, g->error) && covers_near(g, line, t, x, y, k);
}

/* A set of up to this number of subsums is stored in a word. */
#define FEW 64

/* Returns the set of subsums whose boxes are near the point. All are tested, since branches could not be predicted. */
static uint64_t few_near(const sunder_i_operands *g, double x, double y)
{
    uint64_t near = 0;
    for (size_t k = 0; k < g->subsums; k++)
        near |= (uint64_t)sunder_i_box_near_point(g->subsum[k].box, x, y, g->error) << k;
    return near;
}

/* For few subsums: tests subsum `first`, and then the others whose boxes are near the point, cyclically from there.
 * Returns the one that covers the point; -1: none. */
static long cover_of_few(sunder_i_operands *g, const sunder_i_carrier *line, const sunder_i_fraction *t, double x,
                         double y, size_t first)
{
    if (covers_point(g, line, t, x, y, first)) return (long)first;
    uint64_t near = few_near(g, x, y) & ~((uint64_t)1 << first);
    uint64_t later = near >> first << first;
    for (; near && !g->placed.lattice.arena.failed; near &= ~(later & -later), later &= later - 1) {
        if (!later) later = near;
        const size_t k = (size_t)__builtin_ctzll(later);
        if (covers_near(g, line, t, x, y, k)) return (long)k;
    }
    return -1;
}

/* For a board: tests subsum `first`, then those listed for the square. Returns the one that covers the point; -1:
 * none. */
static long cover_on_board(sunder_i_operands *g, const sunder_i_carrier *line, const sunder_i_fraction *t, double x,
                           double y, uint32_t square, size_t first)
{
    const sunder_i_board *h = g->board;
    if (h->holder[square]) return (long)h->holder[square] - 1;
    if (first < g->subsums && covers_point(g, line, t, x, y, first)) return (long)first;
    for (uint32_t i = square ? h->list_end[square - 1] : 0; i < h->list_end[square]; i++) {
        if (covers_point(g, line, t, x, y, h->list[i])) return (long)h->list[i];
        if (g->placed.lattice.arena.failed) return -1;
    }
    return -1;
}

long sunder_i_carrier_cover(sunder_i_operands *operands, const sunder_i_carrier *line, const sunder_i_fraction *t,
                            double x, double y, size_t *first)
{
    if (operands->board) {
        const uint32_t square = sunder_i_board_square(operands->board, x, y);
        if (square < operands->board->n * operands->board->n) {
            const long k = cover_on_board(operands, line, t, x, y, square, first ? *first : operands->subsums);
            if (first && k >= 0) *first = (size_t)k;
            return k;
        }
    }
    size_t k = first && *first < operands->subsums ? *first : 0;
    if (operands->subsums - 1 < FEW) {
        const long found = cover_of_few(operands, line, t, x, y, k);
        if (first && found >= 0) *first = (size_t)found;
        return found;
    }
    for (size_t n = 0; n < operands->subsums; n++, k = k + 1 < operands->subsums ? k + 1 : 0) {
        if (covers_point(operands, line, t, x, y, k)) {
            if (first) *first = k;
            return (long)k;
        }
        if (operands->placed.lattice.arena.failed) return -1;
    }
    return -1;
}

/* ---- The point where a line leaves a subsum ---- */

/* The sides first .. first + n - 1, cyclically. */
typedef struct stretch {
    uint32_t first, n;
} stretch;

uint32_t sunder_i_subsum_lowest(const sunder_i_subsum *subsum, double dx, double dy)
{
    const bool half = dy < 0 || (dy == 0 && dx < 0);
    uint32_t low = 0, high = subsum->sides;
    while (low < high) {
        const uint32_t k = low + (high - low) / 2;
        const bool own = subsum->sy[k] < 0 || (subsum->sy[k] == 0 && subsum->sx[k] < 0);
        if (own != half ? own : dx * subsum->sy[k] - dy * subsum->sx[k] > 0)
            high = k;
        else
            low = k + 1;
    }
    return low % subsum->sides;
}

/* Returns the signed distance of vertex k from the line, times its length, positive on the left. */
static double height_over(const sunder_i_carrier *line, const sunder_i_subsum *s, uint32_t k)
{
    if (k >= s->sides) k -= s->sides;
    return line->dx * (s->cy[k] - line->ay) - line->dy * (s->cx[k] - line->ax);
}

/* Returns the sides through which the line may leave the subsum. Counterclockwise around a convex polygon whose
 * interior a line meets, there is one sequence of vertices on its right and one on its left. Hence between any vertex
 * that is certainly on its right and one that is certainly on its left there is one side through which it leaves, and
 * bisection finds it, except for vertices that doubles cannot decide, and the sides at them. Backwards, left and right
 * are exchanged. */
static stretch leaving_sides(const sunder_i_operands *g, const sunder_i_carrier *line, const sunder_i_subsum *s,
                             bool forwards)
{
    const stretch all = {0, s->sides};
    if (s->sides < SUNDER_I_SIDES_MANY) return all;
    /* The vertices approximately farthest on the right and on the left; `bound` is the error bound of height_over(), by
     * the same formula as s->bound[] of a side (bounds_of() in subsum.c). */
    const uint32_t lowest = sunder_i_subsum_lowest(s, line->dx, line->dy);
    const uint32_t highest = sunder_i_subsum_lowest(s, -line->dx, -line->dy);
    const double sign = forwards ? 1 : -1;
    const double bound = (fabs(line->dx) + fabs(line->dy)) * 2 * g->error + 16 * g->magnitude * g->rough;
    const uint32_t from = forwards ? lowest : highest, to = forwards ? highest : lowest;
    uint32_t low = from, high = to > from ? to : to + s->sides;
    if (sign * height_over(line, s, from) >= -bound || sign * height_over(line, s, to) <= bound) return all;
    for (uint32_t end = high; end - low > 1;) { /* the last vertex that is certainly before the exit */
        const uint32_t k = low + (end - low) / 2;
        if (sign * height_over(line, s, k) < -bound)
            low = k;
        else
            end = k;
    }
    for (uint32_t start = low; high - start > 1;) { /* the first vertex that is certainly beyond it */
        const uint32_t k = start + (high - start) / 2;
        if (sign * height_over(line, s, k) > bound)
            high = k;
        else
            start = k;
    }
    return (stretch){low, high - low};
}

static void take_first(sunder_i_operands *g, const sunder_i_fraction *t, bool forwards, sunder_i_fraction *best,
                       bool *any)
{
    const int c = *any ? sunder_i_carrier_cmp(g, t, best) : 0;
    if (!*any || (forwards ? c < 0 : c > 0)) *best = *t;
    *any = true;
}

/* Returns the exact signed distance of vertex k from the line, times its length, positive on the left; for plain
 * numbers. */
static inline sunder_i_i128 narrow_height(const sunder_i_carrier *line, const sunder_i_subsum *s, uint32_t k)
{
    return sunder_i_narrow_cross(line->d, sunder_i_narrow_sub(s->corner[k], line->a));
}

/* Returns the parameter at which the line leaves the subsum, if all numbers are plain integers; the line leaves it
 * through one of the sides `near`. A line that meets the interior of a bounded convex set leaves it through one side,
 * or through a vertex, which counts as the end of the side before it: forwards, that side begins on the right of the
 * line and ends on its left or on it, backwards the reverse. So each vertex needs one orientation test, and the result
 * one fraction. */
static sunder_i_fraction narrow_exit(const sunder_i_carrier *line, const sunder_i_subsum *s, stretch near,
                                     bool forwards)
{
    uint32_t k = near.first;
    bool before = false;
    for (uint32_t i = 0; i <= near.n; i++) {
        const sunder_i_i128 height = narrow_height(line, s, k);
        if (before && (forwards ? height >= 0 : height <= 0)) break;
        before = forwards ? height < 0 : height > 0;
        k = k + 1 < s->sides ? k + 1 : 0;
    }
    sunder_i_i128 a, b;
    narrow_linear(line, s, k ? k - 1 : s->sides - 1, &a, &b);
    SUNDER_I_ASSERT(forwards ? b < 0 : b > 0);
    return b < 0 ? narrow_fraction(a, -b) : narrow_fraction(-a, b);
}

/* Does the same as narrow_exit() for brief numbers (narrow.h), whose products fit 64 bits. */
static sunder_i_fraction brief_exit(const sunder_i_carrier *line, const sunder_i_subsum *s, stretch near, bool forwards)
{
    const sunder_i_point d = forwards ? line->d : (sunder_i_point){-line->d.x, -line->d.y};
    uint32_t k = near.first, last = k;
    bool before = false;
    for (uint32_t i = 0; i <= near.n; i++) {
        const int64_t height = sunder_i_brief_cross(d, sunder_i_narrow_sub(s->corner[k], line->a));
        if (before && height >= 0) break;
        before = height < 0;
        last = k;
        k = k + 1 < s->sides ? k + 1 : 0;
    }
    const int64_t a = sunder_i_brief_cross(s->side[last], sunder_i_narrow_sub(line->a, s->corner[last]));
    const int64_t b = sunder_i_brief_cross(s->side[last], line->d);
    SUNDER_I_ASSERT(forwards ? b < 0 : b > 0);
    return b < 0 ? brief_fraction(a, -b) : brief_fraction(-a, b);
}

sunder_i_fraction sunder_i_carrier_exit(sunder_i_operands *operands, const sunder_i_carrier *line,
                                        const sunder_i_subsum *subsum, bool forwards)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    sunder_i_fraction best = {0, 1, 0};
    bool any = false;
    const stretch near = leaving_sides(operands, line, subsum, forwards);
    l->counts.segment_intersections++;
    if (operands->brief) return brief_exit(line, subsum, near, forwards);
    if (line->plain && subsum->plain) return narrow_exit(line, subsum, near, forwards);
    for (uint32_t i = 0; i < near.n; i++) {
        const uint32_t k = (near.first + i) % subsum->sides;
        const int turn = sunder_i_cross_sign(l, subsum->side[k], line->d);
        if (forwards ? turn >= 0 : turn <= 0) continue;
        const sunder_i_fraction t = sunder_i_crossing(l, line->a, line->b, subsum->corner[k],
                                                      subsum->corner[k + 1 < subsum->sides ? k + 1 : 0]);
        take_first(operands, &t, forwards, &best, &any);
    }
    SUNDER_I_ASSERT(any || l->arena.failed); /* a line that meets the interior of a bounded set leaves it */
    return best;
}
