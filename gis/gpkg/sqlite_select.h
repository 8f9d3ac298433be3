/* sqlite_select.h: reads rows of a database that GDAL has open, value by value, without making GDAL features. */
#ifndef GIS_SQLITE_SELECT_H
#define GIS_SQLITE_SELECT_H

#include "base/value.h"

#include <stdbool.h>
#include <stddef.h>

/* Prepares a statement, to be ended with gis_sqlite_select_end(); NULL if SQLite is not available or rejects it. */
void *gis_sqlite_select_begin(void *database, const char *sql);
void gis_sqlite_select_end(void *statement);

typedef enum gis_sqlite_next { GIS_SQLITE_HAS_ROW, GIS_SQLITE_AT_END, GIS_SQLITE_BROKEN } gis_sqlite_next;

gis_sqlite_next gis_sqlite_select_next(void *statement);
/* The value of a column in the current row; a text is valid until the next row. False if it is a blob, or a text that
 * contains a NUL. */
bool gis_sqlite_select_value(void *statement, int column, gis_value *value);
/* The bytes of a blob in the current row, valid until the next row; NULL if it is not a blob. *null: the value is
 * null. */
const unsigned char *gis_sqlite_select_bytes(void *statement, int column, size_t *size, bool *null);

#endif
