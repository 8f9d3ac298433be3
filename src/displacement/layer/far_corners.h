/* Bodies with corners that are far out of proportion to the rest of the body; see far_corners.c. */
#ifndef SUNDER_I_FAR_CORNERS_H
#define SUNDER_I_FAR_CORNERS_H

#include "displacement/layer/model.h"

/* Sets the body's origin, its reach, and `far`: whether it has far corners. */
void sunder_i_find_far_corners(const sunder_i_model *model, sunder_i_body *body);
/* The most corners that replace one corner of a body with far corners. */
#define SUNDER_I_FAR_MOST 6
/* Writes to `out`, which has room for SUNDER_I_FAR_MOST corners, what replaces corner k of piece p of a shape in a body
 * with far corners, relative to the body's origin, and returns the number of corners written. Together, what replaces
 * the corners of a piece one after the other is a convex piece of at least one corner. */
size_t sunder_i_far_corner(const sunder_i_body *body, const sunder_shape *shape, uint32_t p, uint32_t k, double *out);
/* Replaces the n corners of a convex set, as given, by their substitutes relative to the body's origin. The body has
 * far corners. */
void sunder_i_draw_in(const sunder_i_body *body, double *corner, uint32_t n);

/* Makes n corners of a convex set relative to the body's origin, whether it has far corners or not. */
static inline void sunder_i_reckon_from_origin(const sunder_i_body *body, double *corner, uint32_t n)
{
    if (body->far)
        sunder_i_draw_in(body, corner, n);
    else
        for (uint32_t k = 0; k < 2 * n; k++) corner[k] = sunder_i_from_origin(body, corner[k], k & 1);
}

#endif
