/* barrier_read.c: reads the features of barrier layers one by one: polygons as shapes, or as rings (as=boundary); lines
 * and points as they are; arcs as chords; each with its width.
 *
 * Only barriers within reach are read: those farther from all features than the longest move plus the distance to be
 * kept are in the way of nothing. A source with an index is asked for the features in the box around all of that; if
 * widths come from a field, the field is read first to find the largest. Without an index GDAL would compare geometries
 * with the box and skip some that are invalid, so such a source is asked for all features. A feature that is near no
 * feature of the layer is dropped when it is read, or after its coordinates were transformed; of lines each segment is
 * tested. If some feature may move without limit, all barriers are within reach. */
#include "layer/barriers/barrier.h"

#include "base/array.h"
#include "base/core_error.h"
#include "base/interrupt.h"
#include "base/message.h"
#include "geometry/geometry.h"
#include "read/fields.h"
#include "read/source_files.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reading {
    const gis_barrier_request *request;
    const gis_barrier_surroundings *around;
    gis_source *source;
    OGRCoordinateTransformationH to_layer; /* NULL: coordinates are not transformed */
    double least;                           /* the distance to be kept at least; negative: likewise */
    double width, distance;                /* the common width (if there is no width field), and the distance to be kept
                                            * from its edge */
    double widest;                         /* the largest width of any feature */
    int width_field;
    gis_polygonal_part part;
    size_t batch; /* largest number of the source's features held at once; 0: all */
    gis_barrier_take *take;
    void *user;
    gis_barrier_common *common;
} reading;

static void name_feature(const reading *r, size_t i, char *who, size_t size)
{
    GIntBig fid = gis_source_fid(r->source, i);
    char within[GIS_WHO_SIZE];
    snprintf(within, sizeof within, "barrier %s", r->request->dataset);
    const gis_subject subject = {within, gis_source_name(r->source), fid != OGRNullFID, fid, i, NULL};
    gis_name_subject(&subject, who, size);
}

/* ---- Reach ------------------------------------------------------------------------------------------------------- */

/* A geometry with a coordinate that is not finite may be anywhere: GDAL leaves such a coordinate out of the box. */
static bool is_within_reach(const reading *r, OGRGeometryH geometry, double width)
{
    OGREnvelope e;
    OGR_G_GetEnvelope(geometry, &e);
    return gis_barrier_is_near(r->around, (double[4]){e.MinX, e.MinY, e.MaxX, e.MaxY}, width / 2 + r->distance) ||
           !gis_geometry_is_finite(geometry);
}

/* Is a segment of its lines, or a point, within reach? */
static bool any_is_within_reach(const reading *r, const gis_barrier_feature *feature)
{
    const gis_lines *lines = &feature->lines;
    for (size_t i = 0, k = 0; i < lines->lines; k = lines->end[i++])
        for (size_t first = k; k < lines->end[i]; k++) {
            const double *p = lines->xy + 2 * k, *q = k > first ? p - 2 : p;
            const double box[4] = {fmin(p[0], q[0]), fmin(p[1], q[1]), fmax(p[0], q[0]), fmax(p[1], q[1])};
            if (gis_barrier_is_near(r->around, box, feature->width / 2 + r->distance)) return true;
        }
    return false;
}

/* ---- One feature ------------------------------------------------------------------------------------------------- */

/* Reads the width of feature i. Null, and values that are not positive, give the common width. */
static bool read_width(const reading *r, size_t i, const char *who, double *width, gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(r->source, i);
    *width = r->width;
    if (r->width_field < 0 || gis_field_is_blank(feature, r->width_field)) return true;
    char held[GIS_FIELD_TEXT_SIZE];
    gis_length length = {gis_field_number(feature, r->width_field), GIS_LAYER_UNIT};
    bool is_text = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, r->width_field)) == OFTString;
    gis_field_text(feature, r->width_field, held);
    if (isinf(length.value) || (is_text && isnan(length.value)))
        return gis_fail(error, "%s: the width in %s is %s; it must be a finite number", who, r->request->width_field,
                        held);
    return !(length.value > 0) || gis_length_in_layer_units(&length, r->around->units, who, width, error);
}

