/* The layer as the caller gives it: its features, with valid weights and limits, and its barriers. */
#include "displacement/layer/layer.h"

#include "base/memory.h"
#include "separation/separation.h"

#include <math.h>
#include <string.h>

static bool are_alike(const sunder_feature *f, const sunder_feature *g)
{
    return f->weight == g->weight && f->max_shift == g->max_shift && f->block == g->block && f->fixed == g->fixed &&
           f->ignored == g->ignored && f->joins_none == g->joins_none && f->may_jump == g->may_jump &&
           f->in_no_row == g->in_no_row;
}

/* Returns the number of runs of consecutive features with equal demands. */
static size_t count_demands(const sunder_feature *feature, size_t n)
{
    size_t demands = 1;
    for (size_t i = 1; i < n; i++) demands += !are_alike(&feature[i], &feature[i - 1]);
    return demands;
}

/* Stores shapes and demands of the features. Returns false if memory is out. */
static bool take_features(sunder_layer *layer, const sunder_feature *feature, size_t n)
{
    const size_t demands = count_demands(feature, n);
    layer->n = n;
    layer->shape = sunder_i_alloc(n, sizeof *layer->shape);
    layer->demands = sunder_i_alloc(demands, sizeof *layer->demands);
    if (demands > 1) layer->demand = sunder_i_alloc(n, sizeof *layer->demand);
    if (!layer->shape || !layer->demands || (demands > 1 && !layer->demand)) return false;
    uint32_t at = 0;
    for (size_t i = 0; i < n; i++) {
        if (i && !are_alike(&feature[i], &feature[i - 1])) at++;
        layer->shape[i] = feature[i].shape;
        layer->demands[at] = feature[i];
        layer->demands[at].shape = NULL;
        if (layer->demand) layer->demand[i] = at;
    }
    return true;
}

sunder_status sunder_layer_new(const sunder_feature *features, size_t n, sunder_layer **out, sunder_error *err)
{
    if (n >= SUNDER_I_NOBODY) return sunder_i_fail(err, SUNDER_EARG, "too many features: %zu", n);
    for (size_t i = 0; i < n; i++) {
        const sunder_feature *f = &features[i];
        if (!(f->weight >= SUNDER_LEAST_WEIGHT && f->weight <= SUNDER_GREATEST_WEIGHT))
            return sunder_i_fail(err, SUNDER_EARG, "feature %zu: the weight %g is not a number from %g to %g", i,
                                 f->weight, SUNDER_LEAST_WEIGHT, SUNDER_GREATEST_WEIGHT);
        if (!(f->max_shift >= 0))
            return sunder_i_fail(err, SUNDER_EARG, "feature %zu: the limit of moves, %g, is negative or not a number",
                                 i, f->max_shift);
    }
    sunder_layer *layer = sunder_i_calloc(1, sizeof *layer);
    if (!layer || !take_features(layer, features, n)) {
        sunder_layer_free(layer);
        return sunder_i_failure_cause(err);
    }
    *out = layer;
    return SUNDER_OK;
}

static sunder_status check_lines(const sunder_obstacle *geometry, size_t barrier, sunder_error *err)
{
    size_t from = 0;
    for (size_t k = 0; k < geometry->lines; from = geometry->line_end[k++])
        if (geometry->line_end[k] < from || geometry->line_end[k] > SIZE_MAX / 2)
            return sunder_i_fail(err, SUNDER_EARG, "barrier %zu, line %zu: ends do not ascend", barrier, k);
    for (size_t v = 0; v < 2 * from; v++)
        if (!isfinite(geometry->xy[v]))
            return sunder_i_fail(err, SUNDER_EINVALID, "barrier %zu, point %zu: a coordinate is not finite", barrier,
                                 v / 2);
    return SUNDER_OK;
}

sunder_status sunder_layer_set_barriers(sunder_layer *layer, const sunder_barrier *barriers, size_t n,
                                        sunder_error *err)
{
    if (n >= SUNDER_I_NOBODY - layer->n) return sunder_i_fail(err, SUNDER_EARG, "too many barriers: %zu", n);
    for (size_t i = 0; i < n; i++) {
        const sunder_barrier *b = &barriers[i];
        if (!(b->width >= 0) || !isfinite(b->width))
            return sunder_i_fail(err, SUNDER_EARG, "barrier %zu: the width, %g, is negative or not finite", i,
                                 b->width);
        if (!isfinite(b->gap)) return sunder_i_fail(err, SUNDER_EARG, "barrier %zu: the gap is not finite", i);
        if (!(b->full_gap >= 0) || !isfinite(b->full_gap))
            return sunder_i_fail(err, SUNDER_EARG, "barrier %zu: the full gap, %g, is negative or not finite", i,
                                 b->full_gap);
        const sunder_status status = check_lines(&b->geometry, i, err);
        if (status) return status;
    }
    sunder_barrier *copy = sunder_i_alloc(n, sizeof *copy);
    if (!copy) return sunder_i_failure_cause(err);
    if (n) memcpy(copy, barriers, n * sizeof *copy);
    sunder_i_free(layer->barrier);
    sunder_i_class_gaps_free(layer->gaps);
    layer->gaps = NULL;
    layer->barrier = copy;
    layer->barriers = n;
    return SUNDER_OK;
}

/* Sets *copy to a copy of n items, or to NULL if there are none. Returns false if memory is out. */
static bool copy_items(const void *item, size_t n, size_t size, void **copy)
{
    *copy = item ? sunder_i_alloc(n, size) : NULL;
    if (*copy && n) memcpy(*copy, item, n * size);
    return *copy || !item;
}

