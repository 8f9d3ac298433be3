/* convolution.h: sums of polygons with convex polygons, computed from the curve of their convolution, if that curve is
 * tame. */
#ifndef SUNDER_I_CONVOLUTION_H
#define SUNDER_I_CONVOLUTION_H

#include "shape/shape.h"
#include "sum/canonical_sum.h"
#include "sunder_sum.h"

/* A pair of a polygon of p and a polygon of q, which is convex. */
typedef struct sunder_i_round {
    const sunder_shape *p, *q;
    const sunder_i_point *at_p, *at_q; /* the vertices of p and q on the lattice */
    uint32_t polygon, convex;          /* the number of the polygon of p, and of that of q */
} sunder_i_round;

static inline uint32_t sunder_i_round_first_ring(const sunder_i_round *r)
{
    return r->polygon ? r->p->form->cleaned.poly_end[r->polygon - 1] : 0;
}

/* Returns the first corner of the convex polygon, which has one ring. */
static inline uint32_t sunder_i_round_first_corner(const sunder_i_round *r)
{
    const uint32_t ring = r->q->form->cleaned.poly_end[r->convex] - 1;
    return ring ? r->q->form->cleaned.ring_end[ring - 1] : 0;
}

static inline uint32_t sunder_i_round_corners(const sunder_i_round *r)
{
    return r->q->form->cleaned.ring_end[r->q->form->cleaned.poly_end[r->convex] - 1] - sunder_i_round_first_corner(r);
}

/* The result so far: the rings of disjoint components, over the vertices of a sum. */
typedef struct sunder_i_traced {
    sunder_sum *sum;  /* its lattice is narrow; its vertices are those of the rings */
    uint32_t *vertex; /* the vertex numbers of the rings, ring by ring */
    sunder_i_found_ring *ring;
    size_t rings, room, ring_room, vertex_room;
    uint32_t components;
} sunder_i_traced;

/* The largest number of rings in one curve: each is located by testing it against all others, or their boxes. */
#define SUNDER_I_MOST_CURVES 512

/* Adds the union of the sums of several rounds and sets *done; if the curve does not prove the result, *done is false,
 * nothing is changed, and the general method must be used. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_convolution_trace(sunder_i_traced *to, const sunder_i_round *round, size_t rounds, bool *done,
                                         sunder_error *err);
/* Moves the traced rings into the sum, in canonical order, and frees the rest. If `keep` is false, or on failure, the
 * sum becomes empty. */
sunder_status sunder_i_traced_end(sunder_i_traced *traced, bool keep, sunder_error *err);

/* Sets the vertices and rings of `sum` to the sum of a polygon p and a convex polygon q, and sets *done. The sum's
 * lattice must contain the vertices at_p and at_q. If the curve does not prove the result, *done is false and nothing
 * is changed. */
sunder_status sunder_i_convolution_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                       const sunder_shape *q, const sunder_i_point *at_q, bool *done,
                                       sunder_error *err);

#endif
