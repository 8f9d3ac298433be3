/* Blocks made larger, up to a least size.
 *
 *      ___________      A part of a block is too small if no disc of the least size fits into it. Among the boxes that
 *     |_|_|_|_|_|_|     have an edge of its convex hull on one side, the narrowest is found. The part is stretched
 *                       along this box and across it, about the middle of the box, to the least size where the box is
 *      ___________      less, and then in both directions alike as far as the disc needs it. So a terrace of low depth
 *     | | | | | | |     becomes deeper, and not longer.
 *     |_|_|_|_|_|_|
 *
 * All vertices of a part are mapped by the same affine map, so members that share a vertex still share it. The parts of
 * a feature may meet when each of them has grown; then the block grows as if it were one part. */
#include "displacement/levels/block_outline.h"
#include "displacement/levels/block_parts.h"
#include "displacement/levels/edges.h"
#include "displacement/levels/inscribed.h"
#include "displacement/levels/levels.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/watch.h"

#include <math.h>

typedef struct enlarger {
    const sunder_layer *layer;
    const sunder_enlarging *how;
    const sunder_shape **from; /* [n] the shapes that may grow; NULL: none */
    sunder_i_blocks blocks;
    const sunder_shape **now; /* [n] scratch of the thread that has the block */
    sunder_shape **out;
} enlarger;

/* The map of a part: q = p + along (u.(p - middle)) u + across (n.(p - middle)) n, where n is the left normal of u. */
typedef struct stretch {
    double middle[2], u[2], along, across;
} stretch;

/* The polygons of a part, which are neighbours in the list of polygons. */
typedef struct part_range {
    size_t begin, end;
} part_range;

/* Scratch of one thread. */
typedef struct workings {
    sunder_i_block_outline outline;
    sunder_i_block_parts parts, grown; /* of the shapes as given; of the larger ones */
    double *point, *hull, *wall, *edge, *xy;
    size_t point_room, hull_room, wall_room, edge_room, xy_room;
    size_t *end;
    size_t end_room;
    stretch *map; /* [parts] */
    size_t map_room;
} workings;

/* ---- The box of a part ------------------------------------------------------------------------------------------- */

/* A box with two sides along u, and the one side along it, the other across it. */
typedef struct turned_box {
    double u[2], middle[2], length, width;
} turned_box;

/* Writes the convex hull of a part to w->hull, relative to `origin`, and returns the number of corners. */
static size_t hull_of(workings *w, const part_range *part, double origin[2])
{
    size_t n = 0;
    for (size_t k = part->begin; k < part->end; k++) {
        const sunder_i_block_polygon *p = &w->parts.polygon[k];
        if (!sunder_i_reserve(&w->point, &w->point_room, 2 * (n + p->end - p->vertex), sizeof *w->point)) return 0;
        if (n == 0) memcpy(origin, p->shape->xy + 2 * (size_t)p->vertex, 2 * sizeof *origin);
        for (uint32_t v = p->vertex; v < p->end; v++, n++)
            for (size_t c = 0; c < 2; c++) w->point[2 * n + c] = p->shape->xy[2 * (size_t)v + c] - origin[c];
    }
    if (!sunder_i_reserve(&w->hull, &w->hull_room, 2 * (n + 1), sizeof *w->hull)) return 0;
    return sunder_i_convex_hull(w->point, n, w->hull);
}

/* Sets *box to the box of the hull along u. */
static void box_along(const double *hull, size_t n, const double u[2], turned_box *box)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t k = 0; k < n; k++) {
        const double *p = hull + 2 * k, at[2] = {p[0] * u[0] + p[1] * u[1], p[1] * u[0] - p[0] * u[1]};
        for (int c = 0; c < 2; c++) {
            low[c] = sunder_i_min(low[c], at[c]);
            high[c] = sunder_i_max(high[c], at[c]);
        }
    }
    const double x = (low[0] + high[0]) / 2, y = (low[1] + high[1]) / 2;
    *box = (turned_box){.u = {u[0], u[1]},
                        .middle = {x * u[0] - y * u[1], x * u[1] + y * u[0]},
                        .length = high[0] - low[0],
                        .width = high[1] - low[1]};
}