sunder_status sunder_layer_set_side_anchors(sunder_layer *layer, const double *xy, sunder_error *err)
{
    void *copy;
    if (!copy_items(xy, 2 * layer->n, sizeof *xy, &copy)) return sunder_i_failure_cause(err);
    sunder_i_free(layer->side_anchor);
    layer->side_anchor = copy;
    return SUNDER_OK;
}

sunder_status sunder_layer_set_originals(sunder_layer *layer, const sunder_shape *const *shape, sunder_error *err)
{
    void *copy;
    if (!copy_items((const void *)shape, layer->n, sizeof *shape, &copy)) return sunder_i_failure_cause(err);
    sunder_i_free((void *)layer->original);
    layer->original = copy;
    return SUNDER_OK;
}

sunder_status sunder_layer_set_rows(sunder_layer *layer, const int64_t *row, sunder_error *err)
{
    void *copy;
    if (!copy_items(row, layer->n, sizeof *row, &copy)) return sunder_i_failure_cause(err);
    sunder_i_free(layer->row);
    layer->row = copy;
    return SUNDER_OK;
}

sunder_status sunder_layer_set_preferred(sunder_layer *layer, const double *move, sunder_error *err)
{
    void *copy;
    bool any = false;
    for (size_t k = 0; move && k < 2 * layer->n; k++) {
        if (!isfinite(move[k]))
            return sunder_i_fail(err, SUNDER_EINVALID, "feature %zu: its preferred move is not finite", k / 2);
        any = any || move[k] != 0;
    }
    if (!copy_items(any ? move : NULL, 2 * layer->n, sizeof *move, &copy)) return sunder_i_failure_cause(err);
    sunder_i_free(layer->preferred);
    layer->preferred = copy;
    return SUNDER_OK;
}

sunder_status sunder_layer_set_hiding(sunder_layer *layer, const sunder_hiding_cost *cost, sunder_error *err)
{
    void *copy;
    for (size_t k = 0; cost && k < layer->n; k++)
        if (cost[k].weight < 1 || cost[k].weight > SUNDER_GREATEST_HIDING_WEIGHT)
            return sunder_i_fail(err, SUNDER_EARG, "feature %zu: the weight for hiding it, %lld, is out of range", k,
                                 (long long)cost[k].weight);
    if (!copy_items(cost, layer->n, sizeof *cost, &copy)) return sunder_i_failure_cause(err);
    sunder_i_free(layer->hiding);
    layer->hiding = copy;
    return SUNDER_OK;
}

void sunder_layer_set_least(sunder_layer *layer, const sunder_trimming *least) { layer->least = *least; }

void sunder_layer_set_crossed(sunder_layer *layer, sunder_crossed crossed) { layer->crossed = crossed; }

/* Checks the levels of feature k: each lies in the shape before it and costs no less. */
static sunder_status check_levels(const sunder_layer *layer, size_t k, const sunder_level *level, size_t n,
                                  sunder_error *err)
{
    const sunder_shape *before = layer->shape[k];
    int64_t least = 0;
    for (size_t i = 0; i < n; i++) {
        bool in = before && level[i].shape && !sunder_shape_is_empty(level[i].shape);
        const sunder_status status = in ? sunder_i_contained(level[i].shape, NULL, before, NULL, &in, err) : SUNDER_OK;
        if (status) return status;
        if (!in)
            return sunder_i_fail(err, SUNDER_EARG, "feature %zu: level %zu does not lie in the level before it", k,
                                 i + 1);
        if (level[i].cost < least || level[i].cost > SUNDER_GREATEST_HIDING_WEIGHT)
            return sunder_i_fail(err, SUNDER_EARG, "feature %zu: the cost of level %zu, %lld, is out of range", k,
                                 i + 1, (long long)level[i].cost);
        before = level[i].shape;
        least = level[i].cost;
    }
    return SUNDER_OK;
}

sunder_status sunder_layer_set_levels(sunder_layer *layer, const sunder_level *level, const size_t *end,
                                      sunder_error *err)
{
    for (size_t k = 0, first = 0; end && k < layer->n; first = end[k++]) {
        if (end[k] < first) return sunder_i_fail(err, SUNDER_EARG, "feature %zu: ends of levels do not ascend", k);
        const sunder_status status = check_levels(layer, k, level + first, end[k] - first, err);
        if (status) return status;
    }
    void *levels = NULL, *ends;
    const size_t n = end && layer->n ? end[layer->n - 1] : 0;
    if (!copy_items(end, layer->n, sizeof *end, &ends) || (n && !copy_items(level, n, sizeof *level, &levels))) {
        sunder_i_free(ends);
        return sunder_i_failure_cause(err);
    }
    sunder_i_free_all(layer->level, layer->level_end);
    layer->level = levels;
    layer->level_end = ends;
    return SUNDER_OK;
}

sunder_status sunder_i_layer_lower(sunder_layer *layer, const sunder_shape *const *shape, sunder_error *err)
{
    void *copy;
    if (!copy_items(shape, layer->n, sizeof *shape, &copy)) return sunder_i_failure_cause(err);
    sunder_i_free((void *)layer->at_level);
    layer->at_level = copy;
    return SUNDER_OK;
}

void sunder_layer_free(sunder_layer *layer)
{
    if (!layer) return;
    sunder_i_class_gaps_free(layer->gaps);
    sunder_i_free_all((void *)layer->shape, layer->demand, layer->demands, layer->barrier, layer->side_anchor,
                      layer->row, layer->preferred, layer->hiding, layer->level, layer->level_end,
                      (void *)layer->at_level, (void *)layer->original, layer);
}
