/* sink_rows.c: writes rows of a GeoPackage's main layer, and of its layers of lines, through SQLite instead of GDAL,
 * where everything is plain.
 *
 * GDAL makes a feature, its geometry, its blob and its bindings for each row. If the source's records
 * (geometry/packed.h) hold the geometry as the blob needs it and the values as the columns do, the row is built from
 * the record directly. GDAL still writes the other data about a layer; the extent and feature count, which it would
 * underestimate, are corrected when it writes them. GDAL also writes the first feature: its blob shows the header that
 * GDAL uses, and unless the rest equals, byte for byte, what would be built here, rows are left to GDAL. */
#include "base/path.h"
#include "write/sink/sink_internal.h"

#include "base/array.h"
#include "base/resources.h"
#include "geometry/packed.h"
#include "gpkg/sql.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A blob (GeoPackageBinary): "GP", version, flags, SRS; the box; well-known binary. */
enum { HEAD = 8, BOX = 4 * sizeof(double), FLAGS = 3, LITTLE_ENDIAN_WITH_BOX = 3 };

/* A line of two points as well-known binary: byte order, type, count, points. */
enum { LINE_POINTS = 1 + 2 * sizeof(uint32_t), LINE_BYTES = LINE_POINTS + 4 * sizeof(double) };

/* ---- Is all plain? ----------------------------------------------------------------------------------------------- */

static bool fields_are_plain(const gis_sink_layer *layer)
{
    OGRFeatureDefnH to = OGR_L_GetLayerDefn(layer->layer);
    const gis_source *source = layer->request.like_source ? layer->source : NULL;
    OGRFeatureDefnH from = source ? OGR_L_GetLayerDefn(gis_source_layer(source)) : NULL;
    const int n = OGR_FD_GetFieldCount(to);
    if (layer->digests.n_fields != (size_t)n) return false; /* false if a field has another type, or a default */
    for (int i = 0; i < n; i++)
        if (EQUAL(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(to, i)), OGR_L_GetFIDColumn(layer->layer))) return false;
    for (int i = 0; from && i < OGR_FD_GetFieldCount(from); i++)
        if (layer->field_map[i] >= 0 && OGR_Fld_GetType(OGR_FD_GetFieldDefn(from, i)) !=
                                            OGR_Fld_GetType(OGR_FD_GetFieldDefn(to, layer->field_map[i])))
            return false;
    for (size_t i = 0; i < layer->request.n_fields; i++)
        if (layer->own[i] < 0 ||
            OGR_Fld_GetType(OGR_FD_GetFieldDefn(to, layer->own[i])) != layer->request.fields[i].type)
            return false;
    return true;
}

/* Is the output a new GeoPackage file without creation options? An option may change what GDAL does for each row. */
static bool sink_is_plain(const gis_sink *sink)
{
    return sink->format.geopackage && sink->place == GIS_PLACE_FILE && !sink->updating &&
           !CSLCount((CSLConstList)sink->request.layer_options) &&
           !CSLCount((CSLConstList)sink->request.dataset_options);
}

static bool main_is_plain(const gis_sink_layer *layer)
{
    const OGRwkbGeometryType type = OGR_L_GetGeomType(layer->layer);
    return layer->request.like_source && layer->request.as_source && layer->sink->fids_kept &&
           (type == wkbUnknown || type == wkbPolygon || type == wkbMultiPolygon);
}

/* Is this a plain layer of lines? Its FIDs are those that SQLite assigns: 1, 2, 3 ... */
static bool lines_are_plain(const gis_sink_layer *layer)
{
    return !layer->request.like_source && !layer->request.copied && OGR_L_GetGeomType(layer->layer) == wkbLineString;
}

static bool layer_is_plain(const gis_sink_layer *layer, bool lines)
{
    return sink_is_plain(layer->sink) && !layer->promote && !layer->wind && layer->tree.trigger &&
           (lines ? lines_are_plain(layer) : main_is_plain(layer)) && fields_are_plain(layer);
}

typedef struct looking {
    OGREnvelope box;
    bool plain;
} looking;

/* Widens seen->box by n points. A coordinate of 0 is not plain: -0 and 0 are equal but differ in their bits, and which
 * of them a box gets is GDAL's choice. */
