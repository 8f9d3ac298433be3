/* A square is held if there are a box inside P and a box inside -Q whose sum, a box, has it in its interior: any
 * placement from the square makes the two boxes overlap; or if a subsum has it there. Where the operands overlap deeply
 * a few large boxes close large squares; the squares become small towards the boundary of the obstacle only, and there
 * few pieces touch. So what is looked at follows the boundary within reach, not the number of pairs of pieces.
 *
 * All in doubles and one-sided: held is certain, and a pair that is not listed stays off by more than the error. */
#include "separation/squares.h"

#include "number/watch.h"

#include <math.h>
#include <string.h>

/* With so few pairs a square is searched as it is; with twice as many after each halving from a certain one on, as many
 * may truly meet in one point. */
#define FEW_PAIRS 256
#define PATIENT 8
#define MOST_SQUARES 20000 /* looked at */
#define MOST_TRIES 1000     /* pairs of boxes that are looked at to hold one square */

typedef struct square {
    double box[4], distance; /* of its nearest point from the origin */
    int depth;
} square;

struct sunder_i_squares {
    sunder_i_pairing *g;
    sunder_i_inner inner[2];
    uint32_t *first_piece[2]; /* [vertices] the first piece that each is a corner of */
    sunder_i_corner *corner[2]; /* [vertices] once it is known */
    uint8_t *state[2];        /* [vertices] UNKNOWN, ... */
    square *heap;
    size_t n, capacity, seen;
    uint32_t (*pair)[2];
    size_t pairs, pairs_capacity;
    uint32_t tries;
    bool held; /* by the subsum that was looked at last */
};

/* ---- The heap ---- */

static bool push(sunder_i_squares *q, square s)
{
    if (!sunder_i_reserve(&q->heap, &q->capacity, q->n + 1, sizeof *q->heap)) return false;
    size_t i = q->n++;
    for (; i > 0 && q->heap[(i - 1) / 2].distance > s.distance; i = (i - 1) / 2) q->heap[i] = q->heap[(i - 1) / 2];
    q->heap[i] = s;
    return true;
}

