/* A tree over the paths of all features, from their original to their present places: which came near a box? */
#ifndef SUNDER_I_PATH_TREE_H
#define SUNDER_I_PATH_TREE_H

#include "displacement/layer/model.h"

/* See path_tree.c. Zeroed: none. */
typedef struct sunder_i_path_tree {
    double *hull;          /* [4 * nodes] of all nodes that are no leaves; NULL: there is no tree */
    const double *own;     /* [2 * features] lent: each feature's move; NULL: they move with their bodies */
    sunder_i_rtree longer; /* of the ways, built when they had grown long; empty: the model's tree is used */
    double sprawl, packed; /* as sunder_i_rtree has them */
} sunder_i_path_tree;

void sunder_i_path_tree_free(sunder_i_path_tree *ways);
static inline bool sunder_i_path_tree_begun(const sunder_i_path_tree *ways) { return ways->hull != NULL; }
static inline const double *sunder_i_move_of(const sunder_i_path_tree *ways, const sunder_i_model *model, uint32_t f)
{
    return ways->own ? ways->own + 2 * (size_t)f : model->move + 2 * (size_t)model->body_of[f];
}
/* The box of a feature's way, rounded outward. */
void sunder_i_path_box(const sunder_i_path_tree *ways, const sunder_i_model *model, uint32_t f, double box[4]);
/* Of the features that are present, as they stand. */
sunder_status sunder_i_path_tree_begin(sunder_i_path_tree *ways, const sunder_i_model *model, sunder_error *err);
/* These, which are present, have moved, on and on: the last place is what counts. */
sunder_status sunder_i_path_tree_follow(sunder_i_path_tree *ways, const sunder_i_model *model, const uint32_t *moved,
                                        size_t n, sunder_error *err);
/* Appends every feature whose path meets the box; the read is recorded (reads.h). False if memory is out. It may list
 * too few until it has been told which features moved. */
bool sunder_i_path_tree_look_about(const sunder_i_path_tree *ways, const sunder_i_model *model, const double box[4],
                                   sunder_i_list *hits);

#endif
