/* pieces.c: lists of convex pieces: construction, ranks, sums. */
#include "convex/pieces.h"

#include "base/invariant.h"
#include "base/watch.h"
#include "convex/merge.h"
#include "predicate/predicate.h"

#include <string.h>

bool sunder_i_convex_pieces_init(sunder_i_convex_pieces *list, size_t n, size_t corners)
{
    memset(list, 0, sizeof *list);
    if (n > UINT32_MAX / 2 || corners > UINT32_MAX / 2) return sunder_i_too_many();
    list->end = sunder_i_alloc(n, sizeof *list->end);
    list->corner = sunder_i_alloc(corners, sizeof *list->corner);
    list->rank = sunder_i_alloc(corners, sizeof *list->rank);
    list->candidate = sunder_i_alloc(corners, sizeof *list->candidate);
    if (list->end && list->corner && list->rank && list->candidate) return true;
    sunder_i_convex_pieces_free(list);
    return false;
}

void sunder_i_convex_pieces_free(sunder_i_convex_pieces *list)
{
    sunder_i_free_all(list->end, list->corner, list->rank, list->candidate, list->vertex);
    memset(list, 0, sizeof *list);
}

void sunder_i_convex_pieces_add_shape(sunder_i_convex_pieces *list, const sunder_shape *shape, const sunder_i_point *at)
{
    for (uint32_t i = 0, k = 0; i < shape->pieces; i++) {
        const uint32_t first = k;
        for (; k < shape->piece_end[i]; k++) {
            const uint32_t u = sunder_i_piece_vertices(shape)[k];
            const uint32_t v = sunder_i_piece_vertices(shape)[k + 1 < shape->piece_end[i] ? k + 1 : first];
            sunder_i_convex_pieces_add_corner(list, at[u], sunder_i_is_boundary(shape, u, v));
        }
        list->end[list->n++] = list->corners;
    }
}

/* Shrinks the memory of an array to n elements. If that fails, the array keeps its size. */
static void cut_off(void *array, size_t n, size_t size)
{
    void *old;
    memcpy(&old, array, sizeof old);
    void *shorter = sunder_i_realloc(old, n, size);
    if (shorter) memcpy(array, &shorter, sizeof shorter);
}

void sunder_i_convex_pieces_remove(sunder_i_convex_pieces *list, const bool *gone)
{
    uint32_t n = 0, corners = 0;
    for (uint32_t i = 0, first = 0; i < list->n; i++) {
        const uint32_t end = list->end[i], m = end - first;
        if (!gone[i] && n == i) { /* nothing was removed so far: the piece is not moved */
            corners += m;
            n++;
        } else if (!gone[i]) {
            memmove(list->corner + corners, list->corner + first, m * sizeof *list->corner);
            memmove(list->rank + corners, list->rank + first, m * sizeof *list->rank);
            memmove(list->candidate + corners, list->candidate + first, m * sizeof *list->candidate);
            if (list->vertex) memmove(list->vertex + corners, list->vertex + first, m * sizeof *list->vertex);
            corners += m;
            list->end[n++] = corners;
        }
        first = end;
    }
    if (n == 0 || n == list->n) return;
    list->n = n;
    list->corners = corners;
    cut_off(&list->end, n, sizeof *list->end);
    cut_off(&list->corner, corners, sizeof *list->corner);
    cut_off(&list->rank, corners, sizeof *list->rank);
    cut_off(&list->candidate, corners, sizeof *list->candidate);
    if (list->vertex) cut_off(&list->vertex, corners, sizeof *list->vertex);
}

/* ---- Ranks ---- */

static uint32_t sides_of(const sunder_i_convex_pieces *list, uint32_t piece)
{
    const uint32_t n = list->end[piece] - sunder_i_convex_pieces_first(list, piece);
    return n < 2 ? 0 : n;
}

/* Writes the vectors of the sides of all pieces to `side`, piece by piece. Returns their number. */
static size_t side_vectors(sunder_i_lattice *l, const sunder_i_convex_pieces *list, sunder_i_point *side)
{
    size_t sides = 0;
    for (uint32_t i = 0; i < list->n; i++) {
        const uint32_t n = sides_of(list, i);
        const sunder_i_point *at = list->corner + sunder_i_convex_pieces_first(list, i);
        for (uint32_t k = 0; k < n; k++) side[sides++] = sunder_i_point_sub(l, at[k + 1 < n ? k + 1 : 0], at[k]);
    }
    return sides;
}

static void rotate_array(void *array, size_t size, uint32_t n, uint32_t by, void *room)
{
    char *item = array;
    memcpy(room, item, by * size);
    memmove(item, item + by * size, (n - by) * size);
    memcpy(item + (n - by) * size, room, by * size);
}

/* Rotates the corners of a piece so that it starts with a side of the least rank. If several collinear sides have that
 * rank, the first of them, which may be at the end of the list, comes first. */
static void start_with_least(sunder_i_convex_pieces *list, uint32_t first, uint32_t n, void *room)
{
    uint32_t *rank = list->rank + first, least = 0;
    for (uint32_t k = 1; k < n; k++)
        if (rank[k] < rank[least]) least = k;
    while (rank[(least + n - 1) % n] == rank[least]) least = (least + n - 1) % n;
    if (least == 0) return;
    rotate_array(rank, sizeof *rank, n, least, room);
    rotate_array(list->corner + first, sizeof *list->corner, n, least, room);
    rotate_array(list->candidate + first, sizeof *list->candidate, n, least, room);
    if (list->vertex) rotate_array(list->vertex + first, sizeof *list->vertex, n, least, room);
}