/* Sets *out to the geometry in the layer's CRS, arcs as chords: a new geometry, or the source's own if there is no
 * transformation. */
static bool in_layer_crs(const reading *r, OGRGeometryH geometry, const char *who, OGRGeometryH *out, gis_error *error)
{
    *out = geometry;
    if (!r->to_layer) return true;
    bool curved = OGR_G_HasCurveGeometry(geometry, TRUE);
    if (curved) gis_say_warning(GIS_MESSAGE_ARCS, "%s: its arcs are taken as polylines", who);
    OGRGeometryH copy = curved ? OGR_G_GetLinearGeometry(geometry, 0, NULL) : OGR_G_Clone(geometry);
    if (!copy) return gis_no_memory(error);
    OGR_G_FlattenTo2D(copy);
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    bool ok = OGR_G_Transform(copy, r->to_layer) == OGRERR_NONE && gis_geometry_is_finite(copy);
    gis_listen_end();
    if (ok)
        *out = copy;
    else {
        OGR_G_DestroyGeometry(copy);
        gis_fail(error, "%s: cannot be transformed to the layer's CRS: %s", who,
                 gis_listener_reason(&listener, "a transformed coordinate is not finite"));
    }
    gis_listener_clear(&listener);
    return ok;
}

/* Takes polygons as a shape or as rings, and lines and points. */
static bool take_geometry(reading *r, OGRGeometryH geometry, const char *who, gis_barrier_feature *out,
                          gis_error *error)
{
    bool arcs = false, invalid;
    if (!gis_lines_append(geometry, &out->lines, &arcs, error)) return false;
    if (r->request->as_boundary) {
        if (!gis_lines_append_rings(geometry, &out->lines, &arcs, error)) return false;
    } else {
        if (!gis_geometry_polygonal_part(geometry, &r->part, error)) return false;
        arcs = arcs || r->part.linearised > 0;
        if (r->part.set.polygons &&
            !gis_shape_of_feature(&r->part.set, r->around->invalid, who, "invalid: ", &out->shape, &invalid, error))
            return false;
    }
    if (arcs) gis_say_warning(GIS_MESSAGE_ARCS, "%s: its arcs are taken as polylines", who);
    return true;
}

void gis_barrier_feature_clear(gis_barrier_feature *feature)
{
    sunder_shape_free(feature->shape);
    gis_lines_clear(&feature->lines);
}

static bool take_feature(reading *r, size_t i, gis_error *error)
{
    char who[GIS_WHO_SIZE];
    OGRGeometryH own = gis_source_geometry(r->source, i), geometry;
    gis_barrier_feature feature = {.fid = gis_source_fid(r->source, i)};
    if (gis_source_content(r->source, i) == GIS_NOTHING) return true;
    name_feature(r, i, who, sizeof who);
    if (!read_width(r, i, who, &feature.width, error) || !in_layer_crs(r, own, who, &geometry, error)) return false;
    const bool near = is_within_reach(r, geometry, feature.width);
    bool ok = !near || take_geometry(r, geometry, who, &feature, error);
    if (geometry != own) OGR_G_DestroyGeometry(geometry);
    if (ok && (feature.shape || any_is_within_reach(r, &feature))) return r->take(r->user, r->common, &feature, error);
    gis_barrier_feature_clear(&feature);
    return ok && gis_barrier_targets_sound(r->around->targets, error);
}

/* ---- One layer --------------------------------------------------------------------------------------------------- */

