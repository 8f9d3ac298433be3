#include "convex/hulls.h"

#include "base/sort.h"
#include "base/watch.h"
#include "predicate/predicate.h"

#include <string.h>

bool sunder_i_hulls_init(sunder_i_hulls *list, size_t n, size_t corners)
{
    memset(list, 0, sizeof *list);
    if (n > UINT32_MAX / 2 || corners > UINT32_MAX / 2) return sunder_i_too_many();
    list->end = sunder_i_alloc(n, sizeof *list->end);
    list->corner = sunder_i_alloc(corners, sizeof *list->corner);
    list->rank = sunder_i_alloc(corners, sizeof *list->rank);
    list->edge = sunder_i_alloc(corners, sizeof *list->edge);
    if (list->end && list->corner && list->rank && list->edge) return true;
    sunder_i_hulls_free(list);
    return false;
}

void sunder_i_hulls_free(sunder_i_hulls *list)
{
    sunder_i_free(list->end);
    sunder_i_free(list->corner);
    sunder_i_free(list->rank);
    sunder_i_free(list->edge);
    memset(list, 0, sizeof *list);
}

void sunder_i_hulls_add_shape(sunder_i_hulls *list, const sunder_shape *shape, const sunder_i_point *at)
{
    for (uint32_t i = 0, k = 0; i < shape->pieces; i++) {
        const uint32_t first = k;
        for (; k < shape->piece_end[i]; k++) {
            const uint32_t u = shape->piece_vertex[k];
            const uint32_t v = shape->piece_vertex[k + 1 < shape->piece_end[i] ? k + 1 : first];
            sunder_i_hulls_add_corner(list, at[u], sunder_i_is_boundary(shape, u, v));
        }
        list->end[list->n++] = list->corners;
    }
}

/* ---- Ranks ---- */

typedef struct ranking {
    sunder_i_lattice *lattice;
    sunder_i_point *key; /* [sides] the side's vector, turned into [0, pi) */
    bool *flipped;
    uint32_t *order, *rank;
    size_t n;
} ranking;

static int compare_keys(void *context, uint32_t a, uint32_t b)
{
    const ranking *r = context;
    return -sunder_i_cross_sign(r->lattice, r->key[a], r->key[b]); /* both in one half-plane */
}

static void add_vectors(ranking *r, const sunder_i_hulls *list)
{
    sunder_i_lattice *l = r->lattice;
    for (uint32_t i = 0; i < list->n; i++) {
        const uint32_t first = sunder_i_hulls_first(list, i), end = list->end[i];
        for (uint32_t k = first; k < end && end - first > 1; k++) {
            const sunder_i_point d = sunder_i_point_sub(l, list->corner[k + 1 < end ? k + 1 : first], list->corner[k]);
            r->flipped[r->n] = sunder_i_half_plane(l, d) == 1;
            r->key[r->n] = r->flipped[r->n] ? sunder_i_point_neg(l, d) : d;
            r->n++;
        }
    }
}

/* Ranks into the list, each piece turned to start with its least. Uses room for the longest piece. */
static void take_ranks(sunder_i_hulls *list, const uint32_t *rank, size_t *at, sunder_i_point *corner, bool *edge)
{
    for (uint32_t i = 0; i < list->n; i++) {
        const uint32_t first = sunder_i_hulls_first(list, i), n = list->end[i] - first;
        if (n < 2) continue;
        uint32_t least = 0;
        for (uint32_t k = 1; k < n; k++)
            if (rank[*at + k] < rank[*at + least]) least = k;
        memcpy(corner, list->corner + first, n * sizeof *corner);
        memcpy(edge, list->edge + first, n * sizeof *edge);
        for (uint32_t k = 0; k < n; k++) {
            const uint32_t from = (least + k) % n;
            list->corner[first + k] = corner[from];
            list->edge[first + k] = edge[from];
            list->rank[first + k] = rank[*at + from];
        }
        *at += n;
    }
}

