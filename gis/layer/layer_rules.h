/* layer_rules.h: the rules of separate and check for the features of a layer. */
#ifndef GIS_LAYER_RULES_H
#define GIS_LAYER_RULES_H

#include "base/length.h"
#include "sunder_hiding.h"

/* --weight */
typedef enum gis_weighting { GIS_WEIGHTING_EVEN, GIS_WEIGHTING_AREA, GIS_WEIGHTING_SQRT_AREA } gis_weighting;
/* "1", "area" or "sqrt-area"; "" for other values. */
const char *gis_weighting_string(gis_weighting weighting);

/* Weights of hidden features are whole numbers in the core: thousandths. */
#define GIS_HIDING_UNIT 1000.
/* Weights times shares of lost area likewise: millionths. */
#define GIS_SHRINKING_UNIT 1e6
/* The class of features without a value is less important than any that a field can give. */
#define GIS_LAST_CLASS UINT32_MAX

/* Strings are borrowed; zeroed members mean "not given". */
typedef struct gis_layer_rules {
    gis_optional_length gap, least_gap, max_shift, touch_tolerance;
    const struct gis_gap_classes *classes; /* gaps by classes (gap_rules.h); NULL: all pairs have the gap */
    bool has_least_gap;                     /* --least-gap is given, or least= of a barrier */
    const char *ignore_where, *fixed_where; /* SQL */
    const char *block_field, *weight_field, *max_shift_field, *rows_field;
    const char *prefer_field[2]; /* the moves that features prefer, in x and y */
    gis_weighting weighting;
    /* Rules for the features of this layer if other layers move with it; then the core's options are those of all. */
    bool joins_none, may_jump, in_no_row, never_hidden;
    bool hide, drop_hidden; /* features may be left out; by the classes in this field, and this weight */
    bool trim; /* features may be cut back at barriers, but keep this share of their area, and a disc of this size */
    double trim_keep;
    sunder_crossed crossed; /* what becomes of features that a line of a barrier crosses */
    const char *inset;      /* the lengths of --inset, separated by commas */
    gis_optional_length min_size, symbol_size;
    bool enlarge;            /* features are made as large as min_size first */
    const char *rigid_where; /* SQL: features whose shapes do not change */
    const char *hierarchy_field;
    const char *hidden_field; /* of a result: which features are hidden */
    gis_weighting hide_weighting;
    bool count_thin; /* if the tolerance is 0: report how many overlaps a tolerance of a hundredth of a metre would
                      * join */
    /* The core's options, as the command line gives them. Those that depend on the layer, such as on its unit, are
     * filled in by gis_layer_core_options(). */
    sunder_layer_options core;
} gis_layer_rules;

#endif
