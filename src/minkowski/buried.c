/* Where many members are grown by one shape and overlap, most of their sides lie inside some other subsum, and the
 * cells (cells.h) spend most of their time on such. A side inside an open convex set is one with both its ends there;
 * which subsums may hold it is read off a grid. A filter: what it does not find is found by the cells. Floating point
 * with one-sided bounds, so that nothing is taken for buried that is not. */
#include "minkowski/buried.h"

#include "predicate/kernel.h"

#include <math.h>

typedef struct box {
    int64_t low[2], high[2];
} box;

/* Squares of 2^shift lattice units; in each the subsums of which the box reaches into it. */
typedef struct grid {
    const sunder_i_subsums *subsums;
    box *reach; /* [subsums] their boxes */
    box all;
    int shift;
    uint32_t size[2];
    uint32_t *end, *list; /* [squares] past its last entry in list */
} grid;

/* ---- Inside a subsum? ---- */

/* cross(b - a, p - a), or 0 where its sign is not certain. Differences are below 2^61 and round once each, products and
 * their difference once more: the error is below 4 ulps of the products' magnitudes. */
static double turn(sunder_i_point a, sunder_i_point b, sunder_i_point p)
{
    const double s = (double)(b.x - a.x) * (double)(p.y - a.y), t = (double)(b.y - a.y) * (double)(p.x - a.x);
    const double c = s - t;
    return fabs(c) > 0x1p-50 * (fabs(s) + fabs(t)) ? c : 0;
}

static bool is_within(const box *b, sunder_i_point p)
{
    return p.x > b->low[0] && p.x < b->high[0] && p.y > b->low[1] && p.y < b->high[1];
}

/* Is p strictly inside for certain? The fan of triangles around the first corner is searched for the one that holds p.
 */
static bool holds(const grid *g, uint32_t subsum, sunder_i_point p)
{
    const sunder_i_subsums *s = g->subsums;
    const uint32_t first = sunder_i_subsum_first(s, subsum);
    const sunder_i_point *c = s->corner + first;
    uint32_t low = 1, high = s->end[subsum] - first - 1;
    if (turn(c[0], c[low], p) <= 0 || turn(c[0], c[high], p) >= 0) return false;
    while (high - low > 1) {
        const uint32_t middle = (low + high) / 2;
        const double where = turn(c[0], c[middle], p);
        if (where == 0) return false; /* on the diagonal, or too near: the two halves might both be wrong */
        if (where > 0)
            low = middle;
        else
            high = middle;
    }
    return turn(c[low], c[high], p) > 0;
}

/* ---- The grid ---- */

static void measure(grid *g)
{
    const sunder_i_subsums *s = g->subsums;
    for (size_t i = 0; i < s->n; i++) {
        const uint32_t first = sunder_i_subsum_first(s, i);
        const sunder_i_point a = s->corner[first];
        box b = {{a.x, a.y}, {a.x, a.y}};
        for (uint32_t k = first + 1; k < s->end[i]; k++) {
            const sunder_i_point p = s->corner[k];
            if (p.x < b.low[0]) b.low[0] = p.x;
            if (p.x > b.high[0]) b.high[0] = p.x;
            if (p.y < b.low[1]) b.low[1] = p.y;
            if (p.y > b.high[1]) b.high[1] = p.y;
        }
        g->reach[i] = b;
        if (i == 0) g->all = b;
        for (int k = 0; k < 2; k++) {
            if (b.low[k] < g->all.low[k]) g->all.low[k] = b.low[k];
            if (b.high[k] > g->all.high[k]) g->all.high[k] = b.high[k];
        }
    }
}

static uint32_t column(const grid *g, int axis, int64_t at) { return (uint32_t)((at - g->all.low[axis]) >> g->shift); }

/* Squares about as large as half a subsum, but no more than four for each. */
static void choose_squares(grid *g)
{
    const size_t n = g->subsums->n;
    double extent = 0;
    for (size_t i = 0; i < n; i++)
        extent +=
            ((double)(g->reach[i].high[0] - g->reach[i].low[0]) + (double)(g->reach[i].high[1] - g->reach[i].low[1])) /
            4;
    for (g->shift = 0; g->shift < 62; g->shift++) {
        for (int k = 0; k < 2; k++) {
            const int64_t columns = (g->all.high[k] - g->all.low[k]) >> g->shift;
            g->size[k] = columns < UINT32_MAX / 2 ? (uint32_t)columns + 1 : UINT32_MAX;
        }
        if (ldexp(1, g->shift + 1) > extent / (double)n && (double)g->size[0] * g->size[1] <= 4.0 * (double)n) break;
    }
}

