/* sqlite_select.h: rows of a table of a database that GDAL has open, value by value, without features being made of
 * them. */
#ifndef GIS_SQLITE_SELECT_H
#define GIS_SQLITE_SELECT_H

#include "base/value.h"

#include <stdbool.h>
#include <stddef.h>

/* The statement, to be given to gis_sqlite_select_end(); NULL where SQLite cannot be had, or does not take it. */
void *gis_sqlite_select_begin(void *database, const char *sql);
void gis_sqlite_select_end(void *statement);

typedef enum gis_sqlite_next { GIS_SQLITE_HAS_ROW, GIS_SQLITE_AT_END, GIS_SQLITE_BROKEN } gis_sqlite_next;

gis_sqlite_next gis_sqlite_select_next(void *statement);
/* A column of the row; a text lives until the next row. False if it is of bytes, or a text with a zero in it. */
bool gis_sqlite_select_value(void *statement, int column, gis_value *value);
/* Its bytes, likewise; NULL if it is not of bytes. *null: it is null. */
const unsigned char *gis_sqlite_select_bytes(void *statement, int column, size_t *size, bool *null);

#endif
