/* reduced_convolution_segments.c: makes the segments of the reduced convolution: each convex vertex of one operand
 * carries the sides of the other whose directions are between those of its own two sides. */
#include "minkowski/reduced_convolution_inner.h"

#include "base/sort.h"
#include "convex/directions.h"

#include <string.h>

/* The cost of the general method depends on the outline, that of this method on the arrangement of all segments, whose
 * number can be as large as the product of sides and vertices. Therefore this method is limited to MOST_FOR_EACH
 * segments for each vertex of the operands, and to MOST_SEGMENTS, the number that a sort key can represent. */
#define MOST_FOR_EACH 13
#define MOST_SEGMENTS (1u << 20)
/* With more than FEW_SEGMENTS segments, SAMPLES of them give an estimate of the number of pairs that overlap along both
 * axes. This method is declined if there are more than MOST_PAIRS pairs for each vertex of the smaller operand, a third
 * of that if numbers are long: the time of the general method depends more on the smaller operand than on the number of
 * crossings. Measured on stars and random polygons of up to 100 vertices each, and of 600 and 1300 by 12. */
#define FEW_SEGMENTS 1024
#define SAMPLES 64
#define MOST_PAIRS 768.0
/* The bytes allocated for each segment, twice what stars need; the bytes that do not depend on their number; and the
 * largest number allocated. */
#define ROOM_FOR_EACH 1024
#define MORE_ROOM 16384
#define MOST_ROOM (1u << 22)

static sunder_i_point sum_of(sunder_i_point a, sunder_i_point b) { return (sunder_i_point){a.x + b.x, a.y + b.y}; }

/* ---- Operands ---- */

static bool operand_init(sunder_i_arena *m, sunder_i_chain_operand *o, const sunder_i_point *at)
{
    const sunder_i_cleaned *c = &o->shape->form->cleaned;
    o->n = o->shape->vertices;
    o->at = sunder_i_arena_alloc(m, o->n, sizeof *o->at);
    o->along = sunder_i_arena_alloc(m, o->n, sizeof *o->along);
    o->by_rank = sunder_i_arena_alloc(m, o->n, sizeof *o->by_rank);
    o->position = sunder_i_arena_alloc(m, o->n, sizeof *o->position);
    o->first = sunder_i_arena_alloc(m, o->n, sizeof *o->first);
    if (m->failed) return false;
    for (uint32_t i = 0, v = 0; i < o->n; i++, v = c->next[v]) o->at[i] = at[v];
    for (uint32_t i = 0; i < o->n; i++) o->along[i] = sunder_i_narrow_sub(o->at[sunder_i_vertex_after(o, i)], o->at[i]);
    return true;
}

/* Counts the sides below each rank, and sorts the sides by rank. Returns false if out of memory. */
static bool order_sides(sunder_i_reduced *r, sunder_i_chain_operand *o)
{
    const uint32_t ranks = 2 * r->classes;
    o->below = sunder_i_arena_alloc(&r->small, ranks + 1, sizeof *o->below);
    if (!o->below) return false;
    memset(o->below, 0, (ranks + 1) * sizeof *o->below);
    for (uint32_t i = 0; i < o->n; i++) o->below[o->rank[i] + 1]++;
    for (uint32_t k = 0; k < ranks; k++) o->below[k + 1] += o->below[k];
    for (uint32_t i = o->n; i-- > 0;) o->by_rank[--o->below[o->rank[i] + 1]] = i;
    /* Now below[k + 1] has the value for below[k]. */
    memmove(o->below, o->below + 1, ranks * sizeof *o->below);
    for (uint32_t at = 0; at < o->n; at++) o->position[o->by_rank[at]] = at;
    return true;
}

/* Returns the set of axis-parallel directions of the operand's sides, one bit for each of the four. */
static unsigned along_axes(const sunder_i_chain_operand *o)
{
    unsigned found = 0;
    for (uint32_t i = 0; i < o->n; i++) {
        const sunder_i_point d = o->along[i];
        if (d.y == 0) found |= d.x > 0 ? 1 : 2;
        if (d.x == 0) found |= d.y > 0 ? 4 : 8;
    }
    return found;
}

