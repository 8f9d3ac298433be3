/* The data of a body that the search uses: its convex pieces in doubles, the anchors of its members, and their convex
 * hulls.
 *
 * The pieces of a whole layer would take more memory than its shapes. Most bodies of a large layer never need their
 * pieces, since they are in no conflict and near none that is. So the pieces of a body are made at their first use.
 * They depend on the body alone, so it does not matter which thread makes them; if several threads make them at the
 * same time, the first one publishes its result and the others use that. Pieces remain until the model is freed. If
 * they take much memory they are freed when a stage ends and no code refers to them (sunder_i_pieces_forget()): the
 * next stage needs only some of them, and making these again costs little compared with the search. They are allocated
 * from an arena, which is freed at once. */
#include "displacement/layer/far_corners.h"

#include "base/invariant.h"
#include "base/sort.h"
#include "shape/shape.h"

#include <pthread.h>
#include <string.h>

struct sunder_i_pieces_store {
    pthread_mutex_t lock;
    sunder_i_arena arena;
    size_t held; /* bytes */
};

/* ---- Bodies with far corners ------------------------------------------------------------------------------------- */

static uint32_t corners_of(const sunder_shape *shape)
{
    return shape->pieces ? shape->piece_end[shape->pieces - 1] : 0;
}

/* Writes the corners of piece p of a body with far corners (far_corners.c) to `corner` and extends `box` by them.
 * Returns the number of corners. */
static uint32_t take_far_corners(const sunder_i_body *body, const sunder_shape *shape, uint32_t p, double *corner,
                                 double box[4])
{
    uint32_t n = 0;
    for (uint32_t k = p ? shape->piece_end[p - 1] : 0; k < shape->piece_end[p]; k++)
        n += (uint32_t)sunder_i_far_corner(body, shape, p, k, corner + 2 * (size_t)n);
    for (uint32_t k = 0; k < n; k++) sunder_i_box_include(box, corner + 2 * (size_t)k);
    return n;
}

/* Writes the corners of all pieces of a shape in a body with far corners to `corner`. Returns their number. */
static size_t take_all_far_corners(const sunder_i_body *body, const sunder_shape *shape, double *corner)
{
    double box[4];
    size_t n = 0;
    sunder_i_box_clear(box);
    for (uint32_t p = 0; p < shape->pieces; p++) n += take_far_corners(body, shape, p, corner + 2 * n, box);
    return n;
}

size_t sunder_i_outline_room(const sunder_i_model *model, uint32_t thing)
{
    const sunder_shape *shape = sunder_i_thing_shape(model, thing);
    const bool far = model->body[model->body_of[thing]].far;
    return far ? SUNDER_I_FAR_MOST * (size_t)corners_of(shape) : shape->vertices;
}

/* ---- Outlines ---------------------------------------------------------------------------------------------------- */

static int by_place(const void *a, const void *b)
{
    const double *p = a, *q = b;
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return p[1] < q[1] ? -1 : p[1] > q[1];
}

/* Do the corners a, b, c make a left turn at b, as computed in doubles? */
static inline bool turns_left(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0;
}

/* By Andrew's monotone chain. */
size_t sunder_i_convex_hull(double *point, size_t n, double *out)
{
    sunder_i_sort_few(point, n, 2 * sizeof *point, by_place);
    size_t m = 0;
    for (int pass = 0; pass < 2; pass++) {
        const size_t bottom = m;
        for (size_t k = 0; k < n; k++) {
            const double *c = point + 2 * (pass ? n - 1 - k : k);
            while (m >= bottom + 2 && !turns_left(out + 2 * (m - 2), out + 2 * (m - 1), c)) m--;
            memcpy(out + 2 * m++, c, 2 * sizeof *c);
        }
        m--; /* the last point is also the first of the other chain */
    }
    return m;
}

/* Sets out to vertex v of a shape, relative to the body's origin. Both coordinates are computed before either is
 * stored, so that one store writes both: a later load of both at once would stall on two separate stores. */
static inline void from_origin(const sunder_shape *shape, uint32_t v, const sunder_i_body *body, double out[2])
{
    const double x = sunder_i_from_origin(body, shape->xy[2 * (size_t)v], 0),
                 y = sunder_i_from_origin(body, shape->xy[2 * (size_t)v + 1], 1);
    out[0] = x;
    out[1] = y;
}

/* Is the convex piece `corner` of the shape its own convex hull? It is if it has all vertices of the shape and turns
 * left at each of them, also as computed in doubles. This holds for most features, as they are convex. */
