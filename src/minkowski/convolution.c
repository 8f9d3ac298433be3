/* convolution.c: a polygon P, with or without holes, plus one convex polygon Q, computed by following one closed curve
 * along P, without a decomposition or an arrangement of many subsums. Most buildings and map symbols have such sums.
 * Several of them can be united in one computation, each as a *round*.
 *
 * The convolution [GRS83] of P's rings with Q consists of one closed curve for each ring: every side of P translated by
 * the corner of Q that is extreme in the side's outward direction; at a convex vertex v two such sides are joined by
 * the arc of v + Q between the two corners, at a reflex one by that arc in the opposite direction. The winding number
 * of the curves at x is the Euler characteristic of the intersection of P and x - Q: the number of its components minus
 * the number of holes of P that are inside x - Q. Here
 *
 *   - holes of P into which Q's box does not fit are omitted, which changes nothing, and no other hole has a box that
 *     fits into Q's. So the winding number counts components: the interiors of P and x - Q meet exactly if it is
 *     positive, and it is never negative;
 *   - an arc in the opposite direction is replaced by its chord. This increases the winding number by one between arc
 *     and chord; that region is inside v + Q, where the number was positive already. So the set where it is positive
 *     remains the same.
 *
 * With several rounds the winding numbers are added. None is ever negative, so that the set where the sum is positive
 * is the union, and all statements here about one round hold for several.
 *
 * P may have a vertex that touches one of its edges from outside. (A vertex that touches from inside, or touches
 * another vertex, is twice in the curve, which is then declined.) If that vertex is moved off the edge by a small
 * amount, the ring becomes simple, its curve changes by the same small amount, and the ring bounds a subset of P that
 * tends to all of P's interior. Tame curves remain tame under small changes, and no part of them vanishes in the limit.
 *
 * The curve is *tame* if two links meet only in these ways: consecutive links at their common end, and pairs that cross
 * in their relative interiors, with no third link through that point. The curve is then traversed while the winding
 * number on its right side is updated. That number changes only where another link crosses, by one; the pieces of links
 * with 0 on their right are the boundary of the sum.
 *
 * Then there are no degenerate holes. A degenerate hole would be on the curve. It cannot be on a chord, ends included:
 * there x - Q has the reflex vertex v on its boundary or in its interior, and so meets the interior of P. Beside a
 * translated side or an arc the number is positive on both sides, so that on the right there is a component other than
 * the one that the contact of this link creates and removes. That component also exists on the link itself, since it
 * could vanish only where another link passes. At a crossing the same argument holds for the quarter to the right of
 * both links.
 *
 * Rings of the result: no point belongs to two boundary pieces, except a vertex where one continues the other, so that
 * the rings are simple and disjoint. An outer ring turns left at its smallest vertex; a round has one outer ring, since
 * P and Q are connected. Collinear vertices cannot arise: parallel sides of P and Q are joined. All tests are exact and
 * need a narrow lattice; on other lattices, and if the curve is not tame, the general method is used (minkowski.c). */
#include "minkowski/convolution.h"

#include "base/watch.h"
#include "minkowski/convolution_inner.h"

#include <stdalign.h>
#include <string.h>

typedef struct box {
    sunder_i_point low, high;
} box;

/* The state of the traversal. A piece of a link is the part between two stops, or between a stop and an end. The pieces
 * of link i have the numbers from stop_begin(i) + i on; there is one more of them than stops. */
typedef struct walker {
    const sunder_i_convolution *curve;
    int32_t *right; /* [pieces] the winding number on the right side */
    bool *done;     /* [pieces] whether the piece is in a ring of the result already */
    bool tame;      /* false: a contradiction to the assumption that the curve is tame was found */
    box *reach;     /* [rings] the bounding boxes of the curve's rings */
    sunder_i_traced *to;
    uint32_t first;   /* the first vertex of the sum that belongs to this curve's rings */
    uint32_t *leaves; /* [vertices of these rings] the link on which the ring continues */
} walker;

static uint32_t stop_begin(const sunder_i_convolution *c, uint32_t link) { return link ? c->stop_end[link - 1] : 0; }

/* ---- Winding numbers ---- */

static uint32_t smallest_corner(const sunder_i_convolution *c, uint32_t begin, uint32_t end)
{
    uint32_t least = begin;
    for (uint32_t i = begin + 1; i < end; i++) {
        const sunder_i_point a = c->corner[i], b = c->corner[least];
        if (a.x < b.x || (a.x == b.x && a.y < b.y)) least = i;
    }
    return least;
}

