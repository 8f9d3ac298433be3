/* sqlite_rows.h: many rows of two columns into a table of a database that GDAL has open.
 *
 * GDAL takes statements as text, searches each for words of its own, and SQLite parses it: for rows by the ten thousand
 * that is most of the work. Here a statement is parsed once. */
#ifndef GIS_SQLITE_ROWS_H
#define GIS_SQLITE_ROWS_H

#include "base/gis_error.h"

#include <stdint.h>

/* A zeroed struct is none. */
typedef struct gis_sqlite_rows {
    void *database, *one, *many; /* statements: of one row, and of many */
    void *next;                  /* of many whose keys SQLite gives; NULL: it is not known which these are */
    int64_t last;                /* key */
    bool any;
    const char *what; /* for messages; lent */
} gis_sqlite_rows;

/* Is the SQLite that is found in this program the one that says this of its source (SQLite's sqlite_source_id())? */
bool gis_sqlite_is_that_of(const char *source_id);

/* database: GDAL's handle of it, for the same SQLite; table: its name, quoted; many: the column of values if hundreds
 * of rows will come and the table is empty; else NULL. False with "WHAT cannot be written: the reason"; the caller ends
 * it in any case. */
bool gis_sqlite_rows_begin(gis_sqlite_rows *rows, void *database, const char *table, const char *many, const char *what,
                           gis_error *error);
/* n rows, each a key and a value, one after the other. Keys that ascend go behind all others, which is several times as
 * fast as among them; those that SQLite would give, each the last one and 1, twice as fast again. */
bool gis_sqlite_rows_add(gis_sqlite_rows *rows, const int64_t (*row)[2], size_t n, gis_error *error);
/* One row: a key and n bytes. */
bool gis_sqlite_rows_add_bytes(gis_sqlite_rows *rows, int64_t key, const void *bytes, size_t n, gis_error *error);
void gis_sqlite_rows_end(gis_sqlite_rows *rows);

#endif
