/* widest_interval.c: finds the widest interval of a set on the horizontal line at half its height. The line meets the
 * interior in open intervals; the widest is returned, of equal ones the leftmost. If there is none, the set is in
 * several parts, and the part below the line is used instead: the height is at least halved each time.
 *
 * A point of the line is inside the set if the points just above and just below it are. So the edges that extend above
 * the line are sorted along it, by x and then by direction; between the first one that opens and the one that closes
 * last the set is covered. The same is done below the line, and the intervals are what is covered on both sides.
 * Opposite edges at one position are the common wall of two polygons that touch, and no gap. Vertices on the line and
 * horizontal edges are no special cases.
 *
 * Everything is decided exactly, doubles first. With eps = 2^-53 and the mean m of low and high, the side of a vertex
 * is the sign of 2 y - (low + high): that of 2 y minus the rounded sum, or of the rounding error. On an edge from a to
 * b with p = a.y - m, which has an error of at most 3 eps (high - low), x is a.x + (b.x - a.x) p / (a.y - b.y).
 * Relative to an origin it has an error of about 8 eps (|a.x - origin| + |b.x - a.x| (1 + (high - low) / |a.y - b.y|)),
 * and 16 eps times the computed value is more than that. Numbers near the ends of the range of doubles are excluded. */
#include "shape/widest_interval.h"

#include "number/accumulator.h"
#include "predicate/predicate.h"
#include "shape/rational_corners.h"

#include <math.h>

typedef struct search {
    const sunder_i_boundary *b;
    sunder_i_arena *arena;
    sunder_i_widest_interval *out; /* contains the height of the line */
    int8_t *side;                  /* [n] the side of each vertex: above the line 1, below it -1, on it 0 */
} search;

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static sunder_i_rational_point point_of(const sunder_i_boundary *b, uint32_t v, sunder_i_arena *arena)
{
    if (!b->xy) return b->point[v];
    const double *xy = b->xy + 2 * (size_t)v;
    return (sunder_i_rational_point){sunder_i_big_in_units(arena, xy[0], b->unit),
                                     sunder_i_big_in_units(arena, xy[1], b->unit), sunder_i_big_i64(arena, 1)};
}

static sunder_i_ratio height_of(const sunder_i_boundary *b, const sunder_i_widest_interval *i, sunder_i_arena *arena)
{
    if (!b->xy) return i->height;
    return (sunder_i_ratio){sunder_i_big_add(arena, sunder_i_big_in_units(arena, i->low, b->unit),
                                             sunder_i_big_in_units(arena, i->high, b->unit)),
                            sunder_i_big_i64(arena, 2)};
}

/* Returns x of the crossing. With the heights p and q of the ends above the line, times the denominators of both, it is
 * (b.x p - a.x q) / (p b.w - q a.w). */
static sunder_i_ratio x_of(const sunder_i_boundary *b, const sunder_i_widest_interval *i, uint32_t edge,
                           sunder_i_arena *arena)
{
    const sunder_i_rational_point from = point_of(b, edge, arena), to = point_of(b, b->next[edge], arena);
    const sunder_i_ratio h = height_of(b, i, arena);
    const sunder_i_big p = sunder_i_big_sub(arena, sunder_i_big_mul(arena, from.y, h.den),
                                            sunder_i_times(arena, h.num, from.w)),
                       q = sunder_i_big_sub(arena, sunder_i_big_mul(arena, to.y, h.den),
                                            sunder_i_times(arena, h.num, to.w));
    sunder_i_ratio x = {sunder_i_big_sub(arena, sunder_i_big_mul(arena, to.x, p), sunder_i_big_mul(arena, from.x, q)),
                        sunder_i_big_sub(arena, sunder_i_times(arena, p, to.w), sunder_i_times(arena, q, from.w))};
    if (sunder_i_big_sign(x.den) < 0) x = (sunder_i_ratio){sunder_i_big_neg(x.num), sunder_i_big_neg(x.den)};
    return x;
}

