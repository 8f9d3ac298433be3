/* Sums of polygons with convex ones, by the convolution's curve where that is all there is to them. */
#ifndef SUNDER_I_CONVOLUTION_H
#define SUNDER_I_CONVOLUTION_H

#include "shape/shape.h"
#include "sum/canonical_sum.h"

/* A polygon of p, and one of q, which is convex. */
typedef struct sunder_i_round {
    const sunder_shape *p, *q;
    const sunder_i_point *at_p, *at_q; /* the vertices on the lattice */
    uint32_t polygon, convex;          /* of p and of q */
} sunder_i_round;

static inline uint32_t sunder_i_round_first_ring(const sunder_i_round *r)
{
    return r->polygon ? r->p->form->cleaned.poly_end[r->polygon - 1] : 0;
}

/* The convex polygon has one ring. */
static inline uint32_t sunder_i_round_first_corner(const sunder_i_round *r)
{
    const uint32_t ring = r->q->form->cleaned.poly_end[r->convex] - 1;
    return ring ? r->q->form->cleaned.ring_end[ring - 1] : 0;
}

static inline uint32_t sunder_i_round_corners(const sunder_i_round *r)
{
    return r->q->form->cleaned.ring_end[r->q->form->cleaned.poly_end[r->convex] - 1] - sunder_i_round_first_corner(r);
}

/* What has been traced so far: rings of components that are apart, over the vertices of a sum. */
typedef struct sunder_i_traced {
    sunder_sum *sum;  /* stands on a narrow lattice; its vertices are those of the rings */
    uint32_t *vertex; /* the rings, one after the other */
    sunder_i_found_ring *ring;
    size_t rings, room, ring_room, vertex_room;
    uint32_t components;
} sunder_i_traced;

/* At most this many rings take part in one curve: each is located by testing all others, or their boxes. */
#define SUNDER_I_MOST_CURVES 512

/* Adds the union of the sums of some rounds, and sets *done; leaves all as it was where the curve does not prove the
 * result: the general road has to be taken then. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_convolution_trace(sunder_i_traced *to, const sunder_i_round *round, size_t rounds, bool *done,
                                         sunder_error *err);
/* Moves the traced rings into the sum, in canonical order, and frees the rest. With `keep` false, or on failure, the
 * sum stays empty. */
sunder_status sunder_i_traced_end(sunder_i_traced *traced, bool keep, sunder_error *err);

/* The sum of one polygon and a convex one: fills in the vertices and rings of `sum`, which stands on a lattice that
 * both operands are placed on, and sets *done. Changes neither where the curve does not prove the result. */
sunder_status sunder_i_convolution_sum(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p,
                                       const sunder_shape *q, const sunder_i_point *at_q, bool *done,
                                       sunder_error *err);

#endif
