/* The bodies that the search moves: the numbering of their pieces, their boxes in doubles, and whole blocks as
 * shapes. */
#include "displacement/layer/far_corners.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "shape/shape.h"

#include <math.h>
#include <string.h>

static void box_of_far_pieces(const sunder_shape *shape, const sunder_i_body *body, double box[4])
{
    uint32_t from = 0;
    sunder_i_box_clear(box);
    for (uint32_t p = 0; p < shape->pieces; from = shape->piece_end[p++]) {
        for (uint32_t k = from; k < shape->piece_end[p]; k++) {
            double corner[2 * SUNDER_I_FAR_MOST];
            const size_t n = sunder_i_far_corner(body, shape, p, k, corner);
            for (size_t l = 0; l < n; l++) sunder_i_box_include(box, corner + 2 * l);
        }
    }
}

/* Sets box to the box of a thing's pieces, relative to the body's origin. Most pieces have the corners of the shape as
 * given. Rounding is monotone, so for these the shape's box less the origin is the box of the corners less the
 * origin. */
static void box_of_pieces(const sunder_i_model *model, uint32_t thing, const sunder_i_body *body, double box[4])
{
    const sunder_shape *shape = sunder_i_thing_shape(model, thing);
    for (size_t c = 0; c < 4; c++) box[c] = sunder_i_from_origin(body, shape->box[c], c & 1);
    if (shape->rational && !body->far) {
        sunder_i_box_clear(box);
        for (uint32_t k = 0; k < shape->piece_end[shape->pieces - 1]; k++) {
            const double *xy = shape->xy + 2 * (size_t)sunder_i_piece_vertices(shape)[k];
            sunder_i_box_include(
                box, (double[]){sunder_i_from_origin(body, xy[0], 0), sunder_i_from_origin(body, xy[1], 1)});
        }
    }
    if (body->far) box_of_far_pieces(shape, body, box);
    const double beyond = sunder_i_reach_beyond(model, thing);
    if (beyond > 0) sunder_i_box_grow(box, beyond, box);
}

/* Task of a thread: computes box and number of pieces of the bodies `begin` to `end` - 1, and resets their `clear`. */
static sunder_status measure_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    (void)err;
    sunder_i_model *model = context;
    for (size_t b = begin; b < end; b++) {
        sunder_i_body *body = &model->body[b];
        body->clear = INFINITY;
        sunder_i_box_clear(body->box);
        if (!body->held) sunder_i_find_far_corners(model, body);
        body->pieces = 0;
        for (uint32_t k = 0; k < body->members; k++) {
            const uint32_t f = model->member[body->member + k];
            double box[4];
            if (!model->present[f] || sunder_i_thing_shape(model, f)->pieces == 0) continue;
            box_of_pieces(model, f, body, box);
            sunder_i_box_join(body->box, box);
            body->pieces += sunder_i_thing_shape(model, f)->pieces;
        }
    }
    return SUNDER_OK;
}

/* Numbers the pieces of all bodies consecutively, body after body, and sets *pieces to their number. Returns false if
 * there are more than 32 bits can number. */
static bool number_pieces(sunder_i_model *model, size_t *pieces)
{
    *pieces = 0;
    for (size_t b = 0; b < model->bodies; b++) {
        sunder_i_body *body = &model->body[b];
        body->piece = (uint32_t)*pieces;
        *pieces += body->pieces;
        if (body->pieces > model->most_pieces) model->most_pieces = body->pieces;
    }
    return *pieces < UINT32_MAX;
}

sunder_status sunder_i_model_cut(sunder_i_model *model, sunder_error *err)
{
    size_t pieces;
    sunder_status status =
        sunder_i_parallel(model->rules.threads, model->bodies, SUNDER_I_GRAIN_LOOKS, measure_some, model, err);
    if (status) return status;
    if (!number_pieces(model, &pieces)) return sunder_i_fail(err, SUNDER_ESIZE, "too many pieces: %zu", pieces);
    model->whole = sunder_i_calloc(model->bodies, sizeof *model->whole);
    if (!sunder_i_pieces_begin(model) || !model->whole) return sunder_i_failure_cause(err);
    return sunder_i_inclusion_walls(model, err);
}

uint32_t sunder_i_body_of_piece(const sunder_i_model *model, uint32_t piece)
{
    size_t low = 0, high = model->bodies; /* the last body whose first piece is at most `piece`; bodies without pieces
                                           * come before it */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (model->body[middle].piece <= piece)
            low = middle;
        else
            high = middle;
    }
    return (uint32_t)low;
}

/* ---- Whole blocks ------------------------------------------------------------------------------------------------ */

