/* members.h: the sum of a set of several polygons with one polygon, computed polygon by polygon, for those whose sums
 * are disjoint from others or form small groups. */
#ifndef SUNDER_I_MEMBERS_H
#define SUNDER_I_MEMBERS_H

#include "shape/shape.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* The polygons that are left for the general method. */
typedef struct sunder_i_members_left {
    bool *polygon; /* [polygons of the set] whether the polygon is left, or NULL: all are */
    size_t n;
} sunder_i_members_left;

/* Computes, by the convolution, the sums of `one` with those polygons of the set `many` whose sums touch no other
 * polygon's sum, or only few. The result is stored in an empty sum, whose lattice must contain the vertices of both
 * operands. *left becomes the polygons that are omitted; their sums are disjoint from the result. If all are omitted,
 * the sum stays empty. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_members_sum(sunder_sum *sum, const sunder_shape *many, const sunder_i_point *at_many,
                                   const sunder_shape *one, const sunder_i_point *at_one, sunder_i_members_left *left,
                                   sunder_error *err);

/* *view becomes the set with the pieces of only those polygons p with polygon[p]; it borrows everything except the
 * lists of pieces from `many`. Returns false if out of memory. */
bool sunder_i_members_view_init(const sunder_shape *many, const bool *polygon, sunder_shape *view);
void sunder_i_members_view_free(sunder_shape *view);

#endif
