/* spelling.h: which of some words was probably meant by a misspelt one. */
#ifndef GIS_SPELLING_H
#define GIS_SPELLING_H

#include <stddef.h>

/* A search among words that are offered one after the other. All words are borrowed. */
typedef struct gis_spelling {
    const char *word; /* as given; n characters */
    size_t n;
    const char *best;        /* the nearest word offered so far that is near enough, best_n characters; NULL: none is */
    size_t best_n, distance; /* how far `best` is, in slips */
} gis_spelling;

gis_spelling gis_spelling_of(const char *word, size_t n);
/* Offers `word` to the search. Case is ignored; of equally near words, the first one offered is kept. */
void gis_spelling_offer(gis_spelling *search, const char *word, size_t n);

#endif