/* Calls for each square of a box: counts it in end[], or with `fill` writes the subsum there. */
static void visit(grid *g, uint32_t subsum, bool fill)
{
    const box *b = &g->reach[subsum];
    for (uint32_t y = column(g, 1, b->low[1]); y <= column(g, 1, b->high[1]); y++)
        for (uint32_t x = column(g, 0, b->low[0]); x <= column(g, 0, b->high[0]); x++) {
            uint32_t *end = &g->end[(size_t)y * g->size[0] + x];
            if (fill) g->list[*end] = subsum;
            ++*end;
        }
}

/* In most layers an entry or two for each square a subsum touches; where a few subsums are far larger than the others
 * the lists would not be worth their room, and *made is false. */
static bool make_lists(grid *g, bool *made)
{
    const uint32_t n = (uint32_t)g->subsums->n;
    const size_t squares = (size_t)g->size[0] * g->size[1];
    double entries = 0;
    *made = false;
    for (uint32_t i = 0; i < n; i++) {
        const box *b = &g->reach[i];
        entries += (double)(column(g, 0, b->high[0]) - column(g, 0, b->low[0]) + 1) *
                   (double)(column(g, 1, b->high[1]) - column(g, 1, b->low[1]) + 1);
    }
    if (entries > 64.0 * n || entries > UINT32_MAX / 2) return true;
    g->end = sunder_i_calloc(squares, sizeof *g->end);
    g->list = sunder_i_alloc((size_t)entries, sizeof *g->list);
    if (!g->end || !g->list) return false;
    for (uint32_t i = 0; i < n; i++) visit(g, i, false);
    uint32_t sum = 0;
    for (size_t q = 0; q < squares; q++) {
        const uint32_t count = g->end[q];
        g->end[q] = sum; /* where the next goes; in the end the end */
        sum += count;
    }
    for (uint32_t i = 0; i < n; i++) visit(g, i, true);
    *made = true;
    return true;
}

/* ---- Sides ---- */

#define NONE UINT32_MAX

static bool holds_both(const grid *g, uint32_t subsum, sunder_i_point a, sunder_i_point b)
{
    const box *r = &g->reach[subsum];
    return is_within(r, a) && is_within(r, b) && holds(g, subsum, b) && holds(g, subsum, a);
}

/* A subsum that holds the segment ab; NONE if none is found. The one that held the side before is asked first. */
static uint32_t find_holder(const grid *g, sunder_i_point a, sunder_i_point b, uint32_t own, uint32_t hint)
{
    if (hint != NONE && holds_both(g, hint, a, b)) return hint;
    const sunder_i_point middle = {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
    const size_t q = (size_t)column(g, 1, middle.y) * g->size[0] + column(g, 0, middle.x);
    for (uint32_t i = q ? g->end[q - 1] : 0; i < g->end[q]; i++) {
        const uint32_t subsum = g->list[i];
        if (subsum != own && holds_both(g, subsum, a, b)) return subsum;
    }
    return NONE;
}

static void bury(sunder_i_subsums *s, const grid *g)
{
    for (uint32_t i = 0; i < s->n; i++) {
        const uint32_t first = sunder_i_subsum_first(s, i), end = s->end[i];
        uint32_t holder = NONE;
        for (uint32_t k = first; k < end; k++) {
            if (!s->candidate[k]) continue;
            holder = find_holder(g, s->corner[k], s->corner[k + 1 < end ? k + 1 : first], i, holder);
            s->candidate[k] = holder == NONE;
        }
    }
}

sunder_status sunder_i_bury_candidates(sunder_i_subsums *subsums, sunder_error *err)
{
    if (!subsums->lattice->narrow || subsums->n == 0) return SUNDER_OK;
    grid g = {.subsums = subsums, .reach = sunder_i_alloc(subsums->n, sizeof *g.reach)};
    bool ok = g.reach != NULL, made = false;
    if (ok) {
        measure(&g);
        choose_squares(&g);
        ok = make_lists(&g, &made);
        if (made) bury(subsums, &g);
    }
    sunder_i_free(g.reach);
    sunder_i_free(g.end);
    sunder_i_free(g.list);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}
