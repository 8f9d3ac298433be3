/* least_translation.c: computes the least translation of Q that separates it from P. The boxes are tested first; then
 * follows the search without a gap, where contact is allowed, or the search with a gap. */
#include "separation/least_translation.h"
#include "base/invariant.h"
#include "separation/gap/gap.h"
#include "separation/penetration/penetration.h"
#include "separation/separation.h"

#include <math.h>
#include <string.h>

sunder_status sunder_i_least(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *options,
                             sunder_separation *out, bool *beyond, sunder_error *err)
{
    sunder_separation result;
    bool far = false;
    memset(&result, 0, sizeof result);
    sunder_status status;
    if (p->pieces == 0 || q->pieces == 0 || sunder_i_boxes_apart(p, options->tp, q, options->tq, options->gap))
        status = sunder_i_stay(options->texts, &result, err);
    else if (options->gap > 0)
        status = sunder_i_least_with_gap(p, q, options, &result, &far, err);
    else
        status = sunder_i_least_without_gap(p, q, options, &result, &far, err);
    if (status) return status;
    SUNDER_I_ASSERT(result.lower_bound <= result.distance || far || options->bound_only);
    *out = result;
    if (beyond) *beyond = far;
    return SUNDER_OK;
}

sunder_status sunder_i_separate(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                double gap, double upper, sunder_separation *out, bool *beyond, sunder_error *err)
{
    const sunder_i_least_options options = {.tp = tp, .tq = tq, .gap = gap, .upper = upper};
    return sunder_i_least(p, q, &options, out, beyond, err);
}

sunder_status sunder_i_least_bound(const sunder_shape *p, const sunder_shape *q, double gap, double upper,
                                   double *lower_bound, double about[2], bool *beyond, sunder_error *err)
{
    const sunder_i_least_options options = {.gap = gap, .upper = upper, .bound_only = true};
    sunder_separation least;
    const sunder_status status = sunder_i_least(p, q, &options, &least, beyond, err);
    if (status) return status;
    *lower_bound = least.lower_bound;
    about[0] = least.dx;
    about[1] = least.dy;
    sunder_separation_clear(&least);
    return SUNDER_OK;
}

sunder_status sunder_pair_separate(const sunder_shape *p, const sunder_shape *q, double gap, sunder_separation *out,
                                   sunder_error *err)
{
    if (!(gap >= 0) || !isfinite(gap))
        return sunder_i_fail(err, SUNDER_EARG, "the gap must be finite and not negative");
    const sunder_i_least_options options = {.gap = gap, .upper = INFINITY, .texts = true};
    return sunder_i_least(p, q, &options, out, NULL, err);
}
