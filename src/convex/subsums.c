#include "convex/subsums.h"

#include "convex/join.h"
#include "base/sort.h"
#include "base/watch.h"
#include "predicate/predicate.h"

#include <string.h>

/* One operand with its directions ranked. Sides of a piece are stored so that ranks ascend from the first. */
typedef struct operand {
    const sunder_shape *shape;
    const sunder_i_point *vertex;
    sunder_i_joined joined; /* its pieces */
    uint32_t *corner;    /* [sides] vertex where the side starts, rotated as said */
    uint32_t *rank;      /* [sides] */
    uint32_t *edge_rank; /* [vertices] rank of the boundary edge (v, next[v]) */
    size_t sides;
} operand;

typedef struct ranking {
    sunder_i_lattice *lattice;
    sunder_i_point *key; /* the side's vector, turned into [0, pi) */
} ranking;

static int compare_keys(void *context, uint32_t a, uint32_t b)
{
    const ranking *r = context;
    return -sunder_i_cross_sign(r->lattice, r->key[a], r->key[b]); /* both in one half-plane */
}

static void operand_free(operand *o)
{
    sunder_i_joined_free(&o->joined);
    sunder_i_free(o->corner);
    sunder_i_free(o->rank);
    sunder_i_free(o->edge_rank);
}

static bool operand_init(operand *o, sunder_i_lattice *l, const sunder_shape *shape, const sunder_i_point *vertex)
{
    o->shape = shape;
    o->vertex = vertex;
    if (!sunder_i_join_pieces(l, shape, vertex, &o->joined)) return false;
    o->sides = o->joined.end[o->joined.pieces - 1];
    o->corner = sunder_i_alloc(o->sides, sizeof *o->corner);
    o->rank = sunder_i_alloc(o->sides, sizeof *o->rank);
    o->edge_rank = sunder_i_alloc(shape->vertices, sizeof *o->edge_rank);
    return o->corner && o->rank && o->edge_rank;
}

static uint32_t piece_first(const operand *o, size_t piece) { return piece ? o->joined.end[piece - 1] : 0; }

/* The vectors of all sides of an operand, turned into [0, pi); flipped tells which were turned. */
static void side_vectors(sunder_i_lattice *l, const operand *o, sunder_i_point *key, bool *flipped)
{
    const uint32_t *vertex = o->joined.vertex;
    for (uint32_t i = 0; i < o->joined.pieces; i++) {
        const uint32_t first = piece_first(o, i), end = o->joined.end[i];
        for (uint32_t k = first; k < end; k++) {
            const uint32_t u = vertex[k], v = vertex[k + 1 < end ? k + 1 : first];
            const sunder_i_point d = sunder_i_point_sub(l, o->vertex[v], o->vertex[u]);
            flipped[k] = sunder_i_half_plane(l, d) == 1;
            key[k] = flipped[k] ? sunder_i_point_neg(l, d) : d;
        }
    }
}

/* Stores corners and ranks of each piece, rotated to ascending ranks, and the ranks of the boundary edges. */
static void store_ranks(operand *o, const uint32_t *rank)
{
    const uint32_t *vertex = o->joined.vertex;
    for (uint32_t i = 0; i < o->joined.pieces; i++) {
        const uint32_t first = piece_first(o, i), n = o->joined.end[i] - first;
        uint32_t least = 0;
        for (uint32_t k = 1; k < n; k++)
            if (rank[first + k] < rank[first + least]) least = k;
        /* Sides on one line have one rank: start with the first of them, which may stand at the end of the list. */
        while (rank[first + (least + n - 1) % n] == rank[first + least]) least = (least + n - 1) % n;
        for (uint32_t k = 0; k < n; k++) {
            const uint32_t from = first + (least + k) % n;
            const uint32_t u = vertex[from], v = vertex[first + (least + k + 1) % n];
            o->corner[first + k] = u;
            o->rank[first + k] = rank[from];
            if (sunder_i_is_boundary(o->shape, u, v)) o->edge_rank[u] = rank[from];
        }
    }
}

static bool rank_directions(sunder_i_subsums *out, operand *p, operand *q)
{
    sunder_i_lattice *l = out->lattice;
    const size_t n = p->sides + q->sides;
    sunder_i_point *key = sunder_i_alloc(n, sizeof *key);
    bool *flipped = sunder_i_alloc(n, sizeof *flipped);
    uint32_t *order = sunder_i_alloc(n, sizeof *order), *rank = sunder_i_alloc(n, sizeof *rank);
    out->direction = sunder_i_alloc(n, sizeof *out->direction);
    bool ok = key && flipped && order && rank && out->direction;
    if (ok) {
        side_vectors(l, p, key, flipped);
        side_vectors(l, q, key + p->sides, flipped + p->sides);
        for (uint32_t i = 0; i < n; i++) order[i] = i;
        ranking r = {l, key};
        ok = sunder_i_sort_indices(order, n, compare_keys, &r);
    }
    uint32_t classes = 0;
    if (ok) {
        for (size_t i = 0; i < n; i++) {
            const sunder_i_point d = key[order[i]];
            if (i == 0 || sunder_i_cross_sign(l, key[order[i - 1]], d) != 0)
                out->direction[classes++] = d;
            else if (!sunder_i_point_is_plain(out->direction[classes - 1]) && sunder_i_point_is_plain(d))
                out->direction[classes - 1] = d; /* any will do, and numbers stay short */
            rank[order[i]] = classes - 1;
        }
        out->classes = classes;
        ok = !l->arena.failed; /* else the ranks are not those of convex pieces */
    }
    if (ok) {
        for (size_t i = 0; i < n; i++)
            if (flipped[i]) rank[i] += classes;
        store_ranks(p, rank);
        store_ranks(q, rank + p->sides);
    }
    sunder_i_free(key);
    sunder_i_free(flipped);
    sunder_i_free(order);
    sunder_i_free(rank);
    return ok;
}

