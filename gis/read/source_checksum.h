/* source_checksum.h: a number that tells whether a layer is what it was. */
#ifndef GIS_SOURCE_CHECKSUM_H
#define GIS_SOURCE_CHECKSUM_H

#include "read/source.h"

#include <stdint.h>

/* Goes on from a checksum (0: from none) over the FIDs and the geometries of the features, in their order; of a source
 * that is read by batches those of the batch. However many are read at a time, and packed or not, it comes to the
 * same. */
bool gis_source_checksum(const gis_source *source, uint64_t *checksum, gis_error *error);

#endif
