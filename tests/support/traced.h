/* Sums traced along outlines, by a direct call of one algorithm, so that the general one cannot replace it. */
#ifndef SUNDER_TESTS_TRACED_H
#define SUNDER_TESTS_TRACED_H

#include "polyset.h"
#include "shape/shape.h"

/* sunder_i_convolution_sum() or sunder_i_reduced_convolution_sum(). */
typedef sunder_status tracing(sunder_sum *sum, const sunder_shape *p, const sunder_i_point *at_p, const sunder_shape *q,
                              const sunder_i_point *at_q, bool *done, sunder_error *error);

/* Returns the canonical text of the traced sum, freed by the caller; NULL if tracing declines, and then the sum must be
 * unchanged. Adds the number of holes to *holes, unless it is NULL. */
char *traced_text(tracing *trace, const polyset *p, const polyset *q, size_t *holes);

#endif
