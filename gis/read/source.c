/* source.c: opens a source and selects its features. source_layer.c chooses the layer, source_features.c reads the
 * features, source_mark.c marks features by a condition. */
#define _LARGEFILE64_SOURCE /* cpl_vsi.h needs struct stat64 */
#include "read/source_features.h"

#include "base/path.h"
#include "geometry/geometry.h"
#include "gpkg/sqlite_calls.h"
#include "gpkg/sqlite_lock.h"
#include "read/source_layer.h"
#include "read/where.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <stdlib.h>
#include <string.h>

/* ---- Opening ----------------------------------------------------------------------------------------------------- */

static bool open_dataset(gis_source *source, const gis_source_request *request, gis_error *error)
{
    if (!gis_path_suits_gdal(request->path, "the input", error)) return false;
    const char *planted = gis_sqlite_planted_companion(request->path);
    if (planted) return gis_fail(error, GIS_SQLITE_PLANTED, request->path, planted, request->path);
    /* Standard input can be rewound only up to a megabyte, unless GDAL is told to keep all of it. */
    if (strncmp(request->path, "/vsistdin/", 10) == 0 && !CPLGetConfigOption("CPL_VSISTDIN_BUFFER_LIMIT", NULL))
        CPLSetThreadLocalConfigOption("CPL_VSISTDIN_BUFFER_LIMIT", "-1");
    gis_sqlite_heed_signals();
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    source->dataset = GDALOpenEx(request->path, GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                 request->drivers, request->open_options, NULL);
    gis_listen_end();
    if (!source->dataset) {
        VSIStatBufL status;
        if (VSIStatExL(request->path, &status, VSI_STAT_EXISTS_FLAG) != 0 && !strchr(request->path, ':'))
            gis_fail(error, "%s: no such file", request->path);
        else if (gis_sqlite_has_journal(request->path))
            gis_fail(error,
                     "%s cannot be read: %s-journal was left by an interrupted transaction; SQLite rolls it back when "
                     "a program that may write opens the database, such as sqlite3",
                     request->path, request->path);
        else
            gis_fail(error, "%s: cannot be opened as a vector dataset: %s", request->path,
                     gis_listener_reason(&listener, "no driver recognises it"));
    }
    gis_source_keep_warnings(source, &listener);
    gis_listener_clear(&listener);
    return source->dataset != NULL;
}

static OGRGeometryH box_polygon(const double box[4])
{
    double xy[] = {box[0], box[1], box[2], box[1], box[2], box[3], box[0], box[3]};
    size_t ring_end = 4, poly_end = 1;
    const gis_polygons ring = {
        .xy = xy, .ring_end = &ring_end, .poly_end = &poly_end, .vertices = 4, .rings = 1, .polygons = 1};
    return gis_geometry_polygon(&ring, 0);
}

static bool run_statement(gis_source *source, const gis_source_request *request, gis_error *error)
{
    OGRGeometryH box = request->bbox ? box_polygon(request->bbox) : NULL;
    gis_sqlite_heed_signals();
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    source->layer = GDALDatasetExecuteSQL(source->dataset, request->sql, box, request->dialect);
    gis_listen_end();
    source->is_result = source->layer != NULL;
    if (box) OGR_G_DestroyGeometry(box);
    if (!source->layer)
        gis_fail(error, "%s: --sql: %s", request->path,
                 gis_listener_reason(&listener, "the statement returns no layer"));
    gis_listener_clear(&listener);
    return source->layer != NULL;
}

static bool select_features(gis_source *source, const gis_source_request *request, gis_error *error)
{
    if (request->bbox && !request->sql)
        OGR_L_SetSpatialFilterRect(source->layer, request->bbox[0], request->bbox[1], request->bbox[2],
                                   request->bbox[3]);
    double box[4];
    source->within = request->within && request->within(request->user, source->layer, source->crs, box);
    if (source->within) OGR_L_SetSpatialFilterRect(source->layer, box[0], box[1], box[2], box[3]);
    if (!request->where) return true;
    source->where = CPLStrdup(request->where);
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    OGRErr status = OGR_L_SetAttributeFilter(source->layer, request->where);
    gis_listen_end();
    if (status != OGRERR_NONE)
        gis_fail_where(source->dataset, source->layer, source->where_option, request->where,
                       gis_listener_reason(&listener, "not understood"), error);
    gis_listener_clear(&listener);
    return status == OGRERR_NONE;
}

