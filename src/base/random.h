/* random.h: pseudo-random numbers for orders of insertion: splitmix64 [SLF14]. Sums do not depend on them; times, and
 * the course of a search, do. So the numbers and their order are part of the contract: one number for each choice, from
 * all n items down to two. */
#ifndef SUNDER_I_RANDOM_H
#define SUNDER_I_RANDOM_H

#include "base/invariant.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Returns the next number of the stream. */
static inline uint64_t sunder_i_draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Swaps a random item with the last of n items of `size` bytes in an array: one step of a Fisher-Yates shuffle from the
 * back. random: a number from sunder_i_draw(). */
static inline void sunder_i_shuffle_step(void *array, size_t n, size_t size, uint64_t random)
{
    unsigned char *const chosen = (unsigned char *)array + (size_t)(random % n) * size;
    unsigned char *const last = (unsigned char *)array + (n - 1) * size, kept[16];
    SUNDER_I_ASSERT(size <= sizeof kept);
    memcpy(kept, chosen, size);
    memmove(chosen, last, size);
    memcpy(last, kept, size);
}

static inline void sunder_i_shuffle(void *array, size_t n, size_t size, uint64_t *state)
{
    for (size_t i = n; i > 1; i--) sunder_i_shuffle_step(array, i, size, sunder_i_draw(state));
}

#endif
