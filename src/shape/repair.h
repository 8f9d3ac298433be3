/* Polygons replaced by the even-odd set of their rings, and the coordinates of the points made for that. */
#ifndef SUNDER_I_REPAIR_H
#define SUNDER_I_REPAIR_H

#include "shape/from_rings.h"

/* A crossing point: coordinate k is num[k] / den[k] * 2^exponent[k], den odd, in lowest terms. */
typedef struct sunder_i_made {
    sunder_i_big num[2], den[2];
    long exponent[2];
} sunder_i_made;

typedef struct sunder_i_made_points {
    sunder_i_made *point;
    size_t n, capacity; /* freed with sunder_i_free(); the numbers are in the arena */
    bool rational;      /* some coordinate is not a double */
} sunder_i_made_points;

/* Appends the even-odd set of polygon p of the input to r. at: the raw vertices on r's lattice, taken from origin.
 * Vertices at crossing points get source SUNDER_I_MADE + number, and no place. False if memory is out. */
bool sunder_i_repair_polygon(sunder_i_rings *r, const sunder_i_input *in, const sunder_i_point *at,
                             const double origin[2], size_t p, sunder_i_made_points *made, sunder_i_arena *arena);

/* All coordinates of r over one denominator, in the arena: coordinate i is num[i] * 2^exponent / den, den odd. */
typedef struct sunder_i_rationals {
    sunder_i_big *num, den;
    long exponent;
} sunder_i_rationals;

/* Places r, which has vertices at made points, on a new lattice (the caller frees it); rationals are filled if
 * made->rational. */
bool sunder_i_repair_place(sunder_i_rings *r, const sunder_i_made_points *made, sunder_i_lattice *lattice,
                           sunder_i_rationals *rationals, sunder_i_arena *arena);

#endif
