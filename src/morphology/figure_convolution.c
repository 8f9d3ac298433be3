/* figure_convolution.c: F + C, or the erosion of F, which is the complement of F^c + C, for a convex C, where the
 * vertices of F are rational: by following the convolution [GRS83], as ../minkowski/convolution.c does for integers.
 * Let X be F or its complement.
 *
 * A band (dilate_erode.c) for each side of F has the vertices of C. After a dilation by an n-gon most sides of F are
 * those of arcs, about n for each vertex of the set that was dilated, so that an erosion by bands costs n^2. Along the
 * complement's convolution by -C, the translated sides of such an arc shrink to the vertex about which the arc was
 * made. What remains are the sides of the set that was dilated, and, at each vertex where two arcs or sides of F meet,
 * the part of -C between them: about as many links as the result has sides.
 *
 * ../minkowski/convolution.c explains why the winding numbers prove the result, and when the curve is *tame*. The
 * differences here:
 *
 *   - The complement is not bounded: far away the winding number is 1, and it still counts the components of X in x -
 *     C. Components have holes only if a part of F is inside x - C; by the boxes of F's outer rings either none is, or
 *     nothing of F remains and its ring is omitted.
 *   - A side of which nothing remains is one vertex v, and so is a whole arc of such sides: the boundary of v - C is
 *     along it. The sides there and those before and after turn by less than half a turn together, else the curve is
 *     declined: so x - C moves away from all of them for x beside v on the free side. That contact creates no component
 *     then, and a component that exists at x and vanishes at v does so in another contact, whose link passes v, or
 *     which is a vertex at v.
 *   - Vertices of several parts of the curve often have one position (figure_convolution_places.c). They are accepted
 *     if exactly one sector of the position is free, so that the position is a vertex of the result, and no degenerate
 *     hole.
 *
 * All vertices are those of F plus those of C, and crossings of two links: no numbers become longer than with bands. */
#include "morphology/figure_convolution.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/watch.h"
#include "predicate/predicate.h"
#include "spatial/strips.h"
#include "sum/canonical_sum.h"

#include <string.h>

/* A vertex of the result, and the link on which its ring continues along the curve. */
typedef struct bend {
    sunder_i_curve_corner at;
    uint32_t leaves;
} bend;

/* A piece of a link is between two stops, or between a stop and an end. Link i has its pieces from stop_begin(i) + i
 * on, one more than it has stops. */
typedef struct walker {
    sunder_i_figure_convolution *curve;
    int32_t *right; /* [pieces] the winding number on the right side */
    bool *done;     /* [pieces] whether the piece is part of a ring already */
    bool tame;      /* nothing contradicts that the curve is tame */
    bend *bend;     /* the vertices of all rings of the result */
    uint32_t bends;
    sunder_i_found_ring *ring; /* start and end are numbers of bends; each ring in the order of the curve, from any bend
                                * on */
    uint32_t *least;           /* [rings] the smallest bend */
    size_t rings, rings_capacity, least_capacity;
    uint32_t components;
} walker;

static uint32_t stop_begin(const sunder_i_figure_convolution *c, uint32_t link)
{
    return link ? c->stop_end[link - 1] : 0;
}

/* ---- Segments on the left of a point ---- */

/* Sorts segments by height, to find those that pass on the left of a point. Returns false if out of memory. */
static bool build_strips(sunder_i_strips *strips, double (*span)[2], size_t n, double error)
{
    for (size_t i = 0; i < n; i++) {
        const double a = span[i][0], b = span[i][1];
        span[i][0] = sunder_i_lesser(a, b) - 4 * error;
        span[i][1] = sunder_i_greater(a, b) + 4 * error;
    }
    return sunder_i_strips_build(strips, (const double(*)[2])span, n, n);
}

/* Returns +1 if the segment from a to b crosses the ray from the point `at` to the left upwards, -1 if it crosses the
 * ray downwards, 0 if it does not. The point is not on the segment. */
