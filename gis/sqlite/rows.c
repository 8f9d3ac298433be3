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

/* The parameters are the value, or the bytes, and the keys. */
static bool prepare(gis_sqlite_rows *rows, const char *table, size_t n, void **statement, gis_error *error)
{
    static const char head[] = "INSERT INTO ", tail[] = " VALUES (?2, ?1)";
    enum { ROW = 32 }; /* ", (?123, ?1)" */
    char *sql = malloc(sizeof head + strlen(table) + sizeof tail + n * ROW);
    if (!sql) return gis_no_memory(error);
    int length = sprintf(sql, "%s%s%s", head, table, tail);
    for (size_t k = 1; k < n; k++) length += sprintf(sql + length, ", (?%zu, ?1)", k + 2);
    const int result = find_all()->prepare(rows->database, sql, length + 1, statement, NULL);
    free(sql);
    return result == OK || fail(rows, error);
}

bool gis_sqlite_rows_begin(gis_sqlite_rows *rows, void *database, const char *table, size_t at_once, const char *what,
                           gis_error *error)
{
    *rows = (gis_sqlite_rows){.database = database, .at_once = at_once, .what = what};
    return prepare(rows, table, 1, &rows->one, error) &&
           (at_once < 2 || prepare(rows, table, at_once, &rows->many, error));
}

/* bound: its parameters are. */
static bool insert(const gis_sqlite_rows *rows, void *statement, bool bound, gis_error *error)
{
    const calls *sqlite = find_all();
    const bool done = bound && sqlite->step(statement) == DONE;
    return (sqlite->reset(statement) == OK && done) || fail(rows, error);
}

static bool bind_keys(void *statement, const int64_t *key, size_t n)
{
    bool bound = true;
    for (size_t k = 0; k < n && bound; k++) bound = find_all()->bind_number(statement, (int)k + 2, key[k]) == OK;
    return bound;
}

bool gis_sqlite_rows_add(gis_sqlite_rows *rows, const int64_t *key, size_t n, int64_t value, gis_error *error)
{
    for (size_t done = 0; done < n;) {
        const bool many = rows->many && n - done >= rows->at_once;
        const size_t now = many ? rows->at_once : 1;
        void *statement = many ? rows->many : rows->one;
        const bool bound = find_all()->bind_number(statement, 1, value) == OK && bind_keys(statement, key + done, now);
        if (!insert(rows, statement, bound, error)) return false;
        done += now;
    }
    return true;
}

bool gis_sqlite_rows_add_bytes(gis_sqlite_rows *rows, int64_t key, const void *bytes, size_t n, gis_error *error)
{
    const bool bound = find_all()->bind_bytes(rows->one, 1, bytes, (int)n, NULL) == OK && bind_keys(rows->one, &key, 1);
    return insert(rows, rows->one, bound, error);
}

void gis_sqlite_rows_end(gis_sqlite_rows *rows)
{
    if (rows->one) find_all()->finalize(rows->one);
    if (rows->many) find_all()->finalize(rows->many);
    *rows = (gis_sqlite_rows){0};
}
