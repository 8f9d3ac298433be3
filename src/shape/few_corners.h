/* What is the same for all rings of so few corners, and so is kept once. */
#ifndef SUNDER_I_FEW_CORNERS_H
#define SUNDER_I_FEW_CORNERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Buildings have more corners seldom. */
#define SUNDER_I_FEW_CORNERS 16

/* A ring of n corners, 3 to SUNDER_I_FEW_CORNERS, numbered from 0 along it. */
typedef struct sunder_i_few_corners {
    const uint32_t *next, *prev, *corner; /* [n]; corner[k] = k */
    const bool *unshared;                 /* [n] false */
} sunder_i_few_corners;

sunder_i_few_corners sunder_i_few_corners_of(uint32_t n);
/* The number n by itself, at most SUNDER_I_FEW_CORNERS + 1, as an array of one. */
const uint32_t *sunder_i_few(uint32_t n);
const size_t *sunder_i_few_long(size_t n);

#endif
