/* sets.c: which features are grown together, and the growing of one such set: joined as they stand, made by the core
 * exactly, rounded. What rounding moves is added up, never estimated. */
#include "buffer/buffer.h"

#include "base/core.h"
#include "layer/fields.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Sets -------------------------------------------------------------------------------------------------------- */

typedef struct dissolve_key {
    char *key; /* the value of the field as text; NULL: null */
    size_t feature, set;
} dissolve_key;

/* Nulls stand by themselves: each is a value of its own. */
static int by_key(const void *a, const void *b)
{
    const dissolve_key *ka = a, *kb = b;
    int order = !ka->key || !kb->key ? (ka->key != NULL) - (kb->key != NULL) : strcmp(ka->key, kb->key);
    return order ? order : (ka->feature > kb->feature) - (ka->feature < kb->feature);
}

static int by_first(const void *a, const void *b)
{
    const dissolve_key *ka = a, *kb = b;
    int order = (ka->set > kb->set) - (ka->set < kb->set);
    return order ? order : (ka->feature > kb->feature) - (ka->feature < kb->feature);
}

static bool same_set(const dissolve_key *a, const dissolve_key *b)
{
    return a->key && b->key && strcmp(a->key, b->key) == 0;
}

static bool read_keys(const gis_buffer *buffer, dissolve_key *keys, gis_error *error)
{
    for (size_t i = 0; i < buffer->input.n; i++) {
        OGRFeatureH feature = gis_source_feature(buffer->input.source, i);
        keys[i].feature = i;
        if (!OGR_F_IsFieldSetAndNotNull(feature, buffer->field)) continue;
        keys[i].key = gis_field_key(feature, buffer->field);
        if (!keys[i].key) return gis_no_memory(error);
    }
    return true;
}

/* Numbers a set by its first feature, then puts the features in the order of sets. */
static void sort_keys(dissolve_key *keys, size_t n)
{
    qsort(keys, n, sizeof *keys, by_key);
    for (size_t i = 0; i < n; i++)
        keys[i].set = i > 0 && same_set(&keys[i], &keys[i - 1]) ? keys[i - 1].set : keys[i].feature;
    qsort(keys, n, sizeof *keys, by_first);
}

/* Lists and bytes have no one text to compare. */
static bool has_single_values(const gis_buffer *buffer, gis_error *error)
{
    OGRFeatureDefnH layer = OGR_L_GetLayerDefn(gis_source_layer(buffer->input.source));
    OGRFieldDefnH field = OGR_FD_GetFieldDefn(layer, buffer->field);
    switch (OGR_Fld_GetType(field)) {
    case OFTInteger:
    case OFTInteger64:
    case OFTReal:
    case OFTString:
    case OFTDate:
    case OFTTime:
    case OFTDateTime: return true;
    default:
        return gis_fail(error,
                        "--dissolve-field: field %s is of type %s; numbers, texts, dates and times can be told "
                        "apart",
                        OGR_Fld_GetNameRef(field), OGR_GetFieldTypeName(OGR_Fld_GetType(field)));
    }
}

static bool gather_by_field(gis_buffer *buffer, gis_error *error)
{
    if (!has_single_values(buffer, error)) return false;
    size_t n = buffer->input.n;
    dissolve_key *keys = calloc(n + 1, sizeof *keys);
    if (!keys) return gis_no_memory(error);
    bool ok = read_keys(buffer, keys, error);
    if (ok) sort_keys(keys, n);
    for (size_t i = 0; ok && i < n; i++) {
        if (i == 0 || keys[i].set != keys[i - 1].set) buffer->set[buffer->sets++].member = buffer->member + i;
        buffer->set[buffer->sets - 1].members++;
        buffer->member[i] = keys[i].feature;
    }
    for (size_t i = 0; i < n; i++) free(keys[i].key);
    free(keys);
    return ok;
}

