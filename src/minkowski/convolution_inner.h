/* What the files of the convolution share: the curve and its crossings. Internal to convolution*.c. */
#ifndef SUNDER_I_CONVOLUTION_INNER_H
#define SUNDER_I_CONVOLUTION_INNER_H

#include "minkowski/convolution.h"
#include "predicate/narrow.h"

/* Closed polylines, one for each ring of each round's P, that follow each other in corner[]. They are made of chains:
 * moved sides, arcs of v + Q at convex vertices, chords at reflex ones. Vertices of P are numbered through all
 * rounds. */
typedef struct sunder_i_chain {
    int64_t low[2], high[2];
    uint32_t first, end; /* links */
    uint32_t vertex;     /* of P, where the side leaves or the arc or chord stands */
    bool side;
} sunder_i_chain;

/* A crossing as seen from one of its two links. */
typedef struct sunder_i_stop {
    uint32_t link, partner; /* partner: the stop of the other link */
    sunder_i_fraction at;   /* along the link */
    bool rises;             /* the link goes to the left of the other one */
} sunder_i_stop;

typedef struct sunder_i_convolution {
    sunder_i_lattice *lattice;
    sunder_i_arena memory; /* the work and its scratch memory */
    const sunder_i_round *round;
    size_t rounds;
    uint32_t rings, vertices; /* of all rounds' P */
    uint32_t links;
    sunder_i_point *corner; /* [links] where each link starts */
    uint32_t *next;         /* [links] the link that starts where this one ends */
    uint32_t *ring_end;     /* [rings] in links */
    bool *left_out;         /* [rings] holes of no consequence: they have no links */
    bool *chord;            /* [links] */
    sunder_i_chain *chain;
    uint32_t chains;
    uint32_t *after;    /* [vertices] the next one of the ring */
    bool *joined;       /* [vertices] sides meet there, without arc or chord */
    bool *reflex;       /* [vertices] */
    uint32_t *stop_end; /* [links] past the last stop on each; stops of a link in its direction */
    sunder_i_stop *stop;
    size_t stops, stops_capacity;
} sunder_i_convolution;

/* Builds the curve of the rounds; *fits is false where a P or Q is of no kind that this is for. Fails only with
 * SUNDER_ENOMEM. */
sunder_status sunder_i_convolution_build(sunder_i_convolution *curve, bool *fits, sunder_error *err);
/* Finds all stops; *fits is false where anything but two links that cross in their insides meets, or it takes
 * too long. */
sunder_status sunder_i_convolution_cross(sunder_i_convolution *curve, bool *fits, sunder_error *err);

static inline uint32_t sunder_i_convolution_first(const sunder_i_convolution *curve, uint32_t ring)
{
    return ring ? curve->ring_end[ring - 1] : 0;
}

#endif
