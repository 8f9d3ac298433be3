/* bisector.c: the angle-bisector decomposition after Chazelle and Dobkin [CD85], in the variant that is called
 * small-side and slightly improved in [AFH00, AFH02]: pairs of reflex vertices first, the others one by one.
 *
 * A direction d resolves a reflex vertex, whose sector opens counterclockwise by more than pi from `low` to `high`, if
 * neither of the two angles into which d divides the sector is more than pi: if d is in the closed cone from -high to
 * -low. One cut in that cone is sufficient, and a vertex that was resolved by the end of another cut needs none. So
 * there are at most r + 1 - h pieces for r reflex vertices and h holes.
 *
 * 1. Two reflex vertices that see each other, each in the other's cone, are resolved by one cut. Of all such pairs
 * those come first that have few reflex vertices on their smaller side (none, if they join two rings): they leave the
 * other pairs intact. A pair is used if neither of its vertices is resolved yet and it crosses no cut.
 *
 * 2. Each other reflex vertex, in order, is joined to a vertex that it sees in its cone and that no cut hides: reflex
 * ones are preferred, then the one nearest to the bisector. This needs no Steiner point. If there is none, a cut
 * extends near the bisector (direction.c) to the first element that it meets: an edge, a vertex (even if the cut only
 * grazes it), another cut.
 *
 * Every cut is on a line through a vertex in a lattice direction, so that its end is the intersection of two such
 * lines: numerator and denominator have degree 2, or, for directions of direction.c with their 20 bits, little more
 * than 1. Intersections on one line are compared in degree 4. A cut never passes through a vertex; one that would meet
 * another cut exactly at its end meets the line on which the other one ends at the same point. The time depends on the
 * number of vertices that reflex vertices see, and on r^2 for the cuts.
 *
 * Doubles select among alternatives that are all exactly possible (which vertex is nearest to the bisector): they
 * decide nothing else. */
#include "base/extremes.h"
#include "base/sort.h"
#include "base/watch.h"
#include "decomposition/maker.h"

#include <string.h>

typedef struct reflex_pair {
    uint32_t a, b;
    uint32_t small_side;
} reflex_pair;

typedef struct bisector {
    sunder_i_maker *m;
    const sunder_i_member *part;
    sunder_i_ray_shooting rays;
    sunder_i_cut *cut;
    double (*box)[4]; /* [cuts] the boxes of the cuts, see box_of_cut() */
    uint32_t cuts;
    uint32_t *ring_of;     /* [n] the ring of each vertex */
    uint32_t *rank;        /* [n + 1] the number of reflex vertices before vertex first + i */
    bool *reflex, *paired; /* [n]; paired: whether the vertex was resolved in the first step */
    uint32_t *first_end;   /* [n] the head of the list of cut ends at a vertex: 2 * cut + (1 if the cut ends there), or
                         * SUNDER_I_NONE */
    uint32_t *next_end;    /* [2 * cuts] the next element of that list */
    reflex_pair *pair;
    uint32_t pairs;
    size_t pair_room;
} bisector;

/* The part of a vertex's sector that opens by more than pi. */
typedef struct sector {
    sunder_i_point low, high;
} sector;

static sunder_i_point to_vertex(const bisector *b, uint32_t v, uint32_t w)
{
    const sunder_i_rings *r = &b->m->rings;
    return sunder_i_point_sub(b->m->lattice, r->at[w], r->at[v]);
}

/* Narrows the sector of v, at each cut that starts or ends at v, to the side that is reflex. Stores the rest in *s.
 * Returns false if no side is reflex. */
static bool reflex_part(const bisector *b, uint32_t v, sector *s)
{
    sunder_i_lattice *l = b->m->lattice;
    const sunder_i_rings *r = &b->m->rings;
    s->low = to_vertex(b, v, r->next[v]);
    s->high = to_vertex(b, v, r->prev[v]);
    for (uint32_t e = b->first_end[v - b->part->first]; e != SUNDER_I_NONE; e = b->next_end[e]) {
        sunder_i_point d = b->cut[e / 2].along;
        if (e & 1) d = sunder_i_point_neg(l, d);
        if (sunder_i_around(l, s->low, d, s->high) >= 0) continue; /* outside the rest of the sector */
        if (sunder_i_cross_sign(l, s->low, d) < 0)
            s->high = d;
        else if (sunder_i_cross_sign(l, d, s->high) < 0)
            s->low = d;
        else
            return false;
    }
    return true;
}

