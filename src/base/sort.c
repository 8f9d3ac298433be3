/* sort.c: merge sort: runs sorted by insertion, merged pairwise between two arrays. Radix sort: from the lowest digit
 * to the highest; each digit begins at a bit in which not all keys agree. */
#include "base/sort.h"

#include "base/invariant.h"
#include "base/watch.h"

#include <string.h>

#define RUN 8 /* shorter runs are sorted by insertion: fastest between 6 and 12, by measurement */

typedef int (*comparison)(void *, uint32_t, uint32_t);

static void insert_indices(uint32_t *index, size_t n, comparison compare, void *context)
{
    for (size_t i = 1; i < n; i++) {
        const uint32_t v = index[i];
        size_t j = i;
        for (; j > 0 && compare(context, index[j - 1], v) > 0; j--) index[j] = index[j - 1];
        index[j] = v;
    }
}

static void merge_runs(const uint32_t *from, uint32_t *to, size_t left, size_t middle, size_t right, comparison compare,
                       void *context)
{
    size_t i = left, j = middle;
    for (size_t k = left; k < right; k++)
        to[k] = j >= right || (i < middle && compare(context, from[i], from[j]) <= 0) ? from[i++] : from[j++];
}

bool sunder_i_sort_indices(uint32_t *index, size_t n, comparison compare, void *context)
{
    for (size_t i = 0; i < n; i += RUN) insert_indices(index + i, n - i < RUN ? n - i : RUN, compare, context);
    if (n <= RUN) return true;
    uint32_t *scratch = sunder_i_alloc(n, sizeof *scratch);
    if (!scratch) return false;
    uint32_t *from = index, *to = scratch;
    for (size_t width = RUN; width < n; width *= 2) {
        for (size_t left = 0; left < n; left += 2 * width) {
            const size_t middle = left + width < n ? left + width : n;
            const size_t right = left + 2 * width < n ? left + 2 * width : n;
            if (!sunder_i_steps((right - left) / 8 + 1)) {
                sunder_i_free(scratch);
                return false;
            }
            merge_runs(from, to, left, middle, right, compare, context);
        }
        uint32_t *t = from;
        from = to;
        to = t;
    }
    if (from != index) memcpy(index, from, n * sizeof *index);
    sunder_i_free(scratch);
    return true;
}

/* The bits of a digit: a pass counts 2^DIGIT values whatever the number of keys, so that a few hundred keys are sorted
 * with short digits, and fewer keys by insertion. */
#define DIGIT 11
#define SHORT_DIGIT 8
#define SOME_KEYS 2048 /* from this number of keys on the longer digits are faster, by measurement */
#define FEW_KEYS 32

static void sort_few(uint64_t *key, size_t n)
{
    for (size_t i = 1; i < n; i++) {
        const uint64_t v = key[i];
        size_t k = i;
        for (; k > 0 && key[k - 1] > v; k--) key[k] = key[k - 1];
        key[k] = v;
    }
}

bool sunder_i_sort_keys(uint64_t *key, size_t n)
{
    uint64_t used = 0;
    for (size_t i = 1; i < n; i++) used |= key[i] ^ key[0];
    if (used == 0) return true;
    if (n <= FEW_KEYS) {
        sort_few(key, n);
        return true;
    }
    uint64_t *scratch = sunder_i_alloc(n, sizeof *scratch);
    if (!scratch) return false;
    uint64_t *from = key, *to = scratch;
    const int bits = n < SOME_KEYS ? SHORT_DIGIT : DIGIT;
    const uint64_t digit = ((uint64_t)1 << bits) - 1;
    for (int shift = 0; shift < 64 && used >> shift; shift += bits) {
        shift += __builtin_ctzll(used >> shift); /* all keys agree in the bits that are skipped */
        size_t start[(1u << DIGIT) + 1];
        memset(start, 0, (digit + 2) * sizeof *start);
        for (size_t i = 0; i < n; i++) start[((from[i] >> shift) & digit) + 1]++;
        for (size_t d = 0; d <= digit; d++) start[d + 1] += start[d];
        for (size_t i = 0; i < n; i++) to[start[(from[i] >> shift) & digit]++] = from[i];
        uint64_t *t = from;
        from = to;
        to = t;
        sunder_i_steps(n / 32);
    }
    if (from != key) memcpy(key, from, n * sizeof *key);
    for (size_t i = 1; i < n; i++) SUNDER_I_ASSERT(key[i - 1] <= key[i]);
    sunder_i_free(scratch);
    return true;
}

int sunder_i_descending(void *doubles, uint32_t a, uint32_t b)
{
    const double *v = doubles;
    return (v[a] < v[b]) - (v[a] > v[b]);
}

static void insert_valued(sunder_i_valued *k, size_t n)
{
    for (size_t i = 1; i < n; i++) {
        const sunder_i_valued v = k[i];
        size_t j = i;
        for (; j > 0 && k[j - 1].value > v.value; j--) k[j] = k[j - 1];
        k[j] = v;
    }
}

static void merge_valued(const sunder_i_valued *from, sunder_i_valued *to, size_t left, size_t middle, size_t right)
{
    size_t i = left, j = middle, k = left;
    while (i < middle && j < right) {
        const bool second = from[j].value < from[i].value;
        to[k++] = from[second ? j : i];
        j += second;
        i += !second;
    }
    memcpy(to + k, from + i, (middle - i) * sizeof *to);
    memcpy(to + k + (middle - i), from + j, (right - j) * sizeof *to);
}

bool sunder_i_sort_valued(sunder_i_valued *valued, size_t n)
{
    for (size_t i = 0; i < n; i += RUN) insert_valued(valued + i, n - i < RUN ? n - i : RUN);
    sunder_i_valued *from = valued, *to = valued + n;
    for (size_t width = RUN; width < n; width *= 2) {
        for (size_t left = 0; left < n; left += 2 * width) {
            const size_t middle = left + width < n ? left + width : n;
            const size_t right = left + 2 * width < n ? left + 2 * width : n;
            if (!sunder_i_steps((right - left) / 8 + 1)) return false;
            merge_valued(from, to, left, middle, right);
        }
        sunder_i_valued *t = from;
        from = to;
        to = t;
    }
    if (from != valued) memcpy(valued, from, n * sizeof *valued);
    return true;
}
