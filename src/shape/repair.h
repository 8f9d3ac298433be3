/* repair.h: polygons replaced by the even-odd set of their rings, and the coordinates of the points made for that. */
#ifndef SUNDER_I_REPAIR_H
#define SUNDER_I_REPAIR_H

#include "shape/from_rings.h"

/* The crossings that became vertices. */
typedef struct sunder_i_made_points {
    sunder_i_exact *point;
    size_t n, capacity; /* `point` is freed with sunder_i_free(); its numbers are in the arena */
    bool rational;      /* some coordinate is not a double */
} sunder_i_made_points;

/* Appends the even-odd set of polygon p of the input to r. at: the raw vertices on r's lattice, relative to `origin`.
 * Vertices at crossings get the source SUNDER_I_MADE + number, and no position yet. Returns false if out of memory. */
bool sunder_i_repair_polygon(sunder_i_rings *r, const sunder_i_input *in, const sunder_i_point *at,
                             const double origin[2], size_t p, sunder_i_made_points *made, sunder_i_arena *arena);

/* Places the vertices of r that are made points on its lattice, whose origin is `origin`. Returns false if out of
 * memory. */
bool sunder_i_repair_place(sunder_i_rings *r, const sunder_i_made_points *made, const double origin[2],
                           sunder_i_arena *arena);

#endif
