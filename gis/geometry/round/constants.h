/* constants.h: the tuning constants of rounding. None decides validity, which the core checks exactly; they determine
 * where to look and when to stop. Lengths are in units in the last place (ulps) of x along x and of y along y, so that
 * the cells that round to one vertex are squares everywhere. */
#ifndef GIS_CONSTANTS_H
#define GIS_CONSTANTS_H

/* A vertex this near to an edge bends the edge, in the first round. Both ends of the edge and the vertex have moved by
 * half an ulp in each coordinate; this bound exceeds the sum of the three. */
#define GIS_BEND_ULPS 4.0
/* The same in later rounds: the edge passes through the square that rounds to the vertex, as in snap rounding, plus a
 * quarter for the error of the position on the edge, which is computed in doubles. With the first bound, features of
 * the size of a few ulps would be bent again and again. */
#define GIS_PIXEL_ULPS 0.75
/* Polygons this near to each other are tested together: each moved by less than an ulp when it was rounded, and by up
 * to four more and another rounding if it was bent. */
#define GIS_NEAR_ULPS 16.0
/* Polygons that were moved farther by mending are tested within this multiple of the move: both may have moved so, and
 * each twice since the last test. */
#define GIS_NEAR_MOVES 4.0
/* A vertex this near to the line between its neighbours is removed as straight: both ends and the vertex were rounded
 * by half an ulp each, once for each union, and so was the turned shape. */
#define GIS_STRAIGHT_ULPS 4.0

enum {
    GIS_STRAIGHT_ROW = 8,        /* most vertices removed in a row; each is compared with the edge that replaces it */
    GIS_BENDS_IN_A_ROW = 4,      /* most passes of bending in a round; more are rarely needed, and the next round
                              * continues */
    GIS_POLYGON_ROUNDS = 12,     /* most rounds for a polygon: one is nearly always enough, three were seen; after that
                              * mending fails */
    GIS_MULTIPOLYGON_ROUNDS = 12 /* most rounds for groups of polygons */
};

#endif
