/* gap_test.c: tests whether two sets keep the gap: their interiors are disjoint, and no two points of them are closer
 * than the gap.
 *
 * If the interiors are disjoint, the distance of the sets is that of two boundary edges, and since no two edges cross
 * properly, that of an end of one edge from the other. Doubles decide all pairs of edges except those whose distance
 * equals the gap to within the error; these are compared exactly, on a lattice that contains the gap, too. */
#include "separation/separation.h"

#include "separation/operands/pair_operands.h"

#include "base/extremes.h"

#include <math.h>

/* Returns the boundary edges of one operand that may be within `reach` of the other, as the numbers of their first
 * vertices; NULL if out of memory. */
static uint32_t *edges_near(sunder_i_operands *g, int side, double reach, uint32_t *n)
{
    const sunder_shape *s = g->shape[side];
    uint32_t *list = sunder_i_arena_alloc(&g->placed.lattice.arena, s->vertices, sizeof *list);
    *n = 0;
    if (!list) return NULL;
    for (uint32_t v = 0; v < s->vertices; v++) {
        double box[4];
        sunder_i_box_of_segment(g->xy[side] + 2 * v, g->xy[side] + 2 * s->form->cleaned.next[v], box);
        if (sunder_i_box_near(box, g->box[!side], reach)) list[(*n)++] = v;
    }
    return list;
}

typedef enum nearness { FAR, NEAR, IN_DOUBT } nearness;

/* Returns whether edge i of P and edge j of Q are closer than `units` lattice units, in doubles. The interiors of P and
 * Q are disjoint. */
static nearness edges_near_each_other(const sunder_i_operands *g, uint32_t i, uint32_t j, double units)
{
    const uint32_t in = g->shape[0]->form->cleaned.next[i], jn = g->shape[1]->form->cleaned.next[j];
    const double *a = g->xy[0] + 2 * i, *b = g->xy[0] + 2 * in, *c = g->xy[1] + 2 * j, *d = g->xy[1] + 2 * jn;
    const double doubt = 16 * g->error + 0x1p-50 * units, reach = units + doubt;
    double ab[4], cd[4];
    sunder_i_box_of_segment(a, b, ab);
    sunder_i_box_of_segment(c, d, cd);
    if (!sunder_i_box_near(ab, cd, reach)) return FAR;
    /* With disjoint interiors no two edges cross properly, so that the least distance is at an end of an edge. The
     * coordinates have at most the error g->error, hence the distance has an error of less than 8 times that. */
    const double square = sunder_i_min(sunder_i_min(sunder_i_point_square(a, c, d), sunder_i_point_square(b, c, d)),
                                       sunder_i_min(sunder_i_point_square(c, a, b), sunder_i_point_square(d, a, b)));
    const double distance = sqrt(square);
    return distance + doubt < units ? NEAR : distance - doubt > units ? FAR : IN_DOUBT;
}

static bool exactly_near(sunder_i_operands *g, uint32_t i, uint32_t j, int64_t gap)
{
    const uint32_t in = g->shape[0]->form->cleaned.next[i], jn = g->shape[1]->form->cleaned.next[j];
    return sunder_i_segment_distance_cmp(&g->placed.lattice, g->at[0][i], g->at[0][in], g->at[1][j], g->at[1][jn],
                                         gap) < 0;
}

static bool exactly_touch(sunder_i_operands *g, uint32_t i, uint32_t j)
{
    const uint32_t in = g->shape[0]->form->cleaned.next[i], jn = g->shape[1]->form->cleaned.next[j];
    return sunder_i_segments_meet(&g->placed.lattice, g->at[0][i], g->at[0][in], g->at[1][j], g->at[1][jn]) !=
           SUNDER_I_APART;
}

/* Returns whether an edge of P is closer to one of Q than the gap. With `gap` (in lattice units) the result is exact;
 * with NULL it is computed in doubles and may be IN_DOUBT. */
static nearness any_near(sunder_i_operands *g, double units, const int64_t *gap)
{
    uint32_t m, n;
    const double reach = units + 16 * g->error + 0x1p-50 * units;
    const uint32_t *p = edges_near(g, 0, reach, &m), *q = edges_near(g, 1, reach, &n);
    if (!p || !q) return IN_DOUBT;
    nearness worst = FAR;
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++) {
            const nearness now = edges_near_each_other(g, p[i], q[j], units);
            if (now == NEAR) return NEAR;
            if (now == FAR) continue;
            if (gap && exactly_near(g, p[i], q[j], *gap)) return NEAR;
            if (!gap) worst = IN_DOUBT;
        }
    return worst;
}

/* Returns whether P and Q, whose interiors are disjoint, are closer than `length` (in the caller's units), in
 * doubles. */
static nearness roughly_near(sunder_i_operands *g, double length)
{
    const double units = length / g->unit;
    return units >= 0 && units < 0x1p500 && (units > 0 || length == 0) ? any_near(g, units, NULL) : IN_DOUBT;
}

