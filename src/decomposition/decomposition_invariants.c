/* decomposition_invariants.c: the tests of decompositions: exact and slow, with big integers only. */
#include "decomposition/decomposition.h"

#include "predicate/predicate.h"

static sunder_i_ratio add_ratios(sunder_i_arena *a, sunder_i_ratio u, sunder_i_ratio v)
{
    return sunder_i_ratio_reduced(a, sunder_i_ratio_add(a, u, v));
}

static sunder_i_big big_determinant(sunder_i_arena *a, sunder_i_big p, sunder_i_big q, sunder_i_big r, sunder_i_big s)
{
    return sunder_i_big_sub(a, sunder_i_big_mul(a, p, s), sunder_i_big_mul(a, q, r));
}

/* Returns twice the area of piece i. */
static sunder_i_ratio piece_area(sunder_i_arena *a, const sunder_i_decomposition *d, uint32_t i)
{
    sunder_i_ratio sum = {{NULL, 0}, sunder_i_big_i64(a, 1)};
    const uint32_t first = sunder_i_piece_first(d, i), end = d->piece_end[i];
    for (uint32_t k = first; k < end; k++) {
        const sunder_i_corner *c = &d->corner[d->piece_corner[k]];
        const sunder_i_corner *e = &d->corner[d->piece_corner[k + 1 < end ? k + 1 : first]];
        sum = add_ratios(a, sum,
                         (sunder_i_ratio){big_determinant(a, c->at.x, c->at.y, e->at.x, e->at.y),
                                          sunder_i_big_mul(a, c->at.w, e->at.w)});
    }
    return sum;
}

/* Returns twice the area of the ring with the vertices lo .. hi - 1. */
static sunder_i_ratio ring_area(sunder_i_lattice *l, const sunder_shape *s, const sunder_i_point *at, uint32_t lo,
                                uint32_t hi)
{
    sunder_i_arena *a = &l->arena;
    sunder_i_ratio sum = {{NULL, 0}, sunder_i_big_i64(a, 1)};
    for (uint32_t v = lo; v < hi; v++) {
        const sunder_i_rational_point p = sunder_i_rational_get(a, l, at[v]),
                                      q = sunder_i_rational_get(a, l, at[s->form->cleaned.next[v]]);
        sum = add_ratios(a, sum, (sunder_i_ratio){sunder_i_rational_cross(a, p, q), sunder_i_big_mul(a, p.w, q.w)});
    }
    return sum;
}

/* Returns true if the difference of the side's ends c and e is a positive multiple of the vector `along`. */
static bool side_agrees(sunder_i_lattice *l, const sunder_i_corner *c, const sunder_i_corner *e, sunder_i_point along)
{
    sunder_i_arena *a = &l->arena;
    const sunder_i_big dx = big_determinant(a, e->at.x, e->at.w, c->at.x, c->at.w),
                       dy = big_determinant(a, e->at.y, e->at.w, c->at.y, c->at.w);
    const sunder_i_rational_point v = sunder_i_rational_get(a, l, along);
    const sunder_i_big x = v.x, y = v.y;
    return sunder_i_big_sign(big_determinant(a, dx, dy, x, y)) == 0 &&
           sunder_i_big_sign(sunder_i_big_add(a, sunder_i_big_mul(a, dx, x), sunder_i_big_mul(a, dy, y))) > 0;
}

static const char *check_piece(sunder_i_lattice *l, const sunder_i_decomposition *d, uint32_t i)
{
    const uint32_t first = sunder_i_piece_first(d, i), end = d->piece_end[i];
    if (end < first + 3) return "a piece has under three corners";
    for (uint32_t k = first; k < end; k++) {
        const uint32_t next = k + 1 < end ? k + 1 : first;
        if (d->piece_corner[k] >= d->corners) return "a piece has a corner that is not there";
        if (!side_agrees(l, &d->corner[d->piece_corner[k]], &d->corner[d->piece_corner[next]], d->along[k]))
            return "a side does not run along its vector";
        if (sunder_i_cross_sign(l, d->along[k], d->along[next]) <= 0) return "a piece is not strictly convex";
        if (next != first && sunder_i_angle_cmp(l, d->along[k], d->along[next]) >= 0)
            return "the angles of a piece do not ascend from its first side";
    }
    return NULL;
}

