/* A tree over the paths of all features from their original to their present positions. It answers which paths come
 * near a box. */
#ifndef SUNDER_I_PATH_TREE_H
#define SUNDER_I_PATH_TREE_H

#include "displacement/layer/model.h"

/* See path_tree.c. Zeroed: none. */
typedef struct sunder_i_path_tree {
    double *hull;          /* [4 * nodes] the boxes of all nodes except leaves; NULL: there is no tree */
    const double *own;     /* borrowed, [2 * features] each feature's move; NULL: features move with their bodies */
    sunder_i_rtree longer; /* an order of the paths themselves, built when paths had become long; empty: the order is
                            * the model's tree */
    double sprawl, packed; /* the total size of the hulls now, and when the tree was packed, as in sunder_i_rtree */
} sunder_i_path_tree;

void sunder_i_path_tree_free(sunder_i_path_tree *tree);
/* Has the tree been built? */
static inline bool sunder_i_path_tree_begun(const sunder_i_path_tree *tree) { return tree->hull != NULL; }
/* Returns the present move of feature f. */
static inline const double *sunder_i_move_of(const sunder_i_path_tree *tree, const sunder_i_model *model, uint32_t f)
{
    return tree->own ? tree->own + 2 * (size_t)f : model->move + 2 * (size_t)model->body_of[f];
}
/* Sets box to the box of feature f's path, rounded outward. */
void sunder_i_path_box(const sunder_i_path_tree *tree, const sunder_i_model *model, uint32_t f, double box[4]);
/* Builds the tree for all present features in their present positions. */
sunder_status sunder_i_path_tree_begin(sunder_i_path_tree *tree, const sunder_i_model *model, sunder_error *err);
/* Updates the tree after the n features in `moved`, all present, have got new positions. May be called repeatedly for a
 * feature; the last position counts. */
sunder_status sunder_i_path_tree_follow(sunder_i_path_tree *tree, const sunder_i_model *model, const uint32_t *moved,
                                        size_t n, sunder_error *err);
/* Appends to `hits` every feature whose path meets the box; the read is recorded (reads.h). Returns false if memory is
 * out. Features that moved since the last sunder_i_path_tree_follow() may be missing. */
bool sunder_i_path_tree_look_about(const sunder_i_path_tree *tree, const sunder_i_model *model, const double box[4],
                                   sunder_i_list *hits);

#endif
