/* What pairs of bodies miss at relative positions, were none of them relaxed, kept at hand. A pair that stands as it
 * stood misses what it missed: a descent looks where its program ends, looks there once more, and begins the next round
 * there; and while bodies are put elsewhere by turns all others stand as they did. */
#ifndef SUNDER_I_MEASURES_H
#define SUNDER_I_MEASURES_H

#include <stddef.h>
#include <stdint.h>

typedef struct sunder_i_measure {
    uint32_t i, j; /* alike: nobody's */
    double u[2];   /* of j from i */
    double missed;
    uint64_t steps; /* that it took to find: counted again, so that what is kept changes no result */
} sunder_i_measure;

/* A table that forgets what another is put in the place of. A zeroed struct is empty. */
typedef struct sunder_i_measures {
    sunder_i_measure *slot;
    size_t slots; /* 0, or a power of two */
} sunder_i_measures;

void sunder_i_measures_free(sunder_i_measures *measures);
/* The slot of bodies i and j, of so many, at u: it holds them, or is theirs to fill. NULL if memory is out. */
sunder_i_measure *sunder_i_measures_slot(sunder_i_measures *measures, size_t bodies, uint32_t i, uint32_t j,
                                         const double u[2]);

static inline int sunder_i_measure_is_of(const sunder_i_measure *m, uint32_t i, uint32_t j, const double u[2])
{
    return m->i == i && m->j == j && m->u[0] == u[0] && m->u[1] == u[1] && i != j;
}

#endif
