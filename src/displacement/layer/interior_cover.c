/* The interior cover of a set: convex pieces whose interiors cover its whole interior.
 *
 * The interiors of the convex pieces of a shape leave out the diagonals between them, and walls that members share.
 * Against a set with area this does not matter, since such a set also meets the neighbourhood of a diagonal. But a
 * segment or a point could lie along a diagonal and meet no piece (motion/diagonals.h, which finds diagonals, and
 * handles lattices that can be made finer). Here members are united first, and each diagonal uv gets a convex
 * quadrilateral u - q - v - p with corners in doubles. p is a corner w of the piece on the right of uv, or a double
 * between w and the middle m of uv; q is such a point on the left. It is decided exactly that p and q lie in the
 * triangles that the diagonal makes with these corners, and that the quadrilateral is strictly convex. So its interior
 * lies in that of the set, and contains the diagonal except for its ends.
 *
 * A diagonal is left uncovered if no doubles qualify: in triangles thinner than the unit in the last place, and at
 * corners that are not doubles (of sets that crossed themselves). A segment that lies entirely along such a diagonal
 * meets no piece. */
#include "displacement/layer/interior_cover.h"

#include "base/error.h"
#include "base/watch.h"
#include "morphology/morphology.h"
#include "motion/diagonals.h"
#include "shape/of_pieces.h"

#include <math.h>
#include <string.h>

/* The candidates for p and q divide the way from the middle m to the corner w by powers of two, down to this one; the
 * last is m itself, up to rounding. */
#define HALVINGS 60
/* The number of steps (base/watch.h) that one quadrilateral counts as. */
#define SEAM_STEPS 64

void sunder_i_interior_cover_free(sunder_i_interior_cover *interior_cover)
{
    sunder_shape_free(interior_cover->shape);
    sunder_shape_free(interior_cover->whole);
    sunder_i_free(interior_cover->corner);
    memset(interior_cover, 0, sizeof *interior_cover);
}

static sunder_point point_of(const double *xy, uint32_t v)
{
    return (sunder_point){xy[2 * (size_t)v], xy[2 * (size_t)v + 1]};
}

/* Returns the point m + (w - m) 2^-j, rounded, where m is the middle of uv; for j = 0 it is w. */
static sunder_point point_towards(sunder_point u, sunder_point v, sunder_point w, int j)
{
    if (j == 0) return w;
    const sunder_point m = {u.x + (v.x - u.x) / 2, u.y + (v.y - u.y) / 2};
    const double part = ldexp(1, -j);
    return (sunder_point){m.x + (w.x - m.x) * part, m.y + (w.y - m.y) * part};
}

/* Does p = point_towards(u, v, w, j) lie in the triangle u, v, w, which is on the left of uv, and not on uv? */
static bool is_within(sunder_point u, sunder_point v, sunder_point w, sunder_point p, int j)
{
    if (!(sunder_orient(&u, &v, &p) > 0)) return false;
    return j == 0 || (sunder_orient(&v, &w, &p) >= 0 && sunder_orient(&w, &u, &p) >= 0);
}

/* Finds the quadrilateral u - q - v - p around a diagonal, counter-clockwise. corner: the numbers of u, a corner on the
 * right of uv, v, and a corner on the left of uv, as in sunder_i_diagonals. Returns false if no doubles make one. */
static bool find_quadrilateral(const double *xy, const uint32_t corner[4], double out[8])
{
    const sunder_point u = point_of(xy, corner[0]), v = point_of(xy, corner[2]);
    const sunder_point right = point_of(xy, corner[1]), left = point_of(xy, corner[3]);
    for (int sum = 0; sum <= 2 * HALVINGS; sum++)
        for (int j = sum > HALVINGS ? sum - HALVINGS : 0; j <= sum && j <= HALVINGS; j++) {
            /* beyond the first few, only equal halvings on both sides are tried, and those with a corner itself */
            if (sum > 4 && j != sum / 2 && j != 0 && j != sum) continue;
            const sunder_point q = point_towards(u, v, right, j), p = point_towards(u, v, left, sum - j);
            if (!is_within(v, u, right, q, j) || !is_within(u, v, left, p, sum - j)) continue;
            if (sunder_orient(&p, &u, &q) <= 0 || sunder_orient(&q, &v, &p) <= 0) continue;
            const double quadrilateral[8] = {u.x, u.y, q.x, q.y, v.x, v.y, p.x, p.y};
            memcpy(out, quadrilateral, sizeof quadrilateral);
            return true;
        }
    return false;
}

