/* What lies in another feature and may overlap it, and how it is kept inside; see inclusion.c. */
#ifndef SUNDER_I_INCLUSION_H
#define SUNDER_I_INCLUSION_H

#include "displacement/layer/model.h"

/* A pair of which one lies in the other, where the rules let that overlap: how the search treats it. */
typedef enum sunder_i_keeping {
    SUNDER_I_LENIENT, /* the one stays inside; it may touch or overstep walls as far as it did at the start */
    SUNDER_I_STRICT,  /* it stays clear of the walls: rounding ate up what leniency left */
    SUNDER_I_LAPSED   /* there is no keeping it inside: the two have to part like any others */
} sunder_i_keeping;

sunder_status sunder_i_keep_init(sunder_i_town *town, const sunder_i_relations *relations, sunder_error *err);
/* One more: a, or else b, is to get inside the other. Before the walls are made. */
sunder_status sunder_i_keep_add(sunder_i_town *town, uint32_t a, uint32_t b, bool a_in_b, sunder_error *err);
/* Notes the pairs in conflict of which the one lies in the other, and that limits may leave so. */
sunder_status sunder_i_keep_note(sunder_i_town *town, const sunder_i_relations *relations, sunder_error *err);
/* The walls, for the search; after the pieces are cut. */
sunder_status sunder_i_keep_walls(sunder_i_town *town, sunder_error *err);
/* Where the pair is in town->kept; kept_n if it never was. */
size_t sunder_i_kept_at(const sunder_i_town *town, uint32_t f, uint32_t g);
/* Is it, and has it not lapsed? */
bool sunder_i_is_kept(const sunder_i_town *town, uint32_t f, uint32_t g);
/* Does `inner` lie in `holder`, by town->kept or town->lying? */
bool sunder_i_is_inner(const sunder_i_town *town, uint32_t inner, uint32_t holder);
/* Does `holder` keep `inner` inside? Then *keeping tells how. */
bool sunder_i_holds(const sunder_i_town *town, uint32_t holder, uint32_t inner, sunder_i_keeping *keeping);
/* What lies in two that have to part cannot stay in both: lets it go from the one whose edge is nearer. conflict[k]:
 * the relation of pair k keeps two bodies from standing as they do. */
sunder_status sunder_i_keep_choose(sunder_i_town *town, const sunder_i_relations *relations, const bool *conflict,
                                   sunder_error *err);

#endif
