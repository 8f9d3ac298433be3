/* second_connection.h: a database that GDAL has open, open once more, so that another thread reads a part of a table
 * meanwhile. */
#ifndef GIS_SECOND_CONNECTION_H
#define GIS_SECOND_CONNECTION_H

#include <stdbool.h>
#include <stdint.h>

/* A second, read-only connection, for one thread at a time. NULL where SQLite is not available, where the database is
 * not a plain file, and where it has a log (WAL), since there each connection sees the state at its start. Elsewhere
 * the file cannot change while a statement of either connection is being read, so both see the same state if one begins
 * while the other is being read. */
void *gis_second_connection_open(void *database);
void gis_second_connection_close(void *again);

/* Rows of a table by their keys: all, those up to `last`, those beyond. */
typedef enum gis_sqlite_stretch { GIS_SQLITE_ALL, GIS_SQLITE_UP_TO, GIS_SQLITE_BEYOND } gis_sqlite_stretch;

/* A SELECT of all rows with the condition behind it; as gis_sql_append(). */
char *gis_sql_append_stretch(char *sql, const char *key, gis_sqlite_stretch which, int64_t last);
/* The key in the middle between the first and the last, and how far from each other these are. False: there are no
 * keys. */
bool gis_sqlite_find_middle(void *database, const char *table, const char *key, int64_t *middle, uint64_t *span);

#endif
