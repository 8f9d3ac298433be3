/* Features that lie in another one and may overlap it, and how the search keeps them inside; see inclusion.c. */
#ifndef SUNDER_I_INCLUSION_H
#define SUNDER_I_INCLUSION_H

#include "displacement/layer/relate.h"

typedef struct sunder_i_model sunder_i_model;

/* How the search treats a pair in which one feature lies in the other and may overlap it. The state of a pair only ever
 * changes to a later one. */
typedef enum sunder_i_inclusion_state {
    SUNDER_I_LENIENT, /* the inner feature stays inside; it may touch or overstep walls as far as at the start */
    SUNDER_I_STRICT,  /* the inner feature stays clear of the walls: with LENIENT it did not stay inside, because of
                       * rounding */
    SUNDER_I_LAPSED   /* the inner feature cannot be kept inside: the two have to be separated */
} sunder_i_inclusion_state;

typedef struct sunder_i_inclusion {
    uint32_t a, b; /* features, a < b */
    bool a_inside; /* a lies in b; otherwise b lies in a */
    bool enters;   /* the inner feature was outside at the start and is to be moved inside
                    * (solve/clusters/move_inside.c) */
    sunder_i_inclusion_state state;
} sunder_i_inclusion;

/* Makes an inclusion for each relation that is `kept`. */
sunder_status sunder_i_inclusions_init(sunder_i_model *model, const sunder_i_relations *relations, sunder_error *err);
/* Adds an inclusion for a pair whose inner feature (a if `a_inside`, else b) is to be moved inside. Must be called
 * before the walls are made. */
sunder_status sunder_i_inclusions_add(sunder_i_model *model, uint32_t a, uint32_t b, bool a_inside, sunder_error *err);
/* Records in model->nested the pairs in conflict in which one feature lies in the other, without being its duplicate,
 * if both have limits, which may force it to stay there. */
sunder_status sunder_i_inclusions_note_nested(sunder_i_model *model, const sunder_i_relations *relations,
                                              sunder_error *err);
/* Makes the walls, which are edges of holders, for the search. The pieces must have been numbered before. */
sunder_status sunder_i_inclusion_walls(sunder_i_model *model, sunder_error *err);
/* Returns the inclusion of features f and g in whatever state; NULL if there is none. */
sunder_i_inclusion *sunder_i_inclusion_find(const sunder_i_model *model, uint32_t f, uint32_t g);
/* Is there an inclusion of features f and g that has not lapsed? */
bool sunder_i_is_included(const sunder_i_model *model, uint32_t f, uint32_t g);
/* Does `inner` lie in `holder` at the start, so that it may overlap it or, both having limits, is in conflict with it?
 * The answer is also yes for a pair that sunder_i_inclusions_add() has added, and does not depend on the state of the
 * inclusion. */
bool sunder_i_is_inner(const sunder_i_model *model, uint32_t inner, uint32_t holder);
/* Does `holder` keep `inner` inside? If so, *state is set to the state of the inclusion. */
bool sunder_i_keeps_inside(const sunder_i_model *model, uint32_t holder, uint32_t inner,
                           sunder_i_inclusion_state *state);
/* A feature that lies in two others cannot stay in both if these have to be separated: lets the inclusion lapse in the
 * one whose edge is nearer. conflict[k] is set if pair k of `relations` has to be resolved. */
sunder_status sunder_i_inclusions_choose(sunder_i_model *model, const sunder_i_relations *relations,
                                         const bool *conflict, sunder_error *err);

#endif
