/* second_connection.h: opens a database that GDAL has open a second time, so that another thread can read part of a
 * table at the same time. */
#ifndef GIS_SECOND_CONNECTION_H
#define GIS_SECOND_CONNECTION_H

#include <stdbool.h>
#include <stdint.h>

/* A second, read-only connection, for one thread at a time. NULL if SQLite is not available, if the database is not a
 * plain file, or if it uses a log (WAL), since with a log each connection sees the state at its start. Without one the
 * file cannot change while a statement of either connection is being read, so both see the same state if one begins
 * while the other is being read. */
void *gis_second_connection_open(void *database);
void gis_second_connection_close(void *again);

/* Which rows of a table: all, those with keys up to `last`, or those with greater keys. */
typedef enum gis_sqlite_stretch { GIS_SQLITE_ALL, GIS_SQLITE_UP_TO, GIS_SQLITE_BEYOND } gis_sqlite_stretch;

/* Appends the condition for these rows to a SELECT of all rows; frees `sql` and returns the result, like
 * gis_sql_append(). */
char *gis_sql_append_stretch(char *sql, const char *key, gis_sqlite_stretch which, int64_t last);
/* Sets *middle to the number midway between the smallest and the largest key of the table, and *span to the difference
 * of the two keys. False if the table has no rows, a key is not an integer, or the query fails. */
bool gis_sqlite_find_middle(void *database, const char *table, const char *key, int64_t *middle, uint64_t *span);

#endif
