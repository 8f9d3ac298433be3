/* Barriers, cut into parts.
 *
 * A barrier may be one long road, or a land use area of a hundred thousand corners, while a feature near it is close to
 * only a few metres of it. So a barrier is stored as convex pieces (segments of a line, points, the convex pieces of a
 * polygonal set), and a few neighbouring pieces form a *part*. Features are related to parts, parts are indexed by
 * their boxes, and the search treats each part as a fixed body. The report on a feature and a barrier, however, is
 * about the whole barrier: how deep the one lies in the other, which least translation separates them, whether the pair
 * is worse than before. Each of these questions has an answer of some length, and only pieces within that length can
 * influence it (barrier_pairs.c).
 *
 *   a point repeated in a line    it is kept once; a line with one distinct point is a point
 *   no area, no points            a barrier without parts, which obstructs nothing */
#include "displacement/layer/barrier_parts.h"

#include "base/error.h"
#include "base/extremes.h"
#include "base/watch.h"
#include "spatial/curve.h"

#include <stdlib.h>
#include <string.h>

/* The number of pieces per part. It is small, so that a feature near one piece seldom has to test the others; and large
 * enough that the roads of a town give no more bodies than its houses do. */
#define PIECES 8

void sunder_i_barriers_free(sunder_i_barriers *barriers)
{
    for (uint32_t k = 0; barriers->shape && k < barriers->parts; k++) sunder_shape_free(barriers->shape[k]);
    sunder_i_free_all(barriers->shape, barriers->piece, barriers->piece_end, barriers->barrier, barriers->part_end,
                      barriers->half, barriers->required, barriers->full);
    memset(barriers, 0, sizeof *barriers);
}

/* ---- Pieces ------------------------------------------------------------------------------------------------------ */

typedef struct parts_maker {
    sunder_i_barriers *out;
    size_t pieces, piece_capacity, part_capacity, barrier_capacity;
} parts_maker;

static bool add_piece(parts_maker *m, const sunder_i_piece_of *piece)
{
    if (!sunder_i_reserve(&m->out->piece, &m->piece_capacity, m->pieces + 1, sizeof *piece)) return false;
    m->out->piece[m->pieces++] = *piece;
    return sunder_i_step();
}

/* Ends the current part of a barrier, if it has pieces. */
static bool end_part(parts_maker *m, uint32_t barrier)
{
    sunder_i_barriers *b = m->out;
    const size_t first = b->parts ? b->piece_end[b->parts - 1] : 0;
    if (m->pieces == first) return true;
    if (!sunder_i_reserve(&b->piece_end, &m->part_capacity, b->parts + 1, sizeof *b->piece_end) ||
        !sunder_i_reserve(&b->barrier, &m->barrier_capacity, b->parts + 1, sizeof *b->barrier))
        return false;
    b->piece_end[b->parts] = (uint32_t)m->pieces;
    b->barrier[b->parts++] = barrier;
    return true;
}

/* Ends the current part if it has PIECES pieces. */
static bool end_full_part(parts_maker *m, uint32_t barrier)
{
    const size_t first = m->out->parts ? m->out->piece_end[m->out->parts - 1] : 0;
    return m->pieces - first < PIECES || end_part(m, barrier);
}

static bool add_line(parts_maker *m, uint32_t barrier, const double *xy, size_t n)
{
    bool any = false;
    for (size_t k = 1; k < n; k++) {
        const double *a = xy + 2 * (k - 1);
        if (a[0] == a[2] && a[1] == a[3]) continue;
        any = true;
        if (!add_piece(m, &(sunder_i_piece_of){.n = 2, .xy = a}) || !end_full_part(m, barrier)) return false;
    }
    if (!any && n && !add_piece(m, &(sunder_i_piece_of){.n = 1, .xy = xy})) return false;
    return end_part(m, barrier);
}

/* Adds the pieces of a polygonal set in the order of a space-filling curve, so that neighbouring pieces are in the same
 * part. */
