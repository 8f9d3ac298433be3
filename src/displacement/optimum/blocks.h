/* Large groups: a bound from overlapping blocks of a few bodies; see blocks.c. */
#ifndef SUNDER_I_BLOCKS_H
#define SUNDER_I_BLOCKS_H

#include "displacement/optimum/contact.h"
#include "displacement/optimum/dual_program.h"
#include "displacement/optimum/optimum.h"

/* ---- contact_forces.c -------------------------------------------------------------------------------------------- */

/* The contacts of a layout, and the forces that act on them; i and j are places in the group's list. */
typedef struct sunder_i_contact_forces {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    sunder_i_move_cut *cut;
    double *force; /* [n] */
    size_t n, capacity;
    sunder_i_contact_list touch;   /* of the pair looked at */
    sunder_i_dual_program program; /* its t: where these forces hold the bodies */
    uint64_t steps;
} sunder_i_contact_forces;

/* weight, mass, anchor: as of the program; lent. False if memory is out; failure leaves what is freed. */
bool sunder_i_contact_forces_find(sunder_i_contact_forces *contacts, const sunder_i_model *model,
                                  const sunder_i_waived *waived, const sunder_i_group *group, const double *weight,
                                  const double *mass, const double *anchor);
void sunder_i_contact_forces_free(sunder_i_contact_forces *contacts);

/* ---- blocks.c ---------------------------------------------------------------------------------------------------- */

/* What is proved of the group by blocks, rounded downwards, in so many steps; the trees that it stands on are kept,
 * where that is asked for, if it is more than what is `known`. */
sunder_status sunder_i_blocks_bound(const sunder_i_model *model, const sunder_i_waived *waived,
                                    const sunder_i_group *group, uint64_t steps, double known, double *bound,
                                    sunder_i_bound_trees *trees, sunder_error *err);

#endif
