/* The full gap: a distance greater than the one that has to be kept. What a pair lacks of it has a price. */
#include "displacement/layer/placement.h"

sunder_i_model sunder_i_with_full_gap(const sunder_i_model *model, sunder_i_barriers *barriers)
{
    sunder_i_model full = *model;
    *barriers = *model->barriers;
    barriers->required = barriers->full;
    full.rules.gap = model->rules.full_gap;
    full.class_gap = model->class_full;
    full.barriers = barriers;
    return full;
}

sunder_status sunder_i_placement_relate_fully(const sunder_i_model *model, const sunder_i_placement *placement,
                                              sunder_i_relations *relations, sunder_error *err)
{
    sunder_i_barriers barriers;
    const sunder_i_model full = sunder_i_with_full_gap(model, &barriers);
    return sunder_i_placement_relate(&full, placement, NULL, relations, err);
}