bool gis_buffer_gather(gis_buffer *buffer, gis_error *error)
{
    size_t n = buffer->input.n;
    buffer->set = calloc(n + 1, sizeof *buffer->set);
    buffer->member = calloc(n + 1, sizeof *buffer->member);
    if (!buffer->set || !buffer->member) return gis_no_memory(error);
    if (buffer->field >= 0) return gather_by_field(buffer, error);
    buffer->sets = buffer->request->dissolve ? 1 : n;
    for (size_t i = 0; i < n; i++) buffer->member[i] = i;
    for (size_t k = 0; k < buffer->sets; k++) {
        buffer->set[k].member = buffer->member + k;
        buffer->set[k].members = buffer->request->dissolve ? n : 1;
    }
    return true;
}

/* ---- One set ----------------------------------------------------------------------------------------------------- */

static bool has_shape(const gis_buffer *buffer, size_t feature) { return buffer->input.shape[feature] != NULL; }

/* Has it polygons, if only empty ones? */
static bool has_polygons(const gis_buffer *buffer, size_t feature)
{
    OGRGeometryH geometry = gis_source_geometry(buffer->input.source, feature);
    return has_shape(buffer, feature) || (geometry && OGR_G_IsEmpty(geometry));
}

/* What an invalid feature was repaired to, with its crossings rounded: one of them as rationals would make rationals of
 * a whole layer. *deviation is raised to what that moves. */
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

static bool append_member(const gis_buffer *buffer, size_t feature, gis_rings *rings, gis_polygons *all,
                          double *deviation, gis_error *error)
{
    const sunder_shape *shape = buffer->input.shape[feature];
    if (sunder_shape_repaired(shape)) return append_repaired(shape, all, deviation, error);
    return gis_geometry_rings(gis_source_geometry(buffer->input.source, feature), rings, error) &&
           gis_polygons_append_all(all, &rings->set, error);
}

bool gis_buffer_join(const gis_buffer *buffer, const gis_buffer_set *set, sunder_shape **out, double *deviation,
                     gis_error *error)
{
    gis_rings rings = {0};
    gis_polygons all = {0};
    bool ok = true;
    for (size_t i = 0; ok && i < set->members; i++)
        ok =
            !has_shape(buffer, set->member[i]) || append_member(buffer, set->member[i], &rings, &all, deviation, error);
    sunder_error why;
    if (ok && gis_polygons_shape(&all, SUNDER_VALIDITY_STRICT, out, &why) != SUNDER_OK)
        ok = gis_core_failed(error, NULL, &why);
    gis_rings_clear(&rings);
    gis_polygons_clear(&all);
    return ok;
}

static bool place(const sunder_sum *sum, const uint32_t *vertex, size_t n, double *xy, double *deviation,
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
        if (!place(sum, ends, 2, set->segment + 4 * i, &set->result.deviation, error)) return false;
    }
    for (size_t i = 0; i < set->points; i++) {
        uint32_t vertex = sunder_sum_point(sum, i);
        if (!place(sum, &vertex, 1, set->point + 2 * i, &set->result.deviation, error)) return false;
    }
    return true;
}

/* Twice the signed area of a ring, from its first vertex on, so that large coordinates cost no digits. */
static long double ring_area(const double *xy, size_t n)
{
    long double area = 0;
    for (size_t i = 1; i + 1 < n; i++) {
        const double *a = xy, *b = xy + 2 * i, *c = b + 2;
        area += ((long double)b[0] - a[0]) * ((long double)c[1] - a[1]) -
                ((long double)b[1] - a[1]) * ((long double)c[0] - a[0]);
    }
    return area;
}

/* Outer rings less holes, whichever way they run. */
double gis_buffer_area(const gis_polygons *set)
{
    long double area = 0;
    for (size_t p = 0, r = 0; p < set->polygons; p++)
        for (size_t first = r; r < set->poly_end[p]; r++) {
            size_t from = r ? set->ring_end[r - 1] : 0;
            long double one = fabsl(ring_area(set->xy + 2 * from, set->ring_end[r] - from));
            area += r == first ? one : -one;
        }
    return (double)(area / 2);
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
    if (ok) set->area = gis_buffer_area(&set->result.set);
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

void gis_buffer_clear(gis_buffer *buffer)
{
    for (size_t k = 0; k < buffer->sets; k++) gis_buffer_set_clear(&buffer->set[k]);
    free(buffer->set);
    free(buffer->member);
    sunder_shape_free(buffer->shape);
    gis_source_close(buffer->shape_source);
    gis_layer_input_clear(&buffer->input);
}
