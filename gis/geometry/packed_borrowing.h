/* packed_borrowing.h: copies all records of a layer without the vertices that they share with shapes. */
#ifndef GIS_PACKED_BORROWING_H
#define GIS_PACKED_BORROWING_H

#include "geometry/packed.h"

/* Replaces each of the n records that is not NULL by its copy in `lean` (gis_packed_add_borrowing()). `lean` must have
 * been begun, with lean->shape set; the old records stay in memory. layer: the layer of the records. Fails if memory is
 * out. */
bool gis_packed_borrow_all(gis_packed *lean, OGRLayerH layer, const unsigned char **record, size_t n, unsigned threads,
                           gis_error *error);

#endif
