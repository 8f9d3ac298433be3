/* stage_internal.h: what the files of the stage share.
 *
 *   stage.c          the hidden directory and its contents
 *   stage_publish.c  renames, and their undoing
 *   stage_remains.c  remains of a run that was killed among its renames
 *   stage_entries.c  entries of an open directory
 *
 * The output's directory and the stage are opened once. From then on everything is done relative to the open
 * directories, by plain names: if a link or another directory takes the place of one of the paths, nothing changes.
 * (GDAL's drivers use the path.) */
#ifndef GIS_STAGE_INTERNAL_H
#define GIS_STAGE_INTERNAL_H

#include "base/interrupt.h"
#include "disk/stage.h"

/* The names of all stages begin with this; six letters follow. */
#define GIS_STAGE_PREFIX ".sunder-"
/* Inside the stage: where superseded files wait until all is in place, and the record of what publishing will do, which
 * is there while the renames are under way. */
#define GIS_STAGE_OLD "superseded~"
#define GIS_STAGE_RECORD "record~"

struct gis_stage {
    char *directory;        /* the final one, for messages and for GDAL */
    char *inside;           /* the stage, likewise; NULL: not made yet */
    int outer, inner;       /* both of them, open; the stage is locked, if it can be. -1: not made yet */
    gis_leftover *leftover; /* the stage, for a signal */
    char *main;             /* name of the main file */
    char **superseded;      /* names */
};

/* One line of the record. Names are escaped. A new file is known by more than its name, so that what is taken away
 * again is that file, and not one that came later: "new MARK NAME". */
#define GIS_RECORD_MAIN "main "
#define GIS_RECORD_OLD "old "
#define GIS_RECORD_NEW "new "

/* The directory and the name of where an output really lies; both freed with CPLFree(). */
void gis_stage_place_of(const char *final_path, char **directory, char **name);

/* ---- stage_entries.c: what is in a directory that is open -------------------------------------------------------- */

/* Identifies a file: inode, size and time of change, none of which a rename changes. False if there is no such file. */
enum { GIS_MARK_SIZE = 128 };
bool gis_entry_mark(int directory, const char *name, char mark[GIS_MARK_SIZE]);
/* Is something called so? A link counts, wherever it leads. */
bool gis_entry_is_there(int directory, const char *name);
bool gis_entry_is_directory(int directory, const char *name);
bool gis_entry_is_file(int directory, const char *name);
/* All names, but "." and ".."; freed with CSLDestroy(). NULL: there are none, or they cannot be listed. */
char **gis_entry_names(int directory);
/* From one directory to another, under its name; 0, or -1 with errno. Without `replace` what has the name there stays
 * (EEXIST), in one step where the system has it. */
int gis_entry_move(int from, int to, const char *name, bool replace);

#endif
