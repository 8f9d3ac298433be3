/* Sides: a feature stays on its side of a barrier's lines.
 *
 * The lines are the segments of a barrier's lines and the edges of its areas; points have none. A feature's side anchor
 * moves straight from a to a + t, and may meet none of the lines, with two exceptions:
 *
 *   an edge with `a` on its inner side  a feature in a polygon may leave it. So only edges whose area lies behind them,
 *                                       as seen from `a`, block the path: a path that enters the polygon, from outside
 *                                       or again, meets one of those, and a path that leaves it meets none of them
 *   a line that `a` lies on             a side anchor lies on no line if doubles have such a point (side_anchor.c);
 *                                       otherwise it belongs to neither side of the line
 *
 * Why a path that enters meets an edge facing the start: just before it enters, it is outside, in a sector bounded by
 * two edges. If the sector is less than half a plane, its inner points are on the outer sides of both edges' lines;
 * otherwise on the outer side of at least one, and the start lies on the same ray. A path that touches an edge facing
 * its start, and stays inside, counts as entering: touching is meeting.
 *
 * In the model each line is a piece of two corners. Lines are stored in the order of the barriers' parts, and the body
 * of a part refers to the lines of that part. */
#include "displacement/layer/sides.h"
#include "displacement/layer/far_corners.h"
#include "displacement/layer/reads.h"

#include "base/parallel.h"
#include "separation/separation.h"
#include "shape/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

/* Returns the number of lines of a convex piece of a barrier, and writes them to `side` unless that is NULL. */
static size_t take_lines(const sunder_i_piece_of *of, sunder_i_side *side)
{
    const double *xy = of->shape ? of->shape->xy : of->xy;
    const uint32_t corners = sunder_i_piece_corners(of);
    size_t lines = 0;
    for (uint32_t k = 0; k < corners; k++) {
        uint32_t v[2];
        if (!sunder_i_piece_edge(of, k, v)) continue;
        if (side)
            side[lines] = (sunder_i_side){.from = xy + 2 * (size_t)v[0],
                                          .to = xy + 2 * (size_t)v[1],
                                          .area = corners > 2 ? of->shape : NULL,
                                          .vertex = v[0]};
        lines++;
    }
    return lines;
}

/* Returns the number of lines of a whole part of a barrier, 0 if the barrier has no sides, and writes them to `side`
 * unless that is NULL. */
static size_t take_part(const sunder_i_model *model, uint32_t part, sunder_i_side *side)
{
    const sunder_i_barriers *b = model->barriers;
    size_t lines = 0;
    if (!model->layer->barrier[b->barrier[part]].side) return 0;
    for (uint32_t k = part ? b->piece_end[part - 1] : 0; k < b->piece_end[part]; k++)
        lines += take_lines(&b->piece[k], side ? side + lines : NULL);
    return lines;
}

static void box_of_line(const sunder_i_side *side, double box[4])
{
    sunder_i_box_of_segment(side->from, side->to, box);
    if (side->area && side->area->rational) sunder_i_box_grow(box, 0, box);
}

/* Stores a line as a piece of the body of its part. */
static void put_piece(const sunder_i_model *model, const sunder_i_body *body, uint32_t part, sunder_i_side *side)
{
    sunder_i_body_piece *piece = &side->piece;
    *piece = (sunder_i_body_piece){.corner = side->corner, .corners = 2, .feature = (uint32_t)model->features + part};
    sunder_i_box_clear(piece->box);
    memcpy(side->corner, side->from, 2 * sizeof *side->corner);
    memcpy(side->corner + 2, side->to, 2 * sizeof *side->corner);
    sunder_i_reckon_from_origin(body, side->corner, 2);
    for (int e = 0; e < 2; e++) sunder_i_box_include(piece->box, side->corner + 2 * e);
}

