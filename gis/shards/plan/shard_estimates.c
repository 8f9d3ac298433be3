/* shard_estimates.c: see plan.h. Estimates for a scheduler, from towns with a hundred thousand buildings and from real
 * layers; most shards take less. Moves may join several contact groups to one piece of work, which cannot be
 * estimated. */
#include "shards/plan/plan.h"

#include <math.h>

/* Seconds on one core, estimated generously for schedulers: per process; per feature, without a search; per feature
 * with --effort 1, if one in four is in conflict; and per feature in the merge. */
static const double seconds_anyway = 2, seconds_a_feature = 2e-4, seconds_of_effort = 1e-3, seconds_merged = 1e-4;

static double seconds_of(const gis_layer_rules *rules, double features)
{
    return ceil(seconds_anyway + (seconds_a_feature + seconds_of_effort * rules->core.effort) * features);
}

gis_plan_estimate gis_plan_estimate_shard(const gis_plan *plan, const gis_plan_load *shard,
                                          const gis_layer_rules *rules)
{
    const double features = (double)shard->features, vertices = (double)shard->vertices;
    return (gis_plan_estimate){.bytes = fmin(plan->memory, gis_shard_run_bytes(rules, features, vertices)),
                               .seconds = seconds_of(rules, features)};
}

gis_plan_estimate gis_plan_estimate_group(const gis_shard_run *parts)
{
    const gis_layer_rules *rules = &parts->request->rules;
    const double features = (double)parts->facts.group.features, vertices = (double)parts->facts.group.vertices;
    return (gis_plan_estimate){.bytes = gis_shard_run_bytes(rules, features, vertices),
                               .seconds = seconds_of(rules, features)};
}

gis_plan_estimate gis_plan_estimate_merge(const gis_plan *plan, const gis_shard_run *parts)
{
    const double features = (double)plan->facts.source.features;
    const gis_plan_estimate group = gis_plan_estimate_group(parts);
    return (gis_plan_estimate){.bytes = fmax(group.bytes, gis_shard_run_bytes_written(parts->request, features)),
                               .seconds = group.seconds + ceil(seconds_anyway + seconds_merged * features)};
}