/* Returns true if d is in the cone that resolves the sector. */
static bool resolves_sector(sunder_i_lattice *l, const sector *s, sunder_i_point d)
{
    return sunder_i_cross_sign(l, s->low, d) >= 0 && sunder_i_cross_sign(l, d, s->high) >= 0;
}

/* ---- Cuts and visibility ---- */

/* *box becomes a box around vertex v and vertex w, the edge that leaves w, or cut w, depending on `end`. Its bounds are
 * rounded coordinates, and rounding is monotone: objects in disjoint boxes are disjoint. A Steiner point is in the box
 * of the edge or cut that contains it. */
static void box_of_cut(const bisector *b, uint32_t v, sunder_i_cut_end end, uint32_t w, double box[4])
{
    const sunder_i_rings *r = &b->m->rings;
    double other[4];
    if (end == SUNDER_I_ON_CUT)
        memcpy(other, b->box[w], sizeof other);
    else
        for (int k = 0; k < 2; k++) {
            const double at = r->xy[2 * (size_t)w + (size_t)k];
            const double to = end == SUNDER_I_ON_EDGE ? r->xy[2 * (size_t)r->next[w] + (size_t)k] : at;
            other[k] = sunder_i_min(at, to);
            other[k + 2] = sunder_i_max(at, to);
        }
    for (int k = 0; k < 2; k++) {
        const double at = r->xy[2 * (size_t)v + (size_t)k];
        box[k] = sunder_i_min(at, other[k]);
        box[k + 2] = sunder_i_max(at, other[k + 2]);
    }
}

/* Returns true if the ray from v along d (through `toward`) crosses cut k in the interior of that cut; *t becomes the
 * position on the ray. */
static bool meets_cut(const bisector *b, uint32_t v, sunder_i_point toward, sunder_i_point d, uint32_t k,
                      sunder_i_fraction *t)
{
    sunder_i_lattice *l = b->m->lattice;
    const sunder_i_rings *r = &b->m->rings;
    const sunder_i_cut *c = &b->cut[k];
    const sunder_i_point from = r->at[v], other = r->at[c->from];
    const int side = sunder_i_orient(l, from, toward, other);
    /* The cut must start on one side of the ray's line and lead to the other. */
    if (side == 0 || side * sunder_i_cross_sign(l, d, c->along) >= 0) return false;
    const sunder_i_fraction on = sunder_i_crossing(l, other, c->toward, from, toward);
    if (sunder_i_fraction_cmp(l, &on, &c->length) >= 0) return false;
    *t = sunder_i_crossing(l, from, toward, other, c->toward);
    return sunder_i_fraction_sign(l, t) > 0;
}

/* Returns true if a cut crosses the segment from v to the vertex w. */
static bool is_hidden(const bisector *b, uint32_t v, uint32_t w)
{
    sunder_i_lattice *l = b->m->lattice;
    const sunder_i_point d = to_vertex(b, v, w);
    const sunder_i_fraction one = sunder_i_fraction_int(l, 1);
    sunder_i_fraction t;
    double box[4];
    box_of_cut(b, v, SUNDER_I_AT_VERTEX, w, box);
    for (uint32_t k = 0; k < b->cuts; k++)
        if (sunder_i_box_meet(box, b->box[k]) && meets_cut(b, v, b->m->rings.at[w], d, k, &t) &&
            sunder_i_fraction_cmp(l, &t, &one) < 0)
            return true;
    return false;
}

static void add_end(bisector *b, uint32_t v, uint32_t e)
{
    uint32_t *head = &b->first_end[v - b->part->first];
    b->next_end[e] = *head;
    *head = e;
}

static void add_cut(bisector *b, const sunder_i_cut *cut)
{
    const uint32_t k = b->cuts++;
    b->cut[k] = *cut;
    box_of_cut(b, cut->from, cut->end, cut->at, b->box[k]);
    add_end(b, cut->from, 2 * k);
    if (cut->end == SUNDER_I_AT_VERTEX) add_end(b, cut->at, 2 * k + 1);
}

static void join_vertices(bisector *b, uint32_t v, uint32_t w)
{
    const sunder_i_cut cut = {.from = v,
                              .toward = b->m->rings.at[w],
                              .along = to_vertex(b, v, w),
                              .end = SUNDER_I_AT_VERTEX,
                              .at = w,
                              .length = sunder_i_fraction_int(b->m->lattice, 1)};
    add_cut(b, &cut);
}

