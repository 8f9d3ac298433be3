/* strips.c: a counting sort of spans by the strips that they meet. */
#include "spatial/strips.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* The largest number of strips: with more the array of their ends costs more than shorter lists save. */
#define MOST_STRIPS (1u << 20)
/* An item is in at most this number of strips on average, which bounds the memory. */
#define ENTRIES_EACH 8

/* Returns the strip of a height. Monotone: the order of heights is that of strips. */
static uint32_t strip_of(const sunder_i_strips *s, double height)
{
    const double k = (height - s->low) * s->per_unit;
    return !(k > 0) ? 0 : k < s->n ? (uint32_t)k : s->n - 1;
}

/* Chooses the number of strips: the largest permitted, or half of that, and so on. Returns the number of entries. */
static size_t choose_count(sunder_i_strips *s, const double (*span)[2], size_t n, size_t most, double high)
{
    size_t entries;
    if (most > n) most = n;
    for (s->n = most < MOST_STRIPS ? (uint32_t)most + 1 : MOST_STRIPS;; s->n /= 2) {
        const double height = high - s->low;
        s->per_unit = height > 0 && isfinite(height) ? s->n / height : 0;
        entries = 0;
        for (size_t i = 0; i < n; i++) entries += strip_of(s, span[i][1]) - strip_of(s, span[i][0]) + 1;
        if (s->n == 1 || entries <= ENTRIES_EACH * n) return entries;
    }
}

bool sunder_i_strips_build(sunder_i_strips *strips, const double (*span)[2], size_t n, size_t most)
{
    double high = -INFINITY;
    memset(strips, 0, sizeof *strips);
    strips->low = INFINITY;
    for (size_t i = 0; i < n; i++) {
        if (span[i][0] < strips->low) strips->low = span[i][0];
        if (span[i][1] > high) high = span[i][1];
    }
    const size_t entries = choose_count(strips, span, n, most, high);
    strips->end = sunder_i_calloc((size_t)strips->n + 1, sizeof *strips->end);
    strips->item = sunder_i_alloc(entries, sizeof *strips->item);
    if (!strips->end || !strips->item) return false;
    /* Counts are stored one index higher; the prefix sum gives the beginning of each strip, which filling increases to
     * its end. */
    for (size_t i = 0; i < n; i++)
        for (uint32_t k = strip_of(strips, span[i][0]), last = strip_of(strips, span[i][1]); k <= last; k++)
            strips->end[k + 1]++;
    for (uint32_t k = 0; k < strips->n; k++) strips->end[k + 1] += strips->end[k];
    for (size_t i = 0; i < n; i++)
        for (uint32_t k = strip_of(strips, span[i][0]), last = strip_of(strips, span[i][1]); k <= last; k++)
            strips->item[strips->end[k]++] = (uint32_t)i;
    return true;
}

void sunder_i_strips_free(sunder_i_strips *strips)
{
    sunder_i_free_all(strips->end, strips->item);
    memset(strips, 0, sizeof *strips);
}

void sunder_i_strips_at(const sunder_i_strips *strips, double height, size_t *from, size_t *to)
{
    const uint32_t k = strip_of(strips, height);
    *from = k ? strips->end[k - 1] : 0;
    *to = strips->end[k];
}