/* Returns true if a side of one operand has the direction of a side of the other. Then contacts along sides exist,
 * which are not tame. */
static bool share_direction(const sunder_i_reduced *r)
{
    const sunder_i_chain_operand *p = &r->operand[0], *q = &r->operand[1];
    for (uint32_t i = 0; i < p->n; i++) {
        const uint32_t rank = p->rank[i], above = rank + 1 < 2 * r->classes ? q->below[rank + 1] : q->n;
        if (q->below[rank] < above) return true;
    }
    return false;
}

/* Ranks all sides by their directions. Returns false if out of memory. */
static bool rank_sides(sunder_i_reduced *r)
{
    sunder_i_chain_operand *p = &r->operand[0], *q = &r->operand[1];
    const uint32_t n = p->n + q->n;
    sunder_i_directions directions;
    sunder_i_point *turned = sunder_i_arena_alloc(&r->small, n, sizeof *turned);
    p->rank = sunder_i_arena_alloc(&r->small, n, sizeof *p->rank);
    if (r->small.failed) return false;
    q->rank = p->rank + p->n;
    memcpy(turned, p->along, p->n * sizeof *turned);
    memcpy(turned + p->n, q->along, q->n * sizeof *turned);
    if (!sunder_i_directions_rank(r->lattice, turned, n, p->rank, &directions)) return false;
    r->classes = directions.classes;
    sunder_i_directions_free(&directions);
    return order_sides(r, p) && order_sides(r, q);
}

/* ---- Segments ---- */

/* Returns the sides of a that the convex vertex j of b carries. */
static sunder_i_rank_range carried_sides(const sunder_i_chain_operand *a, const sunder_i_chain_operand *b, uint32_t j)
{
    return sunder_i_sides_between(a, b->rank[sunder_i_vertex_before(b, j)], b->rank[j]);
}

static uint32_t sides_in(sunder_i_rank_range range)
{
    return range.end[0] - range.first[0] + range.end[1] - range.first[1];
}

/* Numbers the segments that the vertices of operand b carry, from n on. Returns the next free number, or MOST_SEGMENTS
 * if there are too many. */
static uint32_t number_segments(sunder_i_reduced *r, int b, uint32_t n)
{
    sunder_i_chain_operand *o = &r->operand[b], *a = &r->operand[!b];
    for (uint32_t j = 0; j < o->n && n < MOST_SEGMENTS; j++) {
        const bool convex = sunder_i_is_convex(o, j, r->classes);
        o->first[j] = convex ? n : SUNDER_I_NO_SEGMENT;
        n += convex ? sides_in(carried_sides(a, o, j)) : 0;
    }
    return n < MOST_SEGMENTS ? n : MOST_SEGMENTS;
}

uint32_t sunder_i_reduced_segment_of(const sunder_i_reduced *r, int a, uint32_t i, uint32_t j)
{
    const sunder_i_chain_operand *o = &r->operand[a], *b = &r->operand[!a];
    if (b->first[j] == SUNDER_I_NO_SEGMENT) return SUNDER_I_NO_SEGMENT;
    const sunder_i_rank_range range = carried_sides(o, b, j);
    const uint32_t at = o->position[i];
    if (at >= range.first[0] && at < range.end[0]) return r->order[b->first[j] + at - range.first[0]];
    if (at >= range.end[1]) return SUNDER_I_NO_SEGMENT;
    return r->order[b->first[j] + range.end[0] - range.first[0] + at]; /* the second range starts at position 0 */
}

/* A segment before the segments are sorted from left to right. */
typedef struct made {
    sunder_i_point from, along;
    uint32_t side, vertex;
    int of; /* the operand of the side */
} made;

