/* digest_rows.c: reads a written GeoPackage layer back row by row through SQLite, without GDAL.
 *
 * Each row must be what was sent; its bytes are hashed where SQLite holds them, without making a GDAL feature. If any
 * row is unusual (another geometry type or value type, a header with extensions, truncated bytes, an error), this path
 * is abandoned, and GDAL reads the whole layer. */
#include "write/sink/digest.h"

#include "base/array.h"
#include "base/resources.h"
#include "base/side_thread.h"
#include "gpkg/blob.h"
#include "gpkg/second_connection.h"
#include "gpkg/sql.h"
#include "gpkg/sqlite_select.h"

#include <cpl_conv.h>
#include <stdlib.h>

enum { POINT_BYTES = 16 };

/* A layer with at least this number of rows is read by two threads, if more than one is allowed. */
enum { MANY_ROWS = 5000 };

/* The byte order of this machine: doubles in this order can be copied without swapping. */
#ifdef CPL_LSB
static const unsigned char order = wkbNDR;
#else
static const unsigned char order = wkbXDR;
#endif

/* The unread part of a blob, and the hash of the part that was read. */
typedef struct reading {
    const unsigned char *at, *end;
    uint64_t so_far;
} reading;

static bool take_number(reading *r, uint32_t *n)
{
    if (r->end - r->at < (ptrdiff_t)sizeof *n) return false;
    memcpy(n, r->at, sizeof *n);
    r->at += sizeof *n;
    return true;
}

/* Adds n points to the hash; false if n is 0 or the blob is too short. */
static bool mix_points(reading *r, size_t n)
{
    if (n == 0 || (size_t)(r->end - r->at) / POINT_BYTES < n) return false;
    r->so_far = gis_mix(r->so_far, n);
    for (size_t k = 0; k < 2 * n; k++, r->at += sizeof(double)) {
        double x;
        memcpy(&x, r->at, sizeof x);
        r->so_far = gis_mix_double(r->so_far, x);
    }
    return true;
}

static bool ring_or_line(reading *r)
{
    uint32_t n;
    return take_number(r, &n) && mix_points(r, n);
}

/* Computes the hash that mix_geometry() in sent_digests.c computes. False for a type that is not handled here, and for
 * an empty geometry. */
static bool mix_geometry_blob(reading *r, bool part)
{
    uint32_t type, n;
    if (r->at == r->end || *r->at++ != order || !take_number(r, &type)) return false;
    if (type == wkbLineString) return ring_or_line(r);
    if (type == wkbPolygon)
        r->so_far = gis_mix(r->so_far, GIS_MIX_POLYGON);
    else if (part || (type != wkbMultiPolygon && type != wkbMultiLineString))
        return false;
    bool good = take_number(r, &n) && n > 0;
    for (; good && n > 0; n--) good = type == wkbPolygon ? ring_or_line(r) : mix_geometry_blob(r, true);
    return good;
}

static bool mix_blob(const unsigned char *bytes, size_t size, uint64_t *so_far)
{
    size_t rest;
    const unsigned char *at = gis_blob_geometry(bytes, size, &rest);
    if (!at) return false;
    reading r = {at, at + rest, *so_far};
    if (!mix_geometry_blob(&r, false) || r.at != r.end) return false;
    *so_far = r.so_far;
    return true;
}

/* Does `value` have the type that GDAL would give it in this field? */
static bool value_suits_field(const gis_value *value, const gis_plain_field *field)
{
    switch (value->kind) {
    case GIS_TEXT: return field->type == OFTString;
    case GIS_REAL: return field->type == OFTReal;
    case GIS_INTEGER:
        return field->type == OFTInteger64 ||
               (field->type == OFTInteger && value->as.integer >= INT32_MIN && value->as.integer <= INT32_MAX);
    default: return true;
    }
}

/* Hashes the current row of `statement`, whose columns are the FID, the geometry and the fields. False if the row is
 * not plain. */
static bool digest_row(const gis_digests *all, void *statement, gis_digest *out)
{
    gis_value value;
    size_t size;
    bool null;
    *out = (gis_digest){GIS_MIX_START, GIS_MIX_START};
    if (!gis_sqlite_select_value(statement, 0, &value) || value.kind != GIS_INTEGER) return false;
    if (all->with_fid) out->place = gis_mix(out->place, (uint64_t)value.as.integer);
    for (size_t i = 0; i < all->n_fields; i++) {
        if (!gis_sqlite_select_value(statement, (int)i + 2, &value) || !value_suits_field(&value, &all->fields[i]))
            return false;
        out->values = gis_mix_plain(out->values, &value, &all->fields[i]);
    }
    const unsigned char *bytes = gis_sqlite_select_bytes(statement, 1, &size, &null);
    if (null)
        out->place = gis_mix(out->place, GIS_MIX_NOTHING);
    else if (!bytes || !mix_blob(bytes, size, &out->place))
        return false;
    out->values = gis_mix(out->values, out->place);
    return true;
}

/* ---- Stretches of a layer ---------------------------------------------------------------------------------------- */

static char *select_statement(const gis_digests *all, OGRLayerH layer)
{
    char *sql = gis_sql_append_name(CPLStrdup("SELECT "), OGR_L_GetFIDColumn(layer));
    sql = gis_sql_append_name(gis_sql_append(sql, ", "), OGR_L_GetGeometryColumn(layer));
    for (size_t i = 0; i < all->n_fields; i++)
        sql = gis_sql_append_name(gis_sql_append(sql, ", "), all->fields[i].name);
    return gis_sql_append_name(gis_sql_append(sql, " FROM "), OGR_L_GetName(layer));
}

