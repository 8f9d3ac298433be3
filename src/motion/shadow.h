/* shadow.h: what convex parts hide from an eye: a map of depths over directions in doubles, which never hides a point
 * that is visible.
 *
 * Directions are *turns* in [0, 4): dy / (|dx| + |dy|), continued around the circle; distances are |dx| + |dy|. So
 * neither roots nor angles are computed. The sector of directions that is asked for is divided into bins. If the two
 * rays at the sides of a bin are clearly inside a part at the depths r and s, the part hides all points of the bin
 * beyond max(r, s): the chord between the two points is inside the part, which is convex; no point of the chord is
 * farther away than its ends; and every line of sight in the bin crosses it. */
#ifndef SUNDER_I_SHADOW_H
#define SUNDER_I_SHADOW_H

#include "predicate/turn.h"

#include <stdbool.h>
#include <stdint.h>

/* The largest number of bins, also the number in a turn of 1 in a narrow sector. More bins hide more, but take longer
 * to fill for each part. */
#define SUNDER_I_BINS 512
/* The largest number of corners of a part that are used: the hull of some of its corners hides at most what the part
 * does. */
#define SUNDER_I_CAST_CORNERS 16

/* The directions from `low` counterclockwise to `low` + `width`. */
typedef struct sunder_i_sector {
    double low, width;
} sunder_i_sector;

typedef struct sunder_i_shadow {
    sunder_i_sector sector;
    double per_turn; /* the number of bins in a turn of 1 */
    int bins;
    double ray[SUNDER_I_BINS + 1][2]; /* the directions at the sides of the bins, with |x| + |y| = 1 */
    double depth[SUNDER_I_BINS];
} sunder_i_shadow;

/* Returns the turn from direction a counterclockwise to direction b, in [0, 4). */
double sunder_i_turn_between(double a, double b);
/* *out becomes a sector that contains the directions of the n points around an eye at the origin; each coordinate has
 * an error of at most `error`. Returns false if the directions may be half of all or more. Points that may be at the
 * eye are skipped if `at_eye` is set; else the function returns false for these. */
bool sunder_i_sector_of(const double (*point)[2], int n, double error, bool at_eye, sunder_i_sector *out);

/* Sets *shadow to the directions of `sector`, none of which is hidden; all other directions count as hidden. */
void sunder_i_shadow_start(sunder_i_shadow *shadow, sunder_i_sector sector);
/* Adds what a part hides. corner: n corners (3 to SUNDER_I_CAST_CORNERS) in counterclockwise order, relative to the
 * eye, with an error of at most `error` in each coordinate. */
void sunder_i_shadow_cast(sunder_i_shadow *shadow, const double (*corner)[2], int n, double error);
/* Returns true if an object in the directions of `sector` covers a bin, as it must to hide anything. */
bool sunder_i_shadow_takes(const sunder_i_shadow *shadow, sunder_i_sector sector);
/* Returns true if all points in the directions of `sector` at the given distance or more are certainly hidden. */
bool sunder_i_shadow_hides(const sunder_i_shadow *shadow, sunder_i_sector sector, double distance);

#endif
