/* narrow.c: does a disc of a diameter lie in a part? Exact, and as a number in doubles.
 *
 * A disc found in doubles decides if it is larger by more than all rounding, and so does a side of the part's box that
 * is shorter than the diameter. Otherwise the question becomes one of ../separation/: let F be a frame whose only hole
 * is the part's outer ring, together with the part's holes; that is all that the disc may not meet. A point c of
 * the part is at least r from F + t exactly if c - t is the centre of a disc of radius r outside of F. The least such t
 * is found exactly. The frame is so wide that a translation across it is longer than any within
 * the part, so the two cases differ by length. A disc that fits with no room at all is found as well: its centre is a
 * rational point (../separation/gap/step_to_rational.c proves it). */
#include "legibility/legibility.h"

#include "displacement/levels/edges.h"
#include "displacement/levels/inscribed.h"
#include "separation/least_translation.h"
#include "shape/of_pieces.h"

#include <math.h>
#include <string.h>

/* ---- The frame --------------------------------------------------------------------------------------------------- */

static uint32_t ring_start(const sunder_shape *shape, uint32_t ring)
{
    return ring ? shape->form->cleaned.ring_end[ring - 1] : 0;
}

/* Makes the frame: a rectangle `margin` around the part without its outer ring, and the part's holes. */
static sunder_status make_frame(const sunder_i_part_read *part, double margin, sunder_shape **out, sunder_error *err)
{
    const sunder_i_cleaned *c = &part->shape->form->cleaned;
    const uint32_t ring = part->polygon ? c->poly_end[part->polygon - 1] : 0, rings = c->poly_end[part->polygon] - ring;
    const double low[2] = {part->box[0] - margin, part->box[1] - margin};
    const double high[2] = {part->box[2] + margin, part->box[3] + margin};
    const double corner[8] = {low[0], low[1], high[0], low[1], high[0], high[1], low[0], high[1]};
    if (!isfinite(low[0]) || !isfinite(low[1]) || !isfinite(high[0]) || !isfinite(high[1]))
        return sunder_i_fail(err, SUNDER_ERANGE, "a frame around the shape leaves the range of doubles");
    double *xy = sunder_i_alloc(8 + 2 * (size_t)part->n, sizeof *xy);
    size_t *end = sunder_i_alloc(1 + 2 * (size_t)rings, sizeof *end), *poly_end = end ? end + 1 + rings : NULL;
    sunder_status status = SUNDER_OK;
    if (xy && end) {
        memcpy(xy, corner, sizeof corner);
        memcpy(xy + 8, sunder_i_part_xy(part, part->first), 2 * (size_t)part->n * sizeof *xy);
        end[0] = 4;
        for (uint32_t k = 0; k < rings; k++) {
            end[1 + k] = 4 + (size_t)(c->ring_end[ring + k] - ring_start(part->shape, ring));
            poly_end[k] = 2 + (size_t)k; /* the rectangle and the outer ring, then a polygon for each hole */
        }
        status = sunder_shape_from_rings(xy, end, poly_end, rings, SUNDER_VALIDITY_EVEN_ODD, out, err);
    }
    const bool memory = xy && end;
    sunder_i_free_all(xy, end);
    return memory ? status : sunder_i_failure_cause(err);
}

/* Sets *fits to whether a disc of the radius about some point of the part lies in it, near the point `from` of it. */
static sunder_status fits_exactly(const sunder_i_part_read *part, const double from[2], double radius, bool *fits,
                                  sunder_error *err)
{
    const double *b = part->box, within = 2 * (b[2] - b[0] + (b[3] - b[1]));
    const sunder_i_piece_of point = {NULL, 0, 1, from};
    sunder_shape *frame = NULL, *centre = NULL;
    sunder_separation answer;
    /* a translation that takes the centre across the frame is longer than `within` */
    const sunder_i_least_options options = {.gap = radius, .upper = within, .bound_only = true};
    bool beyond = false;
    sunder_status status = make_frame(part, 2 * within + radius, &frame, err);
    if (!status) status = sunder_i_shape_of_pieces(&point, 1, &centre, err);
    if (!status) status = sunder_i_least(centre, frame, &options, &answer, &beyond, err);
    if (!status) sunder_separation_clear(&answer);
    *fits = !beyond;
    sunder_shape_free(frame);
    sunder_shape_free(centre);
    return status;
}

/* ---- The largest disc -------------------------------------------------------------------------------------------- */

/* Finds the largest disc in doubles, and a point of the boundary that is nearest to its centre. */
static bool find_disc(const sunder_i_part_read *part, double centre[2], double *radius, double contact[2])
{
    const size_t n = part->n;
    double *edge = sunder_i_alloc(4 * n, sizeof *edge);
    if (!edge) return false;
    for (uint32_t k = 0; k < part->n; k++) sunder_i_edge_of(part->shape, part->first + k, edge + 4 * (size_t)k);
    const sunder_i_disc_room room = {.wall = edge, .edge = edge, .end = &n, .walls = n, .members = 1};
    const bool ok = sunder_i_largest_disc(&room, centre, radius);
    const double *b = part->box, step = sunder_i_min(b[2] - b[0], b[3] - b[1]) * SUNDER_I_DISC_PRECISION;
    if (ok) sunder_i_disc_climb(&room, step, centre, radius);
    double least = INFINITY;
    for (size_t k = 0; k < n && ok; k++) {
        double off[2];
        sunder_i_off_edge(edge + 4 * k, centre, off);
        if (hypot(off[0], off[1]) >= least) continue;
        least = hypot(off[0], off[1]);
        for (int c = 0; c < 2; c++) contact[c] = centre[c] - off[c];
    }
    sunder_i_free(edge);
    return ok;
}

/* A width is known up to this part of it. */
#define PRECISION 0x1p-20

/* Raises *has, a width that fits, to within PRECISION of the greatest such one, which is less than `high`. */
static sunder_status refine(const sunder_i_part_read *part, const double centre[2], double high, double *has,
                            sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    while (!status && high - *has > high * PRECISION) {
        const double middle = *has + (high - *has) / 2;
        bool fits;
        status = fits_exactly(part, centre, middle / 2, &fits, err);
        if (!status) *(fits ? has : &high) = middle;
    }
    return status;
}

sunder_status sunder_i_part_width(const sunder_i_part_read *part, double limit, bool *found, sunder_illegible *out,
                                  sunder_error *err)
{
    const double *b = part->box, side = sunder_i_min(b[2] - b[0], b[3] - b[1]) * (1 + 0x1p-50);
    double centre[2], radius, contact[2] = {0, 0};
    if (!find_disc(part, centre, &radius, contact)) return sunder_i_failure_cause(err);
    /* Distances from the centre have an error of fewer than 32 units of the last bit of the part's size. */
    const double slack = 0x1p-46 * (b[2] - b[0] + (b[3] - b[1]));
    *found = side < limit;
    if (radius - slack > limit / 2) return SUNDER_OK;
    bool fits = false;
    sunder_status status = *found ? SUNDER_OK : fits_exactly(part, centre, limit / 2, &fits, err);
    *found = !fits;
    if (status || fits) return status;
    /* of a rectangle along the axes, and others, the number found is exact */
    if (radius > 0) status = fits_exactly(part, centre, radius, &fits, err);
    out->has = fits ? 2 * radius : sunder_i_max(0, 2 * (radius - slack));
    for (int c = 0; c < 2; c++) {
        out->from[c] = contact[c];
        out->to[c] = 2 * centre[c] - contact[c];
    }
    return status ? status : refine(part, centre, sunder_i_min(side, limit), &out->has, err);
}
