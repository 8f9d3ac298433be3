/* Where many members are grown by one shape and overlap, most of their sides lie inside some other part, and the
 * cells (culling.h) spend most of their time on such; where members nearly coincide, no cell parts them, and all their
 * sides would meet all parts along their lines. A side inside an open convex set is one with both its ends there;
 * which parts may hold it is read off a grid. A filter: what it does not find is found by the cells. Floating point
 * with one-sided bounds, so that nothing is taken for contained that is not. */
#include "outline/contained_sides.h"

#include "base/extremes.h"
#include "base/sort.h"
#include "base/watch.h"
#include "outline/tuning.h"
#include "predicate/narrow.h"

#include <math.h>

typedef struct box {
    int64_t low[2], high[2];
} box;

/* Squares of 2^shift units; in each the parts of which the box reaches into it. The units are those of a narrow
 * lattice; of a wide one the coordinates are rounded to 60 bits of the largest, and may be off by so much each. */
typedef struct grid {
    const sunder_i_convex_pieces *parts;
    const sunder_i_point *corner;
    sunder_i_point *rounded; /* what they are on a wide lattice, else NULL */
    int64_t error;
    box *reach;      /* [parts] their boxes */
    uint32_t *order; /* [parts] the largest first */
    box all;
    int shift;
    uint32_t size[2];
    uint32_t *end, *list;  /* [squares] past its last entry in list */
    size_t spent, allowed; /* parts looked at, see drop() */
} grid;

/* ---- Inside a part? ---- */

/* cross(b - a, p - a), or 0 where its sign is not certain. Differences are below 2^62 and round once each, products and
 * their difference once more: the error is below 4 ulps of the products' magnitudes. Where coordinates are off by e,
 * differences u, v are by 2 e, and the product by 2 e (|ux| + |uy| + |vx| + |vy|) + 8 e^2 at most; twice that is
 * asked. */
static double turn(const grid *g, sunder_i_point a, sunder_i_point b, sunder_i_point p)
{
    const double ux = (double)(b.x - a.x), uy = (double)(b.y - a.y), vx = (double)(p.x - a.x), vy = (double)(p.y - a.y);
    const double s = ux * vy, t = uy * vx, c = s - t, e = (double)g->error;
    double bound = 0x1p-50 * (fabs(s) + fabs(t));
    if (g->error) bound += 4 * e * (fabs(ux) + fabs(uy) + fabs(vx) + fabs(vy)) + 16 * e * e;
    return fabs(c) > bound ? c : 0;
}

static bool is_within(const grid *g, const box *b, sunder_i_point p)
{
    const int64_t e = 2 * g->error; /* of the corner and of the box */
    return p.x > b->low[0] + e && p.x < b->high[0] - e && p.y > b->low[1] + e && p.y < b->high[1] - e;
}

/* Is p strictly inside for certain? The fan of triangles around the first corner is searched for the one that holds p,
 * or for the diagonal that it is on, or too near to be told on which side: then for the two triangles beside that. */
static bool holds(const grid *g, uint32_t part, sunder_i_point p)
{
    const sunder_i_convex_pieces *s = g->parts;
    const uint32_t first = sunder_i_convex_pieces_first(s, part);
    const sunder_i_point *c = g->corner + first;
    uint32_t low = 1, high = s->end[part] - first - 1;
    if (turn(g, c[0], c[low], p) <= 0 || turn(g, c[0], c[high], p) >= 0) return false;
    while (high - low > 1) {
        const uint32_t middle = (low + high) / 2;
        const double where = turn(g, c[0], c[middle], p);
        if (where == 0)
            return turn(g, c[0], c[middle - 1], p) > 0 && turn(g, c[middle - 1], c[middle], p) > 0 &&
                   turn(g, c[middle], c[middle + 1], p) > 0 && turn(g, c[middle + 1], c[0], p) > 0;
        if (where > 0)
            low = middle;
        else
            high = middle;
    }
    return turn(g, c[low], c[high], p) > 0;
}

/* ---- The grid ---- */

/* sunder_i_approx() is off by half an ulp of the largest, 2^-53 of it, which is less than 2^60 units here: by 2^7, and
 * by half a unit where that is rounded. False if memory is out, or if all is next to nothing, where
 * doubles underflow. */
static bool take_corners(grid *g, bool *no_memory)
{
    const sunder_i_convex_pieces *s = g->parts;
    g->corner = s->corner;
    if (s->lattice->narrow) return true;
    double most = 0;
    int exponent;
    for (size_t k = 0; k < s->corners; k++)
        most = sunder_i_max(most, sunder_i_max(fabs(sunder_i_approx(s->lattice, s->corner[k].x)),
                                               fabs(sunder_i_approx(s->lattice, s->corner[k].y))));
    if (!(most > 0x1p-900)) return false;
    frexp(most, &exponent);
    g->rounded = sunder_i_alloc(s->corners, sizeof *g->rounded);
    *no_memory = !g->rounded;
    if (*no_memory) return false;
    for (size_t k = 0; k < s->corners; k++)
        g->rounded[k] = (sunder_i_point){llrint(ldexp(sunder_i_approx(s->lattice, s->corner[k].x), 60 - exponent)),
                                         llrint(ldexp(sunder_i_approx(s->lattice, s->corner[k].y), 60 - exponent))};
    g->corner = g->rounded;
    g->error = 0x1p8;
    return true;
}

