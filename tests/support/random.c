#include "random.h"

#include <stdlib.h>

uint64_t test_seed(void)
{
    const char *s = getenv("SUNDER_SEED");
    return s && *s ? strtoull(s, NULL, 0) : 1;
}

size_t test_count(size_t n)
{
    const char *s = getenv("SUNDER_TEST_SCALE");
    const double scale = s && *s ? strtod(s, NULL) : 1;
    const double count = (double)n * scale;
    return count >= 1 ? (size_t)count : 1;
}

rng rng_start(uint64_t seed, uint64_t i)
{
    rng r = {seed * 0x9E3779B97F4A7C15u + i * 0xD1B54A32D192ED03u};
    rng_next(&r);
    return r;
}

uint64_t rng_next(rng *r)
{
    uint64_t z = r->state += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

/* The modulus is biased by less than 2^-32 for the spans in use. */
int64_t rng_int(rng *r, int64_t low, int64_t high) { return low + (int64_t)(rng_next(r) % (uint64_t)(high - low + 1)); }

bool rng_once_in(rng *r, int n) { return rng_int(r, 1, n) == 1; }

double rng_unit(rng *r) { return (double)(rng_next(r) >> 11) * 0x1p-53; }
