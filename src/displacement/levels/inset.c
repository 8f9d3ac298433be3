/* Blocks with their outlines moved in.
 *
 *     |  b  |  The outline of a block of two, a and b, is moved in; the wall between them stays. A zone is cut off
 * along a |-----   each side of the outline: a strip of the depth of the inset. Where two sides turn to the right, as
 * here |        beneath b, their strips end in one corner, so that the moved sides meet; if they turn by more than 120
 * degrees, that corner would be far away, and a polygon fills the space between the strips.
 *
 * All members of a block are cut by the same zones. So a wall between two of them is cut at one point. */
#include "displacement/levels/block_outline.h"
#include "displacement/levels/levels.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* Moved sides meet in a corner if the cosine of their turn is at least this: up to 120 degrees. */
#define SHARPEST_TURN (-0.5)

/* Outside of the outline strips are longer by this multiple of the margin, at both ends: more than the tangent of half
 * of the sharpest turn. Where the outline turns inwards, adjacent strips then overlap up to their common corner. */
#define OVERLAP 2

typedef struct insetter {
    const sunder_layer *layer;
    const sunder_inset *how;
    const sunder_shape **from; /* [n] the shapes that are moved in */
    sunder_shape *disc;        /* around the disc of the least width; NULL: there is none */
    sunder_i_blocks blocks;
    sunder_shape **out;
} insetter;

/* ---- Zones ------------------------------------------------------------------------------------------------------- */

/* Scratch of one thread. */
typedef struct strips {
    sunder_i_block_outline outline;
    sunder_i_cuts all, near; /* the zones of a block; those near one member */
} strips;

/* A side with its direction u, its left normal n, and its length. */
typedef struct directed {
    const sunder_i_block_side *side;
    double u[2], n[2], length;
} directed;

static directed direct(const sunder_i_block_side *side)
{
    directed d = {.side = side};
    for (int c = 0; c < 2; c++) d.u[c] = side->to[c] - side->from[c];
    d.length = hypot(d.u[0], d.u[1]);
    for (int c = 0; c < 2; c++) d.u[c] /= d.length;
    d.n[0] = -d.u[1];
    d.n[1] = d.u[0];
    return d;
}

/* at + depth * (n + along * u) */
static void beside(const directed *d, const double at[2], double depth, double along, double out[2])
{
    for (int c = 0; c < 2; c++) out[c] = at[c] + depth * (d->n[c] + along * d->u[c]);
}

/* How the strips of a side and of the next one meet. */
typedef struct joint {
    double end[2], start[2]; /* the inner corners of the first strip at its end, and of the second at its start */
    bool gapes;              /* a polygon has to fill the space between them */
} joint;

static joint join_strips(const directed *a, const directed *b, double depth, double margin)
{
    const double turn = a->u[0] * b->u[1] - a->u[1] * b->u[0], cosine = a->u[0] * b->u[0] + a->u[1] * b->u[1];
    const double *corner = a->side->to, *other = b->side->from;
    joint j = {.gapes = false};
    const bool meet = hypot(other[0] - corner[0], other[1] - corner[1]) <= margin;
    const double bend = cosine > SHARPEST_TURN ? fabs(turn) / (1 + cosine) : 1; /* the tangent of half of the turn */
    const double room = sunder_i_min(a->length, b->length) / 4;
    if (meet && cosine > SHARPEST_TURN && (turn <= 0 || depth * bend <= room)) {
        for (int c = 0; c < 2; c++) j.end[c] = j.start[c] = corner[c] + depth * (a->n[c] + b->n[c]) / (1 + cosine);
        return j;
    }
    const double longer = turn < 0 ? sunder_i_min(bend, 1) : 0;
    j.gapes = !meet || (turn <= 0 && cosine <= SHARPEST_TURN);
    beside(a, corner, depth, longer, j.end);
    beside(b, other, depth, -longer, j.start);
    return j;
}

