/* source_layer.c: chooses the layer of a dataset, and checks whether it can hold what a command needs. Nothing is
 * guessed: if several layers are suitable, none is taken, and they are listed. */
#include "read/source_layer.h"
#include "read/source.h"

#include <stdio.h>
#include <string.h>

/* The kinds of geometry that a layer of this declared type may hold; unknown types and collections may hold any. */
static unsigned kinds_of(OGRwkbGeometryType type)
{
    OGRwkbGeometryType flat = wkbFlatten(type);
    if (flat == wkbNone) return 0;
    if (flat == wkbUnknown || flat == wkbGeometryCollection)
        return GIS_TAKES_POLYGONS | GIS_TAKES_POINTS | GIS_TAKES_LINES;
    if (OGR_GT_IsSubClassOf(flat, wkbSurface) || OGR_GT_IsSubClassOf(flat, wkbMultiSurface)) return GIS_TAKES_POLYGONS;
    if (flat == wkbPoint || flat == wkbMultiPoint) return GIS_TAKES_POINTS;
    return GIS_TAKES_LINES;
}

static const char *words_for(unsigned takes)
{
    switch (takes) {
    case GIS_TAKES_POLYGONS: return "polygons";
    case GIS_TAKES_POINTS: return "points";
    case GIS_TAKES_LINES: return "lines";
    case GIS_TAKES_POLYGONS | GIS_TAKES_POINTS: return "polygons or points";
    default: return "geometries";
    }
}

/* Appends to a text of fixed size; what does not fit is dropped, which only shortens a list in a message. */
static void append_text(char *text, size_t size, const char *more)
{
    size_t used = strlen(text);
    snprintf(text + used, size - used, "%s", more);
}

/* Writes "roads (Line String), rivers (Multi Line String)": the layers of a kind in `takes`, or all if takes is 0. */
static void list_layers(GDALDatasetH dataset, unsigned takes, char *text, size_t size)
{
    text[0] = '\0';
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); i++) {
        OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
        if (GDALDatasetIsLayerPrivate(dataset, i) || (takes && !(kinds_of(OGR_L_GetGeomType(layer)) & takes))) continue;
        if (text[0]) append_text(text, size, ", ");
        append_text(text, size, OGR_L_GetName(layer));
        append_text(text, size, " (");
        append_text(text, size, OGRGeometryTypeToName(OGR_L_GetGeomType(layer)));
        append_text(text, size, ")");
    }
    if (!text[0]) append_text(text, size, "none");
}

bool gis_layer_fits(OGRLayerH layer, const char *name, unsigned takes, gis_error *error)
{
    OGRwkbGeometryType type = OGR_L_GetGeomType(layer);
    if (kinds_of(type) & takes) return true;
    if (type == wkbNone) return gis_fail(error, "layer %s has no geometry; %s are needed", name, words_for(takes));
    return gis_fail(error, "layer %s is declared as %s; %s are needed", name, OGRGeometryTypeToName(type),
                    words_for(takes));
}

OGRLayerH gis_choose_layer(GDALDatasetH dataset, const gis_source_request *request, gis_error *error)
{
    const char *path = request->path, *name = request->layer;
    unsigned takes = request->takes;
    char listed[700];
    if (name) {
        gis_listener listener = {0};
        gis_listen_begin(&listener);
        OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name);
        gis_listen_end();
        gis_listener_clear(&listener);
        if (!layer) {
            list_layers(dataset, 0, listed, sizeof listed);
            gis_fail(error, "%s has no layer %s; its layers: %s", path, name, listed);
        }
        return layer;
    }
    OGRLayerH like = request->layer_like ? GDALDatasetGetLayerByName(dataset, request->layer_like) : NULL;
    if (like) return like;
    OGRLayerH only = NULL, fitting = NULL;
    int visible = 0, fit = 0;
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); i++) {
        if (GDALDatasetIsLayerPrivate(dataset, i)) continue;
        OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
        visible++;
        only = layer;
        if (kinds_of(OGR_L_GetGeomType(layer)) & takes) {
            fit++;
            fitting = layer;
        }
    }
    if (fit == 1) return fitting;
    if (visible == 1) return only; /* gis_layer_fits() will report if it is unsuitable */
    list_layers(dataset, fit ? takes : 0, listed, sizeof listed);
    if (fit)
        gis_fail(error, "%s has several suitable layers; choose one with %s: %s", path,
                 request->layer_option ? request->layer_option : "--input-layer", listed);
    else
        gis_fail(error, "%s has no layer of %s; its layers: %s", path, words_for(takes), listed);
    return NULL;
}