static bool is_its_outline(const sunder_shape *shape, const double *corner)
{
    const uint32_t n = shape->vertices;
    if (n < 3) return false;
    const double *b = corner + 2 * (size_t)(n - 1), *a = b - 2;
    for (uint32_t k = 0; k < n; k++) {
        const double *c = corner + 2 * (size_t)k;
        if (!turns_left(a, b, c)) return false;
        a = b;
        b = c;
    }
    return true;
}

size_t sunder_i_outline_of(const sunder_i_model *model, uint32_t thing, double *point, double *out)
{
    const sunder_shape *shape = sunder_i_thing_shape(model, thing);
    const sunder_i_body *body = &model->body[model->body_of[thing]];
    const uint32_t n = shape->vertices;
    if (!sunder_i_is_barrier(model, thing) && !body->far && shape->pieces == 1 && shape->piece_end[0] == n) {
        for (uint32_t k = 0; k < n; k++)
            from_origin(shape, sunder_i_piece_vertices(shape)[k], body, out + 2 * (size_t)k);
        if (is_its_outline(shape, out)) return n;
    }
    if (body->far) return sunder_i_convex_hull(point, take_all_far_corners(body, shape, point), out);
    for (uint32_t v = 0; v < n; v++) from_origin(shape, v, body, point + 2 * (size_t)v);
    return sunder_i_convex_hull(point, n, out);
}

/* ---- Making ------------------------------------------------------------------------------------------------------ */

/* Makes the convex pieces of member f of the body. Advances *piece and *corner past what was written. */
static void cut_member(const sunder_i_model *model, const sunder_i_body *body, uint32_t f, sunder_i_body_piece **piece,
                       double **corner)
{
    const sunder_shape *shape = sunder_i_thing_shape(model, f);
    const double beyond = sunder_i_reach_beyond(model, f);
    uint32_t from = 0;
    for (uint32_t p = 0; p < shape->pieces; p++) {
        sunder_i_body_piece *to = (*piece)++;
        *to = (sunder_i_body_piece){.corner = *corner, .corners = shape->piece_end[p] - from, .feature = f};
        sunder_i_box_clear(to->box);
        if (body->far) to->corners = take_far_corners(body, shape, p, *corner, to->box);
        if (body->far) *corner += 2 * (size_t)to->corners;
        for (; from < shape->piece_end[p] && !body->far; from++, *corner += 2) {
            from_origin(shape, sunder_i_piece_vertices(shape)[from], body, *corner);
            sunder_i_box_include(to->box, *corner);
        }
        from = shape->piece_end[p];
        if (beyond > 0) sunder_i_box_grow(to->box, beyond, to->box);
    }
}

static void put_anchor(const sunder_i_model *model, const sunder_i_body *body, uint32_t f, sunder_i_body_piece *anchor)
{
    *anchor = (sunder_i_body_piece){.corner = anchor->box, .feature = f};
    if (sunder_i_is_barrier(model, f) || !model->present[f]) return;
    anchor->corners = 1;
    for (int c = 0; c < 4; c++) anchor->box[c] = model->anchor_at[2 * (size_t)f + (c & 1)] - body->origin[c & 1];
}

/* Returns the number of runs of SUNDER_I_RUN pieces that lie entirely within the body's pieces. *first is the number of
 * the first of them. */
static uint32_t count_runs(const sunder_i_body *body, uint32_t *first)
{
    const uint32_t end = (body->piece + body->pieces) / SUNDER_I_RUN;
    *first = body->piece / SUNDER_I_RUN + (body->piece % SUNDER_I_RUN != 0);
    return end > *first ? end - *first : 0;
}

static void box_runs(const sunder_i_body *body, const sunder_i_body_piece *piece, uint32_t first, uint32_t runs,
                     double *box)
{
    for (uint32_t k = 0; k < runs; k++, box += 4) {
        sunder_i_box_clear(box);
        const uint32_t begin = (first + k) * SUNDER_I_RUN - body->piece;
        for (uint32_t l = begin; l < begin + SUNDER_I_RUN; l++) sunder_i_box_join(box, piece[l].box);
    }
}

#ifndef NDEBUG
static const char *check_pieces(const sunder_i_body *body, const sunder_i_body_pieces *made)
{
    double box[4];
    sunder_i_box_clear(box);
    for (uint32_t k = 0; k < body->pieces; k++) sunder_i_box_join(box, made->piece[k].box);
    for (int c = 0; c < 4; c++)
        if (body->box[c] != box[c]) return "a body's box is not that of its pieces";
    return NULL;
}
#endif

