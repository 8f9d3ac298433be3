/* A solver of a scene's model with its conflicts joined: a fixture for unit tests of clusters. Any failure fails the
 * test. */
#ifndef SUNDER_TESTS_SCENE_SOLVER_H
#define SUNDER_TESTS_SCENE_SOLVER_H

#include "scene_model.h"

#include "displacement/solve/clusters/cluster_stages.h"

/* For a model with relations, which the scene keeps; bodies that are too close are joined, and no clusters are
 * formed. */
void scene_solver_begin(sunder_i_solver *solver, scene_model *of);
/* Call it before the model ends. */
void scene_solver_end(sunder_i_solver *solver);

#endif
