/* sqlite_find.h: functions of the SQLite that is in the running program. */
#ifndef GIS_SQLITE_FIND_H
#define GIS_SQLITE_FIND_H

#include <stdbool.h>

/* Fills a pointer to the function of that name; false if the program has none. */
bool gis_sqlite_find(const char *name, void *function);

#endif