/* ---- First step ---- */

static uint32_t small_side(const bisector *b, uint32_t v, uint32_t w)
{
    const sunder_i_rings *r = &b->m->rings;
    const uint32_t first = b->part->first, ring = b->ring_of[v - first];
    if (ring != b->ring_of[w - first]) return 0;
    const uint32_t lo = (ring ? r->ring_end[ring - 1] : 0) - first, hi = r->ring_end[ring] - first;
    const uint32_t between = b->rank[w - first] - b->rank[v - first + 1];
    const uint32_t rest = b->rank[hi] - b->rank[lo] - 2 - between;
    return between < rest ? between : rest;
}

/* Lists the vertices that v sees in the cone that resolves *s, in b->rays.seen. Returns false if out of memory. */
static bool look_in_cone(bisector *b, uint32_t v, const sector *s)
{
    const sunder_i_point cone[2] = {s->low, s->high};
    return sunder_i_ray_shooting_visible(&b->rays, v, cone);
}

static bool find_pairs(bisector *b)
{
    sunder_i_lattice *l = b->m->lattice;
    const uint32_t first = b->part->first;
    for (uint32_t v = first; v < first + b->part->n; v++) {
        sector s, t;
        if (!sunder_i_step()) return false;
        if (!b->reflex[v - first] || !reflex_part(b, v, &s)) continue;
        if (!look_in_cone(b, v, &s)) return false;
        for (uint32_t i = 0; i < b->rays.seen_n; i++) {
            const uint32_t w = b->rays.seen[i];
            if (!sunder_i_step()) return false;
            if (w < v || !b->reflex[w - first] || !resolves_sector(l, &s, to_vertex(b, v, w))) continue;
            if (!reflex_part(b, w, &t) || !resolves_sector(l, &t, to_vertex(b, w, v))) continue;
            if (!sunder_i_reserve(&b->pair, &b->pair_room, (size_t)b->pairs + 1, sizeof *b->pair)) return false;
            b->pair[b->pairs++] = (reflex_pair){v, w, small_side(b, v, w)};
        }
    }
    return true;
}

static int smaller_first(void *context, uint32_t i, uint32_t j)
{
    const bisector *b = context;
    const reflex_pair *p = &b->pair[i], *q = &b->pair[j];
    if (p->small_side != q->small_side) return p->small_side < q->small_side ? -1 : 1;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return (p->b > q->b) - (p->b < q->b);
}

static bool join_pairs(bisector *b)
{
    if (!find_pairs(b)) return false;
    uint32_t *order = sunder_i_alloc(b->pairs, sizeof *order);
    if (!order) return false;
    for (uint32_t i = 0; i < b->pairs; i++) order[i] = i;
    const bool ok = sunder_i_sort_indices(order, b->pairs, smaller_first, b);
    for (uint32_t i = 0; ok && i < b->pairs; i++) {
        const reflex_pair *p = &b->pair[order[i]];
        bool *one = &b->paired[p->a - b->part->first], *other = &b->paired[p->b - b->part->first];
        if (*one || *other || is_hidden(b, p->a, p->b)) continue;
        join_vertices(b, p->a, p->b);
        *one = *other = true;
    }
    sunder_i_free(order);
    return ok;
}

/* ---- Second step ---- */

/* Returns the vertex to which v is joined, one of those in b->rays.seen, or SUNDER_I_NONE. */
static uint32_t choose_vertex(bisector *b, uint32_t v, const sector *s)
{
    sunder_i_lattice *l = b->m->lattice;
    double low[2], high[2], unit[2];
    long exponent;
    sunder_i_direction_unit(l, s->low, low, &exponent);
    sunder_i_direction_unit(l, s->high, high, &exponent);
    const double middle[2] = {-low[0] - high[0], -low[1] - high[1]};
    uint32_t best = SUNDER_I_NONE;
    bool best_reflex = false;
    double best_fit = 0;
    for (uint32_t i = 0; i < b->rays.seen_n; i++) {
        const uint32_t w = b->rays.seen[i];
        const sunder_i_point d = to_vertex(b, v, w);
        if (!resolves_sector(l, s, d)) continue;
        sunder_i_direction_unit(l, d, unit, &exponent);
        const bool reflex = b->reflex[w - b->part->first];
        /* the greatest value is nearest to the bisector */
        const double fit = unit[0] * middle[0] + unit[1] * middle[1];
        if (best != SUNDER_I_NONE && (reflex < best_reflex || (reflex == best_reflex && fit <= best_fit))) continue;
        if (is_hidden(b, v, w)) continue;
        best = w;
        best_reflex = reflex;
        best_fit = fit;
    }
    return best;
}

