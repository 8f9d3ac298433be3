/* Larger pieces for sums: Hertel and Mehlhorn's rule, straight corners allowed.
 *
 * The pieces of a shape are strictly convex. A sum does not need that, and walls with teeth, bars with branches and the
 * like fall into far fewer pieces if a corner may be straight: the bar stays whole. Fewer pieces on both sides mean
 * fewer subsums in the product of the two, and fewer seams between them. */
#ifndef SUNDER_I_HERTEL_MEHLHORN_H
#define SUNDER_I_HERTEL_MEHLHORN_H

#include "convex/pieces.h"

/* The pieces of a shape, joined across diagonals at whose ends no corner becomes reflex [HM83], with the vertex at each
 * corner. at: the shape's vertices on the lattice. False if memory is out. */
bool sunder_i_hertel_mehlhorn(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_convex_pieces *out);

#endif
