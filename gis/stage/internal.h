/* internal.h: what the files of the stage share.
 *
 *   stage.c          the hidden directory and what is put in it
 *   publish.c        renames, and their undoing
 *   remains.c        what a run left that was killed among its renames */
#ifndef GIS_STAGE_INTERNAL_H
#define GIS_STAGE_INTERNAL_H

#include "base/interrupt.h"
#include "stage/stage.h"

/* The names of all stages begin so; mkdtemp() adds six characters. */
#define GIS_STAGE_PREFIX ".sunder-"
/* Inside the stage: where superseded files wait until all is in place, and the record of what publishing will do, which
 * is there while the renames are under way. */
#define GIS_STAGE_OLD "superseded~"
#define GIS_STAGE_RECORD "record~"

struct gis_stage {
    char *directory;        /* the final one */
    char *inside;           /* the stage; NULL: not made yet */
    gis_leftover *leftover; /* the same, for a signal */
    int lock;               /* the stage held open and locked; -1: it cannot be */
    char *main;             /* base name of the main file */
    char **superseded;      /* base names */
};

/* One line of the record. Names are escaped. A new file is known by more than its name, so that what is taken away
 * again is that file, and not one that came later: "new MARK NAME". */
#define GIS_RECORD_MAIN "main "
#define GIS_RECORD_OLD "old "
#define GIS_RECORD_NEW "new "

/* The mark of a file: its inode, size and time of change, none of which a rename changes. False if it is not there. */
enum { GIS_MARK_SIZE = 128 };
bool gis_stage_mark(const char *path, char mark[GIS_MARK_SIZE]);

char *gis_join(const char *directory, const char *name);
/* Is something called so? A link counts, wherever it leads. */
bool gis_there(const char *path);
/* The directory and the base name of where an output really lies; both freed with CPLFree(). */
void gis_stage_place_of(const char *final_path, char **directory, char **name);

#endif
