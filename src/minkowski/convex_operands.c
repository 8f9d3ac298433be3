/* convex_operands.c: the sum of two convex polygons: their sides in the order of their angles are the sides of the sum.
 * No arrangement is needed. Most buildings are such polygons.
 *
 * Both polygons are traversed from their lexicographically smallest corner. From there the directions of the sides turn
 * once around, from straight down (excluded): first those of sides that lead to greater points, then those that lead
 * back. Sides of equal direction become one side, so that no vertex is straight, and the sum starts at its own smallest
 * corner: it is in canonical form. */
#include "minkowski/convex_operands.h"

#include "convex/merge.h"
#include "predicate/narrow.h"

static uint32_t smallest_corner(sunder_i_lattice *l, const sunder_shape *shape, const sunder_i_point *at)
{
    uint32_t least = 0;
    for (uint32_t v = 1; v < shape->vertices; v++)
        if (sunder_i_point_cmp_inline(l, at[v], at[least]) < 0) least = v;
    return least;
}

typedef struct side {
    sunder_i_point along;
    bool back; /* does the side lead to a lexicographically smaller point? */
} side;

static side side_from(sunder_i_lattice *l, const sunder_shape *shape, const sunder_i_point *at, uint32_t v)
{
    const sunder_i_point from = at[v], to = at[shape->form->cleaned.next[v]];
    return (side){sunder_i_point_sub_inline(l, to, from), sunder_i_point_cmp_inline(l, to, from) < 0};
}

/* Compares two sides in the order of the traversal; 0: they have the same direction. */
static int compare_sides(sunder_i_lattice *l, const side *s, const side *t)
{
    if (s->back != t->back) return s->back ? 1 : -1;
    return -sunder_i_cross_sign_inline(l, s->along, t->along);
}

bool sunder_i_are_convex(const sunder_shape *p, const sunder_shape *q) { return p->pieces == 1 && q->pieces == 1; }

sunder_status sunder_i_convex_operands_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                           const sunder_shape *q, const sunder_i_point *at_q, sunder_error *err)
{
    sunder_i_lattice *l = &sum->lattice;
    const size_t most = (size_t)p->vertices + q->vertices;
    sum->vertex = sunder_i_alloc(most, sizeof *sum->vertex);
    sum->ring_vertex = sunder_i_alloc(most, sizeof *sum->ring_vertex);
    sum->ring_end = sunder_i_alloc(1, sizeof *sum->ring_end);
    sum->poly_end = sunder_i_alloc(1, sizeof *sum->poly_end);
    if (!sum->vertex || !sum->ring_vertex || !sum->ring_end || !sum->poly_end) return sunder_i_failure_cause(err);
    uint32_t n = 0, i = smallest_corner(l, p, at_p), j = smallest_corner(l, q, at_q);
    sunder_i_merge m = sunder_i_merge_of(p->vertices, q->vertices);
    side s = side_from(l, p, at_p, i), t = side_from(l, q, at_q, j);
    while (SUNDER_I_MERGE_NEXT(&m, compare_sides(l, &s, &t))) {
        sunder_i_hpoint_of_sum(l, at_p[i], at_q[j], &sum->vertex[n++]);
        if (m.of_a) s = side_from(l, p, at_p, i = p->form->cleaned.next[i]);
        if (m.of_b) t = side_from(l, q, at_q, j = q->form->cleaned.next[j]);
    }
    if (l->arena.failed) return sunder_i_failure_cause(err);
    for (uint32_t v = 0; v < n; v++) sum->ring_vertex[v] = v;
    sum->vertices = n;
    sum->ring_end[0] = n;
    sum->poly_end[0] = sum->rings = sum->polygons = 1;
    return SUNDER_OK;
}
