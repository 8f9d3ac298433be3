/* The options of a layer: their defaults, what they may be, and the rules that they make. */
#include "displacement/layer/layer.h"

#include "base/error.h"
#include "base/sized_struct.h"
#include "base/watch.h"

#include <math.h>
#include <unistd.h>

/* More threads would wait for each other: no layer has that many clusters of significant size. */
#define MOST_THREADS 256

void sunder_layer_options_init_sized(sunder_layer_options *options, size_t size)
{
    static const sunder_layer_options defaults = {.touch_tolerance = -1,
                                                  .contained = SUNDER_CONTAINMENT_BLOCK,
                                                  .threads = 1,
                                                  .effort = 1,
                                                  .barrier_reach = INFINITY};
    sunder_i_options_write(options, size, &defaults, sizeof defaults);
}

static unsigned processors(void)
{
    const long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > MOST_THREADS ? MOST_THREADS : (unsigned)n;
}

sunder_status sunder_i_rules_of(const sunder_layer_options *o, sunder_i_rules *rules, sunder_error *err)
{
    if (!(o->gap >= 0) || !isfinite(o->gap))
        return sunder_i_fail(err, SUNDER_EARG, "the gap, %g, is negative or not finite", o->gap);
    if (isnan(o->touch_tolerance) || o->touch_tolerance == INFINITY)
        return sunder_i_fail(err, SUNDER_EARG, "the touch tolerance, %g, is not finite", o->touch_tolerance);
    const double tolerance = o->touch_tolerance < 0 ? o->gap / 10 : o->touch_tolerance;
    if (o->gap > 0 && tolerance >= o->gap)
        return sunder_i_fail(err, SUNDER_EARG, "the touch tolerance, %g, is not less than the gap, %g", tolerance,
                             o->gap);
    if ((int)o->contained < SUNDER_CONTAINMENT_BLOCK || (int)o->contained > SUNDER_CONTAINMENT_SEPARATE)
        return sunder_i_fail(err, SUNDER_EARG, "no such treatment of contained features: %d", (int)o->contained);
    if (!(o->thin >= 0) || !isfinite(o->thin))
        return sunder_i_fail(err, SUNDER_EARG, "what counts as thin, %g, is negative or not finite", o->thin);
    if (!(o->effort >= 0) || !isfinite(o->effort))
        return sunder_i_fail(err, SUNDER_EARG, "the effort, %g, is negative or not finite", o->effort);
    if (!(o->barrier_reach >= 0))
        return sunder_i_fail(err, SUNDER_EARG, "the reach of barriers, %g, is negative or no number", o->barrier_reach);
    rules->gap = o->gap;
    rules->tolerance = tolerance;
    rules->barriers_known = o->barrier_reach;
    rules->disc = NULL; /* until there is a model */
    rules->touch_joins = !o->no_blocks && !o->no_touch;
    rules->containment_joins = !o->no_blocks && o->contained == SUNDER_CONTAINMENT_BLOCK;
    rules->thin = rules->touch_joins && !(tolerance > 0) ? o->thin : 0;
    rules->list_inside = o->list_inside;
    rules->jumps = o->allow_jumps;
    rules->contained = o->contained;
    rules->effort = o->effort;
    rules->seed = o->seed;
    rules->keep_trees = o->keep_trees;
    rules->keep_pushes = o->keep_pushes;
    rules->keep_worlds = o->keep_worlds;
    rules->drop_proofs = o->drop_proofs;
    rules->threads = o->threads ? o->threads > MOST_THREADS ? MOST_THREADS : o->threads : processors();
    rules->progress = o->progress;
    rules->progress_user = o->progress_user;
    return SUNDER_OK;
}

bool sunder_i_progress(const sunder_i_rules *rules, double fraction)
{
    return rules->progress ? rules->progress(fraction, rules->progress_user) : sunder_i_look();
}
