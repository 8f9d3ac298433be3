/* The sum of a set of several polygons with one polygon, member by member as far as these are apart or trace well. */
#ifndef SUNDER_I_MEMBERS_H
#define SUNDER_I_MEMBERS_H

#include "shape/shape.h"
#include "sum/sum_value.h"

/* Those that are left for the general road. */
typedef struct sunder_i_members_left {
    bool *polygon; /* [polygons of the set], or NULL: all are */
    size_t n;
} sunder_i_members_left;

/* Traces, by the convolution, the sums with `one` of those members of the set `many` whose sums touch no other
 * member's, or only few. The result goes into an empty sum that stands on a lattice that both operands are placed on.
 * *left: the members left out; their sums are disjoint from what is traced. If all are left out the sum stays empty.
 * Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_members_sum(sunder_sum *sum, const sunder_shape *many, const sunder_i_point *at_many,
                                   const sunder_shape *one, const sunder_i_point *at_one, sunder_i_members_left *left,
                                   sunder_error *err);

/* The set as it is, with the pieces of those polygons only; it lends all but the lists of pieces. False if memory is
 * out. */
bool sunder_i_members_view_init(const sunder_shape *many, const bool *polygon, sunder_shape *view);
void sunder_i_members_view_free(sunder_shape *view);

#endif
