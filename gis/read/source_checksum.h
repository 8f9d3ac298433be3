/* source_checksum.h: a checksum that detects whether a layer has changed. */
#ifndef GIS_SOURCE_CHECKSUM_H
#define GIS_SOURCE_CHECKSUM_H

#include "read/source.h"

#include <stdint.h>

/* Continues a checksum (0: begins one) with the FIDs and geometries of the features, in order; for a source that is
 * read in batches, those of the current batch. The result does not depend on the size of batches, or on packing. */
bool gis_source_checksum(const gis_source *source, uint64_t *checksum, gis_error *error);

#endif
