/* links_read.c: reads the links. Each line, also as part of a geometry, is a link from its first vertex to its last. A
 * line of length 0 is a link that keeps its place. */
#include "layer/links/links.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/message.h"
#include "layer/barriers/barrier.h"
#include "read/source_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct reading {
    gis_links *out;
    OGRCoordinateTransformationH to_layer; /* NULL: none */
    const char *path;
    GIntBig fid;
    size_t other; /* features without a line */
} reading;

static bool take_link(reading *r, OGRGeometryH first, OGRGeometryH last, gis_error *error)
{
    gis_links *out = r->out;
    const int n = OGR_G_GetPointCount(last);
    double x[2] = {OGR_G_GetX(first, 0), OGR_G_GetX(last, n - 1)},
           y[2] = {OGR_G_GetY(first, 0), OGR_G_GetY(last, n - 1)};
    if (r->to_layer && !OCTTransform(r->to_layer, 2, x, y, NULL))
        return gis_fail(error, "--links %s: FID %lld cannot be transformed to the CRS of the layer", r->path,
                        (long long)r->fid);
    if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(y[0]) || !isfinite(y[1]))
        return gis_fail(error, "--links %s: FID %lld has no finite coordinates in the CRS of the layer", r->path,
                        (long long)r->fid);
    if (!gis_array_reserve(&out->link, &out->capacity, out->n + 1, sizeof *out->link)) return gis_no_memory(error);
    out->link[out->n++] = (gis_link){.from = {x[0], y[0]}, .move = {x[1] - x[0], y[1] - y[0]}, .fid = r->fid};
    return true;
}

/* The first or the last curve of a compound curve. */
static OGRGeometryH end_of(OGRGeometryH line, bool last)
{
    while (OGR_G_GetGeometryCount(line) > 0)
        line = OGR_G_GetGeometryRef(line, last ? OGR_G_GetGeometryCount(line) - 1 : 0);
    return line;
}

static bool take_lines(reading *r, OGRGeometryH geometry, gis_error *error)
{
    if (!geometry || OGR_G_IsEmpty(geometry)) return true;
    if (OGR_GT_IsSubClassOf(wkbFlatten(OGR_G_GetGeometryType(geometry)), wkbCurve))
        return take_link(r, end_of(geometry, false), end_of(geometry, true), error);
    bool ok = true;
    for (int k = 0; ok && k < OGR_G_GetGeometryCount(geometry); k++)
        if (OGR_G_GetDimension(geometry) != 2) ok = take_lines(r, OGR_G_GetGeometryRef(geometry, k), error);
    return ok;
}

static bool take_features(reading *r, gis_source *source, gis_error *error)
{
    for (size_t i = 0; i < gis_source_count(source); i++) {
        const size_t links = r->out->n;
        r->fid = gis_source_fid(source, i);
        if (!gis_go_on(error) || !take_lines(r, gis_source_geometry(source, i), error)) return false;
        r->other += r->out->n == links;
    }
    if (r->out->n == 0)
        gis_say_warning(GIS_MESSAGE_PASSED_BY, "--links %s: it has no lines, so nothing prefers another place",
                        r->path);
    else if (r->other)
        gis_say_warning(GIS_MESSAGE_PASSED_BY, "--links %s: %zu features have no line", r->path, r->other);
    return true;
}

bool gis_links_read(const gis_links_request *request, const gis_links_surroundings *around, gis_links *out,
                    gis_error *error)
{
    const gis_source_request from = {.path = request->dataset,
                                     .layer = request->layer,
                                     .takes = GIS_TAKES_LINES,
                                     .layer_option = "--links DATASET,layer=NAME"};
    gis_source *source = NULL;
    *out = (gis_links){.radius = INFINITY};
    reading r = {.out = out, .path = request->dataset};
    char who[256];
    snprintf(who, sizeof who, "--links %s", request->dataset);
    bool ok =
        gis_optional_length_in_layer_units(&request->radius, around->units, "--links-radius", &out->radius, error) &&
        (out->radius > 0 || gis_fail_usage(error, "--links-radius %s: must be above 0", request->radius.text)) &&
        gis_source_open(&from, &source, error) &&
        (!around->output || gis_source_spare(source, around->output, around->update, error)) &&
        gis_barrier_transformation(gis_source_crs(source), around->crs, who, &r.to_layer, error);
    if (ok) gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(source));
    ok = ok && take_features(&r, source, error) && gis_links_begin(out, request->dataset, error);
    if (r.to_layer) OCTDestroyCoordinateTransformation(r.to_layer);
    gis_source_close(source);
    return ok;
}
