/* Whether two polygonal sets overlap or contain each other, and the area that a set covers, by cutting them into
 * vertical slabs. In rationals; shares no code with the library. Sets of up to 64 members. */
#ifndef SUNDER_TESTS_SLABS_H
#define SUNDER_TESTS_SLABS_H

#include "polyset.h"

#include <gmp.h>
#include <stdbool.h>

/* Do the interiors of P and Q + (x, y) meet? NULL means zero. */
bool interiors_meet(const polyset *p, const polyset *q, const mpq_t *x, const mpq_t *y);
/* Is an interior point of P outside Q? */
bool escapes(const polyset *p, const polyset *q);
/* The area of the union of the members, each by the even-odd rule. */
void area_by_slabs(mpq_t area, const polyset *set);

#endif
