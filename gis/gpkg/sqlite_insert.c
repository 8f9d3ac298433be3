/* sqlite_insert.c: see sqlite_insert.h. */
#include "gpkg/sqlite_insert.h"

#include "base/array.h"
#include "gpkg/sqlite_statement.h"

#include <stdlib.h>
#include <string.h>

/* ---- Statements -------------------------------------------------------------------------------------------------- */

/* ROWS_AT_ONCE: rows of one statement; more would not be faster. MOST_PARAMETERS: the number of parameters that every
 * SQLite accepts. MOST_STATEMENTS, MOST_HELD: a batch for the other thread has at most this number of statements, and
 * of bytes; smaller batches cost more, since the thread is woken more often. */
enum { ROWS_AT_ONCE = 64, MOST_PARAMETERS = 999, MOST_STATEMENTS = 32, MOST_HELD = 1 << 20 };

static void *prepare_statement(void *database, const char *sql)
{
    void *statement = NULL;
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    return sqlite && sqlite->prepare(database, sql, -1, &statement, NULL) == GIS_SQLITE_OK ? statement : NULL;
}

/* Returns a statement that inserts n rows; NULL if SQLite rejects it. */
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
    void *statement = prepare_statement(rows->database, all);
    free(all);
    return statement;
}

bool gis_sqlite_inserts_begin(gis_sqlite_inserts *rows, void *database, const char *sql, size_t columns,
                              unsigned threads)
{
    *rows = (gis_sqlite_inserts){.database = database, .columns = columns};
    rows->one = prepare_rows(rows, sql, 1);
    if (!rows->one) return false;
    rows->at_once = MOST_PARAMETERS / columns < ROWS_AT_ONCE ? MOST_PARAMETERS / columns : ROWS_AT_ONCE;
    if (rows->at_once > 1) rows->many = prepare_rows(rows, sql, rows->at_once);
    if (!rows->many) rows->at_once = 1;
    for (int k = 0; k < GIS_SIDE_THREAD_PIECES; k++) rows->batch[k].of = rows;
    if (threads > 1) rows->beside = gis_side_thread_new();
    return true;
}

static void free_batch(gis_sqlite_batch *batch)
{
    free(batch->held);
    free(batch->buffer);
}

void gis_sqlite_inserts_end(gis_sqlite_inserts *rows)
{
    gis_side_thread_free(rows->beside);
    if (rows->one) gis_sqlite_find_functions()->finalize(rows->one);
    if (rows->many) gis_sqlite_find_functions()->finalize(rows->many);
    for (int k = 0; k < GIS_SIDE_THREAD_PIECES; k++) free_batch(&rows->batch[k]);
    *rows = (gis_sqlite_inserts){0};
}

/* ---- Inserting the rows of a batch ------------------------------------------------------------------------------- */

static bool bind_value(const gis_sqlite_batch *batch, void *statement, int at, const gis_sqlite_held *held)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    const unsigned char *bytes = batch->buffer + held->at;
    if (held->bytes) return sqlite->bind_bytes(statement, at, bytes, (int)held->size, NULL) == GIS_SQLITE_OK;
    switch (held->value.kind) {
    case GIS_INTEGER: return sqlite->bind_number(statement, at, held->value.as.integer) == GIS_SQLITE_OK;
    case GIS_REAL: return sqlite->bind_real(statement, at, held->value.as.real) == GIS_SQLITE_OK;
    case GIS_TEXT: return sqlite->bind_text(statement, at, (const char *)bytes, (int)held->size, NULL) == GIS_SQLITE_OK;
    default: return sqlite->bind_null(statement, at) == GIS_SQLITE_OK;
    }
}

/* Inserts n rows from `first` on with a statement for n rows. Returns SQLite's result code. */
static int send_rows(const gis_sqlite_batch *batch, void *statement, size_t first, size_t n)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    const size_t columns = batch->of->columns;
    for (size_t k = 0; k < n * columns; k++)
        if (!bind_value(batch, statement, (int)k + 1, &batch->held[first * columns + k])) return GIS_SQLITE_MISUSE;
    const int stepped = sqlite->step(statement), reset = sqlite->reset(statement);
    return stepped == GIS_SQLITE_DONE ? reset : reset != GIS_SQLITE_OK ? reset : stepped;
}

/* Returns true if a single row violated a constraint. Then no row of the statement was inserted, and the transaction
 * continues; each row is inserted separately, to identify the one at fault. After any other failure SQLite may have
 * rolled the transaction back, and no further statement is run. */
static bool is_of_one_row(int outcome) { return (outcome & GIS_SQLITE_KIND) == GIS_SQLITE_CONSTRAINT; }

/* Inserts n rows from *done on: with one statement if it is for n rows, else one by one. *done is advanced by the
 * number of rows inserted. */
static int send_some(const gis_sqlite_batch *batch, size_t n, size_t *done)
{
    const gis_sqlite_inserts *rows = batch->of;
    const size_t end = *done + n;
    int outcome = GIS_SQLITE_OK;
    if (rows->many && n == rows->at_once) {
        outcome = send_rows(batch, rows->many, *done, n);
        if (outcome == GIS_SQLITE_OK) *done = end;
        if (is_of_one_row(outcome)) outcome = GIS_SQLITE_OK;
    }
    for (; outcome == GIS_SQLITE_OK && *done < end; *done += outcome == GIS_SQLITE_OK)
        outcome = send_rows(batch, rows->one, *done, 1);
    return outcome;
}

