/* A field of shapes as one cluster of the search: a fixture for tests of large crowds. Any failure fails the test. */
#ifndef SUNDER_TESTS_SCENE_FIELD_H
#define SUNDER_TESTS_SCENE_FIELD_H

#include "scene_model.h"

#include "displacement/solve/search/cluster_search.h"

typedef struct scene_field {
    sunder_feature *feature; /* [n] of weight 1, in no block */
    size_t n;
    uint32_t *body; /* [n] each feature is a body */
    double *move;   /* [2 * n] */
    scene_model of;
    sunder_i_search search; /* a search of all bodies */
} scene_field;

/* A field for up to `most` shapes. */
scene_field *scene_field_new(size_t most);
/* Adds a shape, from WKT, with this limit. */
void scene_field_add(scene_field *field, const char *wkt, double max_shift);
/* Call it after all shapes were added: makes the search, with this gap; jumps are allowed. */
void scene_field_begin(scene_field *field, double gap);
void scene_field_free(scene_field *field);

#endif
