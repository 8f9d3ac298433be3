/* The rungs of sunder_orient(), each by itself so that tests can force them. */
#ifndef SUNDER_I_ORIENT_DOUBLE_H
#define SUNDER_I_ORIENT_DOUBLE_H

#include "predicate/predicate.h"

#define SUNDER_I_UNSURE 2

/* Floating point with a proved bound: +1, -1 or SUNDER_I_UNSURE. */
int sunder_i_orient_filter(const sunder_point *a, const sunder_point *b, const sunder_point *c);
/* Native integers on a narrow lattice (SUNDER_I_UNSURE where the points do not fit), or big ones on a wide lattice
 * (SUNDER_I_UNSURE only when memory is out). */
int sunder_i_orient_lattice(const sunder_point *a, const sunder_point *b, const sunder_point *c, bool force_wide);

#endif