static box box_of(const sunder_i_convolution *c, uint32_t begin, uint32_t end)
{
    box b = {c->corner[begin], c->corner[begin]};
    for (uint32_t i = begin + 1; i < end; i++) {
        const sunder_i_point a = c->corner[i];
        if (a.x < b.low.x) b.low.x = a.x;
        if (a.y < b.low.y) b.low.y = a.y;
        if (a.x > b.high.x) b.high.x = a.x;
        if (a.y > b.high.y) b.high.y = a.y;
    }
    return b;
}

/* Returns the winding number, at a point that is on no link, of the closed curve of the links [begin, end). It counts
 * the links that cross the ray from the point to the left. */
static int32_t winding_of(const sunder_i_convolution *c, sunder_i_point at, uint32_t begin, uint32_t end)
{
    int32_t winding = 0;
    for (uint32_t i = begin; i < end; i++) {
        const sunder_i_point a = c->corner[i], b = c->corner[c->next[i]];
        if ((a.y > at.y) == (b.y > at.y)) continue;
        const bool up = b.y > at.y;
        const sunder_i_det side = sunder_i_narrow_orient(a, b, at);
        if (up ? side < 0 : side > 0) winding += up ? -1 : 1; /* the link passes to the left of the point */
    }
    return winding;
}

/* Returns the winding number, at the point `at`, of all rings except `ring`; only rings whose boxes contain the point
 * count. */
static int32_t winding_of_others(const walker *w, sunder_i_point at, uint32_t ring)
{
    const sunder_i_convolution *c = w->curve;
    int32_t winding = 0;
    for (uint32_t r = 0; r < c->rings; r++) {
        const box *b = &w->reach[r];
        if (r == ring || c->left_out[r] || at.x < b->low.x || at.x > b->high.x || at.y < b->low.y || at.y > b->high.y)
            continue;
        winding += winding_of(c, at, sunder_i_convolution_first(c, r), c->ring_end[r]);
    }
    return winding;
}

/* Returns the winding number on the right of the link that leaves the ring's smallest corner, `least`. There the
 * outside of the ring is to the left of the corner: a left turn has the outside on its right side; a right turn has it
 * on its left, so that the ring itself counts -1 on the right. */
static int32_t number_at(const walker *w, uint32_t least, uint32_t ring)
{
    const sunder_i_convolution *c = w->curve;
    const uint32_t last = least > sunder_i_convolution_first(c, ring) ? least - 1 : c->ring_end[ring] - 1;
    const int32_t others = c->rings > 1 ? winding_of_others(w, c->corner[least], ring) : 0;
    return others - (sunder_i_narrow_orient(c->corner[last], c->corner[least], c->corner[c->next[least]]) < 0);
}

static void number_ring(walker *w, uint32_t ring)
{
    const sunder_i_convolution *c = w->curve;
    const uint32_t least = smallest_corner(c, sunder_i_convolution_first(c, ring), c->ring_end[ring]);
    const int32_t start = number_at(w, least, ring);
    int32_t right = start;
    uint32_t i = least;
    do {
        uint32_t piece = stop_begin(c, i) + i;
        for (uint32_t s = stop_begin(c, i); s < c->stop_end[i]; s++) {
            w->right[piece++] = right;
            right += c->stop[s].rises ? 1 : -1;
        }
        w->right[piece] = right;
        if (right < 0 || (right == 0 && c->chord[i])) w->tame = false;
        i = c->next[i];
    } while (i != least);
    if (right != start) w->tame = false;
}

/* ---- Rings ---- */

/* Adds a vertex to the sum; `leaves` is the link on which its ring continues. Returns false if out of memory. */
static bool add_vertex(walker *w, sunder_i_hpoint at, uint32_t leaves)
{
    sunder_i_traced *t = w->to;
    sunder_sum *sum = t->sum;
    if (sum->vertices == t->room && !sunder_i_reserve(&sum->vertex, &t->room, (size_t)sum->vertices + 1, sizeof at))
        return false;
    w->leaves[sum->vertices - w->first] = leaves;
    sum->vertex[sum->vertices++] = at;
    return true;
}

/* Follows the boundary from piece k of link i until it closes: at a crossing it continues on the other link, which
 * comes from the left and has the free side on its right as well. Returns false if out of memory. */
