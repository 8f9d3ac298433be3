/* make_set.c: dilates or erodes one set of features. Its members are joined as they are, the core computes the result
 * exactly, and the result is then rounded. The deviations by rounding are computed and added up, never estimated. */
#include "buffer/buffer.h"

#include "base/core_error.h"

#include <math.h>
#include <stdlib.h>

static bool has_shape(const gis_buffer *buffer, size_t feature) { return buffer->input.shape[feature] != NULL; }

/* Returns whether the feature has polygons or an empty geometry. */
static bool has_polygons(const gis_buffer *buffer, size_t feature)
{
    OGRGeometryH geometry = gis_source_geometry(buffer->input.source, feature);
    return has_shape(buffer, feature) || (geometry && OGR_G_IsEmpty(geometry));
}

/* Appends a repaired feature to `all`, with the crossings of its rings rounded to doubles: a single rational vertex
 * would make all coordinates of the joined shape rational. *deviation is raised to the largest distance by which a
 * vertex moved. */
static bool append_repaired(const sunder_shape *shape, gis_polygons *all, double *deviation, gis_error *error)
{
    sunder_sum *sum;
    sunder_error why;
    gis_rounded rounded = {0};
    if (sunder_shape_union(shape, NULL, &sum, &why) != SUNDER_OK) return gis_core_failed(error, NULL, &why);
    bool ok = gis_round_sum(sum, &rounded, error) && gis_polygons_append_all(all, &rounded.set, error);
    *deviation = fmax(*deviation, rounded.deviation);
    gis_rounded_clear(&rounded);
    sunder_sum_free(sum);
    return ok;
}

static bool append_member(const gis_buffer *buffer, size_t feature, gis_polygonal_part *part, gis_polygons *all,
                          double *deviation, gis_error *error)
{
    const sunder_shape *shape = buffer->input.shape[feature];
    if (sunder_shape_repaired(shape)) return append_repaired(shape, all, deviation, error);
    return gis_geometry_polygonal_part(gis_source_geometry(buffer->input.source, feature), part, error) &&
           gis_polygons_append_all(all, &part->set, error);
}

bool gis_buffer_join(const gis_buffer *buffer, const gis_buffer_set *set, sunder_shape **out, double *deviation,
                     gis_error *error)
{
    gis_polygonal_part part = {0};
    gis_polygons all = {0};
    bool ok = true;
    for (size_t i = 0; ok && i < set->members; i++)
        ok = !has_shape(buffer, set->member[i]) || append_member(buffer, set->member[i], &part, &all, deviation, error);
    sunder_error why;
    if (ok && gis_polygons_shape(&all, SUNDER_VALIDITY_STRICT, out, &why) != SUNDER_OK)
        ok = gis_core_failed(error, NULL, &why);
    gis_polygonal_part_clear(&part);
    gis_polygons_clear(&all);
    return ok;
}

/* Converts n vertices of the sum to doubles in xy[2 * n]; raises *deviation to their largest error. Fails if a
 * coordinate exceeds the range of doubles. */
static bool to_doubles(const sunder_sum *sum, const uint32_t *vertex, size_t n, double *xy, double *deviation,
                       gis_error *error)
{
    sunder_error why;
    if (sunder_sum_vertices(sum, vertex, n, xy, deviation, &why) != SUNDER_OK)
        return gis_core_failed(error, NULL, &why);
    return isfinite(*deviation) || gis_fail(error, "the result leaves the range of doubles");
}

static bool keep_degenerate(const sunder_sum *sum, gis_buffer_set *set, gis_error *error)
{
    sunder_sum_size size;
    sunder_sum_get_size(sum, &size);
    set->segment = malloc((size.degenerate_segments + 1) * 4 * sizeof *set->segment);
    set->point = malloc((size.degenerate_points + 1) * 2 * sizeof *set->point);
    if (!set->segment || !set->point) return gis_no_memory(error);
    set->segments = size.degenerate_segments;
    set->points = size.degenerate_points;
    for (size_t i = 0; i < set->segments; i++) {
        uint32_t ends[2];
        sunder_sum_segment(sum, i, ends);
        if (!to_doubles(sum, ends, 2, set->segment + 4 * i, &set->result.deviation, error)) return false;
    }
    for (size_t i = 0; i < set->points; i++) {
        uint32_t vertex = sunder_sum_point(sum, i);
        if (!to_doubles(sum, &vertex, 1, set->point + 2 * i, &set->result.deviation, error)) return false;
    }
    return true;
}

static bool make_from(const gis_buffer *buffer, gis_buffer_set *set, const sunder_shape *p, const sunder_shape *b,
                      const sunder_sum_options *how, gis_error *error)
{
    sunder_sum *sum;
    sunder_error why;
    sunder_status status = sunder_morphology(p, b, buffer->request->operation, how, &sum, &why);
    if (status != SUNDER_OK) return gis_core_failed(error, NULL, &why);
    bool ok = gis_round_sum(sum, &set->result, error) &&
              (!buffer->request->align || gis_straighten(&set->result, error)) &&
              (!buffer->request->degenerate || keep_degenerate(sum, set, error));
    sunder_sum_free(sum);
    if (ok) set->area = gis_polygons_area(&set->result.set);
    return ok;
}

bool gis_buffer_make_set(const gis_buffer *buffer, gis_buffer_set *set, const sunder_sum_options *how, gis_error *error)
{
    sunder_shape *joined = NULL, *turned = NULL;
    set->none = true;
    size_t shapes = 0;
    for (size_t i = 0; i < set->members; i++) {
        shapes += has_shape(buffer, set->member[i]);
        set->none = set->none && !has_polygons(buffer, set->member[i]);
    }
    if (shapes == 0) return true;
    double before = 0;
    bool ok = (!buffer->request->dissolve || gis_buffer_join(buffer, set, &joined, &before, error)) &&
              (!buffer->request->align || gis_buffer_turned(buffer, set, &turned, error)) &&
              make_from(buffer, set, joined ? joined : buffer->input.shape[set->member[0]],
                        turned ? turned : buffer->shape, how, error);
    set->result.deviation += before;
    sunder_shape_free(joined);
    sunder_shape_free(turned);
    return ok;
}

void gis_buffer_set_clear(gis_buffer_set *set)
{
    gis_rounded_clear(&set->result);
    free(set->segment);
    free(set->point);
    set->segment = set->point = NULL;
}
