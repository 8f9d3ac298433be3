/* rows.c: see rows.h. */
#include "sqlite/rows.h"

#include "sqlite/statement.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool gis_sqlite_is_that_of(const char *source_id)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    return sqlite && source_id && strcmp(sqlite->source_id(), source_id) == 0;
}

static bool fail(const gis_sqlite_rows *rows, gis_error *error)
{
    return gis_fail(error, "%s cannot be written: %s", rows->what,
                    gis_sqlite_find_functions()->error_message(rows->database));
}

/* Rows of one statement: what beginning and ending one costs is a small part of them then. */
enum { AT_ONCE = 100 };

static bool prepare(const gis_sqlite_rows *rows, const char *table, size_t n, void **statement, gis_error *error)
{
    static const char head[] = "INSERT INTO ", tail[] = " VALUES (?, ?)", row[] = ", (?, ?)";
    char *sql = malloc(sizeof head + strlen(table) + sizeof tail + n * sizeof row);
    if (!sql) return gis_no_memory(error);
    int length = sprintf(sql, "%s%s%s", head, table, tail);
    for (size_t k = 1; k < n; k++) length += sprintf(sql + length, "%s", row);
    const int result = gis_sqlite_find_functions()->prepare(rows->database, sql, length + 1, statement, NULL);
    free(sql);
    return result == GIS_SQLITE_OK || fail(rows, error);
}

bool gis_sqlite_rows_begin(gis_sqlite_rows *rows, void *database, const char *table, bool many, const char *what,
                           gis_error *error)
{
    *rows = (gis_sqlite_rows){.database = database, .what = what};
    return prepare(rows, table, 1, &rows->one, error) && (!many || prepare(rows, table, AT_ONCE, &rows->many, error));
}

/* bound: its parameters are. */
static bool insert(const gis_sqlite_rows *rows, void *statement, bool bound, gis_error *error)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    const bool done = bound && sqlite->step(statement) == GIS_SQLITE_DONE;
    return (sqlite->reset(statement) == GIS_SQLITE_OK && done) || fail(rows, error);
}

bool gis_sqlite_rows_add(gis_sqlite_rows *rows, const int64_t (*row)[2], size_t n, gis_error *error)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    for (size_t done = 0; done < n;) {
        const size_t now = rows->many && n - done >= AT_ONCE ? AT_ONCE : 1;
        void *statement = now > 1 ? rows->many : rows->one;
        bool bound = true;
        for (size_t k = 0; k < 2 * now && bound; k++)
            bound = sqlite->bind_number(statement, (int)k + 1, row[done + k / 2][k % 2]) == GIS_SQLITE_OK;
        if (!insert(rows, statement, bound, error)) return false;
        done += now;
    }
    return true;
}

bool gis_sqlite_rows_add_bytes(gis_sqlite_rows *rows, int64_t key, const void *bytes, size_t n, gis_error *error)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    return insert(rows, rows->one,
                  sqlite->bind_number(rows->one, 1, key) == GIS_SQLITE_OK &&
                      sqlite->bind_bytes(rows->one, 2, bytes, (int)n, NULL) == GIS_SQLITE_OK,
                  error);
}

void gis_sqlite_rows_end(gis_sqlite_rows *rows)
{
    if (rows->one) gis_sqlite_find_functions()->finalize(rows->one);
    if (rows->many) gis_sqlite_find_functions()->finalize(rows->many);
    *rows = (gis_sqlite_rows){0};
}
