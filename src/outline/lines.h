/* The supporting lines of candidate sides, each once. */
#ifndef SUNDER_I_LINES_H
#define SUNDER_I_LINES_H

#include "convex/pieces.h"

#define SUNDER_I_NO_LINE UINT32_MAX

typedef struct sunder_i_supporting_line {
    sunder_i_point a, b; /* b - a is the direction of the class */
    uint32_t class;
} sunder_i_supporting_line;

typedef struct sunder_i_lines {
    sunder_i_supporting_line *line;
    uint32_t n;
    uint32_t *of; /* [sides] the line of each candidate; SUNDER_I_NO_LINE for the other sides */
} sunder_i_lines;

/* Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_lines_group(const sunder_i_convex_pieces *parts, sunder_i_lines *out, sunder_error *err);
void sunder_i_lines_free(sunder_i_lines *lines);

#endif
