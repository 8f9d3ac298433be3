/* A feature and a barrier, exactly: are they near, how far apart are they, how deep is their overlap, and what is the
 * least translation that separates them? See barrier_pairs.c. */
#ifndef SUNDER_I_BARRIER_PAIRS_H
#define SUNDER_I_BARRIER_PAIRS_H

#include "displacement/layer/model.h"
#include "displacement/layer/resolution.h"

/* Relates a feature at its present place to one part of a barrier: sets relation->near, overlap and drawn, and all
 * other flags to false. */
sunder_status sunder_i_barrier_relate(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                      sunder_i_relation *relation, sunder_error *err);

/* The distance or depth of a feature relative to a whole barrier, which may be named by any of its parts. */
typedef struct sunder_i_barrier_stance {
    bool overlap;            /* the feature's interior meets the barrier */
    double distance;         /* between the two; 0 if they overlap */
    double on[2][2];         /* the ends of a shortest connection: on[0] on the feature, on[1] on the barrier */
    sunder_separation least; /* if they overlap: the feature's least translation off the barrier; without texts */
} sunder_i_barrier_stance;

/* Computes how the feature stands to the whole barrier of `part`: its depth if it overlaps the barrier, otherwise its
 * distance. */
sunder_status sunder_i_barrier_stand(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     sunder_i_barrier_stance *out, sunder_error *err);
/* Finds the least translation of the feature that leaves it `gap` from the whole barrier. `upper`, *out and *beyond are
 * as in sunder_i_separate(). */
sunder_status sunder_i_barrier_least(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     double gap, double upper, sunder_separation *out, bool *beyond, sunder_error *err);
/* Sets *holds if the feature lies in the areas of the barrier. */
sunder_status sunder_i_barrier_holds(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     bool *holds, sunder_error *err);
/* Sets *apart if the whole barrier is at least `length` from the feature. Must not be called for a feature that
 * overlaps the barrier. */
sunder_status sunder_i_barrier_apart(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     double length, bool *apart, sunder_error *err);
/* Sets *worse if the feature, moved from *was to *is, overlaps the whole barrier deeper or is nearer to it than before.
 * A feature that lies in the barrier's areas both before and after is not worse. */
sunder_status sunder_i_barrier_worsened(const sunder_i_model *model, const sunder_i_translate *was,
                                        const sunder_i_translate *is, uint32_t part, bool *worse, sunder_error *err);

/* `part` is a convex part of `feature`, and `of_other` one of `other`. Sets *so if the two features, at their original
 * places, have the same distance or depth as these two parts. */
sunder_status sunder_i_parts_stand_so(const sunder_i_model *model, uint32_t feature, uint32_t other,
                                      const sunder_i_piece_of *part, const sunder_i_piece_of *of_other, bool *so,
                                      sunder_error *err);

/* Finds the least relative move that resolves the pair of things a and b at their original places (resolution.h). a is
 * a feature, b a feature or a part of a barrier. */
sunder_status sunder_i_resolve_things(const sunder_i_model *model, size_t a, size_t b, double upper,
                                      sunder_i_resolution *out, sunder_error *err);

/* The same as sunder_i_resolve_things() for moves within the limits of the two things, INFINITY for no limit. If the
 * pair does not have to keep a gap and may not be resolved by a place of one inside the other, a length that exceeds
 * the sum of the limits by one unit in the last place is beyond them. With a gap, and for barriers, lengths up to the
 * rounded-up sum of the limits count as within them. */
sunder_status sunder_i_resolve_within(const sunder_i_model *model, size_t a, size_t b, const double limit[2],
                                      sunder_i_resolution *out, sunder_error *err);

#endif
