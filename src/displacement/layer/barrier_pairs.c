/* Exact questions about a pair of a feature and a barrier.
 *
 * Whether the two are near or overlap is asked of one part of the barrier. All other questions are asked of the whole
 * barrier, since a feature that leaves one part may be inside another. The whole barrier is represented by its pieces
 * within a certain reach of the feature's box. A distance is final if it is at most the reach, and so is a least
 * translation if its length plus the gap is: pieces farther away cannot have changed the result, since no translation
 * of that length meets them. Otherwise the reach is multiplied by GROWTH. */
#include "displacement/layer/barrier_pairs.h"

#include "separation/separation.h"
#include "shape/shape.h"

#include "base/extremes.h"

#include <math.h>

/* The factor by which the reach grows from one attempt to the next. */
#define GROWTH 4
/* A length in doubles, multiplied by this, is at least the true length. */
#define ABOVE (1 + 0x1p-20)

/* Two lengths are nearly equal if their relative difference is at most this. The errors of the bounds of lengths are
 * far smaller. */
#define NEARLY 0x1p-28

/* ---- The feature, and the pieces of the barrier near it ---------------------------------------------------------- */

static void box_of(const sunder_i_translate *feature, double box[4])
{
    for (int c = 0; c < 4; c++) box[c] = feature->shape->box[c] + feature->t[c & 1];
    sunder_i_box_grow(box, 0, box);
}

static double extent_of(const double box[4]) { return sunder_i_max(box[2] - box[0], box[3] - box[1]); }

/* Returns the feature in the form that a test against `other` needs: against a barrier without area its interior cover
 * (pieces whose interiors cover the whole interior), if it has one; else its shape. */
static const sunder_shape *form_against(const sunder_i_translate *feature, const sunder_shape *other)
{
    return other->flat && feature->interior_cover ? feature->interior_cover : feature->shape;
}

static sunder_status find_near(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                               double reach, bool areas, sunder_shape **out, sunder_error *err)
{
    double box[4];
    box_of(feature, box);
    return sunder_i_barrier_near(model->barriers, &model->tree, (uint32_t)model->features,
                                 sunder_i_barrier_of(model, part), box, reach, areas, out, err);
}

/* ---- One part ---------------------------------------------------------------------------------------------------- */

/* Sets *drawn if the feature is nearer to the part than half the barrier's width, `width`. The caller knows that the
 * feature is nearer to the part than the required distance and that their interiors do not meet. */
static sunder_status is_on_drawn(double width, const double required[2], const sunder_shape *part,
                                 const sunder_shape *feature, const double t[2], bool *drawn, sunder_error *err)
{
    const double half[2] = {width, 0};
    bool apart = false;
    *drawn = required[0] == half[0] && required[1] == 0;
    if (*drawn || !(half[0] > 0)) return SUNDER_OK;
    const sunder_status status = sunder_i_apart_by(part, NULL, feature, t, half, &apart, err);
    *drawn = !apart;
    return status;
}

sunder_status sunder_i_barrier_relate(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                      sunder_i_relation *relation, sunder_error *err)
{
    const sunder_shape *shape = sunder_i_thing_shape(model, part), *own = form_against(feature, shape);
    const double *required = sunder_i_required_of(model, relation->a, part);
    bool apart = false;
    relation->near = relation->overlap = relation->drawn = relation->contained = relation->a_in_b =
        relation->duplicate = relation->touch = relation->kept = false;
    sunder_status status = sunder_i_overlap(shape, NULL, own, feature->t, &relation->overlap, err);
    if (!status && !relation->overlap && required[0] > 0)
        status = sunder_i_apart_by(shape, NULL, own, feature->t, required, &apart, err);
    else
        apart = !relation->overlap;
    relation->near = !apart;
    if (status || apart || relation->overlap) return status;
    const double half = model->barriers->half[sunder_i_barrier_of(model, part)];
    return is_on_drawn(half, required, shape, own, feature->t, &relation->drawn, err);
}

/* ---- The whole barrier ------------------------------------------------------------------------------------------- */

sunder_status sunder_i_barrier_least(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     double gap, double upper, sunder_separation *out, bool *beyond, sunder_error *err)
{
    double box[4], reach;
    box_of(feature, box);
    reach = sunder_i_max(gap, extent_of(box) / 2);
    *out = (sunder_separation){.overlap = false};
    *beyond = false;
    for (bool last = false; !last; reach *= GROWTH) {
        sunder_shape *near = NULL;
        last = !(reach < upper);
        if (last) reach = upper;
        sunder_status status = find_near(model, feature, part, reach * ABOVE + gap, false, &near, err);
        if (status) return status;
        bool far = false;
        if (near)
            status = sunder_i_separate(near, NULL, form_against(feature, near), feature->t, gap, reach, out, &far, err);
        sunder_shape_free(near);
        if (status) return status;
        if (!far) return SUNDER_OK;
        sunder_separation_clear(out);
    }
    out->lower_bound = upper;
    *beyond = true;
    return SUNDER_OK;
}

