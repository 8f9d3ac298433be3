/* in_parts.h: a layer that memory does not hold, separated a part at a time (parts/), for --max-memory.
 *
 *   gis_in_parts_begin   reads the layer onto the disk, in a directory of its own
 *   gis_in_parts_open    opens it again, to be read by batches as it is written
 *   gis_in_parts_solve   all parts, and what borders cut
 *   gis_in_parts_write   the layers: the same bytes as of a layer that is separated whole */
#ifndef GIS_LAYER_IN_PARTS_H
#define GIS_LAYER_IN_PARTS_H

#include "base/interrupt.h"
#include "base/progress.h"
#include "layer/rows.h"
#include "layer/spooling.h"
#include "parts/join.h"

/* Zeroed: nothing. */
typedef struct gis_in_parts {
    const gis_layer_input_request *request;
    char *directory;
    gis_leftover *leftover;
    gis_layer_facts facts;
    gis_spool *spool;
    bool whole;       /* the source was opened to be held whole */
    unsigned at_once; /* so many shards of the spool are a part */
    gis_layout layout;
    gis_part_result result;
    gis_joined joined;
    GIntBig *first_fid; /* [joined.blocks] of those that are the first of their block */
} gis_in_parts;

/* Which layers are written. */
typedef struct gis_in_parts_layers {
    bool main, displacement, conflicts, pushes;
} gis_in_parts_layers;

/* memory: bytes that the work on a part may take, about. Refuses what cannot be done in parts. */
bool gis_in_parts_begin(const gis_layer_input_request *request, double memory, gis_in_parts *out, gis_error *error);
/* As gis_layer_input_read(), but for shapes, demands and the layer. whole: the source is not read by batches. */
bool gis_in_parts_open(gis_in_parts *parts, bool whole, gis_layer_input *out, gis_error *error);
bool gis_in_parts_solve(gis_in_parts *parts, const gis_layer_input *input, gis_progress *progress,
                        sunder_layer_summary *summary, gis_error *error);
bool gis_in_parts_write(gis_in_parts *parts, const gis_layer_input *input, const gis_in_parts_layers *layers,
                        gis_sink *sink, gis_error *error);
/* The FID of a feature that moved. */
GIntBig gis_in_parts_fid(const gis_in_parts *parts, size_t feature);
void gis_in_parts_clear(gis_in_parts *parts);

#endif