/* Allocates `bytes` from the store's arena, under its lock. Returns NULL if memory is out. */
static void *take_room(struct sunder_i_pieces_store *store, size_t bytes)
{
    pthread_mutex_lock(&store->lock);
    void *room = sunder_i_arena_alloc(&store->arena, bytes, 1);
    store->held += bytes;
    pthread_mutex_unlock(&store->lock);
    return room;
}

/* Makes the struct, the pieces, anchors, corners and boxes of runs of a body, in one allocation. Returns NULL if memory
 * is out. */
static sunder_i_body_pieces *make_pieces(const sunder_i_model *model, const sunder_i_body *body)
{
    size_t corners = 0;
    uint32_t first_run;
    const uint32_t runs = count_runs(body, &first_run), anchors = model->anchor_at ? body->members : 0;
    const uint32_t *member = model->member + body->member;
    for (uint32_t m = 0; m < body->members; m++)
        if (model->present[member[m]]) corners += corners_of(sunder_i_thing_shape(model, member[m]));
    if (body->far) corners *= SUNDER_I_FAR_MOST;
    const size_t of_pieces = ((size_t)body->pieces + anchors) * sizeof(sunder_i_body_piece),
                 of_doubles = (2 * corners + 4 * (size_t)runs) * sizeof(double);
    sunder_i_body_pieces *made = take_room(model->store, sizeof *made + of_pieces + of_doubles);
    if (!made) return NULL;
    sunder_i_body_piece *piece = (sunder_i_body_piece *)(made + 1), *anchor = piece + body->pieces, *at = piece;
    double *corner = (double *)(anchor + anchors), *run = corner + 2 * corners;
    *made = (sunder_i_body_pieces){
        .piece = piece, .anchor = model->anchor_at ? anchor : NULL, .run = run, .first_run = first_run};
    for (uint32_t m = 0; m < body->members; m++) {
        if (model->present[member[m]]) cut_member(model, body, member[m], &at, &corner);
        if (anchors) put_anchor(model, body, member[m], &anchor[m]);
    }
    box_runs(body, piece, first_run, runs, run);
    SUNDER_I_CHECK(check_pieces(body, made), body->pieces);
    return made;
}

const sunder_i_body_pieces *sunder_i_pieces_make(const sunder_i_model *model, const sunder_i_body *body)
{
    sunder_i_body_pieces *made = make_pieces(model, body), *before = NULL;
    if (!made || atomic_compare_exchange_strong(&model->made[body - model->body], &before, made)) return made;
    return before;
}

/* Makes the convex hulls of the body's members: structs, corners and scratch in one allocation. Returns NULL if memory
 * is out. */
static sunder_i_body_piece *make_outlines(const sunder_i_model *model, const sunder_i_body *body)
{
    const uint32_t *member = model->member + body->member;
    size_t corners = 0, most = 0;
    for (uint32_t m = 0; m < body->members; m++) {
        const size_t n = model->present[member[m]] ? sunder_i_outline_room(model, member[m]) : 0;
        corners += n + 1;
        most = n > most ? n : most;
    }
    sunder_i_body_piece *outline =
        sunder_i_alloc(body->members * sizeof *outline + 2 * (corners + most) * sizeof(double), 1);
    if (!outline) return NULL;
    double *corner = (double *)(outline + body->members), *point = corner + 2 * corners;
    for (uint32_t m = 0; m < body->members; m++) {
        outline[m] = (sunder_i_body_piece){.corner = corner, .feature = member[m]};
        sunder_i_box_clear(outline[m].box);
        if (model->present[member[m]])
            outline[m].corners = (uint32_t)sunder_i_outline_of(model, member[m], point, corner);
        for (uint32_t k = 0; k < outline[m].corners; k++, corner += 2) sunder_i_box_include(outline[m].box, corner);
    }
    return outline;
}

const sunder_i_body_piece *sunder_i_outlines_of(const sunder_i_model *model, const sunder_i_body *body)
{
    if (!sunder_i_pieces_of(model, body)) return NULL;
    sunder_i_body_pieces *of = atomic_load(&model->made[body - model->body]);
    sunder_i_body_piece *before = atomic_load_explicit(&of->outline, memory_order_acquire);
    if (before) return before;
    sunder_i_body_piece *outline = make_outlines(model, body);
    if (!outline || atomic_compare_exchange_strong(&of->outline, &before, outline)) return outline;
    sunder_i_free(outline);
    return before;
}

/* ---- Storage: when pieces are kept and freed --------------------------------------------------------------------- */

