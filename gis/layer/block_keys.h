/* block_keys.h: the values of --block-field, told apart and numbered. */
#ifndef GIS_LAYER_BLOCK_KEYS_H
#define GIS_LAYER_BLOCK_KEYS_H

#include "base/gis_error.h"

#include <stdint.h>

/* Zeroed: none yet. */
typedef struct gis_block_keys {
    char **key; /* [n] by number: in the order of their first appearance */
    size_t n, capacity;
    size_t *slot; /* [slots] a table of numbers + 1, 0: empty; slots is a power of two */
    size_t slots;
    int64_t *rank; /* [n] once they are ranked */
} gis_block_keys;

/* The number of a key, which is taken over. */
bool gis_block_keys_add(gis_block_keys *keys, char *key, int64_t *number, gis_error *error);
/* In keys->rank the place of each among all, sorted: how blocks are called in the end. */
bool gis_block_keys_rank(gis_block_keys *keys, gis_error *error);
void gis_block_keys_clear(gis_block_keys *keys);

#endif
