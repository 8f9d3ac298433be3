/* Which bodies may come past each other's anchors, by boxes: most do not. */
#ifndef SUNDER_I_ANCHOR_REACH_H
#define SUNDER_I_ANCHOR_REACH_H

#include "displacement/geometry/obstacle_shadow.h"
#include "displacement/layer/model.h"

/* May the way (sunder_i_shadow_way()) meet what the anchors of p see of q, whose origin is at `offset` from p's; or if
 * swapped, those of q of p? Where jumps are not allowed. */
static inline bool sunder_i_anchors_may_reach(const sunder_i_model *model, const sunder_i_body *p,
                                              const sunder_i_body *q, bool swapped, const double offset[2],
                                              const double way[4])
{
    double anchors[4];
    sunder_i_anchors(model, swapped ? q : p, anchors);
    return sunder_i_shadow_may_reach(swapped ? p->box : anchors, swapped ? anchors : q->box, offset, way);
}

#endif
