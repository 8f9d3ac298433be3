/* Bodies as the search sees them: convex pieces in doubles, a convex outline of each feature, and whole blocks as
 * shapes. */
#include "displacement/layer/model.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "base/watch.h"
#include "shape/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void cut_feature(sunder_i_model *model, sunder_i_body *body, uint32_t f, size_t *corner)
{
    const sunder_shape *shape = sunder_i_thing_shape(model, f);
    uint32_t from = 0;
    for (uint32_t p = 0; p < shape->pieces; p++) {
        sunder_i_body_piece *piece = &model->piece[model->pieces++];
        piece->feature = f;
        piece->corner = (uint32_t)*corner;
        piece->corners = shape->piece_end[p] - from;
        sunder_i_box_clear(piece->box);
        for (; from < shape->piece_end[p]; from++, ++*corner) {
            double *c = model->corner + 2 * *corner;
            for (int k = 0; k < 2; k++) c[k] = shape->xy[2 * shape->piece_vertex[from] + (uint32_t)k] - body->origin[k];
            sunder_i_box_include(piece->box, c);
        }
        const double beyond = sunder_i_reach_beyond(model, f);
        if (beyond > 0) sunder_i_box_grow(piece->box, beyond, piece->box);
        sunder_i_box_join(body->box, piece->box);
        body->pieces++;
    }
}

/* The corners of an anchor, a side, a seam or a joint; false if it is a piece of a shape. */
static bool anchor_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece, double *out)
{
    const uint32_t f = piece->feature;
    const bool barrier = sunder_i_is_barrier(model, f);
    const double *at = NULL;
    if (!barrier && model->anchor && piece == &model->anchor[f]) at = model->anchor_at + 2 * (size_t)f;
    if (!barrier && model->side_anchor && piece == &model->side_anchor[f]) at = model->side_at + 2 * (size_t)f;
    if (at) memcpy(out, at, 2 * sizeof *out);
    const sunder_i_body *body = &model->body[model->body_of[f]];
    for (uint32_t k = body->side; barrier && !at && k < body->side + body->sides; k++) {
        const sunder_i_side *side = &model->side[k];
        if (piece != &side->piece) continue;
        memcpy(out, side->from, 2 * sizeof *out);
        memcpy(out + 2, side->to, 2 * sizeof *out);
        at = out;
    }
    for (uint32_t k = body->seam; !at && k < body->seam + body->seams; k++) {
        if (piece != &model->seam[k]) continue;
        memcpy(out, model->seam_at + 8 * (size_t)k, 8 * sizeof *out);
        at = out;
    }
    for (uint32_t k = body->joint; !at && k < body->joint + body->joints; k++) {
        if (piece != &model->joint[k].piece) continue;
        memcpy(out, model->joint[k].at, sizeof model->joint[k].at);
        at = out;
    }
    return at;
}

void sunder_i_piece_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece, double *out)
{
    const uint32_t f = piece->feature;
    if (anchor_as_given(model, piece, out)) return;
    /* Pieces of a feature are in the order of the shape's. */
    const sunder_shape *shape = sunder_i_thing_shape(model, f);
    const sunder_i_body_piece *first = piece, *all = model->piece + model->body[model->body_of[f]].piece;
    while (first > all && first[-1].feature == f) first--;
    const size_t p = (size_t)(piece - first);
    const uint32_t from = p ? shape->piece_end[p - 1] : 0;
    for (uint32_t k = 0; k < piece->corners; k++)
        memcpy(out + 2 * (size_t)k, shape->xy + 2 * (size_t)shape->piece_vertex[from + k], 2 * sizeof *out);
}

static int by_place(const void *a, const void *b)
{
    const double *p = a, *q = b;
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return p[1] < q[1] ? -1 : p[1] > q[1];
}

/* Andrew's monotone chain. */
size_t sunder_i_convex_hull(double *p, size_t n, double *out)
{
    sunder_i_sort_few(p, n, 2 * sizeof *p, by_place);
    size_t m = 0;
    for (int pass = 0; pass < 2; pass++) {
        const size_t bottom = m;
        for (size_t k = 0; k < n; k++) {
            const double *c = p + 2 * (pass ? n - 1 - k : k);
            while (m >= bottom + 2) {
                const double *a = out + 2 * (m - 2), *b = out + 2 * (m - 1);
                if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0) break;
                m--;
            }
            memcpy(out + 2 * m++, c, 2 * sizeof *c);
        }
        m--; /* the last is the first of the other chain */
    }
    return m;
}

