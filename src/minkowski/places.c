/* A hash table over a fine grid of the approximate coordinates. Two approximations of one point differ by a relative error far
 * below a grid step, so they fall in one grid square, or both close to the border between two: looking into every
 * square that the error reaches finds the point. Equality itself is decided exactly. */
#include "minkowski/places.h"

#include <math.h>

typedef struct square {
    int64_t x, y;
} square;

typedef struct grid {
    sunder_i_lattice *lattice;
    sunder_i_hpoint *point; /* compacted so far */
    uint32_t *slot;         /* number + 1, or 0 */
    size_t mask;
    double step;
} grid;

static size_t hash(square q)
{
    uint64_t h = (uint64_t)q.x * 0x9e3779b97f4a7c15u ^ (uint64_t)q.y * 0xc2b2ae3d27d4eb4fu;
    h ^= h >> 32;
    h *= 0x9e3779b97f4a7c15u;
    return (size_t)(h ^ h >> 29);
}

static square square_of(const grid *g, double x, double y)
{
    return (square){(int64_t)floor(x / g->step), (int64_t)floor(y / g->step)};
}

static uint32_t find(const grid *g, square q, const sunder_i_hpoint *p)
{
    for (size_t at = hash(q) & g->mask; g->slot[at]; at = (at + 1) & g->mask)
        if (sunder_i_hpoint_equal(g->lattice, &g->point[g->slot[at] - 1], p)) return g->slot[at] - 1;
    return UINT32_MAX;
}

static void insert(grid *g, square q, uint32_t number)
{
    size_t at = hash(q) & g->mask;
    while (g->slot[at]) at = (at + 1) & g->mask;
    g->slot[at] = number + 1;
}

static uint32_t find_near(const grid *g, const sunder_i_hpoint *p, double error)
{
    const square low = square_of(g, p->ax - error, p->ay - error), high = square_of(g, p->ax + error, p->ay + error);
    for (int64_t x = low.x; x <= high.x; x++)
        for (int64_t y = low.y; y <= high.y; y++) {
            const uint32_t v = find(g, (square){x, y}, p);
            if (v != UINT32_MAX) return v;
        }
    return UINT32_MAX;
}

size_t sunder_i_places_unify(sunder_i_lattice *lattice, sunder_i_hpoint *point, size_t n, uint32_t *vertex_of)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) most = fmax(most, fmax(fabs(point[i].ax), fabs(point[i].ay)));
    size_t size = 16;
    while (size < 2 * n) size *= 2;
    /* Off the powers of two, where lattice points stand; 2^-40 of the whole keeps different places apart on maps. */
    grid g = {lattice, point, sunder_i_calloc(size, sizeof *g.slot), size - 1, most * 0x1.23456p-40 + 0x1p-800};
    if (!g.slot) return SIZE_MAX;
    /* Each approximation is within 2^-50 of its coordinate's size (predicate.h). */
    const double error = most * 0x1p-48;
    size_t places = 0;
    for (size_t i = 0; i < n; i++) {
        const sunder_i_hpoint p = point[i];
        vertex_of[i] = find_near(&g, &p, error);
        if (vertex_of[i] != UINT32_MAX) continue;
        vertex_of[i] = (uint32_t)places;
        point[places] = p;
        insert(&g, square_of(&g, p.ax, p.ay), (uint32_t)places);
        places++;
    }
    sunder_i_free(g.slot);
    return lattice->arena.failed ? SIZE_MAX : places;
}