static bool choose_crs(gis_source *source, const gis_source_request *request, gis_error *error)
{
    if (!request->input_crs) {
        OGRSpatialReferenceH own = OGR_L_GetSpatialRef(source->layer);
        source->crs = own ? OSRClone(own) : NULL;
        return true;
    }
    source->crs = OSRNewSpatialReference(NULL);
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    OGRErr status = source->crs ? OSRSetFromUserInput(source->crs, request->input_crs) : OGRERR_NOT_ENOUGH_MEMORY;
    gis_listen_end();
    gis_listener_clear(&listener);
    if (status != OGRERR_NONE)
        return gis_fail_usage(error, "--input-crs %s: not a coordinate reference system", request->input_crs);
    /* Coordinates are in the order x, y, whatever axis order the authority defines. */
    OSRSetAxisMappingStrategy(source->crs, OAMS_TRADITIONAL_GIS_ORDER);
    return true;
}

static bool fill_source(gis_source *source, const gis_source_request *request, gis_error *error)
{
    source->path = CPLStrdup(request->path);
    source->where_option = request->where_option ? request->where_option : "--where";
    if (!open_dataset(source, request, error)) return false;
    if (request->sql) {
        source->name = gis_path_stem(request->path);
        if (!run_statement(source, request, error)) return false;
    } else {
        source->layer = gis_choose_layer(source->dataset, request, error);
        if (!source->layer) return false;
        source->name = CPLStrdup(OGR_L_GetName(source->layer));
    }
    return gis_layer_fits(source->layer, source->name, request->takes, error) && choose_crs(source, request, error) &&
           select_features(source, request, error) && gis_source_begin_reading(source, request, error);
}

bool gis_source_open(const gis_source_request *request, gis_source **out, gis_error *error)
{
    gis_source *source = calloc(1, sizeof *source);
    if (!source) return gis_no_memory(error);
    if (!fill_source(source, request, error)) {
        gis_source_close(source);
        return false;
    }
    *out = source;
    return true;
}

static void clear_marks(gis_source_marks *marks)
{
    for (size_t k = 0; k < marks->n; k++) {
        CPLFree(marks->marked[k].where);
        free(marks->marked[k].range);
    }
    free(marks->marked);
    *marks = (gis_source_marks){0};
}

void gis_source_close(gis_source *source)
{
    if (!source) return;
    gis_source_drop_features(source);
    clear_marks(&source->marks);
    free(source->packed);
    free(source->held);
    free(source->contents);
    if (source->crs) OSRRelease(source->crs);
    if (source->is_result) GDALDatasetReleaseResultSet(source->dataset, source->layer);
    if (source->dataset) GDALClose(source->dataset);
    CPLFree(source->path);
    CPLFree(source->name);
    CPLFree(source->where);
    gis_sentences_clear(&source->warnings);
    free(source);
}

/* ---- Getters ----------------------------------------------------------------------------------------------------- */

const double *gis_source_extent(const gis_source *source) { return source->extent_known ? source->extent : NULL; }

const char *gis_source_name(const gis_source *source) { return source->name; }
const char *gis_source_path(const gis_source *source) { return source->path; }
GDALDatasetH gis_source_dataset(const gis_source *source) { return source->dataset; }
OGRLayerH gis_source_layer(const gis_source *source) { return source->layer; }
OGRwkbGeometryType gis_source_type(const gis_source *source) { return OGR_L_GetGeomType(source->layer); }
OGRSpatialReferenceH gis_source_crs(const gis_source *source) { return source->crs; }
bool gis_source_is_result(const gis_source *source) { return source->is_result; }
const char *gis_source_where(const gis_source *source) { return source->where; }

int gis_source_field(const gis_source *source, const char *name)
{
    return OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(source->layer), name);
}

const gis_sentences *gis_source_warnings(const gis_source *source) { return &source->warnings; }
