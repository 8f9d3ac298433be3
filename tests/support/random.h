/* A small generator of pseudo-random numbers (splitmix64), with the same numbers on every machine; and the two
 * variables that control random tests. */
#ifndef SUNDER_TESTS_RANDOM_H
#define SUNDER_TESTS_RANDOM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct rng {
    uint64_t state;
} rng;

/* The value of SUNDER_SEED, or 1. */
uint64_t test_seed(void);
/* n times SUNDER_TEST_SCALE (1 unless set; fractions are fine), at least 1. */
size_t test_count(size_t n);

/* The random numbers of case i of a run with this seed. */
rng rng_start(uint64_t seed, uint64_t i);
uint64_t rng_next(rng *r);
/* Uniform in low..high, both included. */
int64_t rng_int(rng *r, int64_t low, int64_t high);
/* True with the probability 1 / n. */
bool rng_once_in(rng *r, int n);
/* Uniform in [0, 1). */
double rng_unit(rng *r);

#endif
