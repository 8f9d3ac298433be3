/* A scene's layer in the form that the search and the proofs use: a fixture for unit tests of these folders. Any
 * failure fails the test. */
#ifndef SUNDER_TESTS_SCENE_MODEL_H
#define SUNDER_TESTS_SCENE_MODEL_H

#include "scene.h"

#include "displacement/layer/placement.h"

typedef struct scene_model {
    sunder_layer *layer;
    sunder_layer work; /* the layer in the order of processing */
    sunder_i_barriers parts;
    sunder_i_model model;
    sunder_i_placement placement; /* these two are set by scene_model_related() only */
    sunder_i_relations start;
    bool placed;
} scene_model;

/* Begins a model with the scene's options; the scene keeps its features. The relations of pairs are not
 * computed: blocks come from the features' numbers only, and searches examine all features. */
void scene_model_begin(scene_model *m, const scene *s);
/* The same, placed and related as at the start of a run, with its seams. */
void scene_model_related(scene_model *m, const scene *s);
/* The same for features that the caller owns; there may be more of them than in a scene. */
void scene_model_related_features(scene_model *m, const sunder_feature *feature, size_t n,
                                  const sunder_layer_options *options);
void scene_model_end(scene_model *m);

#endif
