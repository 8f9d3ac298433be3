/* canonical_rings.c: the order of the cleaned rings of a shape, independent of the order in the input: each ring begins
 * at its lexicographically smallest vertex, and holes and polygons are sorted by their vertices. So equal rings result
 * in equal pieces, numbers and moves, wherever a ring begins and whichever direction it has in a file.
 *
 * If a ring passes its smallest position more than once, or rings have it in common, the following vertices decide.
 * Rings that are equal in all vertices are equal. */
#include "shape/build.h"

#include "base/sort.h"

#include <string.h>

static uint32_t begin_of(const uint32_t *end, uint32_t k) { return k ? end[k - 1] : 0; }

/* Compares two rings from the vertices a and b on; they have n and m vertices. */
static int compare_from(const sunder_i_rings *r, uint32_t a, uint32_t n, uint32_t b, uint32_t m)
{
    for (uint32_t k = 0; k < n && k < m; k++, a = r->next[a], b = r->next[b]) {
        const int order = sunder_i_rings_cmp(r, a, b);
        if (order) return order;
    }
    return (n > m) - (n < m);
}

/* ---- The first vertex of a ring ---- */

static uint32_t first_corner(const sunder_i_rings *r, uint32_t lo, uint32_t hi)
{
    uint32_t first = lo;
    for (uint32_t v = lo + 1; v < hi; v++) {
        const int order = sunder_i_rings_cmp(r, v, first);
        if (order < 0 || (order == 0 && compare_from(r, v, hi - lo, first, hi - lo) < 0)) first = v;
    }
    return first;
}

/* ---- The order of rings ---- */

/* The rings, and the numbers of each polygon's rings in their new order: the outer one, then its holes. */
typedef struct ordering {
    const sunder_i_rings *r;
    uint32_t *ring;
} ordering;

static int by_corners(void *context, uint32_t a, uint32_t b)
{
    const sunder_i_rings *r = ((const ordering *)context)->r;
    const uint32_t i = begin_of(r->ring_end, a), j = begin_of(r->ring_end, b);
    return compare_from(r, i, r->ring_end[a] - i, j, r->ring_end[b] - j);
}

static int by_rings(void *context, uint32_t a, uint32_t b)
{
    const ordering *o = context;
    const uint32_t *end = o->r->poly_end;
    uint32_t i = begin_of(end, a), j = begin_of(end, b);
    for (; i < end[a] && j < end[b]; i++, j++) {
        const int order = by_corners(context, o->ring[i], o->ring[j]);
        if (order) return order;
    }
    return (i < end[a]) - (j < end[b]);
}

/* Sets number[] to first .. first + n - 1, sorted by `compare`. Returns false if the computation must stop. */
static bool sort_from(ordering *o, uint32_t first, uint32_t n, int (*compare)(void *, uint32_t, uint32_t),
                      uint32_t *number)
{
    for (uint32_t k = 0; k < n; k++) number[k] = first + k;
    return sunder_i_sort_indices(number, n, compare, o);
}

/* ---- All steps ---- */

/* Copies vertex `from` of the old rings to vertex `to`; links are set later. */
static void move_corner(const sunder_i_rings *old, uint32_t from, sunder_i_rings *r, uint32_t to)
{
    r->at[to] = old->at[from];
    r->source[to] = old->source[from];
    memcpy(r->xy + 2 * (size_t)to, old->xy + 2 * (size_t)from, 2 * sizeof *r->xy);
}

static void write_ring(const sunder_i_rings *old, uint32_t ring, sunder_i_rings *r)
{
    const uint32_t lo = begin_of(old->ring_end, ring), n = old->ring_end[ring] - lo, to = r->vertices;
    for (uint32_t k = 0; k < n; k++) {
        move_corner(old, lo + k, r, to + k);
        r->next[to + k] = to + (k + 1 < n ? k + 1 : 0);
        r->prev[to + k] = to + (k ? k - 1 : n - 1);
    }
    r->vertices += n;
    r->ring_end[r->rings++] = r->vertices;
}

static bool start_rings(sunder_i_rings *r, sunder_i_arena *arena)
{
    for (uint32_t ring = 0; ring < r->rings; ring++) {
        const uint32_t lo = begin_of(r->ring_end, ring), n = r->ring_end[ring] - lo,
                       first = first_corner(r, lo, lo + n);
        if (first == lo) continue;
        const sunder_i_mark mark = sunder_i_arena_mark(arena);
        sunder_i_rings old = {.lattice = r->lattice};
        if (!sunder_i_rings_grow(&old, arena, n, 1, 1)) return false;
        for (uint32_t k = 0; k < n; k++) move_corner(r, first + k < lo + n ? first + k : first + k - n, &old, k);
        for (uint32_t k = 0; k < n; k++) move_corner(&old, k, r, lo + k);
        sunder_i_arena_release(arena, mark);
    }
    return true;
}

/* Sorts holes and polygons; each ring already begins at its first vertex. Returns false if out of memory. */
static bool sort_rings(sunder_i_rings *r, sunder_i_arena *arena)
{
    uint32_t *number = sunder_i_arena_alloc(arena, (size_t)r->rings + r->polygons, sizeof *number);
    sunder_i_rings sorted = {.lattice = r->lattice, .rounded = r->rounded};
    ordering o = {r, number};
    if (!number || !sunder_i_rings_grow(&sorted, arena, r->vertices, r->rings, r->polygons)) return false;
    for (uint32_t p = 0; p < r->polygons; p++) {
        const uint32_t outer = begin_of(r->poly_end, p), holes = r->poly_end[p] - outer - 1;
        number[outer] = outer;
        if (!sort_from(&o, outer + 1, holes, by_corners, number + outer + 1)) return false;
    }
    uint32_t *const polygon = number + r->rings;
    if (!sort_from(&o, 0, r->polygons, by_rings, polygon)) return false;
    for (uint32_t k = 0; k < r->polygons; k++) {
        const uint32_t p = polygon[k];
        for (uint32_t i = begin_of(r->poly_end, p); i < r->poly_end[p]; i++) write_ring(r, number[i], &sorted);
        sorted.poly_end[sorted.polygons++] = sorted.rings;
    }
    *r = sorted;
    return true;
}

bool sunder_i_rings_canonical(sunder_i_rings *r, sunder_i_arena *arena)
{
    return start_rings(r, arena) && (r->rings < 2 || sort_rings(r, arena));
}
