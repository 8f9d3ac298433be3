/* keyed_sort.c: see keyed_sort.h. Radix sort from the lowest digit up; digits in which all keys agree are skipped.
 * qsort() would call a comparison twenty times for each of a million elements. */
#include "base/keyed_sort.h"

#include <stdlib.h>
#include <string.h>

/* The counters of one digit fit into the first-level cache. */
enum { DIGIT = 11, DIGITS = 1 << DIGIT, BITS = 64 };

static size_t digit_of(const gis_keyed *one, int shift) { return (size_t)(one->key >> shift) & (DIGITS - 1); }

/* Computes for each digit the position of its first element. */
static void count_digits(const gis_keyed *from, size_t n, int shift, size_t start[DIGITS])
{
    memset(start, 0, DIGITS * sizeof *start);
    for (size_t i = 0; i < n; i++) start[digit_of(&from[i], shift)]++;
    size_t before = 0;
    for (size_t d = 0; d < DIGITS; d++) {
        const size_t here = start[d];
        start[d] = before;
        before += here;
    }
}

bool gis_keyed_sort(gis_keyed *list, size_t n)
{
    uint64_t differ = 0;
    bool sorted = true;
    for (size_t i = 1; i < n; i++) {
        differ |= list[i].key ^ list[0].key;
        sorted = sorted && list[i - 1].key <= list[i].key;
    }
    if (sorted) return true;
    gis_keyed *scratch = malloc(n * sizeof *scratch), *from = list, *to = scratch;
    if (!scratch) return false;
    for (int shift = 0; shift < BITS; shift += DIGIT) {
        size_t start[DIGITS];
        if (((differ >> shift) & (DIGITS - 1)) == 0) continue;
        count_digits(from, n, shift, start);
        for (size_t i = 0; i < n; i++) to[start[digit_of(&from[i], shift)]++] = from[i];
        gis_keyed *swap = from;
        from = to;
        to = swap;
    }
    if (from != list) memcpy(list, from, n * sizeof *list);
    free(scratch);
    return true;
}
