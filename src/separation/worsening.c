/* worsening.c: tests exactly whether a pair of shapes is worse than before.
 *
 * The measure is the squared distance or, if the interiors meet, the squared length of the least translation that
 * separates them; disjoint interiors are better than overlapping ones. Both numbers are rational. Doubles decide if
 * they differ by more than their errors; else the rational numbers are compared. */
#include "separation/separation.h"

#include "predicate/rational_point.h"
#include "separation/least_translation.h"
#include "separation/operands/pair_operands.h"

#include "base/extremes.h"

#include <math.h>

/* value * 2^exponent. */
typedef struct square {
    sunder_i_ratio value;
    long exponent;
} square;

static bool is_less(sunder_i_arena *a, const square *p, const square *q)
{
    sunder_i_ratio u = p->value, v = q->value;
    const long shift = p->exponent - q->exponent;
    if (shift > 0) u.num = sunder_i_big_shl(a, u.num, (unsigned long)shift);
    if (shift < 0) v.num = sunder_i_big_shl(a, v.num, (unsigned long)-shift);
    return sunder_i_ratio_cmp(a, u, v) < 0;
}

/* ---- Disjoint pairs: distances ---- */

/* Returns the exact squared distance of vertex v of one operand from an edge of the other. */
static square end_square(sunder_i_operands *g, int side, uint32_t v, uint32_t edge)
{
    sunder_i_lattice *l = &g->placed.lattice;
    sunder_i_arena *m = &l->arena;
    if (m->failed) return (square){{{NULL, 0}, {NULL, 0}}, 0};
    const sunder_i_rational_point c = sunder_i_rational_get(m, l, g->at[side][v]);
    const sunder_i_rational_point a = sunder_i_rational_get(m, l, g->at[1 - side][edge]);
    const sunder_i_rational_point b =
        sunder_i_rational_get(m, l, g->at[1 - side][g->shape[1 - side]->form->cleaned.next[edge]]);
    const sunder_i_rational_point e = sunder_i_rational_sub(m, b, a), u = sunder_i_rational_sub(m, c, a);
    const sunder_i_rational_point w = sunder_i_rational_sub(m, c, b);
    const bool beyond_a = sunder_i_big_sign(sunder_i_rational_dot(m, u, e)) > 0;
    const bool beyond_b = beyond_a && sunder_i_big_sign(sunder_i_rational_dot(m, w, e)) >= 0;
    if (beyond_a && !beyond_b) {
        /* the denominator of e cancels */
        const sunder_i_big cross = sunder_i_rational_cross(m, e, u);
        const sunder_i_big den = sunder_i_big_mul(m, sunder_i_rational_dot(m, e, e), sunder_i_big_mul(m, u.w, u.w));
        return (square){{sunder_i_big_mul(m, cross, cross), den}, 2 * l->exponent};
    }
    const sunder_i_rational_point *d = beyond_b ? &w : &u;
    return (square){{sunder_i_rational_dot(m, *d, *d), sunder_i_big_mul(m, d->w, d->w)}, 2 * l->exponent};
}

/* Returns the least squared distance of all vertices from all edges of the other operand: the least distance in doubles
 * first, then exact ones for those that may be the least. A coordinate in doubles has an error of at most g->error.
 * With u = 2^-53 and coordinates of at most M, the foot of the perpendicular has a further error below 16 u M, and a
 * distance one of at most 8 g->error + 32 u M. */
