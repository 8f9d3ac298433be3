/* member_union.c: the union of the polygons of a shape, by the stages that compute a sum's outline: the shape's convex
 * pieces are the parts.
 *
 * The open pieces do not contain the diagonals between them and walls that polygons share. Both are covered on both
 * sides, so that neither is boundary; they would become degenerate segments and points, which the union of closed
 * polygons does not have. */
#include "morphology/morphology.h"

#include "base/invariant.h"
#include "base/sized_struct.h"
#include "base/watch.h"
#include "convex/pieces.h"
#include "outline/contained_parts.h"
#include "outline/outline.h"
#include "sum/canonical_sum.h"
#include "sum/operands_on_lattice.h"
#include "sum/to_shape.h"

#include <string.h>

/* Removes segments and points, and the vertices that only they have. Returns false if out of memory. */
static bool drop_degenerate(sunder_sum *sum)
{
    const size_t sides = sum->rings ? sum->ring_end[sum->rings - 1] : 0;
    uint32_t *number = sunder_i_alloc(sum->vertices, sizeof *number), n = 0;
    sunder_i_hpoint *vertex = sunder_i_alloc(sum->vertices, sizeof *vertex);
    const bool ok = number && vertex;
    if (ok) {
        memset(number, 0xff, sum->vertices * sizeof *number);
        for (size_t i = 0; i < sides; i++) {
            const uint32_t v = sum->ring_vertex[i];
            if (number[v] == UINT32_MAX) {
                vertex[n] = sum->vertex[v];
                number[v] = n++;
            }
            sum->ring_vertex[i] = number[v];
        }
        memcpy(sum->vertex, vertex, n * sizeof *vertex);
        sum->vertices = n;
        sum->segments = sum->points = 0;
    }
    sunder_i_free_all(number, vertex);
    return ok;
}

static sunder_status unite_pieces(const sunder_shape *shape, const sunder_i_point *at,
                                  const sunder_sum_options *options, sunder_sum *sum, sunder_error *err)
{
    sunder_i_convex_pieces pieces, *const list[] = {&pieces};
    sunder_i_directions directions = {0};
    if (shape->pieces == 0) return SUNDER_OK;
    if (!sunder_i_convex_pieces_init(&pieces, shape->pieces, shape->piece_end[shape->pieces - 1]))
        return sunder_i_failure_cause(err);
    sunder_i_convex_pieces_add_shape(&pieces, shape, at);
    sunder_status status = SUNDER_OK;
    if (sunder_i_convex_pieces_rank(&sum->lattice, list, 1, &directions)) {
        if (shape->form->cleaned.polygons > 1) status = sunder_i_drop_contained(&pieces, err);
        if (status == SUNDER_OK) status = sunder_i_outline_find(&pieces, options, NULL, NULL, sum, err);
    } else
        status = sunder_i_failure_cause(err);
    if (status == SUNDER_OK && !drop_degenerate(sum)) status = sunder_i_failure_cause(err);
    sunder_i_directions_free(&directions);
    sunder_i_convex_pieces_free(&pieces);
    return status;
}

sunder_status sunder_i_union_of_members(const sunder_shape *shape, const sunder_shape *b,
                                        const sunder_sum_options *options, sunder_sum **out, sunder_error *err)
{
    sunder_sum *sum = sunder_i_calloc(1, sizeof *sum);
    if (!sum) return sunder_i_failure_cause(err);
    sunder_i_placed placed;
    sunder_status status = sunder_i_sum_place(sum, shape, b, false, &placed, err);
    if (status == SUNDER_OK) {
        memset(sum->origin[1], 0, sizeof sum->origin[1]); /* only the lattice depends on b */
        sum->method.algorithm = SUNDER_ALGORITHM_CONVOLUTION;
        status = unite_pieces(shape, placed.p, options, sum, err);
        sunder_i_placed_free(&placed);
    }
    SUNDER_I_ASSERT(status != SUNDER_OK || !sunder_i_canonical_check(sum));
    if (status == SUNDER_OK)
        *out = sum;
    else
        sunder_sum_free(sum);
    return status;
}

sunder_status sunder_shape_union(const sunder_shape *shape, const sunder_sum_options *options, sunder_sum **out,
                                 sunder_error *err)
{
    sunder_sum_options o = {.size = sizeof o};
    sunder_status status = sunder_i_options_read(&o, sizeof o, options, err);
    if (status != SUNDER_OK) return status;
    sunder_i_watch watch;
    sunder_i_watch_begin(&watch, &o.progress, &o.progress_user);
    status = sunder_i_union_of_members(shape, NULL, &o, out, err);
    sunder_i_watch_end(&watch);
    return status;
}

sunder_status sunder_i_without_seams(const sunder_shape *shape, sunder_shape **out, sunder_error *err)
{
    *out = NULL;
    if (shape->form->cleaned.polygons < 2) return SUNDER_OK;
    sunder_sum *sum;
    sunder_status status = sunder_shape_union(shape, NULL, &sum, err);
    if (status != SUNDER_OK) return status;
    status = sunder_i_sum_to_shape(sum, true, SUNDER_VALIDITY_STRICT, out, err);
    sunder_sum_free(sum);
    return status;
}
