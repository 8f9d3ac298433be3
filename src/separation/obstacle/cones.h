/* The cones of the interior at the convex vertices of an operand, as ranges of directions, and which of them an edge of
 * the other may meet. */
#ifndef SUNDER_I_CONES_H
#define SUNDER_I_CONES_H

#include "separation/operands/pair_operands.h"
#include "spatial/lanes.h"

/* The direction of an edge: a number that grows with the angle, a whole turn being 2^32, so that differences come round
 * by themselves. vague: the ends are so near to each other, for what is known of them, that it may be any. */
typedef struct sunder_i_direction {
    uint32_t at;
    bool vague;
} sunder_i_direction;

sunder_i_direction sunder_i_direction_of(const sunder_i_operands *operands, double dx, double dy);

/* The directions at to at + width, between those of the edges that arrive at a vertex and leave it, widened by all that
 * is uncertain about them, and about an edge that is asked about. */
typedef struct sunder_i_cone {
    uint32_t at, width;
} sunder_i_cone;

/* False: the vertex is reflex for certain, and no edge that passes it can be boundary there. */
bool sunder_i_cone_of(const sunder_i_operands *operands, int side, uint32_t vertex, sunder_i_cone *out);

/* Do the two edges of the cone enclose the direction, ends included? True too where that is in doubt. */
static inline bool sunder_i_cone_meets(sunder_i_cone cone, sunder_i_direction edge)
{
    return (edge.at - cone.at <= cone.width) | edge.vague;
}

/* All of one operand, in the order of their vertices. */
typedef struct sunder_i_cones {
    uint32_t *direction; /* of the edge that leaves each vertex, also those that have no cone */
    bool *vague;         /* NULL: none of them is */
    uint32_t n, *vertex;
    uint32_t *at, *width; /* of each cone; past the last stand SUNDER_I_LANES - 1 more that may be read */
    /* All directions in equal sectors, a power of two: `sector` lists cones that an edge in that sector may meet,
     * ascending. Not made where it saves nothing (sectors == 0). */
    uint32_t sectors, *sector_end, *sector;
    int shift; /* sector = direction >> shift */
} sunder_i_cones;

static inline sunder_i_direction sunder_i_cones_edge(const sunder_i_cones *cones, uint32_t v)
{
    return (sunder_i_direction){cones->direction[v], cones->vague && cones->vague[v]};
}

/* Memory: the lattice's arena; false if it is out. */
bool sunder_i_cones_find(sunder_i_operands *operands, int side, sunder_i_cones *cones);

/* With at most this many cones, those that an edge may meet are the bits of a word. */
#define SUNDER_I_CONES_FEW 32

/* Of n edges, those that leave vertices `first` and so on, whose cones these are not: met[k] for the k-th. Four cones
 * stay at hand for all of the edges. */
static inline void sunder_i_cones_met_few(const sunder_i_cones *c, const sunder_i_cones *edges, uint32_t first,
                                          uint32_t n, uint32_t *met)
{
    const uint32_t all = (uint32_t)(((uint64_t)1 << c->n) - 1), *direction = edges->direction + first;
    for (uint32_t i = 0; i < n; i++) met[i] = edges->vague && edges->vague[first + i] ? all : 0;
    for (uint32_t k = 0; k < c->n; k += SUNDER_I_LANES) {
        const sunder_i_lanes from = sunder_i_lanes_at(c->at + k), width = sunder_i_lanes_at(c->width + k);
        for (uint32_t i = 0; i < n; i++)
            met[i] |= sunder_i_lanes_set(sunder_i_lanes_up_to(direction[i] - from, width)) << k & all;
    }
}

/* The cones that an edge may meet, ascending: a superset. met: room for cones->n + 1. Returns how many; *looked_at: the
 * number of cones tested. */
uint32_t sunder_i_cones_met(const sunder_i_cones *cones, sunder_i_direction edge, uint32_t *met, uint32_t *looked_at);

#endif