static int passes_left(sunder_i_figure_convolution *c, const sunder_i_curve_corner *a, const sunder_i_curve_corner *b,
                       const sunder_i_curve_corner *at)
{
    const bool up = sunder_i_curve_cmp_axis(c, b, at, 1) > 0;
    if (up == (sunder_i_curve_cmp_axis(c, a, at, 1) > 0)) return 0;
    const double left = sunder_i_lesser(a->xy[0], b->xy[0]), right = sunder_i_greater(a->xy[0], b->xy[0]);
    if (left - at->xy[0] > 4 * c->error) return 0;
    if (at->xy[0] - right > 4 * c->error) return up ? 1 : -1;
    const int side = sunder_i_curve_side(c, a, b, at);
    return up ? side < 0 : side > 0 ? -1 : 0;
}

/* ---- Winding numbers ---- */

/* Returns the winding number of all rings except one about a point that none of them touches. */
static int32_t winding_of_others(sunder_i_figure_convolution *c, const sunder_i_strips *strips,
                                 const sunder_i_curve_corner *at, uint32_t ring)
{
    int32_t winding = 0;
    size_t from, to;
    sunder_i_strips_at(strips, at->xy[1], &from, &to);
    for (; from < to; from++) {
        const uint32_t i = strips->item[from];
        if (c->link[i].ring != ring) winding -= passes_left(c, &c->link[i].from, sunder_i_curve_end(c, i), at);
    }
    return winding;
}

static uint32_t smallest_corner(sunder_i_figure_convolution *c, uint32_t ring)
{
    uint32_t least = sunder_i_curve_first(c, ring);
    for (uint32_t i = least + 1; i < c->ring_end[ring]; i++)
        if (sunder_i_curve_cmp(c, &c->link[i].from, &c->link[least].from) < 0) least = i;
    return least;
}

/* Returns the ray of the link that begins at a corner (leaves), or of the link before it, among the rays of the
 * corner's place. */
static const sunder_i_curve_ray *find_ray(const sunder_i_figure_convolution *c, uint32_t corner, bool leaves)
{
    const sunder_i_curve_ray *ray = c->ray + sunder_i_place_first(c, c->link[corner].place - 1);
    while (ray->corner != corner || ray->leaves != leaves) ray++;
    return ray;
}

/* Returns the change of the winding number on the right side of the curve at a corner: if other corners have the same
 * position, their links may pass on the right of the bend. The right side of an arriving link is the sector after its
 * ray, that of a leaving link the sector before its ray. */
static int32_t number_change(const sunder_i_figure_convolution *c, uint32_t corner)
{
    if (!c->link[corner].place) return 0;
    return find_ray(c, corner, true)->number - 1 - find_ray(c, corner, false)->number;
}

/* Computes the winding numbers on the right of all pieces of a ring. At the ring's smallest corner the outside of the
 * ring is in the west: at a left turn it is on the right side, at a right turn on the left, and there the ring itself
 * counts -1 on the right. Rings with a common smallest corner have no links west of it, slightly above. */
static void number_ring(walker *w, const sunder_i_strips *strips, uint32_t ring)
{
    sunder_i_figure_convolution *c = w->curve;
    const uint32_t least = smallest_corner(c, ring);
    const uint32_t last = (least > sunder_i_curve_first(c, ring) ? least : c->ring_end[ring]) - 1;
    const int32_t others = c->rings > 1 ? winding_of_others(c, strips, &c->link[least].from, ring) : 0;
    int32_t start = others + c->erode;
    if (c->link[least].place)
        start += find_ray(c, least, true)->number - 1;
    else if (sunder_i_plain_cross(c->link[last].along, c->link[least].along) < 0)
        start--;
    int32_t right = start;
    uint32_t i = least;
    do {
        uint32_t piece = stop_begin(c, i) + i;
        for (uint32_t s = stop_begin(c, i); s < c->stop_end[i]; s++) {
            w->right[piece++] = right;
            right += c->stop[s].rises ? 1 : -1;
        }
        w->right[piece] = right;
        if (right < 0 || (right == 0 && c->link[i].chord)) w->tame = false;
        i = c->link[i].next;
        right += number_change(c, i);
    } while (i != least);
    if (right != start) w->tame = false;
}

/* Returns whether exactly one sector of a place is free, and no sector has a negative winding number. Then the place is
 * one vertex of the result; with several free sectors it would be more than one, with none perhaps a degenerate
 * hole. */
