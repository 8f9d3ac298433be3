/* part_file.h: results of parts on disk: a file of chunks, each with the box of all that its worlds read or wrote. A
 * file exists completely, or not at all.
 *
 * A chunk holds some dozen neighbouring worlds of one run, so that most chunks do not meet any of another run, and can
 * stay on disk. Results outside of worlds are in a chunk of their own, without a box. Lines of proofs, which are long,
 * stay in the file until they are needed. */
#ifndef GIS_PART_FILE_H
#define GIS_PART_FILE_H

#include "disk/file.h"
#include "shards/parts/part_result.h"

/* What a file was made of. */
typedef struct gis_part_stamp {
    char version[24];       /* of the program */
    uint64_t options;       /* checksum of the command line */
    uint64_t spool;         /* the layer's checksum */
    uint32_t shard, shards; /* 1 to shards */
} gis_part_stamp;

typedef struct gis_part_chunk {
    double box[4]; /* xmin ymin xmax ymax; box[0] > box[2]: no world of it read or wrote anything */
    uint64_t from, bytes, checksum;
    uint64_t lines, lines_checksum; /* bytes of the lines of proofs before it */
    uint32_t run;
    uint32_t incomplete; /* some world of it is */
} gis_part_chunk;

/* Zeroed: none. */
typedef struct gis_part_file {
    gis_disk_file file;
    gis_part_stamp stamp;
    gis_part_chunk *chunk;
    size_t chunks, room;
    uint64_t places;      /* features of the layer and barriers, to which what is read is held; 0: unknown */
    unsigned char *bytes; /* of one chunk */
    size_t size;
} gis_part_file;

/* "shard-3": of shard 3. */
#define GIS_PART_FILE_NAME 32
void gis_part_file_name(uint32_t shard, char name[GIS_PART_FILE_NAME]);

bool gis_part_file_create(gis_part_file *file, const char *directory, const gis_part_stamp *stamp, gis_error *error);
/* The result of a part, cut into chunks. */
bool gis_part_file_add(gis_part_file *file, const gis_part_result *result, gis_error *error);
/* On the disk, under its name; closed. */
bool gis_part_file_place(gis_part_file *file, const char *directory, gis_error *error);

/* Fails, naming the file, if it is missing, cut off, altered, or was made of something else. */
bool gis_part_file_open(gis_part_file *file, const char *directory, const gis_part_stamp *stamp, gis_error *error);
/* In place of what `to` held. */
bool gis_part_file_read(gis_part_file *file, size_t k, gis_part_result *to, gis_error *error);
/* Is the chunk as it was written, and are the lines that go with it? */
bool gis_part_file_check(gis_part_file *file, size_t chunk, gis_part_result *scratch, gis_error *error);
/* A line that lies in one of n files, which are those of all shards, in their order, becomes the result's own. */
bool gis_part_file_fetch(gis_part_file *file, size_t n, gis_part_result *to, gis_part_line *line, gis_error *error);
void gis_part_file_close(gis_part_file *file);

#endif