static sunder_status take_all_lines(sunder_i_model *model, sunder_error *err)
{
    const uint32_t parts = model->barriers->parts;
    size_t n = 0;
    for (uint32_t k = 0; k < parts; k++) n += take_part(model, k, NULL);
    if (n == 0) return SUNDER_OK;
    if (n >= UINT32_C(1) << 30) return sunder_i_fail(err, SUNDER_ESIZE, "too many sides: %zu", n);
    model->side = sunder_i_alloc(n, sizeof *model->side);
    if (!model->side) return sunder_i_failure_cause(err);
    for (uint32_t k = 0; k < parts; k++) {
        sunder_i_body *body = &model->body[model->body_of[model->features + k]];
        const uint32_t first = (uint32_t)model->sides, sides = (uint32_t)take_part(model, k, model->side + first);
        if (sides == 0) continue;
        sunder_i_extras *extras = sunder_i_own_extras(model, body);
        if (!extras) return sunder_i_failure_cause(err);
        extras->side = first;
        extras->sides = sides;
        for (uint32_t i = 0; i < sides; i++) put_piece(model, body, k, &model->side[model->sides++]);
    }
    return SUNDER_OK;
}

/* ---- Side anchors ------------------------------------------------------------------------------------------------ */

/* The lines that meet a box, and the buffers for finding them. */
typedef struct line_list {
    const sunder_i_model *model;
    sunder_i_list near;
    const sunder_i_side **line;
    size_t n, capacity;
    uint32_t body; /* the body on whose behalf lines beyond the feature's box are read */
} line_list;

static void free_lines(line_list *l) { sunder_i_free_all(l->line, l->near.item); }

/* Finds the lines whose boxes meet `box`. Returns false if memory is out. */
static bool find_lines(line_list *l, const double box[4])
{
    const sunder_i_model *model = l->model;
    sunder_i_list *near = &l->near;
    l->n = 0;
    near->n = 0;
    if (!sunder_i_look_about(model, &model->tree, box, near)) return false;
    if (near->n) qsort(near->item, near->n, sizeof *near->item, sunder_i_by_number);
    for (size_t k = 0; k < near->n; k++) {
        const sunder_i_body *body = &model->body[model->body_of[near->item[k]]];
        for (uint32_t i = body->has->side; i < body->has->side + body->has->sides; i++) {
            double own[4];
            box_of_line(&model->side[i], own);
            if (!sunder_i_box_meet(own, box)) continue;
            if (!sunder_i_reserve(&l->line, &l->capacity, l->n + 1, sizeof *l->line)) return false;
            l->line[l->n++] = &model->side[i];
        }
    }
    return true;
}

static bool find_more(void *user, const double box[4], const sunder_i_side *const **line, size_t *n)
{
    line_list *l = user;
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, l->model, l->body);
    const bool found = find_lines(l, box);
    sunder_i_reads_end(&reading);
    if (!found) return false;
    *line = l->line;
    *n = l->n;
    return true;
}

/* Returns the side anchor that the caller gave to feature f; NULL if it has to be computed. */
static const double *given_anchor(const sunder_i_model *model, size_t f)
{
    const sunder_layer *given = model->layer->given;
    const double *at = given->side_anchor ? given->side_anchor + 2 * (size_t)model->layer->number[f] : NULL;
    return at && isfinite(at[0]) && isfinite(at[1]) ? at : NULL;
}

static sunder_status find_some_anchors(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_model *model = context;
    line_list about = {.model = model}, around = {.model = model};
    const sunder_i_side_scope scope = {model->rules.tolerance, find_more, &around};
    sunder_status status = SUNDER_OK;
    for (size_t f = begin; f < end && !status; f++) {
        const sunder_shape *shape = sunder_i_original_shape(model->layer->given, model->layer->number[f]);
        const double *given = given_anchor(model, f);
        if (!model->present[f]) continue;
        if (given) {
            memcpy(model->side_at + 2 * f, given, 2 * sizeof *given);
            continue;
        }
        around.body = model->body_of[f];
        if (!find_lines(&about, shape->box)) status = sunder_i_failure_cause(err);
        if (!status) status = sunder_i_side_anchor(shape, about.line, about.n, &scope, model->side_at + 2 * f, err);
    }
    free_lines(&about);
    free_lines(&around);
    return status;
}

