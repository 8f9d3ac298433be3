/* The segments of the reduced convolution: each convex vertex of one operand carries the sides of the other whose
 * directions lie between those of its own two sides. */
#include "minkowski/reduced_convolution_inner.h"

#include "base/sort.h"
#include "convex/directions.h"

#include <string.h>

/* More segments are left to the general road, which follows the outline: all pairs of them from left to right are
 * looked at here. And the table of starts has an entry for each pair of vertices. */
#define MOST_SEGMENTS 2048
#define MOST_STARTS (1u << 14)

static sunder_i_point sum_of(sunder_i_point a, sunder_i_point b) { return (sunder_i_point){a.x + b.x, a.y + b.y}; }

/* ---- Operands ---- */

static bool operand_init(sunder_i_arena *m, sunder_i_chain_operand *o, const sunder_i_point *at)
{
    const sunder_i_cleaned *c = &o->shape->form->cleaned;
    o->n = o->shape->vertices;
    o->at = sunder_i_arena_alloc(m, o->n, sizeof *o->at);
    o->along = sunder_i_arena_alloc(m, o->n, sizeof *o->along);
    o->by_rank = sunder_i_arena_alloc(m, o->n, sizeof *o->by_rank);
    if (m->failed) return false;
    for (uint32_t i = 0, v = 0; i < o->n; i++, v = c->next[v]) o->at[i] = at[v];
    for (uint32_t i = 0; i < o->n; i++) o->along[i] = sunder_i_narrow_sub(o->at[sunder_i_vertex_after(o, i)], o->at[i]);
    return true;
}

/* How many sides there are below each rank, and the sides in that order. */
static bool order_sides(sunder_i_reduced *r, sunder_i_chain_operand *o)
{
    const uint32_t ranks = 2 * r->classes;
    o->below = sunder_i_arena_alloc(&r->memory, ranks + 1, sizeof *o->below);
    if (!o->below) return false;
    memset(o->below, 0, (ranks + 1) * sizeof *o->below);
    for (uint32_t i = 0; i < o->n; i++) o->below[o->rank[i] + 1]++;
    for (uint32_t k = 0; k < ranks; k++) o->below[k + 1] += o->below[k];
    for (uint32_t i = o->n; i-- > 0;) o->by_rank[--o->below[o->rank[i] + 1]] = i;
    /* Now below[k + 1] is what below[k] is to be. */
    memmove(o->below, o->below + 1, ranks * sizeof *o->below);
    return true;
}

/* Which of the four directions along the axes sides have. */
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

/* Has some side of the one operand the direction of one of the other's? Contacts along sides are no plain ones. */
static bool share_direction(const sunder_i_reduced *r)
{
    const sunder_i_chain_operand *p = &r->operand[0], *q = &r->operand[1];
    for (uint32_t i = 0; i < p->n; i++) {
        const uint32_t rank = p->rank[i], above = rank + 1 < 2 * r->classes ? q->below[rank + 1] : q->n;
        if (q->below[rank] < above) return true;
    }
    return false;
}

/* Ranks all sides by their directions. */
static bool rank_sides(sunder_i_reduced *r)
{
    sunder_i_chain_operand *p = &r->operand[0], *q = &r->operand[1];
    const uint32_t n = p->n + q->n;
    sunder_i_directions directions;
    sunder_i_point *turned = sunder_i_arena_alloc(&r->memory, n, sizeof *turned);
    p->rank = sunder_i_arena_alloc(&r->memory, n, sizeof *p->rank);
    if (r->memory.failed) return false;
    q->rank = p->rank + p->n;
    memcpy(turned, p->along, p->n * sizeof *turned);
    memcpy(turned + p->n, q->along, q->n * sizeof *turned);
    if (!sunder_i_directions_rank(r->lattice, turned, n, p->rank, &directions)) return false;
    r->classes = directions.classes;
    sunder_i_directions_free(&directions);
    return order_sides(r, p) && order_sides(r, q);
}

/* ---- Segments ---- */

/* At convex vertex j of b. */
static sunder_i_rank_range carried(const sunder_i_chain_operand *a, const sunder_i_chain_operand *b, uint32_t j)
{
    return sunder_i_sides_between(a, b->rank[sunder_i_vertex_before(b, j)], b->rank[j]);
}

static size_t count(const sunder_i_reduced *r, int a)
{
    const sunder_i_chain_operand *o = &r->operand[a], *b = &r->operand[!a];
    size_t n = 0;
    for (uint32_t j = 0; j < b->n; j++) {
        if (!sunder_i_is_convex(b, j, r->classes)) continue;
        const sunder_i_rank_range range = carried(o, b, j);
        n += range.end[0] - range.first[0] + range.end[1] - range.first[1];
    }
    return n;
}

