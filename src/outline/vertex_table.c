/* vertex_table.c: see vertex_table.h. A hash table over a fine grid of the approximate coordinates. Two approximations
 * of one point differ by far less than a grid step, so that they are in one grid square or both close to the border
 * between two: searching every square within the error finds the point. Equality itself is decided exactly: by the
 * numbers of two lines that meet there, which needs no coordinates, or by the coordinates.
 *
 * If the approximations cannot separate points (small details far from the origin, in a sum with a polygon even farther
 * away) one square would contain all of them. Then the table is rebuilt with hashes of the exact coordinates, which
 * cost two divisions of big integers each. */
#include "outline/vertex_table.h"

#include "outline/tuning.h"

#include <string.h>

typedef struct square {
    int64_t x, y;
} square;

static uint32_t hash_of_square(square q)
{
    uint64_t h = (uint64_t)q.x * 0x9e3779b97f4a7c15u ^ (uint64_t)q.y * 0xc2b2ae3d27d4eb4fu;
    h ^= h >> 32;
    h *= 0x9e3779b97f4a7c15u;
    return (uint32_t)(h >> 32);
}

/* Squares are counted from far below the smallest coordinate, so that truncation rounds down. */
static square square_of(const sunder_i_vertex_table *g, double x, double y)
{
    return (square){(int64_t)(x * g->per_step + 0x1p42), (int64_t)(y * g->per_step + 0x1p42)};
}

static bool is_on(const sunder_i_vertex_slot *s, const sunder_i_vertex_lines *lines)
{
    bool met = false;
    for (uint32_t i = 0; i < lines->others; i++)
        met |= (s->line == lines->line && s->other == lines->other[i]) ||
               (s->other == lines->line && s->line == lines->other[i]);
    return met;
}

static uint32_t find_lines(const sunder_i_vertex_table *g, uint32_t h, const sunder_i_vertex_lines *lines, bool *is_new)
{
    for (size_t at = h & g->mask; g->slot[at].number; at = (at + 1) & g->mask) {
        if (g->slot[at].hash != h) continue;
        *is_new = false;
        if (is_on(&g->slot[at], lines)) return g->slot[at].number - 1;
    }
    return SUNDER_I_NO_VERTEX;
}

static uint32_t find_slot(const sunder_i_vertex_table *g, uint32_t h, const sunder_i_hpoint *p, bool *crowded)
{
    const size_t start = h & g->mask;
    size_t at = start;
    for (; g->slot[at].number; at = (at + 1) & g->mask)
        if (g->slot[at].hash == h && sunder_i_hpoint_equal(g->lattice, &g->point[g->slot[at].number - 1], p))
            return g->slot[at].number - 1;
    if (((at - start) & g->mask) > CROWD) *crowded = true;
    return SUNDER_I_NO_VERTEX;
}

typedef struct squares {
    square low, high;
} squares;

static squares squares_near(const sunder_i_vertex_table *g, double x, double y)
{
    return (squares){square_of(g, x - g->error, y - g->error), square_of(g, x + g->error, y + g->error)};
}

/* Returns the number of p if it is known; *crowded is set if the search passed a long sequence of occupied slots. */
static uint32_t find_near(const sunder_i_vertex_table *g, const sunder_i_hpoint *p, bool *crowded)
{
    const squares s = squares_near(g, p->ax, p->ay);
    for (int64_t x = s.low.x; x <= s.high.x; x++)
        for (int64_t y = s.low.y; y <= s.high.y; y++) {
            const uint32_t v = find_slot(g, hash_of_square((square){x, y}), p, crowded);
            if (v != SUNDER_I_NO_VERTEX) return v;
        }
    return SUNDER_I_NO_VERTEX;
}

uint32_t sunder_i_vertex_table_find(const sunder_i_vertex_table *table, double ax, double ay,
                                    const sunder_i_vertex_lines *lines, bool *is_new)
{
    *is_new = !table->exact;
    if (table->exact) return SUNDER_I_NO_VERTEX;
    const squares s = squares_near(table, ax, ay);
    for (int64_t x = s.low.x; x <= s.high.x; x++)
        for (int64_t y = s.low.y; y <= s.high.y; y++) {
            const uint32_t v = find_lines(table, hash_of_square((square){x, y}), lines, is_new);
            if (v != SUNDER_I_NO_VERTEX) return v;
        }
    return SUNDER_I_NO_VERTEX;
}