/* Stores each side anchor as a piece of one corner, and the box of these for each body. */
static void put_anchors(sunder_i_model *model)
{
    for (size_t b = 0; b < model->bodies; b++) {
        const sunder_i_body *body = &model->body[b];
        double *box = model->side_anchors + 4 * b;
        sunder_i_box_clear(box);
        for (uint32_t m = 0; m < body->members; m++) {
            const uint32_t f = model->member[body->member + m];
            if (sunder_i_is_barrier(model, f) || !model->present[f]) continue;
            sunder_i_body_piece *anchor = &model->side_anchor[f];
            *anchor = (sunder_i_body_piece){.corner = anchor->box, .corners = 1, .feature = f};
            for (int c = 0; c < 2; c++)
                anchor->box[c] = anchor->box[c + 2] = model->side_at[2 * (size_t)f + (size_t)c] - body->origin[c];
            sunder_i_box_join(box, anchor->box);
        }
    }
}

sunder_status sunder_i_model_find_sides(sunder_i_model *model, sunder_error *err)
{
    sunder_status status = take_all_lines(model, err);
    if (status || model->sides == 0) return status;
    model->side_at = sunder_i_calloc(2 * model->features, sizeof *model->side_at);
    model->side_anchor = sunder_i_calloc(model->features, sizeof *model->side_anchor);
    model->side_anchors = sunder_i_alloc(4 * model->bodies, sizeof *model->side_anchors);
    if (!model->side_at || !model->side_anchor || !model->side_anchors) return sunder_i_failure_cause(err);
    status =
        sunder_i_parallel(model->rules.threads, model->features, SUNDER_I_GRAIN_TESTS, find_some_anchors, model, err);
    if (!status) put_anchors(model);
    return status;
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

/* Does the path meet the line from-to, and not begin on it? */
static bool meets_line(const sunder_i_passage *path, const double from[2], const double to[2])
{
    const sunder_i_passage stay = {.from = {path->from[0], path->from[1]}};
    return sunder_i_passage_meets(path, from, to) && !sunder_i_passage_meets(&stay, from, to);
}

sunder_status sunder_i_crosses_side(const sunder_i_model *model, uint32_t f, const double t[2], uint32_t part,
                                    bool *crosses, sunder_error *err)
{
    const double *a = model->side_at + 2 * (size_t)f;
    const sunder_i_body *body = &model->body[model->body_of[part]];
    const sunder_i_passage path = {{a[0], a[1]}, {t[0], t[1]}, {0, 0}};
    double box[4], own[4];
    sunder_status status = SUNDER_OK;
    *crosses = false;
    if (t[0] == 0 && t[1] == 0) return SUNDER_OK;
    sunder_i_passage_box(&path, box);
    for (uint32_t k = body->has->side; k < body->has->side + body->has->sides && !status && !*crosses; k++) {
        const sunder_i_side *side = &model->side[k];
        box_of_line(side, own);
        if (!sunder_i_box_meet(own, box)) continue;
        if (side->area)
            status = sunder_i_enters_by_edge(&path, side->area, side->vertex, crosses, err);
        else
            *crosses = meets_line(&path, side->from, side->to);
    }
    return status;
}

bool sunder_i_side_faces(const sunder_i_model *model, const sunder_i_side *side, uint32_t f)
{
    const double *a = model->side_at + 2 * (size_t)f, *p = side->from, *q = side->to;
    if (!side->area) return true;
    if (!side->area->rational) {
        const sunder_point at = {a[0], a[1]}, from = {p[0], p[1]}, to = {q[0], q[1]};
        return sunder_orient(&from, &to, &at) < 0;
    }
    /* Corners may be off by a unit in the last place, 2^-52 of their magnitude, and the differences are rounded as
     * well. */
    const double size = fabs(a[0]) + fabs(a[1]) + fabs(p[0]) + fabs(p[1]) + fabs(q[0]) + fabs(q[1]);
    const double d[2] = {q[0] - p[0], q[1] - p[1]}, e[2] = {a[0] - p[0], a[1] - p[1]};
    const double slack = 0x1p-49 * size * (fabs(d[0]) + fabs(d[1]) + fabs(e[0]) + fabs(e[1]) + 0x1p-49 * size);
    return d[0] * e[1] - d[1] * e[0] < -slack;
}
