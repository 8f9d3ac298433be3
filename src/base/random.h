/* Pseudo-random numbers for orders of insertion: splitmix64 [SLF14]. */
#ifndef SUNDER_I_RANDOM_H
#define SUNDER_I_RANDOM_H

#include <stdint.h>

/* The next number of the stream. */
static inline uint64_t sunder_i_draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

#endif