/* Returns b - a. */
static sunder_i_ratio width_of(sunder_i_ratio a, sunder_i_ratio b, sunder_i_arena *arena)
{
    return (sunder_i_ratio){
        sunder_i_big_sub(arena, sunder_i_big_mul(arena, b.num, a.den), sunder_i_big_mul(arena, a.num, b.den)),
        sunder_i_big_mul(arena, a.den, b.den)};
}

/* ---- Sides of vertices ------------------------------------------------------------------------------------------- */

/* Returns the sign of 2 y - (low + high), exact also near the ends of the range of doubles. */
static int side_of_extreme(double y, double low, double high)
{
    sunder_i_accumulator exact = {{0}};
    sunder_i_accumulator_add(&exact, 2, y);
    sunder_i_accumulator_sub(&exact, 1, low);
    sunder_i_accumulator_sub(&exact, 1, high);
    return sunder_i_accumulator_sign(&exact);
}

/* Sets the sides of all vertices. Doubling is exact, or infinite with the correct sign; if 2 y equals the rounded sum,
 * its rounding error decides. */
static void set_sides(search *s, double low, double high)
{
    const sunder_i_boundary *b = s->b;
    if (!(fabs(low) < 0x1p1000 && fabs(high) < 0x1p1000)) {
        for (uint32_t v = 0; v < b->n; v++) s->side[v] = (int8_t)side_of_extreme(b->xy[2 * (size_t)v + 1], low, high);
        return;
    }
    const double sum = low + high, part = sum - low, rest = (low - (sum - part)) + (high - part);
    const int level = (rest < 0) - (rest > 0);
    for (uint32_t v = 0; v < b->n; v++) {
        const double twice = 2 * b->xy[2 * (size_t)v + 1];
        s->side[v] = (int8_t)(twice == sum ? level : (twice > sum) - (twice < sum));
    }
}

static int side_of_point(search *s, uint32_t v)
{
    const sunder_i_mark mark = sunder_i_arena_mark(s->arena);
    const sunder_i_ratio y = {s->b->point[v].y, s->b->point[v].w};
    const int side = sunder_i_ratio_cmp(s->arena, y, s->out->height);
    if (!s->arena->failed) sunder_i_arena_release(s->arena, mark);
    return side;
}

static int compare_heights(search *s, uint32_t v, uint32_t w)
{
    if (s->b->xy) {
        const double y = s->b->xy[2 * (size_t)v + 1], z = s->b->xy[2 * (size_t)w + 1];
        return (y > z) - (y < z);
    }
    const sunder_i_mark mark = sunder_i_arena_mark(s->arena);
    const int order = sunder_i_rational_cmp(s->arena, &s->b->point[v], &s->b->point[w], 1);
    if (!s->arena->failed) sunder_i_arena_release(s->arena, mark);
    return order;
}

/* Sets the height to the mean of the heights of two vertices, and the sides of all vertices. */
static void set_height(search *s, uint32_t lowest, uint32_t highest)
{
    const sunder_i_boundary *b = s->b;
    if (b->xy) {
        s->out->low = b->xy[2 * (size_t)lowest + 1];
        s->out->high = b->xy[2 * (size_t)highest + 1];
        set_sides(s, s->out->low, s->out->high);
        return;
    }
    const sunder_i_rational_point *p = &b->point[lowest], *q = &b->point[highest];
    sunder_i_ratio sum = sunder_i_ratio_add(s->arena, (sunder_i_ratio){p->y, p->w}, (sunder_i_ratio){q->y, q->w});
    sum.den = sunder_i_big_shl(s->arena, sum.den, 1);
    s->out->height = sum;
    for (uint32_t v = 0; v < b->n && !s->arena->failed; v++) s->side[v] = (int8_t)side_of_point(s, v);
}

/* ---- Crossings --------------------------------------------------------------------------------------------------- */

