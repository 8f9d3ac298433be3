/* Features cut back at barriers. */
#include "displacement/levels/levels.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/watch.h"
#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>

/* Zones are larger than the required distance by MARGIN of the largest coordinate, some hundred units in the last
 * place, so that rounding does not bring corners too near. */
#define MARGIN 0x1p-45

/* The disc of the required distance is replaced by a regular polygon around it. */
enum { ROUND_CORNERS = SUNDER_I_ROUND_CORNERS };

typedef struct trimmer {
    const sunder_layer *layer;
    sunder_trimming how;
    sunder_i_barriers barriers;
    uint32_t *barrier_of;            /* [pieces] the barrier of each piece */
    sunder_i_rtree tree;             /* over the pieces' boxes */
    sunder_shape *disc;              /* around the disc of the least width; NULL: there is none */
    double round[2 * ROUND_CORNERS]; /* the corners of a regular polygon around the unit disc */
    sunder_i_blocks blocks;
    sunder_shape **out;
} trimmer;

/* ---- Zones ------------------------------------------------------------------------------------------------------- */

/* Scratch of one thread. */
typedef struct zones {
    sunder_i_cuts cuts;
    sunder_i_list near;    /* pieces of barriers */
    sunder_i_list crossed; /* barriers that cross the feature; ascending */
    double *point;
    size_t room;
} zones;

static void corner_of(const sunder_i_piece_of *piece, uint32_t k, double xy[2])
{
    const double *at = piece->xy + 2 * (size_t)k;
    if (piece->shape) {
        const uint32_t first = piece->piece ? piece->shape->piece_end[piece->piece - 1] : 0;
        at = piece->shape->xy + 2 * (size_t)sunder_i_piece_vertices(piece->shape)[first + k];
    }
    xy[0] = at[0];
    xy[1] = at[1];
}

/* Adds the zone of a piece to the cuts: its sum with the polygon around the disc of this radius. Returns false if
 * memory is out. */
static bool add_zone(const trimmer *t, zones *z, const sunder_i_piece_of *piece, double radius)
{
    const uint32_t corners = sunder_i_piece_corners(piece);
    const size_t points = (size_t)corners * ROUND_CORNERS;
    sunder_i_cuts *cuts = &z->cuts;
    if (!sunder_i_reserve(&z->point, &z->room, 2 * points, sizeof *z->point) ||
        !sunder_i_reserve(&cuts->xy, &cuts->room, 2 * (cuts->corners + points + 1), sizeof *cuts->xy) ||
        !sunder_i_reserve(&cuts->end, &cuts->end_room, cuts->n + 1, sizeof *cuts->end))
        return false;
    for (uint32_t k = 0; k < corners; k++) {
        double at[2];
        corner_of(piece, k, at);
        for (size_t c = 0; c < 2 * ROUND_CORNERS; c++)
            z->point[2 * (size_t)k * ROUND_CORNERS + c] = at[c & 1] + radius * t->round[c];
    }
    cuts->corners += sunder_i_convex_hull(z->point, points, cuts->xy + 2 * cuts->corners);
    cuts->end[cuts->n++] = cuts->corners;
    return true;
}

/* Returns the margin of zones that reach a box. */
static double margin_of(const double box[4])
{
    double most = 0;
    for (int c = 0; c < 4; c++) most = sunder_i_max(most, fabs(box[c]));
    return most * MARGIN;
}

/* Lists the pieces whose zones may reach a box. Returns false if memory is out. */
static bool list_pieces(const trimmer *t, zones *z, const double box[4], double margin)
{
    double about[4];
    z->near.n = 0;
    sunder_i_box_grow(box, t->barriers.farthest + margin, about);
    if (!sunder_i_rtree_query(&t->tree, about, &z->near)) return false;
    if (z->near.n) qsort(z->near.item, z->near.n, sizeof *z->near.item, sunder_i_by_number);
    return true;
}

