/* The layer as the caller gives it: its features, of which weights and limits are numbers that make sense. */
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
    layer->feature = copy;
    layer->n = n;
    *out = layer;
    return SUNDER_OK;
}

void sunder_layer_free(sunder_layer *layer)
{
    if (!layer) return;
    sunder_i_free(layer->feature);
    sunder_i_free(layer);
}