static void locate_crossing(const search *s, uint32_t edge, sunder_i_level_crossing *c)
{
    const sunder_i_boundary *b = s->b;
    const uint32_t next = b->next[edge];
    *c = (sunder_i_level_crossing){.edge = edge, .opens = s->side[edge] > s->side[next], .off = INFINITY};
    if (!b->xy) return;
    const double *p = b->xy + 2 * (size_t)edge, *q = b->xy + 2 * (size_t)next, *o = b->xy;
    c->exact = s->side[edge] == 0 || s->side[next] == 0 || p[0] == q[0];
    c->at = s->side[next] == 0 ? q[0] : p[0];
    const double far = fabs(c->at - o[0]);
    if (c->exact) {
        c->along = c->at - o[0];
        c->off = far < 0x1p400 ? 0x1p-52 * far : INFINITY;
        return;
    }
    const double height = s->out->high - s->out->low, fall = p[1] - q[1], run = q[0] - p[0];
    const double above = (p[1] - s->out->low) - height / 2, steep = height / fabs(fall);
    c->along = (p[0] - o[0]) + run * (above / fall);
    const double off = 0x1p-49 * (far + fabs(run) * (1 + steep)) + 0x1p-600;
    if (height < 0x1p400 && height > 0x1p-400 && steep < 0x1p200 && off < 0x1p400) c->off = off;
}

/* Lists the crossings of edges that extend above the line (up = 1), or below it (-1). */
static uint32_t gather_crossings(const search *s, int up, sunder_i_level_crossing *list)
{
    uint32_t n = 0;
    for (uint32_t v = 0; v < s->b->n; v++) {
        const int a = up * s->side[v], b = up * s->side[s->b->next[v]];
        if (a * b > 0 || a + b < (a * b < 0 ? 0 : 1)) continue;
        locate_crossing(s, v, &list[n++]);
    }
    return n;
}

static int compare_x(const search *s, const sunder_i_level_crossing *a, const sunder_i_level_crossing *b)
{
    if (a->edge == b->edge) return 0;
    if (a->exact && b->exact) return (a->at > b->at) - (a->at < b->at);
    const double off = a->off + b->off, less = a->along - b->along;
    if (less > off) return 1;
    if (-less > off) return -1;
    const sunder_i_mark mark = sunder_i_arena_mark(s->arena);
    const int order =
        sunder_i_ratio_cmp(s->arena, x_of(s->b, s->out, a->edge, s->arena), x_of(s->b, s->out, b->edge, s->arena));
    if (!s->arena->failed) sunder_i_arena_release(s->arena, mark);
    return order;
}

/* Compares two edges that meet on the line by their positions just beyond it: by the cross product of their directions
 * away from the line. */
static int compare_directions(const search *s, uint32_t a, uint32_t b, int up)
{
    const sunder_i_mark mark = sunder_i_arena_mark(s->arena);
    sunder_i_rational_point away[2];
    for (int k = 0; k < 2; k++) {
        const uint32_t e = k ? b : a;
        const sunder_i_rational_point from = point_of(s->b, e, s->arena), to = point_of(s->b, s->b->next[e], s->arena);
        const bool leaves = up * s->side[e] < up * s->side[s->b->next[e]];
        away[k] = leaves ? sunder_i_rational_sub(s->arena, to, from) : sunder_i_rational_sub(s->arena, from, to);
    }
    const int turn = sunder_i_rational_cross_sign(s->arena, away[0], away[1]);
    if (!s->arena->failed) sunder_i_arena_release(s->arena, mark);
    return up * turn;
}

static int compare_crossings(const search *s, const sunder_i_level_crossing *a, const sunder_i_level_crossing *b,
                             int up)
{
    int order = compare_x(s, a, b);
    if (order == 0) order = compare_directions(s, a->edge, b->edge, up);
    return order ? order : b->opens - a->opens;
}

