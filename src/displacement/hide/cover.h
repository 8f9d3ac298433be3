/* The cheapest features to hide: a minimum-weight hitting set of the clauses. */
#ifndef SUNDER_I_COVER_H
#define SUNDER_I_COVER_H

#include "displacement/hide/clauses.h"
#include "displacement/layer/layer.h"

/* What is known of the best choices, over all components of the clauses. A component is what clauses with common
 * members connect; clauses without members are in none. */
typedef struct sunder_i_cover_result {
    size_t components;
    size_t exact; /* components whose best choice was found */
    bool *hidden; /* [features] the choice; the caller's array */
    bool *sure;   /* NULL, or [features] the feature is in a component whose best choice was found; likewise */
} sunder_i_cover_result;

/* A choice is better than another one if it hides less weight in the most important class in which the two differ; if
 * they differ in none, if its features are the first in order of their numbers. */

/* Chooses features such that each clause has a hidden member: the best choice for each component, or if its search
 * takes more than `effort` nodes the best one found by then. proved_only: only proved clauses count. Members of class 0
 * are not in the clauses. */
sunder_status sunder_i_cover_find(const sunder_i_clauses *clauses, bool proved_only, const sunder_hiding_cost *cost,
                                  size_t features, uint64_t effort, sunder_i_cover_result *result, sunder_error *err);

#endif
