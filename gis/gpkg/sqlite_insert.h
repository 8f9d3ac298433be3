/* sqlite_insert.h: inserts complete rows into a table of a database that GDAL has open, with statements that are parsed
 * once; and other direct access to such a database that GDAL does not notice.
 *
 * Rows are collected and inserted some dozens at a time, by one statement: with ascending keys (AUTOINCREMENT) SQLite
 * looks up and writes the last key once for each statement, which takes as long as inserting a row. Batches of some
 * thousand rows are handed to a second thread, if `threads` allows one, which inserts them while the next rows are
 * collected: the database belongs to that thread until gis_sqlite_inserts_flush(). */
#ifndef GIS_SQLITE_INSERT_H
#define GIS_SQLITE_INSERT_H

#include "base/gis_error.h"
#include "base/side_thread.h"
#include "base/value.h"

#include <stddef.h>
#include <stdint.h>

/* A value of a collected row; the bytes of a text or blob are at offset `at` of the batch's buffer. */
typedef struct gis_sqlite_held {
    gis_value value;
    size_t at, size;
    bool bytes;
} gis_sqlite_held;

/* A batch of rows that are being collected or inserted. */
typedef struct gis_sqlite_batch {
    struct gis_sqlite_inserts *of;
    gis_sqlite_held *held; /* [rows * columns] */
    size_t rows, room;
    unsigned char *buffer;
    size_t size, buffer_room;
    bool refused; /* one of its rows was rejected */
} gis_sqlite_batch;

/* A zeroed struct has not begun. */
typedef struct gis_sqlite_inserts {
    void *database, *one, *many; /* one, many: statements; many == NULL: rows are inserted one by one */
    size_t columns, at_once;
    gis_sqlite_batch batch[GIS_SIDE_THREAD_PIECES]; /* a ring: rows are added to one batch while earlier ones are
                                                     * inserted */
    size_t added_to;
    int64_t failed_key;      /* key of the row that was rejected */
    const char *failed;      /* SQLite's reason; NULL: no row was rejected */
    gis_side_thread *beside; /* the inserting thread; NULL: the caller's thread inserts */
} gis_sqlite_inserts;

/* Prepares insertion by a statement that ends with "VALUES ", followed by groups of parameters: a key, a blob, and
 * values (`columns` in all). False if SQLite is not available or rejects it. threads: at least 1; with more, rows are
 * inserted on another thread. The struct must not move in memory. */
bool gis_sqlite_inserts_begin(gis_sqlite_inserts *rows, void *database, const char *sql, size_t columns,
                              unsigned threads);
/* Adds a row; blob and texts are copied. False, with SQLite's message in *reason, if this row or one added before is
 * rejected; *key is then the key of the rejected row. */
bool gis_sqlite_inserts_add(gis_sqlite_inserts *rows, int64_t *key, const void *bytes, size_t size,
                            const gis_value *values, const char **reason);
/* Inserts all rows that were added, and waits for the end. */
bool gis_sqlite_inserts_flush(gis_sqlite_inserts *rows, int64_t *key, const char **reason);
/* Frees all; rows that were added but not yet handed over for insertion are dropped. */
void gis_sqlite_inserts_end(gis_sqlite_inserts *rows);

/* Does the first value of the query's first row equal `bytes` from offset `from` on? The `from` bytes before are copied
 * to `head`. */
bool gis_sqlite_says(void *database, const char *sql, void *head, size_t from, const void *bytes, size_t size);
/* Prints a number with SQLite's "%.18g", which in some versions gives fewer digits; "0" if SQLite is not available. */
enum { GIS_SQLITE_NUMBER = 64 };
void gis_sqlite_print_number(double x, char out[GIS_SQLITE_NUMBER]);
/* Runs a statement; false if that fails. */
bool gis_sqlite_run(void *database, const char *sql);

#endif
