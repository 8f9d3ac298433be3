/* measure.c: counts, box and area of a shape; its anchor is in anchor.c.
 *
 * sunder_shape_area() cannot fail, so it allocates nothing: if coordinates are doubles, the area is a sum of products
 * of doubles in fixed memory. That of a rational shape, whose numbers have no bound, is computed when it is made
 * (measure_rational.c). */
#include "shape/shape.h"

#include "number/accumulator.h"

#include <string.h>

size_t sunder_shape_polygons(const sunder_shape *shape) { return shape->form->cleaned.polygons; }
size_t sunder_shape_vertices(const sunder_shape *shape) { return shape->vertices; }
bool sunder_shape_is_empty(const sunder_shape *shape) { return shape->form->cleaned.polygons == 0; }
bool sunder_shape_repaired(const sunder_shape *shape) { return shape->repaired; }

bool sunder_shape_touches(const sunder_shape *shape) { return shape->touches; }
void sunder_shape_box(const sunder_shape *shape, double box[4]) { memcpy(box, shape->box, sizeof shape->box); }

/* Rings have the interior on their left, so that the sum of their signed areas is that of the polygons. */
double sunder_shape_area(const sunder_shape *shape)
{
    if (shape->rational) return shape->form->numbers->area;
    sunder_i_accumulator twice = {{0}};
    for (uint32_t i = 0; i < shape->vertices; i++) {
        const double *a = shape->xy + 2 * (size_t)i, *b = shape->xy + 2 * (size_t)shape->form->cleaned.next[i];
        sunder_i_accumulator_add(&twice, a[0], b[1]);
        sunder_i_accumulator_sub(&twice, a[1], b[0]);
    }
    return sunder_i_accumulator_double(&twice, -1);
}
