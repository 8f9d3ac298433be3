/* What the pairs that remain in conflict, or are tight, lack, what that costs, and what they have to pay at least.
 *
 * A pair is two bodies, or a body and a barrier, of which one may move. It lacks the most that a conflict between its
 * members lacks. Let a conflict lack s at home. After a relative move of length r it lacks at least s - r, and r is at
 * most the sum of the limits. The price of the rest is what the pair has to pay wherever it goes. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/prices.h"
#include "displacement/layer/reads.h"
#include "displacement/report/report.h"

#include "base/extremes.h"
#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>

/* A share by which sums and products of a few doubles are rounded at most. */
#define ROUNDED 0x1p-48

static int by_bodies(const void *a, const void *b)
{
    const sunder_i_lacking *p = a, *q = b;
    return p->i != q->i ? (p->i < q->i ? -1 : 1) : p->j < q->j ? -1 : p->j > q->j;
}

/* Sets *missing to a lower bound of what the conflict lacked at home. */
static sunder_status missing_at_home(const sunder_i_model *model, const sunder_conflict *c, double *missing,
                                     sunder_error *err)
{
    const uint32_t a = (uint32_t)c->a, b = (uint32_t)c->b;
    const double none[2] = {0, 0}, owed = sunder_i_full_below(model, a, b);
    sunder_i_barrier_stance stance = {.distance = c->before};
    sunder_status status = SUNDER_OK;
    if (sunder_i_is_barrier(model, b)) {
        const sunder_i_translate home = sunder_i_at_home(model, a);
        status = sunder_i_barrier_stand(model, &home, b, &stance, err);
    } else {
        bool beyond;
        const sunder_shape *p = sunder_i_thing_shape(model, a), *q = sunder_i_thing_shape(model, b);
        status = sunder_i_overlap(p, none, q, none, &stance.overlap, err);
        if (!status && stance.overlap)
            status = sunder_i_separate(p, none, q, none, 0, INFINITY, &stance.least, &beyond, err);
        if (!status && stance.overlap) sunder_separation_clear(&stance.least);
    }
    const double depth = stance.overlap ? stance.least.distance : -stance.distance;
    *missing = owed + depth - ROUNDED * (owed + fabs(depth));
    return status;
}

/* Fills *out for one conflict. */
static sunder_status measure_conflict(const sunder_i_model *model, const sunder_conflict *c, sunder_i_lacking *out,
                                      sunder_error *err)
{
    const uint32_t i = model->body_of[c->a], j = model->body_of[c->b];
    const bool swap = !sunder_i_may_move(&model->body[i]) || (sunder_i_may_move(&model->body[j]) && j < i);
    const double slack = sunder_i_full_above(model, (uint32_t)c->a, (uint32_t)c->b) - c->required;
    *out = (sunder_i_lacking){swap ? j : i, swap ? i : j, c->missing + slack, 0, 0};
    return missing_at_home(model, c, &out->home, err);
}

/* Adds a pair, given by its worst conflicts, to what its first body pays. */
static void add_pair(const sunder_i_model *model, sunder_i_lacking *pair, sunder_i_paying *paying)
{
    const sunder_i_body *p = &model->body[pair->i], *q = &model->body[pair->j];
    const sunder_i_price price = sunder_i_price_of(model, p, q);
    const double rest = pair->home - (sunder_i_limit_of(p) + sunder_i_limit_of(q)) * (1 + ROUNDED);
    pair->alone = rest > 0 ? sunder_i_price_at(&price, rest) * (1 - ROUNDED) : 0;
    paying->pairs++;
    paying->missing += pair->missing;
    paying->pays += sunder_i_price_at(&price, pair->missing);
    paying->alone += pair->alone;
}

static bool is_priced(const sunder_i_model *model, const sunder_conflict *c)
{
    return !isnan(c->missing) && (sunder_i_may_move(&model->body[model->body_of[c->a]]) ||
                                  sunder_i_may_move(&model->body[model->body_of[c->b]]));
}