/* Returns whether an edge of P and one of Q have a common point; exact. The interiors are disjoint. */
static nearness any_touch(sunder_i_operands *g)
{
    uint32_t m, n;
    const double reach = 16 * g->error;
    const uint32_t *p = edges_near(g, 0, reach, &m), *q = edges_near(g, 1, reach, &n);
    if (!p || !q) return IN_DOUBT;
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++)
            if (edges_near_each_other(g, p[i], q[j], 0) != FAR && exactly_touch(g, p[i], q[j])) return NEAR;
    return FAR;
}

/* Tests the gap exactly, on a lattice that contains the gap; it may be finer than that of the shapes alone. */
static sunder_status exactly_apart(const sunder_shape *p, const sunder_shape *q,
                                   const sunder_i_operands_options *options, const double gap[2], bool *apart,
                                   sunder_error *err)
{
    sunder_i_operands_options with_gap = *options;
    with_gap.extra = gap;
    with_gap.extra_n = 2;
    sunder_i_operands g;
    sunder_status status = sunder_i_operands_init(&g, p, q, &with_gap, err);
    if (status) return status;
    sunder_i_lattice *l = &g.placed.lattice;
    const int64_t n = sunder_i_operands_add(&g, (sunder_i_point){sunder_i_lattice_int(l, gap[0], 0), 0},
                                            (sunder_i_point){sunder_i_lattice_int(l, gap[1], 0), 0})
                          .x;
    const nearness answer = any_near(&g, sunder_i_approx(l, n), &n);
    status = sunder_i_operands_end(&g, err);
    if (status == SUNDER_OK) *apart = answer == FAR;
    return status;
}

sunder_status sunder_i_apart_by(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                const double gap[2], bool *apart, sunder_error *err)
{
    /* the low part of the gap is less than the error of comparisons in doubles */
    const double most = gap[1] > 0 ? nextafter(gap[0], INFINITY) : gap[0];
    if (p->pieces == 0 || q->pieces == 0 || sunder_i_boxes_apart(p, tp, q, tq, most) ||
        sunder_i_surely_apart(p, tp, q, tq, most)) {
        *apart = true;
        return SUNDER_OK;
    }
    sunder_i_operands g;
    const sunder_i_operands_options options = {.tp = tp, .tq = tq};
    sunder_status status = sunder_i_operands_init(&g, p, q, &options, err);
    if (status) return status;
    nearness answer = sunder_i_operands_overlap(&g) ? NEAR : FAR;
    if (answer == FAR && gap[0] > 0) answer = roughly_near(&g, gap[0]);
    status = sunder_i_operands_end(&g, err);
    if (status) return status;
    if (answer == IN_DOUBT) return exactly_apart(p, q, &options, gap, apart, err);
    *apart = answer == FAR;
    return SUNDER_OK;
}

sunder_status sunder_i_meet(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                            double gap, double tolerance, sunder_i_encounter *out, sunder_error *err)
{
    /* shapes whose boxes only touch may touch */
    const double far = sunder_i_max(sunder_i_max(gap, tolerance), 0x1p-1074);
    *out = (sunder_i_encounter){.apart = true};
    if (p->pieces == 0 || q->pieces == 0 || sunder_i_boxes_apart(p, tp, q, tq, far)) return SUNDER_OK;
    if (sunder_i_surely_apart(p, tp, q, tq, far)) return SUNDER_OK;
    sunder_i_operands g;
    const sunder_i_operands_options options = {.tp = tp, .tq = tq};
    sunder_status status = sunder_i_operands_init(&g, p, q, &options, err);
    if (status) return status;
    nearness at_gap = FAR, at_tolerance = FAR;
    out->overlap = !sunder_i_boxes_apart(p, tp, q, tq, 0) && sunder_i_operands_overlap(&g);
    if (!out->overlap && gap > 0) at_gap = roughly_near(&g, gap);
    if (!out->overlap && (at_gap != FAR || !(gap > tolerance)))
        at_tolerance = tolerance > 0 ? roughly_near(&g, tolerance) : any_touch(&g);
    status = sunder_i_operands_end(&g, err);
    if (status || out->overlap) return status;
    out->touch = at_tolerance == NEAR;
    out->may_touch = at_tolerance != FAR;
    out->apart = at_gap == FAR;
    return at_gap == IN_DOUBT ? exactly_apart(p, q, &options, (double[2]){gap, 0}, &out->apart, err) : SUNDER_OK;
}

sunder_status sunder_i_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                             double gap, bool *apart, sunder_error *err)
{
    return sunder_i_apart_by(p, tp, q, tq, (double[2]){gap, 0}, apart, err);
}

sunder_status sunder_pair_apart(const sunder_shape *p, const sunder_shape *q, double gap, bool *apart,
                                sunder_error *err)
{
    if (!(gap >= 0) || !isfinite(gap))
        return sunder_i_fail(err, SUNDER_EARG, "the gap must be finite and not negative");
    return sunder_i_apart(p, NULL, q, NULL, gap, apart, err);
}