static bool follow_boundary(walker *w, uint32_t i, uint32_t k)
{
    const sunder_i_convolution *c = w->curve;
    for (;;) {
        const uint32_t piece = stop_begin(c, i) + i + k, s = stop_begin(c, i) + k;
        if (w->done[piece]) return true;
        if (w->right[piece] != 0) w->tame = false;
        w->done[piece] = true;
        sunder_i_hpoint at;
        if (s < c->stop_end[i]) {
            const sunder_i_stop *stop = &c->stop[s];
            at = sunder_i_hpoint_at(c->lattice, c->corner[i], c->corner[c->next[i]], &stop->at);
            i = c->stop[stop->partner].link;
            k = stop->partner - stop_begin(c, i) + 1;
        } else {
            i = c->next[i];
            k = 0;
            at = sunder_i_hpoint_of(c->lattice, c->corner[i]);
        }
        if (!add_vertex(w, at, i)) return false;
    }
}

static sunder_i_point vector_of_link(const walker *w, uint32_t vertex)
{
    const sunder_i_convolution *c = w->curve;
    const uint32_t link = w->leaves[vertex - w->first];
    return sunder_i_narrow_sub(c->corner[c->next[link]], c->corner[link]);
}

/* Makes a ring of the vertices of the sum from number `start` on. Returns false if out of memory. */
static bool add_ring(walker *w, uint32_t start)
{
    sunder_i_traced *t = w->to;
    sunder_sum *sum = t->sum;
    const uint32_t end = sum->vertices;
    uint32_t least = start;
    for (uint32_t v = start + 1; v < end; v++)
        if (sunder_i_hpoint_cmp(&sum->lattice, &sum->vertex[v], &sum->vertex[least]) < 0) least = v;
    if (!sunder_i_reserve(&t->ring, &t->ring_room, t->rings + 1, sizeof *t->ring) ||
        !sunder_i_reserve(&t->vertex, &t->vertex_room, end, sizeof *t->vertex))
        return false;
    const sunder_i_det bend =
        sunder_i_narrow_cross(vector_of_link(w, least > start ? least - 1 : end - 1), vector_of_link(w, least));
    t->ring[t->rings++] = (sunder_i_found_ring){start, end, t->components, bend > 0};
    for (uint32_t v = start, k = least; v < end; v++, k = k + 1 < end ? k + 1 : start) t->vertex[v] = k;
    return true;
}

static bool follow_all(walker *w)
{
    const sunder_i_convolution *c = w->curve;
    sunder_sum *sum = w->to->sum;
    for (uint32_t i = 0; i < c->links; i++)
        for (uint32_t k = 0; k <= c->stop_end[i] - stop_begin(c, i); k++) {
            const uint32_t piece = stop_begin(c, i) + i + k, start = sum->vertices;
            if (w->right[piece] != 0 || w->done[piece]) continue;
            if (!follow_boundary(w, i, k) || (w->tame && !add_ring(w, start))) return false;
        }
    return true;
}

/* ---- Components of the holes ---- */

/* Returns true if ring r contains the position of a vertex of another ring. Then an odd number of the sides of r is to
 * the left of that vertex. */
static bool ring_holds(const walker *w, const sunder_i_found_ring *r, uint32_t vertex)
{
    const sunder_i_convolution *c = w->curve;
    const sunder_sum *sum = w->to->sum;
    const sunder_i_hpoint *place = &sum->vertex[vertex];
    const uint32_t first = (uint32_t)r->start, end = (uint32_t)r->end;
    bool above = sunder_i_hpoint_cmp_y(c->lattice, &sum->vertex[end - 1], place) > 0, odd = false;
    for (uint32_t v = first; v < end; v++) {
        const bool to_above = sunder_i_hpoint_cmp_y(c->lattice, &sum->vertex[v], place) > 0;
        if (above != to_above) {
            const uint32_t link = w->leaves[(v > first ? v - 1 : end - 1) - w->first];
            const int side = sunder_i_orient_hpoint(c->lattice, c->corner[link], c->corner[c->next[link]], place);
            odd ^= to_above ? side < 0 : side > 0;
        }
        above = to_above;
    }
    return odd;
}

/* Numbers the components: each outer ring begins one; a hole belongs to that of the innermost outer ring around it,
 * which is the one with the greatest smallest vertex. */
static void find_components(walker *w, size_t first_ring)
{
    sunder_i_traced *t = w->to;
    const uint32_t before = t->components;
    for (size_t r = first_ring; r < t->rings; r++)
        if (t->ring[r].outer) t->ring[r].component = t->components++;
    if (t->components == before + 1) return;
    for (size_t r = first_ring; r < t->rings; r++) {
        if (t->ring[r].outer) continue;
        if (!sunder_i_steps(t->rings - first_ring)) w->tame = false; /* cancelled: the next allocation fails */
        size_t best = t->rings;
        for (size_t o = first_ring; o < t->rings; o++)
            if (t->ring[o].outer && ring_holds(w, &t->ring[o], t->vertex[t->ring[r].start]) &&
                (best == t->rings ||
                 sunder_i_sum_vertex_cmp(t->sum, t->vertex[t->ring[o].start], t->vertex[t->ring[best].start]) > 0))
                best = o;
        if (best == t->rings)
            w->tame = false;
        else
            t->ring[r].component = t->ring[best].component;
    }
}

