/* The layer as the caller gives it: its features, of which weights and limits are numbers that make sense, and its
 * barriers, likewise. */
#include "displacement/layer/layer.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

sunder_status sunder_layer_new(const sunder_feature *features, size_t n, sunder_layer **out, sunder_error *err)
{
    if (n >= SUNDER_I_NOBODY) return sunder_i_fail(err, SUNDER_EARG, "too many features: %zu", n);
    for (size_t i = 0; i < n; i++) {
        const sunder_feature *f = &features[i];
        if (!(f->weight > 0) || !isfinite(f->weight))
            return sunder_i_fail(err, SUNDER_EARG, "feature %zu: the weight %g is not positive and finite", i,
                                 f->weight);
        if (!(f->max_shift >= 0))
            return sunder_i_fail(err, SUNDER_EARG, "feature %zu: the limit of moves, %g, is negative or not a number",
                                 i, f->max_shift);
    }
    sunder_layer *layer = sunder_i_alloc(1, sizeof *layer);
    sunder_feature *copy = sunder_i_alloc(n, sizeof *copy);
    if (!layer || !copy) {
        sunder_i_free(layer);
        sunder_i_free(copy);
        return sunder_i_no_memory(err);
    }
    if (n) memcpy(copy, features, n * sizeof *copy);
    *layer = (sunder_layer){.feature = copy, .n = n};
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
        const sunder_status status = check_lines(&b->geometry, i, err);
        if (status) return status;
    }
    sunder_barrier *copy = sunder_i_alloc(n, sizeof *copy);
    if (!copy) return sunder_i_no_memory(err);
    if (n) memcpy(copy, barriers, n * sizeof *copy);
    sunder_i_free(layer->barrier);
    layer->barrier = copy;
    layer->barriers = n;
    return SUNDER_OK;
}

void sunder_layer_free(sunder_layer *layer)
{
    if (!layer) return;
    sunder_i_free(layer->feature);
    sunder_i_free(layer->barrier);
    sunder_i_free(layer);
}