const sunder_shape *sunder_i_model_shape(const sunder_i_model *model, uint32_t body)
{
    const sunder_i_body *b = &model->body[body];
    if (b->members > 1) return model->whole[body];
    return model->present[model->member[b->member]] ? sunder_i_thing_shape(model, model->member[b->member]) : NULL;
}

/* Sets model->whole[b] to the union of the members of body b. The members' rings are passed as given, one after the
 * other: the members of a polygonal set may touch and overlap. */
static sunder_status unite_members(sunder_i_model *model, uint32_t b, sunder_error *err)
{
    const sunder_i_body *body = &model->body[b];
    size_t polygons = 0, rings = 0, corners = 0;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (!model->present[f]) continue;
        const sunder_shape *s = sunder_i_thing_shape(model, f);
        const size_t r = s->form->given.polygons ? s->form->given.poly_end[s->form->given.polygons - 1] : 0;
        polygons += s->form->given.polygons;
        rings += r;
        corners += r ? s->form->given.ring_end[r - 1] : 0;
    }
    double *xy = sunder_i_alloc(2 * corners, sizeof *xy);
    size_t *ring_end = sunder_i_alloc(rings, sizeof *ring_end), *poly_end = sunder_i_alloc(polygons, sizeof *poly_end);
    sunder_status status = xy && ring_end && poly_end ? SUNDER_OK : sunder_i_failure_cause(err);
    polygons = rings = corners = 0;
    for (uint32_t m = 0; !status && m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (!model->present[f]) continue;
        const sunder_shape *s = sunder_i_thing_shape(model, f);
        const size_t r = s->form->given.polygons ? s->form->given.poly_end[s->form->given.polygons - 1] : 0,
                     n = r ? s->form->given.ring_end[r - 1] : 0;
        for (size_t k = 0; k < s->form->given.polygons; k++) poly_end[polygons++] = rings + s->form->given.poly_end[k];
        for (size_t k = 0; k < r; k++) ring_end[rings + k] = corners + s->form->given.ring_end[k];
        if (n) memcpy(xy + 2 * corners, s->raw_xy, 2 * n * sizeof *xy);
        rings += r;
        corners += n;
    }
    if (!status)
        status =
            sunder_shape_from_rings(xy, ring_end, poly_end, polygons, SUNDER_VALIDITY_EVEN_ODD, &model->whole[b], err);
    sunder_i_free_all(xy, ring_end, poly_end);
    return status;
}

double sunder_i_farthest_near(const sunder_i_model *model, uint32_t p, uint32_t q)
{
    const sunder_i_body *a = &model->body[p], *b = &model->body[q];
    double reach = 0;
    for (int c = 0; c < 2; c++) {
        const double offset = b->origin[c] - a->origin[c];
        reach += sunder_i_max(fabs(a->box[c + 2] - offset - b->box[c]), fabs(a->box[c] - offset - b->box[c + 2]));
    }
    return reach + 2 * model->rules.gap;
}

double sunder_i_far_from_barrier(const sunder_i_model *model, uint32_t body, uint32_t part)
{
    const uint32_t features = (uint32_t)model->features, first = sunder_i_whole_of(model, part),
                   end = features + model->barriers->part_end[sunder_i_barrier_of(model, part)];
    double far = 0;
    for (uint32_t k = first; k < end; k++)
        far = sunder_i_max(far, sunder_i_farthest_near(model, body, model->body_of[k]));
    return 2 * (far + sunder_i_owed_most(model, first));
}

typedef struct unions_task {
    sunder_i_model *model;
    const uint32_t *body;
} unions_task;

static sunder_status unite_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const unions_task *u = context;
    for (size_t k = begin; k < end; k++) {
        const uint32_t b = u->body[k];
        if (u->model->body[b].members < 2 || u->model->whole[b]) continue;
        const sunder_status status = unite_members(u->model, b, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_model_unite(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err)
{
    unions_task u = {model, body};
    return sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_SHAPES, unite_some, &u, err);
}

void sunder_i_body_home_box(const sunder_i_model *model, const sunder_i_body *body, double box[4])
{
    sunder_i_box_clear(box);
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (model->present[f]) sunder_i_box_join(box, sunder_i_home_box(model, f));
    }
}

/* The sum of the members' weights, less the greatest possible rounding error of the sum. */
double sunder_i_weight_below(const sunder_i_model *model, const sunder_i_body *body)
{
    double w = 0;
    for (uint32_t k = 0; k < body->members; k++) {
        const uint32_t f = model->member[body->member + k];
        if (model->present[f]) w += sunder_i_feature(model->layer, f).weight; /* the others are hidden */
    }
    return body->members > 1 ? w * (1 - body->members * 0x1p-52) : w;
}
