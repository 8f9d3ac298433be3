/* curve.c: sorts along a space-filling curve: neighbours in the order are mostly neighbours in the plane, so that trees
 * over it have small boxes. The order affects speed only, so that doubles are sufficient. */
#include "spatial/curve.h"

#include "base/extremes.h"
#include "base/sort.h"

#include <math.h>
#include <string.h>

/* Interleaves the bits of two 16-bit numbers (Morton order). */
static uint32_t interleave_bits(uint32_t x, uint32_t y)
{
    const uint32_t mask[4] = {0x00ff00ff, 0x0f0f0f0f, 0x33333333, 0x55555555};
    for (int i = 0; i < 4; i++) {
        x = (x | x << (8 >> i)) & mask[i];
        y = (y | y << (8 >> i)) & mask[i];
    }
    return x | y << 1;
}

static uint32_t cell_of(double v, double low, double high)
{
    const double t = (v - low) / (high - low) * 65535;
    return t >= 0 && t <= 65535 ? (uint32_t)t : 0;
}

void sunder_i_curve_sort(const double *xy, const uint32_t *vertex, uint32_t *list, size_t n, sunder_i_arena *arena)
{
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    uint64_t *key = sunder_i_arena_alloc(arena, n, sizeof *key);
    if (!key) return;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 2; k++) {
            const double v = xy[2 * (size_t)vertex[list[i]] + k];
            low[k] = sunder_i_min(low[k], v);
            high[k] = sunder_i_max(high[k], v);
        }
    for (size_t i = 0; i < n; i++) {
        const double *at = xy + 2 * (size_t)vertex[list[i]];
        key[i] =
            (uint64_t)interleave_bits(cell_of(at[0], low[0], high[0]), cell_of(at[1], low[1], high[1])) << 32 | list[i];
    }
    if (!sunder_i_sort_keys(key, n)) {
        arena->failed = true;
        return;
    }
    for (size_t i = 0; i < n; i++) list[i] = (uint32_t)key[i];
    sunder_i_arena_release(arena, mark);
}

bool sunder_i_curve_sort_records(void *record, size_t n, size_t bytes, size_t box)
{
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    double *middle = sunder_i_alloc(2 * n, sizeof *middle);
    uint32_t *number = sunder_i_alloc(n, sizeof *number), *list = sunder_i_alloc(n, sizeof *list);
    char *from = record, *sorted = sunder_i_alloc(n, bytes);
    bool ok = middle && number && list && sorted;
    for (size_t k = 0; ok && k < n; k++) {
        double own[4];
        memcpy(own, from + k * bytes + box, sizeof own);
        for (size_t c = 0; c < 2; c++) middle[2 * k + c] = own[c] / 2 + own[c + 2] / 2;
        number[k] = list[k] = (uint32_t)k;
    }
    if (ok) sunder_i_curve_sort(middle, number, list, n, &arena);
    ok = ok && !arena.failed;
    for (size_t k = 0; ok && k < n; k++) memcpy(sorted + k * bytes, from + list[k] * bytes, bytes);
    if (ok && n) memcpy(from, sorted, n * bytes);
    sunder_i_free_all(middle, number, list, sorted);
    sunder_i_arena_free(&arena);
    return ok;
}
