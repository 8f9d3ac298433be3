/* layer_checksum.h: a checksum that detects changes of a layer since it was separated. It covers everything that
 * determines the moves, and nothing else. */
#ifndef GIS_LAYER_CHECKSUM_H
#define GIS_LAYER_CHECKSUM_H

#include "layer/layer_input.h"

/* Checksums of FIDs and geometries (gis_source_checksum()), of the results of --ignore-where, --fixed-where and
 * --rigid-where, and of the values of --id-field, --block-field, --max-shift-field, --weight-field, --rows,
 * --hierarchy-field, --symbol-field, --symbol-size-field and of the classes for gaps. Each is continued from feature to
 * feature, so the size of batches does not matter. A zeroed struct covers no features. */
enum { GIS_LAYER_CHECKSUMS = 13 };
typedef struct gis_layer_checksums {
    uint64_t of[GIS_LAYER_CHECKSUMS];
} gis_layer_checksums;

/* Continues the checksums with the features of an input that gis_layer_begin() opened, or of its current batch. */
bool gis_layer_checksums_add(gis_layer_checksums *sums, const gis_layer_input *input, gis_error *error);
/* Combines them into one number. */
uint64_t gis_layer_checksums_end(const gis_layer_checksums *sums);

/* Reads the layer again and computes its checksum as it is now. facts: what was found when it was read before. */
bool gis_layer_checksum(const gis_layer_input_request *request, const gis_source_facts *facts, uint64_t *checksum,
                        gis_error *error);

#endif
