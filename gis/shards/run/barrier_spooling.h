/* barrier_spooling.h: writes the barriers within reach of the features of a spool to disk, for a layer that is
 * separated in parts. */
#ifndef GIS_BARRIER_SPOOLING_H
#define GIS_BARRIER_SPOOLING_H

#include "layer/layer_input.h"
#include "shards/spool/spool.h"

/* Like gis_barriers_read(), but writes the barriers of the request to disk (shards/spool/barrier_spool.h) in bounded
 * memory. */
bool gis_barriers_spool(const gis_layer_input *input, const gis_barrier_surroundings *around, const char *directory,
                        gis_error *error);
/* Makes targets of the boxes of all features of a spool, which is borrowed and read a cell at a time. `reach` is the
 * distance within which barriers count. */
gis_barrier_targets *gis_barrier_targets_of_spool(gis_spool *spool, double reach);

#endif