/* Makes the segments that the vertices of operand b carry; of all segments only every step-th, from number 0 on. */
static void make_segments(const sunder_i_reduced *r, int b, uint32_t step, made *out)
{
    const sunder_i_chain_operand *o = &r->operand[b], *a = &r->operand[!b];
    for (uint32_t j = 0; j < o->n; j++) {
        if (o->first[j] == SUNDER_I_NO_SEGMENT) continue;
        const sunder_i_rank_range range = carried_sides(a, o, j);
        uint32_t number = (o->first[j] + step - 1) / step, skip = number * step - o->first[j];
        for (int k = 0; k < 2; k++) {
            uint32_t at = range.first[k] + skip;
            for (; at < range.end[k]; at += step) {
                const uint32_t i = a->by_rank[at];
                out[number++] = (made){sum_of(a->at[i], o->at[j]), a->along[i], i, j, !b};
            }
            skip = at - range.end[k];
        }
    }
}

/* Returns the segment that starts where segment s ends, or SUNDER_I_NO_SEGMENT. */
static uint32_t next_of(const sunder_i_reduced *r, const made *s)
{
    const uint32_t end = sunder_i_vertex_after(&r->operand[s->of], s->side);
    return s->of == 0 ? sunder_i_reduced_starting_at(r, end, s->vertex)
                      : sunder_i_reduced_starting_at(r, s->vertex, end);
}

/* The interval of a segment along one axis. */
typedef struct span {
    int64_t low, high;
} span;

static span span_of(int64_t from, int64_t along)
{
    return along < 0 ? (span){from + along, from} : (span){from, from + along};
}

static span x_of(const made *s) { return span_of(s->from.x, s->along.x); }
static span y_of(const made *s) { return span_of(s->from.y, s->along.y); }

static bool spans_overlap(span a, span b) { return (a.low <= b.high) & (b.low <= a.high); }

static void extend_span(span *all, span by)
{
    if (by.low < all->low) all->low = by.low;
    if (by.high > all->high) all->high = by.high;
}

/* Returns true if differences of coordinates with these extents are brief (narrow.h). */
static bool is_brief(span x, span y) { return (x.high - x.low) >> 30 == 0 && (y.high - y.low) >> 30 == 0; }

static int shift_of(span all)
{
    int shift = 0;
    while ((all.high - all.low) >> shift >> SUNDER_I_STEP_BITS) shift++;
    return shift;
}

static sunder_i_steps_along steps_of(span s, span all, int shift)
{
    return (sunder_i_steps_along){(uint32_t)((s.low - all.low) >> shift), (uint32_t)((s.high - all.low) >> shift)};
}

/* Returns true if testing all pairs of segments that overlap along both axes would probably take longer than the
 * general method. */
static bool are_too_many(const sunder_i_reduced *r, uint32_t n)
{
    made sample[SAMPLES];
    span x[SAMPLES], y[SAMPLES];
    const uint32_t p = r->operand[0].n, q = r->operand[1].n, step = (n + SAMPLES - 1) / SAMPLES;
    const uint32_t samples = (n + step - 1) / step;
    make_segments(r, 0, step, sample);
    make_segments(r, 1, step, sample);
    span all_x = x_of(&sample[0]), all_y = y_of(&sample[0]);
    uint32_t found = 0;
    for (uint32_t a = 0; a < samples; a++) {
        x[a] = x_of(&sample[a]);
        y[a] = y_of(&sample[a]);
        extend_span(&all_x, x[a]);
        extend_span(&all_y, y[a]);
        for (uint32_t b = 0; b < a; b++) {
            const bool across = spans_overlap(x[a], x[b]), up = spans_overlap(y[a], y[b]);
            found += across & up;
        }
    }
    return (double)found * step * step > (is_brief(all_x, all_y) ? MOST_PAIRS : MOST_PAIRS / 3) * (p < q ? p : q);
}

/* Sorts the segments from left to right, and sets `next` of each to the segment that starts where it ends, if there
 * is one. Returns false if out of memory. */
