/* box_pairs.h: which boxes meet, swept from left to right. */
#ifndef GIS_BOX_PAIRS_H
#define GIS_BOX_PAIRS_H

#include "base/error.h"

#include <stddef.h>

typedef struct gis_swept {
    double box[4];
    size_t of; /* what the user knows it by; likewise: */
    int kind;
} gis_swept;

/* Zeroed: none. */
typedef struct gis_sweep {
    gis_swept *box;
    size_t n, room;
} gis_sweep;

/* An empty box (xmin > xmax) meets nothing. */
bool gis_sweep_add(gis_sweep *sweep, const double box[4], size_t of, int kind, gis_error *error);
/* Each pair once that has a point in common, in no order that would matter; changes the order of what was added. a does
 * not begin to the right of b. Of the two one may have seen enough: whom it would meet from now on, the other does. */
typedef enum gis_sweep_on { GIS_SWEEP_BOTH, GIS_SWEEP_A_ALONE, GIS_SWEEP_B_ALONE } gis_sweep_on;
typedef gis_sweep_on gis_sweep_meets(void *user, const gis_swept *a, const gis_swept *b);
void gis_sweep_run(gis_sweep *sweep, gis_sweep_meets *meets, void *user);
void gis_sweep_clear(gis_sweep *sweep);

#endif