static bool add_shape(parts_maker *m, uint32_t barrier, const sunder_shape *shape)
{
    const uint32_t n = shape->pieces;
    double *middle = sunder_i_alloc(2 * (size_t)n, sizeof *middle);
    uint32_t *order = sunder_i_alloc(n, sizeof *order), *number = sunder_i_alloc(n, sizeof *number);
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    bool ok = middle && order && number;
    for (uint32_t i = 0; ok && i < n; i++) {
        double box[4];
        sunder_i_piece_box(&(sunder_i_piece_of){.shape = shape, .piece = i}, box);
        for (int c = 0; c < 2; c++) middle[2 * (size_t)i + (size_t)c] = box[c] / 2 + box[c + 2] / 2;
        order[i] = number[i] = i;
    }
    if (ok && n > 1) sunder_i_curve_sort(middle, number, order, n, &arena);
    ok = ok && !arena.failed;
    for (uint32_t i = 0; ok && i < n; i++)
        ok = add_piece(m, &(sunder_i_piece_of){.shape = shape, .piece = order[i]}) && end_full_part(m, barrier);
    sunder_i_arena_free(&arena);
    sunder_i_free_all(middle, order, number);
    return ok && end_part(m, barrier);
}

static bool add_barrier(parts_maker *m, uint32_t k, const sunder_obstacle *o)
{
    if (o->shape && !add_shape(m, k, o->shape)) return false;
    for (size_t i = 0, from = 0; i < o->lines; from = o->line_end[i++])
        if (!add_line(m, k, o->xy + 2 * from, o->line_end[i] - from)) return false;
    m->out->part_end[k] = m->out->parts;
    return true;
}

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

/* Sets out to half + gap as a sum of two doubles: the rounded sum, and the rounding error, which is a double itself
 * [Knu97, 4.2.2]. */
static void set_required(double half, double gap, double out[2])
{
    const double sum = half + gap, back = sum - half;
    out[0] = sum;
    out[1] = (half - (sum - back)) + (gap - back);
}

static sunder_status make_shapes(sunder_i_barriers *b, sunder_error *err)
{
    b->shape = sunder_i_calloc(b->parts, sizeof *b->shape);
    if (!b->shape) return sunder_i_failure_cause(err);
    for (uint32_t k = 0; k < b->parts; k++) {
        const uint32_t first = k ? b->piece_end[k - 1] : 0;
        const sunder_status status =
            sunder_i_shape_of_pieces(b->piece + first, b->piece_end[k] - first, &b->shape[k], err);
        if (status) return status;
        b->flat = b->flat || b->shape[k]->flat;
        if (!sunder_i_step()) return sunder_i_failure_cause(err);
    }
    return SUNDER_OK;
}

/* Sets the distances that features of one class keep from barrier k. gap, full_gap: those of the class and the
 * barrier's class. Returns false if they are too much for a double. */
static bool set_distance(const sunder_barrier *barrier, uint32_t k, uint32_t of, double gap, double full_gap,
                         sunder_i_barriers *out)
{
    const double own = barrier->gap < 0 ? gap : barrier->gap;
    const double full = barrier->full_gap > 0 ? barrier->full_gap : barrier->gap < 0 ? full_gap : own;
    const size_t at = (size_t)k * out->classes + of;
    set_required(out->half[k], own, out->required[at]);
    set_required(out->half[k], sunder_i_max(own, full), out->full[at]);
    out->slack = out->slack || full > own;
    return isfinite(out->full[at][0]);
}

