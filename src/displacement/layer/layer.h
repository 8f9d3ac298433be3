/* The layer as the caller gives it, the rules that it has to keep, and the order in which its features are
 * processed. */
#ifndef SUNDER_I_LAYER_H
#define SUNDER_I_LAYER_H

#include "sunder_hiding.h"
#include "sunder_layer.h"
#include "displacement/layer/class_gaps.h"
#include <stdbool.h>
#include <stdint.h>

#define SUNDER_I_NOBODY UINT32_MAX

/* A layer. The demands on a feature are its members other than the shape. Most features of a layer have the same
 * demands, so they are stored once for each run of consecutive features with equal demands. */
struct sunder_layer {
    const sunder_shape **shape;    /* [n] */
    uint32_t *demand;              /* [n] the index of each feature's demands in `demands`; NULL: all have the first */
    sunder_feature *demands;       /* features without their shapes, one for each run */
    const sunder_shape **original; /* [n] the shape of each enlarged feature before it grew, NULL for other features;
                                    * NULL: no feature was enlarged */
    size_t n;
    sunder_barrier *barrier;
    size_t barriers;
    double *side_anchor; /* [2 n] side anchors from the caller, not finite where the rule has to find one; NULL: none
                          * are given */
    int64_t *row;        /* [n] the row of each feature, -1 for none, as the caller gives them; NULL: none are given */
    double *preferred;   /* [2 n] the moves that features prefer; NULL: all prefer to stay. Not all are 0 */
    sunder_i_class_gaps *gaps;     /* NULL: all pairs have the gap of the options */
    sunder_hiding_cost *hiding;    /* [n] what it costs to hide each; NULL: none is hidden */
    sunder_crossed crossed;        /* what becomes of features that a barrier's line crosses */
    sunder_trimming least;         /* what a smaller shape keeps at least */
    sunder_level *level;           /* the smaller shapes that features may have, feature by feature ... */
    size_t *level_end;             /* [n] ... and the index past the last one of each; NULL: there are none */
    const sunder_shape **at_level; /* [n] the shapes that features have now; NULL: those of shape[] */
    /* A layer in processing order (feature_order.c) stores no features of its own but has the next three; otherwise
     * they are NULL, and `lowered` is false: */
    const sunder_layer *given; /* the layer in the caller's order */
    uint32_t *number; /* [n + parts] the caller's number of each feature; for a part of a barrier, n plus the number of
                       * the barrier */
    sunder_feature *part; /* [parts] the parts of barriers, as fixed features */
    bool lowered;         /* features have the shapes given->at_level (lowered_features.c) */
};

/* The demands on feature k of a layer in the caller's order, without its shape. */
static inline const sunder_feature *sunder_i_demands(const sunder_layer *given, size_t k)
{
    return &given->demands[given->demand ? given->demand[k] : 0];
}

/* The shape of feature k before it was made larger. */
static inline const sunder_shape *sunder_i_original_shape(const sunder_layer *given, size_t k)
{
    return given->original && given->original[k] ? given->original[k] : given->shape[k];
}

/* Returns the smaller shapes that feature k may have, from the largest on, and sets *n to their number. */
static inline const sunder_level *sunder_i_levels_of(const sunder_layer *given, size_t k, size_t *n)
{
    const size_t first = given->level_end && k ? given->level_end[k - 1] : 0;
    *n = given->level_end ? given->level_end[k] - first : 0;
    return *n ? given->level + first : NULL;
}

/* Feature k of a layer in the caller's order, with its shape as given. */
static inline sunder_feature sunder_i_given_feature(const sunder_layer *given, size_t k)
{
    sunder_feature feature = *sunder_i_demands(given, k);
    feature.shape = given->shape[k];
    return feature;
}

/* A feature of a layer in processing order with its shape as given, or a part of a barrier, numbered after the
 * features. */
static inline sunder_feature sunder_i_feature(const sunder_layer *layer, size_t thing)
{
    return thing < layer->n ? sunder_i_given_feature(layer->given, layer->number[thing])
                            : layer->part[thing - layer->n];
}

/* Does the feature take part, being neither ignored nor empty? */
static inline bool sunder_i_is_present(const sunder_feature *feature)
{
    return !feature->ignored && feature->shape && !sunder_shape_is_empty(feature->shape);
}

/* Gives the features of a layer in the caller's order the shapes shape[n], which the caller keeps. */
sunder_status sunder_i_layer_lower(sunder_layer *layer, const sunder_shape *const *shape, sunder_error *err);

/* ---- rules.c ----------------------------------------------------------------------------------------------------- */

/* The options with every default filled in. */
typedef struct sunder_i_rules {
    double gap;      /* the distance that features have to keep */
    double full_gap; /* >= gap: the distance that they are to keep if it pays */
    bool has_full;   /* a full gap is asked for; those of classes count */
    double tolerance;
    const sunder_shape *disc; /* a polygon in the disc with diameter `tolerance`, for sunder_i_overlap_is_thin(); owned
                               * by the model */
    bool touch_joins, containment_joins, list_inside;
    double thin; /* the thickness below which overlaps are counted; 0: do not count */
    bool jumps;  /* features may jump over others */
    sunder_containment contained;
    unsigned threads;
    double effort; /* >= 0 */
    uint64_t seed;
    bool keep_trees, keep_pushes, keep_worlds, drop_proofs;
    sunder_progress progress; /* NULL: the caller wants no progress reports */
    void *progress_user;
    sunder_trace trace; /* NULL: no trace */
    void *trace_user;
    sunder_rows rows;
    double row_stiffness[2]; /* across rows and along them, >= 0; 0 without rows */
    double kink;             /* the least kink that is counted, >= 0 */
    double ease;             /* the price of what pairs in conflict lack, for each squared metre; 0: it has none */
} sunder_i_rules;

/* Checks the options and makes the rules from them. Fails if an option is out of its range. */
sunder_status sunder_i_rules_of(const sunder_layer_options *options, sunder_i_rules *rules, sunder_error *err);
/* Reports the progress to the caller. Returns false if the caller asked to stop. */
bool sunder_i_progress(const sunder_i_rules *rules, double fraction);

/* ---- feature_order.c --------------------------------------------------------------------------------------------- */

typedef struct sunder_i_barriers sunder_i_barriers;

/* Sets *out to the layer in processing order, or in the given order if as_given. Behind its n features it has a fixed
 * feature for each part of its barriers, in their order. It borrows from the layer, which must outlive it.
 * sunder_i_ordered_clear() frees it, also after a failure. */
sunder_status sunder_i_order_layer(const sunder_layer *layer, const sunder_i_barriers *barriers, bool as_given,
                                   sunder_layer *out, sunder_error *err);
void sunder_i_ordered_clear(sunder_layer *ordered);

#endif
