/* temporary.h: temporary files and directories that several processes make in one directory, under names that end with
 * the program's name and six random letters; and removing those that a killed process has left.
 *
 * The process that makes a file or directory holds a lock on it (flock(2)), which the system releases when the process
 * ends, in whatever way: a file whose lock is free was abandoned and may be removed. If locks do not work, all files
 * count as in use. Other users may make entries with such names, too, so only files of the effective user are removed,
 * and only private directories of that user (base/trust.h) that contain the file GIS_BEING_MADE, the mark of an
 * unfinished directory. */
#ifndef GIS_TEMPORARY_H
#define GIS_TEMPORARY_H

#include <stdbool.h>

/* The end of such a name, as a template for mkstemp() and mkdtemp(). */
#define GIS_OWN_LETTERS ".sunder-XXXXXX"
/* The name of the mark in a directory, which is removed when the directory is complete. */
#define GIS_BEING_MADE "being-made~"

/* Locks a new file or directory until `descriptor` is closed. False: another process took it for abandoned before the
 * lock was taken, and has removed it or will; another one has to be made. */
bool gis_not_abandoned(int descriptor);
/* Makes a directory for the effective user alone, as mkdtemp() does, locks it, and puts GIS_BEING_MADE into it. Returns
 * its descriptor; -1: failed, errno says why. */
int gis_make_directory(char *path);

/* Makes a file as mkstemp() does, locks it, and gives it the usual mode of a new file. Returns its descriptor, or
 * -1. */
int gis_make_file(char *path);

/* Removes abandoned files and directories whose names consist of the prefix, any text, and GIS_OWN_LETTERS. */
void gis_remove_abandoned(const char *directory, const char *prefix);

#endif
