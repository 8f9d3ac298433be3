/* Items by height: the plane in horizontal strips, each with a list of the items that reach into it. To find what a
 * horizontal line meets, search one list. Heights are doubles; the caller's spans must include the error of its
 * coordinates. */
#ifndef SUNDER_I_STRIPS_H
#define SUNDER_I_STRIPS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sunder_i_strips {
    double low, per_unit;
    uint32_t n;
    size_t *end;    /* [n] past the last entry of each */
    uint32_t *item; /* entries, in rising order in each strip */
} sunder_i_strips;

/* Strips for n items with the spans low, high (low <= high, finite): as many that an item is in a few strips on
 * average, at most `most`, and at least one. Few queries do not justify many strips. False if memory is out; the caller
 * frees the strips in any case. */
bool sunder_i_strips_build(sunder_i_strips *strips, const double (*span)[2], size_t n, size_t most);
void sunder_i_strips_free(sunder_i_strips *strips);

/* Entries [*from, *to) are a superset of the items whose spans hold the height. */
void sunder_i_strips_at(const sunder_i_strips *strips, double height, size_t *from, size_t *to);

#endif
