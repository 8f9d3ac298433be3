/* Compares a canonical sum, as text, with its known properties. */
#ifndef SUNDER_TESTS_EXPECT_H
#define SUNDER_TESTS_EXPECT_H

#include "json.h"
#include "polyset.h"

/* Exact area of the polygons of a canonical text, as "num/den"; freed by the caller. */
char *expect_area(const json *sum);

/* Compares the canonical text of a sum with a record of ../shared/cases (its README describes the fields): area,
 * points, segments, the boundary as a set of directed pieces and, if no rings touch, the number of rings. Returns NULL
 * if they agree, otherwise a sentence, freed by the caller. */
char *expect_compare(const char *sum_text, const json *record);

#endif
