/* contained_parts.c: see contained_parts.h. If many polygons are grown by one shape and overlap, most of their sides
 * are inside another part, and the cells (culling.h) would spend most of their time on those sides. If polygons nearly
 * coincide, no cell separates them, and all their sides would meet all parts along their lines. Among ragged operands,
 * one in five subsums is inside another. An open convex set contains a side if it contains both its ends, and a part if
 * it contains its corners; a grid finds the parts that may contain them. This is a filter: the cells find what it
 * misses. */
#include "outline/contained_parts.h"

#include "base/watch.h"
#include "outline/contained_grid.h"
#include "outline/tuning.h"

#include <math.h>

#define NONE UINT32_MAX

/* The number of parts tested, and its limit. */
typedef struct looks {
    size_t spent, allowed;
} looks;

typedef struct dropper {
    sunder_i_convex_pieces *parts;
    sunder_i_part_grid grid;
    looks sides, whole;
    bool *gone; /* [parts] the parts to remove; NULL: all parts are kept */
} dropper;

/* ---- Points inside a part ---- */

/* Returns cross(b - a, p - a), or 0 if its sign is uncertain. Differences are below 2^62 and rounded once each,
 * products and their difference once more: the error is below 4 ulps of the products' magnitudes. If coordinates have
 * an error e, the differences u, v have one of 2 e, and the product one of at most 2 e (|ux| + |uy| + |vx| + |vy|) + 8
 * e^2; the bound is twice that. */
static double turn_of_points(const sunder_i_part_grid *g, sunder_i_point a, sunder_i_point b, sunder_i_point p)
{
    const double ux = (double)(b.x - a.x), uy = (double)(b.y - a.y), vx = (double)(p.x - a.x), vy = (double)(p.y - a.y);
    const double s = ux * vy, t = uy * vx, c = s - t, e = (double)g->error;
    double bound = 0x1p-50 * (fabs(s) + fabs(t));
    if (g->error) bound += 4 * e * (fabs(ux) + fabs(uy) + fabs(vx) + fabs(vy)) + 16 * e * e;
    return fabs(c) > bound ? c : 0;
}

/* Returns whether p, which is inside the part's box, is certainly strictly inside the part. In the fan of triangles
 * about the first corner, the triangle that contains p is found by bisection; if p is on a diagonal, or too close to it
 * to decide, the two triangles beside it are tested. */
static bool holds_point(const sunder_i_part_grid *g, uint32_t part, sunder_i_point p)
{
    const sunder_i_convex_pieces *s = g->parts;
    const uint32_t first = sunder_i_convex_pieces_first(s, part);
    const sunder_i_point *c = g->corner + first;
    uint32_t low = 1, high = s->end[part] - first - 1;
    if (turn_of_points(g, c[0], c[low], p) <= 0 || turn_of_points(g, c[0], c[high], p) >= 0) return false;
    while (high - low > 1) {
        const uint32_t middle = (low + high) / 2;
        const double where = turn_of_points(g, c[0], c[middle], p);
        if (where == 0)
            return turn_of_points(g, c[0], c[middle - 1], p) > 0 &&
                   turn_of_points(g, c[middle - 1], c[middle], p) > 0 &&
                   turn_of_points(g, c[middle], c[middle + 1], p) > 0 && turn_of_points(g, c[middle + 1], c[0], p) > 0;
        if (where > 0)
            low = middle;
        else
            high = middle;
    }
    return turn_of_points(g, c[low], c[high], p) > 0;
}

/* ---- Sides ---- */

static bool holds_both(const sunder_i_part_grid *g, uint32_t part, sunder_i_point a, sunder_i_point b)
{
    return sunder_i_part_grid_reaches(g, part, a) && sunder_i_part_grid_reaches(g, part, b) &&
           holds_point(g, part, b) && holds_point(g, part, a);
}

/* Returns a part that contains the segment ab; NONE if none is found. The part that contained the previous side is
 * tested first, then the parts listed in the square of one end, the one with the shorter list. The part found moves to
 * the front of its list, since it probably contains other sides, too. */
static uint32_t find_holder(dropper *d, sunder_i_point a, sunder_i_point b, uint32_t own, uint32_t hint)
{
    sunder_i_part_grid *g = &d->grid;
    if (hint != NONE && holds_both(g, hint, a, b)) return hint;
    uint32_t from, from_b, n = sunder_i_part_grid_at(g, a, &from);
    const uint32_t at_b = sunder_i_part_grid_at(g, b, &from_b);
    if (at_b < n) {
        n = at_b;
        from = from_b;
    }
    for (uint32_t i = from; i < from + (n < LOOKS ? n : LOOKS); i++) {
        const uint32_t part = g->list[i];
        d->sides.spent++;
        if (part == own || !holds_both(g, part, a, b)) continue;
        g->list[i] = g->list[from];
        g->list[from] = part;
        return part;
    }
    return NONE;
}

