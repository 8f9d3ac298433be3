/* The directions of walls, as vectors at four times their angle.
 *
 * Only sums, products and square roots are used, which are rounded in the same way on every machine, and a wall gives
 * the same numbers in both directions. So the direction of a shape does not depend on how its rings are written. */
#include "displacement/rows/row_limits.h"
#include "displacement/rows/row_pairs.h"

#include "base/watch.h"
#include "shape/shape.h"

#include <math.h>

static double length_of(const double v[2]) { return sqrt(v[0] * v[0] + v[1] * v[1]); }

void sunder_i_walls_add(const sunder_shape *shape, sunder_i_walls *walls)
{
    const uint32_t *next = shape->form->cleaned.next;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        const double *from = shape->xy + 2 * (size_t)v, *to = shape->xy + 2 * (size_t)next[v];
        const double d[2] = {to[0] - from[0], to[1] - from[1]}, length = length_of(d);
        if (!(length > 0)) continue; /* corners that are not doubles may be rounded to the same place */
        const double x = d[0] / length, y = d[1] / length;
        const double cosine = x * x - y * y, sine = 2 * x * y; /* of twice the angle */
        walls->direction[0] += length * (cosine * cosine - sine * sine);
        walls->direction[1] += length * (2 * cosine * sine);
        walls->length += length;
    }
}

bool sunder_i_rows_measure_walls(const sunder_i_model *model, sunder_i_walls *walls)
{
    for (size_t f = 0; f < model->features; f++) {
        if (!sunder_i_step()) return false;
        if (model->present[f]) sunder_i_walls_add(sunder_i_thing_shape(model, f), &walls[f]);
    }
    return true;
}

/* Replaces a unit vector by the one at half its angle, between -90 and 90 degrees. */
static void halve(double unit[2])
{
    const double cosine = unit[0], sine = unit[1];
    /* The greater coordinate is computed without cancellation, and gives the other. */
    if (cosine > 0) {
        unit[0] = sqrt((1 + cosine) / 2);
        unit[1] = sine / (2 * unit[0]);
    } else {
        unit[1] = copysign(sqrt((1 - cosine) / 2), sine);
        unit[0] = fabs(sine / (2 * unit[1]));
    }
}

void sunder_i_walls_axis(const sunder_i_walls *walls, double along[2])
{
    const double length = length_of(walls->direction);
    along[0] = walls->direction[0] / length;
    along[1] = walls->direction[1] / length;
    halve(along);
    halve(along);
}

bool sunder_i_walls_mean(const sunder_i_walls *a, const sunder_i_walls *b, sunder_i_walls *mean)
{
    const double p = length_of(a->direction), q = length_of(b->direction);
    if (!(p > ROW_STRAIGHT * a->length) || !(q > ROW_STRAIGHT * b->length)) return false;
    const double u[2] = {a->direction[0] / p, a->direction[1] / p}, v[2] = {b->direction[0] / q, b->direction[1] / q};
    *mean = (sunder_i_walls){{u[0] + v[0], u[1] + v[1]}, 2};
    return u[0] * v[0] + u[1] * v[1] >= ROW_ANGLE;
}
