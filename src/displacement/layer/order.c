/* The order in which features are worked on, which is no matter of how the caller lists them: by where they lie,
 * then by their corners, then by what is asked of them. All that follows breaks ties by number (of bodies, of
 * pieces, of pairs), so the same features in another order get the same moves; only twins that are alike in
 * everything are told apart by their places in the list, and may change roles. Numbers go up with y, whatever else
 * the layer holds: a feature far away changes the order of no two others. In the end the report speaks of features
 * as the caller numbered them (report/renumber.c). */
#include "displacement/layer/barriers.h"

#include "shape/shape.h"

#include <math.h>
#include <stdlib.h>

typedef struct ranked {
    double box[4];
    const sunder_shape *shape;
    const sunder_feature *demands;
    uint32_t number;
} ranked;

static int by_double(double a, double b) { return a < b ? -1 : a > b; }

static int by_shape(const sunder_shape *a, const sunder_shape *b)
{
    if (a == b || !a || !b) return !a - !b;
    if (a->vertices != b->vertices) return a->vertices < b->vertices ? -1 : 1;
    int order = 0;
    for (size_t k = 0; k < 2 * (size_t)a->vertices && order == 0; k++) order = by_double(a->xy[k], b->xy[k]);
    return order;
}

static int by_demands(const sunder_feature *a, const sunder_feature *b)
{
    int order = by_double(a->weight, b->weight);
    if (order == 0) order = by_double(a->max_shift, b->max_shift);
    if (order == 0) order = a->fixed - b->fixed;
    if (order == 0) order = a->ignored - b->ignored;
    return order ? order : a->block < b->block ? -1 : a->block > b->block;
}

static int by_place(const void *x, const void *y)
{
    static const int side[4] = {1, 0, 3, 2};
    const ranked *a = x, *b = y;
    int order = 0;
    for (int c = 0; c < 4 && order == 0; c++) order = by_double(a->box[side[c]], b->box[side[c]]);
    if (order == 0) order = by_shape(a->shape, b->shape);
    if (order == 0) order = by_demands(a->demands, b->demands);
    return order ? order : a->number < b->number ? -1 : a->number > b->number;
}

/* Parts of barriers behind the features, in the order of the barriers. */
static void append_parts(const sunder_i_barriers *barriers, sunder_layer *out)
{
    for (uint32_t k = 0; k < barriers->parts; k++) {
        out->part[k] =
            (sunder_feature){.shape = barriers->shape[k], .weight = 1, .max_shift = 0, .block = -1, .fixed = true};
        out->number[out->n + k] = (uint32_t)out->n + barriers->barrier[k];
    }
}

void sunder_i_ordered_clear(sunder_layer *ordered)
{
    sunder_i_free(ordered->number);
    sunder_i_free(ordered->part);
    *ordered = (sunder_layer){0};
}

sunder_status sunder_i_order_layer(const sunder_layer *layer, const sunder_i_barriers *barriers, bool as_given,
                                   sunder_layer *out, sunder_error *err)
{
    const size_t n = layer->n;
    ranked *list = sunder_i_alloc(n, sizeof *list);
    *out = (sunder_layer){.n = n, .barrier = layer->barrier, .barriers = layer->barriers, .given = layer};
    out->part = sunder_i_alloc(barriers->parts, sizeof *out->part);
    out->number = sunder_i_alloc(n + barriers->parts, sizeof *out->number);
    const bool ok = list && out->part && out->number;
    for (size_t k = 0; ok && k < n; k++) {
        const sunder_feature feature = sunder_i_given_feature(layer, k);
        list[k] =
            (ranked){{INFINITY, INFINITY, INFINITY, INFINITY}, feature.shape, sunder_i_demands(layer, k), (uint32_t)k};
        if (sunder_i_is_present(&feature)) sunder_shape_box(feature.shape, list[k].box);
    }
    if (ok && n && !as_given) qsort(list, n, sizeof *list, by_place);
    for (size_t k = 0; ok && k < n; k++) out->number[k] = list[k].number;
    if (ok) append_parts(barriers, out);
    sunder_i_free(list);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}
