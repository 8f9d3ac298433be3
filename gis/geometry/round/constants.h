/* constants.h: the numbers of rounding that are choices. None decides what is well, which is the core's exact
 * validation; they say where to look, and how long to try. Lengths are in units in the last place (ulps): of x along x,
 * of y along y, so that cells which round to one vertex are squares, whatever the place. */
#ifndef GIS_CONSTANTS_H
#define GIS_CONSTANTS_H

/* How near a vertex must be to an edge to bend it, at first. Both ends of the edge and the vertex have moved by half an
 * ulp in each coordinate: the sum of the three is below this. */
#define GIS_BEND_ULPS 4.0
/* In later rounds: what passes through the square that rounds to the vertex, as in snap rounding, and a quarter more
 * for the place on the edge, which is computed in doubles. Where features are no larger than a few ulps the first reach
 * would throw everything into everything, again and again. */
#define GIS_PIXEL_ULPS 0.75
/* How near two polygons must come to be looked at together: either moved by less than an ulp when it was rounded, and
 * by up to four more and another rounding where it was bent. */
#define GIS_NEAR_ULPS 16.0
/* More mending than that is accounted for by how far it moved a boundary; both polygons may have moved so, and each
 * twice since the two were last looked at. */
#define GIS_NEAR_MOVES 4.0
/* How far a corner may be off the side that it is taken out of: both ends of the side and the corner were rounded by
 * half an ulp each, once for each union, and the turned shape itself. */
#define GIS_STRAIGHT_ULPS 4.0

enum {
    GIS_STRAIGHT_ROW = 8,    /* corners taken out in a row at most: each is held against the side that comes of it */
    GIS_BENDS_IN_A_ROW = 4,  /* one more would be found seldom, and the next round will see it */
    GIS_POLYGON_ROUNDS = 12, /* one nearly always does, three have been seen; a polygon still broken then is given up */
    GIS_MULTIPOLYGON_ROUNDS = 12 /* likewise of groups of polygons */
};

#endif
