/* turned_shape.c: the main direction of buildings, and the shape turned to it.
 *
 * Directions of walls are taken modulo a right angle: a side of length L and angle a is represented by the vector L
 * (cos 4a, sin 4a), and a quarter of the angle of the sum of these vectors is the main direction, in (-45, 45] degrees.
 * The shape is turned about the origin and its vertices are rounded to doubles. This rounding only chooses the shape;
 * the operation with that shape is exact. Vertices that it leaves in straight walls are removed at the end
 * (geometry/round/straight.c). */
#include "buffer/buffer.h"

#include "base/core_error.h"

#include <math.h>

static void add_sides(const sunder_shape *shape, double sum[2])
{
    for (size_t p = 0; p < sunder_shape_polygons(shape); p++)
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
            size_t n;
            const double *xy = sunder_shape_ring(shape, p, r, &n);
            for (size_t i = 0; i < n; i++) {
                const double *a = xy + 2 * i, *b = xy + 2 * (i + 1 < n ? i + 1 : 0);
                double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
                if (!(length > 0) || !isfinite(length)) continue;
                double c = dx / length, s = dy / length, c2 = c * c - s * s, s2 = 2 * c * s;
                sum[0] += length * (c2 * c2 - s2 * s2);
                sum[1] += length * 2 * c2 * s2;
            }
        }
}

static bool turn_shape(const sunder_shape *shape, double angle, gis_polygons *out, gis_error *error)
{
    double c = cos(angle), s = sin(angle);
    if (!gis_polygons_append_shape(out, shape, 0, 0, error)) return false;
    for (size_t v = 0; v < out->vertices; v++) {
        double *xy = out->xy + 2 * v, x = xy[0], y = xy[1];
        xy[0] = c * x - s * y;
        xy[1] = s * x + c * y;
    }
    return true;
}

bool gis_buffer_turned(const gis_buffer *buffer, const gis_buffer_set *set, sunder_shape **out, gis_error *error)
{
    double sum[2] = {0, 0};
    for (size_t i = 0; i < set->members; i++)
        if (buffer->input.shape[set->member[i]]) add_sides(buffer->input.shape[set->member[i]], sum);
    gis_polygons turned = {0};
    sunder_error why;
    bool ok = turn_shape(buffer->shape, atan2(sum[1], sum[0]) / 4, &turned, error) &&
              (gis_polygons_shape(&turned, SUNDER_VALIDITY_EVEN_ODD, out, &why) == SUNDER_OK ||
               gis_core_failed(error, "--shape, turned", &why));
    gis_polygons_clear(&turned);
    return ok;
}
