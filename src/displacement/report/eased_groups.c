/* Bounds of the contact groups whose pairs are eased: trees in which these pairs have prices.
 *
 * A tree is about the bodies of the group, and the parts of barriers that these lack distance from. Its guests are
 * bodies that are in no group. Each group is proved by itself. If two have taken in the same guest, the later one is
 * proved again without it, so that the bounds of groups add up.
 *
 * If that tree does not come near the cost, each body has a tree of its own, with the prices of its pairs with what
 * does not move. Their sum, and the least prices of the other pairs, are a bound of the group, too.
 */
#include "displacement/layer/reads.h"
#include "displacement/prove/optimum/body_contact.h"
#include "displacement/prove/optimum/tree.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/extremes.h"
#include "base/parallel.h"

#include <math.h>
#include <string.h>

typedef struct easing {
    const sunder_report *report;
    sunder_i_solver *solver;
    uint32_t *group_of; /* [bodies] the group of each body, or of the group that has it as a guest; SUNDER_I_NOBODY */
    sunder_i_group *former; /* [groups] the bounds, trees and guests before, of groups whose bounds were raised here */
} easing;

/* The bodies and prices of one group, or of one body, and what was proved of it. */
typedef struct eased_group {
    sunder_i_list body;
    sunder_i_lacking *pair; /* [prices] those that have a price, sorted; a barrier has the body of its first part */
    sunder_i_task_price *price;
    size_t prices, pair_capacity, movers;
    double pays, cost; /* the prices at the present place; with the cost of moves and springs */
    double bound;
    sunder_i_list guests;
    sunder_i_bound_trees trees; /* if they are kept */
} eased_group;

static void free_eased(eased_group *e)
{
    sunder_i_bound_trees_free(&e->trees);
    sunder_i_free_all(e->body.item, e->pair, e->price, e->guests.item);
}

/* ---- What a tree is about ---------------------------------------------------------------------------------------- */

/* Is the pair one of the group? It is if the group has both bodies, or if the second one does not move. */
static bool is_of_group(const sunder_i_model *model, const sunder_i_group *g, const sunder_i_lacking *l)
{
    return sunder_i_set_has(g->body, g->n, l->i) && (model->body[l->j].fixed || sunder_i_set_has(g->body, g->n, l->j));
}

static bool add_pair(eased_group *e, const sunder_i_lacking *pair)
{
    if (!sunder_i_reserve(&e->pair, &e->pair_capacity, e->prices + 1, sizeof *e->pair)) return false;
    e->pair[e->prices++] = *pair;
    return true;
}

/* Adds two bodies if they are, or were at home, no farther from each other than the full distance. */
static bool add_near_pair(const sunder_i_model *full, eased_group *e, uint32_t p, uint32_t q)
{
    const sunder_i_body *other = &full->body[q];
    const double none[2] = {0, 0};
    bool near, before;
    if (full->body[p].fixed && other->fixed) return true;
    if (full->body[p].fixed) return add_near_pair(full, e, q, p);
    if (!sunder_i_are_in_contact(full, p, q, full->move + 2 * (size_t)p, full->move + 2 * (size_t)q, &near) ||
        !sunder_i_are_in_contact(full, p, q, none, none, &before))
        return false;
    if (!near && !before) return true;
    if (sunder_i_is_barrier_body(full, other)) q = full->body_of[sunder_i_whole_of(full, full->member[other->member])];
    return add_pair(e, &(sunder_i_lacking){.i = p, .j = q});
}

/* Sets the pairs of the group that have a price: those that lack something, and with a least gap all that are near. */
static bool gather_pairs(const sunder_report *report, const sunder_i_model *model, const sunder_i_group *g,
                         eased_group *e)
{
    sunder_i_barriers barriers;
    const sunder_i_model full = sunder_i_with_full_gap(model, &barriers);
    bool ok = true;
    for (size_t k = 0; k < report->eased && ok; k++)
        if (is_of_group(model, g, &report->lacking[k])) ok = add_pair(e, &report->lacking[k]);
    for (size_t k = 0; k < g->n && e->movers <= MOST_EASED && sunder_i_has_slack(model); k++)
        for (size_t m = k + 1; m < g->n && ok; m++) ok = add_near_pair(&full, e, g->body[k], g->body[m]);
    if (ok && e->prices) e->prices = sunder_i_merge_lacking(e->pair, e->prices);
    return ok;
}

static bool gather_bodies(const sunder_i_model *model, const sunder_i_group *g, eased_group *e)
{
    bool ok = true;
    for (size_t k = 0; k < g->n && ok; k++) ok = sunder_i_list_push(&e->body, g->body[k]);
    for (size_t k = 0; k < e->prices && ok; k++)
        ok = sunder_i_tree_list_parts(model, e->pair[k].i, e->pair[k].j, &e->body);
    e->body.n = sunder_i_set_make(e->body.item, e->body.n);
    return ok;
}

