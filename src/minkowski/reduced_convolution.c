/* reduced_convolution.c: two simple polygons P and Q, neither of them convex: the outline of O = int P + int Q from the
 * reduced convolution, without pieces and subsums. For operands of fifty vertices it has some hundred segments and a
 * few thousand crossings.
 *
 * The *segments* of the reduced convolution [BL11]: each convex vertex of one operand carries the sides of the other
 * whose directions are strictly between those of its own two sides. Operands with a pair of parallel sides of one
 * direction are declined, so that "between" is unambiguous. Let x be in P + Q, but not in O: then P and x - Q touch,
 * with disjoint interiors. Each point where they touch is one of
 *
 *   a vertex in the interior of a side  the vertex is convex, and carries the side: x is inside a segment
 *   two convex vertices                 a line separates them, so that the directions that they carry have an interval
 *                                       in common; the segments of its first and its last direction end and begin in x
 *   a convex and a reflex vertex        the convex one fits into the other's notch, and carries both its sides: one
 *                                       segment ends and the other begins in x
 *
 * (Sides in contact along a stretch would have the same direction, and two reflex vertices overlap.) So the boundary of
 * O, its degenerate holes included, is on segments. A segment has a loose end if a convex vertex carries only one of
 * the two sides at a reflex vertex; there the convex vertex is in the interior of the other operand, so that the end is
 * in O.
 *
 * The segments are *tame* if two of them meet only in these ways: consecutive segments, as above, at their common end,
 * and pairs that cross in their relative interiors, with no third segment through that point. A point x on segments
 * that is not in O then has one contact for each segment, or for two consecutive ones, and no other. Near x, these
 * contacts determine O:
 *
 *   inside one segment            its left side
 *   where one continues another   the left of both, or of either: the second segment continues the boundary
 *   where two cross               the left of either; the free wedge is right of both
 *
 * In no case does the sum surround x, or a line through x: there are no degenerate holes. Between two stops, a segment
 * is in O entirely, or is boundary entirely. So the boundary consists of whole *links* between stops, and each link has
 * one successor: at a crossing it is a link of the other segment, if the first link arrives at the other segment's
 * right side. A link that arrives from the left is in O, so is one that leads to a loose end, and so is a link whose
 * successor is in O. The others form *cycles* of links, and a cycle is boundary entirely or not at all: one point of it
 * is tested (reduced_convolution_inside.c). The cycle through the smallest vertex of the sum needs no test: it is the
 * outer ring. There is no other outer ring, since O is connected.
 *
 * No two cycles meet, and none meets itself, since at a crossing only one link leaves to the right of both. A vertex
 * between consecutive links is never straight. Every decision here is exact or certain; if one would not be, or the
 * segments are not tame, this method declines and the general method is used. */
#include "minkowski/reduced_convolution_inner.h"

#include "base/watch.h"

#include <stdalign.h>
#include <string.h>

#define NO_LINK UINT32_MAX

/* The state of the search for cycles. The links of segment a have the numbers from stop_begin(a) + a on; there is one
 * more of them than stops. */
typedef struct tracer {
    sunder_i_reduced *r;
    uint32_t *segment; /* [links] the segment of each link */
    uint32_t *next;    /* [links] the successor of each link, or NO_LINK */
    uint32_t *visit;   /* [links] the number of the traversal that reached the link, from 1 on; 0: none */
    uint32_t *cycle;   /* [links] the current cycle */
    uint32_t n;        /* the number of links in it */
    sunder_i_place_query inside;
    sunder_sum *sum;
    uint32_t *vertex; /* the vertex numbers of the rings, ring by ring */
    sunder_i_found_ring *ring;
    size_t rings, vertices_room, numbers_room, rings_room;
} tracer;

static uint32_t first_link(const sunder_i_reduced *r, uint32_t segment)
{
    return sunder_i_reduced_stop_begin(r, segment) + segment;
}

static bool first_rises_at(const sunder_i_reduced *r, uint32_t end)
{
    return r->crossing[end / 2].first_rises != (end % 2 == 1);
}

