/* format.c: finds the driver for an output, and what the program's guarantees mean in its format. */
#include "write/sink/format.h"

#include "base/path.h"
#include "write/sink/abilities.h"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <string.h>

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
    /* Extensions that several drivers claim, or that GDAL's list lacks. */
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

/* Can the program write with this driver, and does the driver accept the ending of `path`? */
static bool check_able(const gis_abilities *able, const char *path, bool connection, gis_error *error)
{
    if (able->refused && !connection)
        return gis_fail_usage(error, "%s: cannot be written as %s: %s", path, able->driver, able->refused);
    char **endings = CSLTokenizeString2(able->endings ? able->endings : "", " ", 0);
    const bool directory = (able->has & GIS_TAKES_DIRECTORY) && !extension_of(path)[0];
    const bool ends = !able->endings || connection || directory || CSLFindString(endings, extension_of(path)) >= 0 ||
                      strncmp(path, "/vsistdout", 10) == 0 || strcmp(path, "/dev/stdout") == 0;
    CSLDestroy(endings);
    return ends || gis_fail_usage(error, "%s: the name of a file of format %s has to end in one of these: %s", path,
                                  able->driver, able->endings);
}

bool gis_format_find(const char *path, const char *name, const char *const *layer_options, gis_format *out,
                     gis_error *error)
{
    gis_format format = {.driver = name ? GDALGetDriverByName(name) : driver_for(path)};
    if (!format.driver && name) return gis_fail_usage(error, "--of %s: GDAL has no such format", name);
    if (!format.driver)
        return gis_fail_usage(error, "%s: the format is not known from the name; give it with --of", path);
    format.name = GDALGetDescription(format.driver);
    if (!can_create(format.driver))
        return gis_fail_usage(error, "--of %s: GDAL cannot create vector data in this format", format.name);
    const gis_abilities able = gis_abilities_of(format.name);
    if (!check_able(&able, path, has_prefix(format.driver, path), error)) return false;
    format.database = has_prefix(format.driver, path);
    format.shapefile = EQUAL(format.name, "ESRI Shapefile");
    format.geopackage = EQUAL(format.name, "GPKG");
    format.sqlite = format.geopackage || EQUAL(format.name, "SQLite");
    format.only_written = !GDALGetMetadataItem(format.driver, GDAL_DCAP_OPEN, NULL) || (able.has & GIS_IS_NOT_READ);
    format.abilities = able.has;
    format.own_field = able.own_field;
    format.keeps_fids = able.has & GIS_KEEPS_FIDS;
    format.keeps_doubles = able.has & GIS_KEEPS_DOUBLES;
    format.keeps_values = able.has & GIS_KEEPS_VALUES;
    format.keeps_order = able.has & GIS_KEEPS_ORDER;
    format.reprojects = able.has & GIS_REPROJECTS;
    format.one_layer = able.has & GIS_ONE_LAYER;
    format.lines = CSLFindString((CSLConstList)texts, format.name) >= 0;
    format.keeps_vertices = format.keeps_doubles || format.shapefile;
    if (EQUAL(format.name, "GeoJSON") && CPLFetchBool((CSLConstList)layer_options, "RFC7946", false))
        format.reprojects = true;
    if ((able.has & GIS_TAKES_DIRECTORY) && !has_extension(format.driver, extension_of(path)) &&
        !EQUAL(extension_of(path), "csv"))
        format.one_layer = false;
    *out = format;
    return true;
}

/* Does the driver's list, which is XML, have the option? True if there is no list. */
static bool lists(const char *list, const char *option)
{
    CPLXMLNode *root = list ? CPLParseXMLString(list) : NULL;
    bool found = !root;
    for (const CPLXMLNode *node = root ? root->psChild : NULL; node && !found; node = node->psNext)
        found = node->eType == CXT_Element &&
                (EQUAL(CPLGetXMLValue(node, "name", ""), option) || EQUAL(CPLGetXMLValue(node, "alias", ""), option));
    CPLDestroyXMLNode(root);
    return found;
}

bool gis_format_has_option(const gis_format *format, const char *option)
{
    const char *list = GDALGetMetadataItem(format->driver, GDAL_DS_LAYER_CREATIONOPTIONLIST, NULL);
    return list && lists(list, option);
}

void gis_format_tell_unknown(const gis_format *format, const char *kind, const char *const *options, gis_sentences *out)
{
    const char *list = GDALGetMetadataItem(format->driver, kind, NULL);
    for (size_t i = 0; options && options[i]; i++) {
        char *name = NULL;
        CPLParseNameValue(options[i], &name);
        if (name && !lists(list, name))
            gis_sentences_add(out, "creation option %s has no effect: %s has no such option", options[i], format->name);
        CPLFree(name);
    }
}
