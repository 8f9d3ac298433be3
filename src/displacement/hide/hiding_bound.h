/* A lower bound of what has to be hidden, with its proof. See hiding_bound.c. */
#ifndef SUNDER_I_HIDING_BOUND_H
#define SUNDER_I_HIDING_BOUND_H

#include "displacement/hide/cover.h"

/* Trees with their nodes, shares and bounds, as in sunder_hiding.h. A struct of zeros is empty. */
typedef struct sunder_i_hiding_bound {
    sunder_hiding_tree *tree;
    sunder_hiding_node *node;
    sunder_hiding_share *share;
    size_t trees, tree_room, nodes, node_room, shares, share_room;
} sunder_i_hiding_bound;

/* Makes a tree for each component of the proved clauses that only hidden features satisfy. best: [features] the levels
 * of a choice that satisfies them; the search for
 * a bound of a component ends when that of this choice is reached, or after `effort` nodes. The caller frees the
 * arrays, also after a failure. */
sunder_status sunder_i_hiding_bound_find(const sunder_i_clauses *clauses, const sunder_layer *layer,
                                         const uint32_t *best, size_t effort, sunder_i_hiding_bound *bound,
                                         sunder_error *err);

#endif
