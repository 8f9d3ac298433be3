/* few_corners.h: constants that all rings with few vertices share, so that they are stored once. */
#ifndef SUNDER_I_FEW_CORNERS_H
#define SUNDER_I_FEW_CORNERS_H

#include "shape/shape.h"

/* Buildings rarely have more vertices. */
#define SUNDER_I_FEW_CORNERS 16

/* Returns the form of one ring of n vertices, 3 to SUNDER_I_FEW_CORNERS, numbered from 0; they have different positions
 * and are doubles. The raw ring had between n and SUNDER_I_FEW_CORNERS + 1 vertices. */
const sunder_i_form *sunder_i_few_form(uint32_t n, size_t given);
/* Returns whether `of` is one of these forms. */
bool sunder_i_is_few_form(const sunder_i_form *of);
/* Returns the arrays of a convex ring, one piece: its end, followed by its vertices. */
const uint32_t *sunder_i_few_whole(uint32_t n);
#endif
