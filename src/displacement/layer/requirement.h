/* What a pair that is left in conflict is held to; see requirement.c. */
#ifndef SUNDER_I_REQUIREMENT_H
#define SUNDER_I_REQUIREMENT_H

#include "displacement/layer/model.h"

/* Two things, a < b, that need not be separated (for a barrier its first part stands for all), and what they are held
 * to instead, no better than at the start:
 *
 *   clearance >= 0               disjoint interiors, and at least this distance
 *   -INFINITY < clearance < 0    some translation no longer than -clearance makes their interiors disjoint
 *   -INFINITY                    nothing: one lay in the other, and may lie anywhere in it */
typedef struct sunder_i_requirement {
    uint32_t a, b;
    double clearance;
    double shift[2]; /* where that is negative: a translation of b, about as long, that parted them */
} sunder_i_requirement;

/* a: a feature; b: a feature, or any part of a barrier. start: how the layer's pairs stood. */
sunder_status sunder_i_requirement_find(const sunder_i_model *model, const sunder_i_relations *start, uint32_t a,
                                        uint32_t b, sunder_i_requirement *out, sunder_error *err);
/* What the search holds it to; and a little less, since its lengths are rounded. */
sunder_i_requirement sunder_i_requirement_of(const sunder_i_model *model, const sunder_i_relaxation *relaxation);
sunder_i_requirement sunder_i_requirement_below(const sunder_i_model *model, const sunder_i_relaxation *relaxation);

#endif