static square least_square(sunder_i_operands *g)
{
    double least = INFINITY;
    square best = {{{NULL, 0}, {NULL, 0}}, 0};
    bool any = false;
    for (int pass = 0; pass < 2; pass++) {
        const double most = least + 2 * (8 * g->error + 0x1p-48 * g->magnitude);
        for (int side = 0; side < 2; side++)
            for (uint32_t v = 0; v < g->shape[side]->vertices; v++)
                for (uint32_t e = 0; e < g->shape[1 - side]->vertices; e++) {
                    const double *xy = g->xy[1 - side];
                    const double d = sqrt(sunder_i_point_square(g->xy[side] + 2 * v, xy + 2 * e,
                                                                xy + 2 * g->shape[1 - side]->form->cleaned.next[e]));
                    if (pass == 0) least = sunder_i_min(least, d);
                    if (pass == 0 || d > most) continue;
                    const square s = end_square(g, side, v, e);
                    if (!any || is_less(&g->placed.lattice.arena, &s, &best)) best = s;
                    any = true;
                }
    }
    return best;
}

/* Returns an upper bound of the coordinates of the pair. */
static double size_of(const sunder_i_pair *pair)
{
    double size = 0, box[4];
    for (int e = 0; e < 2; e++) {
        const double *t = e ? pair->tq : pair->tp;
        sunder_shape_box(e ? pair->q : pair->p, box);
        for (int c = 0; c < 4; c++) size = sunder_i_max(size, fabs(box[c]) + (t ? fabs(t[c & 1]) : 0));
    }
    return size;
}

static sunder_status compare_distances(const sunder_i_pair *was, const sunder_i_pair *is, bool *worse,
                                       sunder_error *err)
{
    double before, now, on[4];
    sunder_status status = sunder_i_distance(was->p, was->tp, was->q, was->tq, &before, on, on + 2, err);
    if (!status) status = sunder_i_distance(is->p, is->tp, is->q, is->tq, &now, on, on + 2, err);
    if (status) return status;
    *worse = now < before;
    /* each distance is accurate to some ulps of the coordinates; on a wide lattice the cross product has
     * cancellation */
    if (fabs(now - before) > 0x1p-40 * (now + before + size_of(was) + size_of(is))) return SUNDER_OK;
    sunder_i_operands g, h;
    status =
        sunder_i_operands_init(&g, was->p, was->q, &(sunder_i_operands_options){.tp = was->tp, .tq = was->tq}, err);
    if (status) return status;
    status = sunder_i_operands_init(&h, is->p, is->q, &(sunder_i_operands_options){.tp = is->tp, .tq = is->tq}, err);
    if (!status) {
        const square a = least_square(&g), b = least_square(&h);
        *worse = is_less(&g.placed.lattice.arena, &b, &a);
        if (g.placed.lattice.arena.failed || h.placed.lattice.arena.failed) status = sunder_i_failure_cause(err);
        sunder_i_operands_free(&h);
    }
    sunder_i_operands_free(&g);
    return status;
}

/* ---- Overlapping pairs: least translations ---- */

static sunder_status compare_texts(const char *was, const char *is, bool *worse, sunder_error *err)
{
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    square a = {{{NULL, 0}, {NULL, 0}}, 0}, b = a;
    const bool read = sunder_i_ratio_parse(&arena, was, &a.value) && sunder_i_ratio_parse(&arena, is, &b.value);
    *worse = read && is_less(&arena, &a, &b);
    const bool failed = arena.failed || !read;
    sunder_i_arena_free(&arena);
    return failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}

static double translation_at(const double *t, int c) { return t ? t[c] : 0; }

/* Returns whether the least translation is certainly not longer than before. The translation that separated the pair
 * then, minus the change of position since, separates it now; if it is shorter by more than the error of these sums of
 * five terms, that is sufficient. */
static bool is_surely_no_deeper(const sunder_i_depth *d, const sunder_i_pair *was, const sunder_i_pair *is)
{
    double left[2], size = 0;
    if (was->p != is->p || was->q != is->q) return false;
    for (int c = 0; c < 2; c++) {
        left[c] = d->away[c] - ((translation_at(is->tq, c) - translation_at(is->tp, c)) -
                                (translation_at(was->tq, c) - translation_at(was->tp, c)));
        size += fabs(d->away[c]) + fabs(translation_at(is->tq, c)) + fabs(translation_at(is->tp, c)) +
                fabs(translation_at(was->tq, c)) + fabs(translation_at(was->tp, c));
    }
    return hypot(left[0], left[1]) + 0x1p-47 * size < d->least;
}

