/* Ascending sets of numbers, and of pairs of them, as arrays. */
#include "base/list.h"

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

int sunder_i_by_couple(const void *a, const void *b)
{
    const sunder_i_couple *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

size_t sunder_i_couple_at(const sunder_i_couple *list, size_t n, uint32_t x, uint32_t y)
{
    const sunder_i_couple wanted = x < y ? (sunder_i_couple){x, y} : (sunder_i_couple){y, x};
    const sunder_i_couple *found = n ? bsearch(&wanted, list, n, sizeof *list, sunder_i_by_couple) : NULL;
    return found ? (size_t)(found - list) : n;
}