static bool is_plain_place(const walker *w, uint32_t place)
{
    const sunder_i_figure_convolution *c = w->curve;
    const uint32_t first = sunder_i_place_first(c, place), end = c->place_end[place];
    uint32_t k = first, free_sectors = 0;
    while (c->ray[k].leaves) k++;
    const uint32_t in = c->ray[k].link;
    const int32_t west = w->right[c->stop_end[in] + in] - c->ray[k].number;
    for (k = first; k < end; k++) {
        const int32_t number = west + c->ray[k].number;
        if (number < 0) return false;
        free_sectors += number == 0;
    }
    return free_sectors == 1;
}

/* Computes all winding numbers. Returns false if out of memory. */
static bool number_all(walker *w)
{
    sunder_i_figure_convolution *c = w->curve;
    sunder_i_strips strips = {0};
    bool ok = true;
    if (c->rings > 1) {
        double(*span)[2] = sunder_i_alloc(c->links, sizeof *span);
        for (uint32_t i = 0; span && i < c->links; i++) {
            span[i][0] = c->link[i].from.xy[1];
            span[i][1] = sunder_i_curve_end(c, i)->xy[1];
        }
        ok = span && build_strips(&strips, span, c->links, c->error);
        sunder_i_free(span);
    }
    for (uint32_t r = 0; ok && r < c->rings; r++) {
        number_ring(w, &strips, r);
        ok = sunder_i_steps(c->ring_end[r] - sunder_i_curve_first(c, r));
    }
    sunder_i_strips_free(&strips);
    for (uint32_t p = 0; ok && p < c->places; p++) w->tame = w->tame && is_plain_place(w, p);
    return ok;
}

/* ---- Rings ---- */

/* Returns the link on which the boundary continues at the end of link i: the first one after it, counterclockwise
 * across the free sector. */
static uint32_t next_link(walker *w, uint32_t i)
{
    const sunder_i_figure_convolution *c = w->curve;
    const uint32_t next = c->link[i].next, place = c->link[next].place;
    if (!place) return next;
    const sunder_i_curve_ray *ray = find_ray(c, next, false) + 1;
    if (ray == c->ray + c->place_end[place - 1]) ray = c->ray + sunder_i_place_first(c, place - 1);
    if (!ray->leaves || sunder_i_plain_cross(c->link[i].along, ray->along) == 0) w->tame = false;
    return ray->corner;
}

/* Follows the boundary from piece k of link i until it closes: at a crossing it continues on the link that comes from
 * the left, which has the free side on its right as well. */
static void follow_boundary(walker *w, uint32_t i, uint32_t k)
{
    const sunder_i_figure_convolution *c = w->curve;
    for (;;) {
        const uint32_t piece = stop_begin(c, i) + i + k, s = stop_begin(c, i) + k;
        if (w->done[piece]) return;
        if (w->right[piece] != 0) w->tame = false;
        w->done[piece] = true;
        const sunder_i_curve_corner *at;
        if (s < c->stop_end[i]) {
            const sunder_i_curve_stop *stop = &c->stop[s];
            at = &c->crossing[stop->crossing];
            i = c->stop[stop->partner].link;
            k = stop->partner - stop_begin(c, i) + 1;
        } else {
            i = next_link(w, i);
            k = 0;
            at = &c->link[i].from;
        }
        w->bend[w->bends++] = (bend){*at, i};
    }
}

/* Takes the bends from `start` on as a ring, which has the set on its left or, for an erosion, on its right. Returns
 * false if out of memory. */
static bool add_ring(walker *w, uint32_t start)
{
    sunder_i_figure_convolution *c = w->curve;
    const uint32_t end = w->bends;
    uint32_t least = start;
    for (uint32_t v = start + 1; v < end; v++)
        if (sunder_i_curve_cmp(c, &w->bend[v].at, &w->bend[least].at) < 0) least = v;
    if (!sunder_i_arena_reserve(&c->memory, &w->ring, &w->rings_capacity, w->rings + 1, sizeof *w->ring) ||
        !sunder_i_arena_reserve(&c->memory, &w->least, &w->least_capacity, w->rings + 1, sizeof *w->least))
        return false;
    const uint32_t before = (least > start ? least : end) - 1;
    const sunder_i_i128 turn =
        sunder_i_plain_cross(c->link[w->bend[before].leaves].along, c->link[w->bend[least].leaves].along);
    w->least[w->rings] = least;
    w->ring[w->rings++] = (sunder_i_found_ring){start, end, 0, (turn > 0) != c->erode};
    return sunder_i_steps(end - start);
}