static sunder_status find_distance(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                   sunder_i_barrier_stance *out, sunder_error *err)
{
    double box[4];
    box_of(feature, box);
    double reach = sunder_i_max(sunder_i_owed_most(model, part), extent_of(box));
    for (bool found = false; !found; reach = found ? reach : reach * GROWTH) {
        sunder_shape *near = NULL;
        sunder_status status = find_near(model, feature, part, reach, false, &near, err);
        if (!status && near)
            status =
                sunder_i_distance(feature->shape, feature->t, near, NULL, &out->distance, out->on[0], out->on[1], err);
        found = near && out->distance <= reach;
        /* The distance found so far is an upper bound: no reach beyond it is needed. */
        if (near && !found) reach = sunder_i_max(reach, out->distance * ABOVE / GROWTH);
        sunder_shape_free(near);
        if (status) return status;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_barrier_stand(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     sunder_i_barrier_stance *out, sunder_error *err)
{
    *out = (sunder_i_barrier_stance){.overlap = false};
    sunder_shape *near = NULL;
    sunder_status status = find_near(model, feature, part, 0, false, &near, err);
    if (!status && near)
        status = sunder_i_overlap(near, NULL, form_against(feature, near), feature->t, &out->overlap, err);
    sunder_shape_free(near);
    bool beyond;
    if (status) return status;
    return out->overlap ? sunder_i_barrier_least(model, feature, part, 0, INFINITY, &out->least, &beyond, err)
                        : find_distance(model, feature, part, out, err);
}

/* ---- Is a pair worse than at the start? -------------------------------------------------------------------------- */

sunder_status sunder_i_barrier_holds(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     bool *holds, sunder_error *err)
{
    sunder_shape *near = NULL;
    *holds = false;
    sunder_status status = find_near(model, feature, part, 0, true, &near, err);
    if (!status && near) status = sunder_i_contained(feature->shape, feature->t, near, NULL, holds, err);
    sunder_shape_free(near);
    return status;
}

sunder_status sunder_i_barrier_apart(const sunder_i_model *model, const sunder_i_translate *feature, uint32_t part,
                                     double length, bool *apart, sunder_error *err)
{
    sunder_shape *near = NULL;
    *apart = true;
    sunder_status status = find_near(model, feature, part, length, false, &near, err);
    if (!status && near)
        status = sunder_i_apart(near, NULL, form_against(feature, near), feature->t, length, apart, err);
    sunder_shape_free(near);
    return status;
}

static sunder_status compare_stances(const sunder_i_model *model, const sunder_i_translate *was,
                                     const sunder_i_translate *is, uint32_t part, double reach, bool *worse,
                                     sunder_error *err)
{
    sunder_shape *then = NULL, *now = NULL;
    sunder_status status = find_near(model, was, part, reach, false, &then, err);
    if (!status) status = find_near(model, is, part, reach, false, &now, err);
    if (!status && then && now) {
        const sunder_i_pair before = {then, form_against(was, then), NULL, was->t},
                            after = {now, form_against(is, now), NULL, is->t};
        status = sunder_i_pair_worsened(&before, &after, worse, err);
    }
    sunder_shape_free(then);
    sunder_shape_free(now);
    return status;
}

sunder_status sunder_i_barrier_worsened(const sunder_i_model *model, const sunder_i_translate *was,
                                        const sunder_i_translate *is, uint32_t part, bool *worse, sunder_error *err)
{
    sunder_i_barrier_stance then, now;
    bool in[2] = {false, false};
    sunder_status status = sunder_i_barrier_holds(model, was, part, &in[0], err);
    if (!status && in[0]) status = sunder_i_barrier_holds(model, is, part, &in[1], err);
    *worse = false;
    if (status || (in[0] && in[1])) return status;
    status = sunder_i_barrier_stand(model, was, part, &then, err);
    if (!status) status = sunder_i_barrier_stand(model, is, part, &now, err);
    if (status) return status;
    *worse = now.overlap;
    if (then.overlap != now.overlap) return SUNDER_OK;
    const double reach = then.overlap ? sunder_i_max(then.least.distance, now.least.distance)
                                      : sunder_i_max(then.distance, now.distance);
    return compare_stances(model, was, is, part, reach * ABOVE, worse, err);
}

/* ---- Parts of the two, compared with the whole pair -------------------------------------------------------------- */

/* Sets *worse if the pair of `feature` and `other`, both at their original places, stands worse than the pair of the
 * two given shapes, which are parts of them. If `other` is a barrier it is represented by the pieces as near as its
 * part. */
static sunder_status compare_to_parts(const sunder_i_model *model, uint32_t feature, uint32_t other,
                                      const sunder_shape *part, const sunder_shape *of_other, bool *worse,
                                      sunder_error *err)
{
    const sunder_i_pair parts = {of_other, part, NULL, NULL};
    if (!sunder_i_is_barrier(model, other))
        return sunder_i_pair_worsened(
            &parts,
            &(sunder_i_pair){sunder_i_thing_shape(model, other), sunder_i_thing_shape(model, feature), NULL, NULL},
            worse, err);
    const sunder_i_translate home = sunder_i_at_home(model, feature);
    sunder_i_barrier_stance stance;
    sunder_shape *near = NULL;
    sunder_status status = sunder_i_barrier_stand(model, &home, other, &stance, err);
    const double reach = stance.overlap ? stance.least.distance : stance.distance;
    if (!status) status = find_near(model, &home, other, reach * ABOVE, false, &near, err);
    if (!status && near)
        status =
            sunder_i_pair_worsened(&parts, &(sunder_i_pair){near, form_against(&home, near), NULL, home.t}, worse, err);
    sunder_shape_free(near);
    return status;
}

/* Sets *so if the whole pair stands exactly as its two convex parts do. The whole pair never stands better than parts
 * of it, so *so is set unless the whole pair stands worse. */
sunder_status sunder_i_parts_stand_so(const sunder_i_model *model, uint32_t feature, uint32_t other,
                                      const sunder_i_piece_of *part, const sunder_i_piece_of *of_other, bool *so,
                                      sunder_error *err)
{
    sunder_shape *p = NULL, *q = NULL;
    bool worse = true;
    sunder_status status = sunder_i_shape_of_pieces(part, 1, &p, err);
    if (!status) status = sunder_i_shape_of_pieces(of_other, 1, &q, err);
    if (!status) status = compare_to_parts(model, feature, other, p, q, &worse, err);
    *so = !status && !worse;
    sunder_shape_free(p);
    sunder_shape_free(q);
    return status;
}

/* ---- Two things, of which the second may be a part of a barrier -------------------------------------------------- */

sunder_status sunder_i_resolve_things(const sunder_i_model *model, size_t a, size_t b, double upper,
                                      sunder_i_resolution *out, sunder_error *err)
{
    if (!sunder_i_is_barrier(model, (uint32_t)b))
        return sunder_i_resolve(&model->rules, sunder_i_gap_of(model, (uint32_t)a, (uint32_t)b),
                                sunder_i_thing_shape(model, a), sunder_i_thing_shape(model, b), upper, out, err);
    const sunder_i_translate home = sunder_i_at_home(model, (uint32_t)a);
    const double gap = sunder_i_owed_below(model, (uint32_t)a, (uint32_t)b);
    sunder_separation least;
    *out = (sunder_i_resolution){0};
    const sunder_status status =
        sunder_i_barrier_least(model, &home, (uint32_t)b, gap, upper, &least, &out->beyond, err);
    if (status) return status;
    out->least = sunder_i_max(0, least.lower_bound);
    out->apart_beyond = out->beyond = out->beyond || out->least > upper;
    return SUNDER_OK;
}

sunder_status sunder_i_resolve_within(const sunder_i_model *model, size_t a, size_t b, const double limit[2],
                                      sunder_i_resolution *out, sunder_error *err)
{
    const double sum = limit[0] + limit[1];
    bool within;
    sunder_status status = sunder_i_resolve_things(model, a, b, nextafter(sum, INFINITY), out, err);
    if (status || out->beyond || sum == INFINITY || sunder_i_is_barrier(model, (uint32_t)b) ||
        sunder_i_gap_of(model, (uint32_t)a, (uint32_t)b) > 0 || sunder_i_may_be_inside(&model->rules) ||
        out->least < sum * (1 - NEARLY))
        return status;
    status = sunder_i_parts_within(sunder_i_thing_shape(model, a), sunder_i_thing_shape(model, b), limit, &within, err);
    if (!status) out->apart_beyond = out->beyond = !within;
    return status;
}