/* Sets the distances that features keep from barrier k. Returns false if they are too much for a double. */
static bool set_distances(const sunder_layer *layer, uint32_t k, const sunder_i_rules *rules, sunder_i_barriers *out)
{
    const sunder_barrier *barrier = &layer->barrier[k];
    const sunder_i_class_gaps *gaps = layer->gaps;
    bool finite = true;
    out->half[k] = barrier->width / 2;
    for (uint32_t of = 0; of < out->classes && finite; of++) {
        const size_t entry = gaps ? (size_t)of * gaps->n + gaps->of[layer->n + k] : 0;
        const double gap = gaps ? sunder_i_min(rules->gap, gaps->gap[entry]) : rules->gap,
                     full = gaps ? sunder_i_min(rules->full_gap, gaps->full[entry]) : rules->full_gap;
        finite = set_distance(barrier, k, of, gap, rules->has_full ? full : gap, out);
    }
    out->farthest = sunder_i_max(out->farthest, sunder_i_full_required_most(out, k));
    return finite;
}

sunder_status sunder_i_barriers_make(const sunder_layer *layer, const sunder_i_rules *rules, sunder_i_barriers *out,
                                     sunder_error *err)
{
    memset(out, 0, sizeof *out);
    parts_maker m = {.out = out};
    out->n = (uint32_t)layer->barriers;
    out->part_end = sunder_i_alloc(layer->barriers, sizeof *out->part_end);
    out->half = sunder_i_alloc(layer->barriers, sizeof *out->half);
    out->classes = layer->gaps ? (uint32_t)layer->gaps->n : 1;
    out->required = sunder_i_alloc(layer->barriers * out->classes, sizeof *out->required);
    out->full = sunder_i_alloc(layer->barriers * out->classes, sizeof *out->full);
    if (!out->part_end || !out->half || !out->required || !out->full) return sunder_i_failure_cause(err);
    for (uint32_t k = 0; k < out->n; k++) {
        const sunder_barrier *barrier = &layer->barrier[k];
        if (!set_distances(layer, k, rules, out))
            return sunder_i_fail(err, SUNDER_EARG, "barrier %u: half the width and the gap are too much for a double",
                                 k);
        if (!add_barrier(&m, k, &barrier->geometry)) return sunder_i_failure_cause(err);
        if (m.pieces >= UINT32_MAX - layer->n)
            return sunder_i_fail(err, SUNDER_ESIZE, "too many pieces of barriers: %zu", m.pieces);
    }
    return make_shapes(out, err);
}

/* ---- Pieces near a box ------------------------------------------------------------------------------------------- */

sunder_status sunder_i_barrier_near(const sunder_i_barriers *barriers, const sunder_i_rtree *tree, uint32_t first,
                                    uint32_t barrier, const double box[4], double reach, bool areas, sunder_shape **out,
                                    sunder_error *err)
{
    const uint32_t low = barrier ? barriers->part_end[barrier - 1] : 0, high = barriers->part_end[barrier];
    sunder_i_list near = {0};
    double grown[4];
    sunder_i_piece_of *piece = NULL;
    size_t n = 0, capacity = 0;
    *out = NULL;
    sunder_i_box_grow(box, reach, grown);
    bool ok = sunder_i_rtree_query(tree, grown, &near);
    if (ok && near.n) qsort(near.item, near.n, sizeof *near.item, sunder_i_by_number);
    for (size_t k = 0; ok && k < near.n; k++) {
        if (near.item[k] < first + low || near.item[k] >= first + high) continue;
        const uint32_t part = near.item[k] - first;
        for (uint32_t i = part ? barriers->piece_end[part - 1] : 0; ok && i < barriers->piece_end[part]; i++) {
            double own[4];
            sunder_i_piece_box(&barriers->piece[i], own);
            if (!sunder_i_box_meet(own, grown) || (areas && !sunder_i_piece_has_area(&barriers->piece[i]))) continue;
            ok = sunder_i_reserve(&piece, &capacity, n + 1, sizeof *piece);
            if (ok) piece[n++] = barriers->piece[i];
        }
    }
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status && n) status = sunder_i_shape_of_pieces(piece, n, out, err);
    sunder_i_free_all(piece, near.item);
    return status;
}