static uint32_t place_of(const eased_group *e, uint32_t body)
{
    return (uint32_t)sunder_i_lower_bound(&body, e->body.item, e->body.n, sizeof body, sunder_i_by_number);
}

/* Sets the prices of the group's pairs, and the most that these may lack, on the safe side of rounding. With a least
 * gap a pair may lack more than at the start. */
static bool gather_prices(const sunder_i_model *model, eased_group *e)
{
    e->price = sunder_i_alloc(e->prices, sizeof *e->price);
    for (size_t k = 0; k < e->prices && e->price; k++) {
        const sunder_i_lacking *l = &e->pair[k];
        const sunder_i_body *p = &model->body[l->i], *q = &model->body[l->j];
        const sunder_i_price price = sunder_i_price_of(model, p, q);
        const double owed = sunder_i_owed_above(model, model->member[p->member], model->member[q->member]);
        const uint32_t i = place_of(e, l->i), j = place_of(e, l->j);
        e->pays += sunder_i_price_at(&price, l->missing);
        e->price[k] =
            (sunder_i_task_price){i < j ? i : j,
                                  i < j ? j : i,
                                  {price.linear * (1 - PRICE_ROOM), price.square * (1 - PRICE_ROOM)},
                                  sunder_i_has_slack(model) ? INFINITY : l->home + MOST_ROOM * (l->home + owed),
                                  sunder_i_max(0, l->home)};
    }
    return e->price;
}

static bool gather(const sunder_report *report, const sunder_i_model *model, const sunder_i_group *g, eased_group *e)
{
    for (size_t k = 0; k < g->n; k++) e->movers += !model->body[g->body[k]].fixed;
    return gather_pairs(report, model, g, e) && (!e->prices || (gather_bodies(model, g, e) && gather_prices(model, e)));
}

/* ---- Proofs ------------------------------------------------------------------------------------------------------ */

/* Keeps what the tree proves, and the bodies that joined it as guests. Returns false if memory is out. */
static bool keep_bound(sunder_i_tree *tree, void *context)
{
    eased_group *e = context;
    const sunder_i_model *model = tree->task.model;
    bool ok = true;
    e->bound = sunder_i_tree_bound(tree);
    for (size_t k = e->body.n; k < tree->task.n && ok; k++)
        if (!model->body[tree->body[k]].fixed) ok = sunder_i_list_push(&e->guests, tree->body[k]);
    e->guests.n = sunder_i_set_make(e->guests.item, e->guests.n);
    return ok && (!tree->task.keep || sunder_i_tree_keep(tree, &e->trees));
}

/* Proves a bound of what the bodies and prices of *e cost. group: NULL if there are no guests. */
static bool prove_eased(const easing *x, const sunder_i_group *group, eased_group *e, double steps)
{
    const sunder_i_model *model = &x->solver->model;
    const sunder_i_waived waived = {.pair = x->solver->groups.waived, .n = x->solver->groups.waived_n};
    sunder_i_task task = {.model = model,
                          .waived = &waived,
                          .group_of = group ? x->group_of : NULL,
                          .group = group ? group->number : SUNDER_I_NOBODY,
                          .body = e->body.item,
                          .n = e->body.n,
                          .goal = e->cost * (1 - EASED_NEAR),
                          .all_springs = true,
                          .price = e->price,
                          .prices = e->prices,
                          .keep = model->rules.keep_trees};
    const sunder_i_priced_run run = {(uint64_t)sunder_i_min(steps, 0x1p62), NULL, keep_bound, e};
    return sunder_i_tree_run_priced(&task, &run);
}

/* Gives the group a greater bound, with its trees and guests. *former: receives what it had before. */
static void raise_bound(sunder_i_group *g, sunder_i_group *former, eased_group *e)
{
    if (!(e->bound > g->bound)) return;
    if (former->bound < 0) {
        *former = (sunder_i_group){.bound = g->bound, .trees = g->trees, .guests = g->guests};
        g->trees = (sunder_i_bound_trees){0};
        g->guests = (sunder_i_list){0};
    }
    const sunder_i_list guests = g->guests;
    const sunder_i_bound_trees trees = g->trees;
    g->bound = e->bound;
    g->guests = e->guests;
    g->trees = e->trees;
    e->guests = guests;
    e->trees = trees;
}

static void lower_bound(sunder_i_group *g, sunder_i_group *former)
{
    sunder_i_free(g->guests.item);
    sunder_i_bound_trees_free(&g->trees);
    g->bound = former->bound;
    g->guests = former->guests;
    g->trees = former->trees;
    *former = (sunder_i_group){.bound = -1};
}

/* Proves a bound of what one body costs with the prices of its pairs with what does not move, and adds it to that of
 * the whole group. */
