/* What holds a square whole: a box inside P and one inside -Q whose sum, a box, has it in its interior, so that any
 * placement from the square makes the two overlap; or a subsum. And where nothing does, the pairs of pieces that come
 * near it.
 *
 * Where the operands overlap deeply a few large boxes hold large squares. Spikes have no boxes inside, but the sum of
 * two that cross is a parallelogram that holds many a square; among millions of pairs one is found by descending the
 * two trees of pieces, first where the square may be deepest inside. If that leads nowhere soon there are many that
 * nearly hold it, and its quarters are better asked; it is not worth while then to list who comes near.
 *
 * All in doubles and one-sided: held is certain, and a pair that is not listed stays off by more than the error. */
#include "separation/squares_inner.h"

#include "number/watch.h"

#include <math.h>

#define MOST_TRIES 1000 /* pairs of boxes that are looked at to hold one square */
#define NODES_A_TRY 16  /* pairs of nodes that a try of a subsum may cost; by measurement on stars */

/* ---- Boxes ---- */

/* The nodes a and b of the two quarterings, with their boxes. Parts of a box whose sum does not hold the square do not
 * either. */
static bool hold(sunder_i_squares *q, const double at[4], int32_t a, const double abox[4], int32_t b,
                 const double bbox[4])
{
    const double e = 8 * q->g->error;
    for (int k = 0; k < 2; k++)
        if (at[k] - e <= abox[k] + bbox[k] || at[k + 2] + e >= abox[k + 2] + bbox[k + 2]) return false;
    const int32_t u = q->inner[0].child[a], v = q->inner[1].child[b];
    if (u == SUNDER_I_INNER_REST || v == SUNDER_I_INNER_REST) return false;
    if (u == SUNDER_I_INNER_FULL && v == SUNDER_I_INNER_FULL) return true;
    if (++q->tries > MOST_TRIES) return false;
    const bool of_p = v == SUNDER_I_INNER_FULL || (u != SUNDER_I_INNER_FULL && abox[2] - abox[0] >= bbox[2] - bbox[0]);
    for (int k = 0; k < 4; k++) {
        double part[4];
        sunder_i_inner_quarter(of_p ? abox : bbox, k, part);
        if (of_p ? hold(q, at, u + k, part, b, bbox) : hold(q, at, a, abox, v + k, part)) return true;
    }
    return false;
}

bool sunder_i_squares_boxes_hold(sunder_i_squares *q, const double at[4])
{
    q->tries = 0;
    return hold(q, at, 0, q->inner[0].box, 0, q->inner[1].box);
}

/* ---- Subsums ---- */

/* The square and the lines of a subsum's sides: one has it outside for certain, or all have it inside. */
typedef enum position { APART, ACROSS, HELD } position;

/* For the sides that come from piece i of operand `side`, each at the corner of piece j that is farthest out. */
static position position_to_sides(const sunder_i_squares *q, const double at[4], int side, uint32_t i, uint32_t j)
{
    const sunder_i_pairing *g = q->g;
    const sunder_shape *s = g->shape[side], *o = g->shape[!side];
    const double *xy = g->xy[side], *uv = g->xy[!side];
    const double e = 128 * g->error, fixed = 32 * g->magnitude * g->coarse; /* where ends are rounded, sides are too */
    const double cx = at[0] / 2 + at[2] / 2, cy = at[1] / 2 + at[3] / 2;
    const double hx = at[2] / 2 - at[0] / 2 + e, hy = at[3] / 2 - at[1] / 2 + e;
    const uint32_t first = i ? s->piece_end[i - 1] : 0, end = s->piece_end[i];
    position p = HELD;
    for (uint32_t k = first; k < end; k++) {
        const double *a = xy + 2 * (size_t)s->piece_vertex[k];
        const double *b = xy + 2 * (size_t)s->piece_vertex[k + 1 < end ? k + 1 : first];
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        double most = -INFINITY;
        for (uint32_t m = j ? o->piece_end[j - 1] : 0; m < o->piece_end[j]; m++) {
            const double *c = uv + 2 * (size_t)o->piece_vertex[m];
            const double v = dx * (cy - a[1] - c[1]) - dy * (cx - a[0] - c[0]);
            most = v > most ? v : most;
        }
        const double reach = hx * fabs(dy) + hy * fabs(dx), error = e * (fabs(dx) + fabs(dy)) + fixed;
        if (most + reach < -error) return APART;
        if (most - reach <= error) p = ACROSS;
    }
    return p;
}

