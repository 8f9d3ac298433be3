/* Bodies with corners out of all proportion to where the rest of them is; see far_corners.c. */
#ifndef SUNDER_I_FAR_CORNERS_H
#define SUNDER_I_FAR_CORNERS_H

#include "displacement/layer/model.h"

/* Sets the body's origin, its reach, and whether it has far corners. */
void sunder_i_find_far_corners(const sunder_i_model *model, sunder_i_body *body);
/* What corner k of a shape's pieces, which is one of piece p, becomes from the origin of its body, which has far ones:
 * returns how many corners. out: room for two; of a whole piece there is one more than it has, or fewer. */
size_t sunder_i_far_corner(const sunder_i_body *body, const sunder_shape *shape, uint32_t p, uint32_t k, double *out);
/* The same in place of n corners of one convex set as given. */
void sunder_i_draw_in(const sunder_i_body *body, double *corner, uint32_t n);

/* The same of any body. */
static inline void sunder_i_reckon_from_origin(const sunder_i_body *body, double *corner, uint32_t n)
{
    if (body->far)
        sunder_i_draw_in(body, corner, n);
    else
        for (uint32_t k = 0; k < 2 * n; k++) corner[k] = sunder_i_from_origin(body, corner[k], k & 1);
}

#endif
