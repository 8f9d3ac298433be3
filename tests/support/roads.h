/* The algorithms for a sum, for tests that they all give the same result. */
#ifndef SUNDER_TESTS_ROADS_H
#define SUNDER_TESTS_ROADS_H

#include "polyset.h"

#define ROAD_ALGORITHMS 3 /* the algorithms that unite subsums */
#define ROAD_DECOMPOSITIONS 6
#define ROAD_ORDERS 3
#define ROADS (ROAD_ALGORITHMS * ROAD_DECOMPOSITIONS * ROAD_ORDERS)

/* Returns number i of the ROADS combinations of algorithm, decomposition and order, with a seed. Neighbours differ in
 * the algorithm, then in the decomposition. */
sunder_sum_options road_options(size_t i, uint64_t seed);
/* Returns the canonical text of the sum by one algorithm, on big integers throughout if force_wide; NULL if it fails.
 * Checks the statistics of the sum. */
char *road_text(const sunder_shape *p, const sunder_shape *q, const sunder_sum_options *how, bool force_wide);
/* Is that the text `want`? If not, and if `shown`, prints the operands. */
bool road_agrees(const polyset *p, const polyset *q, const sunder_sum_options *how, bool force_wide, const char *want,
                 bool shown);

#endif