/* Sets the end of the cut: the nearest of the elements that its ray meets. Returns false if out of memory. */
static bool find_end(const bisector *b, sunder_i_cut *cut)
{
    sunder_i_lattice *l = b->m->lattice;
    const sunder_i_rings *r = &b->m->rings;
    const sunder_i_point from = r->at[cut->from];
    if (!sunder_i_cut_run(cut, &b->rays)) return false;
    double box[4];
    box_of_cut(b, cut->from, cut->end, cut->at, box);
    for (uint32_t k = 0; k < b->cuts; k++) {
        sunder_i_fraction t;
        if (!sunder_i_box_meet(box, b->box[k]) || !meets_cut(b, cut->from, cut->toward, cut->along, k, &t)) continue;
        if (sunder_i_fraction_cmp(l, &t, &cut->length) >= 0) continue;
        cut->end = SUNDER_I_ON_CUT;
        cut->at = k;
        cut->length = t;
        cut->on = sunder_i_crossing(l, r->at[b->cut[k].from], b->cut[k].toward, from, cut->toward);
    }
    return true;
}

static bool resolve_vertex(bisector *b, uint32_t v)
{
    sunder_i_lattice *l = b->m->lattice;
    sector s;
    if (!reflex_part(b, v, &s)) return true;
    if (!look_in_cone(b, v, &s)) return false;
    const uint32_t w = choose_vertex(b, v, &s);
    if (w != SUNDER_I_NONE) {
        join_vertices(b, v, w);
        return true;
    }
    sunder_i_cut cut = {.from = v};
    cut.along = sunder_i_direction_within(l, sunder_i_point_neg(l, s.high), sunder_i_point_neg(l, s.low));
    cut.toward = sunder_i_point_add(l, b->m->rings.at[v], cut.along);
    if (!find_end(b, &cut)) return false;
    add_cut(b, &cut);
    return true;
}

static bool make_room(bisector *b)
{
    sunder_i_arena *arena = &b->m->scratch;
    const size_t n = b->part->n, most = b->part->reflex;
    b->cut = sunder_i_arena_alloc(arena, most, sizeof *b->cut);
    b->box = sunder_i_arena_alloc(arena, most, sizeof *b->box);
    b->reflex = sunder_i_arena_alloc(arena, 2 * n, sizeof *b->reflex);
    b->ring_of = sunder_i_arena_alloc(arena, n, sizeof *b->ring_of);
    b->rank = sunder_i_arena_alloc(arena, n + 1, sizeof *b->rank);
    b->first_end = sunder_i_arena_alloc(arena, n, sizeof *b->first_end);
    b->next_end = sunder_i_arena_alloc(arena, 2 * most, sizeof *b->next_end);
    if (arena->failed) return false;
    b->paired = b->reflex + n;
    const sunder_i_rings *r = &b->m->rings;
    uint32_t ring = b->part->ring_lo;
    b->rank[0] = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (b->part->first + i == r->ring_end[ring]) ring++;
        b->ring_of[i] = ring;
        b->reflex[i] = sunder_i_is_reflex(r, b->part->first + i);
        b->paired[i] = false;
        b->rank[i + 1] = b->rank[i] + b->reflex[i];
        b->first_end[i] = SUNDER_I_NONE;
    }
    return true;
}

void sunder_i_make_bisector(sunder_i_maker *m, const sunder_i_member *member)
{
    bisector b = {.m = m, .part = member};
    if (!make_room(&b) || !sunder_i_ray_shooting_init(&b.rays, &m->rings, member, &m->scratch)) return;
    bool ok = join_pairs(&b);
    for (uint32_t i = 0; ok && i < member->n && !sunder_i_maker_failed(m); i++)
        if (b.reflex[i] && !b.paired[i]) ok = resolve_vertex(&b, member->first + i);
    if (!ok) m->scratch.failed = true;
    if (!sunder_i_maker_failed(m)) sunder_i_cuts_apply(m, member, b.cut, b.cuts);
    sunder_i_ray_shooting_free(&b.rays);
    sunder_i_free(b.pair);
}
