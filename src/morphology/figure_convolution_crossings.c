/* figure_convolution_crossings.c: the crossings of the curve with itself. Candidate pairs of links are found by a tree
 * over their boxes, in the order of the rings; each pair whose boxes meet is decided by the sides of their ends, in
 * doubles with an error bound, and exactly if these do not suffice. */
#include "morphology/figure_convolution.h"

#include "base/sort.h"
#include "base/watch.h"
#include "number/trust.h"
#include "predicate/predicate.h"
#include "spatial/box_tree.h"

#include <math.h>
#include <string.h>

enum {
    BLOCK = 8,     /* the number of links in a leaf of the tree */
    PATIENCE = 256 /* the average number of pairs of links tested for each link; a curve that meets itself more often
                    * has little of it on the boundary */
};

/* ---- Predicates ---- */

/* With e the error of a coordinate and M the largest of them, e >= 2^-51 M: a difference of two has an error of 2 e,
 * plus 2^-52 M <= e / 2 for rounding, hence less than 3 e. Let S be the sum of the absolute values of the four
 * differences: their two products have a total error of 3 e S + 18 e^2, plus 2^-51 of the products, whose sum is at
 * most S^2 / 4, for rounding. */
int sunder_i_curve_side(sunder_i_figure_convolution *curve, const sunder_i_curve_corner *a,
                        const sunder_i_curve_corner *b, const sunder_i_curve_corner *c)
{
    const double ux = b->xy[0] - a->xy[0], uy = b->xy[1] - a->xy[1], vx = c->xy[0] - a->xy[0], vy = c->xy[1] - a->xy[1];
    const double det = ux * vy - uy * vx, sum = fabs(ux) + fabs(uy) + fabs(vx) + fabs(vy), e = curve->error;
    const double bound = SUNDER_I_DOUBT(4 * e * (sum + 6 * e) + 0x1p-50 * sum * sum + SUNDER_I_APPROX_UNDERFLOW);
    curve->counts.orientation_tests++;
    if (fabs(det) > bound) return det > 0 ? 1 : -1;
    curve->counts.exact_fallbacks++;
    const sunder_i_mark mark = sunder_i_arena_mark(&curve->scratch);
    const int side = sunder_i_rational_orient(&curve->scratch, a->at, b->at, c->at);
    sunder_i_arena_release(&curve->scratch, mark);
    return side;
}

int sunder_i_curve_cmp_axis(sunder_i_figure_convolution *curve, const sunder_i_curve_corner *a,
                            const sunder_i_curve_corner *b, int axis)
{
    const double ahead = a->xy[axis] - b->xy[axis];
    curve->counts.comparisons++;
    if (fabs(ahead) > SUNDER_I_DOUBT(3 * curve->error)) return ahead > 0 ? 1 : -1;
    curve->counts.exact_fallbacks++;
    const sunder_i_mark mark = sunder_i_arena_mark(&curve->scratch);
    const int order = sunder_i_rational_cmp(&curve->scratch, &a->at, &b->at, axis);
    sunder_i_arena_release(&curve->scratch, mark);
    return order;
}

/* ---- Pairs ---- */

typedef struct crosser {
    sunder_i_figure_convolution *curve;
    double (*box)[4]; /* [links] */
    sunder_i_box_tree tree;
    size_t pairs; /* the number of pairs that may still be tested */
    size_t stops_capacity, crossings_capacity, touches_capacity;
    bool fits, no_memory;
} crosser;

/* Returns cross(d, p) times p's denominator, for the line through p with the direction d: cross(d, X - p) is 0 on that
 * line. */
static sunder_i_big line_offset(sunder_i_arena *s, const sunder_i_curve_link *l)
{
    return sunder_i_big_sub(s, sunder_i_big_mul(s, sunder_i_big_i64(s, l->along.x), l->from.at.y),
                            sunder_i_big_mul(s, sunder_i_big_i64(s, l->along.y), l->from.at.x));
}

/* Returns k m - l n, where m and n are coordinates of plain vectors. */
static sunder_i_big difference_of_products(sunder_i_arena *s, sunder_i_big k, int64_t m, sunder_i_big l, int64_t n)
{
    return sunder_i_big_sub(s, sunder_i_big_mul(s, k, sunder_i_big_i64(s, m)),
                            sunder_i_big_mul(s, l, sunder_i_big_i64(s, n)));
}

/* Returns the intersection of two lines with the directions d and e that are not parallel: cross(d, X) = k / v and
 * cross(e, X) = l / w result in X = (k w e - l v d) / (v w cross(d, e)). */
