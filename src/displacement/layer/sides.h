/* Sides: lines of barriers that features may not cross, and the side anchors that the rule refers to; exact. See
 * sides.c. */
#ifndef SUNDER_I_SIDES_H
#define SUNDER_I_SIDES_H

#include "displacement/layer/model.h"

#include "predicate/passage.h"

/* Makes the lines of barriers that have sides, and the side anchors of all features. Does nothing if no barrier has
 * sides. Pieces must have been numbered before. */
sunder_status sunder_i_model_find_sides(sunder_i_model *model, sunder_error *err);
/* Sets *crosses if the side anchor of feature f, moved by t, crosses a line of this part of a barrier. */
sunder_status sunder_i_crosses_side(const sunder_i_model *model, uint32_t f, const double t[2], uint32_t part,
                                    bool *crosses, sunder_error *err);
/* Is `side` a line that f may not cross? Returns false for an edge of an area if the side anchor is inside of it or on
 * it, or, if the area has corners that are not doubles, too near to decide in doubles. */
bool sunder_i_side_faces(const sunder_i_model *model, const sunder_i_side *side, uint32_t f);

/* ---- side_anchor.c ----------------------------------------------------------------------------------------------- */

/* What the choice of a side anchor needs, besides the lines near the feature. */
typedef struct sunder_i_side_scope {
    double tolerance; /* the tolerance for touching */
    /* Sets *line to the *n lines that meet a box; valid until the next call. Returns false if memory is out. */
    bool (*find)(void *user, const double box[4], const sunder_i_side *const **line, size_t *n);
    void *user;
} sunder_i_side_scope;

/* Sets `anchor` to the side anchor of a feature, given the n lines that meet its box. */
sunder_status sunder_i_side_anchor(const sunder_shape *shape, const sunder_i_side *const *side, size_t n,
                                   const sunder_i_side_scope *scope, double anchor[2], sunder_error *err);

#endif
