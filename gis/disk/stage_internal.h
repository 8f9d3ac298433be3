/* stage_internal.h: what the files of the stage share.
 *
 *  stage.c          the hidden directory and its contents
 *  stage_publish.c  renames, and undoing them
 *  stage_remains.c  remains of a run that was killed between renames
 *  stage_entries.c  entries of an open directory
 *
 * The output's directory and the stage are opened once. From then on everything is done relative to the open
 * descriptors, with plain names, so replacing one of the paths by a link or another directory has no effect. (GDAL's
 * drivers use the path.) */
#ifndef GIS_STAGE_INTERNAL_H
#define GIS_STAGE_INTERNAL_H

#include "base/interrupt.h"
#include "disk/stage.h"

/* The names of all stages: this prefix and six letters or digits. */
#define GIS_STAGE_PREFIX ".sunder-"
/* Entries inside the stage: the directory to which replaced files are moved until everything is in place, and the
 * record of all renames, which exists while they are made. */
#define GIS_STAGE_OLD "superseded~"
#define GIS_STAGE_RECORD "record~"

struct gis_stage {
    char *directory;        /* path of the final directory, for messages and for GDAL */
    char *inside;           /* path of the stage, for messages and for GDAL; NULL: not made yet */
    int outer, inner;       /* descriptors of both directories; the stage is locked, if locks work. inner = -1: not made
                             * yet */
    gis_leftover *leftover; /* registers the stage for removal by a signal */
    char *main;             /* name of the main file */
    char **superseded;      /* names of the files that are replaced */
};

/* The kinds of lines in the record; names are escaped. A line of a new file, "new MARK NAME", identifies it by more
 * than its name, so that only this file is removed again, and not a later one of the same name. */
#define GIS_RECORD_MAIN "main "
#define GIS_RECORD_OLD "old "
#define GIS_RECORD_NEW "new "

/* The directory and name of an output after links are resolved; both freed with CPLFree(). */
void gis_stage_place_of(const char *final_path, char **directory, char **name);

/* ---- stage_entries.c: entries of an open directory --------------------------------------------------------------- */

/* Sets `mark` to the inode, the size and the time of modification of a file. A rename changes none of the three.
 * Returns false if there is no such file. */
enum { GIS_MARK_SIZE = 128 };
bool gis_entry_mark(int directory, const char *name, char mark[GIS_MARK_SIZE]);
/* Is there an entry of this name? A link counts, whatever it refers to. */
bool gis_entry_is_there(int directory, const char *name);
bool gis_entry_is_directory(int directory, const char *name);
bool gis_entry_is_file(int directory, const char *name);
/* All names except "." and ".."; freed with CSLDestroy(). NULL: there are none, or they cannot be listed. */
char **gis_entry_names(int directory);
/* Moves an entry from one directory to another, under the same name; returns 0, or -1 with errno. Without `replace` an
 * existing entry is kept and the move fails (EEXIST), atomically if the system supports that. */
int gis_entry_move(int from, int to, const char *name, bool replace);

#endif
