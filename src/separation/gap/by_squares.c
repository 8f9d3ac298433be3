/* by_squares.c: for a problem with a gap and many pairs of pieces, finds the pairs that matter. The plane is searched
 * in squares, nearest to the origin first, as without a gap (squares.h), with subsums grown by the gap. If one grown
 * subsum covers a square completely, only that one is kept for it; if few subsums are near a square, these are kept.
 * So, within the limit, the kept subsums cover what all of them cover, and a point is tested against those of its
 * square only. The boundary of the obstacle lies in open squares only, so that candidate segments are taken from these.
 * The limit is lowered to the nearest square that no subsum is near, or whose centre is certainly free.
 *
 * A square counts as covered only if a margin larger than all rounding errors is left, and a distance that exceeds the
 * gap by less than 2^-17 of the magnitude counts as near. If it is uncertain which of two squares contains a point, or
 * a point beside it (step_to_rational.c), either square can be used. */
#include "base/extremes.h"
#include "base/invariant.h"
#include "separation/gap/gap.h"
#include "separation/squares/squares_inner.h"

#include "base/sort.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct gathering {
    sunder_i_gap_problem *p;
    sunder_i_squares *q;
    sunder_i_gap_quadtree *to;
    size_t nodes_capacity;
    uint64_t *pair; /* the pairs of all squares, one list after the other: a convex set of P in the high word, one of -Q
                     * in the low word */
    size_t pairs, pairs_capacity;
    sunder_i_candidate *segment;
    size_t segments, segments_capacity;
} gathering;

static bool make_nodes(gathering *c)
{
    const size_t need = 1 + 4 * (size_t)c->q->cuts, before = c->nodes_capacity;
    if (!sunder_i_reserve(&c->to->node, &c->nodes_capacity, need, sizeof *c->to->node)) return false;
    if (c->nodes_capacity > before) memset(c->to->node + before, 0, (c->nodes_capacity - before) * sizeof *c->to->node);
    return true;
}

static bool keep_pair(gathering *c, uint32_t i, uint32_t j)
{
    if (c->pairs == UINT32_MAX) return sunder_i_too_many();
    if (!sunder_i_reserve(&c->pair, &c->pairs_capacity, c->pairs + 1, sizeof *c->pair)) return false;
    c->pair[c->pairs++] = (uint64_t)i << 32 | j;
    return true;
}

static bool keep_segments(gathering *c, const sunder_i_square *s)
{
    sunder_i_lattice *l = &c->p->operands->placed.lattice;
    const double by = c->p->gap_units * SUNDER_I_GAP_MORE_FLOATS;
    const double box[4] = {s->box[0] - by, s->box[1] - by, s->box[2] + by, s->box[3] + by};
    const sunder_i_mark mark = sunder_i_arena_mark(&l->arena);
    sunder_i_candidates near;
    if (!sunder_i_squares_take_candidates(c->q, box, c->p->limit + by, &near) ||
        !sunder_i_reserve(&c->segment, &c->segments_capacity, c->segments + near.n, sizeof *c->segment))
        return false;
    if (near.n) memcpy(c->segment + c->segments, near.item, near.n * sizeof *near.item);
    c->segments += near.n;
    sunder_i_arena_release(&l->arena, mark);
    return true;
}

/* Returns whether the centre of an open square is certainly farther than the gap from all subsums near it. */
static bool middle_is_free(const gathering *c, const sunder_i_square *s)
{
    const double x = s->box[0] / 2 + s->box[2] / 2, y = s->box[1] / 2 + s->box[3] / 2;
    const sunder_i_operands *g = c->p->operands;
    const sunder_i_inner_convex *b = c->q->inner;
    const sunder_i_square_query query = sunder_i_inner_convex_query(g, (double[4]){x, y, x, y});
    const float gap = (float)(c->p->gap_units * sunder_i_float_scale(g)) * (float)SUNDER_I_GAP_MORE_FLOATS +
                      2 * SUNDER_I_INNER_CONVEX_ERROR;
    for (size_t k = 0; k < c->q->pairs; k++) {
        const uint32_t i = c->q->pair[k][0], j = c->q->pair[k][1];
        if (!(sunder_i_inner_convex_depth(b, i, j, &query).touch + b[0].vague[i] + b[1].vague[j] < -gap)) return false;
    }
    return true;
}

