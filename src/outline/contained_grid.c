/* contained_grid.c: see contained_grid.h. Corners in units of the grid, boxes of parts, and the lists of the
 * squares. */
#include "outline/contained_grid.h"

#include "base/extremes.h"
#include "base/sort.h"
#include "outline/tuning.h"

#include <math.h>

typedef sunder_i_part_grid grid;
typedef sunder_i_part_box box;

/* Sets the corners in units of the grid. sunder_i_approx() has an error of half an ulp of the largest coordinate, that
 * is, 2^-53 of it; the largest one is below 2^60 units here, so that the error is 2^7 units, and rounding adds half a
 * unit. Returns false if out of memory (*no_memory), or if all coordinates are so small that doubles underflow. */
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

static void measure_parts(grid *g)
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

/* Sorts the parts by size. Boxes are used instead of the parts: an error in the order costs time only. */
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

/* Chooses the size of the squares: their width is a power of two between a quarter and half of the mean width of a
 * part, or a greater one if there would be more than MOST_SQUARES squares for each part. */
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

/* Visits the squares that a part's box meets: counts the part in g->end[] or, with `fill`, writes it to their lists. */
static void visit_cells(grid *g, uint32_t part, bool fill)
{
    const box *b = &g->reach[part];
    for (uint32_t y = sunder_i_part_grid_column(g, 1, b->low[1]); y <= sunder_i_part_grid_column(g, 1, b->high[1]); y++)
        for (uint32_t x = sunder_i_part_grid_column(g, 0, b->low[0]); x <= sunder_i_part_grid_column(g, 0, b->high[0]);
             x++) {
            uint32_t *end = &g->end[(size_t)y * g->size[0] + x];
            if (fill) g->list[*end] = part;
            ++*end;
        }
}

/* Builds the lists of the squares: a part has an entry in every square that its box meets. If a few parts are far
 * larger than the others the lists would need too much memory, and are not built. Returns false if out of memory. */
static bool make_lists(grid *g)
{
    const uint32_t n = (uint32_t)g->parts->n;
    const size_t squares = (size_t)g->size[0] * g->size[1];
    double entries = 0;
    for (uint32_t i = 0; i < n; i++) {
        const box *b = &g->reach[i];
        entries +=
            (double)(sunder_i_part_grid_column(g, 0, b->high[0]) - sunder_i_part_grid_column(g, 0, b->low[0]) + 1) *
            (double)(sunder_i_part_grid_column(g, 1, b->high[1]) - sunder_i_part_grid_column(g, 1, b->low[1]) + 1);
    }
    if (entries > MOST_ENTRIES * n || entries > UINT32_MAX / 2) return true;
    g->end = sunder_i_calloc(squares, sizeof *g->end);
    g->list = sunder_i_alloc((size_t)entries, sizeof *g->list);
    if (!g->end || !g->list) return false;
    for (uint32_t i = 0; i < n; i++) visit_cells(g, i, false);
    uint32_t sum = 0;
    for (size_t q = 0; q < squares; q++) {
        const uint32_t count = g->end[q];
        g->end[q] = sum; /* the position of the next entry; finally the end */
        sum += count;
    }
    if (!order_by_extent(g)) return false;
    for (uint32_t i = 0; i < n; i++) visit_cells(g, g->order[i], true);
    return true;
}

bool sunder_i_part_grid_build(grid *g, const sunder_i_convex_pieces *parts)
{
    bool no_memory = false;
    *g = (grid){.parts = parts,
                .reach = sunder_i_alloc(parts->n, sizeof *g->reach),
                .order = sunder_i_alloc(parts->n, sizeof *g->order)};
    if (!g->reach || !g->order) return false;
    if (!take_corners(g, &no_memory)) return !no_memory;
    measure_parts(g);
    choose_squares(g);
    return make_lists(g);
}

void sunder_i_part_grid_free(grid *g) { sunder_i_free_all(g->rounded, g->reach, g->order, g->end, g->list); }
