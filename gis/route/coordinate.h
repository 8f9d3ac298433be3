/* coordinate.h: a point on the command line, the start or the goal: X,Y, each a decimal or num/den. */
#ifndef GIS_COORDINATE_H
#define GIS_COORDINATE_H

#include <stdbool.h>

#include "sunder.h"

typedef struct gis_coordinate {
    sunder_place at;
    char *fraction[2]; /* owned; at.text points to them; NULL for a decimal */
} gis_coordinate;

/* Reads a text that consists of one coordinate pair. Returns false if it does not. The caller clears *out in any
 * case. */
bool gis_coordinate_parse(const char *text, gis_coordinate *out);
void gis_coordinate_clear(gis_coordinate *coordinate);

#endif