static sunder_i_rational_point meeting_point(sunder_i_arena *s, const sunder_i_curve_link *a,
                                             const sunder_i_curve_link *b)
{
    const sunder_i_point d = a->along, e = b->along;
    const sunder_i_big det = sunder_i_big_i128(s, sunder_i_plain_cross(d, e));
    const sunder_i_big kw = sunder_i_times(s, line_offset(s, a), b->from.at.w);
    const sunder_i_big lv = sunder_i_times(s, line_offset(s, b), a->from.at.w);
    sunder_i_rational_point x = {difference_of_products(s, kw, e.x, lv, d.x),
                                 difference_of_products(s, kw, e.y, lv, d.y),
                                 sunder_i_times(s, sunder_i_times(s, det, a->from.at.w), b->from.at.w)};
    if (sunder_i_big_sign(x.w) < 0) {
        x = sunder_i_rational_neg(x);
        x.w = sunder_i_big_neg(x.w);
    }
    return sunder_i_rational_reduced(s, x);
}

static void add_crossing(crosser *x, uint32_t i, uint32_t j, bool rises)
{
    sunder_i_figure_convolution *c = x->curve;
    if (!sunder_i_arena_reserve(&c->memory, &c->stop, &x->stops_capacity, c->stops + 2, sizeof *c->stop) ||
        !sunder_i_arena_reserve(&c->memory, &c->crossing, &x->crossings_capacity, c->crossings + 1,
                                sizeof *c->crossing)) {
        x->no_memory = true;
        return;
    }
    const sunder_i_mark mark = sunder_i_arena_mark(&c->scratch);
    sunder_i_curve_corner *at = &c->crossing[c->crossings];
    at->at = sunder_i_rational_copy(&c->memory, meeting_point(&c->scratch, &c->link[i], &c->link[j]));
    if (!c->scratch.failed && !c->memory.failed)
        sunder_i_rational_doubles(&c->scratch, at->at, c->shift, &at->xy[0], &at->xy[1]);
    sunder_i_arena_release(&c->scratch, mark);
    const uint32_t n = (uint32_t)c->stops, number = (uint32_t)c->crossings++;
    c->stop[n] = (sunder_i_curve_stop){i, n + 1, number, rises};
    c->stop[n + 1] = (sunder_i_curve_stop){j, n, number, !rises};
    c->stops += 2;
    c->counts.segment_intersections++;
}

static void add_touch(crosser *x, uint32_t corner, uint32_t other)
{
    sunder_i_figure_convolution *c = x->curve;
    if (sunder_i_arena_reserve(&c->memory, &c->touch, &x->touches_capacity, c->touches + 1, sizeof *c->touch))
        c->touch[c->touches++] = (sunder_i_curve_touch){{corner, other}};
    else
        x->no_memory = true;
}

/* Tests two links whose boxes meet. Consecutive links share an end and nothing else, unless they are collinear. If one
 * end of each is on the line of the other and the other ends are not, the lines meet in one point, and both ends are
 * there. A link that ends inside another one, or is along it, makes the curve unsuitable. */
static void cross_links(crosser *x, uint32_t i, uint32_t j)
{
    sunder_i_figure_convolution *c = x->curve;
    const sunder_i_curve_corner *a = &c->link[i].from, *b = sunder_i_curve_end(c, i), *p = &c->link[j].from,
                                *q = sunder_i_curve_end(c, j);
    if (c->link[i].next == j || c->link[j].next == i) {
        if (sunder_i_plain_cross(c->link[i].along, c->link[j].along) == 0) x->fits = false;
        return;
    }
    const int side_p = sunder_i_curve_side(c, a, b, p), side_q = sunder_i_curve_side(c, a, b, q);
    if (side_p * side_q > 0) return;
    const int side_a = sunder_i_curve_side(c, p, q, a), side_b = sunder_i_curve_side(c, p, q, b);
    if (side_a * side_b > 0) return;
    if (side_p && side_q && side_a && side_b)
        add_crossing(x, i, j, side_b > 0);
    else if (!side_p != !side_q && !side_a != !side_b)
        add_touch(x, side_a ? c->link[i].next : i, side_p ? c->link[j].next : j);
    else
        x->fits = false;
}

/* Tests the links of two leaves, or those of one leaf with each other. */
static void cross_leaves(crosser *x, size_t leaf, size_t other)
{
    const size_t end = sunder_i_box_tree_end(&x->tree, leaf), last = sunder_i_box_tree_end(&x->tree, other);
    for (size_t i = sunder_i_box_tree_first(&x->tree, leaf); i < end; i++) {
        const size_t first = leaf == other ? i + 1 : sunder_i_box_tree_first(&x->tree, other);
        for (size_t j = first; j < last && x->fits && !x->no_memory; j++) {
            if (!sunder_i_box_meet_any(x->box[i], x->box[j])) continue;
            x->fits = x->pairs > 0;
            x->pairs -= x->fits;
            cross_links(x, (uint32_t)i, (uint32_t)j);
            x->no_memory |= !sunder_i_step();
        }
    }
}