/* Lists the barriers with a line or point, among the listed pieces, that meets the interior of the shape. */
static sunder_status list_crossed(const trimmer *t, zones *z, const sunder_shape *shape, sunder_error *err)
{
    sunder_i_interior_cover cover = {0};
    sunder_status status = sunder_i_interior_cover_make(shape, &cover, err);
    z->crossed.n = 0;
    for (size_t k = 0; k < z->near.n && !status; k++) {
        const uint32_t barrier = t->barrier_of[z->near.item[k]];
        const sunder_i_piece_of *piece = &t->barriers.piece[z->near.item[k]];
        sunder_shape *line = NULL;
        bool crosses = false;
        if (sunder_i_piece_has_area(piece) || sunder_i_set_has(z->crossed.item, z->crossed.n, barrier)) continue;
        status = sunder_i_shape_of_pieces(piece, 1, &line, err);
        if (!status) status = sunder_i_overlap(line, NULL, cover.shape ? cover.shape : shape, NULL, &crosses, err);
        sunder_shape_free(line);
        /* Pieces are sorted, and barriers with them. */
        if (!status && crosses && !sunder_i_list_push(&z->crossed, barrier)) status = sunder_i_failure_cause(err);
    }
    sunder_i_interior_cover_free(&cover);
    return status;
}

/* Adds the zones of the listed pieces, for features of one class, that reach a box, except those of crossed barriers if
 * these are kept. Returns false if memory is out. */
static bool add_zones(const trimmer *t, zones *z, uint32_t of, const double box[4], double margin)
{
    bool ok = true;
    z->cuts.n = z->cuts.corners = 0;
    for (size_t k = 0; k < z->near.n && ok; k++) {
        const uint32_t piece = z->near.item[k], barrier = t->barrier_of[piece];
        const double radius = sunder_i_rounded_up(sunder_i_required(&t->barriers, barrier, of)) + margin;
        double own[4];
        if (t->layer->crossed == SUNDER_CROSSED_KEEP && sunder_i_set_has(z->crossed.item, z->crossed.n, barrier))
            continue;
        sunder_i_piece_box(&t->barriers.piece[piece], own);
        sunder_i_box_grow(own, radius, own);
        if (sunder_i_box_meet(own, box)) ok = add_zone(t, z, &t->barriers.piece[piece], radius);
    }
    return ok;
}

/* ---- Features ---------------------------------------------------------------------------------------------------- */

/* Does the trimmed shape meet the conditions? */
static sunder_status may_stay(const trimmer *t, const sunder_shape *shape, const sunder_shape *trimmed, bool *may,
                              sunder_error *err)
{
    *may = sunder_shape_area(trimmed) >= t->how.keep * sunder_shape_area(shape);
    return *may ? sunder_i_level_may_follow(shape, trimmed, t->disc, may, err) : SUNDER_OK;
}

/* Is the feature the only one of its block? */
static bool stands_alone(const trimmer *t, size_t f)
{
    const sunder_i_model *model = &t->blocks.model;
    return model->body[model->body_of[f]].members == 1;
}

static sunder_status trim_feature(const trimmer *t, zones *z, size_t f, sunder_error *err)
{
    const sunder_shape *shape = t->layer->shape[f];
    sunder_shape *trimmed = NULL;
    double box[4];
    bool may = false;
    if (!sunder_i_level_has_shape(t->layer, f)) return SUNDER_OK;
    sunder_shape_box(shape, box);
    const double margin = margin_of(box);
    if (!list_pieces(t, z, box, margin)) return sunder_i_failure_cause(err);
    if (z->near.n == 0) return SUNDER_OK;
    sunder_status status = SUNDER_OK;
    if (t->layer->crossed != SUNDER_CROSSED_TRIM)
        status = list_crossed(t, z, sunder_i_original_shape(t->layer, f), err);
    if (status || (t->layer->crossed == SUNDER_CROSSED_HIDE && z->crossed.n)) return status;
    if (!add_zones(t, z, t->layer->gaps ? t->layer->gaps->of[f] : 0, box, margin)) return sunder_i_failure_cause(err);
    if (z->cuts.n == 0) return SUNDER_OK;
    status = sunder_i_shape_subtract(shape, &z->cuts, &trimmed, err);
    if (!status && trimmed && stands_alone(t, f))
        status = sunder_i_trim_along(shape, t->how.keep, margin, t->disc, &trimmed, err);
    if (!status && trimmed) status = sunder_i_cut_arms(shape, t->disc, t->how.width, &trimmed, err);
    if (!status && trimmed) status = may_stay(t, shape, trimmed, &may, err);
    if (may && !status)
        t->out[f] = trimmed;
    else
        sunder_shape_free(trimmed);
    return status;
}

