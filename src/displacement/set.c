/* Ascending sets of numbers, as arrays. */
#include "displacement/displacement.h"

#include <stdlib.h>

int sunder_i_by_number(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return *p < *q ? -1 : *p > *q;
}

size_t sunder_i_set_make(uint32_t *number, size_t n)
{
    size_t out = 0;
    if (n) qsort(number, n, sizeof *number, sunder_i_by_number);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || number[k] != number[out - 1]) number[out++] = number[k];
    return out;
}

bool sunder_i_set_has(const uint32_t *set, size_t n, uint32_t number)
{
    return n && bsearch(&number, set, n, sizeof *set, sunder_i_by_number);
}
