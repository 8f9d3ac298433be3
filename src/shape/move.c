/* move.c: reflected and translated copies. Both keep the cleaned form and the pieces if every coordinate stays exact:
 * nothing is validated or decomposed again. */
#include "shape/build.h"

#include "shape/rational_corners.h"

#include <math.h>

/* Returns an exact copy, without the rational numbers; NULL if out of memory. */
static sunder_shape *copy_shape(const sunder_shape *s)
{
    /* r is only read */
    const sunder_i_rings r = {.vertices = s->vertices,
                              .rings = s->form->cleaned.rings,
                              .polygons = s->form->cleaned.polygons,
                              .xy = s->xy,
                              .rounded = s->rational,
                              .ring_end = (uint32_t *)s->form->cleaned.ring_end,
                              .poly_end = (uint32_t *)s->form->cleaned.poly_end,
                              .next = (uint32_t *)s->form->cleaned.next,
                              .prev = (uint32_t *)s->form->cleaned.prev};
    const sunder_i_pieces pieces = {s->pieces, s->pieces ? s->piece_end[s->pieces - 1] : 0, (uint32_t *)s->piece_end,
                                    (uint32_t *)sunder_i_piece_vertices(s)};
    sunder_shape *c = sunder_i_shape_assemble(s->raw_xy, s->form->given.ring_end, s->form->given.poly_end,
                                              s->form->given.polygons, &r, &pieces);
    if (!c) return NULL;
    sunder_i_shape_copy_shared(c, s->form->cleaned.shared);
    c->repaired = s->repaired;
    c->touches = s->touches;
    return c;
}

sunder_status sunder_shape_reflect(const sunder_shape *shape, sunder_shape **out, sunder_error *err)
{
    sunder_shape *c = copy_shape(shape);
    if (!c) return sunder_i_failure_cause(err);
    /* a rotation by half a turn: orientations are kept; 0 - v is never a negative zero */
    for (size_t i = 0; i < 2 * sunder_i_shape_raw_vertices(c); i++) c->raw_xy[i] = 0 - c->raw_xy[i];
    bool good = true;
    for (size_t i = 0; c->xy != c->raw_xy && i < 2 * (size_t)c->vertices; i++) c->xy[i] = 0 - c->xy[i];
    if (shape->rational) {
        good = sunder_i_shape_set_rational(c, shape->form->numbers->exact);
        for (uint32_t v = 0; good && v < c->vertices; v++)
            for (int k = 0; k < 2; k++)
                c->form->numbers->exact[v].num[k] = sunder_i_big_neg(c->form->numbers->exact[v].num[k]);
        good = good && sunder_i_shape_measure_rational(c);
    } else {
        sunder_i_shape_measure(c, NULL);
        good = sunder_i_shape_measure_anchor(c);
    }
    if (!good) {
        sunder_shape_free(c);
        return sunder_i_failure_cause(err);
    }
    *out = c;
    return SUNDER_OK;
}

/* Returns whether x + d is a double. The rounding error of the sum is a double, too, and computed exactly (Knuth's
 * two-sum). */
static bool sum_is_exact(double x, double d)
{
    const double s = x + d, back = s - x;
    return isfinite(s) && (x - (s - back)) + (d - back) == 0;
}

static sunder_i_rational_point point_of(const sunder_i_exact *at)
{
    return (sunder_i_rational_point){at->num[0], at->num[1], at->den};
}

/* Returns the exact position of a vertex of doubles, translated by d to a position that is not a pair of doubles. */
static sunder_i_exact exact_of_doubles(sunder_i_arena *arena, const double xy[2], const double d[2])
{
    const sunder_i_rational_point origin = {{NULL, 0}, {NULL, 0}, sunder_i_big_i64(arena, 1)};
    const sunder_i_exact at = sunder_i_exact_make(arena, origin, 0, xy);
    return sunder_i_exact_make(arena, point_of(&at), at.exponent, d);
}

/* Sets the numbers of the copy c to those of a rational shape, translated by d. Given vertices stay doubles; crossings
 * may not. Returns false if out of memory. */