/* ---- The whole computation ---- */

static bool walk_curve(sunder_i_convolution *c, sunder_i_traced *to, bool *done)
{
    const size_t pieces = c->links + c->stops, most = c->links + c->stops / 2, rings = to->rings;
    const uint32_t vertices = to->sum->vertices, components = to->components;
    walker w = {.curve = c,
                .right = sunder_i_arena_alloc(&c->memory, pieces, sizeof *w.right),
                .done = sunder_i_arena_alloc(&c->memory, pieces, sizeof *w.done),
                .tame = true,
                .reach = sunder_i_arena_alloc(&c->memory, c->rings, sizeof *w.reach),
                .to = to,
                .first = vertices,
                .leaves = sunder_i_arena_alloc(&c->memory, pieces, sizeof *w.leaves)};
    if (c->memory.failed || !sunder_i_reserve(&to->sum->vertex, &to->room, vertices + most, sizeof *to->sum->vertex))
        return false;
    memset(w.done, 0, pieces * sizeof *w.done);
    for (uint32_t r = 0; r < c->rings && c->rings > 1; r++)
        if (!c->left_out[r]) w.reach[r] = box_of(c, sunder_i_convolution_first(c, r), c->ring_end[r]);
    for (uint32_t r = 0; r < c->rings; r++)
        if (!c->left_out[r]) number_ring(&w, r);
    const bool ok = !w.tame || follow_all(&w);
    if (ok && w.tame) find_components(&w, rings);
    *done = ok && w.tame;
    if (*done) return true;
    to->sum->vertices = vertices;
    to->rings = rings;
    to->components = components;
    return ok;
}

static sunder_status trace_curve(sunder_i_convolution *c, sunder_i_traced *to, bool *done, sunder_error *err)
{
    bool fits;
    sunder_status status = sunder_i_convolution_build(c, &fits, err);
    if (status == SUNDER_OK && fits) status = sunder_i_convolution_cross(c, &fits, err);
    if (status != SUNDER_OK || !fits) return status;
    return walk_curve(c, to, done) ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* The size of the stack memory, enough for a building and a disc. */
enum { LENT = 16384 };

sunder_status sunder_i_convolution_trace(sunder_i_traced *to, const sunder_i_round *round, size_t rounds, bool *done,
                                         sunder_error *err)
{
    sunder_i_convolution c = {.lattice = &to->sum->lattice, .round = round, .rounds = rounds};
    alignas(16) char lent[LENT];
    *done = false;
    sunder_i_arena_init_on(&c.memory, lent, sizeof lent);
    const sunder_status status = trace_curve(&c, to, done, err);
    sunder_i_arena_free(&c.memory);
    return status;
}

sunder_status sunder_i_traced_end(sunder_i_traced *traced, bool keep, sunder_error *err)
{
    sunder_sum *sum = traced->sum;
    sunder_i_found found = {.vertex = traced->vertex,
                            .ring = traced->ring,
                            .rings = traced->rings,
                            .components = traced->components,
                            .compare = sunder_i_sum_vertex_cmp,
                            .context = sum,
                            .place = sum->vertex};
    const bool ok = !keep || sunder_i_canonical(&found, sum);
    sunder_i_free_all(traced->vertex, traced->ring);
    if (keep && ok) return SUNDER_OK;
    sunder_i_free(sum->vertex);
    sum->vertex = NULL;
    sum->vertices = 0;
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_convolution_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                       const sunder_shape *q, const sunder_i_point *at_q, bool *done, sunder_error *err)
{
    *done = false;
    if (!sum->lattice.narrow || p->form->cleaned.polygons != 1 || p->form->cleaned.rings > SUNDER_I_MOST_CURVES ||
        q->pieces != 1)
        return SUNDER_OK;
    const sunder_i_round round = {p, q, at_p, at_q, 0, 0};
    sunder_i_traced traced = {.sum = sum};
    const sunder_status status = sunder_i_convolution_trace(&traced, &round, 1, done, err);
    const sunder_status end = sunder_i_traced_end(&traced, *done, err);
    *done &= end == SUNDER_OK;
    return status == SUNDER_OK ? end : status;
}
