/* estimate.c: see plan.h. Guesses for a scheduler, from towns of a hundred thousand buildings and real layers: they lie
 * above what most shards take. What they do not know: a group of features that all have to do with each other is one
 * piece of work, whatever its size. */
#include "plan/plan.h"

#include <math.h>

/* Seconds on one core, of which a scheduler wants to hear more than enough: for nothing; for each feature, without any
 * search; and for each feature with --effort 1, where one in four is in conflict. */
static const double seconds_anyway = 2, seconds_a_feature = 2e-4, seconds_of_effort = 1e-3, seconds_merged = 1e-4;

gis_plan_estimate gis_plan_of_shard(const gis_plan *plan, const gis_plan_load *shard, const gis_layer_rules *rules)
{
    const double features = (double)shard->features, vertices = (double)shard->vertices;
    return (gis_plan_estimate){
        .bytes = fmin(plan->memory, gis_in_parts_bytes(rules, features, vertices)),
        .seconds = ceil(seconds_anyway + (seconds_a_feature + seconds_of_effort * rules->effort) * features)};
}

gis_plan_estimate gis_plan_of_merge(const gis_plan *plan, bool drawn)
{
    const double features = (double)plan->facts.source.features;
    return (gis_plan_estimate){.bytes = gis_in_parts_bytes_written(features, drawn),
                               .seconds = ceil(seconds_anyway + seconds_merged * features)};
}
