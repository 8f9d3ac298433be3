/* What is the same for all rings of so few corners, and so is kept once. */
#ifndef SUNDER_I_FEW_CORNERS_H
#define SUNDER_I_FEW_CORNERS_H

#include "shape/shape.h"

/* Buildings have more corners seldom. */
#define SUNDER_I_FEW_CORNERS 16

/* One ring of n corners, 3 to SUNDER_I_FEW_CORNERS, numbered from 0 along it; they stand in different places and are
 * doubles. The ring was given with n to SUNDER_I_FEW_CORNERS + 1 vertices. */
const sunder_i_form *sunder_i_few_form(uint32_t n, size_t given);
/* Is it one of these? */
bool sunder_i_is_few_form(const sunder_i_form *of);
/* All of them as one piece: its end, and behind that its corners. */
const uint32_t *sunder_i_few_whole(uint32_t n);
#endif
