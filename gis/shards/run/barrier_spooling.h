/* barrier_spooling.h: barriers onto the disk, for a layer in parts: those within reach of the features of a spool. */
#ifndef GIS_BARRIER_SPOOLING_H
#define GIS_BARRIER_SPOOLING_H

#include "layer/barriers/barrier.h"
#include "shards/spool/spool.h"

/* As gis_barriers_read(), but onto the disk (shards/spool/barrier_spool.h) and in bounded memory. */
bool gis_barriers_spool(const gis_barrier_request *requests, size_t n, const gis_barrier_surroundings *around,
                        const char *directory, gis_error *error);
/* The boxes of all features of a spool, which is borrowed: looked up there, a cell at a time. reach: of moves. */
gis_barrier_targets *gis_barrier_targets_of_spool(gis_spool *spool, double reach);

#endif
