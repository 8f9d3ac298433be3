/* contact_group.h: groups of features that are connected as the layer stands: each is within reach of the next, or of
 * the same block. A group is solved as one piece of work, whatever its size, so the largest is worth knowing before
 * hours are spent. Moves may connect more than is connected at first: that shows only when it happens. */
#ifndef GIS_CONTACT_GROUP_H
#define GIS_CONTACT_GROUP_H

#include "shards/parts/part.h"

typedef struct gis_contact_group {
    size_t features, vertices;
    double box[4];
} gis_contact_group;

/* The largest group by vertices and features, in the measure of gis_part_bytes(). If it has at most `enough` bytes,
 * boxes alone are compared, and *out may be larger than the group; otherwise shapes are compared, unless features are
 * stacked. Fixed features connect nothing. Takes memory for the contents along the borders of cells. */
bool gis_contact_group_find(const gis_layout *layout, double reach, double enough, gis_contact_group *out,
                            gis_error *error);

#endif