static position position_to_subsum(const sunder_i_squares *q, const double at[4], uint32_t i, uint32_t j)
{
    const position p = position_to_sides(q, at, 0, i, j), r = p == APART ? APART : position_to_sides(q, at, 1, j, i);
    return p < r ? p : r;
}

/* The halves of one of two nodes, the one that stands higher in its tree, each with the other. */
static void open_nodes(const sunder_i_squares *q, uint32_t a, uint32_t b, uint32_t part[2][2])
{
    const bool first = b >= q->tree[1].leaves || (a < q->tree[0].leaves && a <= b);
    for (uint32_t k = 0; k < 2; k++) {
        part[k][0] = first ? 2 * a + k : a;
        part[k][1] = first ? b : 2 * b + k;
    }
}

static float depth(const sunder_i_squares *q, const uint32_t nodes[2])
{
    return sunder_i_extents_depth(q->tree[0].extent + nodes[0], q->tree[1].extent + nodes[1], &q->aim);
}

/* Deepest first. q->tries and q->nodes count down, and at zero it is not found. */
static sunder_i_held_by_one one_holds(sunder_i_squares *q, const double at[4], uint32_t a, uint32_t b)
{
    const sunder_i_piece_tree *p = &q->tree[0], *r = &q->tree[1];
    if (a >= p->leaves && b >= r->leaves) {
        if (position_to_subsum(q, at, p->piece[a - p->leaves], r->piece[b - r->leaves]) == HELD) return SUNDER_I_HELD;
        return --q->tries ? SUNDER_I_NOT_HELD : SUNDER_I_NOT_FOUND;
    }
    if (!--q->nodes) return SUNDER_I_NOT_FOUND;
    uint32_t part[2][2];
    open_nodes(q, a, b, part);
    const float d[2] = {depth(q, part[0]), depth(q, part[1])};
    const int deep = d[1] > d[0];
    for (int k = 0; k < 2; k++) {
        const int m = k ? !deep : deep;
        if (!(d[m] > 0)) continue;
        const sunder_i_held_by_one how = one_holds(q, at, part[m][0], part[m][1]);
        if (how != SUNDER_I_NOT_HELD) return how;
    }
    return SUNDER_I_NOT_HELD;
}

sunder_i_held_by_one sunder_i_squares_one_holds(sunder_i_squares *q, const double at[4], uint32_t tries)
{
    q->aim = sunder_i_piece_tree_aim(q->g, at);
    q->tries = tries;
    q->nodes = tries < UINT32_MAX / NODES_A_TRY ? tries * NODES_A_TRY : UINT32_MAX;
    const sunder_i_held_by_one how = one_holds(q, at, 1, 1);
    return sunder_i_steps(q->nodes / 8) ? how : SUNDER_I_NOT_FOUND;
}

/* Adds the pairs below two nodes; false once there are more than `most`, or if one of them holds the square (q->held),
 * or if memory is out. */
static bool gather(sunder_i_squares *q, const double at[4], uint32_t a, uint32_t b, size_t most)
{
    const sunder_i_piece_tree *p = &q->tree[0], *r = &q->tree[1];
    if (!sunder_i_extents_near(p->extent + a, r->extent + b, &q->aim)) return true;
    if (a >= p->leaves && b >= r->leaves) {
        const uint32_t i = p->piece[a - p->leaves], j = r->piece[b - r->leaves];
        if (!sunder_i_step()) return false;
        const position where = position_to_subsum(q, at, i, j);
        if (where == APART) return true;
        q->held = where == HELD;
        if (q->held) return false;
        if (q->pairs == most || !sunder_i_reserve(&q->pair, &q->pairs_capacity, q->pairs + 1, sizeof *q->pair))
            return false;
        q->pair[q->pairs][0] = i;
        q->pair[q->pairs++][1] = j;
        return true;
    }
    uint32_t part[2][2];
    open_nodes(q, a, b, part);
    return gather(q, at, part[0][0], part[0][1], most) && gather(q, at, part[1][0], part[1][1], most);
}

bool sunder_i_squares_gather(sunder_i_squares *q, const double at[4], size_t most)
{
    q->aim = sunder_i_piece_tree_aim(q->g, at);
    q->pairs = 0;
    q->held = false;
    return gather(q, at, 1, 1, most);
}
