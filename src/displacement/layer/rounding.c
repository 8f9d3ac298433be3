/* Moves for which the moved coordinates are doubles.
 *
 * x + t is a double, exactly, if it is a multiple of the unit in the last place of its binade. x is a multiple of its
 * own unit. So if x + t lies in no higher a binade than x, and t is a multiple of x's unit, the sum is exact. For a
 * body this has to hold for every coordinate of every member: t must be a multiple of the coarsest unit among them, at
 * the old and the new position. This fails only if a coordinate enters a higher binade and has bits below the unit
 * there. Then no move of about that length is exact, and the feature is written rounded.
 *
 * The coordinates are those of the raw input, with repeated and collinear vertices, since these are written. */
#include "displacement/layer/rounding.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "shape/shape.h"

#include <float.h>
#include <math.h>

/* The greatest length of a move; a longer one is replaced by no move. The square of this length times the greatest
 * weight, summed over the greatest number of bodies, is finite, so the cost always is. */
#define LONGEST_MOVE 0x1p200

/* Returns the exponent of the unit in the last place of v: |v| = m * 2^e with 2^52 <= m < 2^53, or the least exponent
 * for subnormal v. */
static int unit_exponent(double v)
{
    if (fabs(v) < DBL_MIN) return DBL_MIN_EXP - DBL_MANT_DIG;
    int e;
    frexp(v, &e);
    return e - DBL_MANT_DIG;
}

static bool sum_is_exact(double x, double t)
{
    /* The rounding error of a sum is itself a double [Knu97, 4.2.2; Dek71]. */
    const double s = x + t, b = s - x, e = (x - (s - b)) + (t - b);
    return isfinite(s) && e == 0;
}

static size_t raw_vertices(const sunder_shape *shape)
{
    if (shape->form->given.polygons == 0) return 0;
    const size_t rings = shape->form->given.poly_end[shape->form->given.polygons - 1];
    return rings ? shape->form->given.ring_end[rings - 1] : 0;
}

/* Returns the exponent of the coarsest unit of coordinate c of the body's corners, before and after the move t. */
static int coarsest_unit(const sunder_i_model *model, const sunder_i_body *body, size_t c, double t)
{
    double largest = fabs(t);
    for (uint32_t k = 0; k < body->members; k++) {
        const sunder_shape *shape = sunder_i_thing_shape(model, model->member[body->member + k]);
        if (!shape) continue;
        const size_t n = raw_vertices(shape);
        for (size_t v = 0; v < n; v++) {
            const double before = fabs(shape->raw_xy[2 * v + c]), after = fabs(shape->raw_xy[2 * v + c] + t);
            if (before > largest) largest = before;
            if (after > largest) largest = after;
        }
    }
    return unit_exponent(largest);
}

static bool all_exact(const sunder_i_model *model, const sunder_i_body *body, const double t[2])
{
    for (uint32_t k = 0; k < body->members; k++) {
        const sunder_shape *shape = sunder_i_thing_shape(model, model->member[body->member + k]);
        if (!shape) continue;
        const size_t n = raw_vertices(shape);
        for (size_t v = 0; v < 2 * n; v++)
            if (!sum_is_exact(shape->raw_xy[v], t[v & 1])) return false;
    }
    return true;
}

bool sunder_i_is_exact_move(const sunder_i_model *model, uint32_t body, const double move[2])
{
    double out[2];
    return all_exact(model, &model->body[body], move) || sunder_i_round_move(model, body, move, out, NULL);
}

/* A longer "move" comes from a quadratic program without a meaningful solution: the body stays at its original
 * position. */
static bool is_a_move(const double move[2]) { return fabs(move[0]) <= LONGEST_MOVE && fabs(move[1]) <= LONGEST_MOVE; }

/* Sets `out` to the move in whole units of the coordinates, whatever its length, and u[] to these units. */
static void round_coordinates(const sunder_i_model *model, const sunder_i_body *body, const double move[2],
                              double out[2], double u[2])
{
    for (size_t c = 0; c < 2; c++) {
        u[c] = 0;
        out[c] = 0;
        if (move[c] == 0 || !is_a_move(move)) continue;
        /* Rounding may carry a coordinate into the next binade. Then it is repeated with the unit there. */
        for (int again = 0; again < 2; again++) {
            u[c] = ldexp(1, coarsest_unit(model, body, c, again ? out[c] : move[c]));
            out[c] = u[c] * rint(move[c] / u[c]);
            if (!isfinite(out[c])) out[c] = move[c];
        }
    }
}

void sunder_i_round_to_units(const sunder_i_model *model, uint32_t b, const double move[2], double out[2])
{
    double u[2];
    round_coordinates(model, &model->body[b], move, out, u);
}

bool sunder_i_round_move(const sunder_i_model *model, uint32_t b, const double move[2], double out[2], double *unit)
{
    const sunder_i_body *body = &model->body[b];
    double u[2];
    round_coordinates(model, body, move, out, u);
    if (unit) *unit = sunder_i_max(u[0], u[1]);
    if (!sunder_i_is_within_limit(out, body->limit))
        for (size_t c = 0; c < 2; c++) {
            if (move[c] == 0 || !is_a_move(move)) continue;
            out[c] = u[c] * trunc(move[c] / u[c]);
        }
    /* If the move is still too long, it was too long before rounding: it is shortened by whole units. */
    for (int k = 0; k < 64 && !sunder_i_is_within_limit(out, body->limit); k++) {
        const double length = hypot(out[0], out[1]), shrink = body->limit / length * (1 - ldexp(1, k - 52));
        for (size_t c = 0; c < 2; c++)
            if (u[c] > 0) out[c] = u[c] * trunc(out[c] * sunder_i_max(0, shrink) / u[c]);
    }
    if (!sunder_i_is_within_limit(out, body->limit)) out[0] = out[1] = 0;
    SUNDER_I_ASSERT(isfinite(out[0] + out[1]) && hypot(out[0], out[1]) <= body->limit * (1 + 0x1p-40));
    return all_exact(model, body, out);
}
