/* The corners of a shape, for those who draw it. */
#include "shape/shape.h"

size_t sunder_shape_rings(const sunder_shape *shape, size_t polygon)
{
    return shape->poly_end[polygon] - (polygon ? shape->poly_end[polygon - 1] : 0);
}

const double *sunder_shape_ring(const sunder_shape *shape, size_t polygon, size_t ring, size_t *n)
{
    const size_t r = (polygon ? shape->poly_end[polygon - 1] : 0) + ring;
    const size_t begin = r ? shape->ring_end[r - 1] : 0;
    *n = shape->ring_end[r] - begin;
    return shape->xy + 2 * begin;
}
