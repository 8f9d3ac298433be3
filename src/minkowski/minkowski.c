/* minkowski.c: selects the method for a sum: a merge for two convex operands; the convolution if one operand is convex
 * and the other is one polygon, unless the curve is not tame; rectangles if all sides are parallel to the axes; the
 * reduced convolution for two simple polygons, unless it is large or not tame; else the outline of the union of all
 * subsums. Other algorithms are used on request (../unions/). */
#include "minkowski/minkowski.h"

#include "base/clock.h"
#include "base/invariant.h"
#include "base/sized_struct.h"
#include "base/watch.h"
#include "convex/subsums.h"
#include "minkowski/convex_operands.h"
#include "minkowski/convolution.h"
#include "minkowski/members.h"
#include "minkowski/reduced_convolution.h"
#include "outline/contained_parts.h"
#include "outline/outline.h"
#include "rectilinear/rectilinear_sum.h"
#include "sum/canonical_sum.h"
#include "sum/operands_on_lattice.h"
#include "sum/sum_of_parts.h"
#include "unions/unions.h"

#include <string.h>

/* The general method: the outline of the union of the needed subsums. */
static sunder_status unite_subsums(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q,
                                   const sunder_i_placed *at, double start, const sunder_sum_options *options,
                                   sunder_error *err)
{
    sunder_i_convex_pieces subsums;
    sunder_i_directions directions;
    sunder_status status = sunder_i_subsums_build(&sum->lattice, p, at->p, q, at->q, &directions, &subsums, err);
    if (status != SUNDER_OK) return status;
    status = sunder_i_drop_contained(&subsums, err);
    sum->seconds[1] = sunder_i_now() - start;
    if (status == SUNDER_OK) status = sunder_i_outline_find(&subsums, options, NULL, NULL, sum, err);
    sunder_i_convex_pieces_free(&subsums);
    sunder_i_directions_free(&directions);
    return status;
}

typedef struct operands {
    const sunder_shape *p, *q;
    const sunder_i_placed *at;
    double start;
} operands;

/* Moves the outline to a new sum without a lattice. Returns NULL if out of memory. */
static sunder_sum *take_outline(sunder_sum *sum)
{
    sunder_sum *part = sunder_i_calloc(1, sizeof *part);
    if (!part) return NULL;
    sunder_sum without = {.lattice = sum->lattice, .method = sum->method};
    memcpy(without.origin, sum->origin, sizeof without.origin);
    memcpy(without.seconds, sum->seconds, sizeof without.seconds);
    *part = *sum;
    memset(&part->lattice, 0, sizeof part->lattice);
    *sum = without;
    return part;
}

/* Adds the sums of those polygons that are not in the sum yet, by the general method. */
static sunder_status unite_rest(sunder_sum *sum, const operands *o, bool of_p, const sunder_i_members_left *left,
                                const sunder_sum_options *options, sunder_error *err)
{
    sunder_shape view;
    if (!sunder_i_members_view_init(of_p ? o->p : o->q, left->polygon, &view)) return sunder_i_failure_cause(err);
    sunder_sum *part[2] = {take_outline(sum), NULL};
    sunder_status status =
        part[0] ? unite_subsums(sum, of_p ? &view : o->p, of_p ? o->q : &view, o->at, o->start, options, err)
                : sunder_i_failure_cause(err);
    sunder_i_members_view_free(&view);
    if (status == SUNDER_OK) {
        part[1] = take_outline(sum);
        if (!part[1] || !sunder_i_gather(part, 2, sum)) status = sunder_i_failure_cause(err);
    }
    for (int i = 0; i < 2; i++) sunder_sum_free(part[i]);
    return status;
}

/* Adds several polygons and a single one: those with disjoint sums, or sums in small groups, by sunder_i_members_sum(),
 * the rest by the general method. *done becomes false if no polygon is suited; the sum is then unchanged. */
