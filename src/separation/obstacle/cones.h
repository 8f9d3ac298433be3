/* The cones of the interior at the convex vertices of an operand, in doubles, and which of them an edge of the other
 * may meet. */
#ifndef SUNDER_I_CONES_H
#define SUNDER_I_CONES_H

#include "separation/operands/operands.h"

/* At (x, y); in, out: the edges that arrive and leave. */
typedef struct sunder_i_cone {
    double x, y, in_x, in_y, out_x, out_y;
} sunder_i_cone;

/* False: the vertex is reflex for certain, and no edge that passes it can be boundary there. */
bool sunder_i_cone_of(const sunder_i_operands *operands, int side, uint32_t vertex, sunder_i_cone *out);

/* All of one operand, in the order of their vertices. */
typedef struct sunder_i_cones {
    uint32_t n;
    uint32_t *vertex;
    double *x, *y, *in_x, *in_y, *out_x, *out_y;
    /* All directions in sectors: `sector` lists cones that an edge in that sector may meet, ascending. Not made where
     * it saves nothing (sectors == 0). */
    uint32_t sectors, *sector_end, *sector;
} sunder_i_cones;

/* Memory: the lattice's arena; false if it is out. */
bool sunder_i_cones_find(sunder_i_operands *operands, int side, sunder_i_cones *cones);

/* The cones whose two edges enclose the direction (dx, dy), ends included, ascending; more where doubles do not say.
 * met: room for cones->n + 1. Returns how many; *looked_at: of how many it was asked. */
uint32_t sunder_i_cones_met(const sunder_i_operands *operands, const sunder_i_cones *cones, double dx, double dy,
                            uint32_t *met, uint32_t *looked_at);

#endif