static void *begin_stretch(const gis_digests *all, void *database, OGRLayerH layer, gis_sqlite_stretch which,
                           int64_t last)
{
    char *sql = gis_sql_append_stretch(select_statement(all, layer), OGR_L_GetFIDColumn(layer), which, last);
    void *statement = gis_sqlite_select_begin(database, sql);
    CPLFree(sql);
    return statement;
}

/* ---- The other half, on another thread --------------------------------------------------------------------------- */

/* The second half of the rows, which another thread reads through another connection. */
typedef struct half {
    const gis_digests *all;
    void *statement;
    gis_digest *at;
    size_t n, capacity;
    bool done;
} half;

static void read_half(void *context)
{
    half *h = context;
    gis_sqlite_next next = GIS_SQLITE_AT_END;
    h->done = true;
    while (h->done && (next = gis_sqlite_select_next(h->statement)) == GIS_SQLITE_HAS_ROW) {
        h->done = !gis_interrupted() && gis_array_reserve(&h->at, &h->capacity, h->n + 1, sizeof *h->at) &&
                  digest_row(h->all, h->statement, &h->at[h->n]);
        h->n += h->done;
    }
    h->done = h->done && next == GIS_SQLITE_AT_END;
}

/* Reads the rows of `statement`, and compares each with what was sent as it is read. */
static bool read_stretch(gis_digests *all, void *statement, gis_digests_read *read)
{
    gis_sqlite_next next = GIS_SQLITE_BROKEN;
    gis_error unheard; /* ignored: GDAL reads the layer then, and reports the error */
    bool done = statement;
    while (done && (next = gis_sqlite_select_next(statement)) == GIS_SQLITE_HAS_ROW) {
        gis_digest one;
        done = !gis_interrupted() && digest_row(all, statement, &one) && gis_digests_read_add(read, all, one, &unheard);
    }
    return done && next == GIS_SQLITE_AT_END;
}

static bool add_half(gis_digests *all, const half *h, gis_digests_read *read)
{
    gis_error unheard;
    bool done = h->done;
    for (size_t k = 0; done && k < h->n; k++) done = gis_digests_read_add(read, all, h->at[k], &unheard);
    return done;
}

/* Reads the first half of the rows on this thread and the second half on another. `other` is a second connection to the
 * same file. */
static bool read_halves(gis_sink_layer *layer, void *database, void *other, OGRLayerH as_written,
                        gis_digests_read *read)
{
    gis_digests *all = &layer->digests;
    int64_t middle;
    uint64_t span;
    if (!gis_sqlite_find_middle(database, OGR_L_GetName(as_written), OGR_L_GetFIDColumn(as_written), &middle, &span))
        return false;
    half second = {.all = all, .statement = begin_stretch(all, other, as_written, GIS_SQLITE_BEYOND, middle)};
    void *first = begin_stretch(all, database, as_written, GIS_SQLITE_UP_TO, middle);
    bool done = first && second.statement;
    if (done) {
        gis_side_thread *beside = gis_side_thread_new();
        gis_side_thread_do(beside, read_half, &second);
        done = read_stretch(all, first, read);
        gis_side_thread_free(beside);
        done = done && add_half(all, &second, read);
    }
    gis_sqlite_select_end(first);
    gis_sqlite_select_end(second.statement);
    free(second.at);
    return done;
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

static bool read_all(gis_sink_layer *layer, void *database, OGRLayerH as_written, gis_digests_read *read)
{
    void *statement = begin_stretch(&layer->digests, database, as_written, GIS_SQLITE_ALL, 0);
    const bool done = read_stretch(&layer->digests, statement, read);
    gis_sqlite_select_end(statement);
    return done;
}

static bool may_be_plain(const gis_sink_layer *layer, GDALDatasetH dataset, OGRLayerH as_written)
{
    const gis_digests *all = &layer->digests;
    for (size_t i = 0; i < all->n_fields; i++)
        if (all->fields[i].read < 0) return false;
    return dataset && layer->sink->format.geopackage && all->wanted && all->values_comparable && all->with_z == 0 &&
           OGR_L_GetFIDColumn(as_written)[0] && OGR_L_GetGeometryColumn(as_written)[0];
}

/* A second connection to the file, if the layer has at least MANY_ROWS rows and more than one thread is allowed; else
 * NULL. */
static void *open_again(const gis_sink_layer *layer, void *database)
{
    if (layer->written < MANY_ROWS || gis_threads(layer->sink->request.threads) == 1) return NULL;
    return gis_second_connection_open(database);
}

bool gis_read_rows(gis_sink_layer *layer, GDALDatasetH dataset, OGRLayerH as_written, gis_digests_read *read)
{
    void *database = may_be_plain(layer, dataset, as_written) ? GDALGetInternalHandle(dataset, "SQLITE_HANDLE") : NULL;
    if (!database) return false;
    void *other = open_again(layer, database);
    const bool done =
        other ? read_halves(layer, database, other, as_written, read) : read_all(layer, database, as_written, read);
    gis_second_connection_close(other);
    if (done && read->n == layer->written) return true;
    free(read->at);
    *read = (gis_digests_read){0};
    return false;
}
