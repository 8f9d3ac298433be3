/* Equal sets have equal canonical forms. */
#ifndef SUNDER_TEST_FUZZ_EQUAL_H
#define SUNDER_TEST_FUZZ_EQUAL_H

#include "sunder.h"

/* Ends the process unless the two sums have the same rings, segments and points, vertex for vertex. */
void fuzz_demand_equal(const sunder_sum *a, const sunder_sum *b);

#endif
