/* A field of shapes as one cluster of the search: a fixture for tests of large crowds. Any failure fails the test. */
#ifndef SUNDER_TESTS_SCENE_FIELD_H
#define SUNDER_TESTS_SCENE_FIELD_H

#include "scene_model.h"

#include "displacement/solve/search/cluster_search.h"

typedef struct scene_field {
    sunder_feature *feature; /* [n] of weight 1, in no block */
    size_t n;
    uint32_t *body; /* [n] each is one */
    double *move;   /* [2 * n] */
    scene_model of;
    sunder_i_search search; /* of all of them */
} scene_field;

/* Capacity. */
scene_field *scene_field_new(size_t most);
/* One more, from WKT, which goes no farther than that. */
void scene_field_add(scene_field *field, const char *wkt, double max_shift);
/* They are all there, and owe each other the gap; jumps are allowed. */
void scene_field_begin(scene_field *field, double gap);
void scene_field_free(scene_field *field);

#endif
