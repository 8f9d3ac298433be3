/* See measures.h. */
#include "displacement/solve/search/measures.h"
#include "displacement/solve/search/tuning.h"

#include "base/memory.h"
#include "base/mix.h"

#include <string.h>

void sunder_i_measures_free(sunder_i_measures *measures)
{
    sunder_i_free(measures->slot);
    memset(measures, 0, sizeof *measures);
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
    const uint64_t h = sunder_i_mix(sunder_i_mix((uint64_t)i << 32 | j, u[0]), u[1]);
    return &measures->slot[(size_t)(h >> 32) & (measures->slots - 1)];
}
