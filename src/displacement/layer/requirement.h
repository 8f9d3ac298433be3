/* The bound that a pair left in conflict is held to; see requirement.c. */
#ifndef SUNDER_I_REQUIREMENT_H
#define SUNDER_I_REQUIREMENT_H

#include "displacement/layer/model.h"

/* Two things, a < b, that need not be separated (a barrier is represented by its first part), and the bound that they
 * are held to instead. It demands no more than held at the start.
 *
 *   clearance >= 0               disjoint interiors, and at least this distance
 *   -INFINITY < clearance < 0    some translation no longer than -clearance makes their interiors disjoint
 *   -INFINITY                    nothing: one lay in the other, and may lie anywhere in it */
typedef struct sunder_i_requirement {
    uint32_t a, b;
    double clearance;
    double shift[2]; /* if the clearance is negative: a translation of b, about as long, that separates the two */
} sunder_i_requirement;

/* Finds the bound of the things a and b at the start. a is a feature, b a feature or any part of a barrier; `start` has
 * the layer's relations at the start. */
sunder_status sunder_i_requirement_find(const sunder_i_model *model, const sunder_i_relations *start, uint32_t a,
                                        uint32_t b, sunder_i_requirement *out, sunder_error *err);
/* Returns the bound that a relaxation of the search expresses. sunder_i_requirement_below() returns a slightly weaker
 * one, since the lengths of the search are rounded. */
sunder_i_requirement sunder_i_requirement_of(const sunder_i_model *model, const sunder_i_relaxation *relaxation);
sunder_i_requirement sunder_i_requirement_below(const sunder_i_model *model, const sunder_i_relaxation *relaxation);

#endif