/* Order, then classes, then ranks. False if memory is out. */
static bool assign(ranking *r, sunder_i_point *direction, uint32_t *classes)
{
    for (uint32_t i = 0; i < r->n; i++) r->order[i] = i;
    if (!sunder_i_sort_indices(r->order, r->n, compare_keys, r)) return false;
    uint32_t c = 0;
    for (size_t i = 0; i < r->n; i++) {
        const sunder_i_point key = r->key[r->order[i]];
        if (i == 0 || sunder_i_cross_sign(r->lattice, r->key[r->order[i - 1]], key) != 0)
            direction[c++] = key;
        else if (!sunder_i_point_is_plain(direction[c - 1]) && sunder_i_point_is_plain(key))
            direction[c - 1] = key; /* any will do, and numbers stay short */
        r->rank[r->order[i]] = c - 1;
    }
    for (size_t i = 0; i < r->n; i++)
        if (r->flipped[i]) r->rank[i] += c;
    *classes = c;
    return !r->lattice->arena.failed;
}

bool sunder_i_hulls_rank(sunder_i_lattice *lattice, sunder_i_hulls *const *list, size_t lists,
                         sunder_i_point **direction, uint32_t *classes)
{
    size_t sides = 0;
    for (size_t i = 0; i < lists; i++) sides += list[i]->corners;
    ranking r = {lattice,
                 sunder_i_alloc(sides, sizeof *r.key),
                 sunder_i_alloc(sides, sizeof *r.flipped),
                 sunder_i_alloc(sides, sizeof *r.order),
                 sunder_i_alloc(sides, sizeof *r.rank),
                 0};
    sunder_i_point *room = sunder_i_alloc(sides, sizeof *room), *made = sunder_i_alloc(sides, sizeof *made);
    bool *edges = sunder_i_alloc(sides, sizeof *edges);
    bool ok = r.key && r.flipped && r.order && r.rank && room && made && edges;
    for (size_t i = 0; ok && i < lists; i++) add_vectors(&r, list[i]);
    ok = ok && assign(&r, made, classes);
    size_t at = 0;
    for (size_t i = 0; ok && i < lists; i++) take_ranks(list[i], r.rank, &at, room, edges);
    if (ok)
        *direction = made;
    else
        sunder_i_free(made);
    sunder_i_free(r.key);
    sunder_i_free(r.flipped);
    sunder_i_free(r.order);
    sunder_i_free(r.rank);
    sunder_i_free(room);
    sunder_i_free(edges);
    return ok;
}

/* ---- Sums ---- */

static uint32_t sides_of(const sunder_i_hulls *list, uint32_t piece)
{
    const uint32_t n = list->end[piece] - sunder_i_hulls_first(list, piece);
    return n < 2 ? 0 : n;
}

/* Sides of both in the order of their ranks, equal ones joined. A point has none and only shifts; two parallel segments
 * make a segment, and two points a point, so nothing else is special. */
static void merge(sunder_i_lattice *l, const sunder_i_hulls *a, uint32_t i, const sunder_i_hulls *b, uint32_t j,
                  sunder_i_hulls *out)
{
    const uint32_t af = sunder_i_hulls_first(a, i), an = sides_of(a, i);
    const uint32_t bf = sunder_i_hulls_first(b, j), bn = sides_of(b, j);
    uint32_t s = 0, t = 0;
    do {
        const bool from_a = s < an && (t >= bn || a->rank[af + s] <= b->rank[bf + t]);
        const bool from_b = t < bn && (s >= an || b->rank[bf + t] <= a->rank[af + s]);
        const uint32_t u = af + (s < an ? s : 0), v = bf + (t < bn ? t : 0), at = out->corners++;
        out->corner[at] = sunder_i_point_add(l, a->corner[u], b->corner[v]);
        out->rank[at] = from_a ? a->rank[u] : from_b ? b->rank[v] : 0;
        out->edge[at] = (from_a && a->edge[u]) || (from_b && b->edge[v]);
        s += from_a;
        t += from_b;
    } while (s < an || t < bn);
    out->end[out->n++] = out->corners;
}

bool sunder_i_hulls_sum(sunder_i_lattice *lattice, const sunder_i_hulls *a, const sunder_i_hulls *b,
                        sunder_i_hulls *out)
{
    const size_t m = a->n, n = b->n;
    if (m && n && (m > UINT32_MAX / 2 / n || (size_t)a->corners * n + (size_t)b->corners * m > UINT32_MAX / 2))
        return sunder_i_too_many();
    if (!sunder_i_hulls_init(out, m * n, a->corners * n + b->corners * m)) return false;
    for (uint32_t i = 0; i < m && sunder_i_steps(n); i++)
        for (uint32_t j = 0; j < n; j++) merge(lattice, a, i, b, j, out);
    if (!lattice->arena.failed && !sunder_i_stopped()) return true;
    sunder_i_hulls_free(out);
    return false;
}