/* Does the feature consist of one piece with all its corners, which turns at each of them in doubles, too? */
static bool is_its_outline(const sunder_i_model *model, const sunder_shape *shape, const sunder_i_body_piece *piece)
{
    if (shape->pieces != 1 || piece->corners != shape->vertices || piece->corners < 3) return false;
    const double *corner = model->corner + 2 * (size_t)piece->corner, *b = corner + 2 * (size_t)(piece->corners - 1),
                 *a = b - 2;
    for (uint32_t k = 0; k < piece->corners; k++) {
        const double *c = corner + 2 * (size_t)k;
        if (!((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0)) return false;
        a = b;
        b = c;
    }
    return true;
}

typedef struct outlining {
    sunder_i_model *model;
    size_t hulls, capacity;
    double *point; /* room for the corners of a feature */
    size_t room;
} outlining;

/* The outline of a feature, from its corners in doubles; behind all others in model->corner. Most features are convex,
 * and their piece is it; it is the last one that was cut. */
static bool outline_feature(outlining *o, const sunder_i_body *body, uint32_t f, size_t *corner)
{
    sunder_i_model *model = o->model;
    const sunder_shape *shape = sunder_i_thing_shape(model, f);
    if (!sunder_i_is_barrier(model, f) && is_its_outline(model, shape, &model->piece[model->pieces - 1])) {
        model->outline[f] = (uint32_t)model->pieces - 1;
        return true;
    }
    if (!sunder_i_reserve(&model->hull, &o->capacity, o->hulls + 1, sizeof *model->hull) ||
        !sunder_i_reserve(&o->point, &o->room, 2 * (size_t)shape->vertices, sizeof *o->point))
        return false;
    for (uint32_t v = 0; v < 2 * shape->vertices; v++) o->point[v] = shape->xy[v] - body->origin[v & 1];
    model->outline[f] = UINT32_MAX - (uint32_t)o->hulls;
    sunder_i_body_piece *piece = &model->hull[o->hulls++];
    *piece = (sunder_i_body_piece){.corner = (uint32_t)*corner, .feature = f};
    piece->corners = (uint32_t)sunder_i_convex_hull(o->point, shape->vertices, model->corner + 2 * *corner);
    sunder_i_box_clear(piece->box);
    for (uint32_t k = 0; k < piece->corners; k++, ++*corner)
        sunder_i_box_include(piece->box, model->corner + 2 * *corner);
    return true;
}

static sunder_status find_runs(sunder_i_model *model, sunder_error *err)
{
    const size_t runs = model->pieces / SUNDER_I_RUN;
    model->run = sunder_i_alloc(4 * runs, sizeof *model->run);
    if (!model->run) return sunder_i_no_memory(err);
    for (size_t k = 0; k < runs; k++) sunder_i_box_clear(model->run + 4 * k);
    for (size_t k = 0; k < runs * SUNDER_I_RUN; k++)
        sunder_i_box_join(model->run + 4 * (k / SUNDER_I_RUN), model->piece[k].box);
    return SUNDER_OK;
}

/* All bodies, one after the other. False if memory is out. */
static bool cut_all(sunder_i_model *model)
{
    outlining o = {.model = model, .hulls = 1};
    bool ok = sunder_i_reserve(&model->hull, &o.capacity, o.hulls, sizeof *model->hull);
    if (ok) model->hull[0] = (sunder_i_body_piece){.corners = 0};
    for (size_t b = 0; b < model->bodies && ok; b++) {
        sunder_i_body *body = &model->body[b];
        body->piece = (uint32_t)model->pieces;
        body->clear = INFINITY;
        sunder_i_box_clear(body->box);
        const uint32_t first = model->member[body->member];
        memcpy(body->origin, sunder_i_home_box(model, first), sizeof body->origin);
        for (uint32_t k = 0; k < body->members && ok; k++) {
            const uint32_t f = model->member[body->member + k];
            model->outline[f] = UINT32_MAX;
            if (!model->present[f]) continue;
            cut_feature(model, body, f, &model->corners);
            ok = sunder_i_step() && outline_feature(&o, body, f, &model->corners);
        }
        if (body->pieces > model->most_pieces) model->most_pieces = body->pieces;
    }
    sunder_i_free(o.point);
    return ok && sunder_i_trim(&model->hull, o.hulls, sizeof *model->hull);
}

sunder_status sunder_i_model_cut(sunder_i_model *model, sunder_error *err)
{
    size_t pieces = 0, corners = 0;
    for (size_t f = 0; f < model->things; f++)
        if (model->present[f]) {
            const sunder_shape *shape = sunder_i_thing_shape(model, f);
            pieces += shape->pieces;
            if (shape->pieces) corners += shape->piece_end[shape->pieces - 1];
            corners += shape->vertices + 1;
        }
    if (pieces >= UINT32_MAX || corners >= UINT32_MAX)
        return sunder_i_fail(err, SUNDER_ESIZE, "too many corners: %zu", corners);
    model->piece = sunder_i_alloc(pieces, sizeof *model->piece);
    model->corner = sunder_i_alloc(2 * corners, sizeof *model->corner);
    model->outline = sunder_i_alloc(model->things, sizeof *model->outline);
    model->whole = sunder_i_calloc(model->bodies, sizeof *model->whole);
    if (!model->piece || !model->corner || !model->outline || !model->whole || !cut_all(model))
        return sunder_i_no_memory(err);
    const sunder_status status = find_runs(model, err);
    return status ? status : sunder_i_inclusion_walls(model, err);
}

/* ---- Whole blocks ------------------------------------------------------------------------------------------------ */

const sunder_shape *sunder_i_model_shape(const sunder_i_model *model, uint32_t body)
{
    const sunder_i_body *b = &model->body[body];
    if (b->members > 1) return model->whole[body];
    return model->present[model->member[b->member]] ? sunder_i_thing_shape(model, model->member[b->member]) : NULL;
}

/* The members' rings as given, one after the other: a polygonal set may have members that touch and overlap. */
static sunder_status unite(sunder_i_model *model, uint32_t b, sunder_error *err)
{
    const sunder_i_body *body = &model->body[b];
    size_t polygons = 0, rings = 0, corners = 0;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (!model->present[f]) continue;
        const sunder_shape *s = sunder_i_thing_shape(model, f);
        const size_t r = s->raw_polygons ? s->raw_poly_end[s->raw_polygons - 1] : 0;
        polygons += s->raw_polygons;
        rings += r;
        corners += r ? s->raw_ring_end[r - 1] : 0;
    }
    double *xy = sunder_i_alloc(2 * corners, sizeof *xy);
    size_t *ring_end = sunder_i_alloc(rings, sizeof *ring_end), *poly_end = sunder_i_alloc(polygons, sizeof *poly_end);
    sunder_status status = xy && ring_end && poly_end ? SUNDER_OK : sunder_i_no_memory(err);
    polygons = rings = corners = 0;
    for (uint32_t m = 0; !status && m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (!model->present[f]) continue;
        const sunder_shape *s = sunder_i_thing_shape(model, f);
        const size_t r = s->raw_polygons ? s->raw_poly_end[s->raw_polygons - 1] : 0, n = r ? s->raw_ring_end[r - 1] : 0;
        for (size_t k = 0; k < s->raw_polygons; k++) poly_end[polygons++] = rings + s->raw_poly_end[k];
        for (size_t k = 0; k < r; k++) ring_end[rings + k] = corners + s->raw_ring_end[k];
        if (n) memcpy(xy + 2 * corners, s->raw_xy, 2 * n * sizeof *xy);
        rings += r;
        corners += n;
    }
    if (!status)
        status =
            sunder_shape_from_rings(xy, ring_end, poly_end, polygons, SUNDER_VALIDITY_EVEN_ODD, &model->whole[b], err);
    sunder_i_free(xy);
    sunder_i_free(ring_end);
    sunder_i_free(poly_end);
    return status;
}

