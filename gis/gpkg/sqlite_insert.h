/* sqlite_insert.h: inserts whole rows into a table of a database that GDAL has open, by statements that are parsed
 * once; and other direct access to such a database that GDAL does not notice.
 *
 * Rows are held back until there are some dozens, which one statement inserts: with ascending keys (AUTOINCREMENT)
 * SQLite looks up and writes the last key once for each statement, which takes as long as a row. Some thousands are
 * handed over at a time, to a second thread if there is to be one, which works on them while the next are collected:
 * the database belongs to that thread until gis_sqlite_inserts_flush(). */
#ifndef GIS_SQLITE_INSERT_H
#define GIS_SQLITE_INSERT_H

#include "base/gis_error.h"
#include "base/side_thread.h"
#include "base/value.h"

#include <stddef.h>
#include <stdint.h>

/* A value as it is held back: a text, or bytes, lies at this offset of the buffer. */
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
    gis_sqlite_batch batch[GIS_SIDE_THREAD_PIECES]; /* one is added to, those before it go in */
    size_t added_to;
    int64_t failed_key;      /* the row that was rejected */
    const char *failed;      /* ... and why; NULL: all were */
    gis_side_thread *beside; /* the other thread; NULL: none */
} gis_sqlite_inserts;

/* Prepares insertion by a statement that ends with "VALUES ", followed by groups of parameters: a key, bytes, and
 * values. False where SQLite is not available, or rejects it. threads: at least one; with more, rows are inserted on a
 * thread other than the caller's. The struct must not move. */
bool gis_sqlite_inserts_begin(gis_sqlite_inserts *rows, void *database, const char *sql, size_t columns,
                              unsigned threads);
/* One row; bytes and texts are copied. False, with SQLite's own words in *reason, if it, or one held back before it,
 * is not taken: *key is that one's then. */
bool gis_sqlite_inserts_add(gis_sqlite_inserts *rows, int64_t *key, const void *bytes, size_t size,
                            const gis_value *values, const char **reason);
/* Inserts all rows that are held back. */
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
