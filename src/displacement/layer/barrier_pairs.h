/* A feature and a barrier: are they near, how far, how deep, what takes them apart? Exact; see barrier_pairs.c. */
#ifndef SUNDER_I_BARRIER_PAIRS_H
#define SUNDER_I_BARRIER_PAIRS_H

#include "displacement/layer/model.h"
#include "displacement/layer/resolution.h"

/* What a feature as it stands is to one part: near and overlap. */
sunder_status sunder_i_barrier_relate(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                      sunder_i_relation *relation, sunder_error *err);

/* How a feature stands to all of a barrier, by any part of it. */
typedef struct sunder_i_barrier_stance {
    bool overlap;            /* the feature's interior meets it */
    double distance;         /* 0 where it does */
    double on[2][2];         /* the ends of a shortest link, on the feature and on the barrier */
    sunder_separation least; /* of the feature, where it overlaps; without texts */
} sunder_i_barrier_stance;

sunder_status sunder_i_barrier_stand(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     sunder_i_barrier_stance *out, sunder_error *err);
/* The least translation of the feature that leaves it `gap` from all of the barrier; as sunder_i_separate(). */
sunder_status sunder_i_barrier_least(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     double gap, double upper, sunder_separation *out, bool *beyond, sunder_error *err);
/* Does the feature lie in the barrier's areas? */
sunder_status sunder_i_barrier_holds(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     bool *holds, sunder_error *err);
/* Is all of the barrier at least that far from the feature? Not asked of one that overlaps. */
sunder_status sunder_i_barrier_apart(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     double length, bool *apart, sunder_error *err);
/* Does the feature stand worse to all of the barrier than it did? What lies in it, and did, does not. */
sunder_status sunder_i_barrier_worsened(const sunder_i_model *model, const sunder_i_translate *was,
                                        const sunder_i_translate *is, uint32_t part, bool *worse, sunder_error *err);

/* A feature and another thing, and a convex part of each: did the two stand as the parts did, and no nearer, or deeper
 * in each other? */
sunder_status sunder_i_parts_stand_so(const sunder_i_model *model, uint32_t feature, uint32_t other,
                                      const sunder_i_piece_of *part, const sunder_i_piece_of *of_other, bool *so,
                                      sunder_error *err);

/* Of any two things, a feature first: what it takes to resolve it between them, as they stood (resolution.h). */
sunder_status sunder_i_resolve_things(const sunder_i_model *model, size_t a, size_t b, double upper,
                                      sunder_i_resolution *out, sunder_error *err);

/* The same within the limits of the two, INFINITY for none. Where no gap is owed (and no place inside the other is
 * allowed), a length that exceeds the limits by one unit in the last place is beyond them. With a gap, and beside
 * barriers, lengths up to the rounded-up sum of the limits are within them. */
sunder_status sunder_i_resolve_within(const sunder_i_model *model, size_t a, size_t b, const double limit[2],
                                      sunder_i_resolution *out, sunder_error *err);

#endif
