/* The layer as the caller gives it, the rules that it is to keep, and the order in which it is worked on. */
#ifndef SUNDER_I_LAYER_H
#define SUNDER_I_LAYER_H

#include "sunder.h"
#include <stdbool.h>
#include <stdint.h>

#define SUNDER_I_NOBODY UINT32_MAX

/* Demands on a feature. Most features of a layer have the same, so each distinct value is stored once for a run of
 * features. */
struct sunder_layer {
    const sunder_shape **shape; /* [n] */
    uint32_t *demand;           /* [n] which of `demands`; NULL: the first, for all */
    sunder_feature *demands;    /* features without their shapes */
    size_t n;
    sunder_barrier *barrier;
    size_t barriers;
    double *side_anchor; /* [2 n] the caller's, not finite where the rule is to find it; NULL: of none */
    /* Of a layer in the order of work (feature_order.c), which has no features of its own; else NULL: */
    const sunder_layer *given; /* as it was given, in its order */
    uint32_t *number; /* [n + parts] what each was: of a part of a barrier n + the barrier, as the interface counts */
    sunder_feature *part; /* [parts] */
};

/* The demands on feature k of a layer as it was given, without its shape; and with it. */
static inline const sunder_feature *sunder_i_demands(const sunder_layer *given, size_t k)
{
    return &given->demands[given->demand ? given->demand[k] : 0];
}

static inline sunder_feature sunder_i_given_feature(const sunder_layer *given, size_t k)
{
    sunder_feature feature = *sunder_i_demands(given, k);
    feature.shape = given->shape[k];
    return feature;
}

/* The same of a feature of a layer in the order of work, or of a part behind them. */
static inline sunder_feature sunder_i_feature(const sunder_layer *layer, size_t thing)
{
    return thing < layer->n ? sunder_i_given_feature(layer->given, layer->number[thing])
                            : layer->part[thing - layer->n];
}

/* Is the feature there at all (not ignored, not empty)? */
static inline bool sunder_i_is_present(const sunder_feature *feature)
{
    return !feature->ignored && feature->shape && !sunder_shape_is_empty(feature->shape);
}

/* ---- rules.c ----------------------------------------------------------------------------------------------------- */

/* The options with every default filled in. */
typedef struct sunder_i_rules {
    double gap, tolerance;
    const sunder_shape *disc; /* with the tolerance's diameter, for sunder_i_overlap_is_thin(); the model's */
    bool touch_joins, containment_joins, list_inside;
    double thin; /* 0: joining by tolerance is not needed */
    bool jumps;  /* features may jump over others */
    sunder_containment contained;
    unsigned threads;
    double effort; /* >= 0 */
    uint64_t seed;
    bool keep_trees, keep_pushes, keep_worlds, drop_proofs;
    sunder_progress progress; /* NULL: the distance is not needed */
    void *progress_user;
    sunder_trace trace; /* NULL: no trace */
    void *trace_user;
} sunder_i_rules;

sunder_status sunder_i_rules_of(const sunder_layer_options *options, sunder_i_rules *rules, sunder_error *err);
/* Tells how far it is; false when the caller asked to stop. */
bool sunder_i_progress(const sunder_i_rules *rules, double fraction);

/* ---- feature_order.c --------------------------------------------------------------------------------------------- */

typedef struct sunder_i_barriers sunder_i_barriers;

/* The layer in processing order (or as given). Behind its n features it has a fixed one for each part of its barriers,
 * in their order. It borrows from the layer, which must outlive it; sunder_i_ordered_clear() clears it, also after a
 * failure. */
sunder_status sunder_i_order_layer(const sunder_layer *layer, const sunder_i_barriers *barriers, bool as_given,
                                   sunder_layer *out, sunder_error *err);
void sunder_i_ordered_clear(sunder_layer *ordered);

#endif