/* Sets the successor of each link. */
static void find_next(tracer *t)
{
    const sunder_i_reduced *r = t->r;
    for (uint32_t a = 0, link = 0, stop = 0; a < r->segments; a++) {
        for (; stop < r->stop_end[a]; stop++, link++) {
            const uint32_t end = r->stop[stop].item, other = r->crossing[end / 2].segment[end % 2 == 0];
            t->segment[link] = a;
            t->next[link] = first_rises_at(r, end) ? r->place[end ^ 1] + other + 1 : NO_LINK;
        }
        const uint32_t next = r->segment[a].next;
        t->segment[link] = a;
        t->next[link++] = next == SUNDER_I_NO_SEGMENT ? NO_LINK : first_link(r, next);
    }
}

/* ---- Rings ---- */

/* Returns the point where a link begins: the beginning of its segment, or a stop. */
static sunder_i_hpoint start_of(const tracer *t, uint32_t link)
{
    const sunder_i_reduced *r = t->r;
    const uint32_t a = t->segment[link], first = first_link(r, a);
    const sunder_i_reduced_segment *s = &r->segment[a];
    if (link == first) return sunder_i_hpoint_of(r->lattice, s->from);
    const uint32_t end = r->stop[link - 1 - a].item;
    const sunder_i_reduced_segment *o = &r->segment[r->crossing[end / 2].segment[end % 2 == 0]];
    const sunder_i_det d = sunder_i_narrow_cross(s->along, o->along);
    const sunder_i_fraction at =
        sunder_i_narrow_fraction(sunder_i_narrow_cross(sunder_i_narrow_sub(o->from, s->from), o->along), d);
    r->lattice->counts.segment_intersections++;
    return sunder_i_hpoint_at(r->lattice, s->from, (sunder_i_point){s->from.x + s->along.x, s->from.y + s->along.y},
                              &at);
}

/* Makes a ring of the current cycle; a ring begins at its smallest vertex. Returns false if out of memory. */
static bool add_ring(tracer *t, bool outer)
{
    sunder_sum *sum = t->sum;
    const uint32_t start = sum->vertices, end = start + t->n;
    if (!sunder_i_reserve(&sum->vertex, &t->vertices_room, end, sizeof *sum->vertex) ||
        !sunder_i_reserve(&t->vertex, &t->numbers_room, end, sizeof *t->vertex) ||
        !sunder_i_reserve(&t->ring, &t->rings_room, t->rings + 1, sizeof *t->ring))
        return false;
    sunder_i_hpoint *at = sum->vertex + start;
    uint32_t least = 0;
    for (uint32_t i = 0; i < t->n; i++) {
        at[i] = start_of(t, t->cycle[i]);
        if (!outer && sunder_i_hpoint_cmp(&sum->lattice, &at[i], &at[least]) < 0)
            least = i; /* an outer ring begins there already */
    }
    sum->vertices = end;
    for (uint32_t i = 0; i < t->n; i++)
        t->vertex[start + i] = start + (least + i < t->n ? least + i : least + i - t->n);
    t->ring[t->rings++] = (sunder_i_found_ring){start, end, 0, outer};
    return true;
}

/* ---- Cycles ---- */

/* Returns a parameter, along its segment, of a point near the middle of a link. */
static double middle_of(const tracer *t, uint32_t link)
{
    const sunder_i_reduced *r = t->r;
    const uint32_t a = t->segment[link], stop = link - a;
    const double from = stop > sunder_i_reduced_stop_begin(r, a) ? r->stop[stop - 1].value : 0;
    return (from + (stop < r->stop_end[a] ? r->stop[stop].value : 1)) / 2;
}

/* Returns whether the current cycle is in O. The links are tested one after the other until the answer is certain;
 * SUNDER_I_UNCERTAIN if it is for none. */
static sunder_i_place_in_sum ask_cycle(tracer *t)
{
    for (uint32_t i = 0; i < t->n; i++) {
        const uint32_t link = t->cycle[i];
        const sunder_i_place_in_sum is = sunder_i_place_query_ask(&t->inside, t->segment[link], middle_of(t, link));
        if (is != SUNDER_I_UNCERTAIN) return is;
    }
    return SUNDER_I_UNCERTAIN;
}

/* Follows successors from a link until there is none or the next one was reached before. Returns true if that one was
 * reached in this traversal: then the links from there on form the current cycle. */
static bool walk_links(tracer *t, uint32_t link, uint32_t number)
{
    uint32_t n = 0;
    for (; link != NO_LINK && t->visit[link] == 0; link = t->next[link]) {
        t->visit[link] = number;
        t->cycle[n++] = link;
    }
    if (link == NO_LINK || t->visit[link] != number) return false;
    uint32_t at = 0;
    while (t->cycle[at] != link) at++;
    t->n = n - at;
    memmove(t->cycle, t->cycle + at, t->n * sizeof *t->cycle);
    return true;
}