/* Inserts all rows of a batch. After a row was rejected no later row is inserted. */
static void send_all(void *context)
{
    gis_sqlite_batch *batch = context;
    gis_sqlite_inserts *rows = batch->of;
    size_t done = 0;
    int outcome = GIS_SQLITE_OK;
    while (!rows->failed && outcome == GIS_SQLITE_OK && done < batch->rows) {
        const size_t left = batch->rows - done;
        outcome = send_some(batch, left < rows->at_once ? left : rows->at_once, &done);
    }
    if (outcome == GIS_SQLITE_OK) return;
    rows->failed = gis_sqlite_find_functions()->error_message(rows->database);
    rows->failed_key = batch->held[done * rows->columns].value.as.integer;
    batch->refused = true;
}

/* Waits until all batches handed over are inserted. Returns false, with *key and *reason, if a row was rejected. */
static bool await_batches(gis_sqlite_inserts *rows, int64_t *key, const char **reason)
{
    gis_side_thread_wait(rows->beside, 0);
    if (!rows->failed) return true;
    *key = rows->failed_key;
    *reason = rows->failed;
    for (int k = 0; k < GIS_SIDE_THREAD_PIECES; k++) rows->batch[k].rows = rows->batch[k].size = 0;
    return false;
}

/* Hands the current batch over for insertion, and waits until the oldest batch is finished and can be reused. */
static bool start_batch(gis_sqlite_inserts *rows, int64_t *key, const char **reason)
{
    gis_side_thread_do(rows->beside, send_all, &rows->batch[rows->added_to]);
    gis_side_thread_wait(rows->beside, GIS_SIDE_THREAD_PIECES - 1);
    rows->added_to = (rows->added_to + 1) % GIS_SIDE_THREAD_PIECES;
    gis_sqlite_batch *next = &rows->batch[rows->added_to];
    next->rows = next->size = 0;
    return (rows->beside && !next->refused) || await_batches(rows, key, reason);
}

bool gis_sqlite_inserts_flush(gis_sqlite_inserts *rows, int64_t *key, const char **reason)
{
    *reason = NULL;
    return (rows->batch[rows->added_to].rows == 0 || start_batch(rows, key, reason)) &&
           await_batches(rows, key, reason);
}

/* ---- Collecting rows --------------------------------------------------------------------------------------------- */

static bool hold_bytes(gis_sqlite_batch *batch, gis_sqlite_held *held, const void *bytes, size_t size)
{
    if (!gis_array_reserve(&batch->buffer, &batch->buffer_room, batch->size + size, 1)) return false;
    held->at = batch->size;
    held->size = size;
    if (size) memcpy(batch->buffer + batch->size, bytes, size);
    batch->size += size;
    return true;
}

/* Appends a row to the batch. Returns false if out of memory. */
static bool hold_row(gis_sqlite_batch *batch, size_t columns, int64_t key, const void *bytes, size_t size,
                     const gis_value *values)
{
    const size_t first = batch->rows * columns;
    if (!gis_array_reserve(&batch->held, &batch->room, first + columns, sizeof *batch->held)) return false;
    gis_sqlite_held *row = batch->held + first;
    row[0] = (gis_sqlite_held){.value = {GIS_INTEGER, {.integer = key}}};
    row[1] = (gis_sqlite_held){.bytes = true};
    bool done = hold_bytes(batch, &row[1], bytes, size);
    for (size_t k = 2; done && k < columns; k++) {
        row[k] = (gis_sqlite_held){.value = values[k - 2]};
        if (row[k].value.kind == GIS_TEXT)
            done = hold_bytes(batch, &row[k], row[k].value.as.text, strlen(row[k].value.as.text));
    }
    batch->rows += done;
    return done;
}

bool gis_sqlite_inserts_add(gis_sqlite_inserts *rows, int64_t *key, const void *bytes, size_t size,
                            const gis_value *values, const char **reason)
{
    gis_sqlite_batch *batch = &rows->batch[rows->added_to];
    if (!hold_row(batch, rows->columns, *key, bytes, size, values)) {
        *reason = "out of memory";
        return false;
    }
    return (batch->rows < MOST_STATEMENTS * rows->at_once && batch->size < MOST_HELD) || start_batch(rows, key, reason);
}

/* ---- Other direct access ----------------------------------------------------------------------------------------- */

bool gis_sqlite_says(void *database, const char *sql, void *head, size_t from, const void *bytes, size_t size)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    void *statement = prepare_statement(database, sql);
    if (!statement) return false;
    bool same = sqlite->step(statement) == GIS_SQLITE_ROW;
    const unsigned char *said = same ? sqlite->column_bytes(statement, 0) : NULL;
    same = said && (size_t)sqlite->column_size(statement, 0) == from + size && memcmp(said + from, bytes, size) == 0;
    if (same) memcpy(head, said, from);
    sqlite->finalize(statement);
    return same;
}

void gis_sqlite_print_number(double x, char out[GIS_SQLITE_NUMBER])
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    if (sqlite)
        sqlite->print(GIS_SQLITE_NUMBER, out, "%.18g", x);
    else
        memcpy(out, "0", 2);
}

bool gis_sqlite_run(void *database, const char *sql)
{
    return gis_sqlite_find_functions() &&
           gis_sqlite_find_functions()->run(database, sql, NULL, NULL, NULL) == GIS_SQLITE_OK;
}