/* Finds the box of the least width among those that have an edge of the hull on one side, the first of equal ones. */
static bool find_box(workings *w, const part_range *part, turned_box *best)
{
    double origin[2] = {0, 0};
    const size_t n = hull_of(w, part, origin);
    best->width = INFINITY;
    if (n == 0) return false;
    for (size_t k = 0; k < n; k++) {
        const double *a = w->hull + 2 * k, *b = w->hull + 2 * ((k + 1) % n), length = hypot(b[0] - a[0], b[1] - a[1]);
        turned_box box;
        if (!(length > 0)) continue;
        box_along(w->hull, n, (const double[2]){(b[0] - a[0]) / length, (b[1] - a[1]) / length}, &box);
        if (box.width < best->width) *best = box;
    }
    for (int c = 0; c < 2; c++) best->middle[c] += origin[c];
    return true;
}

/* ---- The map of a part ------------------------------------------------------------------------------------------- */

/* Writes an edge in coordinates of the box, stretched. */
static void to_box(const stretch *s, const double edge[4], double out[4])
{
    for (int c = 0; c < 4; c += 2) {
        const double x = edge[c] - s->middle[0], y = edge[c + 1] - s->middle[1];
        out[c] = (1 + s->along) * (x * s->u[0] + y * s->u[1]);
        out[c + 1] = (1 + s->across) * (y * s->u[0] - x * s->u[1]);
    }
}

/* Writes the sides of the outline near a part, stretched, to w->wall, and returns their number. Sides farther away
 * belong to other parts. */
static size_t list_walls(workings *w, const part_range *part, double crack, const stretch *s)
{
    double box[4];
    size_t walls = 0;
    sunder_i_box_clear(box);
    for (size_t k = part->begin; k < part->end; k++)
        for (int c = 0; c < 4; c += 2) sunder_i_box_include(box, w->parts.polygon[k].box + c);
    sunder_i_box_grow(box, crack, box);
    for (size_t k = 0; k < w->outline.n; k++) {
        const double *a = w->outline.side[k].from, *b = w->outline.side[k].to;
        double around[4];
        sunder_i_box_clear(around);
        sunder_i_box_include(around, a);
        sunder_i_box_include(around, b);
        if (sunder_i_box_meet(around, box)) to_box(s, (const double[4]){a[0], a[1], b[0], b[1]}, w->wall + 4 * walls++);
    }
    return walls;
}

/* Writes the edges of a part's polygons, stretched, to w->edge, and where those of each end to w->end. Returns false if
 * memory is out. */
static bool list_edges(workings *w, const part_range *part, const stretch *s)
{
    size_t edges = 0;
    for (size_t k = part->begin; k < part->end; k++) {
        const sunder_i_block_polygon *p = &w->parts.polygon[k];
        if (!sunder_i_reserve(&w->edge, &w->edge_room, 4 * (edges + p->end - p->vertex), sizeof *w->edge)) return false;
        for (uint32_t v = p->vertex; v < p->end; v++, edges++) {
            double edge[4];
            sunder_i_edge_of(p->shape, v, edge);
            to_box(s, edge, w->edge + 4 * edges);
        }
        w->end[k - part->begin] = edges;
    }
    return true;
}

/* Finds the radius of the largest disc in a part that was stretched by *s. */
static bool find_radius(workings *w, const part_range *part, double crack, const stretch *s, double *radius)
{
    const size_t members = part->end - part->begin;
    double centre[2];
    if (!sunder_i_reserve(&w->wall, &w->wall_room, 4 * w->outline.n, sizeof *w->wall) ||
        !sunder_i_reserve(&w->end, &w->end_room, members, sizeof *w->end) || !list_edges(w, part, s))
        return false;
    const sunder_i_disc_room room = {.walls = list_walls(w, part, crack, s),
                                     .wall = w->wall,
                                     .edge = w->edge,
                                     .end = w->end,
                                     .members = members,
                                     .crack = crack};
    if (!sunder_i_largest_disc(&room, centre, radius)) return false;
    sunder_i_disc_climb(&room, *radius / 8, centre, radius);
    return true;
}

/* Finds the map of a part; one that changes nothing where it is large enough, up to the precision of discs. */
static bool find_map(workings *w, const part_range *part, double crack, double least, stretch *map)
{
    turned_box box;
    double radius;
    if (!find_box(w, part, &box)) return false;
    *map = (stretch){.middle = {box.middle[0], box.middle[1]}, .u = {box.u[0], box.u[1]}};
    if (!find_radius(w, part, crack, map, &radius)) return false;
    if (2 * (radius + box.width * SUNDER_I_DISC_PRECISION) >= least) return true;
    map->along = sunder_i_max(0, least / box.length - 1);
    map->across = sunder_i_max(0, least / box.width - 1);
    const double width = sunder_i_max(box.width, least);
    if (!find_radius(w, part, crack * (1 + map->across), map, &radius)) return false;
    if (2 * (radius + width * SUNDER_I_DISC_PRECISION) >= least) return true;
    const double factor = least / (2 * radius);
    map->along = factor * (1 + map->along) - 1;
    map->across = factor * (1 + map->across) - 1;
    return true;
}

