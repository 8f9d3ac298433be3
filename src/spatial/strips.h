/* Things by height: a plane in horizontal strips, each with a list of what reaches into it. Who asks what a horizontal
 * meets looks at one list. Heights are doubles; a span must hold what the caller's errors may add. */
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

/* Of n items with the spans low, high (low <= high, finite). So many strips that an item is in a few of them on
 * average, and no more than `most`, or one: few questions are not worth many strips. False if memory is out; the strips
 * can be freed all the same. */
bool sunder_i_strips_build(sunder_i_strips *strips, const double (*span)[2], size_t n, size_t most);
void sunder_i_strips_free(sunder_i_strips *strips);

/* Entries [*from, *to) are all whose spans hold the height, and others. */
void sunder_i_strips_at(const sunder_i_strips *strips, double height, size_t *from, size_t *to);

#endif
