/* From convex parts to the outline of their union: lines, cells, coverage, boundary, one after the other. */
#ifndef SUNDER_I_OUTLINE_H
#define SUNDER_I_OUTLINE_H

#include "outline/coverage.h"

/* Fills the outline of an empty sum, which owns the lattice that the parts stand on.
 *
 * keep     NULL, or is called with the coverage while there is one.
 * Fails    SUNDER_ENOMEM, SUNDER_ECANCEL; the caller frees the sum. */
sunder_status sunder_i_outline_find(const sunder_i_convex_pieces *parts, const sunder_sum_options *options,
                                    sunder_status (*keep)(sunder_i_coverage *coverage, void *user,
                                                          sunder_error *err),
                                    void *user, sunder_sum *sum, sunder_error *err);

#endif
