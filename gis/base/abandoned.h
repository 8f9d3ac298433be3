/* abandoned.h: what several processes make at once in one directory, each under a name that ends with the program's
 * and six letters of its own, and what of it is left where one was killed.
 *
 * Who makes something holds a lock on it (flock(2)), which the system lets go of with the process, however that ends.
 * So what nobody holds is nobody's. Where nothing can be locked, all counts as in use. */
#ifndef GIS_ABANDONED_H
#define GIS_ABANDONED_H

#include <stdbool.h>

/* The end of such a name, as mkstemp() and mkdtemp() take it: nobody else's files are called so. */
#define GIS_OWN_LETTERS ".sunder-XXXXXX"

/* Locks what was just made, by an open descriptor of it, until that is closed. False: it was taken for abandoned
 * before, and is gone or will be; another has to be made. */
bool gis_not_abandoned(int descriptor);
/* Likewise, of a directory: its descriptor; -1: it cannot be opened, and is in nobody's way; -2: false. */
int gis_directory_not_abandoned(const char *path);

/* Removes what is called PREFIX, then anything, then such an end, and is held by nobody. */
void gis_remove_abandoned(const char *directory, const char *prefix);

#endif
