/* What limits and fixed bodies leave no solution for: pairs that no admissible moves bring to peace, found exactly
 * before anything moves; pairs that a cluster gave up. */
#include "displacement/clusters/settle.h"
#include "displacement/clusters/stages.h"
#include "displacement/layer/inclusion.h"
#include "displacement/layer/resolution.h"

#include "base/parallel.h"

#include <math.h>

static bool is_settled(const sunder_i_job *w, const sunder_i_relation *r)
{
    return w->improved[w->town.body_of[r->a]] || w->improved[w->town.body_of[r->b]];
}

sunder_status sunder_i_job_choose_holders(sunder_i_job *w, sunder_error *err)
{
    if (w->town.kept_n == 0) return SUNDER_OK;
    bool *conflict = sunder_i_calloc(w->start.n, sizeof *conflict);
    if (!conflict) return sunder_i_no_memory(err);
    for (size_t k = 0; k < w->start.n; k++)
        conflict[k] = !is_settled(w, &w->start.pair[k]) && sunder_i_job_is_between(&w->town, &w->start.pair[k]);
    const sunder_status status = sunder_i_keep_choose(&w->town, &w->start, conflict, err);
    sunder_i_free(conflict);
    return status;
}

/* ---- Hopeless by itself ------------------------------------------------------------------------------------------ */

typedef struct judging {
    const sunder_i_town *town;
    const sunder_i_relations *start;
    sunder_i_truce *truce; /* [start->n] hopeless ones are filled */
    sunder_i_peace *peace; /* [start->n] */
} judging;

/* Is there surely a move of no more than `reach` that takes b's box the gap off a's? It spares the exact question. */
static bool boxes_can_part(const double *a, const double *b, double gap, double reach)
{
    const double out = fmin(fmin(a[2] - b[0], b[2] - a[0]), fmin(a[3] - b[1], b[3] - a[1]));
    return out + gap < reach * (1 - 0x1p-40);
}

static sunder_status judge(void *context, size_t begin, size_t end, sunder_error *err)
{
    const judging *g = context;
    const sunder_i_town *town = g->town;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        const sunder_i_relation *r = &g->start->pair[k];
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        const double reach = sunder_i_limit_of(&town->body[i]) + sunder_i_limit_of(&town->body[j]);
        if (!sunder_i_job_is_between(town, r) || reach == INFINITY ||
            boxes_can_part(town->box + 4 * (size_t)r->a, town->box + 4 * (size_t)r->b, town->rules.gap, reach))
            continue;
        status = sunder_i_make_peace(&town->rules, town->layer->feature[r->a].shape, town->layer->feature[r->b].shape,
                                     nextafter(reach, INFINITY), &g->peace[k], err);
        if (status || !g->peace[k].beyond) continue;
        status = sunder_i_truce_of(town, r->a, r->b, &g->truce[k], err);
        g->truce[k].hopeless = true;
    }
    return status;
}

/* Takes over what was found of pair r. */
static sunder_status note(sunder_i_job *w, const sunder_i_relation *r, const sunder_i_truce *truce,
                          const sunder_i_peace *peace, sunder_error *err)
{
    sunder_i_town *town = &w->town;
    if (truce->hopeless) return sunder_i_truces_add(&town->truces, truce) ? SUNDER_OK : sunder_i_no_memory(err);
    const sunder_i_body *p = &town->body[town->body_of[r->a]], *q = &town->body[town->body_of[r->b]];
    const double reach = sunder_i_limit_of(p) + sunder_i_limit_of(q);
    if (!peace->apart_beyond || !peace->inside || hypot(peace->place[0], peace->place[1]) > reach) return SUNDER_OK;
    if (!sunder_i_reserve(&w->entry, &w->entry_capacity, w->entries + 1, sizeof *w->entry))
        return sunder_i_no_memory(err);
    w->entry[w->entries++] = (sunder_i_entry){r->a, r->b, peace->a_inside, {peace->place[0], peace->place[1]}};
    return sunder_i_keep_add(town, r->a, r->b, peace->a_inside, err);
}

sunder_status sunder_i_job_judge(sunder_i_job *w, sunder_error *err)
{
    const size_t n = w->start.n;
    judging g = {&w->town, &w->start, sunder_i_calloc(n, sizeof *g.truce), sunder_i_calloc(n, sizeof *g.peace)};
    sunder_status status = g.truce && g.peace ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status) status = sunder_i_keep_note(&w->town, &w->start, err);
    if (!status) status = sunder_i_parallel(w->town.rules.threads, n, 8, judge, &g, err);
    for (size_t k = 0; !status && k < n; k++) status = note(w, &w->start.pair[k], &g.truce[k], &g.peace[k], err);
    if (!status && !sunder_i_truces_index(&w->town.truces, &w->town)) status = sunder_i_no_memory(err);
    sunder_i_free(g.truce);
    sunder_i_free(g.peace);
    return status;
}
