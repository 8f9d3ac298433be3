/* part_file.h: results of parts on disk, as a file of chunks, each with the box of everything that its worlds read or
 * wrote. A file exists completely or not at all.
 *
 * A chunk holds about 64 neighbouring worlds of one run, so that most chunks meet no chunk of another run and can stay
 * on disk. Results outside of worlds are in a chunk of their own, without a box. Lines of the proof, which are long,
 * stay in the file until they are needed. */
#ifndef GIS_PART_FILE_H
#define GIS_PART_FILE_H

#include "disk/file.h"
#include "shards/parts/part_result.h"

/* What a file was made from. */
typedef struct gis_part_stamp {
    char version[24];       /* of the program */
    uint64_t options;       /* checksum of the command line */
    uint64_t spool;         /* checksum of the spooled layer */
    uint32_t shard, shards; /* number of the shard, from 1, and number of shards */
} gis_part_stamp;

typedef struct gis_part_chunk {
    double box[4]; /* xmin ymin xmax ymax; box[0] > box[2]: none of its worlds read or wrote anything */
    uint64_t from, bytes, checksum;
    uint64_t lines, lines_checksum; /* bytes of the lines of the proof that precede the chunk */
    uint32_t run;
    uint32_t incomplete; /* 1: one of its worlds is incomplete */
} gis_part_chunk;

/* A file of results. A zeroed struct is closed. */
typedef struct gis_part_file {
    gis_disk_file file;
    gis_part_stamp stamp;
    gis_part_chunk *chunk;
    size_t chunks, room;
    uint64_t places;      /* number of features and barriers, against which the numbers read are checked; 0: unknown */
    unsigned char *bytes; /* buffer for one chunk */
    size_t size;
} gis_part_file;

/* The file name of a shard's results: "shard-3" for shard 3. */
#define GIS_PART_FILE_NAME 32
void gis_part_file_name(uint32_t shard, char name[GIS_PART_FILE_NAME]);

bool gis_part_file_create(gis_part_file *file, const char *directory, const gis_part_stamp *stamp, gis_error *error);
/* Appends the result of a part, divided into chunks. */
bool gis_part_file_add(gis_part_file *file, const gis_part_result *result, gis_error *error);
/* Writes the list of chunks, syncs the file, renames it to its final name and closes it. */
bool gis_part_file_place(gis_part_file *file, const char *directory, gis_error *error);

/* Opens a file. Fails, naming it, if it is missing, cut off, changed, or was made from something else. */
bool gis_part_file_open(gis_part_file *file, const char *directory, const gis_part_stamp *stamp, gis_error *error);
/* Reads chunk k into *to, in place of what it held. */
bool gis_part_file_read(gis_part_file *file, size_t k, gis_part_result *to, gis_error *error);
/* Fails if a chunk, or the lines of the proof before it, differ from what was written. */
bool gis_part_file_check(gis_part_file *file, size_t chunk, gis_part_result *scratch, gis_error *error);
/* If *line refers to a file, copies the line from there into *to, and makes *line refer to the copy. file[] holds the n
 * files of all shards, in order. */
bool gis_part_file_fetch(gis_part_file *file, size_t n, gis_part_result *to, gis_part_line *line, gis_error *error);
void gis_part_file_close(gis_part_file *file);

#endif
