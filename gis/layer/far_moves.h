/* far_moves.h: warns of moves that are longer than the layer is wide, if coordinates of it are corrupt.
 *
 * A coordinate is *sound* up to 2^43, where doubles hold it to a thousandth of a unit; beyond that a move is rounded by
 * more. The rule asks one feature at a time, so it is the same for a layer of two features and for one in parts. The
 * extent of the layer is the diagonal of the box of all features with sound coordinates only. A warning is given for
 * each feature that moves farther, in the order of the input. None if all features are sound, or none is: two features
 * in one place may have to move farther than a small layer is wide. */
#ifndef GIS_FAR_MOVES_H
#define GIS_FAR_MOVES_H

#include "layer/layer_input.h"

/* Zeroed: no feature was seen. */
typedef struct gis_far_moves {
    double sound[4]; /* the box of the features with sound coordinates */
    bool any_sound, any_corrupt;
} gis_far_moves;

/* Boxes are xmin, ymin, xmax, ymax; box[0] > box[2]: of nothing. False: no feature in the box makes a warning
 * possible. */
bool gis_far_moves_may_warn(const double box[4]);
void gis_far_moves_add(gis_far_moves *of, const double box[4]);
/* Once all features were added. */
void gis_far_moves_warn(const gis_far_moves *of, const gis_layer_input *input, size_t i, const double move[2]);
/* All of it, for a layer that is held whole. */
void gis_far_moves_warn_all(const gis_layer_input *input, const sunder_report *report);

#endif