/* Shell's sort, which needs no memory. */
static void sort_crossings(const search *s, sunder_i_level_crossing *list, uint32_t n, int up)
{
    uint32_t gap = 1;
    while (gap < n / 3) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (uint32_t k = gap; k < n && !s->arena->failed; k++) {
            const sunder_i_level_crossing held = list[k];
            uint32_t at = k;
            for (; at >= gap && compare_crossings(s, &list[at - gap], &held, up) > 0; at -= gap)
                list[at] = list[at - gap];
            list[at] = held;
        }
}

/* ---- Intervals --------------------------------------------------------------------------------------------------- */

/* Reduces the list to the two ends of each interval that is covered on one side of the line; returns the number of
 * ends. */
static uint32_t find_covered(const search *s, int up, sunder_i_level_crossing *list)
{
    const uint32_t n = gather_crossings(s, up, list);
    uint32_t ends = 0;
    int covered = 0;
    sort_crossings(s, list, n, up);
    for (uint32_t k = 0; k < n; k++) {
        if (covered == 0) list[ends++] = list[k];
        covered += list[k].opens ? 1 : -1;
        if (covered == 0) list[ends++] = list[k];
    }
    return ends;
}

/* Compares the widths of two intervals. */
static int compare_widths(const search *s, const sunder_i_level_crossing *const a[2],
                          const sunder_i_level_crossing *const b[2])
{
    const double wide[2] = {a[1]->along - a[0]->along, b[1]->along - b[0]->along}, less = wide[0] - wide[1];
    const double off = a[0]->off + a[1]->off + b[0]->off + b[1]->off + 0x1p-51 * (fabs(wide[0]) + fabs(wide[1]));
    if (less > off) return 1;
    if (-less > off) return -1;
    const sunder_i_mark mark = sunder_i_arena_mark(s->arena);
    sunder_i_ratio width[2];
    for (int k = 0; k < 2; k++) {
        const sunder_i_level_crossing *const *c = k ? b : a;
        width[k] =
            width_of(x_of(s->b, s->out, c[0]->edge, s->arena), x_of(s->b, s->out, c[1]->edge, s->arena), s->arena);
    }
    const int order = sunder_i_ratio_cmp(s->arena, width[0], width[1]);
    if (!s->arena->failed) sunder_i_arena_release(s->arena, mark);
    return order;
}

/* Sets the result to the widest interval that both lists cover. Returns false if there is none. */
static bool take_widest(const search *s, const sunder_i_level_crossing *above, uint32_t m,
                        const sunder_i_level_crossing *below, uint32_t n)
{
    const sunder_i_level_crossing *best[2] = {NULL, NULL};
    for (uint32_t i = 0, j = 0; i + 1 < m && j + 1 < n && !s->arena->failed;) {
        const sunder_i_level_crossing *const both[2] = {compare_x(s, &above[i], &below[j]) < 0 ? &below[j] : &above[i],
                                                        compare_x(s, &above[i + 1], &below[j + 1]) < 0 ? &above[i + 1]
                                                                                                       : &below[j + 1]};
        if (compare_x(s, both[0], both[1]) < 0 && (!best[0] || compare_widths(s, both, best) > 0)) {
            best[0] = both[0];
            best[1] = both[1];
        }
        if (both[1] == &above[i + 1])
            i += 2;
        else
            j += 2;
    }
    if (!best[0]) return false;
    s->out->from = *best[0];
    s->out->to = *best[1];
    return true;
}

/* Returns whether no vertex is on the line; then both sides of the line are equal. */
static bool is_plain(const search *s)
{
    bool plain = true;
    for (uint32_t v = 0; v < s->b->n; v++) plain &= s->side[v] != 0;
    return plain;
}

static bool look_at_height(const search *s, sunder_i_level_crossing *list)
{
    const uint32_t m = find_covered(s, 1, list);
    if (is_plain(s)) return take_widest(s, list, m, list, m);
    const uint32_t n = find_covered(s, -1, list + s->b->n);
    return take_widest(s, list, m, list + s->b->n, n);
}