static void lower_limit(gathering *c, double x, double y)
{
    const double d = sqrt(x * x + y * y) * SUNDER_I_GAP_MORE + 64 * c->p->operands->error;
    if (d < c->p->limit) c->p->limit = d;
}

static bool settle_square(gathering *c, const sunder_i_square *s, sunder_i_square_state what)
{
    sunder_i_squares *q = c->q;
    sunder_i_gap_node *at = c->to->node + s->place;
    if (what == SUNDER_I_SQUARE_IN_PARTS) {
        at->child = 1 + 4 * q->cuts;
        return sunder_i_squares_cut(q, s) && make_nodes(c);
    }
    at->from = (uint32_t)c->pairs;
    bool ok = !q->covered || keep_pair(c, q->covering[0], q->covering[1]);
    if (what == SUNDER_I_SQUARE_OPEN) {
        for (size_t k = 0; ok && k < q->pairs; k++) ok = keep_pair(c, q->pair[k][0], q->pair[k][1]);
        ok = ok && keep_segments(c, s);
        if (ok && middle_is_free(c, s)) lower_limit(c, s->box[0] / 2 + s->box[2] / 2, s->box[1] / 2 + s->box[3] / 2);
    } else if (!q->covered)
        lower_limit(c, sunder_i_max(fabs(s->box[0]), fabs(s->box[2])), sunder_i_max(fabs(s->box[1]), fabs(s->box[3])));
    at->to = (uint32_t)c->pairs;
    return ok;
}

/* Processes the squares in the order of distance. *done is set if the limit was reached. */
static bool look_at_all(gathering *c, bool *done)
{
    sunder_i_squares *q = c->q;
    *done = false;
    if (!make_nodes(c)) return false;
    while (q->n && q->heap[0].distance <= c->p->limit * SUNDER_I_GAP_MORE_FLOATS + 64 * q->g->error) {
        const sunder_i_square s = sunder_i_squares_first(q);
        if (sunder_i_squares_too_many(q, &s)) return true;
        const sunder_i_square_state what = sunder_i_squares_look(q, &s);
        if (what == SUNDER_I_SQUARE_NO_MEMORY || !settle_square(c, &s, what)) return false;
    }
    *done = true;
    return true;
}

/* ---- Converting the result to the form of the search ---- */

/* Appends the boxes of one operand (P or -Q) to its pieces. */
static bool add_boxes(sunder_i_operands *g, const sunder_i_inner_convex *b, int side)
{
    const uint32_t pieces = g->shape[side]->pieces;
    sunder_i_arena *arena = &g->placed.lattice.arena;
    sunder_i_turned_piece *piece = sunder_i_arena_alloc(arena, b->n, sizeof *piece);
    sunder_i_point *point = sunder_i_arena_alloc(arena, b->boxes, 9 * sizeof *point);
    if (!piece || !point) return false;
    memcpy(piece, g->turned[side], pieces * sizeof *piece);
    for (uint32_t k = 0; k < b->boxes; k++, point += 9) {
        const double *v = b->box + 4 * (size_t)k;
        const int64_t x0 = (int64_t)v[0], y0 = (int64_t)v[1], x1 = (int64_t)v[2], y1 = (int64_t)v[3];
        const sunder_i_point corner[5] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
        memcpy(point, corner, sizeof corner);
        for (int m = 0; m < 4; m++) point[5 + m] = sunder_i_narrow_sub(corner[m + 1], corner[m]);
        piece[pieces + k] = (sunder_i_turned_piece){4, point, point + 5};
    }
    g->turned[side] = piece;
    return true;
}

static const double *box_of(const sunder_i_operands *g, const sunder_i_inner_convex *b, int side, uint32_t set)
{
    const uint32_t pieces = g->shape[side]->pieces;
    return set < pieces ? g->piece_box[side] + 4 * (size_t)set : b->box + 4 * (size_t)(set - pieces);
}