/* Does the exterior angle at vertex v hold the rank r? The vertex is convex then, a left turn. Where others stand at its
 * place each has a sector of its own (shape.h), and what one of them covers is covered. */
static bool holds(const operand *o, uint32_t v, uint32_t r, uint32_t classes)
{
    const sunder_shape *s = o->shape;
    const uint32_t full = 2 * classes, in = o->edge_rank[s->prev[v]], out = o->edge_rank[v];
    const uint32_t turn = out >= in ? out - in : out + full - in;
    const uint32_t step = r >= in ? r - in : r + full - in;
    return turn < classes && step <= turn;
}

/* Is side k (with the next corner at m) of operand a a boundary edge that the other operand's corner vertex carries? */
static bool is_candidate(const operand *a, uint32_t k, uint32_t m, const operand *b, uint32_t vertex, uint32_t classes)
{
    return sunder_i_is_boundary(a->shape, a->corner[k], a->corner[m]) && holds(b, vertex, a->rank[k], classes);
}

/* Merges piece i of p with piece j of q; returns the number of sides written. */
static uint32_t merge_pieces(sunder_i_subsums *out, uint32_t at, const operand *p, uint32_t i, const operand *q,
                             uint32_t j)
{
    const uint32_t pf = piece_first(p, i), pn = p->joined.end[i] - pf;
    const uint32_t qf = piece_first(q, j), qn = q->joined.end[j] - qf;
    const uint32_t start = at, classes = out->classes;
    const bool narrow = out->lattice->narrow;
    uint32_t a = 0, b = 0;
    while (a < pn || b < qn) {
        const uint32_t pk = pf + (a < pn ? a : 0), qk = qf + (b < qn ? b : 0); /* at the end a piece waits in its first corner */
        const uint32_t pm = pf + (a + 1 < pn ? a + 1 : 0), qm = qf + (b + 1 < qn ? b + 1 : 0);
        const uint32_t pv = p->corner[pk], qv = q->corner[qk];
        const bool from_p = b >= qn || (a < pn && p->rank[pk] <= q->rank[qk]);
        const bool from_q = a >= pn || (b < qn && q->rank[qk] <= p->rank[pk]);
        const sunder_i_point u = p->vertex[pv], v = q->vertex[qv];
        out->corner[at] = narrow ? (sunder_i_point){u.x + v.x, u.y + v.y} : sunder_i_point_add(out->lattice, u, v);
        out->rank[at] = from_p ? p->rank[pk] : q->rank[qk];
        if (from_p && from_q)
            out->candidate[at] = sunder_i_is_boundary(p->shape, pv, p->corner[pm]) ||
                                 sunder_i_is_boundary(q->shape, qv, q->corner[qm]);
        else
            out->candidate[at] =
                from_p ? is_candidate(p, pk, pm, q, qv, classes) : is_candidate(q, qk, qm, p, pv, classes);
        if (from_p) a++;
        if (from_q) b++;
        at++;
    }
    return at - start;
}

static bool merge_all(sunder_i_subsums *out, const operand *p, const operand *q)
{
    const size_t m = p->joined.pieces, n = q->joined.pieces, most = p->sides * n + q->sides * m;
    if (m * n > UINT32_MAX / 2 || most > UINT32_MAX / 2) return sunder_i_too_many();
    out->end = sunder_i_alloc(m * n, sizeof *out->end);
    out->corner = sunder_i_alloc(most, sizeof *out->corner);
    out->rank = sunder_i_alloc(most, sizeof *out->rank);
    out->candidate = sunder_i_alloc(most, sizeof *out->candidate);
    if (!out->end || !out->corner || !out->rank || !out->candidate) return false;
    uint32_t at = 0;
    for (uint32_t i = 0; i < m; i++) {
        if (!sunder_i_steps(n)) return false;
        for (uint32_t j = 0; j < n; j++) {
            at += merge_pieces(out, at, p, i, q, j);
            out->end[out->n++] = at;
        }
    }
    out->sides = at;
    return !out->lattice->arena.failed;
}

sunder_status sunder_i_subsums_build(sunder_i_lattice *lattice, const sunder_shape *p, const sunder_i_point *vp,
                                     const sunder_shape *q, const sunder_i_point *vq, sunder_i_subsums *out,
                                     sunder_error *err)
{
    memset(out, 0, sizeof *out);
    out->lattice = lattice;
    if (p->pieces == 0 || q->pieces == 0) return SUNDER_OK;
    operand a = {0}, b = {0};
    bool ok = operand_init(&a, lattice, p, vp) && operand_init(&b, lattice, q, vq);
    ok = ok && rank_directions(out, &a, &b) && merge_all(out, &a, &b);
    operand_free(&a);
    operand_free(&b);
    if (ok) return SUNDER_OK;
    sunder_i_subsums_free(out);
    return sunder_i_no_memory(err);
}

void sunder_i_subsums_free(sunder_i_subsums *subsums)
{
    sunder_i_free(subsums->direction);
    sunder_i_free(subsums->end);
    sunder_i_free(subsums->corner);
    sunder_i_free(subsums->rank);
    sunder_i_free(subsums->candidate);
    memset(subsums, 0, sizeof *subsums);
}
