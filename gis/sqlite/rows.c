/* rows.c: see rows.h. Types and numbers are those of SQLite's application interface, which does not change. */
#include "sqlite/rows.h"

#include "sqlite/find.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OK = 0, DONE = 101 };

typedef struct calls {
    const char *(*source_id)(void);
    int (*prepare)(void *, const char *, int, void **, const char **);
    int (*bind_number)(void *, int, int64_t);
    int (*bind_bytes)(void *, int, const void *, int, void (*)(void *));
    int (*step)(void *);
    int (*reset)(void *);
    int (*finalize)(void *);
    const char *(*error_message)(void *);
} calls;

/* Looked up once; the program's libraries stay as they are. */
static const calls *find_all(void)
{
    static calls sqlite;
    static bool looked, found;
    if (looked) return found ? &sqlite : NULL;
    looked = true;
    found = gis_sqlite_find("sqlite3_sourceid", &sqlite.source_id) &&
            gis_sqlite_find("sqlite3_prepare_v2", &sqlite.prepare) &&
            gis_sqlite_find("sqlite3_bind_int64", &sqlite.bind_number) &&
            gis_sqlite_find("sqlite3_bind_blob", &sqlite.bind_bytes) && gis_sqlite_find("sqlite3_step", &sqlite.step) &&
            gis_sqlite_find("sqlite3_reset", &sqlite.reset) && gis_sqlite_find("sqlite3_finalize", &sqlite.finalize) &&
            gis_sqlite_find("sqlite3_errmsg", &sqlite.error_message);
    return found ? &sqlite : NULL;
}

bool gis_sqlite_is_that_of(const char *source_id)
{
    const calls *sqlite = find_all();
    return sqlite && source_id && strcmp(sqlite->source_id(), source_id) == 0;
}

static bool fail(const gis_sqlite_rows *rows, gis_error *error)
{
    return gis_fail(error, "%s cannot be written: %s", rows->what, find_all()->error_message(rows->database));
}

bool gis_sqlite_rows_begin(gis_sqlite_rows *rows, void *database, const char *table, const char *what, gis_error *error)
{
    static const char head[] = "INSERT INTO ", tail[] = " VALUES (?1, ?2)";
    *rows = (gis_sqlite_rows){.database = database, .what = what};
    char *sql = malloc(sizeof head + strlen(table) + sizeof tail);
    if (!sql) return gis_no_memory(error);
    const int length = sprintf(sql, "%s%s%s", head, table, tail);
    const int result = find_all()->prepare(database, sql, length + 1, &rows->statement, NULL);
    free(sql);
    return result == OK || fail(rows, error);
}

/* bound: its parameters are. */
static bool insert(const gis_sqlite_rows *rows, bool bound, gis_error *error)
{
    const calls *sqlite = find_all();
    const bool done = bound && sqlite->step(rows->statement) == DONE;
    return (sqlite->reset(rows->statement) == OK && done) || fail(rows, error);
}

bool gis_sqlite_rows_add(gis_sqlite_rows *rows, int64_t key, int64_t value, gis_error *error)
{
    const calls *sqlite = find_all();
    return insert(rows,
                  sqlite->bind_number(rows->statement, 1, key) == OK &&
                      sqlite->bind_number(rows->statement, 2, value) == OK,
                  error);
}

bool gis_sqlite_rows_add_bytes(gis_sqlite_rows *rows, int64_t key, const void *bytes, size_t n, gis_error *error)
{
    const calls *sqlite = find_all();
    return insert(rows,
                  sqlite->bind_number(rows->statement, 1, key) == OK &&
                      sqlite->bind_bytes(rows->statement, 2, bytes, (int)n, NULL) == OK,
                  error);
}

void gis_sqlite_rows_end(gis_sqlite_rows *rows)
{
    if (rows->statement) find_all()->finalize(rows->statement);
    *rows = (gis_sqlite_rows){0};
}