static bool look_at_points(void *user, const unsigned char *points, size_t n, bool last)
{
    looking *seen = user;
    (void)last;
    for (size_t k = 0; k < n; k++) {
        double xy[2];
        memcpy(xy, points + k * sizeof xy, sizeof xy);
        if (!isfinite(xy[0]) || !isfinite(xy[1]) || xy[0] == 0 || xy[1] == 0) return seen->plain = false;
        seen->box.MinX = fmin(seen->box.MinX, xy[0]);
        seen->box.MaxX = fmax(seen->box.MaxX, xy[0]);
        seen->box.MinY = fmin(seen->box.MinY, xy[1]);
        seen->box.MaxY = fmax(seen->box.MaxY, xy[1]);
    }
    return true;
}

/* Does the field hold values of this type, so that nothing is converted? */
static bool value_suits_field(const gis_value *value, const gis_plain_field *field)
{
    switch (value->kind) {
    case GIS_TEXT: return field->type == OFTString;
    case GIS_REAL: return field->type == OFTReal;
    case GIS_INTEGER: return field->type == OFTInteger64;
    default: return true;
    }
}

/* Does a text fit the field's width, which GDAL counts in characters (bytes that begin a UTF-8 sequence), and is it
 * valid UTF-8? */
static bool value_is_plain(const gis_value *value, const gis_plain_field *field)
{
    if (value->kind != GIS_TEXT || field->width <= 0) return true;
    size_t n = 0;
    bool ascii = true;
    for (const char *at = value->as.text; *at; at++) {
        ascii = ascii && (signed char)*at > 0;
        n += (*at & 0xC0) != 0x80;
    }
    return n <= (size_t)field->width && (ascii || CPLIsUTF8(value->as.text, -1));
}

/* ---- Beginning --------------------------------------------------------------------------------------------------- */

static char *insert_statement(const gis_sink_layer *layer)
{
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer->layer);
    const int n = OGR_FD_GetFieldCount(definition);
    char *sql = gis_sql_append_name(CPLStrdup("INSERT INTO "), OGR_L_GetName(layer->layer));
    sql = gis_sql_append_name(gis_sql_append(sql, " ("), OGR_L_GetFIDColumn(layer->layer));
    sql = gis_sql_append_name(gis_sql_append(sql, ", "), OGR_L_GetGeometryColumn(layer->layer));
    for (int i = 0; i < n; i++)
        sql = gis_sql_append_name(gis_sql_append(sql, ", "), OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i)));
    return gis_sql_append(sql, ") VALUES ");
}

/* A query for the blob of feature `fid`. It returns no row if the table has a trigger on INSERT (GDAL has removed its
 * own triggers for index and count) or there is no table of feature counts. */
static char *blob_statement(const gis_sink_layer *layer, GIntBig fid)
{
    char *name = CPLEscapeString(OGR_L_GetName(layer->layer), -1, CPLES_SQL);
    char *sql = gis_sql_append_name(CPLStrdup("SELECT "), OGR_L_GetGeometryColumn(layer->layer));
    sql = gis_sql_append_name(gis_sql_append(sql, " FROM "), OGR_L_GetName(layer->layer));
    sql = gis_sql_append_name(gis_sql_append(sql, " WHERE "), OGR_L_GetFIDColumn(layer->layer));
    char *rest = gis_printed(" = %" PRId64 " AND NOT EXISTS (SELECT 1 FROM sqlite_master WHERE type = "
                             "'trigger' AND lower(tbl_name) = lower('%s') AND sql LIKE '%%INSERT ON%%') AND "
                             "EXISTS (SELECT 1 FROM sqlite_master WHERE name = 'gpkg_ogr_contents')",
                             (int64_t)fid, name);
    sql = gis_sql_append(sql, rest);
    CPLFree(rest);
    CPLFree(name);
    return sql;
}

/* Begins inserting through SQLite if the blob of feature `fid`, which GDAL wrote, equals the blob composed here. */
static bool begin_inserts(gis_sink_layer *layer, GIntBig fid)
{
    gis_sink_rows *rows = &layer->rows;
    rows->database = GDALGetInternalHandle(layer->dataset, "SQLITE_HANDLE");
    char *ask = blob_statement(layer, fid), *insert = insert_statement(layer);
    unsigned char *blob = rows->blob;
    if (rows->database && gis_sqlite_says(rows->database, ask, blob, HEAD, blob + HEAD, rows->size - HEAD) &&
        memcmp(blob, "GP", 2) == 0 && blob[FLAGS] == LITTLE_ENDIAN_WITH_BOX) {
        memcpy(rows->head, blob, HEAD);
        gis_sqlite_inserts_begin(&rows->inserts, rows->database, insert, layer->digests.n_fields + 2,
                                 gis_threads(layer->sink->request.threads));
    }
    CPLFree(ask);
    CPLFree(insert);
    return rows->inserts.one != NULL;
}

