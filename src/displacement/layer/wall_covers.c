/* Convex pieces that cover the walls shared by members of a block.
 *
 * The problem is the same as for the diagonals within a feature (diagonal_covers.c): an anchor that moves straight
 * along a wall where two members touch passes between the shadows of both, on the boundary of each. So each such wall,
 * or the part of it that the two edges have in common, gets a quadrilateral with one further corner in each member.
 * Members touch where an edge of one lies exactly along an edge of the other. If there is a distance between them,
 * there is a slit through which an anchor may pass.
 *
 * Both members block the anchor, unless the anchor lies in one of them. */
#include "displacement/layer/far_corners.h"

#include "base/watch.h"
#include "spatial/box.h"

#include <math.h>
#include <string.h>

typedef struct wall_covering {
    sunder_i_model *model;
    size_t capacity;
    sunder_i_list near;
    bool failed;
} wall_covering;

/* An edge of a convex piece of a feature, with corners as given: the edge from corner k, and the corner after it. */
typedef struct edge {
    sunder_point from, to, beyond;
} edge;

/* Are the coordinates of vertex v doubles? */
static bool is_exact(const sunder_shape *shape, uint32_t v)
{
    return !shape->rational || !shape->form->numbers->exact[v].den.size;
}

static sunder_point point_of(const sunder_shape *shape, uint32_t v)
{
    return (sunder_point){shape->xy[2 * (size_t)v], shape->xy[2 * (size_t)v + 1]};
}

/* Sets *e to edge k of the convex piece with the n corners `vertex`. Returns false if one of the three corners is not a
 * double. */
static bool edge_of(const sunder_shape *shape, const uint32_t *vertex, uint32_t n, uint32_t k, edge *e)
{
    const uint32_t v[3] = {vertex[k], vertex[(k + 1) % n], vertex[(k + 2) % n]};
    for (int i = 0; i < 3; i++)
        if (!is_exact(shape, v[i])) return false;
    *e = (edge){point_of(shape, v[0]), point_of(shape, v[1]), point_of(shape, v[2])};
    return true;
}

/* Returns the position of p along the line of edge e: its coordinate on the axis along which the edge is longer. */
static double position_along(const edge *e, sunder_point p)
{
    const double x = e->to.x - e->from.x, y = e->to.y - e->from.y;
    return fabs(x) >= fabs(y) ? (x > 0 ? p.x : -p.x) : (y > 0 ? p.y : -p.y);
}

/* Finds the common part of edge e and edge f of pieces on opposite sides of their line: from u to v, in the direction
 * of e. Returns false if they have no segment in common. */
static bool find_common(const edge *e, const edge *f, sunder_point *u, sunder_point *v)
{
    if (sunder_orient(&e->from, &e->to, &f->from) != 0 || sunder_orient(&e->from, &e->to, &f->to) != 0 ||
        sunder_orient(&e->from, &e->to, &f->beyond) >= 0)
        return false;
    *u = position_along(e, e->from) > position_along(e, f->to) ? e->from : f->to;
    *v = position_along(e, e->to) < position_along(e, f->from) ? e->to : f->from;
    return position_along(e, *u) < position_along(e, *v);
}

static void add_cover(wall_covering *j, uint32_t f, uint32_t g, const edge *e, const edge *of_g)
{
    sunder_i_model *model = j->model;
    sunder_point u, v;
    double at[8];
    if (!find_common(e, of_g, &u, &v)) return;
    const double corner[8] = {u.x, u.y, of_g->beyond.x, of_g->beyond.y, v.x, v.y, e->beyond.x, e->beyond.y};
    if (!sunder_i_cover_shared_segment(corner, at)) return;
    if (model->wall_covers + 1 >= UINT32_MAX ||
        !sunder_i_reserve(&model->wall_cover, &j->capacity, model->wall_covers + 1, sizeof *model->wall_cover)) {
        j->failed = true;
        return;
    }
    sunder_i_wall_cover *wall_cover = &model->wall_cover[model->wall_covers++];
    *wall_cover = (sunder_i_wall_cover){.piece = {.corners = 4, .feature = f}, .other = g};
    memcpy(wall_cover->at, at, sizeof at);
    sunder_i_box_clear(wall_cover->piece.box);
    memcpy(wall_cover->corner, at, sizeof wall_cover->corner);
    sunder_i_reckon_from_origin(&model->body[model->body_of[f]], wall_cover->corner, 4);
    for (size_t k = 0; k < 4; k++) sunder_i_box_include(wall_cover->piece.box, wall_cover->corner + 2 * k);
}

/* Adds a cover for each edge of feature g that lies along edge e of feature f. */
static void cover_along(wall_covering *j, uint32_t f, uint32_t g, const edge *e)
{
    const sunder_shape *shape = sunder_i_thing_shape(j->model, g);
    uint32_t from = 0;
    for (uint32_t p = 0; p < shape->pieces && !j->failed; from = shape->piece_end[p++]) {
        const uint32_t n = shape->piece_end[p] - from;
        for (uint32_t k = 0; k < n && !j->failed; k++) {
            edge of_g;
            if (edge_of(shape, sunder_i_piece_vertices(shape) + from, n, k, &of_g)) add_cover(j, f, g, e, &of_g);
        }
    }
}

static void cover_walls(wall_covering *j, uint32_t f, uint32_t g)
{
    const sunder_shape *shape = sunder_i_thing_shape(j->model, f);
    const double *box = sunder_i_home_box(j->model, g);
    uint32_t from = 0;
    for (uint32_t p = 0; p < shape->pieces && !j->failed; from = shape->piece_end[p++]) {
        const uint32_t n = shape->piece_end[p] - from;
        for (uint32_t k = 0; k < n; k++) {
            edge e;
            double own[4];
            if (!edge_of(shape, sunder_i_piece_vertices(shape) + from, n, k, &e)) continue;
            sunder_i_box_of_segment((double[]){e.from.x, e.from.y}, (double[]){e.to.x, e.to.y}, own);
            if (sunder_i_box_meet(own, box)) cover_along(j, f, g, &e);
        }
    }
    if (!sunder_i_steps(1 + shape->pieces)) j->failed = true;
}

static void cover_walls_of_body(wall_covering *j, uint32_t b)
{
    sunder_i_model *model = j->model;
    sunder_i_body *body = &model->body[b];
    const size_t first = model->wall_covers;
    for (uint32_t m = 0; m < body->members && body->members > 1 && !j->failed; m++) {
        const uint32_t f = model->member[body->member + m];
        j->near.n = 0;
        if (!model->present[f]) continue;
        if (!sunder_i_rtree_query(&model->tree, sunder_i_home_box(model, f), &j->near)) j->failed = true;
        for (size_t k = 0; k < j->near.n && !j->failed; k++)
            if (j->near.item[k] > f && model->body_of[j->near.item[k]] == b) cover_walls(j, f, j->near.item[k]);
    }
    if (model->wall_covers == first || j->failed) return;
    sunder_i_extras *extras = sunder_i_own_extras(model, body);
    if (!extras) {
        j->failed = true;
        return;
    }
    extras->wall_cover = (uint32_t)first;
    extras->wall_covers = (uint32_t)(model->wall_covers - first);
}

sunder_status sunder_i_model_cover_walls(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err)
{
    wall_covering j = {.model = model};
    for (size_t k = 0; k < n && !j.failed; k++) cover_walls_of_body(&j, body[k]);
    sunder_i_free(j.near.item);
    for (size_t k = 0; k < model->wall_covers; k++) model->wall_cover[k].piece.corner = model->wall_cover[k].corner;
    return j.failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}