static sunder_status sum_members(sunder_sum *sum, const operands *o, bool *done, const sunder_sum_options *options,
                                 sunder_error *err)
{
    const bool of_p = o->p->form->cleaned.polygons > 1;
    const sunder_i_placed *at = o->at;
    sunder_i_members_left left;
    sunder_status status = of_p ? sunder_i_members_sum(sum, o->p, at->p, o->q, at->q, &left, err)
                                : sunder_i_members_sum(sum, o->q, at->q, o->p, at->p, &left, err);
    *done = status == SUNDER_OK && left.n < (of_p ? o->p : o->q)->form->cleaned.polygons;
    if (*done && left.n > 0) status = unite_rest(sum, o, of_p, &left, options, err);
    sunder_i_free(left.polygon);
    return status;
}

/* Computes the sum by one of the special methods if the operands allow it. *done: whether it did. */
static sunder_status try_special(sunder_sum *sum, const operands *o, bool *done, const sunder_sum_options *options,
                                 sunder_error *err)
{
    const sunder_shape *p = o->p, *q = o->q;
    const sunder_i_placed *at = o->at;
    const bool single = p->form->cleaned.polygons == 1 && q->form->cleaned.polygons == 1;
    sunder_status status = SUNDER_OK;
    *done = sunder_i_are_convex(p, q);
    if (p->form->cleaned.polygons == 0 || q->form->cleaned.polygons == 0) return SUNDER_OK;
    if (*done) return sunder_i_convex_operands_sum(sum, p, at->p, q, at->q, err);
    if (single && q->pieces == 1)
        status = sunder_i_convolution_sum(sum, p, at->p, q, at->q, done, err);
    else if (single && p->pieces == 1)
        status = sunder_i_convolution_sum(sum, q, at->q, p, at->p, done, err);
    if (status == SUNDER_OK && !*done) status = sunder_i_rectilinear_sum(sum, p, at->p, q, at->q, done, err);
    if (status == SUNDER_OK && !*done && single && p->pieces > 1 && q->pieces > 1)
        status = sunder_i_reduced_convolution_sum(sum, p, at->p, q, at->q, done, err);
    if (status == SUNDER_OK && !*done && !single && (p->form->cleaned.polygons == 1 || q->form->cleaned.polygons == 1))
        status = sum_members(sum, o, done, options, err);
    return status;
}

static sunder_status build_sum(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q, bool force_wide,
                               const sunder_sum_options *options, sunder_error *err)
{
    const double start = sunder_i_now();
    sunder_i_placed at;
    sunder_status status = sunder_i_sum_place(sum, p, q, force_wide, &at, err);
    if (status != SUNDER_OK) return status;
    const operands o = {p, q, &at, start};
    bool done;
    status = try_special(sum, &o, &done, options, err);
    if (status == SUNDER_OK && !done) status = unite_subsums(sum, p, q, &at, start, options, err);
    sunder_i_placed_free(&at);
    sum->seconds[2] = sunder_i_now() - start - sum->seconds[1];
    return status;
}

/* Fails with SUNDER_EARG if an option has a value that does not exist. */
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
    sunder_sum_options o = {.size = sizeof o};
    sunder_status status = sunder_i_options_read(&o, sizeof o, options, err);
    if (status == SUNDER_OK) status = check_options(&o, err);
    if (status != SUNDER_OK) return status;
    sunder_sum *sum = sunder_i_calloc(1, sizeof *sum);
    if (!sum) return sunder_i_failure_cause(err);
    sum->method.algorithm = o.algorithm  ? o.algorithm
                            : o.keep_map ? SUNDER_ALGORITHM_ARRANGEMENT
                                         : SUNDER_ALGORITHM_CONVOLUTION;
    sunder_i_watch watch;
    sunder_i_watch_begin(&watch, &o.progress, &o.progress_user);
    if (sum->method.algorithm == SUNDER_ALGORITHM_CONVOLUTION)
        status = build_sum(sum, p, q, force_wide, &o, err);
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

void sunder_sum_options_init_sized(sunder_sum_options *options, size_t size)
{
    static const sunder_sum_options defaults;
    sunder_i_options_write(options, size, &defaults, sizeof defaults);
}

sunder_status sunder_minkowski_sum(const sunder_shape *p, const sunder_shape *q, const sunder_sum_options *options,
                                   sunder_sum **out, sunder_error *err)
{
    return sunder_i_minkowski_sum(p, q, false, options, out, err);
}
