/* pushes.c: what presses on what in the result, and how hard, as lines between the anchors as they stand then. A
 * barrier has no anchor: of it the corner is taken that is nearest to the feature's. */
#include "layer/output.h"

#include "base/interrupt.h"

#include <math.h>
#include <string.h>

static void take_nearer(const double *xy, size_t n, const double at[2], double *square, double nearest[2])
{
    for (size_t k = 0; k < n; k++) {
        double dx = xy[2 * k] - at[0], dy = xy[2 * k + 1] - at[1], s = dx * dx + dy * dy;
        if (s >= *square) continue;
        *square = s;
        memcpy(nearest, xy + 2 * k, 2 * sizeof *xy);
    }
}

void gis_barrier_corner(const gis_barrier_feature *barrier, const double at[2], double nearest[2])
{
    double square = INFINITY;
    memcpy(nearest, at, 2 * sizeof *nearest);
    take_nearer(barrier->lines.xy, barrier->lines.points, at, &square, nearest);
    for (size_t p = 0; barrier->shape && p < sunder_shape_polygons(barrier->shape); p++)
        for (size_t r = 0; r < sunder_shape_rings(barrier->shape, p); r++) {
            size_t n;
            const double *xy = sunder_shape_ring(barrier->shape, p, r, &n);
            take_nearer(xy, n, at, &square, nearest);
        }
}

static void anchor_now(const gis_layer_input *input, const sunder_report *report, size_t feature, double at[2])
{
    double dx, dy;
    sunder_shape_anchor(input->shape[feature], at);
    sunder_report_move(report, feature, &dx, &dy);
    at[0] += dx;
    at[1] += dy;
}

void gis_things_push(const gis_things *things, const sunder_push *push, gis_value values[N_PUSH_COLUMNS])
{
    const gis_barrier_feature *barrier = gis_things_barrier(things, push->b);
    const gis_value none = {.kind = GIS_NULL};
    const gis_value row[N_PUSH_COLUMNS] = {
        gis_fid_as_value(things->fid(things->of, push->a)),
        barrier ? none : gis_fid_as_value(things->fid(things->of, push->b)),
        barrier ? (gis_value){GIS_TEXT, {.text = things->barriers->layer[barrier->request]}} : none,
        barrier ? gis_fid_as_value(barrier->fid) : none,
        {GIS_REAL, {.real = push->force}},
        {GIS_REAL, {.real = push->n[0]}},
        {GIS_REAL, {.real = push->n[1]}},
    };
    memcpy(values, row, sizeof row);
}

static bool write_push(gis_sink_layer *layer, const gis_layer_input *input, const sunder_report *report,
                       const sunder_push *push, gis_error *error)
{
    const gis_things things = gis_things_of(input);
    const gis_barrier_feature *barrier = gis_things_barrier(&things, push->b);
    double from[2], to[2];
    gis_value values[N_PUSH_COLUMNS];
    anchor_now(input, report, push->a, from);
    if (barrier)
        gis_barrier_corner(barrier, from, to);
    else
        anchor_now(input, report, push->b, to);
    gis_things_push(&things, push, values);
    return gis_line_row(layer, values, from, to, error);
}

bool gis_pushes_begin(gis_sink *sink, OGRSpatialReferenceH crs, gis_sink_layer **layer, gis_error *error)
{
    static const gis_field fields[N_PUSH_COLUMNS] = {{"fid_a", OFTInteger64, 0}, {"fid_b", OFTInteger64, 0},
                                                     {"barrier", OFTString, 0},  {"barr_fid", OFTInteger64, 0},
                                                     {"force", OFTReal, 0},      {"nx", OFTReal, 0},
                                                     {"ny", OFTReal, 0}};
    const gis_sink_layer_request request = {.suffix = "pushes",
                                            .type = wkbLineString,
                                            .crs = crs,
                                            .fields = fields,
                                            .n_fields = N_PUSH_COLUMNS,
                                            .style = GIS_STYLE_PUSHES};
    return gis_sink_add(sink, &request, layer, error);
}

bool gis_write_pushes(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    gis_sink_layer *layer;
    size_t n;
    const sunder_push *push = sunder_report_pushes(report, &n);
    if (!gis_pushes_begin(sink, gis_source_crs(input->source), &layer, error)) return false;
    for (size_t k = 0; k < n; k++)
        if (!gis_go_on(error) || !write_push(layer, input, report, &push[k], error)) return false;
    return true;
}
