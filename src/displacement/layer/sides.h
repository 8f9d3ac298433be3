/* Sides: lines of barriers that features may not cross, and the anchors that the rule is about; exact. See sides.c. */
#ifndef SUNDER_I_SIDES_H
#define SUNDER_I_SIDES_H

#include "displacement/layer/model.h"

#include "predicate/passage.h"

/* The lines of the barriers that have sides, and the side anchors of the features; of no effect where none has. After
 * the pieces are cut. */
sunder_status sunder_i_model_find_sides(sunder_i_model *model, sunder_error *err);
/* Did the side anchor of f, which moves by t, cross a line of that part of a barrier? */
sunder_status sunder_i_crosses_side(const sunder_i_model *model, uint32_t f, const double t[2], uint32_t part,
                                    bool *crosses, sunder_error *err);
/* Is it a line that f may not cross, as doubles tell? Of an edge that the side anchor lies inside of, or on, or too
 * near to tell: no. */
bool sunder_i_side_faces(const sunder_i_model *model, const sunder_i_side *side, uint32_t f);

/* ---- side_anchor.c ----------------------------------------------------------------------------------------------- */

/* What a side anchor is chosen by, besides the lines about the feature. */
typedef struct sunder_i_side_scope {
    double tolerance; /* of touching */
    /* Those that meet a box, until it is called again. False if memory is out. */
    bool (*find)(void *user, const double box[4], const sunder_i_side *const **line, size_t *n);
    void *user;
} sunder_i_side_scope;

/* The side anchor of a feature, of these lines; the others do not meet its box. */
sunder_status sunder_i_side_anchor(const sunder_shape *shape, const sunder_i_side *const *side, size_t n,
                                   const sunder_i_side_scope *scope, double anchor[2], sunder_error *err);

#endif
