/* hertel_mehlhorn.h: larger pieces for sums, by the rule of Hertel and Mehlhorn, with straight corners allowed.
 *
 * The pieces of a shape are strictly convex. A sum does not need that, and shapes such as walls with teeth or bars with
 * branches have far fewer pieces if a corner may be straight: the bar remains one piece. Fewer pieces in both operands
 * mean fewer subsums, since their number is the product, and fewer common boundaries between them. */
#ifndef SUNDER_I_HERTEL_MEHLHORN_H
#define SUNDER_I_HERTEL_MEHLHORN_H

#include "convex/pieces.h"

/* *out becomes the pieces of `shape`, merged across diagonals at whose ends no corner becomes reflex [HM83], with the
 * vertex number of each corner. at: the shape's vertices on the lattice. Returns false if out of memory. */
bool sunder_i_hertel_mehlhorn(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_convex_pieces *out);

#endif
