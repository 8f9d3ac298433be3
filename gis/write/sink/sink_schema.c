/* sink_schema.c: makes a layer with all properties of the source's layer that the format knows. Which options a format
 * knows is taken from its driver's metadata; losses.c checks the result afterwards. */
#include "base/path.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <inttypes.h>
#include <string.h>

/* ---- Creation options -------------------------------------------------------------------------------------------- */

static char **offer_option(const gis_sink_layer *layer, char **options, const char *name, const char *value)
{
    if (value && value[0] && !CSLFetchNameValue(options, name) && gis_format_has_option(&layer->sink->format, name))
        options = CSLSetNameValue(options, name, value);
    return options;
}

static bool any_field_is(const gis_sink_layer *layer, const char *name)
{
    OGRFeatureDefnH source = gis_sink_source_fields(layer);
    return gis_sink_makes_field(layer, name) || (source && OGR_FD_GetFieldIndex(source, name) >= 0);
}

/* The default names that drivers use for FID and geometry columns; each list ends with NULL. */
static const char *const usual_fid[] = {"fid", "ogc_fid", "OBJECTID", NULL};
static const char *const usual_geometry[] = {"geom", "GEOMETRY", "wkb_geometry", "SHAPE", NULL};

enum { NUMBERED_SIZE = 32 };

/* The name for a FID or geometry column: `wanted` if it is given and free. NULL leaves the choice to the driver, unless
 * an ordinary field has one of the `usual` names; then the first usual name that is free, or a numbered one (in
 * `numbered`). */
static const char *free_name(const gis_sink_layer *layer, const char *wanted, const char *const *usual,
                             char numbered[NUMBERED_SIZE])
{
    if (wanted && wanted[0] && !any_field_is(layer, wanted)) return wanted;
    bool taken = false;
    const char *found = NULL;
    for (const char *const *each = usual; *each; each++) {
        if (any_field_is(layer, *each))
            taken = true;
        else if (!found)
            found = *each;
    }
    for (int i = 1; taken && !found; i++) {
        snprintf(numbered, NUMBERED_SIZE, "%s_%d", usual[0], i);
        if (!any_field_is(layer, numbered)) found = numbered;
    }
    return taken ? found : NULL;
}

static bool identifier_taken(const gis_sink *sink, const char *identifier)
{
    char *quoted = CPLEscapeString(identifier, -1, CPLES_SQL);
    char *sql = gis_printed("SELECT 1 FROM gpkg_contents WHERE identifier = '%s'", quoted);
    OGRLayerH result = GDALDatasetExecuteSQL(sink->dataset, sql, NULL, NULL);
    OGRFeatureH row = result ? OGR_L_GetNextFeature(result) : NULL;
    bool taken = row != NULL;
    if (row) OGR_F_Destroy(row);
    if (result) GDALDatasetReleaseResultSet(sink->dataset, result);
    CPLFree(quoted);
    CPLFree(sql);
    return taken;
}

static char **offer_texts(const gis_sink_layer *layer, char **options)
{
    OGRLayerH source = gis_source_layer(layer->source);
    const char *identifier = OGR_L_GetName(source);
    const char *own = GDALGetMetadataItem(source, "IDENTIFIER", NULL);
    /* An identifier that only repeats the table's name is not copied: identifiers are unique in a GeoPackage, and the
     * new table has another name. */
    if (own && !EQUAL(own, identifier)) {
        if (layer->sink->format.geopackage && layer->sink->updating && identifier_taken(layer->sink, own))
            gis_sentences_add(&layer->sink->warnings,
                              "the identifier \"%s\" is taken; layer %s gets its name as identifier", own, layer->name);
        else
            options = offer_option(layer, options, "IDENTIFIER", own);
    }
    return offer_option(layer, options, "DESCRIPTION", GDALGetMetadataItem(source, "DESCRIPTION", NULL));
}

/* The number of features of the source with a coordinate that is not finite. */
static size_t broken_features(const gis_sink_layer *layer)
{
    return gis_source_content_count(layer->source, GIS_BROKEN);
}

static char **offer_source_names(const gis_sink_layer *layer, char **options)
{
    OGRLayerH source = gis_source_layer(layer->source);
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(source);
    char numbered[NUMBERED_SIZE];
    options = offer_option(layer, options, "FID", free_name(layer, OGR_L_GetFIDColumn(source), usual_fid, numbered));
    if (OGR_FD_GetGeomFieldCount(definition) > 0) {
        OGRGeomFieldDefnH geometry = OGR_FD_GetGeomFieldDefn(definition, 0);
        options = offer_option(layer, options, "GEOMETRY_NAME",
                               free_name(layer, OGR_GFld_GetNameRef(geometry), usual_geometry, numbered));
        /* Only for the source's own geometries: a symbol may be null where the geometry is not. */
        if (layer->request.as_source && !OGR_GFld_IsNullable(geometry) && broken_features(layer) == 0)
            options = offer_option(layer, options, "GEOMETRY_NULLABLE", "NO");
    }
    return layer->request.as_source ? offer_texts(layer, options) : options;
}

/* The encoding of a Shapefile: that of the source if it is a Shapefile with a known one; else UTF-8. */
static const char *shapefile_encoding(const gis_sink *sink)
{
    if (!sink->source) return "UTF-8";
    GDALDriverH driver = GDALGetDatasetDriver(gis_source_dataset(sink->source));
    if (!driver || !EQUAL(GDALGetDescription(driver), "ESRI Shapefile")) return "UTF-8";
    OGRLayerH layer = gis_source_layer(sink->source);
    const char *encoding = GDALGetMetadataItem(layer, "SOURCE_ENCODING", "SHAPEFILE");
    return encoding && encoding[0] ? encoding : "UTF-8";
}

