/* insert.h: whole rows into a table of a database that GDAL has open, by a statement that is parsed once; and what else
 * is asked of such a database without GDAL's hearing of it. */
#ifndef GIS_SQLITE_INSERT_H
#define GIS_SQLITE_INSERT_H

#include "base/error.h"
#include "base/value.h"

#include <stddef.h>
#include <stdint.h>

/* The statement; NULL where SQLite cannot be had, or does not take it. */
void *gis_sqlite_insert_begin(void *database, const char *sql);
/* One row: a key, bytes, and n values. False, with SQLite's own words in *reason, if it does not take it. */
bool gis_sqlite_insert(void *database, void *statement, int64_t key, const void *bytes, size_t size,
                       const gis_value *values, int n, const char **reason);
void gis_sqlite_insert_end(void *statement);

/* Is the first value of the first row that the query gives these bytes, from `from` on? The bytes before are copied to
 * `head`. */
bool gis_sqlite_says(void *database, const char *sql, void *head, size_t from, const void *bytes, size_t size);
/* Runs a statement; false if that fails. */
bool gis_sqlite_run(void *database, const char *sql);

#endif