static void insert_slot(sunder_i_vertex_table *g, sunder_i_vertex_slot s)
{
    size_t at = s.hash & g->mask;
    while (g->slot[at].number) at = (at + 1) & g->mask;
    g->slot[at] = s;
}

static uint32_t hash_of(const sunder_i_vertex_table *g, const sunder_i_hpoint *p)
{
    return g->exact ? (uint32_t)sunder_i_hpoint_hash(g->lattice, p) : hash_of_square(square_of(g, p->ax, p->ay));
}

/* Makes a table with room for `places` vertices, at most half full; known vertices are entered again, with exact hashes
 * if other_hashes. Returns false if out of memory. */
static bool make_table(sunder_i_vertex_table *g, size_t places, bool other_hashes)
{
    size_t size = 16;
    while (size < 2 * places) size *= 2;
    sunder_i_vertex_slot *old = g->slot, *slot = sunder_i_calloc(size, sizeof *slot);
    const size_t old_size = old ? g->mask + 1 : 0;
    if (!slot) return false;
    g->slot = slot;
    g->mask = size - 1;
    for (size_t i = 0; i < old_size; i++) {
        if (!old[i].number) continue;
        if (other_hashes) old[i].hash = hash_of(g, &g->point[old[i].number - 1]);
        insert_slot(g, old[i]);
    }
    sunder_i_free(old);
    return true;
}

bool sunder_i_vertex_table_init(sunder_i_vertex_table *table, sunder_i_lattice *lattice, double most, size_t expected,
                                size_t appended)
{
    memset(table, 0, sizeof *table);
    table->lattice = lattice;
    /* The step is not a power of two, since lattice points are multiples of those; 2^-40 of the whole separates
     * different points of a map. */
    table->per_step = 1 / (most * 0x1.23456p-40 + 0x1p-800);
    /* each approximation has an error of at most 2^-50 of its coordinate (predicate.h) */
    table->error = most * 0x1p-48;
    return sunder_i_reserve(&table->point, &table->capacity, expected + appended + 1, sizeof *table->point) &&
           make_table(table, expected, false);
}

uint32_t sunder_i_vertex_table_append(sunder_i_vertex_table *table, const sunder_i_hpoint *p)
{
    if (!sunder_i_reserve(&table->point, &table->capacity, table->n + 1, sizeof *table->point))
        return SUNDER_I_NO_VERTEX;
    table->point[table->n] = *p;
    return (uint32_t)table->n++;
}

uint32_t sunder_i_vertex_table_add(sunder_i_vertex_table *table, const sunder_i_hpoint *p,
                                   const sunder_i_vertex_lines *lines, bool is_new)
{
    bool crowded = false;
    if (!is_new) {
        const uint32_t known =
            table->exact ? find_slot(table, hash_of(table, p), p, &crowded) : find_near(table, p, &crowded);
        if (known != SUNDER_I_NO_VERTEX) return known;
    }
    if (crowded && !table->exact) {
        table->exact = true;
        if (!make_table(table, table->entered, true)) return SUNDER_I_NO_VERTEX;
    }
    if (2 * (table->entered + 1) > table->mask + 1 && !make_table(table, 2 * table->entered, false))
        return SUNDER_I_NO_VERTEX;
    const uint32_t number = sunder_i_vertex_table_append(table, p);
    if (number == SUNDER_I_NO_VERTEX) return number;
    const bool met = lines && lines->others > 0;
    insert_slot(
        table, (sunder_i_vertex_slot){number + 1, hash_of(table, p), met ? lines->line : 0, met ? lines->other[0] : 0});
    table->entered++;
    return number;
}

void sunder_i_vertex_table_free(sunder_i_vertex_table *table)
{
    sunder_i_free_all(table->point, table->slot);
    memset(table, 0, sizeof *table);
}
