/* convolution_inner.h: the curve and its crossings, shared by convolution*.c only. */
#ifndef SUNDER_I_CONVOLUTION_INNER_H
#define SUNDER_I_CONVOLUTION_INNER_H

#include "minkowski/convolution.h"
#include "predicate/narrow.h"

/* A chain: links that are a translated side, an arc of v + Q at a convex vertex, or the chord at a reflex one. The
 * curve consists of closed polylines, one for each ring of each round's P, one after the other in corner[]. The
 * vertices of P are numbered through all rounds. */
typedef struct sunder_i_chain {
    int64_t low[2], high[2];
    uint32_t first, end; /* the links [first, end) */
    uint32_t vertex;     /* the vertex of P that the side leaves, or at which the arc or chord is */
    bool side;
} sunder_i_chain;

/* A crossing, as a position on one of its two links. */
typedef struct sunder_i_stop {
    uint32_t link, partner; /* partner: the stop of the other link */
    sunder_i_fraction at;   /* the position along the link */
    bool rises;             /* the link crosses to the left side of the other one */
} sunder_i_stop;

typedef struct sunder_i_convolution {
    sunder_i_lattice *lattice;
    sunder_i_arena memory; /* memory for the curve and temporary arrays */
    const sunder_i_round *round;
    size_t rounds;
    uint32_t rings, vertices; /* the totals over all rounds' P */
    uint32_t links;
    sunder_i_point *corner; /* [links] the beginning of each link */
    uint32_t *next;         /* [links] the link that starts where this one ends */
    uint32_t *ring_end;     /* [rings] the index after the last link of each ring */
    bool *left_out;         /* [rings] whether the ring is an omitted hole, which has no links */
    bool *chord;            /* [links] whether the link is a chord */
    sunder_i_chain *chain;
    uint32_t chains;
    uint32_t *after;    /* [vertices] the next vertex of the ring */
    bool *joined;       /* [vertices] whether the sides meet there, without arc or chord */
    bool *reflex;       /* [vertices] whether the vertex of P is reflex */
    uint32_t *stop_end; /* [links] the index after the last stop of each link; the stops of a link are sorted in its
                         * direction */
    sunder_i_stop *stop;
    size_t stops, stops_capacity;
} sunder_i_convolution;

/* Constructs the curve of the rounds; *fits becomes false if a P or Q is not of the required kind. Fails only with
 * SUNDER_ENOMEM. */
sunder_status sunder_i_convolution_build(sunder_i_convolution *curve, bool *fits, sunder_error *err);
/* Finds all stops; *fits becomes false if links meet in any way other than two links crossing in their interiors, or if
 * it takes too long. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_convolution_cross(sunder_i_convolution *curve, bool *fits, sunder_error *err);

static inline uint32_t sunder_i_convolution_first(const sunder_i_convolution *curve, uint32_t ring)
{
    return ring ? curve->ring_end[ring - 1] : 0;
}

#endif
