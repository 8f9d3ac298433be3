/* The outlines of blocks, without the walls between their members. */
#ifndef SUNDER_I_BLOCK_OUTLINE_H
#define SUNDER_I_BLOCK_OUTLINE_H

#include "displacement/layer/model.h"

#define SUNDER_I_NO_SIDE UINT32_MAX

/* A straight part of the outline of a body: one edge of a member, a part of it, or several in one line. The body lies
 * on its left. */
typedef struct sunder_i_block_side {
    double from[2], to[2];
    uint32_t next, last; /* the side that goes on from `to`, and the one that leads to `from`; SUNDER_I_NO_SIDE: none is
                          * near */
} sunder_i_block_side;

/* The sides of one body. */
typedef struct sunder_i_block_outline {
    sunder_i_block_side *side;
    size_t n, room;
    double margin; /* what is nearer than this to a line counts as on it: some ten units in the last place */
} sunder_i_block_outline;

/* Finds the outline of a body whose members have the shapes shape[f], by feature; in doubles. A part of an edge belongs
 * to it unless another member's edge runs along it in the other direction no farther than the touch tolerance, or it
 * lies inside of another member. What `out` holds is replaced. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_block_outline_find(const sunder_i_model *model, const sunder_i_body *body,
                                          const sunder_shape *const *shape, sunder_i_block_outline *out,
                                          sunder_error *err);
void sunder_i_block_outline_free(sunder_i_block_outline *outline);

#endif
