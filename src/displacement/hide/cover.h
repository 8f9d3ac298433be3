/* The cheapest levels of features: a minimum-weight solution of the clauses. */
#ifndef SUNDER_I_COVER_H
#define SUNDER_I_COVER_H

#include "displacement/hide/clauses.h"
#include "displacement/layer/layer.h"

/* What is known of the best choices, over all components of the clauses. A component is what clauses with common
 * members connect; clauses without members are in none. */
typedef struct sunder_i_cover_result {
    size_t components;
    size_t exact;    /* components whose best choice was found */
    uint32_t *level; /* [features] the choice; the caller's array */
    bool *sure;      /* NULL, or [features] the feature is in a component whose best choice was found; likewise */
} sunder_i_cover_result;

/* Which clauses count, and what may be chosen. */
typedef enum sunder_i_cover_demand {
    SUNDER_I_COVER_ALL,      /* all clauses */
    SUNDER_I_COVER_PROVED,   /* the proved ones */
    SUNDER_I_COVER_SHRINKING /* the proved ones without a member that is hidden in result->level; no other is hidden */
} sunder_i_cover_demand;

/* Returns the greatest level of a feature. */
uint32_t sunder_i_last_level(const sunder_layer *layer, size_t feature);
/* Is a feature hidden if it has this level? */
bool sunder_i_is_hidden_at(const sunder_layer *layer, size_t feature, uint32_t level);

/* A choice is better than another one if it hides less weight in the most important class in which the two differ; if
 * they differ in none, if the sum of the costs of its other levels is less; then if the first feature, in order of
 * their numbers, in which the two differ has a greater level. */

/* Chooses levels such that each clause has a member with a greater level than its own: the best choice for each
 * component, or if its search takes more than `effort` nodes the best one found by then. Every member has a greater
 * level than that of its clause. */
sunder_status sunder_i_cover_find(const sunder_i_clauses *clauses, sunder_i_cover_demand demand,
                                  const sunder_layer *layer, uint64_t effort, sunder_i_cover_result *result,
                                  sunder_error *err);

#endif
