/* Builds the area that a body occupies: its union, grown by a polygon inside the disc whose radius is half the gap. The
 * occupied areas of two bodies that keep the gap are disjoint, since a place nearer than half the gap to both bodies
 * would make their distance less than the gap. A subset of the occupied area is a valid area for the bound as well. */
#include "displacement/layer/relate.h"
#include "displacement/prove/areas/areas.h"
#include "displacement/prove/areas/tuning.h"

#include "spatial/box.h"
#include "sum/to_shape.h"

#include <string.h>

/* Computes the area and the bounding box of the rings as they are. */
static void measure_outline(sunder_i_outline *o)
{
    sunder_i_box_clear(o->box);
    size_t from = 0;
    double twice = 0;
    for (size_t r = 0; r < o->rings; r++) {
        const double *first = o->xy + 2 * from;
        for (size_t k = from; k < o->ring_end[r]; k++) {
            const double *a = o->xy + 2 * k, *b = k + 1 < o->ring_end[r] ? a + 2 : first;
            twice += (a[0] - first[0]) * (b[1] - first[1]) - (b[0] - first[0]) * (a[1] - first[1]);
            sunder_i_box_include(o->box, a);
        }
        from = o->ring_end[r];
    }
    o->area = twice / 2;
}

static sunder_status take_rings(const sunder_shape *shape, sunder_i_outline *o, sunder_error *err)
{
    const size_t polygons = sunder_shape_polygons(shape);
    size_t rings = 0, corners = 0, n;
    for (size_t p = 0; p < polygons; p++)
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++, rings++) {
            sunder_shape_ring(shape, p, r, &n);
            corners += n;
        }
    o->xy = sunder_i_alloc(2 * corners, sizeof *o->xy);
    o->ring_end = sunder_i_alloc(rings, sizeof *o->ring_end);
    if (!o->xy || !o->ring_end) return sunder_i_failure_cause(err);
    corners = 0;
    for (size_t p = 0; p < polygons; p++)
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
            const double *xy = sunder_shape_ring(shape, p, r, &n);
            memcpy(o->xy + 2 * corners, xy, 2 * n * sizeof *xy);
            o->ring_end[o->rings++] = corners += n;
        }
    measure_outline(o);
    return SUNDER_OK;
}

/* Sets *out to the union of the members of `shape`, since members may overlap and their common area must count once.
 * The caller frees *out. */
static sunder_status unite_members(const sunder_shape *shape, sunder_shape **out, sunder_error *err)
{
    sunder_sum *sum = NULL;
    sunder_status status = sunder_shape_union(shape, NULL, &sum, err);
    if (!status) status = sunder_i_sum_to_shape(sum, false, SUNDER_VALIDITY_EVEN_ODD, out, err);
    sunder_sum_free(sum);
    return status;
}

/* Returns the least gap that a body has to keep from features. */
static double least_gap(const sunder_i_model *model, uint32_t body)
{
    const sunder_i_body *b = &model->body[body];
    double least = model->rules.gap;
    for (uint32_t m = 0; m < b->members && model->gaps; m++)
        least = sunder_i_min(least, model->gaps->part[sunder_i_class_of(model, model->member[b->member + m])]);
    return least;
}

sunder_status sunder_i_outline_make(const sunder_i_model *model, uint32_t body, sunder_i_outline *out,
                                    sunder_error *err)
{
    *out = (sunder_i_outline){0};
    const sunder_shape *shape = sunder_i_model_shape(model, body);
    if (!shape || sunder_shape_is_empty(shape)) return SUNDER_OK;
    sunder_shape *made = NULL;
    sunder_status status = SUNDER_OK;
    const double gap = least_gap(model, body);
    if (gap > 0)
        status = sunder_i_grow_by_tolerance(shape, gap / 2 * HALF_GAP, &made, err);
    else if (sunder_shape_polygons(shape) > 1)
        status = unite_members(shape, &made, err);
    if (!status) status = take_rings(made ? made : shape, out, err);
    sunder_shape_free(made);
    return status;
}

void sunder_i_outline_free(sunder_i_outline *outline)
{
    sunder_i_free_all(outline->xy, outline->ring_end);
    *outline = (sunder_i_outline){0};
}