/* Returns the segment that begins at the smallest vertex of the sum, which is the sum of the operands' smallest
 * vertices; SUNDER_I_NO_SEGMENT: none. */
static uint32_t outermost_segment(const sunder_i_reduced *r)
{
    uint32_t least[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        const sunder_i_point *at = r->operand[k].at;
        for (uint32_t i = 1; i < r->operand[k].n; i++)
            if (at[i].x < at[least[k]].x || (at[i].x == at[least[k]].x && at[i].y < at[least[k]].y)) least[k] = i;
    }
    return sunder_i_reduced_starting_at(r, least[0], least[1]);
}

/* Finds all cycles and makes rings of those on the boundary. *fits becomes false if a decision is not certain. Returns
 * false if out of memory. */
static bool trace_cycles(tracer *t, bool *fits)
{
    const uint32_t links = t->r->segments + 2 * (uint32_t)t->r->crossings, first = outermost_segment(t->r);
    uint32_t number = 1;
    *fits = first != SUNDER_I_NO_SEGMENT && walk_links(t, first_link(t->r, first), number) &&
            t->cycle[0] == first_link(t->r, first);
    if (!*fits) return true;
    if (!add_ring(t, true)) return false;
    for (uint32_t link = 0; link < links; link++) {
        if (t->visit[link] || !walk_links(t, link, ++number)) continue;
        if (!sunder_i_steps(t->n)) return false;
        const sunder_i_place_in_sum is = ask_cycle(t);
        *fits = is != SUNDER_I_UNCERTAIN;
        if (!*fits) return true;
        if (is == SUNDER_I_NOT_INSIDE && !add_ring(t, false)) return false;
    }
    return true;
}

static bool finish_sum(tracer *t)
{
    sunder_sum *sum = t->sum;
    sunder_i_found found = {.vertex = t->vertex,
                            .ring = t->ring,
                            .rings = t->rings,
                            .components = 1,
                            .compare = sunder_i_sum_vertex_cmp,
                            .context = sum,
                            .place = sum->vertex};
    return sunder_i_canonical(&found, sum);
}

/* Sets the outline of the sum; *done: whether the cycles prove it. Returns false if out of memory. */
static bool trace_sum(sunder_i_reduced *r, sunder_sum *sum, bool *done)
{
    const size_t links = r->segments + 2 * r->crossings;
    sunder_i_arena *m = &r->memory;
    tracer t = {.r = r,
                .segment = sunder_i_arena_alloc(m, links, sizeof *t.segment),
                .next = sunder_i_arena_alloc(m, links, sizeof *t.next),
                .visit = sunder_i_arena_alloc(m, links, sizeof *t.visit),
                .cycle = sunder_i_arena_alloc(m, links, sizeof *t.cycle),
                .sum = sum};
    if (!sunder_i_place_query_init(&t.inside, r)) return false;
    memset(t.visit, 0, links * sizeof *t.visit);
    find_next(&t);
    bool ok = trace_cycles(&t, done);
    if (ok && *done) ok = finish_sum(&t);
    sunder_i_free_all(t.ring, t.vertex);
    if (ok && *done) return true;
    sunder_i_free(sum->vertex);
    sum->vertex = NULL;
    sum->vertices = 0;
    return ok;
}

/* The size of the stack memory, enough for operands with some dozen vertices, without their segments. */
enum { LENT = 16384 };

sunder_status sunder_i_reduced_convolution_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                               const sunder_shape *q, const sunder_i_point *at_q, bool *done,
                                               sunder_error *err)
{
    sunder_i_reduced r = {.lattice = &sum->lattice, .operand = {{.shape = p}, {.shape = q}}};
    alignas(16) char lent[LENT];
    bool fits;
    *done = false;
    sunder_i_arena_init_on(&r.small, lent, sizeof lent);
    bool ok = sunder_i_reduced_build(&r, (const sunder_i_point *[2]){at_p, at_q}, &fits);
    if (ok && fits) ok = sunder_i_reduced_cross(&r, &fits);
    if (ok && fits) ok = trace_sum(&r, sum, done);
    sunder_i_arena_free(&r.memory);
    sunder_i_arena_free(&r.small);
    sunder_i_free(r.room);
    *done &= ok;
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
