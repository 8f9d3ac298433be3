/* Pairs that are left in conflict, and the weaker demands on them; see relaxation.c. */
#ifndef SUNDER_I_RELAXATION_H
#define SUNDER_I_RELAXATION_H

#include "base/list.h"
#include "displacement/layer/relate.h"
#include "sunder_base.h"
#include <stdbool.h>

typedef struct sunder_i_model sunder_i_model;

/* A pair of features, a < b, that is left in conflict, and the demand on it in place of the gap: b + shift has to keep
 * the distance `gap` from a; or, if `inside`, one has to stay inside the other. See relaxation.c. */
typedef struct sunder_i_relaxation {
    uint32_t a, b;
    double shift[2], gap;
    bool inside;
    bool infeasible; /* it is proved that the pair has no solution, by itself or together with others that are resolved;
                      * if not set, the search gave up */
} sunder_i_relaxation;

/* Bodies i < j with n relaxations between their members. No shift of these is longer than `reach`. */
typedef struct sunder_i_relaxed_bodies {
    uint32_t i, j;
    double reach;
    size_t n;
} sunder_i_relaxed_bodies;

/* A relaxation that has ended, so that its pair has to keep the full distance again: its bodies, i < j, and its
 * features, a < b. */
typedef struct sunder_i_restored {
    sunder_i_id_pair body, feature;
} sunder_i_restored;

typedef struct sunder_i_relaxations {
    sunder_i_relaxation *item; /* sorted, as `relaxed` is, by sunder_i_relaxations_index() */
    size_t n, capacity;
    sunder_i_relaxed_bodies *relaxed;
    size_t relaxed_n, relaxed_capacity;
    /* A filter, if there are many: [marks] words, a power of two. Each pair in `relaxed` has its bit set, and few
     * others have. */
    uint64_t *mark;
    size_t marks;
} sunder_i_relaxations;

void sunder_i_relaxations_free(sunder_i_relaxations *relaxations);
/* Appends one. sunder_i_relaxations_index() must be called before anything is looked up. Returns false if memory is
 * out. */
bool sunder_i_relaxations_add(sunder_i_relaxations *relaxations, const sunder_i_relaxation *relaxation);
/* Appends a relaxation; for a barrier, one for each of its parts that the feature may reach. The demand is on the whole
 * barrier: without this, a part that was far off would demand the full distance. */
bool sunder_i_relaxations_spread(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation, double reach);
/* Sorts the relaxations, and lists the pairs of bodies that have any in `relaxed`. Returns false if memory is out. */
bool sunder_i_relaxations_index(sunder_i_relaxations *relaxations, const sunder_i_model *model);
/* Returns the relaxation of features f and g; NULL if there is none. */
const sunder_i_relaxation *sunder_i_relaxations_find(const sunder_i_relaxations *relaxations, uint32_t f, uint32_t g);
/* Returns the entry of two bodies in `relaxed`; NULL if no relaxation is between their members. */
const sunder_i_relaxed_bodies *sunder_i_relaxations_between(const sunder_i_relaxations *relaxations, uint32_t body,
                                                            uint32_t other);
/* Inserts or removes one relaxation; the index stays valid. sunder_i_relaxations_insert() returns false if memory is
 * out. The relaxation to be removed has to be in the list. */
bool sunder_i_relaxations_insert(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation);
void sunder_i_relaxations_remove(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation);
/* Is r a conflict between two bodies? sunder_i_is_open_conflict() returns true only if it also has to be resolved,
 * since the pair has no relaxation in the model. */
bool sunder_i_is_conflict_of_bodies(const sunder_i_model *model, const sunder_i_relation *r);
bool sunder_i_is_open_conflict(const sunder_i_model *model, const sunder_i_relation *r);
/* Removes the relaxations of the n pairs in `restored` (sorted), which have to keep the full distance again. The caller
 * has to index the rest again. */
void sunder_i_relaxations_restore(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                  const sunder_i_restored *restored, size_t n);
/* Returns the index of `wanted` in a sorted list of n, or the index where it would be inserted. */
size_t sunder_i_restored_at(const sunder_i_restored *list, size_t n, const sunder_i_restored *wanted);
/* Compares two restored pairs by their bodies, then by their features, for sorting. */
int sunder_i_by_restored(const void *a, const void *b);
/* Returns the entry that says that this relaxation has ended. */
sunder_i_restored sunder_i_restored_of(const sunder_i_model *model, const sunder_i_relaxation *relaxation);
/* Makes a relaxation for features f and g from their original positions. */
sunder_status sunder_i_relaxation_of(const sunder_i_model *model, uint32_t f, uint32_t g, sunder_i_relaxation *out,
                                     sunder_error *err);
/* Turns the shift of a relaxation of an overlap into the direction of the least translation that separates a and b when
 * they are moved by ta and tb, and keeps its length, up to a tiny share. *fits is set if that translation is no longer
 * than the shift; otherwise the relaxation does not change. Once turned, the relaxation need not hold at the start. */
sunder_status sunder_i_relaxation_turn(const sunder_i_model *model, const double ta[2], const double tb[2],
                                       sunder_i_relaxation *relaxation, bool *fits, sunder_error *err);
/* Appends relaxations for the pairs of members of two bodies that were less than `reach` apart at the start; beside a
 * barrier `reach` is increased by what its required distance exceeds the gap by. Pairs in which one feature is kept
 * inside the other are left out. Returns false if memory is out, or the work is to stop. */
bool sunder_i_relaxations_make(const sunder_i_model *model, uint32_t body, uint32_t other, double reach,
                               sunder_i_relaxations *out);
/* Sets `shift` to the translation of `of_j`, one of the relaxation's features, before its distance is measured. Returns
 * the distance that it has to keep then. */
double sunder_i_relaxation_shift(const sunder_i_relaxation *relaxation, uint32_t of_j, double shift[2]);

#endif
