/* The choice of levels is an implicit hitting set problem: the clauses that it has to satisfy are not known beforehand.
 *
 *     repeat  lay the features out with the shapes of their levels, except those that are hidden
 *             each conflict that remains gives a clause: the features of its proof cannot all keep their levels
 *             choose the cheapest levels such that each clause has a member with a greater one
 *     until   no conflict remains that a clause can be made of
 *
 * In the first rounds all features have their smallest shapes. So only hiding can satisfy a clause of theirs. In the
 * later rounds shapes are as given, and the clauses say which features have to become smaller.
 *
 * A proof that features have no solution together with their levels holds with lesser levels, too, since each shape of
 * a feature lies in the one before. It holds whatever else is hidden or becomes smaller, since blocks, limits, anchors,
 * inclusions and rows are those of the whole layer with the shapes as given. So clauses of proofs are never given up,
 * and the cheapest choice for them alone costs no more than any choice that leaves no conflict. A conflict without a
 * proof gives a tentative clause of its two features; no bound rests on it. The present choice does not satisfy the
 * clause of a conflict, so that it is new, and the loop ends. */
#include "displacement/hide/hiding.h"
#include "displacement/hide/tuning.h"
#include "displacement/prove/proofs/feasibility.h"

#include "base/union_find.h"

#include <string.h>

/* Takes the shapes of the present levels. Features that are not hidden get their smallest shapes if all do, or if they
 * were in too many clauses. */
void sunder_i_hiding_take_levels(sunder_i_hiding *h)
{
    for (size_t f = 0; f < h->layer->n; f++) {
        size_t n;
        const sunder_level *smaller = sunder_i_levels_of(h->layer, f, &n);
        if (h->level[f] < n && (h->smallest || h->times[f] > MOST_CLAUSES)) h->level[f] = (uint32_t)n;
        h->hidden[f] = sunder_i_is_hidden_at(h->layer, f, h->level[f]);
        if (h->shape) h->shape[f] = h->level[f] && !h->hidden[f] ? smaller[h->level[f] - 1].shape : h->layer->shape[f];
    }
}

