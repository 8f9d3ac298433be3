/* mix.h: mixes numbers into one hash, which determines a position in a table. */
#ifndef SUNDER_I_MIX_H
#define SUNDER_I_MIX_H

#include <stdint.h>
#include <string.h>

#define SUNDER_I_MIXER UINT64_C(0x9e3779b97f4a7c15) /* odd, with bits without a pattern */

/* Returns the hash so_far after mixing in the bits of one more double; the upper half of the result is mixed best. */
static inline uint64_t sunder_i_mix(uint64_t so_far, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    so_far = (so_far ^ bits) * SUNDER_I_MIXER;
    return so_far ^ so_far >> 32;
}

#endif
