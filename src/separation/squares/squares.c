/* squares.c: see squares.h. Squares that something covers completely (covering.c) are closed; those with few pairs of
 * pieces near them are open, and searched; the others are divided into quarters. Squares become small only near the
 * boundary of the obstacle, where few pieces meet. So the number of squares depends on the length of the boundary
 * within reach, not on the number of pairs of pieces. */
#include "base/invariant.h"
#include "separation/squares/squares_inner.h"
#include "separation/squares/tuning.h"

#include "base/heap.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* ---- The heap ---- */

static bool square_before(const void *a, const void *b)
{
    return ((const sunder_i_square *)a)->distance < ((const sunder_i_square *)b)->distance;
}

static bool push_square(sunder_i_squares *q, sunder_i_square s)
{
    if (!sunder_i_reserve(&q->heap, &q->capacity, q->n + 1, sizeof *q->heap)) return false;
    sunder_i_heap_push(q->heap, &q->n, sizeof s, &s, square_before);
    return true;
}

sunder_i_square sunder_i_squares_first(sunder_i_squares *squares)
{
    sunder_i_square top;
    squares->seen++;
    sunder_i_heap_pop(squares->heap, &squares->n, sizeof top, &top, square_before);
    return top;
}

static double distance_of(const double box[4])
{
    double d[2];
    sunder_i_box_distance(box, d);
    return sqrt(d[0] * d[0] + d[1] * d[1]);
}

bool sunder_i_squares_take_origin(sunder_i_squares *squares, bool *covered)
{
    static const double origin[4] = {0, 0, 0, 0};
    *covered = sunder_i_squares_boxes_cover(squares, origin);
    if (*covered) return true;
    const sunder_i_covering how = sunder_i_squares_one_covers(squares, origin, (uint32_t[2]){1, 1}, ORIGIN_TRIES);
    *covered = how == SUNDER_I_COVERING_FOUND;
    if (*covered || how == SUNDER_I_COVERING_NO_MEMORY) return *covered;
    const bool all = sunder_i_squares_gather(squares, origin, SIZE_MAX);
    *covered = squares->covered;
    return *covered || (all && sunder_i_squares_take_subsums(squares));
}

/* ---- The order of the squares ---- */

bool sunder_i_squares_cut(sunder_i_squares *squares, const sunder_i_square *square)
{
    const uint32_t first = 1 + 4 * squares->cuts++;
    for (int k = 0; k < 4; k++) {
        sunder_i_square part = {
            .depth = square->depth + 1, .place = first + (uint32_t)k, .best = {squares->best[0], squares->best[1]}};
        sunder_i_quadtree_quarter(square->box, k, part.box);
        part.distance = distance_of(part.box);
        SUNDER_I_ASSERT(part.distance >= square->distance); /* so that squares come nearest first */
        if (!push_square(squares, part)) return false;
    }
    return true;
}

static uint32_t tries_to_cover(int depth)
{
    const int doublings = depth > COVER_PATIENT ? depth - COVER_PATIENT : 0;
    return (uint32_t)COVER_TRIES << (doublings < COVER_MOST ? doublings : COVER_MOST);
}

sunder_i_square_state sunder_i_squares_look(sunder_i_squares *squares, const sunder_i_square *square)
{
    const int patience = square->depth > PATIENT ? square->depth - PATIENT : 0;
    /* with a gap the caller needs the sets that cover the square */
    squares->covered = squares->gap == 0 && sunder_i_squares_boxes_cover(squares, square->box);
    squares->pairs = 0;
    if (!sunder_i_step()) return SUNDER_I_SQUARE_NO_MEMORY;
    if (squares->covered) return SUNDER_I_SQUARE_CLOSED;
    const sunder_i_covering how =
        sunder_i_squares_one_covers(squares, square->box, square->best, tries_to_cover(square->depth));
    if (how == SUNDER_I_COVERING_NO_MEMORY) return SUNDER_I_SQUARE_NO_MEMORY;
    if (how != SUNDER_I_COVERING_NONE)
        return how == SUNDER_I_COVERING_FOUND ? SUNDER_I_SQUARE_CLOSED : SUNDER_I_SQUARE_IN_PARTS;
    const size_t few = (size_t)FEW_PAIRS << patience;
    if (sunder_i_squares_gather(squares, square->box, few))
        return squares->pairs ? SUNDER_I_SQUARE_OPEN : SUNDER_I_SQUARE_CLOSED;
    if (squares->covered) return SUNDER_I_SQUARE_CLOSED;
    return squares->pairs == few ? SUNDER_I_SQUARE_IN_PARTS : SUNDER_I_SQUARE_NO_MEMORY;
}