static void measure(grid *g)
{
    const sunder_i_convex_pieces *s = g->parts;
    for (size_t i = 0; i < s->n; i++) {
        const uint32_t first = sunder_i_convex_pieces_first(s, i);
        const sunder_i_point a = g->corner[first];
        box b = {{a.x, a.y}, {a.x, a.y}};
        for (uint32_t k = first + 1; k < s->end[i]; k++) {
            const sunder_i_point p = g->corner[k];
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

/* Boxes stand for what they hold: whether one is larger is of no consequence but for time. */
static bool order_by_extent(grid *g)
{
    const size_t n = g->parts->n;
    double *extent = sunder_i_alloc(n, sizeof *extent);
    for (uint32_t i = 0; extent && i < n; i++) {
        const box *r = &g->reach[i];
        g->order[i] = i;
        extent[i] = ((double)r->high[0] - (double)r->low[0]) * ((double)r->high[1] - (double)r->low[1]);
    }
    const bool ok = extent && sunder_i_sort_indices(g->order, n, sunder_i_descending, extent);
    sunder_i_free(extent);
    return ok;
}

/* Squares about as large as half a part, but no more than four for each. */
static void choose_squares(grid *g)
{
    const size_t n = g->parts->n;
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
        if (ldexp(1, g->shift + 1) > extent / (double)n && (double)g->size[0] * g->size[1] <= MOST_SQUARES * (double)n)
            break;
    }
}

/* Calls for each square of a box: counts it in end[], or with `fill` writes the part there. */
static void visit(grid *g, uint32_t part, bool fill)
{
    const box *b = &g->reach[part];
    for (uint32_t y = column(g, 1, b->low[1]); y <= column(g, 1, b->high[1]); y++)
        for (uint32_t x = column(g, 0, b->low[0]); x <= column(g, 0, b->high[0]); x++) {
            uint32_t *end = &g->end[(size_t)y * g->size[0] + x];
            if (fill) g->list[*end] = part;
            ++*end;
        }
}

/* In most layers an entry or two for each square a part touches; where a few parts are far larger than the others
 * the lists would not be worth their room, and *made is false. */
static bool make_lists(grid *g, bool *made)
{
    const uint32_t n = (uint32_t)g->parts->n;
    const size_t squares = (size_t)g->size[0] * g->size[1];
    double entries = 0;
    *made = false;
    for (uint32_t i = 0; i < n; i++) {
        const box *b = &g->reach[i];
        entries += (double)(column(g, 0, b->high[0]) - column(g, 0, b->low[0]) + 1) *
                   (double)(column(g, 1, b->high[1]) - column(g, 1, b->low[1]) + 1);
    }
    if (entries > MOST_ENTRIES * n || entries > UINT32_MAX / 2) return true;
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
    if (!order_by_extent(g)) return false;
    for (uint32_t i = 0; i < n; i++) visit(g, g->order[i], true);
    *made = true;
    return true;
}

/* ---- Sides ---- */

#define NONE UINT32_MAX

static bool holds_both(const grid *g, uint32_t part, sunder_i_point a, sunder_i_point b)
{
    const box *r = &g->reach[part];
    return is_within(g, r, a) && is_within(g, r, b) && holds(g, part, b) && holds(g, part, a);
}

/* A part that holds the segment ab; NONE if none is found. The one that held the side before is asked first, then those
 * of the square in which the middle lies, the largest first; what is found goes to the front, for what holds one side
 * holds others. */
static uint32_t find_holder(grid *g, sunder_i_point a, sunder_i_point b, uint32_t own, uint32_t hint)
{
    if (hint != NONE && holds_both(g, hint, a, b)) return hint;
    const sunder_i_point middle = {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
    const size_t q = (size_t)column(g, 1, middle.y) * g->size[0] + column(g, 0, middle.x);
    const uint32_t from = q ? g->end[q - 1] : 0, n = g->end[q] - from;
    for (uint32_t i = from; i < from + (n < LOOKS ? n : LOOKS); i++) {
        const uint32_t part = g->list[i];
        g->spent++;
        if (part == own || !holds_both(g, part, a, b)) continue;
        g->list[i] = g->list[from];
        g->list[from] = part;
        return part;
    }
    return NONE;
}

/* Looks are saved where sides are dropped; where sides are held by several parts together, not by one, that is noticed
 * soon, and the rest is left to the cells. The smallest parts come first: of features one within the other only the
 * last, which nothing holds, is looked for in vain. */
static void drop(sunder_i_convex_pieces *s, grid *g)
{
    g->allowed = SIDES_ON_TRUST * LOOKS + LOOKS_ON_TRUST * (size_t)s->n;
    for (size_t left = s->n; left-- > 0 && g->spent < g->allowed && sunder_i_step();) {
        const uint32_t i = g->order[left];
        const uint32_t first = sunder_i_convex_pieces_first(s, i), end = s->end[i];
        uint32_t holder = NONE;
        for (uint32_t k = first; k < end; k++) {
            if (!s->candidate[k]) continue;
            holder = find_holder(g, g->corner[k], g->corner[k + 1 < end ? k + 1 : first], i, holder);
            s->candidate[k] = holder == NONE;
            if (holder != NONE) g->allowed += LOOKS_SAVED;
        }
    }
}

sunder_status sunder_i_drop_contained_sides(sunder_i_convex_pieces *parts, sunder_error *err)
{
    if (parts->n == 0) return SUNDER_OK;
    grid g = {.parts = parts,
              .reach = sunder_i_alloc(parts->n, sizeof *g.reach),
              .order = sunder_i_alloc(parts->n, sizeof *g.order)};
    bool no_memory = !g.reach || !g.order, made = false;
    if (!no_memory && take_corners(&g, &no_memory)) {
        measure(&g);
        choose_squares(&g);
        no_memory = !make_lists(&g, &made);
        if (made) drop(parts, &g);
    }
    sunder_i_free(g.rounded);
    sunder_i_free(g.reach);
    sunder_i_free(g.order);
    sunder_i_free(g.end);
    sunder_i_free(g.list);
    return no_memory ? sunder_i_no_memory(err) : SUNDER_OK;
}