static bool follow_all(walker *w)
{
    const sunder_i_figure_convolution *c = w->curve;
    for (uint32_t i = 0; i < c->links; i++)
        for (uint32_t k = 0; k <= c->stop_end[i] - stop_begin(c, i); k++) {
            const uint32_t piece = stop_begin(c, i) + i + k, start = w->bends;
            if (w->right[piece] != 0 || w->done[piece]) continue;
            follow_boundary(w, i, k);
            if (w->tame && !add_ring(w, start)) return false;
        }
    return true;
}

/* ---- Holes and components ---- */

typedef struct holder {
    walker *w;
    sunder_i_strips strips; /* the sides that leave each bend, of all rings */
    uint32_t *ring_of;      /* [bends] the ring of each bend */
    bool *odd;              /* [rings] whether an odd number of its sides is on the left of the point */
    uint32_t *met;          /* the rings with a side on the left of the point */
    size_t n;
} holder;

static uint32_t next_bend(const sunder_i_found_ring *r, uint32_t v)
{
    return v + 1 < r->end ? v + 1 : (uint32_t)r->start;
}

/* Counts the parity of the sides of each outer ring on the left of the point. */
static void look_left(holder *h, const sunder_i_curve_corner *at)
{
    walker *w = h->w;
    size_t from, to;
    h->n = 0;
    sunder_i_strips_at(&h->strips, at->xy[1], &from, &to);
    for (; from < to; from++) {
        const uint32_t v = h->strips.item[from], r = h->ring_of[v];
        if (!w->ring[r].outer || !passes_left(w->curve, &w->bend[v].at, &w->bend[next_bend(&w->ring[r], v)].at, at))
            continue;
        h->odd[r] = !h->odd[r];
        h->met[h->n++] = r;
    }
}

/* Assigns a hole to the component of the innermost outer ring around it: that of the rings around it with the greatest
 * smallest vertex. */
static void place_hole(holder *h, size_t hole)
{
    walker *w = h->w;
    size_t best = w->rings;
    look_left(h, &w->bend[w->least[hole]].at);
    for (size_t i = 0; i < h->n; i++) {
        const uint32_t r = h->met[i];
        if (!h->odd[r]) continue;
        h->odd[r] = false;
        if (best == w->rings || sunder_i_curve_cmp(w->curve, &w->bend[w->least[r]].at, &w->bend[w->least[best]].at) > 0)
            best = r;
    }
    if (best == w->rings)
        w->tame = false;
    else
        w->ring[hole].component = w->ring[best].component;
}

static bool holder_init(holder *h)
{
    walker *w = h->w;
    sunder_i_arena *m = &w->curve->memory;
    double(*span)[2] = sunder_i_alloc(w->bends, sizeof *span);
    h->ring_of = sunder_i_arena_alloc(m, w->bends, sizeof *h->ring_of);
    h->odd = sunder_i_arena_alloc(m, w->rings, sizeof *h->odd);
    h->met = sunder_i_arena_alloc(m, w->bends, sizeof *h->met);
    bool ok = span && !m->failed;
    for (uint32_t r = 0; ok && r < w->rings; r++) {
        h->odd[r] = false;
        for (uint32_t v = (uint32_t)w->ring[r].start; v < w->ring[r].end; v++) {
            h->ring_of[v] = r;
            span[v][0] = w->bend[v].at.xy[1];
            span[v][1] = w->bend[next_bend(&w->ring[r], v)].at.xy[1];
        }
    }
    ok = ok && build_strips(&h->strips, span, w->bends, w->curve->error);
    sunder_i_free(span);
    return ok;
}

