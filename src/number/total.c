/* total.c: the public functions of the accumulator: an addend is a product with 1. */
#include "sunder_parts.h"

#include "number/accumulator.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(((sunder_total *)0)->limb) == sizeof(sunder_i_accumulator), "they are the same words");

static sunder_i_accumulator words_of(const sunder_total *total)
{
    sunder_i_accumulator words;
    memcpy(&words, total->limb, sizeof words);
    return words;
}

void sunder_total_add(sunder_total *total, double value)
{
    if (!isfinite(value)) {
        total->beyond += value;
        return;
    }
    sunder_i_accumulator words = words_of(total);
    sunder_i_accumulator_add(&words, value, 1);
    memcpy(total->limb, &words, sizeof words);
}

void sunder_total_join(sunder_total *total, const sunder_total *part)
{
    uint64_t carry = 0;
    for (int i = 0; i < SUNDER_I_ACCUMULATOR_LIMBS; i++) {
        const uint64_t sum = total->limb[i] + part->limb[i];
        const uint64_t more = sum < part->limb[i];
        total->limb[i] = sum + carry;
        carry = more | (total->limb[i] < carry);
    }
    total->beyond += part->beyond;
}

double sunder_total_nearest(const sunder_total *total)
{
    if (total->beyond != 0) return total->beyond; /* NAN differs from 0, too */
    const sunder_i_accumulator words = words_of(total);
    return sunder_i_accumulator_double(&words, 0);
}

double sunder_total_below(const sunder_total *total)
{
    const double nearest = sunder_total_nearest(total);
    if (total->beyond != 0 || nearest == -INFINITY) return nearest;
    if (isinf(nearest)) return nextafter(nearest, 0);
    sunder_i_accumulator rest = words_of(total);
    sunder_i_accumulator_sub(&rest, nearest, 1);
    return sunder_i_accumulator_sign(&rest) < 0 ? nextafter(nearest, -INFINITY) : nearest;
}
