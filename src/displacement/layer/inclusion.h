/* What lies in another feature and may overlap it, and how it is kept inside; see inclusion.c. */
#ifndef SUNDER_I_INCLUSION_H
#define SUNDER_I_INCLUSION_H

#include "displacement/layer/relate.h"

typedef struct sunder_i_model sunder_i_model;

/* How the search treats a pair where one lies in the other and the rules allow the overlap; in this order. */
typedef enum sunder_i_inclusion_state {
    SUNDER_I_LENIENT, /* the one stays inside; it may touch or overstep walls as far as it did at the start */
    SUNDER_I_STRICT,  /* it stays clear of the walls: rounding ate up what leniency left */
    SUNDER_I_LAPSED   /* there is no keeping it inside: the two have to part like any others */
} sunder_i_inclusion_state;

typedef struct sunder_i_inclusion {
    uint32_t a, b; /* features, a < b */
    bool a_inside; /* a lies in b; else b in a */
    bool enters;   /* it did not at the start, but is to get there (solve/clusters/move_inside.c) */
    sunder_i_inclusion_state state;
} sunder_i_inclusion;

/* The pairs whose relations say so. */
sunder_status sunder_i_inclusions_init(sunder_i_model *model, const sunder_i_relations *relations, sunder_error *err);
/* One more: a, or else b, is to get inside the other. Before the walls are made. */
sunder_status sunder_i_inclusions_add(sunder_i_model *model, uint32_t a, uint32_t b, bool a_inside, sunder_error *err);
/* Records the pairs in conflict where one feature lies in the other, and where limits may force it to stay there. */
sunder_status sunder_i_inclusions_note_nested(sunder_i_model *model, const sunder_i_relations *relations,
                                              sunder_error *err);
/* The walls, for the search; after the pieces are cut. */
sunder_status sunder_i_inclusion_walls(sunder_i_model *model, sunder_error *err);
/* The pair; NULL if it never was one. */
sunder_i_inclusion *sunder_i_inclusion_find(const sunder_i_model *model, uint32_t f, uint32_t g);
/* Is it one, and has it not lapsed? */
bool sunder_i_is_included(const sunder_i_model *model, uint32_t f, uint32_t g);
/* Does `inner` lie in `holder`, be it with leave to overlap it or in conflict? */
bool sunder_i_is_inner(const sunder_i_model *model, uint32_t inner, uint32_t holder);
/* Does `holder` keep `inner` inside? Then *state tells how. */
bool sunder_i_keeps_inside(const sunder_i_model *model, uint32_t holder, uint32_t inner,
                           sunder_i_inclusion_state *state);
/* What lies in two that have to part cannot stay in both: lets it go from the one whose edge is nearer. conflict[k]:
 * the relation of pair k keeps two bodies from standing as they do. */
sunder_status sunder_i_inclusions_choose(sunder_i_model *model, const sunder_i_relations *relations,
                                         const bool *conflict, sunder_error *err);

#endif