static void drop_sides(dropper *d, uint32_t part)
{
    sunder_i_convex_pieces *s = d->parts;
    const sunder_i_point *corner = d->grid.corner;
    const uint32_t first = sunder_i_convex_pieces_first(s, part), end = s->end[part];
    uint32_t holder = NONE;
    for (uint32_t k = first; k < end; k++) {
        if (!s->candidate[k]) continue;
        holder = find_holder(d, corner[k], corner[k + 1 < end ? k + 1 : first], part, holder);
        s->candidate[k] = holder == NONE;
        if (holder != NONE) d->sides.allowed += LOOKS_SAVED;
    }
}

/* ---- Parts ---- */

static bool holds_part(const dropper *d, uint32_t part, uint32_t other)
{
    const sunder_i_convex_pieces *s = d->parts;
    if (!sunder_i_part_grid_encloses(&d->grid, part, other)) return false;
    for (uint32_t k = sunder_i_convex_pieces_first(s, other); k < s->end[other]; k++)
        if (!holds_point(&d->grid, part, d->grid.corner[k])) return false;
    return true;
}

/* Returns whether another part contains this one. Such a part is listed in the squares of all corners: the shortest of
 * these lists is searched, usually that of a corner near the outline. */
static bool is_contained(dropper *d, uint32_t part)
{
    const sunder_i_part_grid *g = &d->grid;
    uint32_t from = 0, n = UINT32_MAX;
    for (uint32_t k = sunder_i_convex_pieces_first(d->parts, part); k < d->parts->end[part]; k++) {
        uint32_t here;
        const uint32_t at_k = sunder_i_part_grid_at(g, g->corner[k], &here);
        if (at_k >= n) continue;
        n = at_k;
        from = here;
    }
    d->whole.spent += d->parts->end[part] - sunder_i_convex_pieces_first(d->parts, part);
    if (!sunder_i_steps(1 + n / 8)) return false;
    for (uint32_t i = from; i < from + n; i++) {
        d->whole.spent++;
        if (holds_part(d, g->list[i], part)) return true;
    }
    return false;
}

/* Drops parts and sides. A dropped part increases the limit of further tests; sides that several parts cover together,
 * but none alone, soon exhaust it, and the rest is left to the cells. The smallest parts come first: among nested
 * features only the outermost, which no part contains, is then searched in vain. Parts that are dropped may still
 * contain others: what is inside one of them is also inside the part that contains it. */
static void drop_sides_and_parts(dropper *d)
{
    sunder_i_convex_pieces *s = d->parts;
    d->sides.allowed = SIDES_ON_TRUST * LOOKS + LOOKS_ON_TRUST * (size_t)s->n;
    d->whole.allowed = PART_LOOKS_ON_TRUST * (size_t)s->n;
    for (size_t left = s->n; left-- > 0 && sunder_i_step();) {
        const uint32_t i = d->grid.order[left];
        const bool whole = d->gone && d->whole.spent < d->whole.allowed, sides = d->sides.spent < d->sides.allowed;
        if (!whole && !sides) return;
        if (whole && is_contained(d, i)) {
            d->gone[i] = true;
            d->whole.allowed += PART_LOOKS_SAVED * (s->end[i] - sunder_i_convex_pieces_first(s, i));
        } else if (sides) {
            drop_sides(d, i);
        }
    }
}

static sunder_status drop_contained(sunder_i_convex_pieces *parts, bool whole, sunder_error *err)
{
    if (parts->n == 0) return SUNDER_OK;
    dropper d = {.parts = parts};
    bool ok = sunder_i_part_grid_build(&d.grid, parts);
    if (ok && d.grid.list) {
        d.gone = whole ? sunder_i_calloc(parts->n, sizeof *d.gone) : NULL;
        ok = d.gone || !whole;
        if (ok) drop_sides_and_parts(&d);
        if (d.gone) sunder_i_convex_pieces_remove(parts, d.gone);
    }
    sunder_i_free(d.gone);
    sunder_i_part_grid_free(&d.grid);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_drop_contained(sunder_i_convex_pieces *parts, sunder_error *err)
{
    return drop_contained(parts, true, err);
}

sunder_status sunder_i_drop_contained_sides(sunder_i_convex_pieces *parts, sunder_error *err)
{
    return drop_contained(parts, false, err);
}
