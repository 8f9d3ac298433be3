/* border_chunks.h: which chunks of the parts' files have to be in memory while parts are joined: those with incomplete
 * worlds, and those that meet a chunk of another run, or a world that was separated again. All other chunks share no
 * world with another run, and none of their worlds wrote where another run's read. */
#ifndef GIS_BORDER_CHUNKS_H
#define GIS_BORDER_CHUNKS_H

#include "shards/parts/part_file.h"

typedef struct gis_border_chunk {
    gis_part_file *file;
    size_t chunk; /* of the file */
    bool held, wanted;
} gis_border_chunk;

/* file, files, runs are given: runs from that number on are no file's. */
typedef struct gis_border_chunks {
    gis_part_file *file;
    size_t files;
    unsigned runs;
    gis_border_chunk *chunk;
    size_t chunks;
    size_t seen; /* worlds of the result that were compared with chunks */
} gis_border_chunks;

/* The first, added to the result. */
bool gis_border_chunks_load(gis_border_chunks *chunks, gis_part_result *held, gis_error *error);
/* The second: with those worlds of the result that are new. */
bool gis_border_chunks_load_new(gis_border_chunks *chunks, gis_part_result *held, gis_error *error);
void gis_border_chunks_clear(gis_border_chunks *chunks);

#endif
