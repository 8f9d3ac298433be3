/* format.c: finding the driver for an output, and what our promises mean in its format. */
#include "write/format.h"

#include "base/path.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <string.h>

/* Facts about formats, checked with GDAL 3.6. A format that is not listed is believed nothing: FIDs go to a field and
 * coordinates are read back. */
typedef struct facts {
    const char *name;
    bool keeps_fids, keeps_doubles, keeps_values, keeps_order, reprojects, one_layer;
} facts;

/* clang-format off */
static const facts known[] = {
    /*                  FIDs   doubles values order reprojects one layer */
    {"GPKG",            true,  true,  true,  true,  false, false},
    {"SQLite",          true,  true,  true,  true,  false, false},
    {"PostgreSQL",      true,  true,  false, false, false, false}, /* texts have widths */
    {"OpenFileGDB",     false, false, false, true,  false, false}, /* puts coordinates on a grid */
    {"FlatGeobuf",      false, true,  true,  false, false, true}, /* its index sorts the features */
    {"ESRI Shapefile",  false, false, false, true,  false, true}, /* binary doubles, but rings are regrouped */
    {"GeoJSON",         true,  false, false, true,  false, true},
    {"GeoJSONSeq",      true,  false, false, true,  true,  true},
    {"KML",             false, false, false, true,  true,  false},
    {"LIBKML",          false, false, false, true,  true,  false},
    {"GPX",             false, false, false, true,  true,  false},
    {"MapML",           false, false, false, true,  true,  false},
    {"MVT",             false, false, false, false, true,  false},
    {"MBTiles",         false, false, false, false, true,  false},
    {"CSV",             false, false, false, true,  false, true},
    {"MapInfo File",    false, false, false, true,  false, true},
    {"DXF",             false, false, false, true,  false, true},
    {"GML",             false, false, false, true,  false, false},
};
/* clang-format on */

static const char *const texts[] = {"GeoJSON", "GeoJSONSeq", "CSV", "GML", "KML", NULL};

static bool can_create(GDALDriverH driver)
{
    return GDALGetMetadataItem(driver, GDAL_DCAP_VECTOR, NULL) && GDALGetMetadataItem(driver, GDAL_DCAP_CREATE, NULL);
}

static bool has_extension(GDALDriverH driver, const char *extension)
{
    const char *all = GDALGetMetadataItem(driver, GDAL_DMD_EXTENSIONS, NULL);
    if (!all) all = GDALGetMetadataItem(driver, GDAL_DMD_EXTENSION, NULL);
    char **each = CSLTokenizeString2(all ? all : "", " ", 0);
    bool found = CSLFindString(each, extension) >= 0;
    CSLDestroy(each);
    return found;
}

static bool has_prefix(GDALDriverH driver, const char *path)
{
    const char *prefix = GDALGetMetadataItem(driver, GDAL_DMD_CONNECTION_PREFIX, NULL);
    return prefix && prefix[0] && EQUALN(path, prefix, strlen(prefix));
}

static const char *extension_of(const char *path)
{
    size_t length = strlen(path);
    return length > 8 && EQUAL(path + length - 8, ".shp.zip") ? "shp.zip" : gis_path_extension(path);
}

static GDALDriverH driver_for(const char *path)
{
    /* Endings that several drivers claim, or that GDAL's own list lacks. */
    static const char *const first[][2] = {{"json", "GeoJSON"},           {"shz", "ESRI Shapefile"},
                                           {"shp.zip", "ESRI Shapefile"}, {"db", "SQLite"},
                                           {"sqlite", "SQLite"},          {"gdb", "OpenFileGDB"}};
    char extension[32];
    CPLStrlcpy(extension, extension_of(path), sizeof extension);
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        if (EQUAL(extension, first[i][0]) && GDALGetDriverByName(first[i][1])) return GDALGetDriverByName(first[i][1]);
    for (int i = 0; i < GDALGetDriverCount(); i++)
        if (can_create(GDALGetDriver(i)) && has_prefix(GDALGetDriver(i), path)) return GDALGetDriver(i);
    for (int i = 0; extension[0] && i < GDALGetDriverCount(); i++)
        if (can_create(GDALGetDriver(i)) && has_extension(GDALGetDriver(i), extension)) return GDALGetDriver(i);
    return NULL;
}

bool gis_format_find(const char *path, const char *name, const char *const *layer_options, gis_format *out,
                     gis_error *error)
{
    gis_format format = {.driver = name ? GDALGetDriverByName(name) : driver_for(path)};
    if (!format.driver && name) return gis_fail_usage(error, "--of %s: GDAL has no such format", name);
    if (!format.driver) return gis_fail_usage(error, "%s: the name does not tell the format; give it with --of", path);
    format.name = GDALGetDescription(format.driver);
    if (!can_create(format.driver))
        return gis_fail_usage(error, "--of %s: GDAL cannot create vector data in this format", format.name);
    format.database = has_prefix(format.driver, path);
    format.shapefile = EQUAL(format.name, "ESRI Shapefile");
    format.geopackage = EQUAL(format.name, "GPKG");
    format.sqlite = format.geopackage || EQUAL(format.name, "SQLite");
    format.only_written = !GDALGetMetadataItem(format.driver, GDAL_DCAP_OPEN, NULL) ||
                          EQUAL(format.name, "MVT"); /* tiles are opened one by one */
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (EQUAL(format.name, known[i].name)) {
            format.keeps_fids = known[i].keeps_fids;
            format.keeps_doubles = known[i].keeps_doubles;
            format.keeps_values = known[i].keeps_values;
            format.keeps_order = known[i].keeps_order;
            format.reprojects = known[i].reprojects;
            format.one_layer = known[i].one_layer;
        }
    format.lines = CSLFindString((CSLConstList)texts, format.name) >= 0;
    format.keeps_vertices = format.keeps_doubles || format.shapefile;
    if (EQUAL(format.name, "GeoJSON") && CPLFetchBool((CSLConstList)layer_options, "RFC7946", false))
        format.reprojects = true;
    /* These take a directory too, which then holds a file for each layer. */
    if (format.one_layer && !EQUALN(format.name, "GeoJSON", 7) && !has_extension(format.driver, extension_of(path)) &&
        !EQUAL(extension_of(path), "csv"))
        format.one_layer = false;
    *out = format;
    return true;
}

bool gis_format_has_option(const gis_format *format, const char *option)
{
    const char *list = GDALGetMetadataItem(format->driver, GDAL_DS_LAYER_CREATIONOPTIONLIST, NULL);
    char quoted[64];
    snprintf(quoted, sizeof quoted, "name='%s'", option);
    if (list && strstr(list, quoted)) return true;
    snprintf(quoted, sizeof quoted, "name=\"%s\"", option);
    return list && strstr(list, quoted);
}