double sunder_i_farthest_near(const sunder_i_model *model, uint32_t p, uint32_t q)
{
    const sunder_i_body *a = &model->body[p], *b = &model->body[q];
    double reach = 0;
    for (int c = 0; c < 2; c++) {
        const double offset = b->origin[c] - a->origin[c];
        reach += fmax(fabs(a->box[c + 2] - offset - b->box[c]), fabs(a->box[c] - offset - b->box[c + 2]));
    }
    return reach + 2 * model->rules.gap;
}

typedef struct uniting {
    sunder_i_model *model;
    const uint32_t *body;
} uniting;

static sunder_status unite_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const uniting *u = context;
    for (size_t k = begin; k < end; k++) {
        const uint32_t b = u->body[k];
        if (u->model->body[b].members < 2 || u->model->whole[b]) continue;
        const sunder_status status = unite(u->model, b, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_model_unite(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err)
{
    uniting u = {model, body};
    return sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_SHAPES, unite_some, &u, err);
}

/* Members' weights are added, and what that may round by taken off. */
double sunder_i_weight_below(const sunder_i_model *model, const sunder_i_body *body)
{
    double w = 0;
    for (uint32_t k = 0; k < body->members; k++)
        w += sunder_i_feature(model->layer, model->member[body->member + k])->weight;
    return body->members > 1 ? w * (1 - body->members * 0x1p-52) : w;
}