size_t sunder_i_merge_lacking(sunder_i_lacking *list, size_t n)
{
    size_t out = 0;
    qsort(list, n, sizeof *list, by_bodies);
    for (size_t k = 0; k < n; k++) {
        if (k == 0 || by_bodies(&list[out - 1], &list[k])) list[out++] = list[k];
        list[out - 1].missing = sunder_i_max(list[out - 1].missing, list[k].missing);
        list[out - 1].home = sunder_i_max(list[out - 1].home, list[k].home);
    }
    return out;
}

static void add_pairs(sunder_report *report, const sunder_i_model *model)
{
    for (size_t k = 0; k < report->eased; k++)
        add_pair(model, &report->lacking[k], &report->paying[report->lacking[k].i]);
    for (size_t b = 0; b < model->bodies; b++) report->paying[b].alone *= 1 - ROUNDED * (double)report->paying[b].pairs;
}

/* Adds up what all bodies pay. The sums are exact until they are rounded once, as those of the bounds are. */
static void add_up(sunder_report *report, size_t bodies)
{
    sunder_total missing = {0}, pays = {0}, alone = {0};
    for (size_t b = 0; b < bodies; b++) {
        report->summary.short_pairs += report->paying[b].pairs;
        sunder_total_add(&missing, report->paying[b].missing);
        sunder_total_add(&pays, report->paying[b].pays);
        sunder_total_add(&alone, report->paying[b].alone);
    }
    report->summary.shortfall = sunder_total_nearest(&missing);
    report->summary.cost_shortfall = sunder_total_nearest(&pays);
    report->summary.cost_alone = sunder_total_below(&alone);
}

/* Adds the pairs of neighbours in rows that lack some of the rule of rows with the full gap. */
static void add_rows(const sunder_i_model *model, sunder_i_lacking *list, size_t *n)
{
    for (uint32_t i = 0; i < model->bodies && model->row_sides && sunder_i_has_slack(model); i++) {
        const sunder_i_extras *has = model->body[i].has;
        for (uint32_t e = has->row_side; e < has->row_side + has->row_sides; e++) {
            const sunder_i_row_side *side = &model->row_side[e];
            const double *t = model->move + 2 * (size_t)i, *s = model->move + 2 * (size_t)side->other;
            const double missing = side->full - ((s[0] - t[0]) * side->along[0] + (s[1] - t[1]) * side->along[1]);
            const bool swap = !sunder_i_may_move(&model->body[i]);
            if (side->other < i || !(missing > 0)) continue;
            list[(*n)++] = (sunder_i_lacking){swap ? side->other : i, swap ? i : side->other, missing, side->full, 0};
        }
    }
}

sunder_status sunder_i_report_eased(sunder_report *report, const sunder_i_model *model, sunder_error *err)
{
    if (!(model->rules.ease > 0)) return SUNDER_OK;
    const size_t conflicts = report->conflicts, pairs = conflicts + report->summary.tight;
    sunder_i_lacking *list = sunder_i_alloc(pairs + model->row_sides, sizeof *list);
    report->paying = sunder_i_calloc(model->bodies, sizeof *report->paying);
    sunder_status status = list && report->paying ? SUNDER_OK : sunder_i_failure_cause(err);
    size_t n = 0;
    for (size_t k = 0; k < pairs && !status; k++) {
        const sunder_conflict *c = k < conflicts ? &report->conflict[k] : &report->tight[k - conflicts];
        if (is_priced(model, c)) status = measure_conflict(model, c, &list[n++], err);
    }
    if (!status) add_rows(model, list, &n);
    report->lacking = list;
    report->eased = status || !n ? 0 : sunder_i_merge_lacking(list, n);
    if (!status) add_pairs(report, model);
    if (!status) add_up(report, model->bodies);
    return status;
}
