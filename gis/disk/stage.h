/* stage.h: files that appear in a directory together, or not at all.
 *
 * New files are made under their final names in a new hidden directory beside their place (so that renaming does not
 * copy, and formats that write their own name into themselves write the right one). Publishing syncs and renames them,
 * the main one last, and puts everything back if a rename fails. Freeing without publishing leaves nothing behind. A
 * run that is killed between two renames leaves a record, from which the next one puts everything back. */
#ifndef GIS_STAGE_H
#define GIS_STAGE_H

#include "base/gis_error.h"

typedef struct gis_stage gis_stage;

/* A stage for files beside final_path (a symbolic link there is followed). Fails if the directory is missing or not
 * writable, which is tried; the stage itself is not there yet, so that a run that is killed at its work leaves none. */
bool gis_stage_new(const char *final_path, gis_stage **out, gis_error *error);
/* Makes it, if it is not there; before anything is put in. */
bool gis_stage_make(gis_stage *stage, gis_error *error);
void gis_stage_free(gis_stage *stage);

/* The place where a file of this base name is made, and where it will be; freed with CPLFree(). */
char *gis_stage_inside(const gis_stage *stage, const char *name);
char *gis_stage_outside(const gis_stage *stage, const char *name);
/* Base name of the main file. */
const char *gis_stage_main(const gis_stage *stage);

/* Copies an existing file or directory, which lies in the final directory, into the stage, under its name. */
bool gis_stage_copy_in(gis_stage *stage, const char *path, gis_error *error);

/* Makes a file of these bytes, or a directory, in the stage; the name may be a path below it. */
bool gis_stage_put(gis_stage *stage, const char *name, const void *bytes, size_t n, gis_error *error);
bool gis_stage_put_directory(gis_stage *stage, const char *name, gis_error *error);

/* This file of the final directory belongs to what is replaced: publishing takes it away. */
void gis_stage_supersede(gis_stage *stage, const char *path);

/* The main file, which no process has open for writing, is complete: the disk begins to write it, where the system
 * offers that, so that publishing waits for less. It may take as long as the disk takes; errors show when it is
 * published. */
void gis_stage_write_out(const gis_stage *stage);

/* Puts all that was made in its place. A file in the way that is not superseded makes it fail, unless `replace`. */
bool gis_stage_publish(gis_stage *stage, bool replace, gis_error *error);

/* Looks beside an output for the remains of a run that was killed while it put its files there. Brings the old files
 * back, and reports, one sentence each, what was done and what is to be done by hand. Fails if the files cannot be
 * brought back. */
bool gis_stage_recover(const char *final_path, gis_sentences *said, gis_error *error);

#endif