bool sunder_i_cover_shared_segment(const double corner[8], double out[8])
{
    const uint32_t in_turn[4] = {0, 1, 2, 3};
    return find_quadrilateral(corner, in_turn, out);
}

static bool all_doubles(const sunder_shape *shape, const uint32_t corner[4])
{
    for (int k = 0; k < 4; k++)
        if (shape->rational && shape->form->numbers->exact[corner[k]].den.size) return false;
    return true;
}

bool sunder_i_diagonal_covers_find(const sunder_shape *shape, sunder_i_diagonal_cover **diagonal_cover, size_t *n)
{
    sunder_i_diagonals diagonals;
    *n = 0;
    *diagonal_cover = NULL;
    if (shape->pieces < 2) return true;
    if (!sunder_i_diagonals_find(shape, &diagonals)) return false;
    *diagonal_cover = sunder_i_alloc(diagonals.n, sizeof **diagonal_cover);
    bool ok = *diagonal_cover != NULL;
    for (size_t i = 0; i < diagonals.n && ok; i++) {
        sunder_i_diagonal_cover *one = *diagonal_cover + *n;
        memcpy(one->diagonal, diagonals.corner[i], sizeof one->diagonal);
        *n += all_doubles(shape, one->diagonal) && find_quadrilateral(shape->xy, one->diagonal, one->corner);
        ok = sunder_i_steps(SEAM_STEPS);
    }
    sunder_i_diagonals_free(&diagonals);
    return ok;
}

void sunder_i_diagonal_cover_corners(const sunder_shape *shape, const uint32_t diagonal[4], double corner[8])
{
    find_quadrilateral(shape->xy, diagonal, corner);
}

/* Makes out->shape of the pieces of the shape and the quadrilaterals around its diagonals. */
static sunder_status assemble_cover(const sunder_shape *shape, const sunder_i_diagonals *diagonals,
                                    sunder_i_interior_cover *out, sunder_error *err)
{
    sunder_i_piece_of *piece = sunder_i_alloc(shape->pieces + diagonals->n, sizeof *piece);
    out->corner = sunder_i_alloc(8 * diagonals->n, sizeof *out->corner);
    sunder_status status = piece && out->corner ? SUNDER_OK : sunder_i_failure_cause(err);
    size_t n = 0;
    for (uint32_t i = 0; i < shape->pieces && !status; i++)
        piece[n++] = (sunder_i_piece_of){.shape = shape, .piece = i};
    for (size_t i = 0; i < diagonals->n && !status; i++) {
        double *corner = out->corner + 8 * i;
        if (all_doubles(shape, diagonals->corner[i]) && find_quadrilateral(shape->xy, diagonals->corner[i], corner))
            piece[n++] = (sunder_i_piece_of){.n = 4, .xy = corner};
        if (!sunder_i_steps(SEAM_STEPS)) status = sunder_i_failure_cause(err);
    }
    if (!status) status = sunder_i_shape_of_pieces(piece, n, &out->shape, err);
    sunder_i_free(piece);
    return status;
}

sunder_status sunder_i_interior_cover_make(const sunder_shape *shape, sunder_i_interior_cover *out, sunder_error *err)
{
    memset(out, 0, sizeof *out);
    if (shape->pieces < 2) return SUNDER_OK;
    sunder_status status = sunder_i_without_seams(shape, &out->whole, err);
    if (status) return status;
    const sunder_shape *whole = out->whole ? out->whole : shape;
    sunder_i_diagonals diagonals;
    if (!sunder_i_diagonals_find(whole, &diagonals)) return sunder_i_failure_cause(err);
    if (diagonals.n || out->whole) status = assemble_cover(whole, &diagonals, out, err);
    sunder_i_diagonals_free(&diagonals);
    return status;
}
