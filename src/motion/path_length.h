/* The length of a path: a sum of square roots, to as many bits as are asked for, and rounded once. */
#ifndef SUNDER_I_PATH_LENGTH_H
#define SUNDER_I_PATH_LENGTH_H

#include "motion/filtered_point.h"

/* n nodes, or places, one after the other. */
typedef struct sunder_i_path {
    const sunder_i_filtered_point *place;
    const uint32_t *place_of; /* of each node; NULL: the path is of places */
    const uint32_t *node;
    size_t n;
} sunder_i_path;

/* The number of bits behind the point that gives the path's length some 320 significant bits; 64 at least. */
unsigned long sunder_i_path_length_bits(const sunder_i_filter *filter, sunder_i_arena *arena,
                                        const sunder_i_path *path);

/* 2^bits times the length of a path on the lattice, less than two a leg too small. Memory in the arena. */
sunder_i_big sunder_i_path_length_scaled(sunder_i_arena *arena, const sunder_i_path *path, unsigned long bits);

/* The length to the nearest double, in units of the input. NaN if memory is out. */
double sunder_i_path_length(const sunder_i_filter *filter, const sunder_i_path *path);

#endif
