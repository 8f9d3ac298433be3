/* result_view_held.c: see result.h. The view of a layer in memory with its report. */
#include "base/interrupt.h"
#include "geometry/gis_box.h"
#include "layer/levels.h"
#include "layer/output.h"
#include "layer/result_held.h"

#include <math.h>

static size_t points_of(const sunder_obstacle *geometry)
{
    return geometry->lines ? geometry->line_end[geometry->lines - 1] : 0;
}

gis_view_barrier gis_view_barrier_of(const sunder_obstacle *geometry, double width)
{
    const size_t points = points_of(geometry);
    gis_view_barrier out = {.width = width, .vertices = points, .area = geometry->shape != NULL};
    gis_box_clear(out.box);
    for (size_t i = 0; i < points; i++) {
        const double *at = geometry->xy + 2 * i;
        gis_box_join(out.box, (double[4]){at[0], at[1], at[0], at[1]});
    }
    if (geometry->shape && !sunder_shape_is_empty(geometry->shape)) {
        double of_shape[4];
        sunder_shape_box(geometry->shape, of_shape);
        gis_box_join(out.box, of_shape);
    }
    if (geometry->shape) out.vertices += sunder_shape_vertices(geometry->shape);
    for (int k = 0; k < 4; k++) out.box[k] += (k < 2 ? -0.5 : 0.5) * width;
    return out;
}

static bool fill_features(void *of, gis_view_feature *feature, gis_error *error)
{
    const gis_result *held = of;
    for (size_t i = 0; i < held->input->n; i++) {
        const sunder_shape *shape = held->input->shape[i];
        gis_view_feature *each = &feature[i];
        if (!gis_go_on(error)) return false;
        sunder_report_move(held->of, i, &each->move[0], &each->move[1]);
        each->status = (uint8_t)sunder_report_status(held->of, i);
        each->vertices = shape ? (uint32_t)sunder_shape_vertices(shape) : 0;
        if (!each->vertices) continue;
        sunder_shape_box(shape, each->box);
        each->changed = gis_levels_shape_now(held->input, held->of, i) != gis_layer_original(held->input, i);
    }
    return true;
}

static bool fill_barriers(void *of, gis_view_barrier *barrier, gis_error *error)
{
    const gis_barriers *barriers = &((const gis_result *)of)->input->barriers;
    (void)error;
    for (size_t k = 0; k < barriers->n; k++) {
        barrier[k] = gis_view_barrier_of(&barriers->barrier[k].geometry, barriers->barrier[k].width);
        barrier[k].place = k;
    }
    return true;
}

static bool list_conflicts(void *of, const sunder_conflict **conflict, size_t *n, gis_error *error)
{
    (void)error;
    *conflict = sunder_report_conflicts(((const gis_result *)of)->of, n);
    return true;
}

static bool list_hidden(void *of, gis_hidden_row **hidden, size_t *n, gis_error *error)
{
    const gis_result *held = of;
    return gis_hidden_list(held->input, held->of, hidden, n, error);
}

static bool list_rows(void *of, const sunder_row **row, size_t *n, gis_error *error)
{
    (void)error;
    *row = sunder_report_rows(((const gis_result *)of)->of, n);
    return true;
}

static bool feature_shape(void *of, size_t feature, uint64_t place, gis_view_shape which, const sunder_shape **out,
                          gis_error *error)
{
    const gis_result *held = of;
    (void)place, (void)error;
    *out = which == GIS_VIEW_READ    ? gis_layer_original(held->input, feature)
           : which == GIS_VIEW_FIRST ? held->input->shape[feature]
                                     : gis_levels_shape_now(held->input, held->of, feature);
    return true;
}

static bool barrier_geometry(void *of, uint64_t place, sunder_obstacle *out, gis_error *error)
{
    (void)error;
    *out = ((const gis_result *)of)->input->barriers.barrier[place].geometry;
    return true;
}

static bool feature_name(void *of, size_t feature, uint64_t place, GIntBig *fid, const char **id, gis_error *error)
{
    const gis_layer_input *input = gis_layer_own(((const gis_result *)of)->input, &feature);
    (void)place, (void)error;
    *fid = gis_source_fid(input->source, feature);
    *id = NULL;
    if (input->id_field < 0) return true;
    OGRFeatureH given = gis_source_feature(input->source, feature);
    if (OGR_F_IsFieldSetAndNotNull(given, input->id_field)) *id = OGR_F_GetFieldAsString(given, input->id_field);
    return true;
}

static bool barrier_name(void *of, size_t barrier, GIntBig *fid, const char **layer, gis_error *error)
{
    const gis_barriers *barriers = &((const gis_result *)of)->input->barriers;
    (void)error;
    *fid = barriers->feature[barrier].fid;
    *layer = barriers->layer[barriers->feature[barrier].request];
    return true;
}

static void close_nothing(void *of) { (void)of; }

bool gis_result_held_view(const gis_result *result, gis_result_view *out, gis_error *error)
{
    (void)error;
    *out = (gis_result_view){(void *)result,   result->input->n, result->input->barriers.n,
                             fill_features,    fill_barriers,    list_conflicts,
                             list_hidden,      list_rows,        feature_shape,
                             barrier_geometry, feature_name,     barrier_name,
                             close_nothing};
    return true;
}
