/* Do two neighbours stand side by side, as neighbours in a row do? */
#include "displacement/rows/row_limits.h"
#include "displacement/rows/row_pairs.h"

#include "base/extremes.h"
#include "shape/shape.h"

#include <math.h>

/* The extent of a set along an axis. */
typedef struct extent {
    double from, to;
} extent;

/* Enlarges the extent by that of a shape along the axis, measured from `origin`. */
static void include_shape(const sunder_shape *shape, const double axis[2], const double origin[2], extent *e)
{
    for (uint32_t v = 0; v < shape->vertices; v++) {
        const double *p = shape->xy + 2 * (size_t)v;
        const double at = (p[0] - origin[0]) * axis[0] + (p[1] - origin[1]) * axis[1];
        e->from = sunder_i_min(e->from, at);
        e->to = sunder_i_max(e->to, at);
    }
}

static extent extent_of_body(const sunder_i_model *model, uint32_t body, const double axis[2], const double origin[2])
{
    const sunder_i_body *b = &model->body[body];
    extent e = {INFINITY, -INFINITY};
    for (uint32_t m = b->member; m < b->member + b->members; m++)
        if (model->present[model->member[m]])
            include_shape(sunder_i_thing_shape(model, model->member[m]), axis, origin, &e);
    return e;
}

/* The extents of a feature along a row and across it. */
typedef struct stand {
    extent along, across;
} stand;

static stand stand_of(const sunder_shape *shape, const double along[2], const double origin[2])
{
    const double across[2] = {-along[1], along[0]};
    stand s = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    include_shape(shape, along, origin, &s.along);
    include_shape(shape, across, origin, &s.across);
    return s;
}

static double length_of(const extent *e) { return e->to - e->from; }

/* Returns the separation of two extents; negative if they overlap. */
static double apart(const extent *e, const extent *f) { return sunder_i_max(e->from - f->to, f->from - e->to); }

/* Returns the separation in units of the shorter of the two. */
static double apart_by_length(const extent *e, const extent *f)
{
    return apart(e, f) / sunder_i_min(length_of(e), length_of(f));
}

/* Returns by how much f is beyond e: at the lower ends, the upper ends, or the middles, whichever is the least. */
static double offset_of(const extent *e, const extent *f)
{
    const double low = f->from - e->from, high = f->to - e->to, middle = (low + high) / 2;
    const double ends = fabs(high) < fabs(low) ? high : low;
    return fabs(middle) < fabs(ends) ? middle : ends;
}

static bool are_of_one_depth(const extent *e, const extent *f)
{
    return length_of(e) <= ROW_DEPTHS * length_of(f) && length_of(f) <= ROW_DEPTHS * length_of(e);
}

/* Turns the axis of the walls so that f and g stand farther apart along it than at right angles to it, and towards g,
 * and sets their extents along it and across it. */
static void choose_axis(const sunder_shape *const shape[2], const double origin[2], double along[2], stand s[2])
{
    for (int k = 0; k < 2; k++) s[k] = stand_of(shape[k], along, origin);
    const bool turned = apart(&s[0].across, &s[1].across) > apart(&s[0].along, &s[1].along);
    const extent *e = turned ? &s[0].across : &s[0].along, *f = turned ? &s[1].across : &s[1].along;
    const double sign = f->from + f->to < e->from + e->to ? -1 : 1, x = along[0];
    along[0] = sign * (turned ? -along[1] : x);
    along[1] = sign * (turned ? x : along[1]);
    for (int k = 0; k < 2; k++) s[k] = stand_of(shape[k], along, origin);
}

/* Sets the edge along the axis edge->along, which it turns, and the extents of f and g. */
static void measure_edge(const sunder_i_model *model, const sunder_i_row_pair *pair, sunder_i_row_edge *edge,
                         stand s[2])
{
    const sunder_shape *shape[2] = {sunder_i_thing_shape(model, pair->f), sunder_i_thing_shape(model, pair->g)};
    const double *origin = shape[0]->box;
    choose_axis(shape, origin, edge->along, s);
    edge->offset = offset_of(&s[0].across, &s[1].across);
    const extent i = extent_of_body(model, pair->i, edge->along, origin),
                 j = extent_of_body(model, pair->j, edge->along, origin);
    edge->apart = j.from - i.to;
}

static sunder_i_row_edge edge_of_pair(const sunder_i_row_pair *pair)
{
    return (sunder_i_row_edge){.i = pair->i, .j = pair->j, .f = pair->f, .g = pair->g};
}

bool sunder_i_row_side_by_side(const sunder_i_model *model, const sunder_i_walls *walls, const sunder_i_row_pair *pair,
                               sunder_i_row_edge *edge)
{
    sunder_i_walls mean;
    stand s[2];
    *edge = edge_of_pair(pair);
    if (!sunder_i_walls_mean(&walls[pair->f], &walls[pair->g], &mean)) return false;
    sunder_i_walls_axis(&mean, edge->along);
    measure_edge(model, pair, edge, s);
    return apart_by_length(&s[0].along, &s[1].along) >= -ROW_SHARED &&
           apart_by_length(&s[0].across, &s[1].across) <= -ROW_SHARED &&
           are_of_one_depth(&s[0].across, &s[1].across) && fabs(edge->offset) <= model->rules.gap;
}

/* Sets the axis to the direction of the link, or to the x-axis if the two touch. */
static void take_link(const sunder_i_row_pair *pair, double along[2])
{
    const double x = pair->to[0] - pair->from[0], y = pair->to[1] - pair->from[1], length = sqrt(x * x + y * y);
    along[0] = length > 0 ? x / length : 1;
    along[1] = length > 0 ? y / length : 0;
}

void sunder_i_row_join(const sunder_i_model *model, const sunder_i_walls *walls, const sunder_i_row_pair *pair,
                       sunder_i_row_edge *edge)
{
    sunder_i_walls mean = {{0, 0}, 0};
    stand s[2];
    *edge = edge_of_pair(pair);
    sunder_i_walls_mean(&walls[pair->f], &walls[pair->g], &mean);
    if (fabs(mean.direction[0]) + fabs(mean.direction[1]) > ROW_STRAIGHT)
        sunder_i_walls_axis(&mean, edge->along);
    else
        take_link(pair, edge->along);
    measure_edge(model, pair, edge, s);
}
