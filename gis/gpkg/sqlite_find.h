/* sqlite_find.h: looks up functions of the SQLite in the running program. */
#ifndef GIS_SQLITE_FIND_H
#define GIS_SQLITE_FIND_H

#include <stdbool.h>

/* Sets the function pointer that `function` points to; false if the program has no function of this name. */
bool gis_sqlite_find(const char *name, void *function);

#endif
