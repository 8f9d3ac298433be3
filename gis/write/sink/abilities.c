/* abilities.c: see abilities.h. Checked with GDAL 3.6. */
#include "write/sink/abilities.h"

#include <cpl_string.h>
#include <stddef.h>

#define NO_LAYERS "it writes no layers of geometries"
#define IS_SERVER "it is a service: OUTPUT is its connection, as GDAL spells it"

enum {
    FIDS = GIS_KEEPS_FIDS,
    DOUBLES = GIS_KEEPS_DOUBLES,
    VALUES = GIS_KEEPS_VALUES,
    ORDER = GIS_KEEPS_ORDER,
    CASE = GIS_KEEPS_CASE,
    REPROJECTS = GIS_REPROJECTS,
    ONE_LAYER = GIS_ONE_LAYER,
    DIRECTORY = GIS_ONE_LAYER | GIS_TAKES_DIRECTORY,
    NO_NULL = GIS_HAS_NO_NULL,
    NEEDS_TYPE = GIS_NEEDS_TYPE,
    DROPS_EMPTY = GIS_DROPS_EMPTY
};

/* clang-format off */
static const gis_abilities known[] = {
    {"GPKG", FIDS | DOUBLES | VALUES | ORDER, NULL, NULL, NULL},
    {"SQLite", FIDS | DOUBLES | VALUES | ORDER, NULL, "ogc_fid", NULL},
    {"OpenFileGDB", ORDER | NEEDS_TYPE, NULL, NULL, NULL}, /* rounds coordinates to a grid */
    {"FlatGeobuf", DOUBLES | VALUES | DIRECTORY | GIS_NEEDS_GEOMETRY, NULL, NULL, NULL}, /* sorts features in space */
    {"ESRI Shapefile", ORDER | DIRECTORY, NULL, NULL, NULL}, /* stores binary doubles, but regroups rings */
    {"GeoJSON", FIDS | ORDER | CASE | ONE_LAYER | GIS_NEEDS_POSITIVE_FIDS, NULL, NULL, NULL},
    {"GeoJSONSeq", FIDS | ORDER | CASE | REPROJECTS | ONE_LAYER | DROPS_EMPTY | GIS_NEEDS_POSITIVE_FIDS, NULL, NULL,
     NULL},
    {"CSV", ORDER | DIRECTORY, NULL, NULL, NULL},
    {"MapInfo File", ORDER | DIRECTORY | NO_NULL, NULL, NULL, "tab mif"},
    {"GML", ORDER, NULL, NULL, NULL},
    {"DXF", ORDER | ONE_LAYER, NULL, NULL, NULL},
    {"DGN", ORDER | ONE_LAYER, NULL, NULL, NULL},
    {"OGR_GMT", ORDER | ONE_LAYER, NULL, NULL, NULL},
    {"JML", ORDER | ONE_LAYER, NULL, NULL, NULL},
    {"PDS4", ORDER | NO_NULL, NULL, NULL, NULL},
    {"netCDF", ORDER | NEEDS_TYPE | DROPS_EMPTY | NO_NULL, NULL, NULL, NULL},
    {"PCIDSK", ORDER | GIS_HAS_NO_POLYGONS, NULL, NULL, NULL},
    {"Geoconcept", ORDER | NEEDS_TYPE | ONE_LAYER | DROPS_EMPTY, NULL, NULL, NULL},
    {"VDV", ORDER, NULL, NULL, NULL}, /* holds only attributes, as do the next two */
    {"ODS", ORDER | DROPS_EMPTY, NULL, NULL, NULL},
    {"XLSX", ORDER | DROPS_EMPTY, NULL, NULL, "xlsx"},
    {"PDF", ORDER | DROPS_EMPTY, NULL, NULL, NULL},
    /* These formats hold degrees (WGS 84). */
    {"KML", ORDER | REPROJECTS, NULL, NULL, NULL},
    {"LIBKML", ORDER | REPROJECTS, NULL, NULL, NULL},
    {"MapML", ORDER | REPROJECTS, NULL, NULL, NULL},
    {"MVT", REPROJECTS | GIS_IS_NOT_READ, NULL, NULL, NULL}, /* each tile is opened separately */
    {"MBTiles", REPROJECTS | GIS_IS_NOT_READ, NULL, NULL, NULL},
    {"GeoRSS", ORDER | ONE_LAYER | GIS_NEEDS_WGS84, NULL, NULL, NULL},
    /* Connections to servers. */
    {"PostgreSQL", FIDS | DOUBLES | CASE, IS_SERVER, NULL, NULL}, /* texts have a maximal width */
    {"MySQL", 0, IS_SERVER, NULL, NULL},
    {"MSSQLSpatial", 0, IS_SERVER, NULL, NULL},
    {"Elasticsearch", 0, IS_SERVER, NULL, NULL},
    {"Carto", 0, IS_SERVER, NULL, NULL},
    {"AmigoCloud", 0, IS_SERVER, NULL, NULL},
    {"NGW", 0, IS_SERVER, NULL, NULL},
    /* The program does not write these. */
    {"FITS", 0, NO_LAYERS, NULL, NULL},
    {"VICAR", 0, NO_LAYERS, NULL, NULL},
    {"BAG", 0, NO_LAYERS, NULL, NULL},
    {"S57", 0, "it has only the layers of its own catalogue", NULL, NULL},
    {"Interlis 1", 0, "its layers are defined by a model, and others cannot be created", NULL, NULL},
    {"Interlis 2", 0, "its layers are defined by a model, and others cannot be created", NULL, NULL},
    {"WAsP", 0, "it holds only lines of elevation and roughness", NULL, NULL},
    {"Selafin", 0, "it holds only the points of a mesh", NULL, NULL},
    {"GPX", 0, "it holds only waypoints, routes and tracks", NULL, NULL},
    {"GPSBabel", 0, "it passes tracks and waypoints to another program", NULL, NULL},
    {"Memory", 0, "it is not kept when the program ends", NULL, NULL},
    {"MEM", 0, "it is not kept when the program ends", NULL, NULL},
};
/* clang-format on */

gis_abilities gis_abilities_of(const char *driver)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (EQUAL(driver, known[i].driver)) return known[i];
    return (gis_abilities){.driver = driver};
}
