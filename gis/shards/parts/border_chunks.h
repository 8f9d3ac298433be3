/* border_chunks.h: which chunks of the parts' files must be in memory while parts are joined: chunks with incomplete
 * worlds, and chunks whose box meets a chunk of another run or a world that was separated again. Every other chunk
 * shares no world with another run, and none of its worlds was written to where another run's world read. */
#ifndef GIS_BORDER_CHUNKS_H
#define GIS_BORDER_CHUNKS_H

#include "shards/parts/part_file.h"

typedef struct gis_border_chunk {
    gis_part_file *file;
    size_t chunk; /* number of the chunk in the file */
    bool held, wanted;
} gis_border_chunk;

/* The chunks of all parts' files. The caller sets file, files and runs; runs with numbers from `runs` on are
 * separations repeated in memory, and have no file. */
typedef struct gis_border_chunks {
    gis_part_file *file;
    size_t files;
    unsigned runs;
    gis_border_chunk *chunk;
    size_t chunks;
    size_t seen; /* number of worlds in the result that were compared with the chunks already */
} gis_border_chunks;

/* Lists all chunks, and adds those with incomplete worlds, or that meet a chunk of another run, to `held`. */
bool gis_border_chunks_load(gis_border_chunks *chunks, gis_part_result *held, gis_error *error);
/* Adds the chunks that meet a world of `held` that is new since the last call. */
bool gis_border_chunks_load_new(gis_border_chunks *chunks, gis_part_result *held, gis_error *error);
void gis_border_chunks_clear(gis_border_chunks *chunks);

#endif
