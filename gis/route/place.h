/* place.h: a place in the plane as a command line gives it: X,Y, each a decimal or num/den. */
#ifndef GIS_PLACE_H
#define GIS_PLACE_H

#include <stdbool.h>

#include "sunder.h"

typedef struct gis_place {
    sunder_place at;
    char *fraction[2]; /* owned; NULL: a decimal. at.text leads there */
} gis_place;

/* Reads a text that is one place and nothing else. Clear in any case. */
bool gis_place_parse(const char *text, gis_place *out);
void gis_place_clear(gis_place *place);

#endif