/* Returns the highest vertex of the part below the line. */
static uint32_t top_below(search *s)
{
    uint32_t top = s->b->n;
    for (uint32_t v = 0; v < s->b->n; v++) {
        const uint32_t next = s->b->next[v];
        if (s->side[v] >= 0 && s->side[next] >= 0) continue;
        const uint32_t higher = compare_heights(s, v, next) > 0 ? v : next;
        if (top == s->b->n || compare_heights(s, higher, top) > 0) top = higher;
    }
    return top;
}

/* Finds a lowest and a highest vertex. */
static void find_extremes(search *s, uint32_t *low, uint32_t *high)
{
    const double *xy = s->b->xy;
    *low = *high = 0;
    for (uint32_t v = 1; v < s->b->n; v++) {
        if (xy ? xy[2 * (size_t)v + 1] < xy[2 * (size_t)*low + 1] : compare_heights(s, v, *low) < 0) *low = v;
        if (xy ? xy[2 * (size_t)v + 1] > xy[2 * (size_t)*high + 1] : compare_heights(s, v, *high) > 0) *high = v;
    }
}

void sunder_i_widest_interval_find(const sunder_i_boundary *boundary, int8_t *side, sunder_i_level_crossing *crossing,
                                   sunder_i_arena *arena, sunder_i_widest_interval *out)
{
    search s = {boundary, arena, out, side};
    uint32_t low, high;
    find_extremes(&s, &low, &high);
    set_height(&s, low, high);
    while (!arena->failed && !look_at_height(&s, crossing)) set_height(&s, low, top_below(&s));
}

/* ---- The midpoint ------------------------------------------------------------------------------------------------ */

sunder_i_rational_point sunder_i_widest_interval_middle(const sunder_i_boundary *boundary,
                                                        const sunder_i_widest_interval *interval, sunder_i_arena *arena)
{
    const sunder_i_ratio p = x_of(boundary, interval, interval->from.edge, arena),
                         q = x_of(boundary, interval, interval->to.edge, arena),
                         y = height_of(boundary, interval, arena);
    const sunder_i_ratio sum = {
        sunder_i_big_add(arena, sunder_i_big_mul(arena, p.num, q.den), sunder_i_big_mul(arena, q.num, p.den)),
        sunder_i_big_shl(arena, sunder_i_big_mul(arena, p.den, q.den), 1)};
    return (sunder_i_rational_point){sunder_i_big_mul(arena, sum.num, y.den), sunder_i_big_mul(arena, y.num, sum.den),
                                     sunder_i_big_mul(arena, sum.den, y.den)};
}

/* Sets *out to the mean of two doubles. Returns false if halving may round, too, or the sum is too large. */
static bool middle_of(double a, double b, double *out)
{
    const double sum = a + b;
    *out = sum / 2 + 0.0;
    return sum == 0 || (fabs(sum) > 0x1p-1000 && isfinite(sum));
}

void sunder_i_widest_interval_doubles(const sunder_i_boundary *boundary, const sunder_i_widest_interval *interval,
                                      sunder_i_arena *arena, double xy[2])
{
    const double o = boundary->xy[0], c = (interval->from.along + interval->to.along) / 2,
                 off = (interval->from.off + interval->to.off) / 2 + 0x1p-51 * fabs(c);
    bool sure = middle_of(interval->low, interval->high, &xy[1]);
    if (interval->from.exact && interval->to.exact) {
        sure = middle_of(interval->from.at, interval->to.at, &xy[0]) && sure;
    } else {
        xy[0] = o + (c - off);
        sure = sure && isfinite(xy[0]) && xy[0] == o + (c + off);
    }
    if (sure) return;
    const sunder_i_rational_point at = sunder_i_widest_interval_middle(boundary, interval, arena);
    sunder_i_rational_doubles(arena, at, boundary->unit, &xy[0], &xy[1]);
}
