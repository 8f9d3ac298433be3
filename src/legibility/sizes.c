/* sizes.c: the area of a part, and its shortest edge. */
#include "legibility/legibility.h"

#include "number/accumulator.h"
#include "separation/answer/root.h"

#include <math.h>

/* ---- Area -------------------------------------------------------------------------------------------------------- */

/* Compares twice the area of a part whose corners are doubles with twice the limit; *area becomes the area. */
static int double_area_cmp(const sunder_i_part_read *part, double limit, double *area)
{
    sunder_i_accumulator sum = {{0}};
    for (uint32_t k = 0; k < part->n; k++) {
        const double *a = sunder_i_part_xy(part, part->first + k);
        const double *b = sunder_i_part_xy(part, sunder_i_part_next(part, part->first + k));
        sunder_i_accumulator_add(&sum, a[0], b[1]);
        sunder_i_accumulator_sub(&sum, b[0], a[1]);
    }
    *area = sunder_i_accumulator_double(&sum, -1);
    sunder_i_accumulator_sub(&sum, limit, 2);
    return sunder_i_accumulator_sign(&sum);
}

/* The same for a part with corners that are crossings: a sum of fractions over the lattice. */
static int rational_area_cmp(sunder_i_part_read *part, double limit, double *area)
{
    sunder_i_lattice *l = &part->placed.lattice;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    sunder_i_ratio sum = sunder_i_ratio_double(m, 0);
    for (uint32_t k = 0; k < part->n && !m->failed; k++) {
        const sunder_i_rational_point a = sunder_i_rational_get(m, l, sunder_i_part_at(part, part->first + k));
        const sunder_i_rational_point b =
            sunder_i_rational_get(m, l, sunder_i_part_at(part, sunder_i_part_next(part, part->first + k)));
        sum = sunder_i_ratio_add(m, sum,
                                 (sunder_i_ratio){sunder_i_rational_cross(m, a, b), sunder_i_big_mul(m, a.w, b.w)});
    }
    *area = sunder_i_big_ratio(m, sum.num, sum.den, 2 * l->exponent - 1);
    int exponent;
    sunder_i_big least = sunder_i_big_mul(m, sunder_i_big_double(m, limit, &exponent), sum.den);
    const long shift = 2 * l->exponent - 1 - exponent; /* sum / 2 * 2^(2 exponents of the lattice) against the limit */
    if (shift > 0) sum.num = sunder_i_big_shl(m, sum.num, (unsigned long)shift);
    if (shift < 0) least = sunder_i_big_shl(m, least, (unsigned long)-shift);
    const int c = sunder_i_big_cmp(sum.num, least);
    sunder_i_lattice_end(l, mark);
    return c;
}

void sunder_i_part_area(sunder_i_part_read *part, double limit, bool *found, sunder_illegible *out)
{
    *found = (part->shape->rational ? rational_area_cmp(part, limit, &out->has)
                                    : double_area_cmp(part, limit, &out->has)) < 0;
    for (int c = 0; c < 2; c++) {
        out->from[c] = part->box[c];
        out->to[c] = part->box[2 + c];
    }
}

/* ---- Edges ------------------------------------------------------------------------------------------------------- */

/* Sets *has to the length of edge v, as the nearest double, if it is below the limit, and returns whether it is. */
static bool edge_below(sunder_i_part_read *part, uint32_t v, double limit, double *has)
{
    sunder_i_lattice *l = &part->placed.lattice;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point u =
        sunder_i_rational_diff(m, l, sunder_i_part_at(part, sunder_i_part_next(part, v)), sunder_i_part_at(part, v));
    const sunder_i_big square = sunder_i_rational_dot(m, u, u);
    const bool below = sunder_i_distance_below(l, square, sunder_i_big_mul(m, u.w, u.w), limit);
    double down;
    if (below) sunder_i_root(m, square, u.w, l->exponent, has, &down);
    sunder_i_lattice_end(l, mark);
    return below;
}

void sunder_i_part_edges(sunder_i_part_read *part, double limit, bool *found, sunder_illegible *out)
{
    *found = false;
    out->has = INFINITY;
    for (uint32_t v = part->first; v < part->first + part->n; v++) {
        const double *a = sunder_i_part_xy(part, v), *b = sunder_i_part_xy(part, sunder_i_part_next(part, v));
        double has;
        /* a length in doubles has an error of a few units of the last bit, unless its corners are rounded */
        if (!part->shape->rational && hypot(b[0] - a[0], b[1] - a[1]) > limit * (1 + 0x1p-40)) continue;
        if (!edge_below(part, v, limit, &has) || has >= out->has) continue;
        *found = true;
        out->has = has;
        for (int c = 0; c < 2; c++) {
            out->from[c] = a[c];
            out->to[c] = b[c];
        }
    }
}
