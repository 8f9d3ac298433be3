/* Which road leads to the sum: a merge for two convex operands; the convolution where one is convex and the other one
 * polygon, unless it is not tame; rectangles where all sides run along the axes; else the outline of the union of all
 * subsums. Other roads are taken when asked for (../unions/). */
#include "minkowski/minkowski.h"

#include "base/clock.h"
#include "base/invariant.h"
#include "base/watch.h"
#include "convex/subsums.h"
#include "minkowski/convex_operands.h"
#include "minkowski/convolution.h"
#include "outline/contained_sides.h"
#include "outline/outline.h"
#include "rectilinear/rectilinear_sum.h"
#include "sum/canonical.h"
#include "sum/place.h"
#include "unions/unions.h"

/* The general road. */
static sunder_status unite_subsums(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q,
                                   const sunder_i_placed *at, double start, const sunder_sum_options *options,
                                   sunder_error *err)
{
    sunder_i_convex_pieces subsums;
    sunder_i_directions directions;
    sunder_status status = sunder_i_subsums_build(&sum->lattice, p, at->p, q, at->q, &directions, &subsums, err);
    if (status != SUNDER_OK) return status;
    /* Members overlap as they stand, and more once they are grown; else few sides are inside a single subsum. */
    if (p->polygons > 1 || q->polygons > 1) status = sunder_i_drop_contained_sides(&subsums, err);
    sum->seconds[1] = sunder_i_now() - start;
    if (status == SUNDER_OK) status = sunder_i_outline_find(&subsums, options, NULL, NULL, sum, err);
    sunder_i_convex_pieces_free(&subsums);
    sunder_i_directions_free(&directions);
    return status;
}

static sunder_status build(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q, bool force_wide,
                           const sunder_sum_options *options, sunder_error *err)
{
    const double start = sunder_i_now();
    sunder_i_placed at;
    sunder_status status = sunder_i_sum_place(sum, p, q, force_wide, &at, err);
    if (status != SUNDER_OK) return status;
    bool done = sunder_i_are_convex(p, q);
    if (done)
        status = sunder_i_convex_operands_sum(sum, p, at.p, q, at.q, err);
    else if (q->pieces == 1)
        status = sunder_i_convolution_sum(sum, p, at.p, q, at.q, &done, err);
    else if (p->pieces == 1)
        status = sunder_i_convolution_sum(sum, q, at.q, p, at.p, &done, err);
    if (status == SUNDER_OK && !done) status = sunder_i_rectilinear_sum(sum, p, at.p, q, at.q, &done, err);
    if (status == SUNDER_OK && !done) status = unite_subsums(sum, p, q, &at, start, options, err);
    sunder_i_placed_free(&at);
    sum->seconds[2] = sunder_i_now() - start - sum->seconds[1];
    return status;
}

/* Is each option one of its values? */
static sunder_status check_options(const sunder_sum_options *o, sunder_error *err)
{
    if ((unsigned)o->algorithm > SUNDER_ALGORITHM_DIVIDE)
        return sunder_i_fail(err, SUNDER_EARG, "there is no such algorithm");
    if ((unsigned)o->decomposition > SUNDER_DECOMPOSITION_MIXED)
        return sunder_i_fail(err, SUNDER_EARG, "there is no such decomposition");
    if ((unsigned)o->order > SUNDER_ORDER_GIVEN) return sunder_i_fail(err, SUNDER_EARG, "there is no such order");
    if (o->keep_map && o->algorithm == SUNDER_ALGORITHM_CONVOLUTION)
        return sunder_i_fail(err, SUNDER_EARG, "the convolution makes no planar map; the other algorithms do");
    return SUNDER_OK;
}

sunder_status sunder_i_minkowski_sum(const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                     const sunder_sum_options *options, sunder_sum **out, sunder_error *err)
{
    sunder_sum_options o = {0};
    if (options) o = *options;
    sunder_status status = check_options(&o, err);
    if (status != SUNDER_OK) return status;
    sunder_sum *sum = sunder_i_calloc(1, sizeof *sum);
    if (!sum) return sunder_i_no_memory(err);
    sum->method.algorithm = o.algorithm  ? o.algorithm
                            : o.keep_map ? SUNDER_ALGORITHM_ARRANGEMENT
                                         : SUNDER_ALGORITHM_CONVOLUTION;
    sunder_i_watch watch;
    sunder_i_watch_begin(&watch, &o.progress, &o.progress_user);
    if (sum->method.algorithm == SUNDER_ALGORITHM_CONVOLUTION)
        status = build(sum, p, q, force_wide, &o, err);
    else
        status = sunder_i_union_sum(sum, p, q, force_wide, &o, err);
    sunder_i_watch_end(&watch);
    SUNDER_I_ASSERT(status != SUNDER_OK || !sunder_i_canonical_check(sum));
    if (status == SUNDER_OK)
        *out = sum;
    else
        sunder_sum_free(sum);
    return status;
}

sunder_status sunder_minkowski_sum(const sunder_shape *p, const sunder_shape *q, const sunder_sum_options *options,
                                   sunder_sum **out, sunder_error *err)
{
    return sunder_i_minkowski_sum(p, q, false, options, out, err);
}
