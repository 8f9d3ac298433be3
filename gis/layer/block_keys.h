/* block_keys.h: numbers the distinct values of --block-field. */
#ifndef GIS_LAYER_BLOCK_KEYS_H
#define GIS_LAYER_BLOCK_KEYS_H

#include "base/gis_error.h"

#include <stdint.h>

/* The distinct keys. A zeroed struct is empty. */
typedef struct gis_block_keys {
    char **key; /* [n] by number, in the order of first appearance */
    size_t n, capacity;
    size_t *slot; /* [slots] hash table of numbers + 1; 0: empty. `slots` is a power of two */
    size_t slots;
    int64_t *rank; /* [n] set by gis_block_keys_rank() */
} gis_block_keys;

/* Sets *number to the number of a key, which is taken over and freed. */
bool gis_block_keys_add(gis_block_keys *keys, char *key, int64_t *number, gis_error *error);
/* Sets keys->rank to the position of each key in sorted order, which is the final number of its block. */
bool gis_block_keys_rank(gis_block_keys *keys, gis_error *error);
void gis_block_keys_clear(gis_block_keys *keys);

#endif
