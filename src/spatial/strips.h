/* strips.h: items by height: the plane is divided into horizontal strips, each with a list of the items that meet it.
 * To find the items that meet a horizontal line, one list is searched. Heights are doubles; the caller's spans must
 * include the error of its coordinates. */
#ifndef SUNDER_I_STRIPS_H
#define SUNDER_I_STRIPS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sunder_i_strips {
    double low, per_unit;
    uint32_t n;
    size_t *end;    /* [n] the index after the last entry of each strip */
    uint32_t *item; /* the entries, ascending in each strip */
} sunder_i_strips;

/* Makes strips for n items with the spans low, high (low <= high, finite): as many that an item is in a few strips on
 * average, at most `most`, and at least one. (For few queries many strips are not worth their cost.) Returns false if
 * out of memory; the caller frees the strips in either case. */
bool sunder_i_strips_build(sunder_i_strips *strips, const double (*span)[2], size_t n, size_t most);
void sunder_i_strips_free(sunder_i_strips *strips);

/* The entries [*from, *to) become a superset of the items whose spans contain the height. */
void sunder_i_strips_at(const sunder_i_strips *strips, double height, size_t *from, size_t *to);

#endif