bool sunder_i_squares_too_many(const sunder_i_squares *squares, const sunder_i_square *square)
{
    return squares->seen > squares->most || square->depth > DEEPEST_SQUARE;
}

sunder_i_squares_next sunder_i_squares_pop(sunder_i_squares *squares, double limit, double box[4], sunder_i_mark *mark,
                                           sunder_i_candidates *candidates)
{
    while (squares->n && squares->heap[0].distance <= limit + 64 * squares->g->error) {
        const sunder_i_square s = sunder_i_squares_first(squares);
        if (sunder_i_squares_too_many(squares, &s)) return SUNDER_I_SQUARES_TOO_MANY;
        const sunder_i_square_state what = sunder_i_squares_look(squares, &s);
        if (what == SUNDER_I_SQUARE_NO_MEMORY ||
            (what == SUNDER_I_SQUARE_IN_PARTS && !sunder_i_squares_cut(squares, &s)))
            return SUNDER_I_SQUARES_NO_MEMORY;
        if (what != SUNDER_I_SQUARE_OPEN) continue;
        memcpy(box, s.box, sizeof s.box);
        *mark = sunder_i_arena_mark(&squares->g->placed.lattice.arena);
        const bool ok =
            sunder_i_squares_take_subsums(squares) && sunder_i_squares_take_candidates(squares, box, limit, candidates);
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

bool sunder_i_squares_worth(const sunder_i_operands *operands, uint64_t pairs)
{
    if (operands->shape[0]->flat) return false; /* sets without area cover no square */
    return (uint64_t)operands->shape[0]->pieces * operands->shape[1]->pieces >= SUNDER_I_SQUARES_WHOLE &&
           sunder_i_operands_parts(operands) >= pairs;
}

sunder_i_squares *sunder_i_squares_new(sunder_i_operands *operands, double reach, double gap)
{
    sunder_i_squares *q = sunder_i_calloc(1, sizeof *q);
    if (!q) return NULL;
    q->g = operands;
    q->gap = gap;
    const size_t m = operands->shape[0]->pieces, n = operands->shape[1]->pieces;
    q->most = MOST_SQUARES + MOST_EACH * (m + n) + m * n / MOST_PAIRS;
    const double r = reach + 64 * operands->error;
    q->reach = (float)(sunder_i_float_scale(operands) * r);
    for (int k = 0; k < SUNDER_I_SQUARES_MEMORY * SUNDER_I_SQUARES_MEMORY; k++) q->memory[k][0] = q->memory[k][1] = 1;
    const bool ok = sunder_i_quadtree_build(&q->quadtree[0], operands, 0) &&
                    sunder_i_quadtree_build(&q->quadtree[1], operands, 1) &&
                    sunder_i_inner_convex_build(&q->inner[0], operands, 0, &q->quadtree[0]) &&
                    sunder_i_inner_convex_build(&q->inner[1], operands, 1, &q->quadtree[1]) && make_tables(q, 0) &&
                    make_tables(q, 1) && push_square(q, (sunder_i_square){.box = {-r, -r, r, r}, .best = {1, 1}});
    if (ok) return q;
    sunder_i_squares_free(q);
    return NULL;
}

void sunder_i_squares_free(sunder_i_squares *squares)
{
    if (!squares) return;
    for (int k = 0; k < 2; k++) {
        sunder_i_quadtree_free(&squares->quadtree[k]);
        sunder_i_inner_convex_free(&squares->inner[k]);
        sunder_i_free_all(squares->first_piece[k], squares->corner[k], squares->state[k]);
    }
    sunder_i_free_all(squares->heap, squares->pair, squares->node, squares);
}
