/* table.c: see table.h. The statement is GDAL's own, so rows come in its order; what a database has to say of one that
 * cannot be read is left to GDAL, too, which reads it again. */
#include "read/table.h"

#include "base/interrupt.h"
#include "read/blob.h"
#include "sqlite/names.h"
#include "sqlite/select.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <stdint.h>

/* Columns before those of the fields. */
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

/* Is it what GDAL would take as it stands into a field of that type? */
static bool suits(const gis_value *value, OGRFieldType type)
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

/* *record = NULL: the row is not plain. */
static bool pack(gis_packed *packed, void *statement, gis_value *value, const unsigned char **record, gis_error *error)
{
    gis_value fid;
    size_t size, bytes;
    bool null;
    *record = NULL;
    if (!gis_sqlite_select_value(statement, FID, &fid) || fid.kind != GIS_INTEGER) return true;
    for (int i = 0; i < packed->fields; i++)
        if (!gis_sqlite_select_value(statement, FIELDS + i, &value[i]) || !suits(&value[i], packed->type[i]))
            return true;
    const unsigned char *blob = gis_sqlite_select_bytes(statement, GEOMETRY, &size, &null);
    const unsigned char *geometry = blob ? gis_blob_geometry(blob, size, &bytes) : NULL;
    if (!geometry || bytes > INT32_MAX || !gis_blob_is_polygonal(geometry, bytes)) return true;
    const unsigned char *packed_row = gis_packed_add_row(packed, fid.as.integer, geometry, bytes, value);
    if (!packed_row) return gis_no_memory(error);
    *record = gis_packed_is_finite(packed_row) ? packed_row : NULL;
    return true;
}

static bool read_rows(void *statement, gis_packed *packed, gis_value *value, gis_table_take *take, void *user,
                      bool *all, gis_error *error)
{
    gis_sqlite_next next;
    while ((next = gis_sqlite_select_next(statement)) == GIS_SQLITE_HAS_ROW) {
        const unsigned char *record;
        if (!pack(packed, statement, value, &record, error)) return false;
        if (!record) return true;
        if (!take(user, record, error) || !gis_go_on(error)) return false;
    }
    *all = next == GIS_SQLITE_AT_END;
    return gis_go_on(error); /* a statement that is cut short */
}

bool gis_table_read(GDALDatasetH dataset, OGRLayerH layer, gis_packed *packed, gis_table_take *take, void *user,
                    bool *all, gis_error *error)
{
    *all = false;
    if (!packed->definition || !EQUAL(GDALGetDriverShortName(GDALGetDatasetDriver(dataset)), "GPKG") ||
        !OGR_L_GetFIDColumn(layer)[0] || !OGR_L_GetGeometryColumn(layer)[0])
        return true;
    void *database = GDALGetInternalHandle(dataset, "SQLITE_HANDLE");
    char *sql = select_statement(layer);
    void *statement = database ? gis_sqlite_select_begin(database, sql) : NULL;
    gis_value *value = CPLCalloc((size_t)packed->fields + 1, sizeof *value);
    const bool done = !statement || read_rows(statement, packed, value, take, user, all, error);
    gis_sqlite_select_end(statement);
    CPLFree(value);
    CPLFree(sql);
    return done;
}