static void cross_all(crosser *x)
{
    const sunder_i_box_tree *tree = &x->tree;
    for (size_t leaf = tree->leaves; leaf < 2 * tree->leaves && x->fits && !x->no_memory; leaf++) {
        sunder_i_box_walk walk;
        sunder_i_box_walk_start(&walk, tree);
        x->no_memory |= !sunder_i_step();
        for (size_t node; sunder_i_box_walk_next(&walk, &node);) {
            if (!sunder_i_box_meet(tree->box[node], tree->box[leaf])) continue;
            if (node < tree->leaves)
                sunder_i_box_walk_open(&walk, 2 * node + 1, 2 * node);
            else if (node >= leaf)
                cross_leaves(x, leaf, node);
        }
    }
}

static void add_box(const void *of, size_t i, double box[4])
{
    const crosser *x = of;
    sunder_i_box_join(box, x->box[i]);
}

static bool make_tree(crosser *x)
{
    sunder_i_figure_convolution *c = x->curve;
    x->box = sunder_i_arena_alloc(&c->memory, c->links, sizeof *x->box);
    x->tree = sunder_i_box_tree_of(c->links, BLOCK);
    x->tree.box = sunder_i_arena_alloc(&c->memory, 2 * x->tree.leaves, sizeof *x->tree.box);
    if (!x->box || !x->tree.box) return false;
    for (uint32_t i = 0; i < c->links; i++) {
        sunder_i_box_of_segment(c->link[i].from.xy, sunder_i_curve_end(c, i)->xy, x->box[i]);
        for (int k = 0; k < 4; k++) x->box[i][k] += k < 2 ? -2 * c->error : 2 * c->error;
    }
    sunder_i_box_tree_fill(&x->tree, add_box, x);
    return sunder_i_steps(c->links);
}

/* ---- Sorting stops along their links ---- */

/* Compares stops on one link by their positions, in the reverse order if the link's direction is descending. */
static int compare_stops(void *context, uint32_t a, uint32_t b)
{
    sunder_i_figure_convolution *c = context;
    const sunder_i_point d = c->link[c->stop[a].link].along;
    const int order = sunder_i_curve_cmp(c, &c->crossing[c->stop[a].crossing], &c->crossing[c->stop[b].crossing]);
    return (d.x ? d.x > 0 : d.y > 0) ? order : -order;
}

/* Lists the numbers of all stops, link by link, and sets the end of each link's stops. */
static void group_stops(sunder_i_figure_convolution *c, uint32_t *order)
{
    uint32_t *end = c->stop_end, before = 0;
    memset(end, 0, c->links * sizeof *end);
    for (size_t i = 0; i < c->stops; i++) end[c->stop[i].link]++;
    for (uint32_t k = 0; k < c->links; k++) {
        const uint32_t own = end[k];
        end[k] = before; /* the position of the next one; finally the end */
        before += own;
    }
    for (uint32_t i = 0; i < c->stops; i++) order[end[c->stop[i].link]++] = i;
}

/* Sorts the stops and updates their partners. Two stops at one position of a link mean that three links cross there,
 * which is unsuitable. */
static bool order_stops(crosser *x)
{
    sunder_i_figure_convolution *c = x->curve;
    const size_t n = c->stops;
    uint32_t *order = sunder_i_arena_alloc(&c->memory, n, sizeof *order);
    uint32_t *rank = sunder_i_arena_alloc(&c->memory, n, sizeof *rank);
    sunder_i_curve_stop *sorted = sunder_i_arena_alloc(&c->memory, n, sizeof *sorted);
    if (!order || !rank || !sorted) return false;
    group_stops(c, order);
    for (uint32_t k = 0, begin = 0; k < c->links; begin = c->stop_end[k++]) {
        if (c->stop_end[k] - begin < 2) continue;
        if (!sunder_i_sort_indices(order + begin, c->stop_end[k] - begin, compare_stops, c)) return false;
        for (uint32_t i = begin + 1; i < c->stop_end[k]; i++)
            if (compare_stops(c, order[i - 1], order[i]) == 0) x->fits = false;
    }
    for (uint32_t i = 0; i < n; i++) rank[order[i]] = i;
    for (uint32_t i = 0; i < n; i++) {
        sorted[i] = c->stop[order[i]];
        sorted[i].partner = rank[sorted[i].partner];
    }
    c->stop = sorted;
    return true;
}

sunder_status sunder_i_figure_convolution_cross(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err)
{
    crosser x = {.curve = curve, .pairs = PATIENCE * (size_t)curve->links, .fits = true};
    curve->stop_end = sunder_i_arena_alloc(&curve->memory, curve->links, sizeof *curve->stop_end);
    bool ok = curve->stop_end && make_tree(&x);
    if (ok) cross_all(&x);
    ok = ok && !x.no_memory && !curve->memory.failed && !curve->scratch.failed;
    if (ok && x.fits) ok = order_stops(&x) && !curve->scratch.failed;
    *fits = x.fits;
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
