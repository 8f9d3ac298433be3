/* Better layouts of a contact group: the functions that the search offers to proofs. */
#ifndef SUNDER_I_SHAKE_H
#define SUNDER_I_SHAKE_H

#include "displacement/prove/optimum/optimum.h"

extern const sunder_i_layout_search sunder_i_group_search;

/* Looks for cheaper moves of the group by random perturbation. The work that it may take is proportional to `steps`
 * (SHAKE_WORK). */
sunder_status sunder_i_group_shake(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *group,
                                   uint64_t steps, sunder_error *err);

#endif