static bool add_polygon(sunder_i_cuts *cuts, const double *xy, size_t n)
{
    if (!sunder_i_reserve(&cuts->xy, &cuts->room, 2 * (cuts->corners + n), sizeof *cuts->xy) ||
        !sunder_i_reserve(&cuts->end, &cuts->end_room, cuts->n + 1, sizeof *cuts->end))
        return false;
    memcpy(cuts->xy + 2 * cuts->corners, xy, 2 * n * sizeof *xy);
    cuts->corners += n;
    cuts->end[cuts->n++] = cuts->corners;
    return true;
}

/* Fills the space between a strip that ends at `to` and one that begins at `from`. */
static bool add_fill(sunder_i_cuts *cuts, const double to[2], const double from[2], const joint *j)
{
    double corner[8] = {to[0], to[1], from[0], from[1], j->start[0], j->start[1], j->end[0], j->end[1]};
    double hull[10];
    const size_t n = sunder_i_convex_hull(corner, 4, hull);
    return n < 3 || add_polygon(cuts, hull, n);
}

/* Adds the strip along a side, and what fills the space between it and the next one. Strips begin somewhat outside of
 * the outline, so that rounded ends of sides leave nothing of it. */
static bool add_strip(const sunder_i_block_outline *outline, size_t k, double depth, sunder_i_cuts *cuts)
{
    const sunder_i_block_side *side = &outline->side[k];
    const directed own = direct(side);
    double strip[8];
    joint at_end = {.gapes = false};
    beside(&own, side->from, -outline->margin, OVERLAP, strip);
    beside(&own, side->to, -outline->margin, -OVERLAP, strip + 2);
    beside(&own, side->to, depth, 0, strip + 4);
    beside(&own, side->from, depth, 0, strip + 6);
    if (side->next != SUNDER_I_NO_SIDE) {
        const directed next = direct(&outline->side[side->next]);
        at_end = join_strips(&own, &next, depth, outline->margin);
        memcpy(strip + 4, at_end.end, sizeof at_end.end);
    }
    if (side->last != SUNDER_I_NO_SIDE) {
        const directed last = direct(&outline->side[side->last]);
        const joint at_start = join_strips(&last, &own, depth, outline->margin);
        memcpy(strip + 6, at_start.start, sizeof at_start.start);
    }
    if (!add_polygon(cuts, strip, 4)) return false;
    return !at_end.gapes || add_fill(cuts, side->to, outline->side[side->next].from, &at_end);
}

/* Lists the zones of the block whose boxes meet the box. */
static bool list_near(strips *s, const double box[4])
{
    s->near.n = s->near.corners = 0;
    for (size_t k = 0, first = 0; k < s->all.n; first = s->all.end[k++]) {
        double own[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
        for (size_t i = 2 * first; i < 2 * s->all.end[k]; i++) {
            own[i & 1] = sunder_i_min(own[i & 1], s->all.xy[i]);
            own[2 + (i & 1)] = sunder_i_max(own[2 + (i & 1)], s->all.xy[i]);
        }
        if (sunder_i_box_meet(own, box) && !add_polygon(&s->near, s->all.xy + 2 * first, s->all.end[k] - first))
            return false;
    }
    return true;
}

/* ---- Features ---------------------------------------------------------------------------------------------------- */

/* The smallest level that feature f has so far. */
static const sunder_shape *last_level(const insetter *t, size_t f, size_t level)
{
    while (level-- > 0)
        if (t->out[f * t->how->lengths + level]) return t->out[f * t->how->lengths + level];
    return t->from[f];
}

static sunder_status inset_feature(const insetter *t, strips *s, size_t f, size_t level, sunder_error *err)
{
    const sunder_shape *before = last_level(t, f, level);
    sunder_shape *shape = NULL;
    double box[4];
    bool may = false;
    if (!before || before->form->cleaned.polygons != 1) return SUNDER_OK;
    sunder_shape_box(before, box);
    if (!list_near(s, box)) return sunder_i_failure_cause(err);
    sunder_status status = sunder_i_shape_subtract(before, &s->near, &shape, err);
    if (!status && shape) status = sunder_i_cut_arms(t->layer->shape[f], t->disc, t->how->width, &shape, err);
    if (!status && shape) status = sunder_i_level_may_follow(before, shape, t->disc, &may, err);
    if (may) t->out[f * t->how->lengths + level] = shape;
    if (!may) sunder_shape_free(shape);
    return status;
}

static sunder_status inset_body(const insetter *t, strips *s, const sunder_i_body *body, sunder_error *err)
{
    const sunder_i_model *model = &t->blocks.model;
    sunder_status status = sunder_i_block_outline_find(model, body, t->from, &s->outline, err);
    for (size_t level = 0; level < t->how->lengths && !status; level++) {
        bool ok = true;
        s->all.n = s->all.corners = 0;
        for (size_t k = 0; k < s->outline.n && ok; k++) ok = add_strip(&s->outline, k, t->how->length[level], &s->all);
        if (!ok) return sunder_i_failure_cause(err);
        for (uint32_t m = 0; m < body->members && !status; m++)
            status = inset_feature(t, s, model->member[body->member + m], level, err);
    }
    return status;
}

static sunder_status inset_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const insetter *t = context;
    strips s = {0};
    sunder_status status = SUNDER_OK;
    for (size_t b = begin; b < end && !status; b++) {
        const sunder_i_body *body = &t->blocks.model.body[b];
        if (!sunder_i_is_barrier_body(&t->blocks.model, body)) status = inset_body(t, &s, body, err);
        if (!status && !sunder_i_step()) status = sunder_i_failure_cause(err);
    }
    sunder_i_block_outline_free(&s.outline);
    sunder_i_free_all(s.all.xy, s.all.end, s.near.xy, s.near.end);
    return status;
}

