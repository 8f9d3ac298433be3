/* The supporting lines of candidate sides, each once. */
#ifndef SUNDER_I_LINES_H
#define SUNDER_I_LINES_H

#include "minkowski/coverage.h"

/* line_of[side] for every live candidate; others are untouched. The lines found are added to out. False if memory is out. */
bool sunder_i_lines_group(const sunder_i_subsums *subsums, const bool *live, uint32_t *line_of,
                          sunder_i_coverage *out);

#endif
