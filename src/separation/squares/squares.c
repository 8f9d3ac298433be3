/* Squares that something covers whole (covering.c) are closed; those that few pairs of pieces come near are open,
 * and searched; the others are cut in four. Squares become small towards the boundary of the obstacle only, and there
 * few pieces touch. So what is looked at follows the boundary within reach, not the number of pairs of pieces. */
#include "base/invariant.h"
#include "separation/squares/squares_inner.h"
#include "separation/squares/tuning.h"

#include "base/heap.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* ---- The heap ---- */

static bool before(const void *a, const void *b)
{
    return ((const sunder_i_square *)a)->distance < ((const sunder_i_square *)b)->distance;
}

static bool push(sunder_i_squares *q, sunder_i_square s)
{
    if (!sunder_i_reserve(&q->heap, &q->capacity, q->n + 1, sizeof *q->heap)) return false;
    sunder_i_heap_push(q->heap, &q->n, sizeof s, &s, before);
    return true;
}

sunder_i_square sunder_i_squares_first(sunder_i_squares *q)
{
    sunder_i_square top;
    q->seen++;
    sunder_i_heap_pop(q->heap, &q->n, sizeof top, &top, before);
    return top;
}

static double distance_of(const double box[4])
{
    double d[2];
    sunder_i_box_distance(box, d);
    return sqrt(d[0] * d[0] + d[1] * d[1]);
}

bool sunder_i_squares_take_origin(sunder_i_squares *q, bool *covered)
{
    static const double origin[4] = {0, 0, 0, 0};
    *covered = sunder_i_squares_boxes_cover(q, origin);
    if (*covered) return true;
    const sunder_i_covering how = sunder_i_squares_one_covers(q, origin, (uint32_t[2]){1, 1}, ORIGIN_TRIES);
    *covered = how == SUNDER_I_COVERING_FOUND;
    if (*covered || how == SUNDER_I_COVERING_NO_MEMORY) return *covered;
    const bool all = sunder_i_squares_gather(q, origin, SIZE_MAX);
    *covered = q->covered;
    return *covered || (all && sunder_i_squares_take_subsums(q));
}

/* ---- In order ---- */

bool sunder_i_squares_cut(sunder_i_squares *q, const sunder_i_square *s)
{
    const uint32_t first = 1 + 4 * q->cuts++;
    for (int k = 0; k < 4; k++) {
        sunder_i_square part = {.depth = s->depth + 1, .place = first + (uint32_t)k, .best = {q->best[0], q->best[1]}};
        sunder_i_quadtree_quarter(s->box, k, part.box);
        part.distance = distance_of(part.box);
        SUNDER_I_ASSERT(part.distance >= s->distance); /* so that squares come nearest first */
        if (!push(q, part)) return false;
    }
    return true;
}

static uint32_t tries_to_cover(int depth)
{
    const int doublings = depth > COVER_PATIENT ? depth - COVER_PATIENT : 0;
    return (uint32_t)COVER_TRIES << (doublings < COVER_MOST ? doublings : COVER_MOST);
}

sunder_i_square_state sunder_i_squares_look(sunder_i_squares *q, const sunder_i_square *s)
{
    const int patience = s->depth > PATIENT ? s->depth - PATIENT : 0;
    /* with a gap: the caller asks what covers it */
    q->covered = q->gap == 0 && sunder_i_squares_boxes_cover(q, s->box);
    q->pairs = 0;
    if (!sunder_i_step()) return SUNDER_I_SQUARE_NO_MEMORY;
    if (q->covered) return SUNDER_I_SQUARE_CLOSED;
    const sunder_i_covering how = sunder_i_squares_one_covers(q, s->box, s->best, tries_to_cover(s->depth));
    if (how == SUNDER_I_COVERING_NO_MEMORY) return SUNDER_I_SQUARE_NO_MEMORY;
    if (how != SUNDER_I_COVERING_NONE)
        return how == SUNDER_I_COVERING_FOUND ? SUNDER_I_SQUARE_CLOSED : SUNDER_I_SQUARE_IN_PARTS;
    const size_t few = (size_t)FEW_PAIRS << patience;
    if (sunder_i_squares_gather(q, s->box, few)) return q->pairs ? SUNDER_I_SQUARE_OPEN : SUNDER_I_SQUARE_CLOSED;
    if (q->covered) return SUNDER_I_SQUARE_CLOSED;
    return q->pairs == few ? SUNDER_I_SQUARE_IN_PARTS : SUNDER_I_SQUARE_NO_MEMORY;
}

