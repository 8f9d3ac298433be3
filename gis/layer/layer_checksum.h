/* layer_checksum.h: a number that tells whether a layer is what it was when it was separated: of all that decides which
 * features move where, and of nothing else. */
#ifndef GIS_LAYER_CHECKSUM_H
#define GIS_LAYER_CHECKSUM_H

#include "layer/layer_input.h"

/* Sums of FIDs and geometries (gis_source_checksum()), of whether --ignore-where and --fixed-where hold, and of the
 * values of --id-field, --block-field, --max-shift-field, --weight-field, --symbol-field and --symbol-size-field.
 * Each sum is continued from feature to feature, so the number of features read at a time does not matter. A zeroed
 * struct holds the sums of no features. */
enum { GIS_LAYER_CHECKSUMS = 9 };
typedef struct gis_layer_checksums {
    uint64_t of[GIS_LAYER_CHECKSUMS];
} gis_layer_checksums;

/* Goes on over the features of an input that gis_layer_begin() opened, or of its batch. */
bool gis_layer_checksums_add(gis_layer_checksums *sums, const gis_layer_input *input, gis_error *error);
/* One number of all of them. */
uint64_t gis_layer_checksums_end(const gis_layer_checksums *sums);

/* The number as it is now: the layer is read, and that is all. facts: what was found when it was read before. */
bool gis_layer_checksum(const gis_layer_input_request *request, const gis_source_facts *facts, uint64_t *checksum,
                        gis_error *error);

#endif
