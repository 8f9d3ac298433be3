/* Finds the move that took a shape from one place to another, if it is a translate whose vertices were rounded to
 * doubles.
 *
 * If some t makes every sum x + t exact, it is the move: no vertex was rounded. This t is tried first, since a shorter
 * t that rounds to the same vertices would hide a rule broken by a unit in the last place. If sums were rounded, each
 * vertex allows an interval of t, about as wide as a unit in the last place of x + t. Candidates are the ends and the
 * middle of the common interval of all vertices, and the difference at the vertex with the smallest unit. The shortest
 * candidate that fits is the move, so that rounding alone never counts as a broken rule. Each candidate is tested at
 * every vertex. */
#include "displacement/layer/rounding.h"

#include "shape/shape.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

/* Do the two shapes have the same numbers of polygons, rings and vertices? */
static bool same_rings(const sunder_shape *p, const sunder_shape *q)
{
    if (p->form->given.polygons != q->form->given.polygons) return false;
    if (p->form->given.polygons == 0) return true;
    const size_t rings = p->form->given.poly_end[p->form->given.polygons - 1];
    return memcmp(p->form->given.poly_end, q->form->given.poly_end,
                  p->form->given.polygons * sizeof *p->form->given.poly_end) == 0 &&
           memcmp(p->form->given.ring_end, q->form->given.ring_end, rings * sizeof *p->form->given.ring_end) == 0;
}

/* Coordinate c of each of the n vertices, before and after the move. */
typedef struct coordinates {
    const double *before, *after;
    size_t n, c;
} coordinates;

static bool is_move(const coordinates *k, double t)
{
    for (size_t v = 0; v < k->n; v++)
        if (k->before[2 * v + k->c] + t != k->after[2 * v + k->c]) return false;
    return isfinite(t);
}

/* Is the difference the same at each vertex, and no sum rounded? The rounding error of x + t is that of [She96],
 * theorem 7 (two-sum): 0 exactly if the sum is exact. */
static bool is_exact_move(const coordinates *k, double t)
{
    if (!is_move(k, t)) return false;
    for (size_t v = 0; v < k->n; v++) {
        const double x = k->before[2 * v + k->c], sum = k->after[2 * v + k->c], part = sum - x;
        if ((x - (sum - part)) + (t - part) != 0) return false;
    }
    return true;
}

/* Sets [*low, *high] approximately to the moves that all vertices allow: a sum is rounded to x' if it is within half a
 * unit of x'. *finest is the difference at the vertex with the smallest coordinates. */
static void find_common(const coordinates *k, double *low, double *high, double *finest)
{
    double least = INFINITY;
    *low = -INFINITY;
    *high = INFINITY;
    *finest = 0;
    for (size_t v = 0; v < k->n; v++) {
        const double x = k->before[2 * v + k->c], y = k->after[2 * v + k->c], size = sunder_i_max(fabs(x), fabs(y));
        *low = sunder_i_max(*low, (y - x) - (y - nextafter(y, -INFINITY)) / 2);
        *high = sunder_i_min(*high, (y - x) + (nextafter(y, INFINITY) - y) / 2);
        if (!(size < least)) continue;
        least = size;
        *finest = y - x;
    }
}

static bool find_along(const coordinates *k, double *t)
{
    double low, high, finest;
    *t = 0;
    if (is_move(k, 0)) return true;
    find_common(k, &low, &high, &finest);
    if (is_exact_move(k, finest)) {
        *t = finest;
        return true;
    }
    const double near = fabs(low) < fabs(high) ? low : high, far = near == low ? high : low;
    const double tried[] = {near, nextafter(near, far), finest, low + (high - low) / 2, nextafter(far, near), far};
    bool found = false;
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        if (!is_move(k, tried[i]) || (found && fabs(tried[i]) >= fabs(*t))) continue;
        *t = tried[i];
        found = true;
    }
    return found;
}

bool sunder_i_move_between(const sunder_shape *before, const sunder_shape *after, double t[2])
{
    t[0] = t[1] = 0;
    if (!same_rings(before, after)) return false;
    coordinates k = {before->raw_xy, after->raw_xy, sunder_i_shape_raw_vertices(before), 0};
    for (; k.c < 2; k.c++)
        if (!find_along(&k, &t[k.c])) return false;
    return true;
}
