/* Costs of choices: vectors with a number for each class, the most important class first. */
#ifndef SUNDER_I_COST_VECTORS_H
#define SUNDER_I_COST_VECTORS_H

#include <stddef.h>
#include <stdint.h>

/* Compares two vectors of n numbers lexicographically. */
static inline int sunder_i_costs_cmp(const int64_t *p, const int64_t *q, size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
    return 0;
}

/* Adds sign * term to the sum. */
static inline void sunder_i_costs_add(int64_t *sum, const int64_t *term, int64_t sign, size_t n)
{
    for (size_t k = 0; k < n; k++) sum[k] += sign * term[k];
}

#endif
