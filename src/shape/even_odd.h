/* The set that the rings of a polygon enclose by the even-odd rule, taken exactly. */
#ifndef SUNDER_I_EVEN_ODD_H
#define SUNDER_I_EVEN_ODD_H

#include "shape/build.h"

/* The closure of the set, as polygons in the cleaned form of shape.h: one polygon for each component of the interior,
 * its outer ring first. */
typedef struct sunder_i_even_odd {
    uint32_t points; /* corners of the rings, one after the other */
    uint32_t *point; /* a vertex of the rings given, or SUNDER_I_MADE + the number of a crossing point */
    uint32_t rings, polygons;
    uint32_t *ring_end, *poly_end;
    sunder_i_hpoint *made; /* the crossing points, in the order of their numbers */
    uint32_t makes;
} sunder_i_even_odd;

/* r holds the rings of one polygon, in any state but without repeated vertices in a row and of at least two vertices
 * each. Everything goes to the arena. False if memory is out. */
bool sunder_i_even_odd_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_even_odd *out);

/* The parts, in the order of work; see even_odd.c. An arc is a piece of edge between neighbouring points of the
 * arrangement, by point numbers lo < hi; points are numbered lexicographically. */
typedef struct sunder_i_arc {
    uint32_t lo, hi, parent; /* parent: the edge whose line it lies on */
} sunder_i_arc;

typedef struct sunder_i_arcs {
    uint32_t points, arcs;
    uint32_t *node;    /* of each point: a vertex of r, or SUNDER_I_MADE + number */
    sunder_i_arc *arc; /* those with odd multiplicity, by lo, then bottom to top */
    sunder_i_hpoint *made;
    uint32_t makes;
} sunder_i_arcs;

bool sunder_i_arcs_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_arcs *out);

#endif
