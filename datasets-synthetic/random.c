#include "random.h"

static uint64_t mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

uint64_t town_random_next(town_random *random)
{
    random->state += UINT64_C(0x9e3779b97f4a7c15);
    return mix(random->state);
}

town_random town_random_at(uint64_t seed, int64_t column, int64_t row, uint64_t purpose)
{
    uint64_t h = mix(seed + UINT64_C(0x9e3779b97f4a7c15));
    h = mix(h ^ ((uint64_t)column * UINT64_C(0xd6e8feb86659fd93)));
    h = mix(h ^ ((uint64_t)row * UINT64_C(0xa0761d6478bd642f)));
    return (town_random){mix(h ^ (purpose * UINT64_C(0xe7037ed1a0b428db)))};
}

double town_random_between(town_random *random, double low, double high)
{
    return low + (high - low) * ((double)(town_random_next(random) >> 11) * 0x1p-53);
}

unsigned town_random_below(town_random *random, unsigned n)
{
    return (unsigned)(((town_random_next(random) >> 32) * n) >> 32);
}

bool town_random_chance(town_random *random, double probability)
{
    return town_random_between(random, 0, 1) < probability;
}
