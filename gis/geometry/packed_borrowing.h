/* packed_borrowing.h: all records of a layer once more, without the vertices that they have in common with shapes. */
#ifndef GIS_PACKED_BORROWING_H
#define GIS_PACKED_BORROWING_H

#include "geometry/packed.h"

/* record[i] becomes gis_packed_add_borrowing() of itself, unless it is NULL, for each of n, in `lean`, which has begun
 * and knows the shapes; those that they were stay where they are. layer: theirs. False if memory is out. */
bool gis_packed_borrow_all(gis_packed *lean, OGRLayerH layer, const unsigned char **record, size_t n, unsigned threads,
                           gis_error *error);

#endif
