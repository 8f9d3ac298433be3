/* The widest interval that the interior of a shape has on the horizontal line through its middle: an anchor is the
 * middle of that (anchor.c). */
#ifndef SUNDER_I_WIDEST_INTERVAL_H
#define SUNDER_I_WIDEST_INTERVAL_H

#include "number/ratio.h"
#include "predicate/rational_point.h"

/* A set with area, by its boundary: edge v goes from corner v to corner next[v], with the interior on its left. Corners
 * are doubles, multiples of 2^unit, or rational points. */
typedef struct sunder_i_boundary {
    uint32_t n;
    const uint32_t *next;
    const double *xy;
    int unit;
    const sunder_i_rational_point *point; /* where xy is NULL */
} sunder_i_boundary;

/* Where an edge is at a height. */
typedef struct sunder_i_level_crossing {
    uint32_t edge;
    bool opens; /* the interior is to its right */
    bool exact; /* x is `at`, a double */
    double at;
    double along, off; /* x less that of corner 0, and by how much that may be off; INFINITY: it is not known */
} sunder_i_level_crossing;

typedef struct sunder_i_widest_interval {
    sunder_i_level_crossing from, to;
    double low, high;      /* the height is the middle of these, of a boundary in doubles */
    sunder_i_ratio height; /* else it is this */
} sunder_i_widest_interval;

/* The interval; of a set that has none at its middle that of what lies below. Room for [n] and [2 n]. The arena holds
 * numbers, of doubles no more than SUNDER_I_INTERVAL_LIMBS at a time; *out is undefined if it failed. */
void sunder_i_widest_interval_find(const sunder_i_boundary *boundary, int8_t *side, sunder_i_level_crossing *crossing,
                                   sunder_i_arena *arena, sunder_i_widest_interval *out);
/* Its middle, in units of the boundary. */
sunder_i_rational_point sunder_i_widest_interval_middle(const sunder_i_boundary *boundary,
                                                        const sunder_i_widest_interval *interval,
                                                        sunder_i_arena *arena);
/* The nearest doubles to that, of a boundary in doubles. */
void sunder_i_widest_interval_doubles(const sunder_i_boundary *boundary, const sunder_i_widest_interval *interval,
                                      sunder_i_arena *arena, double xy[2]);

#define SUNDER_I_INTERVAL_LIMBS 5120

#endif
