/* Computes how a pair stood at the start, as a bound that proofs may hold it to.
 *
 * A distance is known as a nearby double, which may be too large, so lengths just below it are tested exactly. The
 * length of a least translation is the nearest double, so the next double is an upper bound. The rule lets a feature
 * inside another go deeper, so nothing is demanded of such a pair (solve/clusters/uphold.c). */
#include "displacement/layer/requirement.h"
#include "displacement/layer/barrier_pairs.h"

#include "separation/separation.h"

#include "base/extremes.h"

#include <math.h>

/* The length tested first is smaller than the distance by a share of 2^-FIRST_BITS. If the test fails the share is
 * multiplied by 2^BITS_A_STEP, while it is less than 2^-LAST_BITS. */
#define FIRST_BITS 51
#define BITS_A_STEP 8
#define LAST_BITS 10

/* Sets *apart if the distance of the disjoint things a and b is at least `length`. */
static sunder_status are_apart(const sunder_i_model *model, uint32_t a, uint32_t b, double length, bool *apart,
                               sunder_error *err)
{
    const double none[2] = {0, 0};
    if (!sunder_i_is_barrier(model, b))
        return sunder_i_apart(sunder_i_thing_shape(model, a), none, sunder_i_thing_shape(model, b), none, length, apart,
                              err);
    const sunder_i_translate home = sunder_i_at_home(model, a);
    return sunder_i_barrier_apart(model, &home, b, length, apart, err);
}

/* Sets out->clearance to a length just below the pair's distance, which is about `near`, but at most the distance that
 * the pair has to keep. Sets it to 0 if no such length is found. */
static sunder_status below_distance(const sunder_i_model *model, double near, sunder_i_requirement *out,
                                    sunder_error *err)
{
    out->clearance = 0;
    for (int bits = FIRST_BITS; near > 0 && bits > LAST_BITS; bits -= BITS_A_STEP) {
        bool apart;
        const double length = near * (1 - ldexp(1, -bits));
        const sunder_status status = are_apart(model, out->a, out->b, length, &apart, err);
        if (status) return status;
        if (!apart) continue;
        out->clearance = sunder_i_min(length, sunder_i_owed_below(model, out->a, out->b));
        break;
    }
    return SUNDER_OK;
}

static sunder_status of_barrier(const sunder_i_model *model, sunder_i_requirement *out, sunder_error *err)
{
    const sunder_i_translate home = sunder_i_at_home(model, out->a);
    sunder_i_barrier_stance stance;
    bool inside;
    sunder_status status = sunder_i_barrier_holds(model, &home, out->b, &inside, err);
    if (status || inside) return status;
    status = sunder_i_barrier_stand(model, &home, out->b, &stance, err);
    if (status || !stance.overlap) return status ? status : below_distance(model, stance.distance, out, err);
    out->clearance = -nextafter(stance.least.distance, INFINITY);
    out->shift[0] = -stance.least.dx;
    out->shift[1] = -stance.least.dy;
    return SUNDER_OK;
}

static sunder_status of_features(const sunder_i_model *model, sunder_i_requirement *out, sunder_error *err)
{
    const double none[2] = {0, 0};
    const sunder_shape *a = sunder_i_thing_shape(model, out->a), *b = sunder_i_thing_shape(model, out->b);
    bool overlap, beyond;
    sunder_status status = sunder_i_overlap(a, none, b, none, &overlap, err);
    if (!status && !overlap) {
        double distance, on_a[2], on_b[2];
        status = sunder_pair_distance(a, b, &distance, on_a, on_b, err);
        return status ? status : below_distance(model, distance, out, err);
    }
    sunder_separation least;
    if (!status) status = sunder_i_separate(a, none, b, none, 0, INFINITY, &least, &beyond, err);
    if (status) return status;
    out->clearance = -nextafter(least.distance, INFINITY);
    out->shift[0] = least.dx;
    out->shift[1] = least.dy;
    sunder_separation_clear(&least);
    return SUNDER_OK;
}

sunder_status sunder_i_requirement_find(const sunder_i_model *model, const sunder_i_relations *start, uint32_t a,
                                        uint32_t b, sunder_i_requirement *out, sunder_error *err)
{
    *out = (sunder_i_requirement){.a = a, .b = b, .clearance = -INFINITY};
    if (sunder_i_is_barrier(model, b)) return of_barrier(model, out, err);
    const sunder_i_relation *stood = sunder_i_relations_find(start, a, b);
    return stood && stood->contained ? SUNDER_OK : of_features(model, out, err);
}

sunder_i_requirement sunder_i_requirement_of(const sunder_i_model *model, const sunder_i_relaxation *relaxation)
{
    const double *shift = relaxation->shift, depth = hypot(shift[0], shift[1]);
    const double clearance = relaxation->inside ? -INFINITY : depth > 0 ? -depth : relaxation->gap;
    return (sunder_i_requirement){
        relaxation->a, sunder_i_whole_of(model, relaxation->b), clearance, {shift[0], shift[1]}};
}

sunder_i_requirement sunder_i_requirement_below(const sunder_i_model *model, const sunder_i_relaxation *relaxation)
{
    sunder_i_requirement r = sunder_i_requirement_of(model, relaxation);
    r.clearance *= r.clearance < 0 ? 1 + 0x1p-48 : 1 - 0x1p-48;
    return r;
}
