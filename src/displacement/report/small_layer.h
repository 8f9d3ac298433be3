/* The small layer around a remaining conflict, of which questions are asked; small_layer.c explains it. */
#ifndef SUNDER_I_SMALL_LAYER_H
#define SUNDER_I_SMALL_LAYER_H

#include "displacement/report/report.h"

/* The small layer around one conflict. The first `moving` features may move, all others are fixed. */
typedef struct sunder_i_surroundings {
    sunder_i_list feature; /* features, by their numbers in the whole layer */
    sunder_i_list part;    /* parts of barriers, by their numbers in the whole layer */
    size_t moving;
    sunder_feature *as;      /* [feature.n] the properties with which each takes part */
    sunder_shape **standing; /* [feature.n] owned: the shapes of features that moved in the result, at their present
                              * positions; NULL for others */
    double known[4];         /* every feature that reaches into this box is in the small layer */
    double farthest;         /* the longest move that a feature may make in it */
} sunder_i_surroundings;

/* Collects the features and barriers of the small layer around a conflict. The caller calls
 * sunder_i_surroundings_clear() even if this fails. */
sunder_status sunder_i_surround(const sunder_i_solver *solver, const sunder_conflict *conflict,
                                sunder_i_surroundings *surroundings, sunder_error *err);
void sunder_i_surroundings_clear(sunder_i_surroundings *surroundings);

/* Makes the small layer without the feature or barrier `gone`, a number of the whole layer or SUNDER_I_NOBODY. Each
 * feature that moves may go as far as `limit`, or as its own limit if that is larger, but not farther than
 * surroundings->farthest. `solver` is that of the whole layer. The caller frees *layer. */
sunder_status sunder_i_surroundings_layer(const sunder_i_surroundings *surroundings, const sunder_i_solver *solver,
                                          double limit, uint32_t gone, sunder_layer **layer, sunder_error *err);
/* Returns the number in the whole layer of `thing`, a feature or barrier part of the small layer. `small` solves the
 * small layer; `gone` is the barrier that the small layer leaves out. */
uint32_t sunder_i_surroundings_number(const sunder_i_surroundings *surroundings, const sunder_i_model *whole,
                                      const sunder_i_solver *small, uint32_t thing, uint32_t gone);
/* Returns the names by which the memo of relaxations knows the features and barrier parts of the small layer without
 * `gone`: their numbers in the whole layer; SUNDER_I_NOBODY for a feature that moved in the result, since it stands
 * elsewhere here than at the start of the whole layer. The caller frees them. Returns NULL if memory is out. */
uint32_t *sunder_i_surroundings_names(const sunder_i_surroundings *surroundings, const sunder_i_model *whole,
                                      uint32_t gone);
/* Compares two conflicts by their features and barriers: the order of a report's list. */
int sunder_i_by_things(const void *p, const void *q);
/* Lists the pairs of the report except `conflict`, which may remain in conflict, in the small layer's numbers; sorted.
 * The caller frees *list. Returns false if memory is out. */
bool sunder_i_surroundings_listed(const sunder_i_surroundings *surroundings, const sunder_i_model *whole,
                                  const sunder_report *report, const sunder_conflict *conflict, uint32_t gone,
                                  sunder_i_id_pair **list, size_t *n);

#endif