/* ---- The layer --------------------------------------------------------------------------------------------------- */

static sunder_status prepare_insetter(insetter *t, const sunder_layer_options *options, sunder_shape *const *from,
                                      sunder_error *err)
{
    const double width = t->how->width;
    t->from = sunder_i_alloc(t->layer->n, sizeof *t->from);
    if (!t->from) return sunder_i_failure_cause(err);
    for (size_t f = 0; f < t->layer->n; f++) {
        const sunder_shape *given = sunder_i_level_has_shape(t->layer, f) ? t->layer->shape[f] : NULL;
        t->from[f] = from && from[f] ? from[f] : given;
    }
    if (width > 0) {
        const sunder_status status = sunder_shape_disc(width / 2, SUNDER_I_ROUND_CORNERS, false, &t->disc, err);
        if (status) return status;
    }
    return sunder_i_blocks_find(t->layer, options, &t->blocks, err);
}

static sunder_status check_inset(const sunder_inset *inset, sunder_error *err)
{
    double last = 0;
    if (!(inset->width >= 0) || !isfinite(inset->width))
        return sunder_i_fail(err, SUNDER_EARG, "the least width, %g, is out of range", inset->width);
    for (size_t k = 0; k < inset->lengths; last = inset->length[k++])
        if (!(inset->length[k] > last) || !isfinite(inset->length[k]))
            return sunder_i_fail(err, SUNDER_EARG, "inset %zu, %g, is not greater than the one before", k + 1,
                                 inset->length[k]);
    return SUNDER_OK;
}

sunder_status sunder_layer_inset(const sunder_layer *layer, const sunder_layer_options *options,
                                 const sunder_inset *inset, sunder_shape *const *from, sunder_shape **shape,
                                 sunder_error *err)
{
    insetter t = {.layer = layer, .how = inset, .out = shape};
    const size_t n = layer->n * inset->lengths;
    for (size_t k = 0; k < n; k++) shape[k] = NULL;
    sunder_status status = check_inset(inset, err);
    if (!status) status = prepare_insetter(&t, options, from, err);
    if (!status)
        status = sunder_i_parallel(t.blocks.model.rules.threads, t.blocks.model.bodies, SUNDER_I_GRAIN_SHAPES,
                                   inset_some, &t, err);
    if (status) sunder_i_levels_drop(shape, n);
    sunder_i_blocks_free(&t.blocks);
    sunder_shape_free(t.disc);
    sunder_i_free((void *)t.from);
    return status;
}
