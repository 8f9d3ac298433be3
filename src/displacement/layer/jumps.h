/* Which features jumped over others, or crossed sides, exactly; see jumps.c. */
#ifndef SUNDER_I_JUMPS_H
#define SUNDER_I_JUMPS_H

#include "displacement/layer/changes.h"
#include "displacement/layer/path_tree.h"

/* The pairs that break a rule in the present positions, updated while features move: two features where one jumped over
 * the other, and a feature with a part of a barrier whose side it crossed. Zeroed: nothing has moved. */
typedef struct sunder_i_jumps {
    sunder_i_path_tree ways; /* straight from home */
    sunder_i_id_pair *pair;  /* things, a < b, of different bodies; sorted */
    size_t n;
} sunder_i_jumps;

void sunder_i_jumps_free(sunder_i_jumps *jumps);
/* Is there a tree, of ways? There is none while nothing has moved, and where features may jump. */
static inline bool sunder_i_jumps_begun(const sunder_i_jumps *jumps) { return sunder_i_path_tree_begun(&jumps->ways); }
/* What changed (sorted; NULL: all) stands elsewhere now, by model->move. Of no effect where no way is forbidden. */
sunder_status sunder_i_jumps_update(sunder_i_jumps *jumps, const sunder_i_model *model, const sunder_i_changes *changes,
                                    sunder_error *err);
/* *over: did the anchor of f pass g? If g is part of a barrier: did the side anchor of f pass a side of g? */
sunder_status sunder_i_jumps_over(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f, uint32_t g,
                                  bool *over, sunder_error *err);
/* One body stands elsewhere for now; the pairs stay what they were. */
sunder_status sunder_i_jumps_follow(sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t body,
                                    sunder_error *err);
/* Is one of its members, as they all stand, in such a pair? near: scratch. */
sunder_status sunder_i_jumps_of_body(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t body,
                                     sunder_i_list *near, bool *any, sunder_error *err);

#endif
