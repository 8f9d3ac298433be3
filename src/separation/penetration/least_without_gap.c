/* least_without_gap.c: computes the least separating translation without a gap. The nearest point that no subsum covers
 * is found (penetration_search.c), classified (free_point_kind.c), verified against every pair of pieces
 * (verify_penetration.c), and converted to the caller's form. */
#include "separation/penetration/penetration.h"

#include "separation/penetration/penetration_search.h"

#include <math.h>

/* The memory for two buildings with their subsums and candidates; then only the answer is allocated. */
#define SMALL_BYTES 24576

/* Returns the point with num / den and the vector d reduced, first by the common divisors of num and den, then by those
 * of d and den. The point's numbers become as short as possible without regard to the line's first point. */
static sunder_i_hpoint reduced_point(sunder_i_lattice *l, const sunder_i_free_point *f)
{
    const sunder_i_point a = f->line.a, d = f->line.d;
    sunder_i_i128 num = sunder_i_det_i128(f->t.num), den = sunder_i_det_i128(f->t.den);
    const sunder_i_u128 size = sunder_i_i128_abs(num);
    const sunder_i_i128 common = size ? (sunder_i_i128)sunder_i_u128_gcd(size, (sunder_i_u128)den) : den;
    num /= common;
    den /= common;
    sunder_i_u128 shared = (sunder_i_u128)den;
    if (d.x != 0) shared = sunder_i_u128_gcd(shared, sunder_i_i128_abs(d.x));
    if (d.y != 0) shared = sunder_i_u128_gcd(shared, sunder_i_i128_abs(d.y));
    const int64_t by = (int64_t)shared; /* it divides a coordinate of d */
    const sunder_i_fraction t = {num, den / by, f->t.value * (double)by};
    return sunder_i_hpoint_at(l, a, (sunder_i_point){a.x + d.x / by, a.y + d.y / by}, &t);
}

/* Returns whether a number of the point is not exact as a double, so that rounding it takes long. */
static bool is_long(const sunder_i_hpoint *p)
{
    const uint64_t most = (uint64_t)1 << 53;
    return !sunder_i_hpoint_is_short(p) || p->x.limb[0] > most || p->y.limb[0] > most || p->w > (sunder_i_i128)most;
}

/* Returns the found point as a vector, reduced if its numbers are long. Points that fit exactly are mostly sums of
 * vertices, which are short. */
static sunder_i_exact_translation translation_of(sunder_i_operands *g, const sunder_i_free_point *f)
{
    sunder_i_lattice *l = &g->placed.lattice;
    sunder_i_hpoint point = sunder_i_hpoint_at(l, f->line.a, f->line.b, &f->t);
    if (l->narrow && f->t.den != 0 && is_long(&point)) point = reduced_point(l, f);
    return sunder_i_exact_translation_of(g, &point);
}

static sunder_status answer_without_gap(sunder_i_operands *g, const sunder_i_free_point *f, bool texts,
                                        sunder_separation *out, sunder_error *err)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const sunder_i_exact_translation v = translation_of(g, f);
    out->overlap = out->attained = true;
    sunder_i_near_subsums near;
    out->contact = sunder_i_free_point_contact(g, f, &near);
    sunder_i_answer_numbers(g, &v, out);
    out->rounded_is_free =
        sunder_i_answer_exact(g, &v, out->dx, out->dy) || sunder_i_doubles_free(g, f, &near, out->dx, out->dy);
    if (!sunder_i_free_point_verify(g, f) && !l->arena.failed)
        return sunder_i_fail(err, SUNDER_EFAULT, "internal fault: a translation failed its exact check");
    if (l->arena.failed) return sunder_i_failure_cause(err);
    return texts ? sunder_i_answer_texts(g, &v, out, err) : SUNDER_OK;
}

sunder_status sunder_i_least_without_gap(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *o,
                                         sunder_separation *out, bool *beyond, sunder_error *err)
{
    sunder_i_operands g;
    _Alignas(16) unsigned char memory[SMALL_BYTES];
    const sunder_i_operands_options options = {.tp = o->tp,
                                               .tq = o->tq,
                                               .reflect_q = true,
                                               .force_wide = o->force_wide,
                                               .memory = memory,
                                               .memory_bytes = sizeof memory};
    sunder_status status = sunder_i_operands_init(&g, p, q, &options, err);
    if (status) return status;
    sunder_i_free_point found;
    const double limit = o->upper < INFINITY ? o->upper / g.unit : INFINITY;
    status = sunder_i_nearest_free_point(&g, limit == limit ? limit : INFINITY, &found, err);
    if (status == SUNDER_OK) {
        if (found.found && found.origin)
            status = sunder_i_stay(o->texts, out, err);
        else if (!found.found)
            sunder_i_too_far(o->upper, out, beyond);
        else {
            status = answer_without_gap(&g, &found, o->texts, out, err);
            if (status == SUNDER_OK && out->lower_bound > o->upper) {
                sunder_separation_clear(out);
                sunder_i_too_far(o->upper, out, beyond);
            }
        }
        out->counts = g.placed.lattice.counts;
    }
    sunder_i_operands_free(&g);
    return status;
}
