/* layer_rules.h: what is asked of the features of a layer: the rules of separate and check. */
#ifndef GIS_LAYER_RULES_H
#define GIS_LAYER_RULES_H

#include "base/length.h"
#include "sunder.h"

/* --weight */
typedef enum gis_weighting { GIS_WEIGHTING_EVEN, GIS_WEIGHTING_AREA, GIS_WEIGHTING_SQRT_AREA } gis_weighting;
/* "1", "area", "sqrt-area"; "" for what is none of them. */
const char *gis_weighting_string(gis_weighting weighting);

/* Strings are borrowed; zeroed members mean "not given". */
typedef struct gis_layer_rules {
    gis_optional_length gap, max_shift, touch_tolerance;
    const char *ignore_where, *fixed_where; /* SQL */
    const char *block_field, *weight_field, *max_shift_field;
    gis_weighting weighting;
    bool count_thin; /* where the tolerance is 0: how many overlaps would one of a hundredth of a metre join? */
    /* The library's own options, as the command line gives them. What depends on the layer, such as its unit, is filled
     * in by gis_layer_core_options(). */
    sunder_layer_options core;
} gis_layer_rules;

#endif
