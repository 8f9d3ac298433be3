/* sqlite_insert.h: whole rows into a table of a database that GDAL has open, by statements that are parsed once; and
 * what else is asked of such a database without GDAL's hearing of it.
 *
 * Rows are held back until there are some dozens, which go in by one statement: where keys are to rise (AUTOINCREMENT)
 * SQLite looks up and writes the last one once a statement, and that takes as long as the row itself. Some thousands go
 * at once, on another thread if there is to be one, which has the next to go on with when it is done with them: the
 * database is that thread's until gis_sqlite_inserts_flush(). */
#ifndef GIS_SQLITE_INSERT_H
#define GIS_SQLITE_INSERT_H

#include "base/error.h"
#include "base/side_thread.h"
#include "base/value.h"

#include <stddef.h>
#include <stdint.h>

/* A value as it is held back: what is text, or bytes, lies so far into the buffer. */
typedef struct gis_sqlite_held {
    gis_value value;
    size_t at, size;
    bool bytes;
} gis_sqlite_held;

/* Rows that are held back, or go in. */
typedef struct gis_sqlite_batch {
    struct gis_sqlite_inserts *of;
    gis_sqlite_held *held; /* [rows * columns] */
    size_t rows, room;
    unsigned char *buffer;
    size_t size, buffer_room;
    bool refused; /* one of them was not taken */
} gis_sqlite_batch;

/* A zeroed struct has not begun. */
typedef struct gis_sqlite_inserts {
    void *database, *one, *many; /* statements; many NULL: rows go one by one */
    size_t columns, at_once;
    gis_sqlite_batch batch[GIS_BESIDE_PIECES]; /* one is added to, those before it go in */
    size_t added_to;
    int64_t failed_key; /* of what went in: the row that was not taken */
    const char *failed; /* ... and why; NULL: all were */
    gis_beside *beside; /* the other thread; NULL: none */
} gis_sqlite_inserts;

/* Rows for a statement that ends with "VALUES ", to which is added a bracket of so many parameters: a key, bytes, and
 * values. False where SQLite cannot be had, or does not take it. threads: one at least; with more rows go in on another
 * than the caller's. The struct stays where it is. */
bool gis_sqlite_inserts_begin(gis_sqlite_inserts *rows, void *database, const char *sql, size_t columns,
                              unsigned threads);
/* One row; bytes and texts are copied. False, with SQLite's own words in *reason, if it, or one held back before it,
 * is not taken: *key is that one's then. */
bool gis_sqlite_inserts_add(gis_sqlite_inserts *rows, int64_t *key, const void *bytes, size_t size,
                            const gis_value *values, const char **reason);
/* What is held back goes in, all of it. */
bool gis_sqlite_inserts_flush(gis_sqlite_inserts *rows, int64_t *key, const char **reason);
/* What is held back, and is not yet given to go in, is forgotten. */
void gis_sqlite_inserts_end(gis_sqlite_inserts *rows);

/* Is the first value of the first row that the query gives these bytes, from `from` on? The bytes before are copied to
 * `head`. */
bool gis_sqlite_says(void *database, const char *sql, void *head, size_t from, const void *bytes, size_t size);
/* A number as SQLite's "%.18g" has it, which in some versions is of fewer digits; "0" where SQLite cannot be had. */
enum { GIS_SQLITE_NUMBER = 64 };
void gis_sqlite_print_number(double x, char out[GIS_SQLITE_NUMBER]);
/* Runs a statement; false if that fails. */
bool gis_sqlite_run(void *database, const char *sql);

#endif
