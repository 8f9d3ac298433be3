/* rungs.h: the smaller shapes that the features of a layer of the core may have, made by the rules: the rungs of a run,
 * from the largest on.
 *
 * A feature has a rung only if its shape meets the conditions and lies in that of the rung before. The core numbers the
 * levels of a feature without the rungs that it does not have. */
#ifndef GIS_LAYER_RUNGS_H
#define GIS_LAYER_RUNGS_H

#include "base/gis_error.h"
#include "layer/layer_rules.h"
#include "read/crs_units.h"

typedef enum gis_rung { GIS_RUNG_TRIMMED, GIS_RUNG_INSET, GIS_RUNG_SCALED, GIS_RUNG_SYMBOL, GIS_RUNGS } gis_rung;

typedef struct gis_levels {
    sunder_shape **shape; /* [features * rungs] feature by feature, from the largest on; NULL: it does not have it */
    int64_t *cost;        /* [features * rungs] the cost of each shape */
    size_t features, rungs;
    gis_rung *kind; /* [rungs] */
} gis_levels;

/* The lengths of the rules, in units of the layer. */
typedef struct gis_rung_lengths {
    double *inset; /* [insets] the lengths of --inset; owned */
    size_t insets;
    double min_size, symbol_size; /* 0: not given */
} gis_rung_lengths;

/* The features of a layer, and the rules. */
typedef struct gis_rung_request {
    const gis_layer_rules *rules;
    const gis_rung_lengths *lengths;
    sunder_layer_options core;
    const sunder_layer *layer;
    size_t n;
    const sunder_shape *const *shape; /* [n] the shapes in the layer */
    const int64_t *weight;            /* [n] what it costs to hide them */
    const bool *rigid;                /* [n] their shapes never change; NULL: all may */
} gis_rung_request;

/* Do the rules allow other shapes, larger ones among them? Do they allow rungs of this kind? */
bool gis_levels_asked(const gis_layer_rules *rules);
bool gis_rung_asked(const gis_layer_rules *rules, gis_rung kind);

/* Converts the lengths. Clear *out also after a failure. */
bool gis_rung_lengths_read(const gis_layer_rules *rules, const gis_crs_units *units, gis_rung_lengths *out,
                           gis_error *error);
void gis_rung_lengths_clear(gis_rung_lengths *lengths);

/* Makes the smaller shapes. Clear *out also after a failure. */
bool gis_rungs_make(const gis_rung_request *request, gis_levels *out, gis_error *error);
/* Sets the smaller shapes, and the least that they keep, for a layer of the features matched[n] (NULL: all n features).
 * They must outlive the layer, which has this name in messages. Does nothing if the rules do not allow any. */
bool gis_rungs_set(const gis_layer_rules *rules, double min_size, const gis_levels *levels, const size_t *matched,
                   size_t n, sunder_layer *layer, const char *name, gis_error *error);
void gis_levels_clear(gis_levels *levels);

/* Returns the rung of level k >= 1 of feature i, counted from 0. */
size_t gis_levels_rung(const gis_levels *levels, size_t i, size_t k);
/* Returns the shape of feature i on a rung that it has. */
static inline const sunder_shape *gis_levels_shape(const gis_levels *levels, size_t i, size_t rung)
{
    return levels->shape[i * levels->rungs + rung];
}

#endif
