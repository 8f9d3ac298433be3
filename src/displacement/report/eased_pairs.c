/* What the pairs that remain in conflict lack, what that costs, and what each has to pay at least by itself.
 *
 * A pair is two bodies, or a body and a barrier, of which one may move. It lacks the most that a conflict between its
 * members lacks. Let a conflict lack s at home. After a relative move of length r it lacks at least s - r, and r is at
 * most the sum of the limits. The price of the rest is what the pair has to pay wherever it goes. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/prices.h"
#include "displacement/report/report.h"

#include "base/extremes.h"
#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>

/* A share by which sums and products of a few doubles are rounded at most. */
#define ROUNDED 0x1p-48

typedef struct lacking {
    uint32_t i, j;         /* the bodies; for a barrier, that of its first part */
    double missing, alone; /* at the present place; at least, wherever it goes */
} lacking;

static int by_bodies(const void *a, const void *b)
{
    const lacking *p = a, *q = b;
    return p->i != q->i ? (p->i < q->i ? -1 : 1) : p->j < q->j ? -1 : p->j > q->j;
}

/* Sets *missing to a lower bound of what the conflict lacked at home. */
static sunder_status missing_at_home(const sunder_i_model *model, const sunder_conflict *c, double *missing,
                                     sunder_error *err)
{
    const uint32_t a = (uint32_t)c->a, b = (uint32_t)c->b;
    const double none[2] = {0, 0}, owed = sunder_i_owed_below(model, a, b);
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
static sunder_status measure_conflict(const sunder_i_model *model, const sunder_conflict *c, lacking *out,
                                      sunder_error *err)
{
    const uint32_t i = model->body_of[c->a], j = model->body_of[c->b];
    const double reach = sunder_i_limit_of(&model->body[i]) + sunder_i_limit_of(&model->body[j]);
    *out = (lacking){i, j, c->missing, 0};
    if (reach == INFINITY) return SUNDER_OK;
    const sunder_status status = missing_at_home(model, c, &out->alone, err);
    out->alone = sunder_i_max(0, out->alone - reach * (1 + ROUNDED));
    return status;
}

/* Adds the price of a pair, given by its worst conflicts, to the summary, and what it exceeds the least price by to the
 * body that pays it. */
static void add_pair(sunder_report *report, const sunder_i_model *model, const lacking *pair, sunder_total total[3])
{
    const sunder_i_body *p = &model->body[pair->i], *q = &model->body[pair->j];
    const sunder_i_price price = sunder_i_price_of(model, p, q);
    const double pays = sunder_i_price_at(&price, pair->missing),
                 alone = sunder_i_price_at(&price, pair->alone) * (1 - ROUNDED);
    report->summary.short_pairs++;
    sunder_total_add(&total[0], pair->missing);
    sunder_total_add(&total[1], pays);
    sunder_total_add(&total[2], alone);
    report->overpaid[sunder_i_may_move(p) ? pair->i : pair->j] += pays - alone;
}

static bool is_priced(const sunder_i_model *model, const sunder_conflict *c)
{
    return !isnan(c->missing) && (sunder_i_may_move(&model->body[model->body_of[c->a]]) ||
                                  sunder_i_may_move(&model->body[model->body_of[c->b]]));
}

sunder_status sunder_i_report_eased(sunder_report *report, const sunder_i_model *model, sunder_error *err)
{
    if (!(model->rules.ease > 0)) return SUNDER_OK;
    lacking *list = sunder_i_alloc(report->conflicts, sizeof *list);
    report->overpaid = sunder_i_calloc(model->bodies, sizeof *report->overpaid);
    sunder_status status = list && report->overpaid ? SUNDER_OK : sunder_i_failure_cause(err);
    sunder_total total[3] = {{{0}, 0}};
    size_t n = 0;
    for (size_t k = 0; k < report->conflicts && !status; k++)
        if (is_priced(model, &report->conflict[k]))
            status = measure_conflict(model, &report->conflict[k], &list[n++], err);
    if (!status && n) qsort(list, n, sizeof *list, by_bodies);
    for (size_t k = 0, next; k < n && !status; k = next) {
        for (next = k + 1; next < n && by_bodies(&list[k], &list[next]) == 0; next++) {
            list[k].missing = sunder_i_max(list[k].missing, list[next].missing);
            list[k].alone = sunder_i_max(list[k].alone, list[next].alone);
        }
        add_pair(report, model, &list[k], total);
    }
    report->summary.shortfall = sunder_total_nearest(&total[0]);
    report->summary.cost_shortfall = sunder_total_nearest(&total[1]);
    report->summary.cost_alone = sunder_total_below(&total[2]);
    sunder_i_free(list);
    return status;
}
