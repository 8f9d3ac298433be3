/* path_length.h: the length of a path, a sum of square roots, with a given number of bits or rounded once to a
 * double. */
#ifndef SUNDER_I_PATH_LENGTH_H
#define SUNDER_I_PATH_LENGTH_H

#include "motion/filtered_point.h"

/* A path through n positions. Its elements node[0 .. n - 1] are node numbers, or position numbers if place_of is
 * NULL. */
typedef struct sunder_i_path {
    const sunder_i_filtered_point *place;
    const uint32_t *place_of; /* the position of each node; NULL: `node` holds positions */
    const uint32_t *node;
    size_t n;
} sunder_i_path;

/* Returns the number of fractional bits with which the path's length has about 320 significant bits; at least 64. */
unsigned long sunder_i_path_length_bits(const sunder_i_filter *filter, sunder_i_arena *arena,
                                        const sunder_i_path *path);

/* Returns 2^bits times the length of the path on the lattice, too small by less than 2 for each leg. Memory is from the
 * arena. */
sunder_i_big sunder_i_path_length_scaled(sunder_i_arena *arena, const sunder_i_path *path, unsigned long bits);

/* Returns the length of the path in units of the input, rounded to the nearest double. NaN if out of memory. */
double sunder_i_path_length(const sunder_i_filter *filter, const sunder_i_path *path);

#endif
