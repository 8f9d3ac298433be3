/* What two polygonal sets have in common, and how much one covers, by cutting them into vertical slabs. In rationals;
 * shares no code with the library. Sets of up to 64 members. */
#ifndef SUNDER_TESTS_SLABS_H
#define SUNDER_TESTS_SLABS_H

#include "polyset.h"

#include <gmp.h>
#include <stdbool.h>

/* Do the interiors of P and Q + (x, y) meet? NULLs for zero. */
bool interiors_meet(const polyset *p, const polyset *q, const mpq_t *x, const mpq_t *y);
/* Is some interior point of P outside Q? */
bool escapes(const polyset *p, const polyset *q);
/* The area of the union of the members, each taken by the even-odd rule. */
void area_by_slabs(mpq_t area, const polyset *set);

#endif
