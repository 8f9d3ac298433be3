/* Convex pieces that cover the diagonals between the convex pieces of a feature.
 *
 * A barrier's segment or point has no width. Features may touch it but their interiors may not meet it; along a
 * diagonal it would lie between two pieces and meet neither.
 *
 * The same holds for an anchor, which is a point. An anchor that moves straight along a diagonal, or through a corner
 * where two pieces end, passes between the shadows of the pieces (geometry/obstacle_shadow.h), on the boundary of both,
 * although the feature blocks it. So proofs, which test pieces one by one and may pass on the boundary of each, get one
 * more piece around each diagonal: a convex quadrilateral that lies in the feature (seamless.c). */
#include "displacement/layer/far_corners.h"

#include "spatial/box.h"

#include <string.h>

typedef struct gathering {
    sunder_i_model *model;
    size_t capacity, of_diagonals, of_corners;
} gathering;

/* Appends the cover of a diagonal of feature f, with its corners relative to the body's origin. */
static void put(sunder_i_model *model, uint32_t f, const sunder_i_seam *seam)
{
    sunder_i_body_piece *piece = &model->seam[model->seams];
    double *to = model->seam_corner + 8 * model->seams;
    memcpy(model->seam_diagonal + 4 * model->seams++, seam->diagonal, sizeof seam->diagonal);
    *piece = (sunder_i_body_piece){.corners = 4, .feature = f};
    sunder_i_box_clear(piece->box);
    memcpy(to, seam->corner, sizeof seam->corner);
    sunder_i_reckon_from_origin(&model->body[model->body_of[f]], to, 4);
    for (size_t i = 0; i < 8; i += 2) sunder_i_box_include(piece->box, to + i);
}

static bool add_seams(gathering *g, uint32_t f)
{
    sunder_i_model *model = g->model;
    sunder_i_seam *seam;
    size_t n;
    bool ok = sunder_i_seams_find(sunder_i_thing_shape(model, f), &seam, &n);
    const size_t all = model->seams + n;
    ok = ok && sunder_i_reserve(&model->seam, &g->capacity, all, sizeof *model->seam) &&
         sunder_i_reserve(&model->seam_diagonal, &g->of_diagonals, 4 * all, sizeof *model->seam_diagonal) &&
         sunder_i_reserve(&model->seam_corner, &g->of_corners, 8 * all, sizeof *model->seam_corner);
    for (size_t k = 0; k < n && ok; k++) put(model, f, &seam[k]);
    sunder_i_free(seam);
    return ok;
}

/* Shrinks an array to n elements, since large layers have many covers. Returns false if memory is out. */
static bool fit(void *array, size_t n, size_t size)
{
    void *had, *fits;
    memcpy(&had, array, sizeof had);
    if (!had) return true;
    fits = sunder_i_realloc(had, n, size);
    if (fits) memcpy(array, &fits, sizeof fits);
    return fits != NULL;
}

/* Sets the pointers of all covers to their corners, once the array of corners no longer moves. */
static sunder_status settle_seams(sunder_i_model *model, sunder_error *err)
{
    const size_t n = model->seams;
    if (n >= UINT32_MAX) return sunder_i_fail(err, SUNDER_ESIZE, "too many seams: %zu", n);
    if (!fit(&model->seam, n, sizeof *model->seam) ||
        !fit(&model->seam_diagonal, 4 * n, sizeof *model->seam_diagonal) ||
        !fit(&model->seam_corner, 8 * n, sizeof *model->seam_corner))
        return sunder_i_no_memory(err);
    for (size_t k = 0; k < n; k++) model->seam[k].corner = model->seam_corner + 8 * k;
    return SUNDER_OK;
}

bool sunder_i_has_bare_barriers(const sunder_i_model *model)
{
    const sunder_i_barriers *b = model->barriers;
    for (uint32_t k = 0; b->flat && k < b->n; k++)
        if (sunder_i_required_above(b, k) == 0) return true;
    return false;
}

/* Are covers of diagonals useless in this layer? They are if jumps are allowed and no barrier could lie along a
 * diagonal. */
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
    gathering g = {model, model->seams, 4 * model->seams, 8 * model->seams};
    if (model->has_seams || are_idle(model)) return SUNDER_OK;
    for (size_t k = 0; k < n; k++)
        if (!add_body(&g, &model->body[body[k]])) return sunder_i_no_memory(err);
    return settle_seams(model, err);
}

sunder_status sunder_i_model_find_seams(sunder_i_model *model, sunder_error *err)
{
    gathering g = {model, model->seams, 4 * model->seams, 8 * model->seams};
    if (model->has_seams || are_idle(model)) return SUNDER_OK;
    model->has_seams = true;
    for (size_t b = 0; b < model->bodies; b++)
        if (!add_body(&g, &model->body[b])) return sunder_i_no_memory(err);
    return settle_seams(model, err);
}
