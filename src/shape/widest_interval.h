/* widest_interval.h: the widest interval of the interior of a shape on the horizontal line at half its height; the
 * anchor is its midpoint (anchor.c). */
#ifndef SUNDER_I_WIDEST_INTERVAL_H
#define SUNDER_I_WIDEST_INTERVAL_H

#include "number/ratio.h"
#include "predicate/rational_point.h"

/* A set with area, by its boundary: edge v goes from vertex v to vertex next[v] with the interior on its left. Vertices
 * are doubles, multiples of 2^unit, or rational points. */
typedef struct sunder_i_boundary {
    uint32_t n;
    const uint32_t *next;
    const double *xy;
    int unit;
    const sunder_i_rational_point *point; /* used if xy is NULL */
} sunder_i_boundary;

/* The crossing of an edge with the line. */
typedef struct sunder_i_level_crossing {
    uint32_t edge;
    bool opens; /* the interior is on its right */
    bool exact; /* x is exactly the double `at` */
    double at;
    double along, off; /* x relative to vertex 0, and a bound of its error; INFINITY: unknown */
} sunder_i_level_crossing;

typedef struct sunder_i_widest_interval {
    sunder_i_level_crossing from, to;
    double low, high;      /* for a boundary in doubles: the height is their mean */
    sunder_i_ratio height; /* else the height */
} sunder_i_widest_interval;

/* Finds the interval; if the set has none at half its height, that of the part below. side and crossing have room for
 * [n] and [2 n]. The arena contains numbers, for doubles at most SUNDER_I_INTERVAL_LIMBS limbs at a time; *out is
 * undefined if it failed. */
void sunder_i_widest_interval_find(const sunder_i_boundary *boundary, int8_t *side, sunder_i_level_crossing *crossing,
                                   sunder_i_arena *arena, sunder_i_widest_interval *out);
/* Returns the midpoint of the interval, in units of the boundary. */
sunder_i_rational_point sunder_i_widest_interval_middle(const sunder_i_boundary *boundary,
                                                        const sunder_i_widest_interval *interval,
                                                        sunder_i_arena *arena);
/* Sets xy to the doubles nearest to that midpoint, for a boundary in doubles. */
void sunder_i_widest_interval_doubles(const sunder_i_boundary *boundary, const sunder_i_widest_interval *interval,
                                      sunder_i_arena *arena, double xy[2]);

#define SUNDER_I_INTERVAL_LIMBS 5120

#endif
