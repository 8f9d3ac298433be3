/* A detached building is cut along its own walls where that costs hardly more.
 *
 * A slanted road leaves a slanted front. Instead, one straight cut along the longest wall, or across it, may take off
 * all that is nearer to barriers than it has to be. Of the four such cuts, one for each side, that which keeps most is
 * taken, if it takes off at most a tenth more area. What it leaves lies in what the zones leave, exactly. */
#include "displacement/levels/levels.h"

#include "base/extremes.h"

#include <math.h>

/* The area that a cut along a wall may take off, as a multiple of what has to be taken off. */
#define MOST_AREA 1.1

static bool has_corner(const sunder_shape *shape, const double at[2])
{
    for (uint32_t v = 0; v < shape->vertices; v++)
        if (shape->xy[2 * (size_t)v] == at[0] && shape->xy[2 * (size_t)v + 1] == at[1]) return true;
    return false;
}

/* Returns the least n.(x - from) of the corners of one shape that the other does not have. */
static double least_of_others(const sunder_shape *shape, const sunder_shape *other, const double n[2],
                              const double from[2])
{
    double least = INFINITY;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        const double *at = shape->xy + 2 * (size_t)v;
        if (!has_corner(other, at)) least = sunder_i_min(least, n[0] * (at[0] - from[0]) + n[1] * (at[1] - from[1]));
    }
    return least;
}

/* Cuts off what is beyond the line n.x = c, such that everything that `trimmed` lacks is. */
static sunder_status cut_beyond(const sunder_shape *shape, const sunder_shape *trimmed, const double n[2],
                                double margin, sunder_shape **out, sunder_error *err)
{
    double box[4], middle[2], xy[8];
    size_t end = 4;
    sunder_shape_box(shape, box);
    const double far = 2 * hypot(box[2] - box[0], box[3] - box[1]);
    for (int c = 0; c < 2; c++) middle[c] = box[c] + (box[c + 2] - box[c]) / 2;
    const double at =
        sunder_i_min(least_of_others(shape, trimmed, n, middle), least_of_others(trimmed, shape, n, middle)) - margin;
    *out = NULL;
    if (!isfinite(at)) return SUNDER_OK;
    for (size_t k = 0; k < 4; k++) {
        const double along = k == 0 || k == 3 ? -far : far, beyond = at + (k < 2 ? 0 : far);
        xy[2 * k] = middle[0] + along * n[1] + beyond * n[0];
        xy[2 * k + 1] = middle[1] - along * n[0] + beyond * n[1];
    }
    return sunder_i_shape_subtract(shape, &(sunder_i_cuts){.xy = xy, .corners = 4, .end = &end, .n = 1}, out, err);
}

sunder_status sunder_i_trim_along(const sunder_shape *shape, double keep, double margin, const sunder_shape *disc,
                                  sunder_shape **trimmed, sunder_error *err)
{
    const double whole = sunder_shape_area(shape),
                 least = sunder_i_max(keep * whole, whole - MOST_AREA * (whole - sunder_shape_area(*trimmed)));
    sunder_shape *best = NULL;
    sunder_status status = SUNDER_OK;
    double u[2] = {1, 0};
    sunder_i_main_direction(shape, u);
    for (int k = 0; k < 4 && !status; k++) {
        const double sign = k < 2 ? 1 : -1, n[2] = {sign * (k & 1 ? -u[1] : u[0]), sign * (k & 1 ? u[0] : u[1])};
        sunder_shape *cut;
        bool may = false;
        status = cut_beyond(shape, *trimmed, n, margin, &cut, err);
        const double area = cut ? sunder_shape_area(cut) : 0;
        if (!status && cut && area >= least && (!best || area > sunder_shape_area(best)))
            status = sunder_i_level_may_follow(*trimmed, cut, disc, &may, err);
        sunder_shape_free(may ? best : cut);
        if (may) best = cut;
    }
    if (best && !status) {
        sunder_shape_free(*trimmed);
        *trimmed = best;
    } else {
        sunder_shape_free(best);
    }
    return status;
}
