/* contact_group.h: what hangs together in a layer as it stands: features of which each is within reach of the next, or
 * that are of one block. Such are one piece of work, whatever their number, so that it is worth knowing before hours
 * are spent. Moves may make more hang together than does so at first: that is seen only when it happens. */
#ifndef GIS_CONTACT_GROUP_H
#define GIS_CONTACT_GROUP_H

#include "shards/parts/part.h"

typedef struct gis_contact_group {
    size_t features, vertices;
    double box[4];
} gis_contact_group;

/* The largest group by vertices and features, as gis_part_bytes() weighs them. Where that is no more than `enough` bytes
 * boxes alone are asked, and *out may be larger than what does hang together; where it is more, shapes are, unless
 * features lie in piles. Fixed features hang together with nothing: nobody waits for them. Takes memory for what lies
 * at the borders of cells. */
bool gis_contact_group_find(const gis_layout *layout, double reach, double enough, gis_contact_group *out,
                            gis_error *error);

#endif
