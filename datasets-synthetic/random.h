/* A small generator of random numbers with the same values on every machine.
 *
 * SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): a counter and a mixing function. A stream is identified by a hash of
 * its use (seed, column, row, purpose), so every block of the town can be drawn by itself, in any order. Each draw is a
 * statement of its own, since C does not specify the order in which arguments of a call are evaluated. */
#ifndef TOWN_RANDOM_H
#define TOWN_RANDOM_H

#include <stdbool.h>
#include <stdint.h>

typedef struct town_random {
    uint64_t state;
} town_random;

/* Returns the stream for one purpose at one place of the town. */
town_random town_random_at(uint64_t seed, int64_t column, int64_t row, uint64_t purpose);

uint64_t town_random_next(town_random *random);

/* Uniform in [low, high): 53 bits, so exactly the same double everywhere. */
double town_random_between(town_random *random, double low, double high);

/* Uniform in 0 .. n - 1 (up to a bias of n / 2^64). */
unsigned town_random_below(town_random *random, unsigned n);

bool town_random_chance(town_random *random, double probability);

#endif
