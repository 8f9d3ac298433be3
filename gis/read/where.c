/* where.c: see where.h. For a database GDAL passes a condition on, so it must be in the database's SQL; for all other
 * formats GDAL evaluates it itself, in its own dialect. A condition in the wrong dialect is reported as an unknown
 * column, which does not show the cause. */
#define _GNU_SOURCE /* strcasestr() */
#include "read/where.h"

#include "read/field_names.h"

#include <cpl_string.h>
#include <stdio.h>
#include <string.h>

/* Does the layer's driver evaluate conditions in an SQL of its own? */
static bool has_own_sql(GDALDatasetH dataset)
{
    static const char *const drivers[] = {"GPKG", "SQLite", "PostgreSQL", "MySQL", "MSSQLSpatial", "OCI"};
    GDALDriverH driver = dataset ? GDALGetDatasetDriver(dataset) : NULL;
    const char *name = driver ? GDALGetDriverShortName(driver) : "";
    for (size_t i = 0; i < sizeof drivers / sizeof *drivers; i++)
        if (EQUAL(name, drivers[i])) return true;
    return false;
}

static void explain_sizes(GDALDatasetH dataset, OGRLayerH layer, const char *where, char *text, size_t size)
{
    const char *column = OGR_L_GetGeometryColumn(layer);
    bool own = has_own_sql(dataset);
    if (!column || !column[0]) column = "geom";
    if (own && strcasestr(where, "OGR_GEOM"))
        snprintf(text, size, "; a condition on %s is in its own SQL, in which the area is ST_Area(\"%s\")",
                 GDALGetDriverShortName(GDALGetDatasetDriver(dataset)), column);
    else if (own && strcasestr(where, "ST_"))
        snprintf(text, size, "; its geometry is \"%s\"", column);
    else if (!own && strcasestr(where, "ST_"))
        snprintf(text, size, "; a condition on this format is in OGR SQL, in which the area is OGR_GEOM_AREA");
}

bool gis_fail_where(GDALDatasetH dataset, OGRLayerH layer, const char *option, const char *where, const char *reason,
                    gis_error *error)
{
    char sizes[256] = "", fields[GIS_FIELD_NAMES_SIZE];
    explain_sizes(dataset, layer, where, sizes, sizeof sizes);
    gis_field_names(layer, fields, sizeof fields);
    size_t n = strlen(reason);
    while (n && reason[n - 1] == '.') n--;
    return gis_fail_usage(error, "%s \"%s\": %.*s%s; %s", option, where, (int)n, reason, sizes, fields);
}
