/* The length of a path: a sum of square roots, to as many bits as are asked for, and rounded once. */
#ifndef SUNDER_I_PATH_LENGTH_H
#define SUNDER_I_PATH_LENGTH_H

#include "motion/filtered_point.h"

/* So many bits behind the point that a length of about `length`, in units of sunder_i_approx(), has 320 significant
 * ones; 64 at least. */
unsigned long sunder_i_path_length_bits(const sunder_i_lattice *lattice, double length);

/* 2^bits times the length of a path on the lattice, less than two a leg too small. The path is of places, or, if
 * place_of is not NULL, of nodes, and place_of tells the place of each. Memory in the arena. */
sunder_i_big sunder_i_path_length_scaled(sunder_i_arena *arena, const sunder_i_filtered_point *place,
                                         const uint32_t *place_of, const uint32_t *path, size_t n, unsigned long bits);

/* The length of a path of places to the nearest double, in units of the input. NaN if memory is out. */
double sunder_i_path_length(const sunder_i_lattice *lattice, const sunder_i_filtered_point *place, const uint32_t *path,
                            size_t n);

#endif
