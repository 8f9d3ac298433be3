/* sink_whole.c: the feature count and extent that a GeoPackage stores for a layer. If some rows did not go through
 * GDAL, GDAL would store too small ones. */
#include "base/path.h"
#include "gpkg/sql.h"
#include "gpkg/sqlite_insert.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <float.h>
#include <math.h>

void gis_sink_widen(OGREnvelope *around, const OGREnvelope *box)
{
    around->MinX = fmin(around->MinX, box->MinX);
    around->MaxX = fmax(around->MaxX, box->MaxX);
    around->MinY = fmin(around->MinY, box->MinY);
    around->MaxY = fmax(around->MaxY, box->MaxY);
}

/* Makes the stored feature count right. GDAL stores the number of features that it wrote itself, at a time of its
 * choice; a temporary trigger, which exists in this connection only, replaces it then. `name` is escaped for SQL. */
static bool note_count(const gis_sink_layer *layer, void *database, const char *name)
{
    char *sql = gis_printed(
        "CREATE TEMP TRIGGER sunder_count_%zu BEFORE UPDATE OF feature_count ON main.gpkg_ogr_contents WHEN "
        "lower(new.table_name) = lower('%s') AND new.feature_count IS NOT %zu BEGIN UPDATE gpkg_ogr_contents SET "
        "feature_count = %zu WHERE lower(table_name) = lower('%s'); SELECT RAISE(IGNORE); END",
        layer->sink->n_layers, name, layer->written, layer->written, name);
    const bool done = gis_sqlite_run(database, sql);
    CPLFree(sql);
    return done;
}

/* Widens rows.around by the extent of the rows that GDAL wrote. */
static bool find_extent(gis_sink_layer *layer)
{
    OGREnvelope box;
    if (OGR_L_GetExtent(layer->layer, &box, FALSE) != OGRERR_NONE) return false;
    gis_sink_widen(&layer->rows.around, &box);
    return true;
}

/* Makes the stored extent right, now and whenever GDAL stores it again (by a temporary trigger); the numbers are
 * printed as GDAL has SQLite print them. `name` is escaped for SQL. */
static bool note_extent(const gis_sink_layer *layer, void *database, const char *name)
{
    static const char *const sides[] = {"min_x", "min_y", "max_x", "max_y"};
    const OGREnvelope *all = &layer->rows.around;
    const double side[] = {all->MinX, all->MinY, all->MaxX, all->MaxY};
    char *set = CPLStrdup(""), *is = CPLStrdup("");
    for (int k = 0; k < 4; k++) {
        char number[GIS_SQLITE_NUMBER], part[GIS_SQLITE_NUMBER + 24];
        gis_sqlite_print_number(side[k], number);
        snprintf(part, sizeof part, "%s%s = %s", k ? ", " : "", sides[k], number);
        set = gis_sql_append(set, part);
        snprintf(part, sizeof part, "%snew.%s IS %s", k ? " AND " : "", sides[k], number);
        is = gis_sql_append(is, part);
    }
    char *now = gis_printed("UPDATE gpkg_contents SET %s WHERE lower(table_name) = lower('%s')", set, name);
    char *later = gis_printed(
        "CREATE TEMP TRIGGER sunder_extent_%zu BEFORE UPDATE ON main.gpkg_contents WHEN lower(new.table_name) = "
        "lower('%s') AND NOT (%s) BEGIN UPDATE gpkg_contents SET %s, last_change = new.last_change WHERE "
        "lower(table_name) = lower('%s'); SELECT RAISE(IGNORE); END",
        layer->sink->n_layers, name, is, set, name);
    const bool done = gis_sqlite_run(database, now) && gis_sqlite_run(database, later);
    CPLFree(later);
    CPLFree(now);
    CPLFree(is);
    CPLFree(set);
    return done;
}

bool gis_sink_note_whole(gis_sink_layer *layer, void *database, gis_error *error)
{
    char *name = CPLEscapeString(OGR_L_GetName(layer->layer), -1, CPLES_SQL);
    const bool done = note_count(layer, database, name) && find_extent(layer) && note_extent(layer, database, name);
    CPLFree(name);
    return done || gis_fail(error, "%s, layer %s: the count of its features and their extent cannot be written",
                            layer->sink->request.path, layer->name);
}

/* Does the stored bound `told` reach `side`, one of the four sides of the layer's extent? way = 1: an upper bound; -1:
 * a lower bound. The tolerance allows for GDAL's printing with fifteen digits. */
static bool extent_reaches(double told, double side, int way)
{
    return way * (side - told) <= 1e-14 * fabs(side) + DBL_MIN;
}

bool gis_sink_check_whole(const gis_sink_layer *layer, OGRLayerH as_written, gis_error *error)
{
    const OGREnvelope *all = &layer->rows.around;
    OGREnvelope box;
    if (!layer->rows.n) return true;
    const size_t told = (size_t)OGR_L_GetFeatureCount(as_written, TRUE);
    if (told != layer->written) return gis_sink_fail_count(layer, told, error);
    if (OGR_L_GetExtent(as_written, &box, FALSE) == OGRERR_NONE && extent_reaches(box.MinX, all->MinX, -1) &&
        extent_reaches(box.MinY, all->MinY, -1) && extent_reaches(box.MaxX, all->MaxX, 1) &&
        extent_reaches(box.MaxY, all->MaxY, 1))
        return true;
    return gis_fail(error, "%s, layer %s: its registered extent leaves features out", layer->sink->request.path,
                    layer->name);
}
