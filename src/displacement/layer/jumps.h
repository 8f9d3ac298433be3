/* Which features jumped over others, crossed sides of barriers, or left their rows, exactly; see jumps.c. */
#ifndef SUNDER_I_JUMPS_H
#define SUNDER_I_JUMPS_H

#include "displacement/layer/changes.h"
#include "displacement/layer/path_tree.h"

/* The pairs that break a rule in the present positions; it is updated while features move. A pair is two features of
 * which one jumped over the other, or a feature and a part of a barrier whose side it crossed, or the features that
 * stand for two neighbours in a row that broke its rule. Zeroed: nothing has moved. */
typedef struct sunder_i_jumps {
    sunder_i_path_tree paths; /* each from the original position straight to the present one */
    sunder_i_id_pair *pair;   /* things, a < b, of different bodies; sorted */
    size_t n;
} sunder_i_jumps;

void sunder_i_jumps_free(sunder_i_jumps *jumps);
/* Has the tree of paths been built? It has not before the first move, and never if jumps are allowed. */
static inline bool sunder_i_jumps_begun(const sunder_i_jumps *jumps) { return sunder_i_path_tree_begun(&jumps->paths); }
/* Updates the pairs after the features in `changes` (sorted; NULL: all) were given new positions in model->move. Does
 * nothing if no relative moves are forbidden. */
sunder_status sunder_i_jumps_update(sunder_i_jumps *jumps, const sunder_i_model *model, const sunder_i_changes *changes,
                                    sunder_error *err);
/* Sets *over if the anchor of feature f passed over feature g, or, if g is a part of a barrier, if the side anchor of f
 * passed a side of g. */
sunder_status sunder_i_jumps_over(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f, uint32_t g,
                                  bool *over, sunder_error *err);
/* Updates only the paths of one body that has a new position for now; jumps->pair is not updated. */
sunder_status sunder_i_jumps_follow(sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t body,
                                    sunder_error *err);
/* Sets *any if a member of the body, in the present positions, breaks a rule together with a thing of another body.
 * near: scratch. */
sunder_status sunder_i_jumps_of_body(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t body,
                                     sunder_i_list *near, bool *any, sunder_error *err);

#endif
