/* A polygon of one ring, for tests of functions on shapes. */
#ifndef SUNDER_TESTS_SIMPLE_POLYGON_H
#define SUNDER_TESTS_SIMPLE_POLYGON_H

#include "sunder.h"

/* Makes the polygon of n vertices, which has to be valid; otherwise the test fails. The caller frees it. */
sunder_shape *simple_polygon(const double *xy, size_t n);

#endif
