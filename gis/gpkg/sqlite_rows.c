/* sqlite_rows.c: see sqlite_rows.h. */
#include "gpkg/sqlite_rows.h"

#include "gpkg/sqlite_statement.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool gis_sqlite_is_that_of(const char *source_id)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    return sqlite && source_id && strcmp(sqlite->source_id(), source_id) == 0;
}

static bool fail_rows(const gis_sqlite_rows *rows, gis_error *error)
{
    return gis_fail(error, "%s cannot be written: %s", rows->what,
                    gis_sqlite_find_functions()->error_message(rows->database));
}

/* Number of rows inserted by one statement, so that the cost of starting and ending a statement matters little. */
enum { AT_ONCE = 100 };

/* Prepares a statement for n rows of both columns or, if `values` is given, of the column of that name alone. */
static bool prepare_rows(const gis_sqlite_rows *rows, const char *table, const char *values, size_t n, void **statement,
                         gis_error *error)
{
    static const char head[] = "INSERT INTO ", tail[] = " () VALUES ", row[] = ", (?, ?)";
    const size_t size = sizeof head + strlen(table) + (values ? strlen(values) : 0) + sizeof tail + n * sizeof row;
    char *sql = malloc(size);
    if (!sql) return gis_no_memory(error);
    int length =
        values ? sprintf(sql, "%s%s (%s) VALUES ", head, table, values) : sprintf(sql, "%s%s VALUES ", head, table);
    for (size_t k = 0; k < n; k++) length += sprintf(sql + length, "%s%s", k ? ", " : "", values ? "(?)" : "(?, ?)");
    const int result = gis_sqlite_find_functions()->prepare(rows->database, sql, length + 1, statement, NULL);
    free(sql);
    return result == GIS_SQLITE_OK || fail_rows(rows, error);
}

bool gis_sqlite_rows_begin(gis_sqlite_rows *rows, void *database, const char *table, const char *many, const char *what,
                           gis_error *error)
{
    *rows = (gis_sqlite_rows){.database = database, .what = what};
    return prepare_rows(rows, table, NULL, 1, &rows->one, error) &&
           (!many || (prepare_rows(rows, table, NULL, AT_ONCE, &rows->many, error) &&
                      prepare_rows(rows, table, many, AT_ONCE, &rows->next, error)));
}

/* Runs a statement and resets it. bound: all its parameters were bound. */
static bool insert_rows(const gis_sqlite_rows *rows, void *statement, bool bound, gis_error *error)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    const bool done = bound && sqlite->step(statement) == GIS_SQLITE_DONE;
    return (sqlite->reset(statement) == GIS_SQLITE_OK && done) || fail_rows(rows, error);
}

/* Would SQLite assign exactly these keys by itself, that is, is each of them the previous key plus 1? False for the
 * first row, since no previous key is known, and if rows->next is NULL. */
static bool keys_follow(const gis_sqlite_rows *rows, const int64_t (*row)[2], size_t n)
{
    int64_t last = rows->last;
    bool so = rows->any && rows->next;
    for (size_t k = 0; k < n && so; last = row[k++][0]) so = last < INT64_MAX && row[k][0] == last + 1;
    return so;
}

/* Remembers the last key. If a key does not ascend, the greatest key is not the last one, so SQLite's own keys are not
 * used any more. */
static void note_keys(gis_sqlite_rows *rows, const int64_t (*row)[2], size_t n)
{
    for (size_t k = 0; k < n && rows->next; k++) {
        if (rows->any && row[k][0] <= rows->last) {
            gis_sqlite_find_functions()->finalize(rows->next);
            rows->next = NULL;
        }
        rows->last = row[k][0];
        rows->any = true;
    }
}

bool gis_sqlite_rows_add(gis_sqlite_rows *rows, const int64_t (*row)[2], size_t n, gis_error *error)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    for (size_t done = 0; done < n;) {
        const size_t now = rows->many && n - done >= AT_ONCE ? AT_ONCE : 1;
        const bool next = now > 1 && keys_follow(rows, row + done, now);
        void *statement = next ? rows->next : now > 1 ? rows->many : rows->one;
        bool bound = true;
        int at = 0;
        for (size_t k = 0; k < now && bound; k++)
            for (int column = next; column < 2 && bound; column++)
                bound = sqlite->bind_number(statement, ++at, row[done + k][column]) == GIS_SQLITE_OK;
        if (!insert_rows(rows, statement, bound, error)) return false;
        note_keys(rows, row + done, now);
        done += now;
    }
    return true;
}

bool gis_sqlite_rows_add_bytes(gis_sqlite_rows *rows, int64_t key, const void *bytes, size_t n, gis_error *error)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    return insert_rows(rows, rows->one,
                       sqlite->bind_number(rows->one, 1, key) == GIS_SQLITE_OK &&
                           sqlite->bind_bytes(rows->one, 2, bytes, (int)n, NULL) == GIS_SQLITE_OK,
                       error);
}

void gis_sqlite_rows_end(gis_sqlite_rows *rows)
{
    if (rows->one) gis_sqlite_find_functions()->finalize(rows->one);
    if (rows->many) gis_sqlite_find_functions()->finalize(rows->many);
    if (rows->next) gis_sqlite_find_functions()->finalize(rows->next);
    *rows = (gis_sqlite_rows){0};
}
