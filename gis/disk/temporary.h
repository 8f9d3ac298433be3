/* temporary.h: what several processes make at once in one directory, each under a name that ends with the program's
 * and six letters of its own, and what of it is left where one was killed.
 *
 * The maker of a file or directory holds a lock on it (flock(2)), which the system lets go of with the process, however
 * that ends: what is not locked was abandoned. Where nothing can be locked, all counts as in use. Others may make files
 * and directories of such names, too, or give them to what lies there: so only files of the effective user are removed,
 * and only private directories of that user (base/trust.h) that hold the file GIS_BEING_MADE, the mark of a directory
 * that is being made. */
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
