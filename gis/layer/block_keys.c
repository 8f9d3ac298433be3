/* block_keys.c: see block_keys.h. Memory depends on the number of distinct keys, not of features. */
#include "layer/block_keys.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>

/* The hash function FNV-1a. */
static size_t hash_key(const char *key)
{
    uint64_t h = UINT64_C(14695981039346656037);
    for (; *key; key++) h = (h ^ (unsigned char)*key) * UINT64_C(1099511628211);
    return (size_t)(h ^ h >> 32);
}

/* The slot of the key, or the empty slot where it would go. */
static size_t find_slot(const gis_block_keys *keys, const char *key)
{
    size_t at = hash_key(key) & (keys->slots - 1);
    while (keys->slot[at] && strcmp(keys->key[keys->slot[at] - 1], key) != 0) at = (at + 1) & (keys->slots - 1);
    return at;
}

/* Grows the table if needed, so that it is at most half full. */
static bool reserve_slots(gis_block_keys *keys)
{
    if (2 * (keys->n + 1) <= keys->slots) return true;
    gis_block_keys larger = *keys;
    larger.slots = keys->slots ? 2 * keys->slots : 64;
    larger.slot = calloc(larger.slots, sizeof *larger.slot);
    if (!larger.slot) return false;
    for (size_t k = 0; k < keys->n; k++) larger.slot[find_slot(&larger, keys->key[k])] = k + 1;
    free(keys->slot);
    *keys = larger;
    return true;
}

bool gis_block_keys_add(gis_block_keys *keys, char *key, int64_t *number, gis_error *error)
{
    if (!reserve_slots(keys) || !gis_array_reserve(&keys->key, &keys->capacity, keys->n + 1, sizeof *keys->key)) {
        free(key);
        return gis_no_memory(error);
    }
    const size_t at = find_slot(keys, key);
    if (keys->slot[at]) {
        free(key);
    } else {
        keys->key[keys->n] = key;
        keys->slot[at] = ++keys->n;
    }
    *number = (int64_t)keys->slot[at] - 1;
    return true;
}

typedef struct numbered {
    const char *key;
    size_t number;
} numbered;

static int compare_keys(const void *a, const void *b)
{
    const numbered *p = a, *q = b;
    return strcmp(p->key, q->key);
}

bool gis_block_keys_rank(gis_block_keys *keys, gis_error *error)
{
    numbered *sorted = malloc((keys->n + 1) * sizeof *sorted);
    free(keys->rank);
    keys->rank = malloc((keys->n + 1) * sizeof *keys->rank);
    const bool done = sorted && keys->rank;
    for (size_t k = 0; done && k < keys->n; k++) sorted[k] = (numbered){keys->key[k], k};
    if (done) qsort(sorted, keys->n, sizeof *sorted, compare_keys);
    for (size_t k = 0; done && k < keys->n; k++) keys->rank[sorted[k].number] = (int64_t)k;
    free(sorted);
    return done || gis_no_memory(error);
}

void gis_block_keys_clear(gis_block_keys *keys)
{
    for (size_t k = 0; k < keys->n; k++) free(keys->key[k]);
    free(keys->key);
    free(keys->slot);
    free(keys->rank);
    *keys = (gis_block_keys){0};
}
