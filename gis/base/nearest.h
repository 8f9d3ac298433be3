/* nearest.h: which of some words was probably meant by a misspelt one. */
#ifndef GIS_NEAREST_H
#define GIS_NEAREST_H

#include <stddef.h>

typedef struct gis_nearest {
    const char *word; /* as given; n characters */
    size_t n;
    const char *best; /* the nearest word offered so far that is near enough, best_n characters; NULL: none is */
    size_t best_n, distance;
} gis_nearest;

gis_nearest gis_nearest_to(const char *word, size_t n);
/* The words are borrowed. Small and capital letters are alike; of equally near words the first stays. */
void gis_nearest_offer(gis_nearest *search, const char *word, size_t n);

#endif
