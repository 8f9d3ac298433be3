/* Larger pieces for sums: straight corners allowed.
 *
 * The pieces of a shape are strictly convex. A sum does not need that, and walls with teeth, bars with branches and the
 * like fall into far fewer pieces if a corner may be straight: the bar stays whole. Fewer pieces on both sides mean
 * fewer subsums in the product of the two, and fewer seams between them. */
#ifndef SUNDER_I_JOIN_H
#define SUNDER_I_JOIN_H

#include "shape/shape.h"

typedef struct sunder_i_joined {
    uint32_t pieces;
    uint32_t *end;    /* [pieces] */
    uint32_t *vertex; /* corners, counter-clockwise; convex, straight ones included */
} sunder_i_joined;

/* The pieces of a shape, joined across diagonals at whose ends no corner becomes reflex (Hertel and Mehlhorn's rule
 * [HM83]). at: the shape's vertices on the lattice. False if memory is out. */
bool sunder_i_join_pieces(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                          sunder_i_joined *out);
void sunder_i_joined_free(sunder_i_joined *joined);

#endif
