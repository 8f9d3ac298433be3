/* coordinate.h: a coordinate as a command line gives it, the start or the goal: X,Y, each a decimal or num/den. */
#ifndef GIS_COORDINATE_H
#define GIS_COORDINATE_H

#include <stdbool.h>

#include "sunder.h"

typedef struct gis_coordinate {
    sunder_place at;
    char *fraction[2]; /* owned, and what at.text leads to; NULL: a decimal */
} gis_coordinate;

/* Reads a text that is one coordinate and nothing else. Clear in any case. */
bool gis_coordinate_parse(const char *text, gis_coordinate *out);
void gis_coordinate_clear(gis_coordinate *coordinate);

#endif
