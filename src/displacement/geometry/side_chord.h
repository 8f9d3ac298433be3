/* Chords across ends of two sides that are on one ray from an anchor; see side_chord.c. */
#ifndef SUNDER_I_SIDE_CHORD_H
#define SUNDER_I_SIDE_CHORD_H

#include <stdbool.h>

/* Computes a chord from behind the side between end[0] and other[0] to behind that between end[1] and other[1], seen
 * from the anchor a. The two ends have to lie on one ray from a; share: how much of the sides the chord cuts off there.
 * Returns false if there is no chord. */
bool sunder_i_side_chord(const double a[2], const double *const end[2], const double *const other[2], double share,
                         double chord[4]);
/* Does the path of the anchor a, which moves by -u relative to the side, pass nearly through `end`? */
bool sunder_i_passes_end(const double a[2], const double end[2], const double u[2]);

#endif
