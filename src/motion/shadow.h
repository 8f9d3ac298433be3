/* What convex parts hide from an eye: a map of depths over directions, in doubles, that never claims too much.
 *
 * Directions are *turns* in [0, 4), dy / (|dx| + |dy|) carried on round the circle, and distances are |dx| + |dy|: no
 * roots and no angles. The directions of interest are cut into bins. A ray at either side of a bin that is found
 * clearly inside a part, at depths r and s, hides what the bin has beyond max(r, s): the chord between the two places
 * lies inside the part, which is convex, no place of it is farther away than its ends, and whoever looks past it looks
 * through it. */
#ifndef SUNDER_I_SHADOW_H
#define SUNDER_I_SHADOW_H

#include "predicate/turn.h"

#include <stdbool.h>
#include <stdint.h>

/* The largest number of bins, and the number in a turn of 1 where a sector is narrower: more of them hide more, and
 * cost more to fill for each part. */
#define SUNDER_I_BINS 512
/* Corners of a part that are used, at most: a hull of some of its corners hides no more than it does. */
#define SUNDER_I_CAST_CORNERS 16

/* Directions from `low` on, anticlockwise, `width` wide. */
typedef struct sunder_i_sector {
    double low, width;
} sunder_i_sector;

typedef struct sunder_i_shadow {
    sunder_i_sector sector;
    double per_turn; /* bins in a turn of 1 */
    int bins;
    double ray[SUNDER_I_BINS + 1][2]; /* at the sides of the bins, |x| + |y| = 1 */
    double depth[SUNDER_I_BINS];
} sunder_i_shadow;

/* From direction a on to b, anticlockwise, in [0, 4). */
double sunder_i_turn_between(double a, double b);
/* The directions of n points around an eye at the origin, off by `error` each; false if they may be half of all, or
 * more. Points that may be at the eye: not counted with `at_eye`, else reason to say false. */
bool sunder_i_sector_of(const double (*point)[2], int n, double error, bool at_eye, sunder_i_sector *out);

/* Nothing is hidden yet, but all that is outside the sector. */
void sunder_i_shadow_start(sunder_i_shadow *shadow, sunder_i_sector sector);
/* A part casts its shadow: 3 to SUNDER_I_CAST_CORNERS corners, counter-clockwise, from the eye, off by `error` each. */
void sunder_i_shadow_cast(sunder_i_shadow *shadow, const double (*corner)[2], int n, double error);
/* Can what lies in these directions cast a shadow? It has to reach over a bin. */
bool sunder_i_shadow_takes(const sunder_i_shadow *shadow, sunder_i_sector sector);
/* Is all that lies in these directions, `distance` away or more, hidden for certain? */
bool sunder_i_shadow_hides(const sunder_i_shadow *shadow, sunder_i_sector sector, double distance);

#endif