/* Assigns all rings to components. Returns false if out of memory. */
static bool find_components(walker *w)
{
    holder h = {.w = w};
    for (size_t r = 0; r < w->rings; r++)
        if (w->ring[r].outer) w->ring[r].component = w->components++;
    if (w->components == 1 || w->components == w->rings) return true;
    bool ok = holder_init(&h);
    for (size_t r = 0; ok && r < w->rings; r++) {
        if (w->ring[r].outer) continue;
        place_hole(&h, r);
        ok = sunder_i_step();
    }
    sunder_i_strips_free(&h.strips);
    return ok;
}

/* ---- All of it ---- */

/* Copies the rings, from the smallest vertex on and with the set on the left, to the sum. Returns false if out of
 * memory. */
static bool fill_sum(const walker *w, sunder_sum *sum)
{
    uint32_t *order = sunder_i_alloc(w->bends, sizeof *order);
    sum->vertex = sunder_i_alloc(w->bends, sizeof *sum->vertex);
    if (order && sum->vertex) {
        for (uint32_t v = 0; v < w->bends; v++) sum->vertex[v] = sunder_i_hpoint_make(&sum->lattice, w->bend[v].at.at);
        sum->vertices = w->bends;
        for (size_t r = 0; r < w->rings; r++) {
            const uint32_t first = (uint32_t)w->ring[r].start, end = (uint32_t)w->ring[r].end;
            for (uint32_t k = first, v = w->least[r]; k < end; k++) {
                order[k] = v;
                v = w->curve->erode ? (v > first ? v : end) - 1 : v + 1 < end ? v + 1 : first;
            }
        }
    }
    sunder_i_found found = {.vertex = order,
                            .ring = w->ring,
                            .rings = w->rings,
                            .components = w->components,
                            .compare = sunder_i_sum_vertex_cmp,
                            .context = sum,
                            .place = sum->vertex};
    const bool ok = order && sum->vertex && !sum->lattice.arena.failed && sunder_i_canonical(&found, sum);
    sunder_i_free(order);
    return ok;
}

static bool walk_curve(sunder_i_figure_convolution *c, sunder_sum *sum, bool *done)
{
    const size_t pieces = c->links + c->stops;
    walker w = {.curve = c,
                .right = sunder_i_arena_alloc(&c->memory, pieces, sizeof *w.right),
                .done = sunder_i_arena_alloc(&c->memory, pieces, sizeof *w.done),
                .tame = true,
                .bend = sunder_i_arena_alloc(&c->memory, pieces, sizeof *w.bend)};
    if (c->memory.failed) return false;
    memset(w.done, 0, pieces * sizeof *w.done);
    bool ok = number_all(&w);
    if (ok && w.tame) ok = follow_all(&w);
    if (ok && w.tame) ok = find_components(&w);
    ok = ok && !c->memory.failed && !c->scratch.failed;
    *done = ok && w.tame;
    return *done ? fill_sum(&w, sum) : ok;
}

sunder_status sunder_i_sum_by_convolution(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                          bool erode, sunder_sum *sum, bool *done, sunder_error *err)
{
    *done = false;
    if (element->pieces != 1 || !element->plain || figure->touches || figure->segments || figure->points ||
        figure->sides == 0 || figure->sides > UINT32_MAX / 4)
        return SUNDER_OK;
    sunder_i_figure_convolution c = {
        .figure = figure, .element = element, .erode = erode, .shift = -(long)sum->lattice.approx_shift};
    bool fits;
    sunder_status status = sunder_i_figure_convolution_build(&c, &fits, err);
    if (status == SUNDER_OK && fits) status = sunder_i_figure_convolution_cross(&c, &fits, err);
    if (status == SUNDER_OK && fits) status = sunder_i_figure_convolution_places(&c, &fits, err);
    if (status == SUNDER_OK && fits && !walk_curve(&c, sum, done)) status = sunder_i_failure_cause(err);
    sum->lattice.counts.comparisons += c.counts.comparisons;
    sum->lattice.counts.orientation_tests += c.counts.orientation_tests;
    sum->lattice.counts.segment_intersections += c.counts.segment_intersections;
    sum->lattice.counts.exact_fallbacks += c.counts.exact_fallbacks;
    sunder_i_arena_free(&c.memory);
    sunder_i_arena_free(&c.scratch);
    SUNDER_I_ASSERT(status != SUNDER_OK || !*done || !sunder_i_canonical_check(sum));
    return status;
}
