/* point_in_shape.c: is a point inside a shape, on its boundary, or outside? */
#include "sunder_shape.h"

/* The position of a point relative to one polygon, as of sunder_shape_locate(). By the even-odd rule: the ray from the
 * point in the direction of x crosses an edge whose ends lie on different sides of the ray's line if the point lies on
 * the left of the edge directed upwards. An end on the line counts as below it, so that a vertex on the ray counts
 * once. */
static int locate_in_polygon(const double *xy, const size_t *ring_end, size_t ring, size_t end, const sunder_point *at)
{
    bool inside = false;
    for (size_t first = ring ? ring_end[ring - 1] : 0; ring < end; first = ring_end[ring++])
        for (size_t i = first; i < ring_end[ring]; i++) {
            const size_t j = i + 1 < ring_end[ring] ? i + 1 : first;
            const sunder_point a = {xy[2 * i], xy[2 * i + 1]}, b = {xy[2 * j], xy[2 * j + 1]};
            const bool up = a.y <= at->y && b.y > at->y, down = b.y <= at->y && a.y > at->y;
            if ((a.y == at->y && a.x == at->x) || (a.y == at->y && b.y == at->y && (a.x < at->x) != (b.x < at->x)))
                return 0;
            if (!up && !down) continue;
            const int side = sunder_orient(up ? &a : &b, up ? &b : &a, at);
            if (side == 0) return 0;
            inside ^= side > 0;
        }
    return inside ? 1 : -1;
}

int sunder_shape_locate(const sunder_shape *shape, const sunder_point *at)
{
    const double *xy;
    const size_t *ring_end, *poly_end, n = sunder_shape_given(shape, &xy, &ring_end, &poly_end);
    double box[4];
    int found = -1;
    sunder_shape_box(shape, box); /* spikes of an invalid ring may lie outside */
    if (!sunder_shape_repaired(shape) && !(at->x >= box[0] && at->y >= box[1] && at->x <= box[2] && at->y <= box[3]))
        return -1;
    for (size_t p = 0; p < n && found < 1; p++) {
        const int side = locate_in_polygon(xy, ring_end, p ? poly_end[p - 1] : 0, poly_end[p], at);
        if (side > found) found = side;
    }
    return found;
}