static bool arrange_segments(sunder_i_reduced *r, const made *s)
{
    const uint32_t n = r->segments;
    uint64_t *key = sunder_i_arena_alloc(&r->memory, n, sizeof *key);
    if (!key) return false;
    span x = x_of(&s[0]), y = y_of(&s[0]);
    for (uint32_t k = 1; k < n; k++) {
        extend_span(&x, x_of(&s[k]));
        extend_span(&y, y_of(&s[k]));
    }
    const int shift_x = shift_of(x), shift_y = shift_of(y);
    r->brief = is_brief(x, y);
    for (uint32_t k = 0; k < n; k++) key[k] = (uint64_t)steps_of(x_of(&s[k]), x, shift_x).low * MOST_SEGMENTS + k;
    if (!sunder_i_sort_keys(key, n)) return false;
    for (uint32_t at = 0; at < n; at++) {
        const made *own = &s[key[at] % MOST_SEGMENTS];
        r->x[at] = steps_of(x_of(own), x, shift_x);
        r->y[at] = steps_of(y_of(own), y, shift_y);
        r->segment[at] = (sunder_i_reduced_segment){own->from, own->along, SUNDER_I_NO_SEGMENT};
        r->order[key[at] % MOST_SEGMENTS] = at;
    }
    for (uint32_t k = 0; k < n; k++) r->segment[r->order[k]].next = next_of(r, &s[k]);
    return true;
}

/* Allocates memory for n segments, their stops and links, in one block with spare room that is never touched: glibc
 * keeps up to twice the largest block freed so far (../outline/culling_root.c). If the block is too small, the arena
 * allocates more. Returns false if out of memory. */
static bool make_room(sunder_i_reduced *r, uint32_t n)
{
    const size_t bytes = n < MOST_ROOM / ROOM_FOR_EACH ? (size_t)n * ROOM_FOR_EACH + MORE_ROOM : MOST_ROOM;
    r->room = sunder_i_alloc(bytes, 1);
    if (!r->room) return false;
    sunder_i_arena_init_on(&r->memory, r->room, bytes);
    return true;
}

/* Returns true if the shape has one ring only, which touches no other point of itself. */
static bool is_simple(const sunder_shape *s)
{
    return s->form->cleaned.rings == 1 && !s->touches && !s->repaired && !s->flat && !s->rational;
}

bool sunder_i_reduced_build(sunder_i_reduced *r, const sunder_i_point *at[2], bool *fits)
{
    sunder_i_arena *m = &r->memory;
    const sunder_shape *p = r->operand[0].shape, *q = r->operand[1].shape;
    *fits = r->lattice->narrow && is_simple(p) && is_simple(q);
    if (!*fits) return true;
    for (int k = 0; k < 2; k++)
        if (!operand_init(&r->small, &r->operand[k], at[k])) return false;
    *fits =
        /* tested first, since it is fast and a common reason to decline */
        (along_axes(&r->operand[0]) & along_axes(&r->operand[1])) == 0;
    if (!*fits) return true;
    if (!rank_sides(r)) return false;
    const uint32_t n = number_segments(r, 1, number_segments(r, 0, 0));
    *fits = n < MOST_SEGMENTS && n / MOST_FOR_EACH <= p->vertices + q->vertices && !share_direction(r) &&
            (n <= FEW_SEGMENTS || !are_too_many(r, n));
    if (!*fits) return true;
    if (!make_room(r, n)) return false;
    made *s = sunder_i_arena_alloc(m, n, sizeof *s);
    r->segments = n;
    r->segment = sunder_i_arena_alloc(m, n, sizeof *r->segment);
    r->x = sunder_i_arena_alloc(m, n, sizeof *r->x);
    r->y = sunder_i_arena_alloc(m, n, sizeof *r->y);
    r->order = sunder_i_arena_alloc(m, n, sizeof *r->order);
    if (m->failed) return false;
    make_segments(r, 0, 1, s);
    make_segments(r, 1, 1, s);
    return arrange_segments(r, s);
}
