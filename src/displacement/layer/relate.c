/* The relation of two features, exactly.
 *
 *   near       their interiors meet, or their distance is less than the gap
 *   touch      their interiors are disjoint and their distance, as the nearest double, is at most the tolerance; or
 *              their interiors meet, but the overlap is at most the tolerance (thin_overlap.c)
 *   contained  their interiors meet, and P lies in Q; or, with a tolerance, P lies in Q + D, where D is a polygon of
 *              16 corners in the disc whose radius is the tolerance (a point of P may then lie outside Q by the
 *              tolerance at most, and by 0.93 of it in any direction), and the corners of Q + D are rounded to the
 *              nearest doubles
 *   duplicate  each lies in the other, with no tolerance
 *
 * Disjoint interiors at distance 0 touch even with the tolerance 0: the nearest double of a positive distance is
 * positive. */
#include "displacement/layer/resolution.h"

#include "base/list.h"
#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>

/* A cheap test: returns false only if P's box certainly exceeds Q's box by more than `reach` in some direction. 8 units
 * in the last place cover the four roundings on each side. */
static bool box_may_lie_in(const sunder_i_translate *p, const sunder_i_translate *q, double reach)
{
    double a[4], b[4];
    sunder_shape_box(p->shape, a);
    sunder_shape_box(q->shape, b);
    for (int k = 0; k < 4; k++) {
        const double tp = p->t[k & 1], tq = q->t[k & 1];
        const double slack = (fabs(a[k]) + fabs(tp) + fabs(b[k]) + fabs(tq) + reach) * 0x1p-49;
        const double d = (a[k] + tp) - (b[k] + tq);
        if ((k < 2 ? -d : d) > reach + slack) return false;
    }
    return true;
}

/* Sets *in if P lies in Q up to the tolerance, and *exact_in if it does so with no tolerance. */
static sunder_status lies_in(const sunder_i_translate *p, const sunder_i_translate *q, double tolerance, bool *exact_in,
                             bool *in, sunder_error *err)
{
    *exact_in = *in = false;
    if (!box_may_lie_in(p, q, tolerance)) return SUNDER_OK;
    sunder_status status = sunder_i_contained(p->shape, p->t, q->shape, q->t, exact_in, err);
    if (status) return status;
    *in = *exact_in;
    if (*in || !(tolerance > 0)) return SUNDER_OK;
    sunder_shape *grown = NULL;
    status = sunder_i_grow_by_tolerance(q->shape, tolerance, &grown, err);
    if (!status) status = sunder_i_contained(p->shape, p->t, grown, q->t, in, err);
    sunder_shape_free(grown);
    return status;
}

static sunder_status relate_overlapping(const sunder_i_rules *rules, const sunder_i_translate *a,
                                        const sunder_i_translate *b, sunder_i_relation *r, sunder_error *err)
{
    bool a_in, a_exact, b_in, b_exact;
    sunder_status status = lies_in(a, b, rules->tolerance, &a_exact, &a_in, err);
    if (!status) status = lies_in(b, a, rules->tolerance, &b_exact, &b_in, err);
    if (status) return status;
    r->near = r->overlap = true;
    r->contained = a_in || b_in;
    r->a_in_b = a_in;
    r->duplicate = a_exact && b_exact;
    r->kept = r->contained && sunder_i_may_be_inside(rules);
    if (r->contained) return SUNDER_OK;
    return sunder_i_overlap_is_thin(a, b, rules->tolerance, rules->disc, &r->touch, err);
}

/* Sets *distance to the distance of two disjoint sets, each of which may be translated. */
static sunder_status distance_between(const sunder_i_translate *a, const sunder_i_translate *b, double *distance,
                                      sunder_error *err)
{
    double on_a[2], on_b[2];
    if (a->t[0] == 0 && a->t[1] == 0 && b->t[0] == 0 && b->t[1] == 0)
        return sunder_pair_distance(a->shape, b->shape, distance, on_a, on_b, err);
    sunder_shape *p = NULL, *q = NULL;
    bool exact;
    sunder_status status = sunder_shape_translate(a->shape, a->t[0], a->t[1], &p, &exact, err);
    if (!status) status = sunder_shape_translate(b->shape, b->t[0], b->t[1], &q, &exact, err);
    if (!status) status = sunder_pair_distance(p, q, distance, on_a, on_b, err);
    sunder_shape_free(p);
    sunder_shape_free(q);
    return status;
}

sunder_status sunder_i_relate(const sunder_i_rules *rules, double gap, const sunder_i_translate *a,
                              const sunder_i_translate *b, sunder_i_relation *relation, sunder_error *err)
{
    relation->near = relation->overlap = relation->drawn = relation->contained = relation->a_in_b =
        relation->duplicate = relation->touch = relation->kept = false;
    sunder_i_encounter m;
    sunder_status status = sunder_i_meet(a->shape, a->t, b->shape, b->t, gap, rules->tolerance, &m, err);
    if (status) return status;
    if (m.overlap) return relate_overlapping(rules, a, b, relation, err);
    relation->near = !m.apart;
    relation->touch = m.touch;
    if (m.touch || !m.may_touch || (m.apart && gap > rules->tolerance)) return SUNDER_OK;
    double distance;
    status = distance_between(a, b, &distance, err);
    if (!status) relation->touch = distance <= rules->tolerance;
    return status;
}

const sunder_i_relation *sunder_i_relations_find(const sunder_i_relations *relations, uint32_t a, uint32_t b)
{
    const sunder_i_relation key = {.a = a, .b = b};
    return relations->n ? bsearch(&key, relations->pair, relations->n, sizeof key, sunder_i_by_id_pair) : NULL;
}
