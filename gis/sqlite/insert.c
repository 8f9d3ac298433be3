/* insert.c: see insert.h. Types and numbers are those of SQLite's application interface, which does not change. */
#include "sqlite/insert.h"

#include "sqlite/find.h"

#include <string.h>

enum { OK = 0, ROW = 100, DONE = 101 };

typedef struct calls {
    int (*prepare)(void *, const char *, int, void **, const char **);
    int (*bind_null)(void *, int);
    int (*bind_number)(void *, int, int64_t);
    int (*bind_real)(void *, int, double);
    int (*bind_text)(void *, int, const char *, int, void (*)(void *));
    int (*bind_bytes)(void *, int, const void *, int, void (*)(void *));
    int (*step)(void *);
    int (*reset)(void *);
    int (*finalize)(void *);
    const void *(*column_bytes)(void *, int);
    int (*column_size)(void *, int);
    int (*run)(void *, const char *, int (*)(void *, int, char **, char **), void *, char **);
    const char *(*error_message)(void *);
} calls;

/* Looked up once; the program's libraries stay as they are. */
static const calls *find_all(void)
{
    static calls sqlite;
    static bool looked, found;
    if (looked) return found ? &sqlite : NULL;
    looked = true;
    found = gis_sqlite_find("sqlite3_prepare_v2", &sqlite.prepare) &&
            gis_sqlite_find("sqlite3_bind_null", &sqlite.bind_null) &&
            gis_sqlite_find("sqlite3_bind_int64", &sqlite.bind_number) &&
            gis_sqlite_find("sqlite3_bind_double", &sqlite.bind_real) &&
            gis_sqlite_find("sqlite3_bind_text", &sqlite.bind_text) &&
            gis_sqlite_find("sqlite3_bind_blob", &sqlite.bind_bytes) && gis_sqlite_find("sqlite3_step", &sqlite.step) &&
            gis_sqlite_find("sqlite3_reset", &sqlite.reset) && gis_sqlite_find("sqlite3_finalize", &sqlite.finalize) &&
            gis_sqlite_find("sqlite3_column_blob", &sqlite.column_bytes) &&
            gis_sqlite_find("sqlite3_column_bytes", &sqlite.column_size) &&
            gis_sqlite_find("sqlite3_exec", &sqlite.run) && gis_sqlite_find("sqlite3_errmsg", &sqlite.error_message);
    return found ? &sqlite : NULL;
}

void *gis_sqlite_insert_begin(void *database, const char *sql)
{
    void *statement = NULL;
    return find_all() && find_all()->prepare(database, sql, -1, &statement, NULL) == OK ? statement : NULL;
}

static bool bind(void *statement, int at, const gis_value *value)
{
    const calls *sqlite = find_all();
    switch (value->kind) {
    case GIS_INTEGER: return sqlite->bind_number(statement, at, value->as.integer) == OK;
    case GIS_REAL: return sqlite->bind_real(statement, at, value->as.real) == OK;
    case GIS_TEXT: return sqlite->bind_text(statement, at, value->as.text, -1, NULL) == OK;
    default: return sqlite->bind_null(statement, at) == OK;
    }
}

bool gis_sqlite_insert(void *database, void *statement, int64_t key, const void *bytes, size_t size,
                       const gis_value *values, int n, const char **reason)
{
    const calls *sqlite = find_all();
    bool done =
        sqlite->bind_number(statement, 1, key) == OK && sqlite->bind_bytes(statement, 2, bytes, (int)size, NULL) == OK;
    for (int i = 0; done && i < n; i++) done = bind(statement, i + 3, &values[i]);
    done = done && sqlite->step(statement) == DONE;
    done = sqlite->reset(statement) == OK && done;
    *reason = done ? NULL : sqlite->error_message(database);
    return done;
}

void gis_sqlite_insert_end(void *statement)
{
    if (statement) find_all()->finalize(statement);
}

bool gis_sqlite_says(void *database, const char *sql, void *head, size_t from, const void *bytes, size_t size)
{
    const calls *sqlite = find_all();
    void *statement = gis_sqlite_insert_begin(database, sql);
    if (!statement) return false;
    bool same = sqlite->step(statement) == ROW;
    const unsigned char *said = same ? sqlite->column_bytes(statement, 0) : NULL;
    same = said && (size_t)sqlite->column_size(statement, 0) == from + size && memcmp(said + from, bytes, size) == 0;
    if (same) memcpy(head, said, from);
    sqlite->finalize(statement);
    return same;
}

bool gis_sqlite_run(void *database, const char *sql)
{
    return find_all() && find_all()->run(database, sql, NULL, NULL, NULL) == OK;
}
