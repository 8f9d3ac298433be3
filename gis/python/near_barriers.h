/* near_barriers.h: which barriers are within reach of a layer. The program reads no others; here they are left out, so
 * that the result is the same. */
#ifndef GIS_PYTHON_NEAR_BARRIERS_H
#define GIS_PYTHON_NEAR_BARRIERS_H

#include "sunder.h"

/* The boxes near which barriers matter. NULL: memory is out, or there are none. */
typedef struct gis_py_targets gis_py_targets;

/* Makes targets of n features that are not ignored. reach: the longest move. anchor: NULL, or the point of each
 * feature, by which alone its side is decided. *no_memory is set if memory is out. */
gis_py_targets *gis_py_targets_new(const sunder_feature *feature, const double *anchor, size_t n, double reach,
                                   bool *no_memory);
/* Is the barrier within reach, if features keep `distance` from its drawn edge? */
bool gis_py_is_near(const gis_py_targets *targets, const sunder_barrier *barrier, double distance);
void gis_py_targets_free(gis_py_targets *targets);

#endif