static char **layer_options(const gis_sink_layer *layer)
{
    gis_sink *sink = layer->sink;
    char **options = CSLDuplicate((CSLConstList)sink->request.layer_options), numbered[NUMBERED_SIZE];
    if (layer->request.like_source && layer->source)
        options = offer_source_names(layer, options);
    else {
        options = offer_option(layer, options, "FID", free_name(layer, NULL, usual_fid, numbered));
        options = offer_option(layer, options, "GEOMETRY_NAME", free_name(layer, NULL, usual_geometry, numbered));
    }
    options = offer_option(layer, options, "LAUNDER", "NO");
    options = offer_option(layer, options, "GEOMETRY", "AS_WKT");
    if (!sink->to_stdout) options = offer_option(layer, options, "CREATE_CSVT", "YES");
    if (sink->format.shapefile) options = offer_option(layer, options, "ENCODING", shapefile_encoding(sink));
    /* 17 digits are enough for every double: see sink_rewrite.c */
    if (!CSLFetchNameValue(options, "COORDINATE_PRECISION"))
        options = offer_option(layer, options, "SIGNIFICANT_FIGURES", layer->more_digits ? "20" : "17");
    return options;
}

/* ---- The layer --------------------------------------------------------------------------------------------------- */

static void copy_metadata(const gis_sink_layer *layer)
{
    if (!layer->sink->format.geopackage) return;
    char **all = CSLDuplicate(GDALGetMetadata(gis_source_layer(layer->source), NULL));
    const char *const set_otherwise[] = {"IDENTIFIER", "DESCRIPTION", "DBF_DATE_LAST_UPDATE"};
    for (size_t i = 0; i < sizeof set_otherwise / sizeof *set_otherwise; i++)
        all = CSLSetNameValue(all, set_otherwise[i], NULL);
    if (CSLCount(all) > 0) GDALSetMetadata(layer->layer, all, NULL);
    CSLDestroy(all);
}

/* Takes over the name that the format gave the layer, and notes a loss if it differs: some formats limit the length. A
 * format with a file for each layer may name the layer after its file, which is not a loss. */
static void note_name(gis_sink_layer *layer)
{
    const char *name = OGR_L_GetName(layer->layer);
    if (strcmp(name, layer->name) == 0) return;
    if (!layer->file) gis_sentences_add(&layer->sink->losses, "layer %s is called %s", layer->name, name);
    CPLFree(layer->name);
    layer->name = CPLStrdup(name);
}

static void note_broken(gis_sink_layer *layer)
{
    const size_t n = layer->request.as_source ? broken_features(layer) : 0;
    if (n > 0)
        gis_sentences_add(&layer->sink->losses,
                          "%zu feature%s written without geometry: a coordinate of %s is not a finite number", n,
                          n == 1 ? " is" : "s are", n == 1 ? "it" : "each");
}

static bool digits_are_ours(const gis_sink *sink)
{
    CSLConstList given = (CSLConstList)sink->request.layer_options;
    return gis_format_has_option(&sink->format, "SIGNIFICANT_FIGURES") &&
           !CSLFetchNameValue(given, "SIGNIFICANT_FIGURES") && !CSLFetchNameValue(given, "COORDINATE_PRECISION");
}

bool gis_sink_create_layer(gis_sink_layer *layer, gis_error *error)
{
    gis_sink *sink = layer->sink;
    gis_sink_choose_type(layer);
    /* shapelib's own orientation of rings is turned off. It takes a hole whose Z differs from the outer ring's for an
     * outer ring (and the hole is filled when read), and an invalid member that crosses another for a hole of it. Here
     * it is known which rings are holes, so the rings are oriented before shapelib gets them. */
    layer->wind = sink->format.shapefile;
    if (layer->wind && !CPLGetConfigOption("SHAPE_REWIND_ON_WRITE", NULL)) {
        CPLSetThreadLocalConfigOption("SHAPE_REWIND_ON_WRITE", "NO");
        sink->set_rewind = true;
    }
    char **options = layer_options(layer);
    const char *encoding = sink->format.shapefile ? CSLFetchNameValue(options, "ENCODING") : NULL;
    layer->has_encoding = encoding && encoding[0];
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    layer->layer = GDALDatasetCreateLayer(layer->dataset, layer->name, gis_sink_crs(layer), layer->type, options);
    bool done = layer->layer != NULL;
    if (done) {
        note_name(layer);
        if (layer->request.as_source) copy_metadata(layer);
        note_broken(layer);
        gis_sink_create_fields(layer);
        done = !sink->format.geopackage || gis_rtree_begin(layer->dataset, layer->layer, &layer->tree, error);
        layer->can_measure = OGR_L_TestCapability(layer->layer, OLCMeasuredGeometries);
        layer->can_curve = OGR_L_TestCapability(layer->layer, OLCCurveGeometries);
    }
    gis_listen_end();
    /* After a failed statement GDAL may continue with an incomplete layer in a database. */
    if (!layer->layer || (sink->format.sqlite && listener.failures))
        done = gis_fail(error, "%s: layer %s cannot be made: %s", sink->request.path, layer->name,
                        gis_listener_reason(&listener, "GDAL gives no reason"));
    gis_listener_clear(&listener);
    CSLDestroy(options);
    /* The guarantee covers the features; geometries of arrows and links may be rounded. */
    layer->promised = layer->request.like_source || !layer->request.suffix[0];
    layer->keep_sent = gis_sink_remembers(sink);
    layer->can_rewrite = layer->keep_sent && layer->file && digits_are_ours(sink);
    if (done && sink->format.keeps_doubles) gis_digests_begin(layer);
    return done && gis_sink_unbroken(sink, error);
}
