/* Members may touch and overlap, and their union is meant: where two share a wall, the wall is inside. Their pieces
 * leave it out, though, and a segment or a point, which has no area, would pass along it. So the union is taken first.
 * Its corners are the members' own, unless members cross. */
#include "motion/whole.h"

#include "shape/shape.h"
#include "sum/to_shape.h"

sunder_status sunder_i_whole(const sunder_shape *shape, sunder_shape **out, sunder_error *err)
{
    *out = NULL;
    if (shape->polygons < 2) return SUNDER_OK;
    sunder_sum *sum;
    sunder_status status = sunder_shape_union(shape, NULL, &sum, err);
    if (status != SUNDER_OK) return status;
    status = sunder_i_sum_to_shape(sum, true, SUNDER_VALIDITY_STRICT, out, err);
    sunder_sum_free(sum);
    return status;
}