static bool grows(const stretch *map) { return map->along > 0 || map->across > 0; }

/* Along an axis, and where both directions grow alike, a coordinate depends on no other one; so vertices on a common
 * line along an axis stay on one, to the bit. */
static void map_point(const stretch *map, const double p[2], double out[2])
{
    const double *u = map->u, d[2] = {p[0] - map->middle[0], p[1] - map->middle[1]};
    const bool alike = map->along == map->across;
    const double xx = alike ? map->along : map->along * u[0] * u[0] + map->across * u[1] * u[1];
    const double yy = alike ? map->along : map->along * u[1] * u[1] + map->across * u[0] * u[0];
    const double xy = alike ? 0 : (map->along - map->across) * u[0] * u[1];
    out[0] = p[0] + (xx * d[0] + xy * d[1]);
    out[1] = p[1] + (xy * d[0] + yy * d[1]);
}

/* ---- Blocks ------------------------------------------------------------------------------------------------------ */

/* Finds the maps of all parts. Sets *any to whether one grows. */
static bool find_maps(workings *w, double crack, double least, bool *any)
{
    *any = false;
    if (!sunder_i_reserve(&w->map, &w->map_room, w->parts.parts, sizeof *w->map)) return false;
    for (part_range part = {0, 0}; part.begin < w->parts.n; part.begin = part.end) {
        const uint32_t number = w->parts.polygon[part.begin].part;
        while (part.end < w->parts.n && w->parts.polygon[part.end].part == number) part.end++;
        if (!find_map(w, &part, crack, least, &w->map[number])) return false;
        *any = *any || grows(&w->map[number]);
    }
    return true;
}

/* Makes all parts one part, which is as large as the least of them demands: its map is of the largest factors. */
static bool unite_parts(workings *w)
{
    turned_box box;
    double most = 0;
    for (uint32_t part = 0; part < w->parts.parts; part++)
        most = sunder_i_max(most, sunder_i_max(w->map[part].along, w->map[part].across));
    for (size_t k = 0; k < w->parts.n; k++) w->parts.polygon[k].part = 0;
    w->parts.parts = 1;
    if (!find_box(w, &(part_range){0, w->parts.n}, &box)) return false;
    w->map[0] = (stretch){{box.middle[0], box.middle[1]}, {box.u[0], box.u[1]}, most, most};
    return true;
}

/* Sets out[f] to the larger shape of feature f, if one of its polygons grows; clears *valid if it is no shape. */
static sunder_status enlarge_feature(const enlarger *t, workings *w, uint32_t f, bool *valid, sunder_error *err)
{
    const sunder_shape *shape = t->from[f];
    bool any = false;
    if (!sunder_i_reserve(&w->xy, &w->xy_room, 2 * (size_t)shape->vertices, sizeof *w->xy))
        return sunder_i_failure_cause(err);
    for (size_t k = 0; k < w->parts.n; k++) {
        const sunder_i_block_polygon *p = &w->parts.polygon[k];
        const stretch *map = &w->map[p->part];
        if (p->feature != f) continue;
        any = any || grows(map);
        for (size_t v = p->vertex; v < p->end; v++) {
            memcpy(w->xy + 2 * v, shape->xy + 2 * v, 2 * sizeof *w->xy);
            if (grows(map)) map_point(map, shape->xy + 2 * v, w->xy + 2 * v);
            if (!isfinite(w->xy[2 * v]) || !isfinite(w->xy[2 * v + 1]))
                return sunder_i_fail(err, SUNDER_ERANGE, "a least size of %g leads out of the range of doubles",
                                     t->how->width);
        }
    }
    if (!any) return SUNDER_OK;
    const sunder_status status = sunder_i_shape_with_corners(shape, w->xy, &t->out[f], err);
    *valid = *valid && t->out[f];
    return status;
}

