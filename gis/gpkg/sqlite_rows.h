/* sqlite_rows.h: inserts many rows of two columns into a table of a database that GDAL has open.
 *
 * GDAL takes statements as text, searches each for keywords of its own, and SQLite parses it; for tens of thousands of
 * rows that is most of the work. Here a statement is parsed once. */
#ifndef GIS_SQLITE_ROWS_H
#define GIS_SQLITE_ROWS_H

#include "base/gis_error.h"

#include <stdint.h>

/* A zeroed struct is empty. */
typedef struct gis_sqlite_rows {
    void *database, *one, *many; /* one, many: statements for one row, and for AT_ONCE rows */
    void *next;                  /* statement for AT_ONCE rows without keys, used if their keys are those that SQLite
                                  * would assign; NULL: none was prepared, or a key did not ascend, so that the key
                                  * that SQLite would assign next is not known */
    int64_t last;                /* the last key, if `any` */
    bool any;
    const char *what; /* for messages; borrowed */
} gis_sqlite_rows;

/* Is the SQLite in this program the one with this source id (SQLite's sqlite_source_id())? */
bool gis_sqlite_is_that_of(const char *source_id);

/* Begins inserting. database: GDAL's handle, for the same SQLite. table: its name, quoted. many: the name of the column
 * of values if the table is empty and hundreds of rows will follow; else NULL. Fails with "WHAT cannot be written: the
 * reason"; call gis_sqlite_rows_end() in any case. */
bool gis_sqlite_rows_begin(gis_sqlite_rows *rows, void *database, const char *table, const char *many, const char *what,
                           gis_error *error);
/* Inserts n rows, each a key and a value. Ascending keys are appended, which is several times faster than inserting
 * among others; keys that SQLite would assign (the last one plus 1) are twice as fast again. */
bool gis_sqlite_rows_add(gis_sqlite_rows *rows, const int64_t (*row)[2], size_t n, gis_error *error);
/* Inserts one row: a key and n bytes. */
bool gis_sqlite_rows_add_bytes(gis_sqlite_rows *rows, int64_t key, const void *bytes, size_t n, gis_error *error);
void gis_sqlite_rows_end(gis_sqlite_rows *rows);

#endif
