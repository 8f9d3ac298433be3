/* stage.h: files that appear in a directory together, or not at all.
 *
 * New files are made under their final names in a new hidden directory beside their final place (so that renaming does
 * not copy, and formats that store their own name store the right one). Publishing syncs and renames them, the main
 * file last, and undoes the renames if one fails. Freeing without publishing leaves nothing behind. A run that is
 * killed between two renames leaves a record, from which the next run restores the old files. */
#ifndef GIS_STAGE_H
#define GIS_STAGE_H

#include "base/gis_error.h"

typedef struct gis_stage gis_stage;

/* A stage for files beside final_path (a symbolic link is followed). Fails if a directory cannot be made there, which
 * is tried. The stage's own directory is made later, so that a run that is killed during its work leaves none
 * behind. */
bool gis_stage_new(const char *final_path, gis_stage **out, gis_error *error);
/* Makes the stage's directory, if it does not exist; call it before anything is put in. */
bool gis_stage_make(gis_stage *stage, gis_error *error);
void gis_stage_free(gis_stage *stage);

/* The path at which a file of this base name is made, and its final path; freed with CPLFree(). */
char *gis_stage_inside(const gis_stage *stage, const char *name);
char *gis_stage_outside(const gis_stage *stage, const char *name);
/* Base name of the main file. */
const char *gis_stage_main(const gis_stage *stage);

/* Copies an existing file or directory of the final directory into the stage, under its name. */
bool gis_stage_copy_in(gis_stage *stage, const char *path, gis_error *error);

/* Makes a file with these bytes, or a directory, in the stage; the name may be a relative path. */
bool gis_stage_put(gis_stage *stage, const char *name, const void *bytes, size_t n, gis_error *error);
bool gis_stage_put_directory(gis_stage *stage, const char *name, gis_error *error);

/* Marks a file of the final directory as replaced: publishing removes it. */
void gis_stage_supersede(gis_stage *stage, const char *path);

/* Asks the system, if it supports that, to begin writing the main file to disk, so that publishing waits less. The file
 * must be complete, and no process may have it open for writing. May block as long as the disk takes; errors are
 * reported by publishing. */
void gis_stage_write_out(const gis_stage *stage);

/* Puts all files in place. Fails if a file that was not marked as replaced is in the way, unless `replace`. */
bool gis_stage_publish(gis_stage *stage, bool replace, gis_error *error);

/* Looks beside an output for the remains of a run that was killed while it put files in place. Restores the old files,
 * and adds sentences that say what was done and what the user has to do. Fails if files cannot be restored. */
bool gis_stage_recover(const char *final_path, gis_sentences *said, gis_error *error);

#endif
