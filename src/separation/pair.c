#include "separation/answer.h"
#include "separation/gap.h"
#include "separation/least.h"
#include "separation/nearest.h"

#include <math.h>
#include <string.h>

void sunder_separation_clear(sunder_separation *separation)
{
    if (!separation) return;
    sunder_i_free(separation->dx_text);
    sunder_i_free(separation->dy_text);
    sunder_i_free(separation->distance_squared_text);
    separation->dx_text = separation->dy_text = separation->distance_squared_text = NULL;
}

sunder_status sunder_i_stay(bool texts, sunder_separation *out, sunder_error *err)
{
    out->attained = out->rounded_is_free = true;
    out->contact = SUNDER_CONTACT_NONE;
    if (!texts) return SUNDER_OK;
    char **text[3] = {&out->dx_text, &out->dy_text, &out->distance_squared_text};
    for (int i = 0; i < 3; i++) {
        *text[i] = sunder_i_alloc(2, 1);
        if (!*text[i]) {
            sunder_separation_clear(out);
            return sunder_i_no_memory(err);
        }
        memcpy(*text[i], "0", 2);
    }
    return SUNDER_OK;
}

void sunder_i_too_far(double upper, sunder_separation *out, bool *beyond)
{
    *beyond = true;
    out->overlap = true;
    out->attained = false;
    out->lower_bound = upper;
}

static sunder_status answer_without_gap(sunder_i_pairing *g, const sunder_i_nearest *f, bool texts,
                                        sunder_separation *out, sunder_error *err)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const sunder_i_hpoint point = sunder_i_hpoint_at(l, f->line.a, f->line.b, &f->t);
    const sunder_i_vector_exact v = sunder_i_vector_of(g, &point);
    out->overlap = out->attained = true;
    out->contact = sunder_i_nearest_contact(g, f);
    sunder_i_answer_numbers(g, &v, out);
    out->rounded_is_free = sunder_i_answer_exact(g, &v, out->dx, out->dy) || sunder_i_doubles_free(g, out->dx, out->dy);
    if (!sunder_i_nearest_verify(g, f) && !l->arena.failed)
        return sunder_i_fail(err, SUNDER_EFAULT, "internal fault: a translation failed its exact check");
    if (l->arena.failed) return sunder_i_no_memory(err);
    return texts ? sunder_i_answer_texts(g, &v, out, err) : SUNDER_OK;
}

static sunder_status least_without_gap(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *o,
                                       sunder_separation *out, bool *beyond, sunder_error *err)
{
    sunder_i_pairing g;
    const sunder_i_pairing_options options = {.tp = o->tp, .tq = o->tq, .reflect_q = true, .force_wide = o->force_wide};
    sunder_status status = sunder_i_pairing_init(&g, p, q, &options, err);
    if (status) return status;
    sunder_i_nearest found;
    const double limit = o->upper < INFINITY ? o->upper / g.unit : INFINITY;
    status = sunder_i_nearest_free(&g, limit == limit ? limit : INFINITY, &found, err);
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
    sunder_i_pairing_free(&g);
    return status;
}

sunder_status sunder_i_least(const sunder_shape *p, const sunder_shape *q, const sunder_i_least_options *o,
                             sunder_separation *out, bool *beyond, sunder_error *err)
{
    sunder_separation result;
    bool far = false;
    memset(&result, 0, sizeof result);
    sunder_status status;
    if (p->pieces == 0 || q->pieces == 0 || sunder_i_boxes_apart(p, o->tp, q, o->tq, o->gap))
        status = sunder_i_stay(o->texts, &result, err);
    else if (o->gap > 0)
        status = sunder_i_least_with_gap(p, q, o, &result, &far, err);
    else
        status = least_without_gap(p, q, o, &result, &far, err);
    if (status) return status;
    *out = result;
    if (beyond) *beyond = far;
    return SUNDER_OK;
}

sunder_status sunder_i_separate(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                double gap, double upper, sunder_separation *out, bool *beyond, sunder_error *err)
{
    const sunder_i_least_options options = {.tp = tp, .tq = tq, .gap = gap, .upper = upper};
    return sunder_i_least(p, q, &options, out, beyond, err);
}

sunder_status sunder_pair_separate(const sunder_shape *p, const sunder_shape *q, double gap, sunder_separation *out,
                                   sunder_error *err)
{
    if (!(gap >= 0) || !isfinite(gap))
        return sunder_i_fail(err, SUNDER_EARG, "the gap must be finite and not negative");
    const sunder_i_least_options options = {.gap = gap, .upper = INFINITY, .texts = true};
    return sunder_i_least(p, q, &options, out, NULL, err);
}
