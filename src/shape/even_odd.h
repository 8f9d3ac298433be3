/* even_odd.h: the set that the rings of a polygon enclose by the even-odd rule, or where their winding number is
 * positive, exactly. */
#ifndef SUNDER_I_EVEN_ODD_H
#define SUNDER_I_EVEN_ODD_H

#include "shape/build.h"

/* The closure of the set, as polygons in the cleaned form of shape.h: one polygon for each component of the interior,
 * its outer ring first. */
typedef struct sunder_i_even_odd {
    uint32_t points; /* the number of vertices of all rings */
    uint32_t *point; /* each is a vertex of the given rings, or SUNDER_I_MADE + the number of a crossing point */
    uint32_t rings, polygons;
    uint32_t *ring_end, *poly_end;
    sunder_i_hpoint *made; /* [makes] the crossing points */
    uint32_t makes;
} sunder_i_even_odd;

/* Computes the set, in the arena. r contains the rings of one polygon, in any state except that consecutive vertices
 * differ and each ring has at least two. Returns false if out of memory. */
bool sunder_i_even_odd_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_even_odd *out);

/* Computes the set of the points with a positive winding number in the same way. crossing_of: NULL, or *crossing_of
 * becomes, for each crossing point, the lesser one of two edges that cross there. */
bool sunder_i_winding_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_even_odd *out,
                           const uint32_t **crossing_of);

/* The arrangement, an intermediate result (see even_odd.c). An arc is a part of an edge between neighbouring points of
 * the arrangement, with point numbers lo < hi; points are numbered lexicographically. */
typedef struct sunder_i_arc {
    uint32_t lo, hi, parent; /* parent: the edge that contains the arc */
    int32_t turn;            /* by how much the winding number is greater above the arc than below it */
} sunder_i_arc;

typedef struct sunder_i_arcs {
    uint32_t points, arcs;
    uint32_t *node;    /* [points] for each point a vertex of r, or SUNDER_I_MADE + the number of a crossing */
    sunder_i_arc *arc; /* sorted by lo, then from bottom to top */
    sunder_i_hpoint *made;
    uint32_t *made_on; /* [makes] the lesser one of two edges that cross at each */
    uint32_t makes;
} sunder_i_arcs;

/* Finds the arcs with odd multiplicity or, with `winding`, those at which the winding number changes. */
bool sunder_i_arcs_find(const sunder_i_rings *r, bool winding, sunder_i_arena *arena, sunder_i_arcs *out);

#endif
