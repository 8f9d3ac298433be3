/* Tests, by boxes, whether a body may move past an anchor of another body; for most pairs this excludes it. */
#ifndef SUNDER_I_ANCHOR_REACH_H
#define SUNDER_I_ANCHOR_REACH_H

#include "displacement/geometry/obstacle_shadow.h"
#include "displacement/layer/model.h"

/* May a relative path with the box `path` (sunder_i_shadow_path_box()) meet the shadow of body q from an anchor of body
 * p, or if `swapped`, of p from an anchor of q? `offset` is the origin of q relative to that of p. Only if jumps are
 * not allowed. */
static inline bool sunder_i_anchors_may_reach(const sunder_i_model *model, const sunder_i_body *p,
                                              const sunder_i_body *q, bool swapped, const double offset[2],
                                              const double path[4])
{
    double anchors[4];
    sunder_i_anchors(model, swapped ? q : p, anchors);
    return sunder_i_shadow_may_reach(swapped ? p->box : anchors, swapped ? anchors : q->box, offset, path);
}

#endif
