/* insert.c: see insert.h. */
#include "sqlite/insert.h"

#include "base/array.h"
#include "sqlite/statement.h"

#include <stdlib.h>
#include <string.h>

/* ---- Statements -------------------------------------------------------------------------------------------------- */

/* Rows of one statement: with more a row costs no less. Parameters of one: what every SQLite takes. Bytes that are held
 * back for it. */
enum { ROWS_AT_ONCE = 64, MOST_PARAMETERS = 999, MOST_HELD = 1 << 20 };

static void *prepare(void *database, const char *sql)
{
    void *statement = NULL;
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    return sqlite && sqlite->prepare(database, sql, -1, &statement, NULL) == GIS_SQLITE_OK ? statement : NULL;
}

/* The statement for so many rows; NULL if it is not taken. */
static void *prepare_rows(const gis_sqlite_inserts *rows, const char *sql, size_t n)
{
    const size_t start = strlen(sql);
    char *all = malloc(start + n * (3 * rows->columns + 3) + 1);
    if (!all) return NULL;
    memcpy(all, sql, start);
    char *at = all + start;
    for (size_t k = 0; k < n * rows->columns; k++) {
        const bool first = k % rows->columns == 0, last = (k + 1) % rows->columns == 0;
        if (first && k > 0) *at++ = ',';
        *at++ = first ? '(' : ',';
        *at++ = '?';
        if (last) *at++ = ')';
    }
    *at = 0;
    void *statement = prepare(rows->database, all);
    free(all);
    return statement;
}

bool gis_sqlite_inserts_begin(gis_sqlite_inserts *rows, void *database, const char *sql, size_t columns)
{
    *rows = (gis_sqlite_inserts){.database = database, .columns = columns};
    rows->one = prepare_rows(rows, sql, 1);
    if (!rows->one) return false;
    rows->at_once = MOST_PARAMETERS / columns < ROWS_AT_ONCE ? MOST_PARAMETERS / columns : ROWS_AT_ONCE;
    if (rows->at_once > 1) rows->many = prepare_rows(rows, sql, rows->at_once);
    if (!rows->many) rows->at_once = 1;
    return true;
}

void gis_sqlite_inserts_end(gis_sqlite_inserts *rows)
{
    if (rows->one) gis_sqlite_find_functions()->finalize(rows->one);
    if (rows->many) gis_sqlite_find_functions()->finalize(rows->many);
    free(rows->held);
    free(rows->buffer);
    *rows = (gis_sqlite_inserts){0};
}

/* ---- What is held back goes in ----------------------------------------------------------------------------------- */

static bool bind(const gis_sqlite_inserts *rows, void *statement, int at, const gis_sqlite_held *held)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    const unsigned char *bytes = rows->buffer + held->at;
    if (held->bytes) return sqlite->bind_bytes(statement, at, bytes, (int)held->size, NULL) == GIS_SQLITE_OK;
    switch (held->value.kind) {
    case GIS_INTEGER: return sqlite->bind_number(statement, at, held->value.as.integer) == GIS_SQLITE_OK;
    case GIS_REAL: return sqlite->bind_real(statement, at, held->value.as.real) == GIS_SQLITE_OK;
    case GIS_TEXT: return sqlite->bind_text(statement, at, (const char *)bytes, (int)held->size, NULL) == GIS_SQLITE_OK;
    default: return sqlite->bind_null(statement, at) == GIS_SQLITE_OK;
    }
}

/* Rows from `first` on, as many as the statement has. The outcome of SQLite. */
static int send(const gis_sqlite_inserts *rows, void *statement, size_t first, size_t n)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    for (size_t k = 0; k < n * rows->columns; k++)
        if (!bind(rows, statement, (int)k + 1, &rows->held[first * rows->columns + k])) return GIS_SQLITE_MISUSE;
    const int stepped = sqlite->step(statement), reset = sqlite->reset(statement);
    return stepped == GIS_SQLITE_DONE ? reset : reset != GIS_SQLITE_OK ? reset : stepped;
}

/* Where one of the rows broke a rule of the table none of them is in it, and all else is as it was: so each is asked by
 * itself, and it is known which. After any other failure SQLite may have taken back the whole transaction, and nothing
 * more is asked of it. */
static bool is_of_one_row(int outcome) { return (outcome & GIS_SQLITE_KIND) == GIS_SQLITE_CONSTRAINT; }

bool gis_sqlite_inserts_flush(gis_sqlite_inserts *rows, int64_t *key, const char **reason)
{
    size_t done = 0;
    int outcome = GIS_SQLITE_OK;
    if (rows->many && rows->rows == rows->at_once) {
        outcome = send(rows, rows->many, 0, rows->rows);
        if (outcome == GIS_SQLITE_OK) done = rows->rows;
        if (is_of_one_row(outcome)) outcome = GIS_SQLITE_OK;
    }
    for (; outcome == GIS_SQLITE_OK && done < rows->rows; done += outcome == GIS_SQLITE_OK)
        outcome = send(rows, rows->one, done, 1);
    *reason = outcome == GIS_SQLITE_OK ? NULL : gis_sqlite_find_functions()->error_message(rows->database);
    if (outcome != GIS_SQLITE_OK) *key = rows->held[done * rows->columns].value.as.integer;
    rows->rows = rows->size = 0;
    return outcome == GIS_SQLITE_OK;
}

/* ---- Holding back ------------------------------------------------------------------------------------------------ */

static bool hold(gis_sqlite_inserts *rows, gis_sqlite_held *held, const void *bytes, size_t size)
{
    if (!gis_array_reserve(&rows->buffer, &rows->buffer_room, rows->size + size, 1)) return false;
    held->at = rows->size;
    held->size = size;
    if (size) memcpy(rows->buffer + rows->size, bytes, size);
    rows->size += size;
    return true;
}

/* Puts the row behind those that are held back; false if memory is out. */
static bool hold_row(gis_sqlite_inserts *rows, int64_t key, const void *bytes, size_t size, const gis_value *values)
{
    const size_t first = rows->rows * rows->columns;
    if (!gis_array_reserve(&rows->held, &rows->room, first + rows->columns, sizeof *rows->held)) return false;
    gis_sqlite_held *row = rows->held + first;
    row[0] = (gis_sqlite_held){.value = {GIS_INTEGER, {.integer = key}}};
    row[1] = (gis_sqlite_held){.bytes = true};
    bool done = hold(rows, &row[1], bytes, size);
    for (size_t k = 2; done && k < rows->columns; k++) {
        row[k] = (gis_sqlite_held){.value = values[k - 2]};
        if (row[k].value.kind == GIS_TEXT)
            done = hold(rows, &row[k], row[k].value.as.text, strlen(row[k].value.as.text));
    }
    rows->rows += done;
    return done;
}

bool gis_sqlite_inserts_add(gis_sqlite_inserts *rows, int64_t *key, const void *bytes, size_t size,
                            const gis_value *values, const char **reason)
{
    if (!hold_row(rows, *key, bytes, size, values)) {
        *reason = "out of memory";
        return false;
    }
    return (rows->rows < rows->at_once && rows->size < MOST_HELD) || gis_sqlite_inserts_flush(rows, key, reason);
}

/* ---- Beside rows ------------------------------------------------------------------------------------------------- */

bool gis_sqlite_says(void *database, const char *sql, void *head, size_t from, const void *bytes, size_t size)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    void *statement = prepare(database, sql);
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
