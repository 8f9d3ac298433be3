/* A cache of the violations of pairs of bodies, by relative position, as if no pair were relaxed. Many relative
 * positions recur: the layout in which a program ends is evaluated again, and the next round begins there; and while
 * one body is tried elsewhere, all other pairs keep their relative position. */
#ifndef SUNDER_I_MEASURES_H
#define SUNDER_I_MEASURES_H

#include <stddef.h>
#include <stdint.h>

typedef struct sunder_i_measure {
    uint32_t i, j; /* the bodies; i == j: the slot is unused */
    double u[2];   /* position of j relative to i */
    double missed;
    uint64_t steps; /* the work of computing it, which is counted again, so that the cache does not change the remaining
                     * effort */
} sunder_i_measure;

/* A hash table in which a new entry replaces an old one in its slot. A zeroed struct is empty. */
typedef struct sunder_i_measures {
    sunder_i_measure *slot;
    size_t slots; /* 0, or a power of two */
} sunder_i_measures;

void sunder_i_measures_free(sunder_i_measures *measures);
/* The slot for bodies i and j at relative position u. It holds their value (sunder_i_measure_is_of()), or the caller
 * fills it. `bodies` determines the size of the table. NULL if memory is out. */
sunder_i_measure *sunder_i_measures_slot(sunder_i_measures *measures, size_t bodies, uint32_t i, uint32_t j,
                                         const double u[2]);

/* Does the slot hold the value of bodies i and j at relative position u? */
static inline int sunder_i_measure_is_of(const sunder_i_measure *m, uint32_t i, uint32_t j, const double u[2])
{
    return m->i == i && m->j == j && m->u[0] == u[0] && m->u[1] == u[1] && i != j;
}

#endif
