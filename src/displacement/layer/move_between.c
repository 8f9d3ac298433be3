/* Finds the move that took a shape from one place to another, if it is a translate whose vertices were rounded to
 * doubles.
 *
 * If some t makes every sum x + t exact, it is the move: no vertex was rounded. This t is tried first, since a shorter
 * t that rounds to the same vertices would hide a rule broken by a unit in the last place. If sums were rounded, each
 * vertex allows an interval of doubles t, since the rounded sum never decreases as t grows. The move is the shortest t
 * that all vertices allow, so that rounding alone never counts as a broken rule. */
#include "displacement/layer/rounding.h"

#include "shape/shape.h"

#include <math.h>
#include <stdint.h>
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

/* The same for their cleaned forms. */
static bool same_cleaned_rings(const sunder_shape *p, const sunder_shape *q)
{
    const sunder_i_cleaned *a = &p->form->cleaned, *b = &q->form->cleaned;
    return p->vertices == q->vertices && a->rings == b->rings && a->polygons == b->polygons &&
           memcmp(a->ring_end, b->ring_end, a->rings * sizeof *a->ring_end) == 0 &&
           memcmp(a->poly_end, b->poly_end, a->polygons * sizeof *a->poly_end) == 0;
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

/* The r-th double above zero, or below it for a negative r. */
static double double_of_rank(int64_t r)
{
    const int64_t bits = r < 0 ? INT64_MIN - r : r;
    double t;
    memcpy(&t, &bits, sizeof t);
    return t;
}

/* Returns the least double t with x + t >= y in doubles, by bisection; infinity if there is none. */
static double least_to_reach(double x, double y)
{
    const double infinity = INFINITY;
    int64_t low, high;
    memcpy(&high, &infinity, sizeof high);
    for (low = -high; high - 1 > low;) {
        const int64_t middle = low / 2 + high / 2 + (low % 2 + high % 2) / 2;
        if (x + double_of_rank(middle) >= y)
            high = middle;
        else
            low = middle;
    }
    return double_of_rank(high);
}

/* Returns the least t that takes each coordinate to its new place or beyond; after a reflection if sign is -1. */
static double least_move(const coordinates *k, double sign)
{
    double t = -INFINITY;
    for (size_t v = 0; v < k->n; v++) {
        const double x = sign * k->before[2 * v + k->c], y = sign * k->after[2 * v + k->c];
        if (!(x + t >= y)) t = least_to_reach(x, y);
    }
    return t;
}

static bool find_along(const coordinates *k, double *t)
{
    *t = 0;
    if (is_move(k, 0)) return true;
    *t = k->after[k->c] - k->before[k->c];
    if (is_exact_move(k, *t)) return true;
    const double low = least_move(k, 1), high = -least_move(k, -1);
    *t = low > 0 ? low : high;
    return low <= high && isfinite(*t);
}

static bool find_move(const double *before, const double *after, size_t n, double t[2])
{
    coordinates k = {before, after, n, 0};
    for (; k.c < 2; k.c++)
        if (!find_along(&k, &t[k.c])) return false;
    return true;
}

bool sunder_i_move_between(const sunder_shape *before, const sunder_shape *after, double t[2])
{
    t[0] = t[1] = 0;
    if (!same_rings(before, after)) return false;
    return find_move(before->raw_xy, after->raw_xy, sunder_i_shape_raw_vertices(before), t);
}

bool sunder_i_move_between_sets(const sunder_shape *before, const sunder_shape *after, double t[2])
{
    t[0] = t[1] = 0;
    return same_cleaned_rings(before, after) && !before->rational && !after->rational &&
           find_move(before->xy, after->xy, before->vertices, t);
}