static bool number_pairs(gathering *c)
{
    sunder_i_operands *g = c->p->operands;
    sunder_i_arena *arena = &g->placed.lattice.arena;
    uint64_t *key = sunder_i_arena_alloc(arena, c->pairs + 1, sizeof *key);
    c->to->list = sunder_i_arena_alloc(arena, c->pairs + 1, sizeof *c->to->list);
    if (!c->to->list) return false;
    if (c->pairs) memcpy(key, c->pair, c->pairs * sizeof *key);
    if (!sunder_i_sort_keys(key, c->pairs)) return false;
    size_t n = 0;
    for (size_t k = 0; k < c->pairs; k++)
        if (k == 0 || key[k] != key[n - 1]) key[n++] = key[k];
    g->subsum = sunder_i_arena_alloc(arena, n + 1, sizeof *g->subsum);
    if (!g->subsum) return false;
    g->subsums = n;
    for (size_t k = 0; k < n; k++) {
        sunder_i_subsum *s = g->subsum + k;
        *s = (sunder_i_subsum){.i = (uint32_t)(key[k] >> 32), .j = (uint32_t)key[k]};
        sunder_i_box_sum(box_of(g, c->q->inner, 0, s->i), box_of(g, c->q->inner + 1, 1, s->j), s->box);
    }
    for (size_t k = 0; k < c->pairs; k++) {
        size_t low = 0, high = n - 1;
        while (low < high) {
            const size_t m = low + (high - low) / 2;
            if (key[m] < c->pair[k])
                low = m + 1;
            else
                high = m;
        }
        SUNDER_I_ASSERT(key[low] == c->pair[k]);
        c->to->list[k] = (uint32_t)low;
    }
    return sunder_i_steps(c->pairs);
}

static int by_place(const void *a, const void *b)
{
    const sunder_i_candidate *c = a, *d = b;
    if (c->side != d->side) return c->side - d->side;
    if (c->edge != d->edge) return c->edge < d->edge ? -1 : 1;
    return (c->vertex > d->vertex) - (c->vertex < d->vertex);
}

static bool take_segments(gathering *c)
{
    sunder_i_candidate *out = sunder_i_arena_alloc(&c->p->operands->placed.lattice.arena, c->segments + 1, sizeof *out);
    if (!out) return false;
    if (c->segments) qsort(c->segment, c->segments, sizeof *c->segment, by_place);
    size_t n = 0;
    for (size_t k = 0; k < c->segments; k++)
        if (k == 0 || by_place(c->segment + k, out + n - 1) != 0) out[n++] = c->segment[k];
    c->p->segment = out;
    c->p->segments = n;
    return sunder_i_steps(n);
}

static bool take_all(gathering *c)
{
    sunder_i_operands *g = c->p->operands;
    return add_boxes(g, &c->q->inner[0], 0) && add_boxes(g, &c->q->inner[1], 1) && number_pairs(c) && take_segments(c);
}

bool sunder_i_gap_by_squares(sunder_i_gap_problem *problem, sunder_i_gap_quadtree *quadtree, bool *done)
{
    const double limit = problem->limit, reach = problem->limit;
    *quadtree = (sunder_i_gap_quadtree){.reach = reach + 64 * problem->operands->error};
    *done = false;
    gathering c = {
        .p = problem, .q = sunder_i_squares_new(problem->operands, reach, problem->gap_units), .to = quadtree};
    const bool ok = c.q && look_at_all(&c, done) && (!*done || take_all(&c));
    sunder_i_squares_free(c.q);
    sunder_i_free_all(c.pair, c.segment);
    if (ok && *done)
        problem->quadtree = quadtree;
    else
        problem->limit = limit;
    return ok && !problem->operands->placed.lattice.arena.failed;
}

void sunder_i_gap_quadtree_free(sunder_i_gap_quadtree *quadtree)
{
    sunder_i_free(quadtree->node);
    *quadtree = (sunder_i_gap_quadtree){.node = NULL};
}

const uint32_t *sunder_i_gap_quadtree_near(const sunder_i_gap_quadtree *quadtree, double x, double y, size_t *n)
{
    double box[4] = {-quadtree->reach, -quadtree->reach, quadtree->reach, quadtree->reach};
    const sunder_i_gap_node *at = quadtree->node;
    while (at->child) {
        const double mx = box[0] / 2 + box[2] / 2, my = box[1] / 2 + box[3] / 2;
        const int k = (x > mx) + 2 * (y > my);
        double part[4];
        sunder_i_quadtree_quarter(box, k, part);
        memcpy(box, part, sizeof box);
        at = quadtree->node + at->child + k;
    }
    SUNDER_I_ASSERT(at->from <= at->to);
    *n = at->to - at->from;
    return quadtree->list + at->from;
}