void gis_sink_rows_clear(gis_sink_layer *layer)
{
    gis_sink_rows *rows = &layer->rows;
    gis_sqlite_inserts_end(&rows->inserts);
    free(rows->blob);
    CPLFree(rows->value);
    *rows = (gis_sink_rows){.closed = true, .n = rows->n, .around = rows->around};
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static bool put_blob(gis_sink_rows *rows, const OGREnvelope *box, const unsigned char *wkb, size_t bytes)
{
    const double sides[] = {box->MinX, box->MaxX, box->MinY, box->MaxY};
    rows->size = HEAD + BOX + bytes;
    if (!gis_array_reserve(&rows->blob, &rows->room, rows->size, 1)) return false;
    memcpy(rows->blob, rows->head, HEAD);
    memcpy(rows->blob + HEAD, sides, BOX);
    memcpy(rows->blob + HEAD + BOX, wkb, bytes);
    return true;
}

static bool values_are_plain(const gis_sink_layer *layer)
{
    for (size_t k = 0; k < layer->digests.n_fields; k++)
        if (!value_is_plain(&layer->rows.value[k], &layer->digests.fields[k])) return false;
    return true;
}

/* Composes the row of feature i of the source; GIS_ROW_GDAL if it is not plain. */
static gis_row compose_row(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values,
                           OGREnvelope *box, gis_error *error)
{
    gis_sink_rows *rows = &layer->rows;
    size_t bytes;
    looking seen = {{INFINITY, -INFINITY, INFINITY, -INFINITY}, true};
    const unsigned char *wkb;
    if (!gis_source_plain(layer->source, i, dx, dy, layer->field_map, rows->value, &wkb, &bytes)) return GIS_ROW_GDAL;
    if (!wkb) return gis_no_memory(error), GIS_ROW_FAILED;
    gis_packed_visit(wkb, look_at_points, &seen);
    uint32_t type;
    memcpy(&type, wkb + 1, sizeof type);
    const OGRwkbGeometryType declared = OGR_L_GetGeomType(layer->layer);
    if (!seen.plain || gis_source_fid(layer->source, i) <= 0 || bytes > INT32_MAX / 2 ||
        (declared != wkbUnknown && (uint32_t)declared != type))
        return GIS_ROW_GDAL;
    for (size_t k = 0; k < layer->request.n_fields; k++) rows->value[layer->own[k]] = values[k];
    if (!values_are_plain(layer)) return GIS_ROW_GDAL;
    *box = seen.box;
    return put_blob(rows, box, wkb, bytes) ? GIS_ROW_DONE : (gis_no_memory(error), GIS_ROW_FAILED);
}

static gis_row compose_line(gis_sink_layer *layer, const double from[2], const double to[2], const gis_value *values,
                            OGREnvelope *box, gis_error *error)
{
    gis_sink_rows *rows = &layer->rows;
    const uint32_t type = wkbLineString, n = 2;
    looking seen = {{INFINITY, -INFINITY, INFINITY, -INFINITY}, true};
    unsigned char wkb[LINE_BYTES] = {
        wkbNDR}; /* on a big-endian GDAL the comparison in begin_inserts() fails, and rows are left
                                               * to GDAL */
    memcpy(wkb + 1, &type, sizeof type);
    memcpy(wkb + 1 + sizeof type, &n, sizeof n);
    memcpy(wkb + LINE_POINTS, from, 2 * sizeof *from);
    memcpy(wkb + LINE_POINTS + 2 * sizeof *from, to, 2 * sizeof *to);
    look_at_points(&seen, wkb + LINE_POINTS, n, true);
    for (size_t k = 0; k < layer->digests.n_fields; k++) rows->value[k] = (gis_value){.kind = GIS_NULL};
    for (size_t k = 0; k < layer->request.n_fields; k++) {
        if (!value_suits_field(&values[k], &layer->digests.fields[layer->own[k]])) return GIS_ROW_GDAL;
        rows->value[layer->own[k]] = values[k];
    }
    if (!seen.plain || !values_are_plain(layer)) return GIS_ROW_GDAL;
    *box = seen.box;
    return put_blob(rows, box, wkb, sizeof wkb) ? GIS_ROW_DONE : (gis_no_memory(error), GIS_ROW_FAILED);
}

static bool fail_row(const gis_sink_layer *layer, int64_t fid, const char *reason, gis_error *error)
{
    return gis_fail(error, "%s, layer %s: FID %" PRId64 " cannot be written: %s", layer->sink->request.path,
                    layer->name, fid, reason);
}

static bool insert_row(gis_sink_layer *layer, GIntBig fid, const OGREnvelope *box, gis_error *error)
{
    gis_sink_rows *rows = &layer->rows;
    const char *reason;
    int64_t key = fid;
    if (!gis_sqlite_inserts_add(&rows->inserts, &key, rows->blob, rows->size, rows->value, &reason))
        return fail_row(layer, key, reason, error);
    layer->written++;
    rows->n++;
    gis_sink_widen(&rows->around, box);
    return gis_rtree_add_box(&layer->tree, fid, box, error) &&
           gis_digests_add_plain(&layer->digests, fid, rows->blob + HEAD + BOX, rows->value, error);
}

/* May rows of this layer be composed? Decided at the first call. */
static bool may_compose(gis_sink_layer *layer, bool lines)
{
    gis_sink_rows *rows = &layer->rows;
    if (rows->closed || rows->value) return !rows->closed;
    rows->closed = !layer_is_plain(layer, lines);
    if (rows->closed) return false;
    rows->value = CPLCalloc(layer->digests.n_fields + 1, sizeof *rows->value);
    rows->around = (OGREnvelope){INFINITY, -INFINITY, INFINITY, -INFINITY};
    return true;
}

/* Sends pending rows to SQLite; to be called before GDAL does anything with the layer. */
static bool flush_rows(gis_sink_layer *layer, gis_error *error)
{
    int64_t key;
    const char *reason;
    return !layer->rows.inserts.one || gis_sqlite_inserts_flush(&layer->rows.inserts, &key, &reason) ||
           fail_row(layer, key, reason, error);
}

/* Inserts the composed row, or returns GIS_ROW_GDAL if GDAL has to write it. */
static gis_row settle_row(gis_sink_layer *layer, gis_row row, GIntBig fid, const OGREnvelope *box, gis_error *error)
{
    gis_sink_rows *rows = &layer->rows;
    rows->offered = row == GIS_ROW_DONE;
    if (row == GIS_ROW_FAILED) return row;
    if (row != GIS_ROW_DONE || !rows->inserts.one) return flush_rows(layer, error) ? GIS_ROW_GDAL : GIS_ROW_FAILED;
    return insert_row(layer, fid, box, error) ? GIS_ROW_DONE : GIS_ROW_FAILED;
}

gis_row gis_sink_row(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values, gis_error *error)
{
    OGREnvelope box = {0};
    if (!may_compose(layer, false)) return GIS_ROW_GDAL;
    const gis_row row = compose_row(layer, i, dx, dy, values, &box, error);
    return settle_row(layer, row, gis_source_fid(layer->source, i), &box, error);
}

gis_row gis_sink_line(gis_sink_layer *layer, const double from[2], const double to[2], const gis_value *values,
                      gis_error *error)
{
    OGREnvelope box = {0};
    if (!may_compose(layer, true)) return GIS_ROW_GDAL;
    const gis_row row = compose_line(layer, from, to, values, &box, error);
    return settle_row(layer, row, (GIntBig)layer->written + 1, &box, error);
}

void gis_sink_row_by_gdal(gis_sink_layer *layer, GIntBig fid)
{
    gis_sink_rows *rows = &layer->rows;
    if (rows->closed || !rows->offered) return;
    if (!rows->inserts.one && !begin_inserts(layer, fid)) gis_sink_rows_clear(layer);
}

bool gis_sink_rows_flush(gis_sink_layer *layer, gis_error *error) { return flush_rows(layer, error); }

/* Called before the next layer is added, and at the end. */
bool gis_sink_rows_end(gis_sink_layer *layer, gis_error *error)
{
    gis_sink_rows *rows = &layer->rows;
    const bool done =
        flush_rows(layer, error) && (rows->closed || rows->n == 0 || gis_sink_note_whole(layer, rows->database, error));
    gis_sink_rows_clear(layer);
    return done;
}
