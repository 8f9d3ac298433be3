/* culling_root.c: the start: sides as doubles, and the lists of the root cell. */
#include "outline/culling_inner.h"

#include "base/sort.h"
#include "base/watch.h"
#include "outline/tuning.h"
#include "predicate/predicate.h"

/* Allocates the large arrays as one block with unused space: glibc keeps up to twice the largest block freed so far,
 * and so keeps all memory of one sum for the next one, instead of returning it and fetching it again page by page.
 * Returns false if out of memory. */
static bool make_room(builder *b)
{
    const sunder_i_convex_pieces *s = b->parts;
    const size_t bytes = s->corners * (sizeof *b->side + sizeof *b->crossing) + s->n * sizeof *b->reach;
    b->side = sunder_i_alloc(bytes + bytes / 2, 1);
    if (!b->side) return false;
    b->crossing = (crossing *)(void *)(b->side + s->corners);
    b->reach = (box *)(void *)(b->crossing + s->corners);
    b->before = sunder_i_alloc(s->corners + 1, sizeof *b->before);
    if (!b->before) return false;
    uint32_t n = 0;
    for (size_t k = 0; k < s->corners; k++) {
        b->before[k] = n;
        n += b->lines->of[k] != SUNDER_I_NO_LINE;
    }
    b->before[s->corners] = n;
    return true;
}

/* Computes the doubles of all sides, the boxes of the parts, and the box of all. Returns false if out of memory.
 * Vectors are computed from exact differences, so that their error is relative to their length. */
static bool approximate_corners(builder *b, box *all)
{
    const sunder_i_convex_pieces *s = b->parts;
    sunder_i_lattice *l = s->lattice;
    double most = 0;
    *all = nothing;
    const bool narrow = l->narrow;
    for (size_t i = 0; i < s->n; i++) {
        const uint32_t first = sunder_i_convex_pieces_first(s, i), end = s->end[i];
        if (!sunder_i_step()) return false;
        box own = nothing;
        for (uint32_t k = first; k < end; k++) {
            const sunder_i_point from = s->corner[k], to = s->corner[k + 1 < end ? k + 1 : first];
            const double x = narrow ? (double)from.x : sunder_i_approx(l, from.x);
            const double y = narrow ? (double)from.y : sunder_i_approx(l, from.y);
            double dx, dy;
            if (narrow) {
                dx = (double)(to.x - from.x);
                dy = (double)(to.y - from.y);
            } else {
                sunder_i_point_difference(l, to, from, &dx, &dy);
            }
            b->side[k] = (approx_side){x, y, dx, dy};
            own.low[0] = sunder_i_lesser(own.low[0], x);
            own.high[0] = sunder_i_greater(own.high[0], x);
            own.low[1] = sunder_i_lesser(own.low[1], y);
            own.high[1] = sunder_i_greater(own.high[1], y);
            most = sunder_i_greater(most, sunder_i_greater(fabs(x), fabs(y)));
        }
        b->reach[i] = own;
        grow_box(all, &own);
    }
    /* With u = 2^-53 and all coordinates and box corners within `most` (cells are within the box of all): the start
     * point has an error of 2u * most (conversion), differences of coordinates as much again, products and their
     * difference 3u of products up to 2 * most * |d|. The sum is below 16 u * most * (|dx| + |dy|); the bound is twice
     * that. Underflow: approx_shift keeps the largest coordinates near 2^500; SUNDER_I_APPROX_UNDERFLOW allows for what
     * underflows beside them. */
    b->error = 0x1p-48 * most + 0x1p-900;
    b->out->most = most;
    /* a candidate exactly on the boundary must not be missed */
    widen_box(all, b->error);
    for (size_t i = 0; i < s->n; i++) widen_box(&b->reach[i], b->error);
    return !l->arena.failed;
}

/* Returns approximately twice the area of a part. */
static double extent_of(const builder *b, size_t part)
{
    const uint32_t first = sunder_i_convex_pieces_first(b->parts, part);
    const approx_side *o = &b->side[first];
    double area = 0;
    for (uint32_t k = first; k < b->parts->end[part]; k++) {
        const approx_side *s = &b->side[k];
        area += (s->ax - o->ax) * s->dy - (s->ay - o->ay) * s->dx;
    }
    return area;
}

static bool one_quadrant(const approx_side *s, const approx_side *t)
{
    return (s->dx > 0) == (t->dx > 0) && (s->dy > 0) == (t->dy > 0) && (s->dx < 0) == (t->dx < 0) &&
           (s->dy < 0) == (t->dy < 0);
}

/* Lists the sides of a part as runs; as single sides if it has few, which takes less time. */
static void add_runs(builder *b, uint32_t part)
{
    const uint32_t first = sunder_i_convex_pieces_first(b->parts, part), end = b->parts->end[part];
    const uint32_t longest = end - first < FEW_SIDES || b->single_most == UINT32_MAX ? 1 : LONGEST_RUN;
    const size_t before = b->runs_n;
    for (uint32_t k = first; k < end;) {
        uint32_t n = 1;
        while (n < longest && k + n < end && one_quadrant(&b->side[k], &b->side[k + n])) n++;
        b->runs[b->runs_n++] = n > 1 ? (n - 1) << RUN_BITS | k : k;
        k += n;
    }
    b->entries[b->entries_n++] = (entry){part, (uint32_t)(b->runs_n - before)};
}

/* Makes the root cell with every side of every part, the largest parts first, since these close cells. Returns false if
 * out of memory. */
static bool list_all(builder *b, const box *all, cell *root)
{
    const sunder_i_convex_pieces *s = b->parts;
    double *extent = sunder_i_alloc(s->n, sizeof *extent);
    uint32_t *order = sunder_i_alloc(s->n, sizeof *order);
    /* with room for both halves, which are written after them (reserve_halves()) */
    bool ok = extent && order && sunder_i_reserve(&b->entries, &b->entries_capacity, 3 * s->n, sizeof *b->entries) &&
              sunder_i_reserve(&b->runs, &b->runs_capacity, 3 * s->corners + 2, sizeof *b->runs);
    for (uint32_t i = 0; ok && i < s->n; i++) {
        order[i] = i;
        extent[i] = extent_of(b, i);
    }
    ok = ok && sunder_i_sort_indices(order, s->n, sunder_i_descending, extent);
    for (size_t i = 0; ok && i < s->n; i++) {
        add_runs(b, order[i]);
        ok = sunder_i_step();
    }
    *root = (cell){*all, 0, b->entries_n, 0, b->runs_n, s->corners, 0, 0, 1, 1, 0};
    root->axis = all->high[1] - all->low[1] > all->high[0] - all->low[0];
    sunder_i_free_all(extent, order);
    return ok;
}

bool sunder_i_cells_root(builder *b, cell *root)
{
    box all;
    return make_room(b) && approximate_corners(b, &all) && list_all(b, &all, root);
}
