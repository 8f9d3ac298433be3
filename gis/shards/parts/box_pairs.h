/* box_pairs.h: which boxes meet, swept from left to right. */
#ifndef GIS_BOX_PAIRS_H
#define GIS_BOX_PAIRS_H

#include "base/gis_error.h"

#include <stddef.h>

typedef struct gis_paired_box {
    double box[4];
    size_t of; /* what the user knows it by; likewise: */
    int kind;
} gis_paired_box;

/* Zeroed: none. */
typedef struct gis_box_pairs {
    gis_paired_box *box;
    size_t n, room;
} gis_box_pairs;

/* An empty box (xmin > xmax) meets nothing. */
bool gis_box_pairs_add(gis_box_pairs *pairs, const double box[4], size_t of, int kind, gis_error *error);
/* Each pair once that has a point in common, in no order that would matter; changes the order of what was added. a does
 * not begin to the right of b. Of the two one may have seen enough: what it would meet from now on, the other does. */
typedef enum gis_box_pairs_next { GIS_BOX_PAIRS_BOTH, GIS_BOX_PAIRS_A_ONLY, GIS_BOX_PAIRS_B_ONLY } gis_box_pairs_next;
typedef gis_box_pairs_next gis_box_pairs_visitor(void *user, const gis_paired_box *a, const gis_paired_box *b);
void gis_box_pairs_visit(gis_box_pairs *pairs, gis_box_pairs_visitor *meets, void *user);
void gis_box_pairs_clear(gis_box_pairs *pairs);

#endif
