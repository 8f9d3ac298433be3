/* insert.c: see insert.h. */
#include "sqlite/insert.h"

#include "sqlite/statement.h"

#include <string.h>

void *gis_sqlite_insert_begin(void *database, const char *sql)
{
    void *statement = NULL;
    return gis_sqlite_find_functions() &&
                   gis_sqlite_find_functions()->prepare(database, sql, -1, &statement, NULL) == GIS_SQLITE_OK
               ? statement
               : NULL;
}

static bool bind(void *statement, int at, const gis_value *value)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    switch (value->kind) {
    case GIS_INTEGER: return sqlite->bind_number(statement, at, value->as.integer) == GIS_SQLITE_OK;
    case GIS_REAL: return sqlite->bind_real(statement, at, value->as.real) == GIS_SQLITE_OK;
    case GIS_TEXT: return sqlite->bind_text(statement, at, value->as.text, -1, NULL) == GIS_SQLITE_OK;
    default: return sqlite->bind_null(statement, at) == GIS_SQLITE_OK;
    }
}

bool gis_sqlite_insert(void *database, void *statement, int64_t key, const void *bytes, size_t size,
                       const gis_value *values, int n, const char **reason)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    bool done = sqlite->bind_number(statement, 1, key) == GIS_SQLITE_OK &&
                sqlite->bind_bytes(statement, 2, bytes, (int)size, NULL) == GIS_SQLITE_OK;
    for (int i = 0; done && i < n; i++) done = bind(statement, i + 3, &values[i]);
    done = done && sqlite->step(statement) == GIS_SQLITE_DONE;
    done = sqlite->reset(statement) == GIS_SQLITE_OK && done;
    *reason = done ? NULL : sqlite->error_message(database);
    return done;
}

void gis_sqlite_insert_end(void *statement)
{
    if (statement) gis_sqlite_find_functions()->finalize(statement);
}

bool gis_sqlite_says(void *database, const char *sql, void *head, size_t from, const void *bytes, size_t size)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    void *statement = gis_sqlite_insert_begin(database, sql);
    if (!statement) return false;
    bool same = sqlite->step(statement) == GIS_SQLITE_ROW;
    const unsigned char *said = same ? sqlite->column_bytes(statement, 0) : NULL;
    same = said && (size_t)sqlite->column_size(statement, 0) == from + size && memcmp(said + from, bytes, size) == 0;
    if (same) memcpy(head, said, from);
    sqlite->finalize(statement);
    return same;
}

bool gis_sqlite_run(void *database, const char *sql)
{
    return gis_sqlite_find_functions() &&
           gis_sqlite_find_functions()->run(database, sql, NULL, NULL, NULL) == GIS_SQLITE_OK;
}
