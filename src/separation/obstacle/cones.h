/* cones.h: the convex vertices of an operand as ranges of directions, the cones of its interior at these vertices, and
 * which of them an edge of the other operand may meet. */
#ifndef SUNDER_I_CONES_H
#define SUNDER_I_CONES_H

#include "separation/operands/pair_operands.h"
#include "spatial/lanes.h"

/* The direction of an edge: a number that increases with the angle; a full turn is 2^32, so that differences are
 * cyclic. vague: the ends are so close, compared with their errors, that every direction is possible. */
typedef struct sunder_i_direction {
    uint32_t at;
    bool vague;
} sunder_i_direction;

sunder_i_direction sunder_i_direction_of(const sunder_i_operands *operands, double dx, double dy);

/* The directions from at to at + width, between those of the edges that arrive at a vertex and leave it, enlarged by
 * their errors and by that of a tested edge. */
typedef struct sunder_i_cone {
    uint32_t at, width;
} sunder_i_cone;

/* Computes the cone of a vertex. Returns false if the vertex is certainly reflex: then no edge at it can belong to the
 * boundary there. */
bool sunder_i_cone_of(const sunder_i_operands *operands, int side, uint32_t vertex, sunder_i_cone *out);

/* Returns whether the direction lies between the two edges of the cone, inclusive; true also if this is uncertain. */
static inline bool sunder_i_cone_meets(sunder_i_cone cone, sunder_i_direction edge)
{
    return (edge.at - cone.at <= cone.width) | edge.vague;
}

/* The cones of one operand, in the order of their vertices. */
typedef struct sunder_i_cones {
    uint32_t *direction; /* the direction of the edge that leaves each vertex, also of vertices without a cone */
    bool *vague;         /* NULL: no direction is vague */
    uint32_t n, *vertex;
    uint32_t *at, *width; /* of each cone; SUNDER_I_LANES - 1 further elements may be read */
    /* The directions divided into `sectors` equal sectors, a power of two: `sector` lists the cones that an edge in
     * each sector may meet, ascending. sectors == 0: not built, since it would not save time. */
    uint32_t sectors, *sector_end, *sector;
    int shift; /* sector = direction >> shift */
} sunder_i_cones;

static inline sunder_i_direction sunder_i_cones_edge(const sunder_i_cones *cones, uint32_t v)
{
    return (sunder_i_direction){cones->direction[v], cones->vague && cones->vague[v]};
}

/* Computes the cones of an operand, in the lattice's arena. Returns false if out of memory. */
bool sunder_i_cones_find(sunder_i_operands *operands, int side, sunder_i_cones *cones);

/* With at most this number of cones, the set that an edge may meet is stored in a word. */
#define SUNDER_I_CONES_FEW 32

/* Sets met[k] to the set of cones of c that edge first + k may meet, for n edges of the other operand, whose cones are
 * `edges`. Four cones at a time are kept in registers for all edges. */
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

/* Writes the numbers of the cones that an edge may meet to `met`, ascending; a superset. met has room for cones->n + 1.
 * Returns their number; *looked_at becomes the number of cones tested. */
uint32_t sunder_i_cones_met(const sunder_i_cones *cones, sunder_i_direction edge, uint32_t *met, uint32_t *looked_at);

#endif