/* The filter box for the source, in its CRS. False: all features are read. */
static bool filter_box(void *user, OGRLayerH layer, OGRSpatialReferenceH crs, double box[4])
{
    reading *r = user;
    const char *field = r->request->width_field;
    double here[4];
    gis_error ignored;
    r->widest = field ? INFINITY : r->width;
    if (!isfinite(r->around->reach) || r->around->without_box) return false; /* all features are read */
    gis_length widest = {0, GIS_LAYER_UNIT};
    if (field &&
        (!gis_barrier_greatest(layer, field, &widest.value) ||
         (widest.value > 0 && !gis_length_in_layer_units(&widest, r->around->units, field, &r->widest, &ignored))))
        return false;
    if (field && !(widest.value > 0)) r->widest = 0;
    if (!OGR_L_TestCapability(layer, OLCFastSpatialFilter) ||
        !gis_barrier_reach_box(r->around, r->widest / 2 + r->distance, box))
        return false;
    if (gis_crs_may_be_same(crs, r->around->crs)) return true;
    if (!gis_barrier_box(box, r->around->crs, crs, here)) return false;
    memcpy(box, here, sizeof here);
    return true;
}

/* Keep the feature when it is read? In another CRS that can only be decided later. */
static bool wants_feature(void *user, OGRSpatialReferenceH crs, OGRFeatureH feature)
{
    const reading *r = user;
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    return geometry && (!gis_crs_may_be_same(crs, r->around->crs) || is_within_reach(r, geometry, r->widest));
}

static bool open_source(reading *r, gis_error *error)
{
    const gis_barrier_request *request = r->request;
    const gis_source_request source = {
        .path = request->dataset,
        .layer = request->layer,
        .where = request->where,
        .takes = GIS_TAKES_POLYGONS | GIS_TAKES_LINES | GIS_TAKES_POINTS,
        .layer_option = "layer=",
        .where_option = "where=",
        .within = filter_box,
        .wants = wants_feature,
        .user = r,
        .batch = r->batch,
        .not_finite = gis_invalid_not_finite(r->around->invalid, GIS_NOT_FINITE_LEFT_OUT),
    };
    gis_error why;
    if (!gis_source_open(&source, &r->source, &why)) {
        size_t n = strlen(request->dataset);
        bool named = strncmp(why.message, request->dataset, n) == 0;
        gis_fail(error, "--barrier %s%s%s", named ? "" : request->dataset, named ? "" : ": ", why.message);
        error->exit_status = why.exit_status;
        error->no_memory = why.no_memory;
        error->in_a_box = why.in_a_box;
        return false;
    }
    if (!r->batch) gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(r->source));
    return true;
}

static bool read_lengths(reading *r, gis_error *error)
{
    const gis_barrier_surroundings *around = r->around;
    char who[GIS_WHO_SIZE];
    snprintf(who, sizeof who, "--barrier %s", r->request->dataset);
    r->distance = around->gap;
    r->least = around->least_gap;
    if (!gis_optional_length_in_layer_units(&r->request->width, around->units, who, &r->width, error) ||
        !gis_optional_length_in_layer_units(&r->request->gap, around->units, who, &r->distance, error) ||
        !gis_optional_length_in_layer_units(&r->request->least, around->units, who, &r->least, error))
        return false;
    if (r->request->least.text && r->least > r->distance)
        return gis_fail_usage(error, "%s: least=%s: must not be greater than the gap, %.15g", who,
                              r->request->least.text, r->distance);
    r->least = fmin(r->least, r->distance);
    return true;
}

static bool read_features(reading *r, gis_error *error)
{
    char who[GIS_WHO_SIZE], field[GIS_WHO_SIZE];
    bool ok = true;
    snprintf(who, sizeof who, "barrier %s, layer %s", r->request->dataset, gis_source_name(r->source));
    snprintf(field, sizeof field, "--barrier %s: width-field=", r->request->dataset);
    if (r->around->output && !gis_source_spare(r->source, r->around->output, r->around->update, error)) return false;
    if (!gis_field_find_numbers(r->source, field, r->request->width_field, &r->width_field, error) ||
        !gis_barrier_transformation(gis_source_crs(r->source), r->around->crs, who, &r->to_layer, error))
        return false;
    for (bool any = true; ok && any;) {
        for (size_t i = 0; ok && i < gis_source_count(r->source); i++)
            ok = gis_go_on(error) && take_feature(r, i, error);
        any = r->batch > 0;
        if (ok && any) ok = gis_source_next(r->source, &any, error);
    }
    if (ok && r->batch) gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(r->source));
    return ok;
}

