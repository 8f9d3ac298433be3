/* spelling.h: finds the word that was probably meant by a misspelt one. */
#ifndef GIS_SPELLING_H
#define GIS_SPELLING_H

#include <stddef.h>

/* A search among words that are offered one by one. All words are borrowed. */
typedef struct gis_spelling {
    const char *word; /* the misspelt word, n characters */
    size_t n;
    const char *best;        /* the nearest word offered that is near enough, best_n characters; NULL: none */
    size_t best_n, distance; /* distance: edit distance of `best` */
} gis_spelling;

gis_spelling gis_spelling_of(const char *word, size_t n);
/* Offers a word. Case is ignored; of equally near words the first one offered is kept. */
void gis_spelling_offer(gis_spelling *search, const char *word, size_t n);

#endif
