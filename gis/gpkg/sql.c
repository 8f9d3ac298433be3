/* sql.c: see sql.h. GDAL returns no result both for a statement without one and for one that failed; errors that it
 * reports meanwhile distinguish the two. */
#include "gpkg/sql.h"

#include <cpl_conv.h>
#include <ogr_api.h>

bool gis_sql_run(GDALDatasetH dataset, const char *sql, const char *what, gis_error *error)
{
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    OGRLayerH result = GDALDatasetExecuteSQL(dataset, sql, NULL, NULL);
    if (result) GDALDatasetReleaseResultSet(dataset, result);
    gis_listen_end();
    bool done = !listener.failures;
    if (!done)
        gis_fail(error, "%s cannot be written: %s", what, gis_listener_reason(&listener, "GDAL gives no reason"));
    gis_listener_clear(&listener);
    return done;
}

char *gis_sql_ask(GDALDatasetH dataset, const char *sql)
{
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    OGRLayerH result = GDALDatasetExecuteSQL(dataset, sql, NULL, NULL);
    OGRFeatureH row = result ? OGR_L_GetNextFeature(result) : NULL;
    char *text = row && OGR_F_IsFieldSetAndNotNull(row, 0) ? CPLStrdup(OGR_F_GetFieldAsString(row, 0)) : NULL;
    if (row) OGR_F_Destroy(row);
    if (result) GDALDatasetReleaseResultSet(dataset, result);
    gis_listen_end();
    gis_listener_clear(&listener);
    return text;
}