/* The factor of the length up to which a translation is computed: beyond it, doubles of the lengths certainly
 * differ. */
#define BARELY (1 + 0x1p-20)

static sunder_status compare_exactly(const sunder_i_pair *was, const sunder_separation *now, bool *worse,
                                     sunder_error *err)
{
    sunder_separation before;
    const sunder_i_least_options o = {.tp = was->tp, .tq = was->tq, .upper = INFINITY, .texts = true};
    sunder_status status = sunder_i_least(was->p, was->q, &o, &before, NULL, err);
    if (status) return status;
    status = compare_texts(before.distance_squared_text, now->distance_squared_text, worse, err);
    sunder_separation_clear(&before);
    return status;
}

static sunder_status compare_lengths(const sunder_i_pair *was, const sunder_i_depth *d, const sunder_i_pair *is,
                                     bool *worse, sunder_error *err)
{
    sunder_separation now;
    const sunder_i_least_options o = {.tp = is->tp, .tq = is->tq, .upper = BARELY * d->distance, .texts = true};
    *worse = false;
    sunder_status status = sunder_i_least(is->p, is->q, &o, &now, worse, err);
    if (status) return status;
    if (!*worse && now.distance != d->distance) {
        *worse = now.distance > d->distance; /* the nearest doubles of the exact lengths have the same order */
    } else if (!*worse) {
        status = compare_exactly(was, &now, worse, err);
    }
    sunder_separation_clear(&now);
    return status;
}

/* ---- The state before ------------------------------------------------------------------------------------------- */

static sunder_status find_depth(const sunder_i_pair *was, sunder_i_depth *d, sunder_error *err)
{
    bool overlap;
    sunder_separation least;
    sunder_status status = sunder_i_overlap(was->p, was->tp, was->q, was->tq, &overlap, err);
    if (status) return status;
    *d = (sunder_i_depth){.stood = SUNDER_I_STOOD_APART};
    if (!overlap) return SUNDER_OK;
    const sunder_i_least_options o = {.tp = was->tp, .tq = was->tq, .upper = INFINITY};
    status = sunder_i_least(was->p, was->q, &o, &least, NULL, err);
    if (status) {
        d->stood = SUNDER_I_STOOD_UNKNOWN;
        return status;
    }
    *d = (sunder_i_depth){SUNDER_I_STOOD_IN_EACH_OTHER, {least.dx, least.dy}, least.distance, least.lower_bound};
    sunder_separation_clear(&least);
    return SUNDER_OK;
}

/* ---- The test ---------------------------------------------------------------------------------------------------- */

sunder_status sunder_i_pair_worsened_since(const sunder_i_pair *was, sunder_i_depth *depth, const sunder_i_pair *is,
                                           bool *worse, sunder_error *err)
{
    bool now;
    *worse = false;
    sunder_status status = depth->stood == SUNDER_I_STOOD_UNKNOWN ? find_depth(was, depth, err) : SUNDER_OK;
    if (status) return status;
    const bool before = depth->stood == SUNDER_I_STOOD_IN_EACH_OTHER;
    if (before && is_surely_no_deeper(depth, was, is)) return SUNDER_OK;
    status = sunder_i_overlap(is->p, is->tp, is->q, is->tq, &now, err);
    if (status) return status;
    if (before != now) {
        *worse = now;
        return SUNDER_OK;
    }
    return now ? compare_lengths(was, depth, is, worse, err) : compare_distances(was, is, worse, err);
}

sunder_status sunder_i_pair_worsened(const sunder_i_pair *was, const sunder_i_pair *is, bool *worse, sunder_error *err)
{
    sunder_i_depth depth = {.stood = SUNDER_I_STOOD_UNKNOWN};
    return sunder_i_pair_worsened_since(was, &depth, is, worse, err);
}
