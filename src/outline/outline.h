/* outline.h: computes the outline of the union of convex parts: lines, cells, coverage and boundary, one after the
 * other. */
#ifndef SUNDER_I_OUTLINE_H
#define SUNDER_I_OUTLINE_H

#include "outline/coverage.h"

/* Sets the outline of an empty sum, which owns the lattice of the parts.
 *
 * keep     NULL, or a function that is called with the coverage while it exists.
 * Fails    with SUNDER_ENOMEM or SUNDER_ECANCEL; the caller frees the sum. */
sunder_status sunder_i_outline_find(const sunder_i_convex_pieces *parts, const sunder_sum_options *options,
                                    sunder_status (*keep)(sunder_i_coverage *coverage, void *user,
                                                          sunder_error *err),
                                    void *user, sunder_sum *sum, sunder_error *err);

#endif
