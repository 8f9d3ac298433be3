/* table.c: see table.h. The SELECT is the same as GDAL's, so rows come in GDAL's order. If a row cannot be read, the
 * error is ignored here, since GDAL reads the layer again and reports it. If that order is the order of keys, the rows
 * of the second half are read by another thread through a second connection. */
#include "gpkg/table.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/path.h"
#include "base/side_thread.h"
#include "gpkg/blob.h"
#include "gpkg/second_connection.h"
#include "gpkg/sqlite_names.h"
#include "gpkg/sqlite_select.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Columns of the SELECT; the fields follow. */
enum { FID, GEOMETRY, FIELDS };

static char *select_statement(OGRLayerH layer)
{
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
    char *sql = gis_sql_append_name(CPLStrdup("SELECT "), OGR_L_GetFIDColumn(layer));
    sql = gis_sql_append_name(gis_sql_append(sql, ", "), OGR_L_GetGeometryColumn(layer));
    for (int i = 0; i < OGR_FD_GetFieldCount(definition); i++)
        sql = gis_sql_append_name(gis_sql_append(sql, ", "), OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i)));
    return gis_sql_append_name(gis_sql_append(sql, " FROM "), OGR_L_GetName(layer));
}

/* Would GDAL take this value into a field of this type without conversion? */
static bool value_suits(const gis_value *value, OGRFieldType type)
{
    switch (value->kind) {
    case GIS_TEXT: return type == OFTString && CPLIsUTF8(value->as.text, -1);
    case GIS_REAL: return type == OFTReal;
    case GIS_INTEGER:
        return type == OFTInteger64 ||
               (type == OFTInteger && value->as.integer >= INT32_MIN && value->as.integer <= INT32_MAX);
    default: return true;
    }
}

