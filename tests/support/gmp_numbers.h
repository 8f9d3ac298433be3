/* Numbers of the library converted to GMP's, for tests that compare the two. */
#ifndef SUNDER_TESTS_GMP_NUMBERS_H
#define SUNDER_TESTS_GMP_NUMBERS_H

#include "number/lattice.h"
#include "random.h"

#include <gmp.h>

void mpz_from_i128(mpz_t r, sunder_i_i128 v);
void mpz_from_i256(mpz_t r, const sunder_i_i256 *v);
void mpz_from_limbs(mpz_t r, const uint64_t *limb, size_t n);
void mpz_from_big(mpz_t r, sunder_i_big v);
sunder_i_big big_from_mpz(sunder_i_arena *arena, const mpz_t v);
/* Is the big integer in canonical form? */
bool big_is_canonical(sunder_i_big v);

/* A random integer of at most `bits` bits and either sign, often a power of two, a neighbour of one, a run of ones, or
 * zero. */
void random_mpz(mpz_t r, rng *g, unsigned bits);
sunder_i_i128 random_i128(rng *g, unsigned bits);

#endif
