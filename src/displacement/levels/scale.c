/* Features made smaller as a whole: scaled about the centre of their largest disc, and at last a square there.
 *
 * A scaled feature often lies in itself if the centre sees most of it. A member of a block is not scaled: the block
 * would be scaled as one, about one point, and a member that this point is not in would move out of itself. */
#include "displacement/levels/levels.h"

#include "base/parallel.h"
#include "base/watch.h"

#include <math.h>

typedef struct scaler {
    const sunder_layer *layer;
    const sunder_scaling *how;
    sunder_shape *const *from; /* NULL, or [n] */
    sunder_shape *disc;        /* around the disc of the least width; NULL: there is none */
    bool *alone;               /* [n] it is the only member of its block */
    sunder_shape **out;
} scaler;

/* Sets *out to the shape, scaled about a point, with rounded corners; NULL if it is not valid then. */
static sunder_status scale_shape(const sunder_shape *shape, const double about[2], double factor, sunder_shape **out,
                                 sunder_error *err)
{
    double *xy = sunder_i_alloc(2 * (size_t)shape->vertices, sizeof *xy);
    if (!xy) return sunder_i_failure_cause(err);
    for (size_t i = 0; i < 2 * (size_t)shape->vertices; i++)
        xy[i] = about[i & 1] + factor * (shape->xy[i] - about[i & 1]);
    const sunder_status status = sunder_i_shape_with_corners(shape, xy, out, err);
    sunder_i_free(xy);
    return status;
}

/* Sets *out to the square of this side about a centre, with two sides along u. */
static sunder_status make_square(const double at[2], const double u[2], double side, sunder_shape **out,
                                 sunder_error *err)
{
    static const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    double xy[8];
    const size_t four = 4, one = 1;
    for (size_t k = 0; k < 4; k++) {
        const double x = side / 2 * corner[k][0], y = side / 2 * corner[k][1];
        xy[2 * k] = at[0] + x * u[0] - y * u[1];
        xy[2 * k + 1] = at[1] + x * u[1] + y * u[0];
    }
    return sunder_shape_from_rings(xy, &four, &one, 1, SUNDER_VALIDITY_STRICT, out, err);
}

/* Takes a shape as rung `rung` of feature f if it may follow the one before, which it then replaces. */
static sunder_status take_rung(const scaler *t, size_t f, size_t rung, sunder_shape *shape, const sunder_shape *disc,
                               const sunder_shape **before, sunder_error *err)
{
    bool may = false;
    const sunder_status status = shape ? sunder_i_level_may_follow(*before, shape, disc, &may, err) : SUNDER_OK;
    if (!may) {
        sunder_shape_free(shape);
        return status;
    }
    *before = t->out[f * (t->how->factors + 1) + rung] = shape;
    return status;
}

static sunder_status scale_feature(const scaler *t, size_t f, sunder_error *err)
{
    const sunder_scaling *how = t->how;
    const sunder_shape *given = t->layer->shape[f], *before = t->from && t->from[f] ? t->from[f] : given;
    sunder_shape *shape;
    double at[2], radius, u[2] = {1, 0};
    if (!sunder_i_level_has_shape(t->layer, f)) return SUNDER_OK;
    sunder_status status = sunder_shape_largest_disc(given, at, &radius, err);
    for (size_t k = 0; k < how->factors && t->alone[f] && !status; k++) {
        status = scale_shape(given, at, how->factor[k], &shape, err);
        if (!status) status = take_rung(t, f, k, shape, t->disc, &before, err);
    }
    if (status || !(how->square > 0)) return status;
    status = sunder_shape_largest_disc(before, at, &radius, err);
    if (status || how->square > 2 * radius) return status;
    sunder_i_main_direction(given, u);
    status = make_square(at, u, how->square, &shape, err);
    return status ? status : take_rung(t, f, how->factors, shape, NULL, &before, err);
}

static sunder_status scale_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t f = begin; f < end && !status; f++) {
        status = scale_feature(context, f, err);
        if (!status && !sunder_i_step()) status = sunder_i_failure_cause(err);
    }
    return status;
}

static sunder_status find_single(scaler *t, const sunder_layer_options *options, sunder_error *err)
{
    sunder_i_blocks blocks;
    t->alone = sunder_i_calloc(t->layer->n, sizeof *t->alone);
    if (!t->alone) return sunder_i_failure_cause(err);
    if (t->how->factors == 0) return SUNDER_OK;
    const sunder_status status = sunder_i_blocks_find(t->layer, options, &blocks, err);
    for (size_t f = 0; f < t->layer->n && !status; f++)
        t->alone[f] = blocks.model.body[blocks.model.body_of[f]].members == 1;
    sunder_i_blocks_free(&blocks);
    return status;
}

static sunder_status check_scaling(const sunder_scaling *how, sunder_error *err)
{
    double last = 1;
    if (!(how->width >= 0) || !isfinite(how->width) || !(how->square >= 0) || !isfinite(how->square))
        return sunder_i_fail(err, SUNDER_EARG, "the least width, %g, or the side of the square, %g, is out of range",
                             how->width, how->square);
    for (size_t k = 0; k < how->factors; last = how->factor[k++])
        if (!(how->factor[k] > 0 && how->factor[k] < last))
            return sunder_i_fail(err, SUNDER_EARG, "factor %zu, %g, is not above 0 and below the one before", k + 1,
                                 how->factor[k]);
    return SUNDER_OK;
}

sunder_status sunder_layer_scale(const sunder_layer *layer, const sunder_layer_options *options,
                                 const sunder_scaling *scaling, sunder_shape *const *from, sunder_shape **shape,
                                 sunder_error *err)
{
    scaler t = {.layer = layer, .how = scaling, .from = from, .out = shape};
    const size_t n = layer->n * (scaling->factors + 1);
    sunder_i_rules rules;
    for (size_t k = 0; k < n; k++) shape[k] = NULL;
    sunder_status status = check_scaling(scaling, err);
    if (!status) status = sunder_i_rules_of(options, &rules, err);
    if (!status && scaling->width > 0)
        status = sunder_shape_disc(scaling->width / 2, SUNDER_I_ROUND_CORNERS, false, &t.disc, err);
    if (!status) status = find_single(&t, options, err);
    if (!status) status = sunder_i_parallel(rules.threads, layer->n, SUNDER_I_GRAIN_SHAPES, scale_some, &t, err);
    if (status) sunder_i_levels_drop(shape, n);
    sunder_shape_free(t.disc);
    sunder_i_free(t.alone);
    return status;
}
