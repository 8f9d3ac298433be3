/* contact_group.h: groups of features that are connected in the input: each is within reach of another, or in the same
 * block. A group is solved as one piece of work, whatever its size, so the size of the largest should be known before
 * hours are spent. Moves may connect further features; that is only known when it happens. */
#ifndef GIS_CONTACT_GROUP_H
#define GIS_CONTACT_GROUP_H

#include "shards/parts/part.h"

typedef struct gis_contact_group {
    size_t features, vertices;
    double box[4];
} gis_contact_group;

/* Finds the largest group in terms of gis_part_bytes(). If it has at most `enough` bytes when boxes alone are compared,
 * *out may be larger than the group; otherwise shapes are compared, unless features are stacked. Fixed features connect
 * nothing. Memory is needed for the features along the borders of cells. */
bool gis_contact_group_find(const gis_layout *layout, double reach, double enough, gis_contact_group *out,
                            gis_error *error);

#endif
