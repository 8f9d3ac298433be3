/* Squares that something holds whole (square_pairs.c) are closed; those that few pairs of pieces come near are open,
 * and searched; the others are cut in four. Squares become small towards the boundary of the obstacle only, and there
 * few pieces touch. So what is looked at follows the boundary within reach, not the number of pairs of pieces. */
#include "separation/squares_inner.h"

#include "number/watch.h"

#include <math.h>
#include <string.h>

/* With so few pairs a square is searched as it is; with twice as many after each halving from a certain one on, as many
 * may truly meet in one point. */
#define FEW_PAIRS 128
#define PATIENT 8
/* So many subsums are tried to hold a square: twice as many after each halving from a certain one on, and whenever half
 * as many squares have been looked at as there are pieces. Few are best where spikes are of all lengths: there is a deep
 * one, or many that nearly hold it. But of a comb's teeth that are all alike only some in a thousand hold a square, and
 * without them it falls to dust. */
#define HOLD_TRIES 16
#define HOLD_PATIENT 6
#define HOLD_MOST 18 /* doublings */
#define DEEPEST 28 /* for tries to be numbered; by then a square holds nothing but rounding */
#define ORIGIN_TRIES 1024
/* So many squares, and so many for each piece, are looked at: each is worth some microseconds, and what else could be
 * done takes all pairs of pieces. */
#define MOST_SQUARES 20000
#define MOST_EACH 8

/* ---- The heap ---- */

static bool push(sunder_i_squares *q, sunder_i_square s)
{
    if (!sunder_i_reserve(&q->heap, &q->capacity, q->n + 1, sizeof *q->heap)) return false;
    size_t i = q->n++;
    for (; i > 0 && q->heap[(i - 1) / 2].distance > s.distance; i = (i - 1) / 2) q->heap[i] = q->heap[(i - 1) / 2];
    q->heap[i] = s;
    return true;
}

static sunder_i_square pop(sunder_i_squares *q)
{
    const sunder_i_square top = q->heap[0], last = q->heap[--q->n];
    size_t i = 0;
    for (size_t k = 1; k < q->n; i = k, k = 2 * k + 1) {
        if (k + 1 < q->n && q->heap[k + 1].distance < q->heap[k].distance) k++;
        if (last.distance <= q->heap[k].distance) break;
        q->heap[i] = q->heap[k];
    }
    q->heap[i] = last;
    return top;
}

static double distance_of(const double box[4])
{
    const double x = box[0] > 0 ? box[0] : box[2] < 0 ? -box[2] : 0;
    const double y = box[1] > 0 ? box[1] : box[3] < 0 ? -box[3] : 0;
    return sqrt(x * x + y * y);
}

bool sunder_i_squares_take_origin(sunder_i_squares *q, bool *covered)
{
    static const double origin[4] = {0, 0, 0, 0};
    *covered = sunder_i_squares_boxes_hold(q, origin) ||
               sunder_i_squares_one_holds(q, origin, ORIGIN_TRIES) == SUNDER_I_HELD;
    if (*covered) return true;
    const bool all = sunder_i_squares_gather(q, origin, SIZE_MAX);
    *covered = q->held;
    return *covered || (all && sunder_i_squares_take_subsums(q));
}

/* ---- In order ---- */

static bool cut(sunder_i_squares *q, const sunder_i_square *s)
{
    for (int k = 0; k < 4; k++) {
        sunder_i_square part = {.depth = s->depth + 1};
        sunder_i_inner_quarter(s->box, k, part.box);
        part.distance = distance_of(part.box);
        if (!push(q, part)) return false;
    }
    return true;
}

typedef enum finding { CLOSED, OPEN, IN_PARTS, NO_MEMORY } finding;

static uint32_t tries_to_hold(const sunder_i_squares *q, int depth)
{
    const size_t pieces = (size_t)q->g->shape[0]->pieces + q->g->shape[1]->pieces;
    const size_t doublings = (size_t)(depth > HOLD_PATIENT ? depth - HOLD_PATIENT : 0) + 2 * q->seen / pieces;
    return (uint32_t)HOLD_TRIES << (doublings < HOLD_MOST ? doublings : HOLD_MOST);
}

/* What is to be done with a square; if it is open its pairs are listed. */
static finding look_at(sunder_i_squares *q, const sunder_i_square *s)
{
    const int patience = s->depth > PATIENT ? s->depth - PATIENT : 0;
    if (!sunder_i_step()) return NO_MEMORY;
    if (sunder_i_squares_boxes_hold(q, s->box)) return CLOSED;
    const sunder_i_held_by_one how = sunder_i_squares_one_holds(q, s->box, tries_to_hold(q, s->depth));
    if (how != SUNDER_I_NOT_HELD) return how == SUNDER_I_HELD ? CLOSED : IN_PARTS;
    const size_t few = (size_t)FEW_PAIRS << patience;
    if (sunder_i_squares_gather(q, s->box, few)) return q->pairs ? OPEN : CLOSED;
    return q->held ? CLOSED : q->pairs == few ? IN_PARTS : NO_MEMORY;
}

sunder_i_squares_next sunder_i_squares_pop(sunder_i_squares *q, double limit, double box[4], sunder_i_mark *mark,
                                           sunder_i_candidates *candidates)
{
    while (q->n && q->heap[0].distance <= limit + 64 * q->g->error) {
        const sunder_i_square s = pop(q);
        if (++q->seen > q->most || s.depth > DEEPEST) return SUNDER_I_SQUARES_TOO_MANY;
        const finding what = look_at(q, &s);
        if (what == NO_MEMORY || (what == IN_PARTS && !cut(q, &s))) return SUNDER_I_SQUARES_NO_MEMORY;
        if (what != OPEN) continue;
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
    for (uint32_t i = s->pieces; i-- > 0;)
        for (uint32_t k = i ? s->piece_end[i - 1] : 0; k < s->piece_end[i]; k++)
            q->first_piece[side][s->piece_vertex[k]] = i;
    return true;
}

sunder_i_squares *sunder_i_squares_new(sunder_i_pairing *g, double reach)
{
    sunder_i_squares *q = sunder_i_calloc(1, sizeof *q);
    if (!q) return NULL;
    q->g = g;
    q->most = MOST_SQUARES + (size_t)MOST_EACH * ((size_t)g->shape[0]->pieces + g->shape[1]->pieces);
    const double r = reach + 64 * g->error;
    const bool ok = sunder_i_inner_build(&q->inner[0], g, 0) && sunder_i_inner_build(&q->inner[1], g, 1) &&
                    sunder_i_piece_tree_build(&q->tree[0], g, 0) && sunder_i_piece_tree_build(&q->tree[1], g, 1) &&
                    make_tables(q, 0) && make_tables(q, 1) && push(q, (sunder_i_square){{-r, -r, r, r}, 0, 0});
    if (ok) return q;
    sunder_i_squares_free(q);
    return NULL;
}

void sunder_i_squares_free(sunder_i_squares *q)
{
    if (!q) return;
    for (int k = 0; k < 2; k++) {
        sunder_i_inner_free(&q->inner[k]);
        sunder_i_piece_tree_free(&q->tree[k]);
        sunder_i_free(q->first_piece[k]);
        sunder_i_free(q->corner[k]);
        sunder_i_free(q->state[k]);
    }
    sunder_i_free(q->heap);
    sunder_i_free(q->pair);
    sunder_i_free(q);
}