static bool prove_body(const easing *x, uint32_t body, eased_group *all)
{
    const sunder_i_model *model = &x->solver->model;
    sunder_i_group alone = {.body = &body, .n = 1, .number = body};
    eased_group e = {0};
    bool ok = gather(x->report, model, &alone, &e);
    e.cost = sunder_i_move_cost(model, body, model->move + 2 * (size_t)body) + e.pays;
    if (ok && e.prices) ok = prove_eased(x, NULL, &e, BODY_STEPS);
    if (ok && e.bound > 0) {
        all->bound = all->bound > 0 ? nextafter(all->bound + e.bound, -INFINITY) : e.bound;
        ok = sunder_i_bound_trees_take(&all->trees, &e.trees);
    }
    free_eased(&e);
    return ok;
}

/* The same for all bodies of the group, with the least prices of its other pairs. */
static bool prove_bodies(const easing *x, const sunder_i_group *g, eased_group *all)
{
    const sunder_report *report = x->report;
    const sunder_i_model *model = &x->solver->model;
    double rest = 0, added = 0;
    bool ok = true;
    for (size_t k = 0; k < g->n && ok; k++)
        if (!model->body[g->body[k]].fixed && report->paying[g->body[k]].pairs) ok = prove_body(x, g->body[k], all);
    for (size_t k = 0; k < report->eased && ok; k++) {
        const sunder_i_lacking *l = &report->lacking[k];
        if (model->body[l->j].fixed || !sunder_i_set_has(g->body, g->n, l->i)) continue;
        rest += l->alone;
        added++;
    }
    all->bound = (all->bound + rest) * (1 - (added + 8) * 0x1p-50);
    return ok;
}

static sunder_status prove_group(const easing *x, sunder_i_group *g, sunder_i_group *former, sunder_error *err)
{
    const sunder_i_model *model = &x->solver->model;
    eased_group e = {.cost = g->cost}, each = {0};
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, model, g->number);
    bool ok = gather(x->report, model, g, &e);
    const double steps = EASED_STEPS * sunder_i_max(FEWEST_EASED, (double)e.movers) * model->rules.effort;
    if (ok && e.prices && e.movers <= MOST_EASED && steps > 0) ok = prove_eased(x, g, &e, steps);
    if (ok) raise_bound(g, former, &e);
    if (ok && e.prices && g->bound < g->cost * (1 - BODIES_NEAR)) ok = prove_bodies(x, g, &each);
    if (ok) raise_bound(g, former, &each);
    sunder_i_reads_end(&reading);
    free_eased(&e);
    free_eased(&each);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status prove_groups(void *context, size_t begin, size_t end, sunder_error *err)
{
    const easing *x = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++)
        if (x->solver->groups.group[k].cost > 0)
            status = prove_group(x, &x->solver->groups.group[k], &x->former[k], err);
    return status;
}

/* Does a former group have one of the guests of this one? */
static bool shares_guest(const easing *x, const sunder_i_group *g)
{
    for (size_t k = 0; k < g->guests.n; k++)
        if (x->group_of[g->guests.item[k]] != SUNDER_I_NOBODY) return true;
    return false;
}

static void take_guests(easing *x, const sunder_i_group *g)
{
    for (size_t m = 0; m < g->guests.n; m++) x->group_of[g->guests.item[m]] = g->number;
}

/* Gives each guest to one group: to one whose bound was not raised here, or to the first. */
static sunder_status part_guests(easing *x, sunder_error *err)
{
    sunder_i_groups *groups = &x->solver->groups;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < groups->n; k++)
        if (x->former[k].bound < 0) take_guests(x, &groups->group[k]);
    for (size_t k = 0; k < groups->n && !status; k++) {
        sunder_i_group *g = &groups->group[k];
        if (x->former[k].bound < 0) continue;
        if (shares_guest(x, g)) {
            lower_bound(g, &x->former[k]);
            status = prove_group(x, g, &x->former[k], err);
        }
        take_guests(x, g);
    }
    return status;
}

sunder_status sunder_i_report_eased_groups(const sunder_report *report, sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_groups *groups = &solver->groups;
    easing x = {report, solver, sunder_i_alloc(solver->model.bodies, sizeof *x.group_of),
                sunder_i_alloc(groups->n, sizeof *x.former)};
    sunder_status status = x.group_of && x.former ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) {
        memcpy(x.group_of, groups->of, solver->model.bodies * sizeof *x.group_of);
        for (size_t k = 0; k < groups->n; k++) x.former[k] = (sunder_i_group){.bound = -1};
        status = sunder_i_parallel(solver->model.rules.threads, groups->n, 1, prove_groups, &x, err);
        if (!status) status = part_guests(&x, err);
        for (size_t k = 0; k < groups->n; k++) sunder_i_group_free(&x.former[k]);
    }
    sunder_i_free_all(x.group_of, x.former);
    return status;
}