static const char *check_corner(sunder_i_lattice *l, const sunder_shape *s, const sunder_i_point *at,
                                const sunder_i_decomposition *d, uint32_t i)
{
    sunder_i_arena *a = &l->arena;
    const sunder_i_corner *c = &d->corner[i];
    const sunder_i_big g = sunder_i_big_gcd(a, sunder_i_big_gcd(a, c->at.x, c->at.y), c->at.w);
    if (sunder_i_big_sign(c->at.w) <= 0 || sunder_i_big_cmp(g, sunder_i_big_i64(a, 1)))
        return "a corner is not in lowest terms";
    if (i >= s->vertices) return c->vertex != UINT32_MAX ? "a Steiner point is not said as one" : NULL;
    const sunder_i_rational_point v = sunder_i_rational_get(a, l, at[i]);
    if (c->vertex != i || sunder_i_big_sign(big_determinant(a, c->at.x, c->at.w, v.x, v.w)) != 0 ||
        sunder_i_big_sign(big_determinant(a, c->at.y, c->at.w, v.y, v.w)) != 0)
        return "a vertex does not stand where the shape has it";
    return NULL;
}

/* Tests that the pieces of the polygon, from number *i on, have its area; *i becomes the first piece of the next
 * polygon. Returns NULL, or a message. */
static const char *check_area(sunder_i_lattice *l, const sunder_shape *s, const sunder_i_point *at,
                              const sunder_i_decomposition *d, uint32_t polygon, uint32_t *i)
{
    sunder_i_arena *a = &l->arena;
    sunder_i_ratio sum = {{NULL, 0}, sunder_i_big_i64(a, 1)};
    sunder_i_ratio want = sum;
    const uint32_t ring_lo = polygon ? s->form->cleaned.poly_end[polygon - 1] : 0;
    for (uint32_t r = ring_lo; r < s->form->cleaned.poly_end[polygon]; r++)
        want = add_ratios(a, want,
                          ring_area(l, s, at, r ? s->form->cleaned.ring_end[r - 1] : 0, s->form->cleaned.ring_end[r]));
    for (; *i < d->pieces && d->member[*i] == polygon; ++*i) sum = add_ratios(a, sum, piece_area(a, d, *i));
    if (sunder_i_ratio_cmp(a, sum, want) != 0) return "the pieces of a member do not have its area";
    return NULL;
}

const char *sunder_i_decomposition_check(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                                         const sunder_i_decomposition *decomposition)
{
    const sunder_i_mark mark = sunder_i_arena_mark(&lattice->arena);
    const sunder_counts counts = lattice->counts; /* the tests are not counted as operations */
    const char *wrong = decomposition->corners < shape->vertices ? "vertices are missing" : NULL;
    for (uint32_t i = 0; i < decomposition->corners && !wrong; i++)
        wrong = check_corner(lattice, shape, at, decomposition, i);
    for (uint32_t i = 0; i < decomposition->pieces && !wrong; i++) wrong = check_piece(lattice, decomposition, i);
    uint32_t i = 0;
    for (uint32_t polygon = 0; polygon < shape->form->cleaned.polygons && !wrong; polygon++)
        wrong = check_area(lattice, shape, at, decomposition, polygon, &i);
    if (!wrong && i != decomposition->pieces) wrong = "pieces do not stand in the order of their members";
    lattice->counts = counts;
    if (lattice->arena.failed) return NULL; /* nothing could be tested */
    sunder_i_arena_release(&lattice->arena, mark);
    return wrong;
}
