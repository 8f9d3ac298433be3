/* box_pairs.h: finds all pairs of boxes that meet, by a sweep from left to right. */
#ifndef GIS_BOX_PAIRS_H
#define GIS_BOX_PAIRS_H

#include "base/gis_error.h"

#include <stddef.h>

typedef struct gis_paired_box {
    double box[4];
    size_t of; /* the user's number for the box, and the user's own classification: */
    int kind;
} gis_paired_box;

/* A list of boxes. A zeroed list is empty. */
typedef struct gis_box_pairs {
    gis_paired_box *box;
    size_t n, room;
} gis_box_pairs;

/* Adds a box. An empty box (xmin > xmax) meets nothing and is left out. */
bool gis_box_pairs_add(gis_box_pairs *pairs, const double box[4], size_t of, int kind, gis_error *error);
/* What a visitor returns about a pair: go on with both boxes, or with only one of them, if everything that the other
 * one would meet from now on is met by that one as well. */
typedef enum gis_box_pairs_next { GIS_BOX_PAIRS_BOTH, GIS_BOX_PAIRS_A_ONLY, GIS_BOX_PAIRS_B_ONLY } gis_box_pairs_next;
typedef gis_box_pairs_next gis_box_pairs_visitor(void *user, const gis_paired_box *a, const gis_paired_box *b);
void gis_box_pairs_visit(gis_box_pairs *pairs, gis_box_pairs_visitor *meets, void *user);
void gis_box_pairs_clear(gis_box_pairs *pairs);

#endif