bool gis_barrier_visit(const gis_barrier_request *request, const gis_barrier_surroundings *around, size_t batch,
                       gis_barrier_take *take, void *user, gis_barrier_common *common, gis_error *error)
{
    reading r = {.request = request,
                 .around = around,
                 .width_field = -1,
                 .batch = batch,
                 .take = take,
                 .user = user,
                 .common = common};
    *common = (gis_barrier_common){0};
    bool ok = read_lengths(&r, error) && open_source(&r, error);
    common->distance = r.distance;
    common->least = r.least;
    if (ok) common->layer = CPLStrdup(gis_source_name(r.source));
    ok = ok && read_features(&r, error);
    if (r.to_layer) OCTDestroyCoordinateTransformation(r.to_layer);
    gis_polygonal_part_clear(&r.part);
    gis_source_close(r.source);
    return ok;
}

/* ---- All of them ------------------------------------------------------------------------------------------------- */

sunder_barrier gis_barrier_demands(const gis_barrier_feature *f, const gis_barrier_request *request,
                                   const gis_barrier_common *common)
{
    const bool own = request->gap.text || request->least.text, least = common->least >= 0;
    return (sunder_barrier){
        .geometry = {f->shape, f->lines.xy, f->lines.end, f->lines.lines},
        .width = f->width,
        .gap = !own ? -1 : least ? common->least : common->distance,
        .full_gap = own && least ? common->distance : 0,
        .side = request->side,
    };
}

static bool make_barriers(const gis_barrier_request *requests, const gis_barrier_common *common, gis_barriers *out,
                          gis_error *error)
{
    out->barrier = calloc(out->n + 1, sizeof *out->barrier);
    if (!out->barrier) return gis_no_memory(error);
    for (size_t k = 0; k < out->n; k++) {
        const gis_barrier_feature *f = &out->feature[k];
        out->barrier[k] = gis_barrier_demands(f, &requests[f->request], &common[f->request]);
    }
    return true;
}

static bool append_feature(void *user, const gis_barrier_common *common, gis_barrier_feature *feature, gis_error *error)
{
    gis_barriers *out = user;
    (void)common;
    if (!gis_array_reserve(&out->feature, &out->capacity, out->n + 1, sizeof *feature)) {
        gis_barrier_feature_clear(feature);
        return gis_no_memory(error);
    }
    feature->request = out->requests;
    out->feature[out->n++] = *feature;
    return true;
}

static bool read_all(const gis_barrier_request *requests, size_t n, const gis_barrier_surroundings *around,
                     gis_barriers *out, gis_error *error)
{
    gis_barrier_common *common = calloc(n + 1, sizeof *common);
    *out = (gis_barriers){.layer = calloc(n + 1, sizeof *out->layer)};
    bool ok = (common && out->layer) || gis_no_memory(error);
    for (size_t k = 0; ok && k < n; k++) {
        ok = gis_barrier_visit(&requests[k], around, 0, append_feature, out, &common[k], error);
        out->layer[k] = common[k].layer;
        out->requests++;
    }
    ok = ok && make_barriers(requests, common, out, error);
    free(common);
    return ok;
}

bool gis_barriers_read(const gis_barrier_request *requests, size_t n, const gis_barrier_surroundings *around,
                       gis_barriers *out, gis_error *error)
{
    if (read_all(requests, n, around, out, error)) return true;
    if (!error->in_a_box) return false;
    gis_barrier_surroundings all = *around;
    all.without_box = true;
    gis_barriers_clear(out);
    return read_all(requests, n, &all, out, error);
}

void gis_barriers_clear(gis_barriers *barriers)
{
    for (size_t k = 0; k < barriers->n; k++) gis_barrier_feature_clear(&barriers->feature[k]);
    for (size_t k = 0; barriers->layer && k < barriers->requests; k++) CPLFree(barriers->layer[k]);
    free(barriers->layer);
    free(barriers->feature);
    free(barriers->barrier);
    *barriers = (gis_barriers){0};
}