/* A segment before it has its place from left to right. */
typedef struct made {
    sunder_i_point from, along;
    uint32_t start, end; /* in the table of starts */
} made;

/* The sides of operand a at the vertices of the other. */
static uint32_t make(const sunder_i_reduced *r, int a, made *out, uint32_t n)
{
    const sunder_i_chain_operand *o = &r->operand[a], *b = &r->operand[!a];
    const uint32_t stride = r->operand[1].n, step = a ? 1 : stride, other = a ? stride : 1;
    for (uint32_t j = 0; j < b->n; j++) {
        if (!sunder_i_is_convex(b, j, r->classes)) continue;
        const sunder_i_rank_range range = carried(o, b, j);
        for (int k = 0; k < 2; k++)
            for (uint32_t at = range.first[k]; at < range.end[k]; at++) {
                const uint32_t i = o->by_rank[at];
                out[n++] = (made){sum_of(o->at[i], b->at[j]), o->along[i], i * step + j * other,
                                  sunder_i_vertex_after(o, i) * step + j * other};
            }
    }
    return n;
}

/* Where a segment begins and ends along one axis. */
typedef struct span {
    int64_t low, high;
} span;

static span span_of(int64_t from, int64_t along)
{
    return along < 0 ? (span){from + along, from} : (span){from, from + along};
}

static span x_of(const made *s) { return span_of(s->from.x, s->along.x); }
static span y_of(const made *s) { return span_of(s->from.y, s->along.y); }

static void extend(span *all, span by)
{
    if (by.low < all->low) all->low = by.low;
    if (by.high > all->high) all->high = by.high;
}

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

/* Puts the segments in order from left to right, and finds which follows which. */
static bool arrange(sunder_i_reduced *r, const made *s)
{
    const uint32_t n = r->segments;
    uint64_t *key = sunder_i_arena_alloc(&r->memory, n, sizeof *key);
    if (!key) return false;
    span x = x_of(&s[0]), y = y_of(&s[0]);
    for (uint32_t k = 1; k < n; k++) {
        extend(&x, x_of(&s[k]));
        extend(&y, y_of(&s[k]));
    }
    const int shift_x = shift_of(x), shift_y = shift_of(y);
    r->brief = (x.high - x.low) >> 30 == 0 && (y.high - y.low) >> 30 == 0;
    for (uint32_t k = 0; k < n; k++) key[k] = (uint64_t)steps_of(x_of(&s[k]), x, shift_x).low * MOST_SEGMENTS + k;
    if (!sunder_i_sort_keys(key, n)) return false;
    for (uint32_t at = 0; at < n; at++) {
        const made *own = &s[key[at] % MOST_SEGMENTS];
        r->x[at] = steps_of(x_of(own), x, shift_x);
        r->y[at] = steps_of(y_of(own), y, shift_y);
        r->segment[at] = (sunder_i_reduced_segment){own->from, own->along, own->end};
        r->start[own->start] = at;
    }
    for (uint32_t at = 0; at < n; at++) r->segment[at].next = r->start[r->segment[at].next];
    return true;
}

/* Vertices of one ring, none of which another touches. */
static bool is_simple(const sunder_shape *s)
{
    return s->form->cleaned.rings == 1 && !s->touches && !s->repaired && !s->flat && !s->rational;
}

bool sunder_i_reduced_build(sunder_i_reduced *r, const sunder_i_point *at[2], bool *fits)
{
    sunder_i_arena *m = &r->memory;
    const sunder_shape *p = r->operand[0].shape, *q = r->operand[1].shape;
    *fits = r->lattice->narrow && is_simple(p) && is_simple(q) && p->vertices <= MOST_STARTS / q->vertices;
    if (!*fits) return true;
    for (int k = 0; k < 2; k++)
        if (!operand_init(m, &r->operand[k], at[k])) return false;
    *fits =
        (along_axes(&r->operand[0]) & along_axes(&r->operand[1])) == 0; /* what many have in common, and soon seen */
    if (!*fits) return true;
    if (!rank_sides(r)) return false;
    const size_t n = count(r, 0) + count(r, 1);
    *fits = n <= MOST_SEGMENTS && !share_direction(r);
    if (!*fits) return true;
    const size_t starts = (size_t)r->operand[0].n * r->operand[1].n;
    made *s = sunder_i_arena_alloc(m, n, sizeof *s);
    r->segment = sunder_i_arena_alloc(m, n, sizeof *r->segment);
    r->x = sunder_i_arena_alloc(m, n, sizeof *r->x);
    r->y = sunder_i_arena_alloc(m, n, sizeof *r->y);
    r->start = sunder_i_arena_alloc(m, starts, sizeof *r->start);
    if (m->failed) return false;
    memset(r->start, 0xff, starts * sizeof *r->start);
    r->segments = make(r, 1, s, make(r, 0, s, 0));
    return arrange(r, s);
}