bool sunder_i_squares_too_many(const sunder_i_squares *q, const sunder_i_square *s)
{
    return q->seen > q->most || s->depth > DEEPEST_SQUARE;
}

sunder_i_squares_next sunder_i_squares_pop(sunder_i_squares *q, double limit, double box[4], sunder_i_mark *mark,
                                           sunder_i_candidates *candidates)
{
    while (q->n && q->heap[0].distance <= limit + 64 * q->g->error) {
        const sunder_i_square s = sunder_i_squares_first(q);
        if (sunder_i_squares_too_many(q, &s)) return SUNDER_I_SQUARES_TOO_MANY;
        const sunder_i_square_state what = sunder_i_squares_look(q, &s);
        if (what == SUNDER_I_SQUARE_NO_MEMORY || (what == SUNDER_I_SQUARE_IN_PARTS && !sunder_i_squares_cut(q, &s)))
            return SUNDER_I_SQUARES_NO_MEMORY;
        if (what != SUNDER_I_SQUARE_OPEN) continue;
        memcpy(box, s.box, sizeof s.box);
        *mark = sunder_i_arena_mark(&q->g->placed.lattice.arena);
        const bool ok = sunder_i_squares_take_subsums(q) && sunder_i_squares_take_candidates(q, box, limit, candidates);
        return ok ? SUNDER_I_SQUARES_OPEN : SUNDER_I_SQUARES_NO_MEMORY;
    }
    return SUNDER_I_SQUARES_END;
}

static bool make_tables(sunder_i_squares *q, int side)
{
    const sunder_shape *s = q->g->shape[side];
    q->first_piece[side] = sunder_i_alloc(s->vertices, sizeof *q->first_piece[side]);
    q->corner[side] = sunder_i_alloc(s->vertices, sizeof *q->corner[side]);
    q->state[side] = sunder_i_calloc(s->vertices, sizeof *q->state[side]);
    if (!q->first_piece[side] || !q->corner[side] || !q->state[side]) return false;
    for (uint32_t i = s->pieces; i-- > 0;) {
        const sunder_i_operand_piece p = sunder_i_operands_piece(q->g, side, i);
        for (uint32_t k = 0; k < p.n; k++) q->first_piece[side][p.corner[k]] = i;
    }
    return true;
}

bool sunder_i_squares_worth(const sunder_i_operands *g, uint64_t pairs)
{
    if (g->shape[0]->flat) return false; /* sets without area cover no square */
    return (uint64_t)g->shape[0]->pieces * g->shape[1]->pieces >= SUNDER_I_SQUARES_WHOLE &&
           sunder_i_operands_parts(g) >= pairs;
}

sunder_i_squares *sunder_i_squares_new(sunder_i_operands *g, double reach, double gap)
{
    sunder_i_squares *q = sunder_i_calloc(1, sizeof *q);
    if (!q) return NULL;
    q->g = g;
    q->gap = gap;
    const size_t m = g->shape[0]->pieces, n = g->shape[1]->pieces;
    q->most = MOST_SQUARES + MOST_EACH * (m + n) + m * n / MOST_PAIRS;
    const double r = reach + 64 * g->error;
    q->reach = (float)(sunder_i_float_scale(g) * r);
    for (int k = 0; k < SUNDER_I_SQUARES_MEMORY * SUNDER_I_SQUARES_MEMORY; k++) q->memory[k][0] = q->memory[k][1] = 1;
    const bool ok = sunder_i_quadtree_build(&q->quadtree[0], g, 0) && sunder_i_quadtree_build(&q->quadtree[1], g, 1) &&
                    sunder_i_inner_convex_build(&q->inner[0], g, 0, &q->quadtree[0]) &&
                    sunder_i_inner_convex_build(&q->inner[1], g, 1, &q->quadtree[1]) && make_tables(q, 0) &&
                    make_tables(q, 1) && push(q, (sunder_i_square){.box = {-r, -r, r, r}, .best = {1, 1}});
    if (ok) return q;
    sunder_i_squares_free(q);
    return NULL;
}

void sunder_i_squares_free(sunder_i_squares *q)
{
    if (!q) return;
    for (int k = 0; k < 2; k++) {
        sunder_i_quadtree_free(&q->quadtree[k]);
        sunder_i_inner_convex_free(&q->inner[k]);
        sunder_i_free(q->first_piece[k]);
        sunder_i_free(q->corner[k]);
        sunder_i_free(q->state[k]);
    }
    sunder_i_free(q->heap);
    sunder_i_free(q->pair);
    sunder_i_free(q->node);
    sunder_i_free(q);
}
