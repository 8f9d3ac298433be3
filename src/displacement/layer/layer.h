/* The layer as the caller gives it, and the order in which it is worked on. */
#ifndef SUNDER_I_LAYER_H
#define SUNDER_I_LAYER_H

#include "sunder.h"
#include <stdbool.h>
#include <stdint.h>

#define SUNDER_I_NOBODY UINT32_MAX

struct sunder_layer {
    sunder_feature *feature;
    size_t n;
};

/* Is the feature there at all (not ignored, not empty)? */
static inline bool sunder_i_is_present(const sunder_feature *feature)
{
    return !feature->ignored && feature->shape && !sunder_shape_is_empty(feature->shape);
}

/* ---- order.c ----------------------------------------------------------------------------------------------------- */

/* A copy of the layer in the order that it is worked on in: number[k] is what feature k was. Failure leaves what
 * sunder_i_free() takes. */
sunder_status sunder_i_order_layer(const sunder_layer *layer, sunder_layer *out, size_t **number, sunder_error *err);

#endif