static bool move_rational(const sunder_shape *shape, const double d[2], sunder_shape *c)
{
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    sunder_i_exact *exact = sunder_i_arena_alloc(&arena, shape->vertices, sizeof *exact);
    for (uint32_t v = 0; exact && v < shape->vertices; v++) {
        const sunder_i_exact *from = &shape->form->numbers->exact[v];
        exact[v] = *from;
        double *xy = c->xy + 2 * (size_t)v;
        if (from->den.size)
            exact[v] = sunder_i_exact_make(&arena, point_of(from), from->exponent, d);
        else if (!sum_is_exact(xy[0], d[0]) || !sum_is_exact(xy[1], d[1]))
            exact[v] = exact_of_doubles(&arena, xy, d);
        else
            for (int k = 0; k < 2; k++) xy[k] += d[k];
    }
    const bool good = !arena.failed && sunder_i_shape_set_rational(c, exact) && sunder_i_shape_measure_rational(c);
    sunder_i_arena_free(&arena);
    return good;
}

/* Translates a copy; all raw coordinates stay exact. */
static sunder_status move_exactly(const sunder_shape *shape, const double d[2], sunder_shape **out, sunder_error *err)
{
    sunder_shape *c = copy_shape(shape);
    if (!c) return sunder_i_failure_cause(err);
    for (size_t i = 0; i < 2 * sunder_i_shape_raw_vertices(c); i++) c->raw_xy[i] += d[i & 1];
    bool good;
    if (shape->rational) {
        good = move_rational(shape, d, c);
    } else {
        for (size_t i = 0; c->xy != c->raw_xy && i < 2 * (size_t)c->vertices; i++) c->xy[i] += d[i & 1];
        sunder_i_shape_measure(c, NULL);
        good = sunder_i_shape_measure_anchor(c);
    }
    if (!good) {
        sunder_shape_free(c);
        return sunder_i_failure_cause(err);
    }
    *out = c;
    return SUNDER_OK;
}

/* Makes a new shape from rounded coordinates: the set changes slightly, and its rings may have become invalid. */
static sunder_status move_rounded(const sunder_shape *shape, const double d[2], sunder_shape **out, sunder_error *err)
{
    const size_t n = sunder_i_shape_raw_vertices(shape);
    double *xy = sunder_i_alloc(2 * n, sizeof *xy);
    if (!xy) return sunder_i_failure_cause(err);
    sunder_status status = SUNDER_OK;
    for (size_t i = 0; i < 2 * n && !status; i++) {
        xy[i] = shape->raw_xy[i] + d[i & 1];
        if (!isfinite(xy[i]))
            status = sunder_i_fail(err, SUNDER_ERANGE, "moved by (%.17g %.17g) the shape leaves the range of doubles",
                                   d[0], d[1]);
    }
    if (!status)
        status = sunder_shape_from_rings(xy, shape->form->given.ring_end, shape->form->given.poly_end,
                                         shape->form->given.polygons, SUNDER_VALIDITY_EVEN_ODD, out, err);
    sunder_i_free(xy);
    return status;
}

sunder_status sunder_shape_translate(const sunder_shape *shape, double dx, double dy, sunder_shape **out, bool *exact,
                                     sunder_error *err)
{
    const double d[2] = {dx, dy};
    if (!isfinite(dx) || !isfinite(dy))
        return sunder_i_fail(err, SUNDER_EARG, "a translation must be finite, not (%.17g %.17g)", dx, dy);
    bool all = true;
    for (size_t i = 0; i < 2 * sunder_i_shape_raw_vertices(shape) && all; i++)
        all = sum_is_exact(shape->raw_xy[i], d[i & 1]);
    /* a vertex made by a repair may be a double although its translate is not, even if all raw coordinates stay
     * exact */
    for (size_t i = 0; i < 2 * (size_t)shape->vertices && all && !shape->rational; i++)
        if (!sum_is_exact(shape->xy[i], d[i & 1])) {
            const sunder_status status = move_rounded(shape, d, out, err);
            if (!status && exact) *exact = true;
            return status;
        }
    const sunder_status status = all ? move_exactly(shape, d, out, err) : move_rounded(shape, d, out, err);
    if (!status && exact) *exact = all;
    return status;
}