/* Makes a record of the current row; *record = NULL if the row is not plain. */
static bool pack_row(gis_packed *packed, void *statement, gis_value *value, const unsigned char **record,
                     gis_error *error)
{
    gis_value fid;
    size_t size, bytes;
    bool null;
    *record = NULL;
    if (!gis_sqlite_select_value(statement, FID, &fid) || fid.kind != GIS_INTEGER) return true;
    for (int i = 0; i < packed->fields; i++)
        if (!gis_sqlite_select_value(statement, FIELDS + i, &value[i]) || !value_suits(&value[i], packed->type[i]))
            return true;
    const unsigned char *blob = gis_sqlite_select_bytes(statement, GEOMETRY, &size, &null);
    const unsigned char *geometry = blob ? gis_blob_geometry(blob, size, &bytes) : NULL;
    if (!geometry || bytes > INT32_MAX || !gis_blob_is_polygonal(geometry, bytes)) return true;
    const unsigned char *packed_row = gis_packed_add_row(packed, fid.as.integer, geometry, bytes, value);
    if (!packed_row) return gis_no_memory(error);
    *record = gis_packed_is_finite(packed_row) ? packed_row : NULL;
    return true;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* A statement whose rows are read, and the records made of them. */
typedef struct reading {
    void *statement;
    gis_sqlite_next next; /* what the last step returned */
    gis_packed *packed;
    gis_value *value; /* buffer for the values of a row */
} reading;

/* Prepares the statement and reads its first row; from here on the file cannot change. */
static void begin_reading(reading *r, void *database, const char *sql, gis_packed *packed)
{
    *r = (reading){.packed = packed, .statement = gis_sqlite_select_begin(database, sql), .next = GIS_SQLITE_BROKEN};
    if (!r->statement) return;
    r->value = CPLCalloc((size_t)packed->fields + 1, sizeof *r->value);
    r->next = gis_sqlite_select_next(r->statement);
}

static void end_reading(reading *r)
{
    gis_sqlite_select_end(r->statement);
    CPLFree(r->value);
}

static bool read_rows(reading *r, gis_table_take *take, void *user, bool *all, gis_error *error)
{
    for (; r->next == GIS_SQLITE_HAS_ROW; r->next = gis_sqlite_select_next(r->statement)) {
        const unsigned char *record;
        if (!pack_row(r->packed, r->statement, r->value, &record, error)) return false;
        if (!record) return true;
        if (!take(user, record, error) || !gis_go_on(error)) return false;
    }
    *all = r->next == GIS_SQLITE_AT_END;
    return gis_go_on(error); /* false if a signal ended the statement early */
}

/* ---- In halves --------------------------------------------------------------------------------------------------- */

/* If the smallest and the largest key are at least this far apart, reading the table takes longer than starting a
 * thread. */
enum { MANY_ROWS = 5000 };

/* Does SQLite's query plan for `sql` consist of one step whose description is `verb`, `name` and `way` (older versions
 * write "TABLE" before the name)? more: further words may follow. */
static bool goes_by(void *database, const char *sql, const char *verb, const char *name, const char *way, bool more)
{
    enum { DETAIL = 3 };
    char *explain = gis_sql_append(CPLStrdup("EXPLAIN QUERY PLAN "), sql);
    void *statement = gis_sqlite_select_begin(database, explain);
    gis_value told;
    bool so = statement && gis_sqlite_select_next(statement) == GIS_SQLITE_HAS_ROW &&
              gis_sqlite_select_value(statement, DETAIL, &told) && told.kind == GIS_TEXT,
         found = false;
    for (int older = 0; so && older < 2; older++) {
        char *words = gis_printed("%s %s%s%s", verb, older ? "TABLE " : "", name, way);
        const size_t n = strlen(words);
        found = found || (strncmp(told.as.text, words, n) == 0 && (more || told.as.text[n] == 0));
        CPLFree(words);
    }
    so = so && gis_sqlite_select_next(statement) == GIS_SQLITE_AT_END;
    gis_sqlite_select_end(statement);
    CPLFree(explain);
    return so && found;
}

/* Statements for the rows with keys up to the middle one, and for those with greater keys. */
typedef struct halves {
    char *sql[2];
    void *again; /* a second connection, for the second statement; NULL: the table is not divided */
} halves;

/* Are rows returned in ascending order of keys, by the whole statement and by both halves? Not if the layer is a
 * view, or if an index covers all columns. */
static bool keys_rise(void *database, OGRLayerH layer, const char *all, const halves *h)
{
    const char *name = OGR_L_GetName(layer);
    bool so = goes_by(database, all, "SCAN", name, "", false);
    for (int k = 0; k < 2; k++)
        so = so && goes_by(database, h->sql[k], "SEARCH", name, " USING INTEGER PRIMARY KEY (rowid", true);
    return so;
}

static halves divide_table(void *database, OGRLayerH layer, const char *all)
{
    const char *key = OGR_L_GetFIDColumn(layer);
    int64_t middle;
    uint64_t span;
    halves h = {0};
    if (!gis_sqlite_find_middle(database, OGR_L_GetName(layer), key, &middle, &span) || span < MANY_ROWS) return h;
    h.sql[0] = gis_sql_append_stretch(CPLStrdup(all), key, GIS_SQLITE_UP_TO, middle);
    h.sql[1] = gis_sql_append_stretch(CPLStrdup(all), key, GIS_SQLITE_BEYOND, middle);
    if (keys_rise(database, layer, all, &h)) h.again = gis_second_connection_open(database);
    return h;
}

static void clear_halves(halves *h)
{
    CPLFree(h->sql[0]);
    CPLFree(h->sql[1]);
    gis_second_connection_close(h->again);
}

/* The half that the other thread reads. */
typedef struct half {
    reading rows;
    gis_packed packed;
    const unsigned char **record;
    size_t n, capacity;
    bool done, all;
    gis_error error; /* set if not `done` */
} half;

static bool keep_record(void *user, const unsigned char *record, gis_error *error)
{
    half *h = user;
    if (!gis_array_reserve(&h->record, &h->capacity, h->n + 1, sizeof *h->record)) return gis_no_memory(error);
    h->record[h->n++] = record;
    return true;
}

static void read_half(void *context)
{
    half *h = context;
    h->done = read_rows(&h->rows, keep_record, h, &h->all, &h->error);
}

static bool take_half(half *h, gis_packed *packed, gis_table_take *take, void *user, bool *all, gis_error *error)
{
    *all = h->done && h->all;
    if (!h->done) *error = h->error;
    if (!*all) return h->done;
    if (!gis_packed_join(packed, &h->packed)) return gis_no_memory(error);
    for (size_t k = 0; k < h->n; k++)
        if (!take(user, h->record[k], error) || !gis_go_on(error)) return false;
    return true;
}

/* Reads both halves at once; both statements are at their first rows. */
static bool read_both(reading *first, half *second, gis_table_take *take, void *user, bool *all, gis_error *error)
{
    gis_side_thread *beside = gis_side_thread_new();
    gis_side_thread_do(beside, read_half, second);
    const bool done = read_rows(first, take, user, all, error);
    gis_side_thread_free(beside);
    return done && (!*all || take_half(second, first->packed, take, user, all, error));
}

/* Reads the table in halves if that is possible. *tried is false if it was not; then nothing was given to `take`. */
static bool read_halves(void *database, OGRLayerH layer, const char *sql, gis_packed *packed, gis_table_take *take,
                        void *user, bool *tried, bool *all, gis_error *error)
{
    halves h = divide_table(database, layer, sql);
    half second = {0};
    reading first = {0};
    bool done = !h.again || gis_packed_begin(&second.packed, layer, error);
    if (done && h.again) {
        begin_reading(&first, database, h.sql[0], packed);
        begin_reading(&second.rows, h.again, h.sql[1], &second.packed);
    }
    *tried = first.statement && first.next == GIS_SQLITE_HAS_ROW && second.rows.next == GIS_SQLITE_HAS_ROW;
    if (done && *tried) done = read_both(&first, &second, take, user, all, error);
    end_reading(&first);
    end_reading(&second.rows);
    gis_packed_clear(&second.packed);
    free(second.record);
    clear_halves(&h);
    return done;
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

static bool read_all(void *database, const char *sql, gis_packed *packed, gis_table_take *take, void *user, bool *all,
                     gis_error *error)
{
    reading rows;
    begin_reading(&rows, database, sql, packed);
    const bool done = !rows.statement || read_rows(&rows, take, user, all, error);
    end_reading(&rows);
    return done;
}

bool gis_table_read(GDALDatasetH dataset, OGRLayerH layer, unsigned threads, gis_packed *packed, gis_table_take *take,
                    void *user, bool *all, gis_error *error)
{
    *all = false;
    if (!packed->definition || !EQUAL(GDALGetDriverShortName(GDALGetDatasetDriver(dataset)), "GPKG") ||
        !OGR_L_GetFIDColumn(layer)[0] || !OGR_L_GetGeometryColumn(layer)[0])
        return true;
    void *database = GDALGetInternalHandle(dataset, "SQLITE_HANDLE");
    if (!database) return true;
    char *sql = select_statement(layer);
    bool tried = false, done = true;
    if (threads > 1) done = read_halves(database, layer, sql, packed, take, user, &tried, all, error);
    if (done && !tried) done = read_all(database, sql, packed, take, user, all, error);
    CPLFree(sql);
    return done;
}