bool sunder_i_pieces_begin(sunder_i_model *model)
{
    model->made = sunder_i_calloc(model->bodies, sizeof *model->made);
    model->store = sunder_i_calloc(1, sizeof *model->store);
    if (!model->made || !model->store) return false;
    sunder_i_arena_init(&model->store->arena);
    pthread_mutex_init(&model->store->lock, NULL);
    return true;
}

static void forget_pieces(sunder_i_model *model)
{
    for (size_t b = 0; b < model->bodies; b++) {
        sunder_i_body_pieces *pieces = atomic_load_explicit(&model->made[b], memory_order_relaxed);
        if (!pieces) continue;
        sunder_i_free(pieces->outline);
        atomic_store_explicit(&model->made[b], NULL, memory_order_relaxed);
    }
    sunder_i_arena_free(&model->store->arena);
    model->store->held = 0;
}

void sunder_i_pieces_forget(sunder_i_model *model, size_t most)
{
    if (model->store->held > most) forget_pieces(model);
}

void sunder_i_pieces_end(sunder_i_model *model)
{
    if (model->made && model->store) {
        forget_pieces(model);
        pthread_mutex_destroy(&model->store->lock);
    }
    sunder_i_free_all(model->made, model->store);
}

/* ---- Corners as they were given ---------------------------------------------------------------------------------- */

/* If `piece` is an anchor, a side, or the cover of a diagonal or of a shared wall, writes its corners as they were
 * given to `out`. Returns false if it is a convex piece of a shape. */
static bool anchor_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece, double *out)
{
    const uint32_t f = piece->feature;
    const bool barrier = sunder_i_is_barrier(model, f);
    const double *at = NULL;
    if (!barrier && piece->corner == piece->box) at = model->anchor_at;
    if (!barrier && model->side_anchor && piece == &model->side_anchor[f]) at = model->side_at;
    if (at) memcpy(out, at + 2 * (size_t)f, 2 * sizeof *out);
    const sunder_i_body *body = &model->body[model->body_of[f]];
    for (uint32_t k = body->has->side; barrier && !at && k < body->has->side + body->has->sides; k++) {
        const sunder_i_side *side = &model->side[k];
        if (piece != &side->piece) continue;
        memcpy(out, side->from, 2 * sizeof *out);
        memcpy(out + 2, side->to, 2 * sizeof *out);
        at = out;
    }
    for (uint32_t k = body->has->diagonal_cover; !at && k < body->has->diagonal_cover + body->has->diagonal_covers;
         k++) {
        if (piece != &model->diagonal_cover[k]) continue;
        sunder_i_diagonal_cover_corners(sunder_i_thing_shape(model, f), model->diagonal_cover_vertices + 4 * (size_t)k,
                                        out);
        at = out;
    }
    for (uint32_t k = body->has->wall_cover; !at && k < body->has->wall_cover + body->has->wall_covers; k++) {
        if (piece != &model->wall_cover[k].piece) continue;
        memcpy(out, model->wall_cover[k].at, sizeof model->wall_cover[k].at);
        at = out;
    }
    return at;
}

/* Sets [*from, *end) to the corners of a convex piece among those of its feature's shape. Pieces are in the order of
 * the shape's pieces; and since the caller has a piece of this body, the body's pieces have been made. */
static void find_corners(const sunder_i_model *model, const sunder_i_body_piece *piece, uint32_t *from, uint32_t *end)
{
    const uint32_t f = piece->feature;
    const sunder_shape *shape = sunder_i_thing_shape(model, f);
    const sunder_i_body_piece *first = piece, *all = atomic_load(&model->made[model->body_of[f]])->piece;
    while (first > all && first[-1].feature == f) first--;
    const size_t p = (size_t)(piece - first);
    *from = p ? shape->piece_end[p - 1] : 0;
    *end = shape->piece_end[p];
}

size_t sunder_i_corners_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece)
{
    const uint32_t b = model->body_of[piece->feature];
    const sunder_i_body *body = &model->body[b];
    const sunder_i_body_pieces *made = body->far ? atomic_load(&model->made[b]) : NULL;
    uint32_t from, end;
    if (!made || piece < made->piece || piece >= made->piece + body->pieces) return piece->corners;
    find_corners(model, piece, &from, &end);
    return end - from;
}

void sunder_i_piece_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece, double *out)
{
    uint32_t from, end;
    if (anchor_as_given(model, piece, out)) return;
    const sunder_shape *shape = sunder_i_thing_shape(model, piece->feature);
    find_corners(model, piece, &from, &end);
    for (uint32_t k = 0; k < end - from; k++)
        memcpy(out + 2 * (size_t)k, shape->xy + 2 * (size_t)sunder_i_piece_vertices(shape)[from + k], 2 * sizeof *out);
}
