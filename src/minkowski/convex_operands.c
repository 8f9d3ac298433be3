/* Two convex polygons: their sides in the order of their angles are the sides of the sum. No arrangement is needed, and
 * most buildings are such.
 *
 * Both walks start in the lexicographically smallest corner. From there directions turn from straight down (excluded)
 * once around: first those that lead to greater points, then those that lead back. Sides of one direction make one
 * side, so no vertex is straight, and the sum starts in its own smallest corner: it is canonical as it comes. */
#include "minkowski/convex_operands.h"

static uint32_t smallest(sunder_i_lattice *l, const sunder_shape *shape, const sunder_i_point *at)
{
    uint32_t least = 0;
    for (uint32_t v = 1; v < shape->vertices; v++)
        if (sunder_i_point_cmp(l, at[v], at[least]) < 0) least = v;
    return least;
}

/* Which of the sides a -> a' and b -> b' comes first; 0: they have one direction. */
static int order(sunder_i_lattice *l, const sunder_i_point a[2], const sunder_i_point b[2])
{
    const bool back_a = sunder_i_point_cmp(l, a[1], a[0]) < 0, back_b = sunder_i_point_cmp(l, b[1], b[0]) < 0;
    if (back_a != back_b) return back_a ? 1 : -1;
    return -sunder_i_cross_sign(l, sunder_i_point_sub(l, a[1], a[0]), sunder_i_point_sub(l, b[1], b[0]));
}

bool sunder_i_are_convex(const sunder_shape *p, const sunder_shape *q) { return p->pieces == 1 && q->pieces == 1; }

sunder_status sunder_i_convex_build(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                    const sunder_shape *q, const sunder_i_point *at_q, sunder_error *err)
{
    sunder_i_lattice *l = &sum->lattice;
    const size_t most = (size_t)p->vertices + q->vertices;
    sum->vertex = sunder_i_alloc(most, sizeof *sum->vertex);
    sum->ring_vertex = sunder_i_alloc(most, sizeof *sum->ring_vertex);
    sum->ring_end = sunder_i_alloc(1, sizeof *sum->ring_end);
    sum->poly_end = sunder_i_alloc(1, sizeof *sum->poly_end);
    if (!sum->vertex || !sum->ring_vertex || !sum->ring_end || !sum->poly_end) return sunder_i_no_memory(err);
    uint32_t n = 0, i = smallest(l, p, at_p), j = smallest(l, q, at_q), a = 0, b = 0;
    while (a < p->vertices || b < q->vertices) {
        const sunder_i_point side_p[2] = {at_p[i], at_p[p->next[i]]}, side_q[2] = {at_q[j], at_q[q->next[j]]};
        sum->vertex[n] = sunder_i_hpoint_of(l, sunder_i_point_add(l, side_p[0], side_q[0]));
        sum->ring_vertex[n] = n;
        n++;
        const int c = a == p->vertices ? 1 : b == q->vertices ? -1 : order(l, side_p, side_q);
        if (c <= 0) i = p->next[i], a++;
        if (c >= 0) j = q->next[j], b++;
    }
    if (l->arena.failed) return sunder_i_no_memory(err);
    sum->vertices = n;
    sum->ring_end[0] = n;
    sum->poly_end[0] = sum->rings = sum->polygons = 1;
    return SUNDER_OK;
}
