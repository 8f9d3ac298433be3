/* The options of a layer: their defaults, their ranges, and the rules made from them. */
#include "displacement/layer/layer.h"

#include "base/error.h"
#include "base/extremes.h"
#include "base/sized_struct.h"
#include "base/watch.h"

#include <math.h>
#include <unistd.h>

/* The greatest number of threads. More would only wait, as no layer has that many clusters of significant size. */
#define MOST_THREADS 256

void sunder_layer_options_init_sized(sunder_layer_options *options, size_t size)
{
    static const sunder_layer_options defaults = {.touch_tolerance = -1,
                                                  .contained = SUNDER_CONTAINMENT_BLOCK,
                                                  .threads = 1,
                                                  .effort = 1,
                                                  .barrier_reach = INFINITY,
                                                  .kink = -1,
                                                  .row_stiffness = {3, 0.3}};
    sunder_i_options_write(options, size, &defaults, sizeof defaults);
}

static unsigned count_processors(void)
{
    const long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > MOST_THREADS ? MOST_THREADS : (unsigned)n;
}

/* Fails if one of the options that are lengths, prices or factors is out of its range. */
static sunder_status check_amounts(const sunder_layer_options *o, sunder_error *err)
{
    const struct {
        const char *name;
        double value;
    } amount[] = {{"gap", o->gap},
                  {"full gap", o->full_gap},
                  {"tolerance of thin overlaps", o->thin},
                  {"effort", o->effort},
                  {"stiffness of rows", o->row_stiffness[0]},
                  {"stiffness of rows", o->row_stiffness[1]},
                  {"price of easing", o->ease}};
    for (size_t k = 0; k < sizeof amount / sizeof *amount; k++)
        if (!(amount[k].value >= 0) || !isfinite(amount[k].value))
            return sunder_i_fail(err, SUNDER_EARG, "the %s, %g, is negative or not finite", amount[k].name,
                                 amount[k].value);
    if (!(o->barrier_reach >= 0))
        return sunder_i_fail(err, SUNDER_EARG, "the reach of barriers, %g, is negative or not a number",
                             o->barrier_reach);
    if (isnan(o->kink)) return sunder_i_fail(err, SUNDER_EARG, "the kink that counts is not a number");
    if (isnan(o->touch_tolerance) || o->touch_tolerance == INFINITY)
        return sunder_i_fail(err, SUNDER_EARG, "the touch tolerance, %g, is not finite", o->touch_tolerance);
    return SUNDER_OK;
}

sunder_status sunder_i_rules_of(const sunder_layer_options *options, sunder_i_rules *rules, sunder_error *err)
{
    const sunder_status status = check_amounts(options, err);
    if (status) return status;
    const double full = sunder_i_max(options->gap, options->full_gap),
                 tolerance = options->touch_tolerance < 0 ? full / 10 : options->touch_tolerance;
    if (full > 0 && tolerance >= full)
        return sunder_i_fail(err, SUNDER_EARG, "the touch tolerance, %g, is not less than the gap, %g", tolerance,
                             full);
    if ((int)options->contained < SUNDER_CONTAINMENT_BLOCK || (int)options->contained > SUNDER_CONTAINMENT_SEPARATE)
        return sunder_i_fail(err, SUNDER_EARG, "no such treatment of contained features: %d", (int)options->contained);
    if ((int)options->rows < SUNDER_ROWS_NONE || (int)options->rows > SUNDER_ROWS_GIVEN)
        return sunder_i_fail(err, SUNDER_EARG, "no such choice of rows: %d", (int)options->rows);
    rules->gap = options->gap;
    rules->full_gap = full;
    rules->has_full = options->full_gap > 0;
    rules->tolerance = tolerance;
    rules->disc = NULL; /* set when the model is made */
    rules->touch_joins = !options->no_blocks && !options->no_touch;
    rules->containment_joins = !options->no_blocks && options->contained == SUNDER_CONTAINMENT_BLOCK;
    rules->thin = rules->touch_joins && !(tolerance > 0) ? options->thin : 0;
    rules->list_inside = options->list_inside;
    rules->jumps = options->allow_jumps;
    rules->contained = options->contained;
    rules->effort = options->effort;
    rules->seed = options->seed;
    rules->keep_trees = options->keep_trees;
    rules->keep_pushes = options->keep_pushes;
    rules->keep_worlds = options->keep_worlds;
    rules->drop_proofs = options->drop_proofs;
    rules->threads =
        options->threads ? options->threads > MOST_THREADS ? MOST_THREADS : options->threads : count_processors();
    rules->progress = options->progress;
    rules->progress_user = options->progress_user;
    rules->trace = options->trace;
    rules->trace_user = options->trace_user;
    rules->rows = options->rows;
    for (int k = 0; k < 2; k++) rules->row_stiffness[k] = options->rows ? options->row_stiffness[k] : 0;
    rules->ease = options->ease;
    rules->kink = options->kink < 0 ? full / 10 : options->kink;
    return SUNDER_OK;
}

bool sunder_i_progress(const sunder_i_rules *rules, double fraction)
{
    return rules->progress ? rules->progress(fraction, rules->progress_user) : sunder_i_look();
}