/* Clears *apart if parts of the body meet now that they have grown. Returns false if memory is out. */
static bool stay_apart(const enlarger *t, workings *w, const sunder_i_body *body, bool *apart)
{
    const sunder_i_model *model = &t->blocks.model;
    if (w->parts.parts == 1) return true;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        t->now[f] = t->out[f] ? t->out[f] : t->from[f];
    }
    if (!sunder_i_block_parts_find(model, body, t->now, 0, &w->grown)) return false;
    *apart = w->grown.parts >= w->parts.parts;
    return true;
}

static sunder_status enlarge_members(const enlarger *t, workings *w, const sunder_i_body *body, bool *valid,
                                     sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *valid = true;
    for (uint32_t m = 0; m < body->members && *valid && !status; m++)
        status = enlarge_feature(t, w, t->blocks.model.member[body->member + m], valid, err);
    if (!status && *valid && !stay_apart(t, w, body, valid)) status = sunder_i_failure_cause(err);
    if (!status && *valid) return SUNDER_OK;
    for (uint32_t m = 0; m < body->members; m++)
        sunder_i_levels_drop(&t->out[t->blocks.model.member[body->member + m]], 1);
    return status;
}

/* May all members of the body grow? */
static bool may_grow(const enlarger *t, const sunder_i_body *body)
{
    const sunder_i_model *model = &t->blocks.model;
    if (sunder_i_is_barrier_body(model, body)) return false;
    for (uint32_t m = 0; m < body->members; m++)
        if (!t->from[model->member[body->member + m]]) return false;
    return true;
}

static sunder_status enlarge_body(const enlarger *t, workings *w, const sunder_i_body *body, sunder_error *err)
{
    const sunder_i_model *model = &t->blocks.model;
    bool any, valid;
    if (!may_grow(t, body)) return SUNDER_OK;
    sunder_status status = sunder_i_block_outline_find(model, body, t->from, &w->outline, err);
    if (status) return status;
    const double crack = sunder_i_max(model->rules.tolerance, 2 * w->outline.margin);
    if (!sunder_i_block_parts_find(model, body, t->from, crack, &w->parts) || !find_maps(w, crack, t->how->width, &any))
        return sunder_i_failure_cause(err);
    if (!any) return SUNDER_OK;
    status = enlarge_members(t, w, body, &valid, err);
    if (status || valid || w->parts.parts == 1) return status;
    if (!unite_parts(w)) return sunder_i_failure_cause(err);
    return enlarge_members(t, w, body, &valid, err);
}

static sunder_status enlarge_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const enlarger *t = context;
    workings w = {0};
    sunder_status status = SUNDER_OK;
    for (size_t b = begin; b < end && !status; b++) {
        status = enlarge_body(t, &w, &t->blocks.model.body[b], err);
        if (!status && !sunder_i_step()) status = sunder_i_failure_cause(err);
    }
    sunder_i_block_outline_free(&w.outline);
    sunder_i_free_all(w.parts.polygon, w.grown.polygon, w.point, w.hull, w.wall, w.edge, w.xy, w.end, w.map);
    return status;
}

/* ---- The layer --------------------------------------------------------------------------------------------------- */

sunder_status sunder_layer_enlarge(const sunder_layer *layer, const sunder_layer_options *options,
                                   const sunder_enlarging *enlarging, sunder_shape **shape, int64_t *block,
                                   sunder_error *err)
{
    enlarger t = {.layer = layer, .how = enlarging, .out = shape};
    for (size_t f = 0; f < layer->n; f++) shape[f] = NULL;
    if (!(enlarging->width > 0) || !isfinite(enlarging->width))
        return sunder_i_fail(err, SUNDER_EARG, "the least size, %g, is out of range", enlarging->width);
    t.from = sunder_i_alloc(2 * layer->n, sizeof *t.from);
    if (!t.from) return sunder_i_failure_cause(err);
    t.now = t.from + layer->n;
    for (size_t f = 0; f < layer->n; f++) {
        const bool rigid = enlarging->rigid && enlarging->rigid[f];
        t.from[f] = !rigid && sunder_i_level_has_shape(layer, f) ? layer->shape[f] : NULL;
    }
    sunder_status status = sunder_i_blocks_find(layer, options, &t.blocks, err);
    if (!status)
        status = sunder_i_parallel(t.blocks.model.rules.threads, t.blocks.model.bodies, SUNDER_I_GRAIN_SHAPES,
                                   enlarge_some, &t, err);
    if (!status) sunder_i_blocks_number(&t.blocks, layer->n, block);
    if (status) sunder_i_levels_drop(shape, layer->n);
    sunder_i_blocks_free(&t.blocks);
    sunder_i_free((void *)t.from);
    return status;
}
