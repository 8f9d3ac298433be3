/* previous_layer.h: one layer and its result of an earlier run, as the files about --previous share it. */
#ifndef GIS_PREVIOUS_LAYER_H
#define GIS_PREVIOUS_LAYER_H

#include "layer/feature_keys.h"
#include "layer/layer_input.h"

typedef struct gis_previous_layer {
    gis_layer_input *input;
    gis_layer_input_request request;
    gis_layer_input before; /* the result of the earlier run; without a source if that did not have the layer */
    size_t n;               /* the number of its features */
    int move_field[2], block_field;
    gis_feature_key *key; /* [n] sorted */
    bool *matched;        /* [n] */
    int64_t *block;       /* [features of the layer] the former block; -1: none */
} gis_previous_layer;

/* previous_places.c: finds the features that are free to go back, in all layers, and sets `relaxed` of each. */
bool gis_previous_relax(gis_previous_layer *layer, size_t layers, bool stays, double gap, gis_error *error);

#endif
