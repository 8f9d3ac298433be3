/* temporary.h: temporary files and directories that several processes make in one directory, each with a name that ends
 * in the program's name and six random letters; and their removal after a process was killed.
 *
 * The maker of a file or directory holds a lock on it (flock(2)), which the system releases with the process, however
 * that ends: a file whose lock is free was abandoned and may be removed. Where locks do not work, all count as in use.
 * Other users may make entries with such names, too: so only files of the effective user are removed, and only private
 * directories of that user (base/trust.h) that hold the file GIS_BEING_MADE, the mark of an unfinished directory. */
#ifndef GIS_TEMPORARY_H
#define GIS_TEMPORARY_H

#include <stdbool.h>

/* The end of such a name, as mkstemp() and mkdtemp() take it. */
#define GIS_OWN_LETTERS ".sunder-XXXXXX"
/* In a directory, until all of it is there. */
#define GIS_BEING_MADE "being-made~"

/* Locks what was just made, by an open descriptor of it, until that is closed. False: it was taken for abandoned
 * before, and is gone or will be; another has to be made. */
bool gis_not_abandoned(int descriptor);
/* Makes a directory for the effective user alone, as mkdtemp() does, locks it, and puts GIS_BEING_MADE into it. Its
 * descriptor, -1: it cannot be made; errno says why. */
int gis_make_directory(char *path);

/* Makes a file, as mkstemp() does, locks it, and gives it the mode of any other new file. Its descriptor, or -1. */
int gis_make_file(char *path);

/* Removes what is called PREFIX, then anything, then such an end, and was abandoned. */
void gis_remove_abandoned(const char *directory, const char *prefix);

#endif
