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

/* The extents of a body along a row and across it, and the greatest extent of one of its members across it. */
typedef struct stand {
    extent along, across;
    double deepest;
} stand;

static double length_of(const extent *e) { return e->to - e->from; }

static stand stand_of(const sunder_i_model *model, uint32_t body, const double along[2], const double origin[2])
{
    const sunder_i_body *b = &model->body[body];
    const double across[2] = {-along[1], along[0]};
    stand s = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}, 0};
    for (uint32_t m = b->member; m < b->member + b->members; m++) {
        extent depth = {INFINITY, -INFINITY};
        if (!model->present[model->member[m]]) continue;
        include_shape(sunder_i_thing_shape(model, model->member[m]), along, origin, &s.along);
        include_shape(sunder_i_thing_shape(model, model->member[m]), across, origin, &depth);
        s.across.from = sunder_i_min(s.across.from, depth.from);
        s.across.to = sunder_i_max(s.across.to, depth.to);
        s.deepest = sunder_i_max(s.deepest, length_of(&depth));
    }
    return s;
}

static double middle_of(const extent *e) { return (e->from + e->to) / 2; }

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

/* Is the body about as deep as its deepest member, as a terrace is? A perimeter block is deeper, and one that turns a
 * corner. */
static bool is_one_deep(const stand *s) { return length_of(&s->across) <= ROW_DEEP * s->deepest; }

/* Turns the axis of the walls so that the bodies stand farther apart along it than at right angles to it, and towards
 * the second one, and sets their extents along it and across it. */
static void choose_axis(const sunder_i_model *model, const uint32_t body[2], const double origin[2], double along[2],
                        stand s[2])
{
    for (int k = 0; k < 2; k++) s[k] = stand_of(model, body[k], along, origin);
    const bool turned = apart(&s[0].across, &s[1].across) > apart(&s[0].along, &s[1].along);
    const extent *e = turned ? &s[0].across : &s[0].along, *f = turned ? &s[1].across : &s[1].along;
    const double sign = f->from + f->to < e->from + e->to ? -1 : 1, x = along[0];
    along[0] = sign * (turned ? -along[1] : x);
    along[1] = sign * (turned ? x : along[1]);
    for (int k = 0; k < 2; k++) s[k] = stand_of(model, body[k], along, origin);
}

/* Sets link[] to the segment between the two that runs along the row, in the middle of what they share across it. */
static void find_link(const stand s[2], const double along[2], const double origin[2], double link[2][2])
{
    const double across =
                     (sunder_i_max(s[0].across.from, s[1].across.from) + sunder_i_min(s[0].across.to, s[1].across.to)) /
                     2,
                 at[2] = {s[0].along.to, s[1].along.from};
    for (int k = 0; k < 2; k++) {
        link[k][0] = origin[0] + at[k] * along[0] - across * along[1];
        link[k][1] = origin[1] + at[k] * along[1] + across * along[0];
    }
}

/* Sets the edge along the axis edge->along, which it turns, the extents of the bodies, and the link between them. */
static void measure_edge(const sunder_i_model *model, sunder_i_row_edge *edge, stand s[2], double link[2][2])
{
    const uint32_t body[2] = {edge->i, edge->j};
    const double *origin = sunder_i_thing_shape(model, edge->f)->box;
    choose_axis(model, body, origin, edge->along, s);
    edge->offset = offset_of(&s[0].across, &s[1].across);
    edge->apart = s[1].along.from - s[0].along.to;
    edge->middle[0] = middle_of(&s[1].along) - middle_of(&s[0].along);
    edge->middle[1] = middle_of(&s[1].across) - middle_of(&s[0].across);
    find_link(s, edge->along, origin, link);
}

static sunder_i_row_edge edge_of_pair(const sunder_i_row_pair *pair)
{
    return (sunder_i_row_edge){.i = pair->i, .j = pair->j, .f = pair->f, .g = pair->g};
}

/* Are two bodies with this offset in line? */
static bool are_in_line(const stand s[2], double offset, double gap)
{
    const double depth = sunder_i_min(length_of(&s[0].across), length_of(&s[1].across));
    return fabs(offset) <= sunder_i_min(ROW_STEP * depth, ROW_STEP_GAPS * gap);
}

bool sunder_i_row_side_by_side(const sunder_i_model *model, const sunder_i_walls *walls, const sunder_i_row_pair *pair,
                               sunder_i_row_edge *edge, double link[2][2])
{
    sunder_i_walls mean;
    stand s[2];
    *edge = edge_of_pair(pair);
    if (!sunder_i_walls_mean(&walls[pair->f], &walls[pair->g], &mean)) return false;
    sunder_i_walls_axis(&mean, edge->along);
    measure_edge(model, edge, s, link);
    return apart_by_length(&s[0].along, &s[1].along) >= -ROW_SHARED &&
           apart_by_length(&s[0].across, &s[1].across) <= -ROW_SHARED && are_of_one_depth(&s[0].across, &s[1].across) &&
           is_one_deep(&s[0]) && is_one_deep(&s[1]) && are_in_line(s, edge->offset, sunder_i_row_full_gap(model));
}

/* Sets the axis to the direction of the link, or to the x-axis if the two touch. */
static void take_link(const sunder_i_row_pair *pair, double along[2])
{
    const double x = pair->to[0] - pair->from[0], y = pair->to[1] - pair->from[1], length = sqrt(x * x + y * y);
    along[0] = length > 0 ? x / length : 1;
    along[1] = length > 0 ? y / length : 0;
}

void sunder_i_row_join(const sunder_i_model *model, const sunder_i_walls *walls, const sunder_i_row_pair *pair,
                       sunder_i_row_edge *edge, double link[2][2])
{
    sunder_i_walls mean = {{0, 0}, 0};
    stand s[2];
    *edge = edge_of_pair(pair);
    sunder_i_walls_mean(&walls[pair->f], &walls[pair->g], &mean);
    if (fabs(mean.direction[0]) + fabs(mean.direction[1]) > ROW_STRAIGHT)
        sunder_i_walls_axis(&mean, edge->along);
    else
        take_link(pair, edge->along);
    measure_edge(model, edge, s, link);
}
