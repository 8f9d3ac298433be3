/* far_moves.h: warns of moves that are longer than the extent of the layer, if the layer has corrupt coordinates.
 *
 * A coordinate is *sound* up to 2^43, where doubles still resolve a thousandth of a unit; beyond that moves are rounded
 * by more. The extent of the layer is the diagonal of the box of all features that have only sound coordinates. A
 * warning is given for each feature that moves farther, in input order. There is none if all features are sound, or if
 * none is: two features at the same place may have to move farther than a small layer is wide. Features are examined
 * one by one, so that the warnings are the same for a layer that is separated in parts. */
#ifndef GIS_FAR_MOVES_H
#define GIS_FAR_MOVES_H

#include "layer/layer_input.h"

/* A zeroed struct: no feature was added. */
typedef struct gis_far_moves {
    double sound[4]; /* box of the features with sound coordinates */
    bool any_sound, any_corrupt;
} gis_far_moves;

/* Does a box contain a coordinate that is not sound? Boxes are xmin, ymin, xmax, ymax; one with box[0] > box[2] is
 * empty. */
bool gis_far_moves_may_warn(const double box[4]);
void gis_far_moves_add(gis_far_moves *of, const double box[4]);
/* Warns if feature i moves too far; call it after all features were added. */
void gis_far_moves_warn(const gis_far_moves *of, const gis_layer_input *input, size_t i, const double move[2]);
/* Adds all features of a layer that is held in memory, and warns. */
void gis_far_moves_warn_all(const gis_layer_input *input, const sunder_report *report);

#endif