sunder_status sunder_i_hiding_begin(const sunder_layer *layer, sunder_i_hiding *hiding, sunder_error *err)
{
    memset(hiding, 0, sizeof *hiding);
    hiding->layer = layer;
    hiding->level = sunder_i_calloc(layer->n, sizeof *hiding->level);
    hiding->hidden = sunder_i_calloc(layer->n, sizeof *hiding->hidden);
    hiding->times = sunder_i_calloc(layer->n, sizeof *hiding->times);
    hiding->stays = sunder_i_calloc(layer->n, sizeof *hiding->stays);
    if (layer->level_end) {
        hiding->shape = sunder_i_alloc(layer->n, sizeof *hiding->shape);
        if (hiding->shape && layer->n) memcpy(hiding->shape, layer->shape, layer->n * sizeof *hiding->shape);
    }
    const bool ok =
        hiding->level && hiding->hidden && hiding->times && hiding->stays && (hiding->shape || !layer->level_end);
    hiding->smallest = layer->level_end && layer->hiding;
    if (ok) sunder_i_hiding_take_levels(hiding);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

void sunder_i_hiding_free(sunder_i_hiding *hiding)
{
    for (size_t k = 0; k < hiding->sources; k++) sunder_i_proof_free(hiding->source[k].proof);
    sunder_i_free_all(hiding->level, hiding->hidden, hiding->times, (void *)hiding->shape, hiding->source,
                      hiding->stays, hiding->shown.item, hiding->conflict.item);
    sunder_i_influence_free(&hiding->influence);
    sunder_i_clauses_free(&hiding->clauses);
    memset(hiding, 0, sizeof *hiding);
}

/* ---- What a conflict proves -------------------------------------------------------------------------------------- */

static bool add_members(const sunder_i_model *model, uint32_t thing, sunder_i_list *set)
{
    const sunder_i_body *body = &model->body[model->body_of[thing]];
    bool ok = true;
    for (uint32_t m = 0; m < body->members && ok; m++) {
        const uint32_t f = model->member[body->member + m];
        if (model->present[f]) ok = sunder_i_list_push(set, f);
    }
    return ok;
}

/* Does the node ask more of a feature and the barrier that crosses it than not to stand worse? The proof is then about
 * a layout in which the two are apart, though they need not be. */
static bool asks_of_crossed(const sunder_i_model *model, const sunder_proof_node *node)
{
    return !node->shadow && !node->row && !node->held && node->clearance >= 0 &&
           sunder_i_is_crossed(model, (uint32_t)node->a, (uint32_t)node->b);
}

/* Lists the things that the proof names. With the rule of rows for two blocks it names all of their members. Sets
 * *proved to false if the proof rests on the coordinates that the corners of a block can have: without some of its
 * members it can have others; or if it asks more than is owed. */
static bool add_things(const sunder_i_model *model, const sunder_proof *proof, bool *proved, sunder_i_list *set)
{
    bool ok = true;
    *proved = true;
    for (size_t k = 0; k < proof->nodes && ok; k++) {
        const sunder_proof_node *node = &proof->node[k];
        const uint32_t a = (uint32_t)node->a, b = (uint32_t)node->b;
        *proved = *proved && !node->still;
        if (node->ways == 0) continue;
        *proved = *proved && !asks_of_crossed(model, node);
        if (node->row)
            ok = add_members(model, a, set) && add_members(model, b, set);
        else
            ok = sunder_i_list_push(set, sunder_i_whole_of(model, a)) &&
                 sunder_i_list_push(set, sunder_i_whole_of(model, b));
        if (node->chord && ok) ok = sunder_i_list_push(set, sunder_i_whole_of(model, (uint32_t)node->c));
    }
    return ok;
}

/* Lists what cannot all be kept, because of conflict k. */
static bool list_things(const sunder_i_model *model, const sunder_report *report, size_t k, bool *proved,
                        sunder_i_list *set)
{
    const sunder_conflict *c = &report->conflict[k];
    const sunder_proof *proof = report->proof ? report->proof[k] : NULL;
    set->n = 0;
    *proved = false;
    if (proof && !add_things(model, proof, proved, set)) return false;
    if (*proved) return true;
    set->n = 0;
    *proved = c->reason == SUNDER_REASON_FIXED || c->reason == SUNDER_REASON_MAX_SHIFT;
    return sunder_i_list_push(set, (uint32_t)c->a) && sunder_i_list_push(set, (uint32_t)c->b);
}

/* ---- Clauses ----------------------------------------------------------------------------------------------------- */

/* Notes that conflict k of the report is the source of the clause that was added last. Returns false if memory is
 * out. */
static bool note_source(sunder_i_hiding *h, const uint32_t *number, sunder_report *report, size_t k, size_t first,
                        bool proved)
{
    const sunder_conflict *c = &report->conflict[k];
    if (!sunder_i_reserve(&h->source, &h->source_room, h->sources + 1, sizeof *h->source)) return false;
    sunder_i_clause_source *source = &h->source[h->sources++];
    *source = (sunder_i_clause_source){first, number[c->a], number[c->b], c->reason, c->crowded, h->choices, NULL};
    if (!h->keep_proofs || !proved || !report->proof || !report->proof[k]) return true;
    source->proof = report->proof[k];
    report->proof[k] = NULL;
    sunder_i_proof_number(source->proof, number);
    return true;
}

/* May this thing, by the caller's number, get a greater level than it has? */
static bool may_rise(const sunder_i_hiding *h, uint32_t thing)
{
    return thing < h->layer->n && h->level[thing] < sunder_i_last_level(h->layer, thing);
}

/* May it become smaller without being hidden? */
static bool may_shrink(const sunder_i_hiding *h, uint32_t thing)
{
    size_t n;
    if (thing >= h->layer->n) return false;
    sunder_i_levels_of(h->layer, thing, &n);
    return h->level[thing] < n;
}

/* Notes that the features that may get greater levels influenced each other and all other things of the set. */
static void note_influence(sunder_i_hiding *h, const sunder_i_model *model, const uint32_t *number,
                           const sunder_i_list *set)
{
    uint32_t first = UINT32_MAX;
    for (size_t m = 0; m < set->n && h->influence.root; m++) {
        if (!may_rise(h, number[set->item[m]])) continue;
        sunder_i_influence_lower(&h->influence, model, set->item[m]);
        if (first == UINT32_MAX) first = set->item[m];
    }
    for (size_t m = 0; m < set->n && first != UINT32_MAX; m++)
        sunder_i_influence_meet(&h->influence, model, first, set->item[m]);
}

/* Makes a clause of these things with their present levels, because of conflict k, and adds it, if at least one of them
 * may get a greater one. */
static bool add_clause(sunder_i_hiding *h, const sunder_i_model *model, const uint32_t *number, sunder_report *report,
                       size_t k, sunder_i_list *set, bool proved, bool *added)
{
    sunder_i_list item = {0}, level = {0};
    const size_t first = h->clauses.items;
    size_t members = 0;
    bool ok = true;
    note_influence(h, model, number, set);
    for (size_t m = 0; m < set->n; m++) set->item[m] = number[set->item[m]];
    set->n = sunder_i_set_make(set->item, set->n);
    for (int others = 0; others < 2; others++) {
        for (size_t m = 0; m < set->n && ok; m++) {
            if (may_rise(h, set->item[m]) == others) continue;
            ok = sunder_i_list_push(&item, set->item[m]) &&
                 (others || sunder_i_list_push(&level, h->level[set->item[m]]));
        }
        if (!others) members = item.n;
    }
    *added = false;
    if (ok && members)
        ok = sunder_i_clauses_add(&h->clauses, item.item, level.item, members, item.n - members, proved, added);
    if (ok && *added) ok = note_source(h, number, report, k, first, proved);
    for (size_t m = 0; m < members && *added; m++) h->times[item.item[m]] += !h->smallest;
    sunder_i_free_all(item.item, level.item);
    return ok;
}

/* Adds the clauses of the conflicts that are proved. */
static bool add_proved(sunder_i_hiding *h, const sunder_i_model *model, const uint32_t *number, sunder_report *report,
                       bool *any)
{
    sunder_i_list set = {0};
    bool ok = true;
    for (size_t k = 0; k < report->conflicts && ok; k++) {
        bool proved, added = false;
        if (!sunder_i_hiding_counts(&report->conflict[k])) continue;
        ok = list_things(model, report, k, &proved, &set);
        if (ok && proved) ok = add_clause(h, model, number, report, k, &set, true, &added);
        *any = *any || added;
    }
    sunder_i_free(set.item);
    return ok;
}

/* Adds tentative clauses: of each set of conflicts that features connect only that of the first one, since its hidden
 * feature may solve the others. */
static bool add_tentative(sunder_i_hiding *h, const sunder_i_model *model, const uint32_t *number,
                          sunder_report *report, bool *any)
{
    sunder_i_list set = {0};
    uint32_t *parent = sunder_i_alloc(model->things, sizeof *parent);
    bool *done = sunder_i_calloc(model->things, sizeof *done), ok = parent && done;
    if (ok) sunder_i_union_init(parent, model->things);
    for (size_t k = 0; k < report->conflicts && ok; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (sunder_i_hiding_counts(c) && !sunder_i_is_barrier(model, (uint32_t)c->b))
            sunder_i_union_join(parent, (uint32_t)c->a, (uint32_t)c->b);
    }
    for (size_t k = 0; k < report->conflicts && ok; k++) {
        bool proved, added = false;
        const uint32_t root = sunder_i_union_find(parent, (uint32_t)report->conflict[k].a);
        if (!sunder_i_hiding_counts(&report->conflict[k]) || done[root]) continue;
        ok = list_things(model, report, k, &proved, &set) &&
             add_clause(h, model, number, report, k, &set, proved, &added);
        done[root] = ok && added;
        *any = *any || done[root];
    }
    sunder_i_free_all(parent, done, set.item);
    return ok;
}

/* ---- Rounds ------------------------------------------------------------------------------------------------------ */

/* Adds tentative clauses of conflicts without a proof for which a member may become smaller: that costs little, and
 * everything that is not hidden now has a solution with its smallest shape. */
static bool add_shrinking(sunder_i_hiding *h, const sunder_i_model *model, const uint32_t *number,
                          sunder_report *report, bool *any)
{
    sunder_i_list set = {0};
    bool ok = true;
    for (size_t k = 0; k < report->conflicts && ok; k++) {
        const sunder_conflict *c = &report->conflict[k];
        bool proved, added = false;
        if (!sunder_i_hiding_counts(c) || !(may_shrink(h, number[c->a]) || may_shrink(h, number[c->b]))) continue;
        ok = list_things(model, report, k, &proved, &set) &&
             add_clause(h, model, number, report, k, &set, proved, &added);
        *any = *any || added;
    }
    sunder_i_free(set.item);
    return ok;
}

static bool has_conflicts(const sunder_report *report)
{
    for (size_t k = 0; k < report->conflicts; k++)
        if (sunder_i_hiding_counts(&report->conflict[k])) return true;
    return false;
}

/* What follows a layout from which nothing was learnt. A step teaches nothing about conflicts that it does not find, so
 * that each part of the layer takes the same steps, whatever remains in conflict elsewhere. */
static sunder_i_hiding_step step_after(const sunder_i_hiding *h, bool conflicts)
{
    if (h->step == SUNDER_I_HIDING_QUICK) return conflicts ? SUNDER_I_HIDING_PROVE : SUNDER_I_HIDING_THOROUGH;
    return h->step == SUNDER_I_HIDING_PROVE ? SUNDER_I_HIDING_THOROUGH : SUNDER_I_HIDING_END;
}

static sunder_status choose_levels(sunder_i_hiding *h, sunder_error *err)
{
    sunder_i_cover_result result = {.level = h->level};
    const sunder_status status =
        sunder_i_cover_find(&h->clauses, SUNDER_I_COVER_ALL, h->layer, COVER_EFFORT, &result, err);
    h->choices++;
    sunder_i_hiding_take_levels(h);
    return status;
}

sunder_status sunder_i_hiding_learn(sunder_i_hiding *hiding, const sunder_i_model *model, const uint32_t *number,
                                    sunder_report *report, sunder_error *err)
{
    bool learnt = false;
    bool ok = add_proved(hiding, model, number, report, &learnt);
    if (ok && !learnt && !hiding->smallest) ok = add_shrinking(hiding, model, number, report, &learnt);
    if (ok && !learnt && hiding->step == SUNDER_I_HIDING_THOROUGH)
        ok = add_tentative(hiding, model, number, report, &learnt);
    if (!ok) return sunder_i_failure_cause(err);
    hiding->step = learnt ? SUNDER_I_HIDING_QUICK : step_after(hiding, has_conflicts(report));
    if (learnt) return choose_levels(hiding, err);
    if (hiding->step != SUNDER_I_HIDING_END || !hiding->smallest) return SUNDER_OK;
    hiding->smallest = false;
    hiding->step = SUNDER_I_HIDING_QUICK;
    return choose_levels(hiding, err);
}