static sunder_status trim_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const trimmer *t = context;
    zones z = {0};
    sunder_status status = SUNDER_OK;
    for (size_t f = begin; f < end && !status; f++) {
        status = trim_feature(t, &z, f, err);
        if (!status && !sunder_i_step()) status = sunder_i_failure_cause(err);
    }
    sunder_i_free_all(z.cuts.xy, z.cuts.end, z.near.item, z.crossed.item, z.point);
    return status;
}

/* ---- The layer --------------------------------------------------------------------------------------------------- */

/* Builds the tree over the pieces of all barriers. Returns false if memory is out. */
static sunder_status index_pieces(trimmer *t, sunder_error *err)
{
    const sunder_i_barriers *b = &t->barriers;
    const size_t n = b->parts ? b->piece_end[b->parts - 1] : 0;
    double *box = sunder_i_alloc(4 * n, sizeof *box);
    t->barrier_of = sunder_i_alloc(n, sizeof *t->barrier_of);
    if (!box || !t->barrier_of) {
        sunder_i_free(box);
        return sunder_i_failure_cause(err);
    }
    for (uint32_t part = 0, k = 0; part < b->parts; part++)
        for (; k < b->piece_end[part]; k++) {
            sunder_i_piece_box(&b->piece[k], box + 4 * (size_t)k);
            t->barrier_of[k] = b->barrier[part];
        }
    const sunder_status status = sunder_i_rtree_build(box, NULL, n, &t->tree, err);
    sunder_i_free(box);
    return status;
}

static sunder_status prepare_trimmer(trimmer *t, const sunder_i_rules *rules, sunder_error *err)
{
    const double pi = acos(-1), circumradius = 1 / cos(pi / ROUND_CORNERS);
    for (size_t k = 0; k < ROUND_CORNERS; k++) {
        const double angle = (2 * (double)k + 1) * pi / ROUND_CORNERS;
        t->round[2 * k] = circumradius * cos(angle);
        t->round[2 * k + 1] = circumradius * sin(angle);
    }
    sunder_i_rules bare = *rules;
    bare.has_full = false;
    sunder_status status = sunder_i_barriers_make(t->layer, &bare, &t->barriers, err);
    if (!status) status = index_pieces(t, err);
    if (!status && t->how.width > 0) status = sunder_shape_disc(t->how.width / 2, ROUND_CORNERS, false, &t->disc, err);
    return status;
}

sunder_status sunder_layer_trim(const sunder_layer *layer, const sunder_layer_options *options,
                                const sunder_trimming *trimming, sunder_shape **shape, sunder_error *err)
{
    trimmer t = {.layer = layer, .how = *trimming, .out = shape};
    if (!(trimming->keep >= 0 && trimming->keep <= 1) || !(trimming->width >= 0 && isfinite(trimming->width)))
        return sunder_i_fail(err, SUNDER_EARG, "the share to be kept, %g, or the least width, %g, is out of range",
                             trimming->keep, trimming->width);
    sunder_i_rules rules;
    for (size_t f = 0; f < layer->n; f++) shape[f] = NULL;
    sunder_status status = sunder_i_rules_of(options, &rules, err);
    if (!status) status = prepare_trimmer(&t, &rules, err);
    if (!status) status = sunder_i_blocks_find(layer, options, &t.blocks, err);
    if (!status) status = sunder_i_parallel(rules.threads, layer->n, SUNDER_I_GRAIN_SHAPES, trim_some, &t, err);
    if (status) sunder_i_levels_drop(shape, layer->n);
    sunder_i_blocks_free(&t.blocks);
    sunder_i_barriers_free(&t.barriers);
    sunder_i_rtree_free(&t.tree);
    sunder_shape_free(t.disc);
    sunder_i_free(t.barrier_of);
    return status;
}
