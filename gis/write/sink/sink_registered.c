/* sink_registered.c: would a reader find a layer that was added to a database? A layer of a GeoPackage, or of a SQLite
 * database with geometries, is a table and its rows in the tables that list layers. GDAL relies on what it wrote there,
 * but triggers of the database may have suppressed or changed these rows. So they are read before the transaction ends,
 * after everything is written. */
#include "base/path.h"
#include "gpkg/sql.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <ctype.h>
#include <string.h>

enum { WORD_SIZE = 32 };

/* Prints a geometry type as a GeoPackage names it, such as MULTIPOLYGON. */
static void print_type(OGRwkbGeometryType type, char word[WORD_SIZE])
{
    const OGRwkbGeometryType flat = OGR_GT_Flatten(type);
    size_t n = 0;
    for (const char *c = flat == wkbUnknown ? "GEOMETRY" : OGRGeometryTypeToName(flat); *c && n + 1 < WORD_SIZE; c++)
        if (*c != ' ') word[n++] = (char)toupper((unsigned char)*c);
    word[n] = '\0';
}

/* Does the query return `wanted` in its first row (ignoring case)? False if it returns no row. */
static bool query_gives(const gis_sink_layer *layer, const char *sql, const char *wanted)
{
    char *answer = gis_sql_ask(layer->dataset, sql);
    const bool same = answer && EQUAL(answer, wanted);
    CPLFree(answer);
    return same;
}

/* Does the GeoPackage list the layer with its geometry column and type? `name` is escaped for SQL. */
static bool is_in_geopackage(const gis_sink_layer *layer, const char *name)
{
    char type[WORD_SIZE];
    print_type(OGR_L_GetGeomType(layer->layer), type);
    char *sql = gis_printed("SELECT c.data_type || ' ' || g.column_name || ' ' || g.geometry_type_name || ' ' || "
                            "(c.srs_id = g.srs_id) FROM gpkg_contents c JOIN gpkg_geometry_columns g ON "
                            "lower(g.table_name) = lower(c.table_name) WHERE lower(c.table_name) = lower('%s')",
                            name);
    char *wanted = gis_printed("features %s %s 1", OGR_L_GetGeometryColumn(layer->layer), type);
    const bool found = query_gives(layer, sql, wanted);
    CPLFree(sql);
    CPLFree(wanted);
    return found;
}

/* Does the GeoPackage list the layer `name` with the authority and code of its CRS? True if the CRS has none. */
static bool has_its_crs(const gis_sink_layer *layer, const char *name)
{
    OGRSpatialReferenceH crs = OGR_L_GetSpatialRef(layer->layer);
    const char *authority = crs ? OSRGetAuthorityName(crs, NULL) : NULL;
    const char *code = authority ? OSRGetAuthorityCode(crs, NULL) : NULL;
    if (!code) return true;
    char *sql =
        gis_printed("SELECT s.organization || ':' || s.organization_coordsys_id FROM gpkg_spatial_ref_sys s JOIN "
                    "gpkg_geometry_columns g ON g.srs_id = s.srs_id WHERE lower(g.table_name) = lower('%s')",
                    name);
    char *wanted = gis_printed("%s:%s", authority, code);
    const bool found = query_gives(layer, sql, wanted);
    CPLFree(sql);
    CPLFree(wanted);
    return found;
}

/* Does geometry_columns list the layer? True if the database has no such table: then readers find geometry columns from
 * the tables themselves. */
static bool is_in_geometry_columns(const gis_sink_layer *layer, const char *name)
{
    if (!query_gives(layer, "SELECT 1 FROM sqlite_master WHERE lower(name) = 'geometry_columns'", "1")) return true;
    char *sql =
        gis_printed("SELECT f_geometry_column FROM geometry_columns WHERE lower(f_table_name) = lower('%s')", name);
    const bool found = query_gives(layer, sql, OGR_L_GetGeometryColumn(layer->layer));
    CPLFree(sql);
    return found;
}

bool gis_sink_check_registered(const gis_sink_layer *layer, gis_error *error)
{
    const gis_format *format = &layer->sink->format;
    if (!format->sqlite || OGR_L_GetGeomType(layer->layer) == wkbNone) return true;
    char *name = CPLEscapeString(layer->name, -1, CPLES_SQL);
    const bool found = format->geopackage ? is_in_geopackage(layer, name) && has_its_crs(layer, name)
                                          : is_in_geometry_columns(layer, name);
    CPLFree(name);
    return found || gis_fail(error,
                             "%s: layer %s was written, but the database does not list it, so readers would not find "
                             "it; does a trigger prevent this? Nothing was changed",
                             layer->sink->request.path, layer->name);
}
