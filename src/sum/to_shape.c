/* to_shape.c: converts a sum to a shape: its rings have the layout from which a shape is made, so that only vertices
 * are rounded. Rounded rings may cross; `validity` determines what happens then. */
#include "sum/to_shape.h"

sunder_status sunder_i_sum_to_shape(const sunder_sum *sum, bool exact, sunder_validity validity, sunder_shape **out,
                                    sunder_error *err)
{
    const size_t corners = sum->rings ? sum->ring_end[sum->rings - 1] : 0;
    double *xy = sunder_i_alloc(2 * corners, sizeof *xy), off = 0;
    sunder_status status =
        xy ? sunder_sum_vertices(sum, sum->ring_vertex, corners, xy, &off, err) : sunder_i_failure_cause(err);
    if (status == SUNDER_OK && (!exact || off == 0))
        status = sunder_shape_from_rings(xy, sum->ring_end, sum->poly_end, sum->polygons, validity, out, err);
    sunder_i_free(xy);
    return status;
}
