/* Convex pieces that cover the diagonals between the convex pieces of a feature.
 *
 * A barrier's segment or point has no width. Features may touch it but their interiors may not meet it; along a
 * diagonal it would lie between two pieces and meet neither.
 *
 * The same holds for an anchor, which is a point. An anchor that moves straight along a diagonal, or through a corner
 * where two pieces end, passes between the shadows of the pieces (geometry/obstacle_shadow.h), on the boundary of both,
 * although the feature blocks it. So proofs, which test pieces one by one and may pass on the boundary of each, get one
 * more piece around each diagonal: a convex quadrilateral that lies in the feature (interior_cover.c). */
#include "displacement/layer/far_corners.h"

#include "spatial/box.h"

#include <string.h>

typedef struct cover_lists {
    sunder_i_model *model;
    size_t capacity, of_diagonals, of_corners;
} cover_lists;

/* Appends the cover of a diagonal of feature f, with its corners relative to the body's origin. */
static void append_cover(sunder_i_model *model, uint32_t f, const sunder_i_diagonal_cover *diagonal_cover)
{
    sunder_i_body_piece *piece = &model->diagonal_cover[model->diagonal_covers];
    double *to = model->diagonal_cover_corner + 8 * model->diagonal_covers;
    memcpy(model->diagonal_cover_vertices + 4 * model->diagonal_covers++, diagonal_cover->diagonal,
           sizeof diagonal_cover->diagonal);
    *piece = (sunder_i_body_piece){.corners = 4, .feature = f};
    sunder_i_box_clear(piece->box);
    memcpy(to, diagonal_cover->corner, sizeof diagonal_cover->corner);
    sunder_i_reckon_from_origin(&model->body[model->body_of[f]], to, 4);
    for (size_t i = 0; i < 8; i += 2) sunder_i_box_include(piece->box, to + i);
}

static bool add_diagonal_covers(cover_lists *g, uint32_t f)
{
    sunder_i_model *model = g->model;
    sunder_i_diagonal_cover *diagonal_cover;
    size_t n;
    bool ok = sunder_i_diagonal_covers_find(sunder_i_thing_shape(model, f), &diagonal_cover, &n);
    const size_t all = model->diagonal_covers + n;
    ok = ok && sunder_i_reserve(&model->diagonal_cover, &g->capacity, all, sizeof *model->diagonal_cover) &&
         sunder_i_reserve(&model->diagonal_cover_vertices, &g->of_diagonals, 4 * all,
                          sizeof *model->diagonal_cover_vertices) &&
         sunder_i_reserve(&model->diagonal_cover_corner, &g->of_corners, 8 * all, sizeof *model->diagonal_cover_corner);
    for (size_t k = 0; k < n && ok; k++) append_cover(model, f, &diagonal_cover[k]);
    sunder_i_free(diagonal_cover);
    return ok;
}

/* Shrinks an array to n elements, since large layers have many covers. Returns false if memory is out. */
static bool shrink_array(void *array, size_t n, size_t size)
{
    void *had, *fits;
    memcpy(&had, array, sizeof had);
    if (!had) return true;
    fits = sunder_i_realloc(had, n, size);
    if (fits) memcpy(array, &fits, sizeof fits);
    return fits != NULL;
}

/* Sets the pointers of all covers to their corners, once the array of corners no longer moves. */
static sunder_status set_cover_corners(sunder_i_model *model, sunder_error *err)
{
    const size_t n = model->diagonal_covers;
    if (n >= UINT32_MAX) return sunder_i_fail(err, SUNDER_ESIZE, "too many seams: %zu", n);
    if (!shrink_array(&model->diagonal_cover, n, sizeof *model->diagonal_cover) ||
        !shrink_array(&model->diagonal_cover_vertices, 4 * n, sizeof *model->diagonal_cover_vertices) ||
        !shrink_array(&model->diagonal_cover_corner, 8 * n, sizeof *model->diagonal_cover_corner))
        return sunder_i_failure_cause(err);
    for (size_t k = 0; k < n; k++) model->diagonal_cover[k].corner = model->diagonal_cover_corner + 8 * k;
    return SUNDER_OK;
}

bool sunder_i_has_bare_barriers(const sunder_i_model *model)
{
    const sunder_i_barriers *b = model->barriers;
    for (uint32_t k = 0; b->flat && k < b->n; k++)
        if (sunder_i_required_least(b, k) == 0) return true;
    return false;
}

/* Are covers of diagonals useless in this layer? They are if jumps are allowed and no barrier could lie along a
 * diagonal. */
static bool are_covers_useless(const sunder_i_model *model)
{
    return model->rules.jumps && !sunder_i_has_bare_barriers(model);
}

static bool cover_body(cover_lists *g, sunder_i_body *body)
{
    sunder_i_model *model = g->model;
    if (body->has_diagonal_covers) return true;
    body->has_diagonal_covers = true;
    const size_t first = model->diagonal_covers;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (!sunder_i_is_barrier(model, f) && model->present[f] && !add_diagonal_covers(g, f)) return false;
    }
    if (model->diagonal_covers == first) return true;
    sunder_i_extras *extras = sunder_i_own_extras(model, body);
    if (!extras) return false;
    extras->diagonal_cover = (uint32_t)first;
    extras->diagonal_covers = (uint32_t)(model->diagonal_covers - first);
    return true;
}

sunder_status sunder_i_model_cover_diagonals_of(sunder_i_model *model, const uint32_t *body, size_t n,
                                                sunder_error *err)
{
    cover_lists g = {model, model->diagonal_covers, 4 * model->diagonal_covers, 8 * model->diagonal_covers};
    if (model->has_diagonal_covers || are_covers_useless(model)) return SUNDER_OK;
    for (size_t k = 0; k < n; k++)
        if (!cover_body(&g, &model->body[body[k]])) return sunder_i_failure_cause(err);
    return set_cover_corners(model, err);
}

sunder_status sunder_i_model_cover_diagonals(sunder_i_model *model, sunder_error *err)
{
    cover_lists g = {model, model->diagonal_covers, 4 * model->diagonal_covers, 8 * model->diagonal_covers};
    if (model->has_diagonal_covers || are_covers_useless(model)) return SUNDER_OK;
    model->has_diagonal_covers = true;
    for (size_t b = 0; b < model->bodies; b++)
        if (!cover_body(&g, &model->body[b])) return sunder_i_failure_cause(err);
    return set_cover_corners(model, err);
}
