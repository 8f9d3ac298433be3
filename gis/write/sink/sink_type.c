/* sink_type.c: the geometry type that a layer is declared with, and the conversion of features to it: the source's
 * type, the multi type (-nlt PROMOTE_TO_MULTI), or, if a driver requires a definite type, the type of its features. */
#include "write/sink/abilities.h"
#include "write/sink/sink_internal.h"

/* Is the type open: may features of different types be in the layer? */
static bool is_open(OGRwkbGeometryType type)
{
    return wkbFlatten(type) == wkbUnknown || wkbFlatten(type) == wkbGeometryCollection;
}

/* Do all features with a geometry have this content? */
static bool all_are(const gis_source *source, gis_content content)
{
    for (gis_content other = GIS_NOTHING + 1; other < GIS_BROKEN; other++)
        if (other != content && gis_source_content_count(source, other) > 0) return false;
    return true;
}

static bool any_is_3d(const gis_source *source)
{
    for (size_t i = 0; i < gis_source_count(source); i++) {
        OGRGeometryH geometry = gis_source_geometry(source, i);
        if (geometry && OGR_G_Is3D(geometry)) return true;
    }
    return false;
}

/* The multi type for the features of a source whose `type` is open; `type` itself if they are of more than one kind. */
static OGRwkbGeometryType type_of_content(const gis_source *source, OGRwkbGeometryType type)
{
    OGRwkbGeometryType found = all_are(source, GIS_POLYGONS) ? wkbMultiPolygon
                               : all_are(source, GIS_POINTS) ? wkbMultiPoint
                                                             : type;
    return found == type ? type : OGR_GT_SetModifier(found, OGR_GT_HasZ(type) || any_is_3d(source), OGR_GT_HasM(type));
}

/* Is the source a Shapefile declared as Polygon that holds multipolygons? Shapefiles use Polygon for both; other
 * formats distinguish the two, so there the layer is declared as MultiPolygon, and every feature is written as one. */
static bool means_both(const gis_sink_layer *layer, OGRwkbGeometryType type)
{
    const gis_source *source = layer->source;
    if (!layer->request.as_source || layer->sink->format.shapefile || wkbFlatten(type) != wkbPolygon) return false;
    GDALDriverH driver = GDALGetDatasetDriver(gis_source_dataset(source));
    if (!driver || !EQUAL(GDALGetDescription(driver), "ESRI Shapefile")) return false;
    return gis_source_has_multipolygons(source);
}

void gis_sink_choose_type(gis_sink_layer *layer)
{
    const gis_sink *sink = layer->sink;
    const bool promoted = sink->request.promote && !layer->request.suffix[0];
    OGRwkbGeometryType type = layer->request.as_source ? gis_source_type(layer->source) : layer->request.type;
    if (layer->request.as_source && is_open(type) && (promoted || (sink->format.abilities & GIS_NEEDS_TYPE))) {
        type = type_of_content(layer->source, type);
        layer->promote = promoted || !is_open(type);
    } else if (promoted || means_both(layer, type)) {
        const OGRwkbGeometryType several = OGR_GT_GetCollection(type);
        if (wkbFlatten(several) != wkbUnknown && wkbFlatten(several) != wkbGeometryCollection) type = several;
        layer->promote = true;
    }
    layer->type = type;
}

void gis_sink_promote(const gis_sink_layer *layer, OGRFeatureH to)
{
    OGRGeometryH geometry = OGR_F_GetGeometryRef(to);
    if (!geometry) return;
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    const OGRwkbGeometryType wanted = wkbFlatten(layer->type);
    if (type == wkbGeometryCollection && (wanted == wkbMultiPolygon || wanted == wkbMultiPoint))
        OGR_F_SetGeometryDirectly(to, OGR_G_ForceTo(OGR_F_StealGeometry(to), wanted, NULL));
    else if (type == wkbPoint || type == wkbPolygon || type == wkbCurvePolygon || OGR_GT_IsSubClassOf(type, wkbCurve))
        OGR_F_SetGeometryDirectly(to, OGR_G_ForceTo(OGR_F_StealGeometry(to), OGR_GT_GetCollection(type), NULL));
}

bool gis_sink_check_type(const gis_sink *sink, gis_error *error)
{
    const gis_sink_request *request = &sink->request;
    const unsigned lacks = sink->format.abilities;
    if (request->polygons && (lacks & GIS_HAS_NO_POLYGONS))
        return gis_fail(error, "%s: %s holds no polygons; write another format", request->path, sink->format.name);
    if (!request->features || !(lacks & GIS_NEEDS_TYPE)) return true;
    for (size_t k = 0; k <= request->n_more; k++) {
        const gis_source *source = gis_sink_source(sink, k);
        if (is_open(gis_source_type(source)) && is_open(type_of_content(source, gis_source_type(source))))
            return gis_fail(error,
                            "%s: the layer %s holds geometries of several kinds, and a layer of %s can hold only one "
                            "kind: select them with --where, or write another format",
                            request->path, gis_source_name(source), sink->format.name);
    }
    return true;
}