/* Sets the ranks of the sides, and rotates each piece so that it starts with the least one. Returns the number of ranks
 * used. */
static size_t take_ranks(sunder_i_convex_pieces *list, const uint32_t *rank, void *room)
{
    size_t sides = 0;
    for (uint32_t i = 0; i < list->n; i++) {
        const uint32_t first = sunder_i_convex_pieces_first(list, i), n = sides_of(list, i);
        if (n == 0) continue;
        memcpy(list->rank + first, rank + sides, n * sizeof *rank);
        start_with_least(list, first, n, room);
        sides += n;
    }
    return sides;
}

bool sunder_i_convex_pieces_rank(sunder_i_lattice *lattice, sunder_i_convex_pieces *const *list, size_t lists,
                                 sunder_i_directions *out)
{
    size_t most = 0, sides = 0;
    for (size_t i = 0; i < lists; i++) most += list[i]->corners;
    sunder_i_point *side = sunder_i_alloc(most, sizeof *side);
    uint32_t *rank = sunder_i_alloc(most, sizeof *rank);
    bool ok = side && rank;
    for (size_t i = 0; ok && i < lists; i++) sides += side_vectors(lattice, list[i], side + sides);
    ok = ok && sunder_i_directions_rank(lattice, side, sides, rank, out);
    sides = 0;
    for (size_t i = 0; ok && i < lists; i++) {
        sides += take_ranks(list[i], rank + sides, side);
        list[i]->lattice = lattice;
        list[i]->classes = out->classes;
        list[i]->direction = out->vector;
        SUNDER_I_ASSERT(!sunder_i_convex_pieces_check(list[i]));
    }
    sunder_i_free_all(side, rank);
    return ok;
}

const char *sunder_i_convex_pieces_check(const sunder_i_convex_pieces *list)
{
    for (uint32_t i = 0; i < list->n; i++) {
        const uint32_t first = sunder_i_convex_pieces_first(list, i), n = sides_of(list, i);
        if (list->end[i] <= first) return "a piece has no corner";
        for (uint32_t k = 0; k < n; k++) {
            const uint32_t rank = list->rank[first + k];
            const uint32_t next = k + 1 < n ? list->rank[first + k + 1] : list->rank[first] + 2 * list->classes;
            if (rank >= 2 * list->classes) return "a side has a rank past the last";
            if (next < rank) return "the ranks of a piece fall";
            if (next - rank > list->classes || (next - rank == list->classes && n > 2))
                return "a piece turns by half a turn or more at a corner";
        }
    }
    return NULL;
}

/* ---- Sums ---- */

bool sunder_i_convex_pieces_init_sum(const sunder_i_convex_pieces *a, const sunder_i_convex_pieces *b,
                                     sunder_i_convex_pieces *out)
{
    const size_t m = a->n, n = b->n;
    if (m && n && (m > UINT32_MAX / 2 / n || (size_t)a->corners * n + (size_t)b->corners * m > UINT32_MAX / 2))
        return sunder_i_too_many();
    if (!sunder_i_convex_pieces_init(out, m * n, a->corners * n + b->corners * m)) return false;
    out->lattice = a->lattice;
    out->classes = a->classes;
    out->direction = a->direction;
    return true;
}

/* Appends the sum of piece i of a and piece j of b. A point only translates the other piece, and two parallel segments
 * give a segment, so that only two points are a special case. */
static void add_sum(const sunder_i_convex_pieces *a, uint32_t i, const sunder_i_convex_pieces *b, uint32_t j,
                    sunder_i_convex_pieces *out)
{
    const uint32_t af = sunder_i_convex_pieces_first(a, i), bf = sunder_i_convex_pieces_first(b, j);
    sunder_i_merge m = sunder_i_merge_of(sides_of(a, i), sides_of(b, j));
    while (SUNDER_I_MERGE_NEXT(&m, sunder_i_rank_cmp(a->rank[af + m.next_a], b->rank[bf + m.next_b]))) {
        const uint32_t u = af + m.a, v = bf + m.b;
        out->rank[out->corners] = m.of_a ? a->rank[u] : b->rank[v];
        sunder_i_convex_pieces_add_corner(out, sunder_i_point_add(out->lattice, a->corner[u], b->corner[v]),
                                          (m.of_a && a->candidate[u]) || (m.of_b && b->candidate[v]));
    }
    if (!sides_of(a, i) && !sides_of(b, j)) {
        out->rank[out->corners] = 0;
        sunder_i_convex_pieces_add_corner(out, sunder_i_point_add(out->lattice, a->corner[af], b->corner[bf]), false);
    }
    out->end[out->n++] = out->corners;
}

bool sunder_i_convex_pieces_sum(const sunder_i_convex_pieces *a, const sunder_i_convex_pieces *b,
                                sunder_i_convex_pieces *out)
{
    if (!sunder_i_convex_pieces_init_sum(a, b, out)) return false;
    for (uint32_t i = 0; i < a->n && sunder_i_steps(b->n); i++)
        for (uint32_t j = 0; j < b->n; j++) add_sum(a, i, b, j, out);
    if (!out->lattice->arena.failed && !sunder_i_stopped()) return true;
    sunder_i_convex_pieces_free(out);
    return false;
}
