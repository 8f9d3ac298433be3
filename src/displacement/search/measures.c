/* See measures.h. */
#include "displacement/search/measures.h"
#include "displacement/search/tuning.h"

#include "base/memory.h"

#include <string.h>

void sunder_i_measures_free(sunder_i_measures *measures)
{
    sunder_i_free(measures->slot);
    memset(measures, 0, sizeof *measures);
}

static uint64_t mix(uint64_t so_far, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    so_far = (so_far ^ bits) * UINT64_C(0x9e3779b97f4a7c15); /* odd, its bits without pattern */
    return so_far ^ so_far >> 32;
}

sunder_i_measure *sunder_i_measures_slot(sunder_i_measures *measures, size_t bodies, uint32_t i, uint32_t j,
                                         const double u[2])
{
    if (!measures->slot) {
        size_t slots = FEWEST_MEASURES;
        while (slots < MEASURES_EACH * bodies && slots < MOST_MEASURES) slots *= 2;
        measures->slot = sunder_i_calloc(slots, sizeof *measures->slot);
        if (!measures->slot) return NULL;
        measures->slots = slots;
    }
    const uint64_t h = mix(mix((uint64_t)i << 32 | j, u[0]), u[1]);
    return &measures->slot[(size_t)(h >> 32) & (measures->slots - 1)];
}
