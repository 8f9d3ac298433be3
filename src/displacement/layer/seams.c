/* What a feature's convex pieces leave out: the diagonals between them.
 *
 * A barrier's segment or point that features may touch, but not meet, has no width: on a diagonal it would lie between
 * the pieces, and meet neither. So it is with an anchor, which is a point, too:
 *
 * An anchor that goes straight along a diagonal, or through a corner where two pieces end, runs between the shadows of
 * the pieces (obstacles/shadow.h), on the boundary of both. The feature is in its way all the same. So proofs, which
 * ask about pieces one by one and may pass on the boundary of each, are given one more about each diagonal: a convex
 * quadrilateral that lies in the feature (seamless.c). */
#include "displacement/layer/model.h"

#include "spatial/box.h"

#include <string.h>

typedef struct gathering {
    sunder_i_model *model;
    size_t capacity, at_capacity;
} gathering;

static bool add_seams(gathering *g, uint32_t f)
{
    sunder_i_model *model = g->model;
    double *corner;
    size_t n;
    bool ok = sunder_i_seams_find(sunder_i_thing_shape(model, f), &corner, &n);
    ok = ok && sunder_i_reserve(&model->seam, &g->capacity, model->seams + n, sizeof *model->seam) &&
         sunder_i_reserve(&model->seam_at, &g->at_capacity, 8 * (model->seams + n), sizeof *model->seam_at);
    for (size_t k = 0; k < n && ok; k++) {
        model->seam[model->seams] = (sunder_i_body_piece){.corners = 4, .feature = f};
        memcpy(model->seam_at + 8 * model->seams++, corner + 8 * k, 8 * sizeof *corner);
    }
    sunder_i_free(corner);
    return ok;
}

/* Corners of the seams from `first` on, from the bodies' origins. */
static sunder_status put_corners(sunder_i_model *model, size_t first, sunder_error *err)
{
    if (model->seams >= UINT32_MAX) return sunder_i_fail(err, SUNDER_ESIZE, "too many seams: %zu", model->seams);
    double *corner = sunder_i_realloc(model->seam_corner, 8 * model->seams, sizeof *corner);
    if (!corner) return sunder_i_no_memory(err);
    model->seam_corner = corner;
    for (size_t k = 0; k < model->seams; k++) model->seam[k].corner = corner + 8 * k;
    for (size_t k = first; k < model->seams; k++) {
        sunder_i_body_piece *seam = &model->seam[k];
        const double *origin = model->body[model->body_of[seam->feature]].origin;
        sunder_i_box_clear(seam->box);
        for (size_t i = 0; i < 4; i++) {
            double *to = corner + 8 * k + 2 * i;
            for (size_t c = 0; c < 2; c++) to[c] = model->seam_at[8 * k + 2 * i + c] - origin[c];
            sunder_i_box_include(seam->box, to);
        }
    }
    return SUNDER_OK;
}

bool sunder_i_has_bare_barriers(const sunder_i_model *model)
{
    const sunder_i_barriers *b = model->barriers;
    for (uint32_t k = 0; b->flat && k < b->n; k++)
        if (sunder_i_required_above(b, k) == 0) return true;
    return false;
}

/* Has nobody a use for them? */
static bool are_idle(const sunder_i_model *model) { return model->rules.jumps && !sunder_i_has_bare_barriers(model); }

static bool add_body(gathering *g, sunder_i_body *body)
{
    sunder_i_model *model = g->model;
    if (body->has_seams) return true;
    body->has_seams = true;
    const size_t first = model->seams;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (!sunder_i_is_barrier(model, f) && model->present[f] && !add_seams(g, f)) return false;
    }
    if (model->seams == first) return true;
    sunder_i_extras *extras = sunder_i_own_extras(model, body);
    if (!extras) return false;
    extras->seam = (uint32_t)first;
    extras->seams = (uint32_t)(model->seams - first);
    return true;
}

sunder_status sunder_i_model_find_seams_of(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err)
{
    const size_t first = model->seams;
    gathering g = {model, first, 8 * first};
    if (model->has_seams || are_idle(model)) return SUNDER_OK;
    for (size_t k = 0; k < n; k++)
        if (!add_body(&g, &model->body[body[k]])) return sunder_i_no_memory(err);
    return put_corners(model, first, err);
}

sunder_status sunder_i_model_find_seams(sunder_i_model *model, sunder_error *err)
{
    const size_t first = model->seams;
    gathering g = {model, first, 8 * first};
    if (model->has_seams || are_idle(model)) return SUNDER_OK;
    model->has_seams = true;
    for (size_t b = 0; b < model->bodies; b++)
        if (!add_body(&g, &model->body[b])) return sunder_i_no_memory(err);
    return put_corners(model, first, err);
}
