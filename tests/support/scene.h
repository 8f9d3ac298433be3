/* A small layer, built feature by feature, and its last report: a fixture for unit tests of displacement. Any failure
 * fails the test. */
#ifndef SUNDER_TESTS_SCENE_H
#define SUNDER_TESTS_SCENE_H

#include "sunder.h"

enum { SCENE_MOST = 80 };

typedef struct scene {
    sunder_feature feature[SCENE_MOST];
    size_t n;
    sunder_layer_options options;
    sunder_report *report; /* the last one; freed by the next run and by scene_end() */
    sunder_layer_summary summary;
} scene;

/* Begins a scene without features, with the given gap and default options. */
void scene_begin(scene *s, double gap);
void scene_end(scene *s);

/* Adds a feature of weight 1, without a limit, in no block; without a shape if wkt is NULL. The scene owns it. */
sunder_feature *scene_add(scene *s, const char *wkt);
/* The axis-parallel rectangle of that width and height with its lower left corner at (x, y). */
sunder_feature *scene_add_box(scene *s, double x, double y, double w, double h);

void scene_separate(scene *s);
void scene_check(scene *s);

/* The number of conflicts left between blocks, of every kind. */
size_t scene_left(const scene *s);
/* The length of a feature's move. */
double scene_length(const scene *s, size_t feature);

#endif
