/* list.c: lists of numbers, ascending sets of numbers, and binary search. */
#include "base/list.h"

#include <stdlib.h>
#include <string.h>

bool sunder_i_list_copy(sunder_i_list *list, const sunder_i_list *from)
{
    if (from->n == 0) return true;
    list->item = sunder_i_alloc(from->n, sizeof *list->item);
    if (!list->item) return false;
    memcpy(list->item, from->item, from->n * sizeof *list->item);
    list->n = list->capacity = from->n;
    return true;
}

int sunder_i_by_number(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return *p < *q ? -1 : *p > *q;
}

/* Most sets have a dozen numbers, for which qsort() with its calls takes several times as long. */
enum { FEW = 24 };

static void sort_numbers(uint32_t *number, size_t n)
{
    if (n > FEW) {
        qsort(number, n, sizeof *number, sunder_i_by_number);
        return;
    }
    for (size_t k = 1; k < n; k++) {
        const uint32_t item = number[k];
        size_t at = k;
        for (; at > 0 && number[at - 1] > item; at--) number[at] = number[at - 1];
        number[at] = item;
    }
}

size_t sunder_i_set_make(uint32_t *number, size_t n)
{
    size_t out = 0;
    sort_numbers(number, n);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || number[k] != number[out - 1]) number[out++] = number[k];
    return out;
}

bool sunder_i_set_has(const uint32_t *set, size_t n, uint32_t number)
{
    return n && bsearch(&number, set, n, sizeof *set, sunder_i_by_number);
}

int sunder_i_by_id_pair(const void *a, const void *b)
{
    uint32_t p[2], q[2];
    memcpy(p, a, sizeof p);
    memcpy(q, b, sizeof q);
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return p[1] < q[1] ? -1 : p[1] > q[1];
}

static int compare_numbers(const void *a, const void *b, size_t n)
{
    uint32_t p[4], q[4];
    size_t k = 0;
    memcpy(p, a, n * sizeof *p);
    memcpy(q, b, n * sizeof *q);
    while (k < n && p[k] == q[k]) k++;
    return k == n ? 0 : p[k] < q[k] ? -1 : 1;
}

int sunder_i_by_id_triple(const void *a, const void *b) { return compare_numbers(a, b, 3); }

int sunder_i_by_id_quadruple(const void *a, const void *b) { return compare_numbers(a, b, 4); }

size_t sunder_i_lower_bound(const void *key, const void *item, size_t n, size_t size,
                            int (*order)(const void *, const void *))
{
    size_t low = 0, high = n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (order((const char *)item + middle * size, key) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}
