/* Pairs that are left in conflict, and what is demanded of them instead; see relaxation.c. */
#ifndef SUNDER_I_RELAXATION_H
#define SUNDER_I_RELAXATION_H

#include "base/list.h"
#include "displacement/layer/relate.h"
#include "sunder.h"
#include <stdbool.h>

typedef struct sunder_i_model sunder_i_model;

/* A pair of features, a < b, that is left in conflict, and what is demanded of it instead of the gap: that b + shift
 * keep `gap` from a; or that the one stay inside the other. See relaxation.c. */
typedef struct sunder_i_relaxation {
    uint32_t a, b;
    double shift[2], gap;
    bool inside;
    bool infeasible; /* it was proved that nothing resolves the pair, by itself or with what is left besides; else the
                        search gave up */
} sunder_i_relaxation;

/* Bodies i < j that have n relaxations between their members. No shift of these is longer than `reach`. */
typedef struct sunder_i_relaxed_bodies {
    uint32_t i, j;
    double reach;
    size_t n;
} sunder_i_relaxed_bodies;

/* A relaxation that has ended, so that its pair owes all again: of these bodies, i < j, and these features, a < b. */
typedef struct sunder_i_restored {
    sunder_i_id_pair body, feature;
} sunder_i_restored;

typedef struct sunder_i_relaxations {
    sunder_i_relaxation *item; /* sorted, as `relaxed` is, by sunder_i_relaxations_index() */
    size_t n, capacity;
    sunder_i_relaxed_bodies *relaxed;
    size_t relaxed_n, relaxed_capacity;
    /* Of many: words, a power of two, in which each two of `relaxed` have a bit, and few others. */
    uint64_t *mark;
    size_t marks;
} sunder_i_relaxations;

void sunder_i_relaxations_free(sunder_i_relaxations *relaxations);
/* Appends one; to be indexed before anything is looked up. False if memory is out. */
bool sunder_i_relaxations_add(sunder_i_relaxations *relaxations, const sunder_i_relaxation *relaxation);
/* The same for a barrier: for all of its parts that the feature may reach. The demand is on the whole barrier; a part
 * that was far off would otherwise demand the full distance. */
bool sunder_i_relaxations_spread(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation, double reach);
bool sunder_i_relaxations_index(sunder_i_relaxations *relaxations, const sunder_i_model *model);
/* The relaxation of two features, or between members of two bodies; NULL: there is none. */
const sunder_i_relaxation *sunder_i_relaxations_find(const sunder_i_relaxations *relaxations, uint32_t f, uint32_t g);
const sunder_i_relaxed_bodies *sunder_i_relaxations_between(const sunder_i_relaxations *relaxations, uint32_t body,
                                                            uint32_t other);
/* One more, or one less, of relaxations that stay indexed. */
bool sunder_i_relaxations_insert(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation);
void sunder_i_relaxations_remove(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation);
/* Is it a conflict between two bodies? And one that is to be resolved, with no relaxation? */
bool sunder_i_is_conflict_of_bodies(const sunder_i_model *model, const sunder_i_relation *r);
bool sunder_i_is_open_conflict(const sunder_i_model *model, const sunder_i_relation *r);
/* Removes the relaxations of the n sorted pairs, which owe all again. The caller has to index the rest again. */
void sunder_i_relaxations_restore(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                  const sunder_i_restored *restored, size_t n);
/* The place, or insertion point, among n of them, sorted. */
size_t sunder_i_restored_at(const sunder_i_restored *list, size_t n, const sunder_i_restored *wanted);
int sunder_i_by_restored(const void *a, const void *b);
sunder_i_restored sunder_i_restored_of(const sunder_i_model *model, const sunder_i_relaxation *relaxation);
/* A relaxation for two features, by how they stood at the start. */
sunder_status sunder_i_relaxation_of(const sunder_i_model *model, uint32_t f, uint32_t g, sunder_i_relaxation *out,
                                     sunder_error *err);
/* Changes a relaxation by one direction of separation to the shortest one with a and b moved by ta and tb: *fits, if it
 * is no longer than before. After that it does not hold at the start any more. */
sunder_status sunder_i_relaxation_turn(const sunder_i_model *model, const double ta[2], const double tb[2],
                                       sunder_i_relaxation *relaxation, bool *fits, sunder_error *err);
/* Appends relaxations for all members of two bodies that stood within reach of each other. */
sunder_status sunder_i_relaxations_make(const sunder_i_model *model, uint32_t body, uint32_t other, double reach,
                                        sunder_i_relaxations *out, sunder_error *err);
/* By how much `of_j`, one of its features, is shifted before it is measured; returns the distance it then keeps. */
double sunder_i_relaxation_shift(const sunder_i_relaxation *relaxation, uint32_t of_j, double shift[2]);

#endif
