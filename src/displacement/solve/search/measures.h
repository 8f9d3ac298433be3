/* A cache of the violations of pairs at relative positions, as if none were relaxed. A pair at an unchanged relative
 * position has an unchanged violation: a descent evaluates where its program ends, evaluates there once more, and
 * begins the next round there. While bodies are moved one at a time all others stay in place. */
#ifndef SUNDER_I_MEASURES_H
#define SUNDER_I_MEASURES_H

#include <stddef.h>
#include <stdint.h>

typedef struct sunder_i_measure {
    uint32_t i, j; /* i == j: unused */
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
/* The slot of bodies i and j, of `bodies` bodies, at u: it holds their value, or the caller fills it. NULL if memory is
 * out. */
sunder_i_measure *sunder_i_measures_slot(sunder_i_measures *measures, size_t bodies, uint32_t i, uint32_t j,
                                         const double u[2]);

static inline int sunder_i_measure_is_of(const sunder_i_measure *m, uint32_t i, uint32_t j, const double u[2])
{
    return m->i == i && m->j == j && m->u[0] == u[0] && m->u[1] == u[1] && i != j;
}

#endif