static square pop(sunder_i_squares *q)
{
    const square top = q->heap[0], last = q->heap[--q->n];
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

/* ---- Held? ---- */

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

/* ---- Which pairs come near ---- */

static bool near(const sunder_i_squares *q, const double at[4], uint32_t a, uint32_t b)
{
    const double *u = q->inner[0].extent[a], *v = q->inner[1].extent[b], e = 128 * q->g->error;
    return u[0] + v[0] <= at[2] + e && u[2] + v[2] >= at[0] - e && u[1] + v[1] <= at[3] + e && u[3] + v[3] >= at[1] - e;
}

/* The square and the lines of a subsum's sides: one has it outside for certain, or all have it inside. */
typedef enum position { APART, ACROSS, HELD } position;

/* For the sides that come from piece i of operand `side`, each at the corner of piece j that is farthest out. */
static position position_to_sides(const sunder_i_squares *q, const double at[4], int side, uint32_t i, uint32_t j)
{
    const sunder_i_pairing *g = q->g;
    const sunder_shape *s = g->shape[side], *o = g->shape[!side];
    const double *xy = g->xy[side], *uv = g->xy[!side], e = 128 * g->error;
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
        const double reach = hx * fabs(dy) + hy * fabs(dx), error = e * (fabs(dx) + fabs(dy));
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

/* Adds the pairs below two nodes; false once there are more than `most`, or if one of them holds the square (q->held),
 * or if memory is out. */
static bool gather(sunder_i_squares *q, const double at[4], uint32_t a, uint32_t b, size_t most)
{
    const sunder_i_inner *p = &q->inner[0], *r = &q->inner[1];
    if (!near(q, at, a, b)) return true;
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
    const double *u = p->extent[a], *v = r->extent[b];
    if (b >= r->leaves || (a < p->leaves && u[2] - u[0] + u[3] - u[1] >= v[2] - v[0] + v[3] - v[1]))
        return gather(q, at, 2 * a, b, most) && gather(q, at, 2 * a + 1, b, most);
    return gather(q, at, a, 2 * b, most) && gather(q, at, a, 2 * b + 1, most);
}

/* ---- A square's subsums and candidates ---- */

enum { UNKNOWN = 0, NO_CORNER, CORNER };

static const sunder_i_corner *corner_of(sunder_i_squares *q, int side, uint32_t v)
{
    if (q->state[side][v] == UNKNOWN)
        q->state[side][v] = sunder_i_corner_of(q->g, side, v, &q->corner[side][v]) ? CORNER : NO_CORNER;
    return q->state[side][v] == CORNER ? &q->corner[side][v] : NULL;
}

/* Does the segment from (x, y) along (dx, dy) come near the square? */
static bool comes_near(const double at[4], double e, double x, double y, double dx, double dy)
{
    return fmin(x, x + dx) <= at[2] + e && fmax(x, x + dx) >= at[0] - e && fmin(y, y + dy) <= at[3] + e &&
           fmax(y, y + dy) >= at[1] - e;
}

/* The edge from vertex u, a side of piece i of operand `side`, at the corners of piece j of the other; those that are
 * corners of several pieces with the first of them only. Tests as in candidates.c. */
static bool add_edge(sunder_i_squares *q, const double at[4], double reach, int side, uint32_t u, uint32_t j,
                     sunder_i_candidates *out)
{
    sunder_i_pairing *g = q->g;
    const sunder_shape *s = g->shape[side], *o = g->shape[!side];
    const double *a = g->xy[side] + 2 * (size_t)u, *b = g->xy[side] + 2 * (size_t)s->next[u];
    const double dx = b[0] - a[0], dy = b[1] - a[1], inverse = 1 / (dx * dx + dy * dy);
    const double bound = -(fabs(dx) + fabs(dy)) * g->error - 8 * g->magnitude * g->coarse;
    for (uint32_t k = j ? o->piece_end[j - 1] : 0; k < o->piece_end[j]; k++) {
        const uint32_t v = o->piece_vertex[k];
        const double *c = g->xy[!side] + 2 * (size_t)v;
        if (q->first_piece[!side][v] != j || !comes_near(at, 32 * g->error, a[0] + c[0], a[1] + c[1], dx, dy)) continue;
        const sunder_i_corner *w = corner_of(q, !side, v);
        if (!w || !(w->in_x * dy - w->in_y * dx >= bound) || !(dx * w->out_y - dy * w->out_x >= bound)) continue;
        const double norm = sunder_i_segment_square(a[0] + c[0], a[1] + c[1], dx, dy, inverse);
        if (norm > reach * reach) continue;
        if (!sunder_i_candidates_push(g, out, (sunder_i_candidate){norm, u, v, side})) return false;
    }
    return true;
}

/* A boundary edge is a side of one piece, so nothing comes twice. */
static bool add_edges(sunder_i_squares *q, const double at[4], double reach, int side, uint32_t i, uint32_t j,
                      sunder_i_candidates *out)
{
    const sunder_shape *s = q->g->shape[side];
    const uint32_t first = i ? s->piece_end[i - 1] : 0, end = s->piece_end[i];
    for (uint32_t k = first; k < end; k++) {
        const uint32_t u = s->piece_vertex[k], v = s->piece_vertex[k + 1 < end ? k + 1 : first];
        if (sunder_i_is_boundary(s, u, v) && !add_edge(q, at, reach, side, u, j, out)) return false;
    }
    return true;
}

static bool take_subsums(sunder_i_squares *q)
{
    sunder_i_pairing *g = q->g;
    g->subsum = sunder_i_arena_alloc(&g->placed.lattice.arena, q->pairs + 1, sizeof *g->subsum);
    g->subsums = g->subsum ? q->pairs : 0;
    for (size_t k = 0; k < g->subsums; k++) {
        sunder_i_subsum *s = g->subsum + k;
        *s = (sunder_i_subsum){.i = q->pair[k][0], .j = q->pair[k][1]};
        for (int m = 0; m < 4; m++)
            s->box[m] = g->piece_box[0][4 * (size_t)s->i + (size_t)m] + g->piece_box[1][4 * (size_t)s->j + (size_t)m];
    }
    return g->subsum != NULL;
}

static bool take(sunder_i_squares *q, const double at[4], double limit, sunder_i_candidates *out)
{
    const double reach = limit + 8 * q->g->error;
    *out = (sunder_i_candidates){NULL, 0, 0};
    if (!take_subsums(q)) return false;
    for (size_t k = 0; k < q->pairs; k++) {
        const uint32_t i = q->pair[k][0], j = q->pair[k][1];
        if (!add_edges(q, at, reach, 0, i, j, out) || !add_edges(q, at, reach, 1, j, i, out)) return false;
    }
    sunder_i_candidates_order(out);
    return true;
}

bool sunder_i_squares_take_origin(sunder_i_squares *q, bool *covered)
{
    static const double origin[4] = {0, 0, 0, 0};
    q->tries = 0;
    q->pairs = 0;
    q->held = false;
    const bool held = hold(q, origin, 0, q->inner[0].box, 0, q->inner[1].box);
    const bool all = held || gather(q, origin, 1, 1, SIZE_MAX);
    *covered = held || q->held;
    return *covered || (all && take_subsums(q));
}

/* ---- In order ---- */

static bool cut(sunder_i_squares *q, const square *s)
{
    for (int k = 0; k < 4; k++) {
        square part = {.depth = s->depth + 1};
        sunder_i_inner_quarter(s->box, k, part.box);
        part.distance = distance_of(part.box);
        if (!push(q, part)) return false;
    }
    return true;
}

sunder_i_squares_next sunder_i_squares_pop(sunder_i_squares *q, double limit, double box[4], sunder_i_mark *mark,
                                           sunder_i_candidates *candidates)
{
    while (q->n && q->heap[0].distance <= limit + 64 * q->g->error) {
        const square s = pop(q);
        if (++q->seen > MOST_SQUARES) return SUNDER_I_SQUARES_TOO_MANY;
        q->tries = 0;
        if (hold(q, s.box, 0, q->inner[0].box, 0, q->inner[1].box)) continue;
        q->pairs = 0;
        q->held = false;
        const size_t few = (size_t)FEW_PAIRS << (s.depth > PATIENT ? s.depth - PATIENT : 0);
        if (gather(q, s.box, 1, 1, few)) {
            if (q->pairs == 0) continue;
            memcpy(box, s.box, sizeof s.box);
            *mark = sunder_i_arena_mark(&q->g->placed.lattice.arena);
            return take(q, box, limit, candidates) ? SUNDER_I_SQUARES_OPEN : SUNDER_I_SQUARES_NO_MEMORY;
        }
        if (q->held) continue;
        if (q->pairs < few) return SUNDER_I_SQUARES_NO_MEMORY;
        if (!cut(q, &s)) return SUNDER_I_SQUARES_NO_MEMORY;
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
    const double r = reach + 64 * g->error;
    const bool ok = sunder_i_inner_build(&q->inner[0], g, 0) && sunder_i_inner_build(&q->inner[1], g, 1) &&
                    make_tables(q, 0) && make_tables(q, 1) && push(q, (square){{-r, -r, r, r}, 0, 0});
    if (ok) return q;
    sunder_i_squares_free(q);
    return NULL;
}

void sunder_i_squares_free(sunder_i_squares *q)
{
    if (!q) return;
    for (int k = 0; k < 2; k++) {
        sunder_i_inner_free(&q->inner[k]);
        sunder_i_free(q->first_piece[k]);
        sunder_i_free(q->corner[k]);
        sunder_i_free(q->state[k]);
    }
    sunder_i_free(q->heap);
    sunder_i_free(q->pair);
    sunder_i_free(q);
}
