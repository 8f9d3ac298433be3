/* The largest disc in a shape, in doubles.
 *
 * The distance f(x) from a point inside of the shape to its boundary, negative outside of it, changes by no more than
 * the point moves. So in a square of half diagonal r around x it is at most f(x) + r. Squares are divided into four,
 * all of a size at a time, and those that cannot hold a better point are dropped, until a square holds hardly more than
 * its centre does. */
#include "displacement/levels/levels.h"

#include "base/extremes.h"

#include <math.h>

/* Squares are divided this many times at most: the radius is found up to 2^-DIVISIONS of the box. */
enum { DIVISIONS = 10 };
#define MOST_SQUARES 65536u

typedef struct square {
    double at[2], distance;
} square;

/* The squares of one size. */
typedef struct squares {
    square *item;
    size_t n, room;
} squares;

/* The distance from p to the boundary, negative outside of the shape by the even-odd rule. */
static double distance_inside(const sunder_shape *shape, const double p[2])
{
    double least = INFINITY;
    bool inside = false;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        const double *a = shape->xy + 2 * (size_t)v, *b = shape->xy + 2 * (size_t)shape->form->cleaned.next[v];
        const double u[2] = {b[0] - a[0], b[1] - a[1]}, w[2] = {p[0] - a[0], p[1] - a[1]};
        const double t = (u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1]);
        const double on = sunder_i_max(0, sunder_i_min(1, t)), off[2] = {w[0] - on * u[0], w[1] - on * u[1]};
        least = sunder_i_min(least, off[0] * off[0] + off[1] * off[1]);
        if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + u[0] * (w[1] / u[1])) inside = !inside;
    }
    return inside ? sqrt(least) : -sqrt(least);
}

static bool add_square(squares *list, const sunder_shape *shape, double x, double y)
{
    if (!sunder_i_reserve(&list->item, &list->room, list->n + 1, sizeof *list->item)) return false;
    square *s = &list->item[list->n++];
    *s = (square){.at = {x, y}};
    s->distance = distance_inside(shape, s->at);
    return true;
}

static void take_best(const squares *list, square *best)
{
    for (size_t k = 0; k < list->n; k++)
        if (list->item[k].distance > best->distance) *best = list->item[k];
}

/* Divides those squares of half side h that may hold a point better than `best` by more than `enough`. */
static bool divide_squares(const squares *from, const sunder_shape *shape, double h, const square *best, double enough,
                           squares *to)
{
    bool ok = true;
    to->n = 0;
    for (size_t k = 0; k < from->n && ok; k++) {
        const square *s = &from->item[k];
        if (s->distance + h * sqrt(2) <= best->distance + enough) continue;
        for (int q = 0; q < 4 && ok; q++)
            ok = add_square(to, shape, s->at[0] + (q & 1 ? h / 2 : -h / 2), s->at[1] + (q & 2 ? h / 2 : -h / 2));
    }
    return ok;
}

sunder_status sunder_shape_largest_disc(const sunder_shape *shape, double centre[2], double *radius, sunder_error *err)
{
    squares list[2] = {{0}, {0}};
    double box[4];
    centre[0] = centre[1] = *radius = 0;
    if (!shape || sunder_shape_is_empty(shape)) return SUNDER_OK;
    sunder_shape_box(shape, box);
    const double w = box[2] - box[0], d = box[3] - box[1], size = sunder_i_min(w, d);
    const size_t nx = (size_t)ceil(sunder_i_min(w / size, 256)), ny = (size_t)ceil(sunder_i_min(d / size, 256));
    double h = sunder_i_max(w / (double)nx, d / (double)ny) / 2;
    square best = {.distance = -INFINITY};
    bool ok = true;
    for (size_t k = 0; k < nx * ny && ok; k++)
        ok = add_square(&list[0], shape, box[0] + h * (double)(2 * (k % nx) + 1),
                        box[1] + h * (double)(2 * (k / nx) + 1));
    for (int k = 0; ok && list[k & 1].n && k < DIVISIONS && list[k & 1].n < MOST_SQUARES; k++, h /= 2) {
        take_best(&list[k & 1], &best);
        ok = divide_squares(&list[k & 1], shape, h, &best, size * ldexp(1, -DIVISIONS), &list[!(k & 1)]);
    }
    for (int k = 0; k < 2 && ok; k++) take_best(&list[k], &best);
    for (int c = 0; c < 2 && ok; c++) centre[c] = best.at[c];
    if (ok) *radius = sunder_i_max(0, best.distance);
    sunder_i_free_all(list[0].item, list[1].item);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
