/* A contact group: the bound proved for it, and the cheaper layouts that its branch and bound finds.
 *
 * Any layout costs at least the sum, over disjoint groups, of the bound of each. So a group whose layout costs as much
 * as its bound cannot be improved, wherever the others go. From a cheaper layout found by branching the search descends
 * until it is free of all neighbours in their present positions; then it is accepted. If it collides with another group
 * the two are joined. Groups for which branching does not complete are bounded by blocks (blocks.c). */
#include "displacement/prove/optimum/optimum.h"
#include "displacement/layer/stage_table.h"
#include "displacement/prove/optimum/blocks.h"
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool sunder_i_group_is_optimal(const sunder_i_group *group)
{
    return group->cost - group->bound <= OPTIMAL_SHARE * group->cost + OPTIMAL_MORE;
}

void sunder_i_group_free(sunder_i_group *group)
{
    sunder_i_free_all(group->body, group->move, group->guests.item, group->joins.item);
    sunder_i_bound_trees_free(&group->trees);
    sunder_i_trace_log_free(&group->log);
    *group = (sunder_i_group){0};
}

/* Returns the cost of n bodies with these moves, and of the springs between them, rounded upwards. */
static double cost_of(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move)
{
    double cost = sunder_i_springs_within(model, body, n, move);
    for (size_t k = 0; k < n; k++)
        if (!model->body[body[k]].fixed)
            cost += model->body[body[k]].weight * sunder_i_stray_square(model, body[k], move + 2 * k);
    return cost * (1 + ((double)n + 8) * 0x1p-50);
}

/* Returns the bound to be proved for a group: its cost, less half of the share that still counts as optimal, and less
 * the cost of moving its heaviest body by the share SMALL_LENGTH of the gap or, if that is 0, of the share SMALL_EXTENT
 * of the smallest movable body. (A fixed one may be a road, miles long.) Only lengths of the layer itself are used, so
 * that a layer on another scale gets the same moves. */
static double goal_of(const sunder_i_model *model, const sunder_i_group *g)
{
    double length = INFINITY, weight = 0;
    for (size_t k = 0; k < g->n; k++) {
        const sunder_i_body *b = &model->body[g->body[k]];
        if (b->fixed) continue;
        weight = sunder_i_max(weight, b->weight);
        length = sunder_i_min(length, SMALL_EXTENT * sunder_i_max(b->box[2] - b->box[0], b->box[3] - b->box[1]));
    }
    if (model->rules.gap > 0 || weight == 0) length = model->rules.gap;
    return g->cost * (1 - OPTIMAL_SHARE / 2) - weight * (SMALL_LENGTH * length) * (SMALL_LENGTH * length);
}

typedef struct standing {
    uint32_t body;
    double t[2];
} standing;

/* Descends from the moves of n bodies to a layout that keeps a margin; with `tight`, looks for a layout near them that
 * has no margin. *cost is the cost of the layout found, INFINITY if there is none. */
static sunder_status settle_layout(const sunder_i_model *model, const sunder_i_waived *waived, const sunder_i_group *g,
                                   uint32_t *body, size_t n, bool tight, double *move, double *cost, sunder_error *err)
{
    bool found;
    *cost = INFINITY;
    if (tight) {
        if (!sunder_i_tight_place(model, waived, body, n, TIGHT_MARGIN * g->margin, move, &found))
            return sunder_i_failure_cause(err);
    } else {
        const double most = g->cost + sunder_i_springs_beyond(model, g->body, g->n, g->move);
        const sunder_status status = g->search->descend(model, body, n, g->margin, most, move, &found, err);
        if (status) return status;
    }
    if (found) *cost = cost_of(model, body, n, move);
    return SUNDER_OK;
}

/* Looks for a layout near the moves t of n bodies, which may include guests. If it is cheaper than the group's layout,
 * it replaces that, and *better is set; otherwise *better is false, as it is if the group's moves are held. */
static sunder_status attempt_layout(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *g,
                                    const uint32_t *body, const double *t, size_t n, bool tight, bool *better,
                                    sunder_error *err)
{
    standing *at = sunder_i_alloc(n, sizeof *at);
    uint32_t *list = sunder_i_alloc(n, sizeof *list);
    double *move = sunder_i_alloc(2 * n, sizeof *move);
    sunder_status status = at && list && move ? SUNDER_OK : sunder_i_failure_cause(err);
    *better = false;
    if (!status && !g->held) {
        for (size_t k = 0; k < n; k++) at[k] = (standing){body[k], {t[2 * k], t[2 * k + 1]}};
        qsort(at, n, sizeof *at, sunder_i_by_number);
        for (size_t k = 0; k < n; k++) {
            list[k] = at[k].body;
            memcpy(move + 2 * k, at[k].t, sizeof at[k].t);
        }
        const double beyond = sunder_i_springs_beyond(model, g->body, g->n, g->move);
        double cost;
        status = settle_layout(model, waived, g, list, n, tight, move, &cost, err);
        const double more = cost < INFINITY ? sunder_i_springs_beyond(model, list, n, move) - beyond : 0;
        if (!status && cost < g->cost * (1 - CHEAPER) && cost + more < g->cost * (1 - CHEAPER)) {
            sunder_i_free_all(g->body, g->move);
            g->body = list;
            g->move = move;
            g->n = n;
            g->cost = cost;
            g->state = tight ? SUNDER_I_IS_CHEAPER_TIGHT : SUNDER_I_IS_CHEAPER;
            *better = true;
            list = NULL;
            move = NULL;
        }
    }
    sunder_i_free_all(at, list, move);
    return status;
}

sunder_status sunder_i_group_descend(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *group,
                                     const double *t, sunder_error *err)
{
    bool better;
    return attempt_layout(model, waived, group, group->body, t, group->n, false, &better, err);
}

/* Is making the pairs too expensive for blocks, which make them again in each evaluation? */
static bool blocks_are_dear(const sunder_i_tree *tree, uint64_t steps)
{
    return tree->pair_steps > steps / BLOCKS_ASKED;
}

/* Returns the total of steps that the tree of a large group may take; 0 if it is not to be continued. taken: the total
 * that it was given last and has used up; 0 at first. At a higher effort the tree gets at least the steps of effort 1
 * if making its pairs takes a large share of those. */
static uint64_t steps_of_large(const sunder_i_tree *tree, uint64_t taken, uint64_t steps)
{
    const double share = taken ? sunder_i_tree_bound(tree) / tree->task.goal : 0;
    const uint64_t once = (uint64_t)((double)steps / sunder_i_max(tree->task.model->rules.effort, 1));
    if (taken == 0) return steps / TREE_FIRST;
    if (taken < once && blocks_are_dear(tree, once)) return once;
    if (share >= TREE_WHOLE_SHARE || blocks_are_dear(tree, steps)) return steps;
    return share >= TREE_SECOND_SHARE ? steps / TREE_SECOND : 0;
}

/* Runs the group's tree, and descends from each layout that it finds. For a large group at most steps / TREE_SECOND of
 * its steps are counted in g->steps: the tree takes the others in place of blocks, whose steps are not counted
 * either. */
static sunder_status run_tree(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *g,
                              sunder_i_tree *tree, uint64_t steps, bool large, sunder_error *err)
{
    for (uint64_t most = large ? steps_of_large(tree, 0, steps) : steps;;) {
        bool better;
        const sunder_i_tree_outcome outcome = sunder_i_tree_run(tree, most);
        if (tree->failed) return sunder_i_failure_cause(err);
        const uint64_t more = outcome == SUNDER_I_TREE_SPENT && large ? steps_of_large(tree, most, steps) : 0;
        if (more > most) {
            most = more;
            continue;
        }
        if (outcome != SUNDER_I_TREE_FOUND) break;
        const double *t = tree->program.t, cost = cost_of(model, tree->body, tree->task.n, t);
        bool tighter = false;
        sunder_status status = attempt_layout(model, waived, g, tree->body, t, tree->task.n, false, &better, err);
        if (!status && !g->with_slack && cost < g->cost * (1 - OPTIMAL_SHARE))
            status = attempt_layout(model, waived, g, tree->body, t, tree->task.n, true, &tighter, err);
        if (status) return status;
        if (better || tighter) sunder_i_tree_lower_goal(tree, goal_of(model, g));
    }
    g->bound = sunder_i_max(g->bound, sunder_i_tree_bound(tree));
    g->steps += large && tree->steps > steps / TREE_SECOND ? steps / TREE_SECOND : tree->steps;
    sunder_i_free(g->joins.item);
    g->joins = tree->joins;
    tree->joins = (sunder_i_list){0};
    return SUNDER_OK;
}

/* Adds to g->guests the bodies that joined the tree as guests: those from place `from` on. Returns false if memory is
 * out. */
static bool keep_guests(sunder_i_group *g, const sunder_i_tree *tree, size_t from)
{
    for (size_t k = from; k < tree->task.n; k++)
        if (!sunder_i_list_push(&g->guests, tree->body[k])) return false;
    g->guests.n = sunder_i_set_make(g->guests.item, g->guests.n);
    return true;
}

/* Makes a quick trial with blocks; they are evaluated fully only if it proves at least `enough` (*promising). For a
 * group small enough for a tree that ended without a proof they seldom prove more than the tree. */
static sunder_status look_at_blocks(const sunder_i_model *model, const sunder_i_waived *waived, const sunder_i_group *g,
                                    double enough, uint64_t steps, bool *promising, sunder_error *err)
{
    sunder_i_bound_trees trees = {0};
    double bound;
    const sunder_status status = sunder_i_blocks_bound(model, waived, g, steps / QUICK_LOOK, 0, &bound, &trees, err);
    sunder_i_bound_trees_free(&trees);
    *promising = bound >= enough;
    return status;
}

/* Replaces the group's bound by that of blocks, if it is greater. */
static sunder_status prove_blocks(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *g,
                                  uint64_t steps, sunder_error *err)
{
    sunder_i_bound_trees trees = {0};
    double bound;
    const sunder_status status = sunder_i_blocks_bound(model, waived, g, steps, g->bound, &bound, &trees, err);
    if (!status && bound > g->bound) {
        const sunder_i_bound_trees before = g->trees;
        g->trees = trees;
        g->bound = bound;
        trees = before;
    }
    sunder_i_bound_trees_free(&trees);
    return status;
}

/* Proves blocks of a dense group: a quick trial proves most of what they can. If it proves little it was too short for
 * the group's number of pieces, and they get all steps. */
static sunder_status prove_dense_group(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *g,
                                       uint64_t steps, sunder_error *err)
{
    const sunder_status status = prove_blocks(model, waived, g, steps / CROWD_LOOK, err);
    if (status || g->bound >= QUICK_SHARE * g->cost) return status;
    return prove_blocks(model, waived, g, steps, err);
}

/* Proves blocks of a part of a group, fully only if a quick trial proves a good share of its cost: if all bodies have
 * moved far, pushed by all others, few of them alone have only a weak bound, at any effort. */
static sunder_status prove_part(const sunder_i_model *model, const sunder_i_waived *waived, const sunder_i_group *part,
                                uint64_t steps, double *bound, sunder_i_bound_trees *trees, sunder_error *err)
{
    const sunder_status status = sunder_i_blocks_bound(model, waived, part, steps / QUICK_LOOK, 0, bound, trees, err);
    if (status || *bound < QUICK_SHARE * part->cost) return status;
    return sunder_i_blocks_bound(model, waived, part, steps, *bound, bound, trees, err);
}

/* Proves a group too large for a program over all of it: parts of consecutive bodies, each by blocks. */
static sunder_status prove_parts(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *g,
                                 uint64_t steps, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t first = 0; first < g->n && !status; first += PART) {
        sunder_i_bound_trees trees = {0};
        sunder_i_group part = {.body = g->body + first,
                               .move = g->move + 2 * first,
                               .n = g->n - first < PART ? g->n - first : PART,
                               .number = g->number};
        double bound = 0;
        part.cost = cost_of(model, part.body, part.n, part.move);
        if (part.cost > 0) status = prove_part(model, waived, &part, steps / g->n * part.n, &bound, &trees, err);
        if (!status && !sunder_i_bound_trees_take(&g->trees, &trees)) status = sunder_i_failure_cause(err);
        sunder_i_bound_trees_free(&trees);
        if (bound > 0) g->bound = nextafter(g->bound + bound, -INFINITY);
    }
    g->steps += steps;
    return status;
}

/* ---- The stages of a proof --------------------------------------------------------------------------------------- */

/* The state that the stages of one group share. */
typedef struct proving {
    sunder_i_stage_run run;
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    const uint32_t *group_of;
    sunder_i_group *g;
    uint64_t steps;
    double known;               /* the bound that was proved before; the proof ends if it suffices */
    double before;              /* the cost at the beginning; a cheaper layout found here may have to be undone later */
    size_t movers;              /* the number of movable bodies */
    bool asked;                 /* the group costs little more than when it was last examined fully */
    bool conflicted, unlimited; /* it has many remaining conflicts: only blocks and parts prove much; or it is
                                 * unlimited: prices of area do */
    bool spent, exhausted_tree; /* the tree of a large group, or of a small one, used all its steps */
} proving;

/* The steps that the present stage may take. */
static uint64_t steps_of_stage(const proving *x) { return x->steps / x->run.budget; }

static bool is_too_large(const void *state) { return ((const proving *)state)->movers > MOST_TOGETHER; }

static bool has_many_conflicts(const void *state) { return ((const proving *)state)->conflicted; }

static bool is_beyond_branching(const void *state) { return ((const proving *)state)->movers > BRANCHED; }

static bool is_large_and_unlimited(const void *state)
{
    const proving *x = state;
    return x->unlimited && x->movers > LARGE_FREE_CROWD;
}

static bool is_small(const void *state) { return ((const proving *)state)->movers <= BRANCHED; }

static bool is_worth_blocks(const void *state)
{
    const proving *x = state;
    return x->movers > FEW && !x->asked;
}

/* If a group costs little more than when it was last examined fully (a rounding error undid its move, or it has lost or
 * gained a few bodies), neither blocks nor parts are evaluated again. */
static void prove_in_parts(void *state)
{
    proving *x = state;
    const uint64_t steps = x->conflicted ? steps_of_stage(x) / CROWD_LOOK : steps_of_stage(x);
    x->run.over = true;
    if (x->asked || x->unlimited) return;
    x->run.status = prove_parts(x->model, x->waived, x->g, steps, x->run.err);
}

static void polish_layout(void *state)
{
    proving *x = state;
    const sunder_i_group *g = x->g;
    bool better;
    x->run.status = attempt_layout(x->model, x->waived, x->g, g->body, g->move, g->n, false, &better, x->run.err);
    x->run.over = x->known >= goal_of(x->model, g);
}

static void prove_as_dense_group(void *state)
{
    proving *x = state;
    x->run.over = true;
    if (x->asked) return;
    x->g->asked = x->before;
    x->run.status = prove_dense_group(x->model, x->waived, x->g, steps_of_stage(x), x->run.err);
}

/* A body that a perturbation has sent to another side has other neighbours now; the next round knows them. */
static void shake_large(void *state)
{
    proving *x = state;
    sunder_i_group *g = x->g;
    const bool again = g->shaken_at >= ASKED_SHARE * x->before;
    const uint64_t steps = again ? steps_of_stage(x) / AGAIN : steps_of_stage(x);
    x->run.status = g->search->shake(x->model, x->waived, g, steps, x->run.err);
    if (!again) g->shaken_at = x->before;
    x->run.over = g->shaken && sunder_i_group_is_cheaper(g);
}

static void leave_to_prices(void *state) { ((proving *)state)->run.over = true; }

static void grow_tree(void *state)
{
    proving *x = state;
    sunder_i_group *g = x->g;
    const size_t n = g->n;
    const uint64_t steps = steps_of_stage(x);
    const sunder_i_task task = {.model = x->model,
                                .waived = x->waived,
                                .group_of = x->group_of,
                                .group = g->number,
                                .body = g->body,
                                .n = n,
                                .goal = goal_of(x->model, g),
                                .all_springs = true,
                                .keep = x->model->rules.keep_trees};
    sunder_i_tree tree;
    sunder_status status = sunder_i_tree_init(&tree, &task) ? SUNDER_OK : sunder_i_failure_cause(x->run.err);
    if (!status) status = run_tree(x->model, x->waived, g, &tree, steps, x->movers > BRANCHED, x->run.err);
    if (!status && (!keep_guests(g, &tree, n) || (task.keep && !sunder_i_tree_keep(&tree, &g->trees))))
        status = sunder_i_failure_cause(x->run.err);
    x->run.status = status;
    x->spent = x->movers > BRANCHED && (tree.steps >= steps || blocks_are_dear(&tree, steps));
    x->exhausted_tree = x->movers <= BRANCHED && tree.steps >= steps;
    sunder_i_tree_free(&tree);
    x->run.over = g->joins.n || g->bound >= goal_of(x->model, g);
}

static void shake_small(void *state)
{
    proving *x = state;
    x->run.status = x->g->search->shake(x->model, x->waived, x->g, steps_of_stage(x), x->run.err);
}

static void prove_by_blocks(void *state)
{
    proving *x = state;
    sunder_i_group *g = x->g;
    const uint64_t steps = steps_of_stage(x);
    sunder_status status = SUNDER_OK;
    bool promising = !x->spent;
    double priced = 0;
    g->asked = x->before;
    if (promising && x->unlimited) status = sunder_i_group_ask_prices(x->model, g, &priced, x->run.err);
    if (!status && promising && (x->exhausted_tree || priced > 0))
        status = look_at_blocks(x->model, x->waived, g, QUICK_AS_MUCH * sunder_i_max(g->bound, priced), steps,
                                &promising, x->run.err);
    if (!status && promising) status = prove_blocks(x->model, x->waived, g, steps, x->run.err);
    x->run.status = status;
}

/* The steps of the group are divided by the budget. */
static const sunder_i_stage stages[] = {
    {"prove in parts", is_too_large, prove_in_parts, 1},
    {"polish", NULL, polish_layout, 0},
    {"prove as crowd", has_many_conflicts, prove_as_dense_group, 1},
    {"shake", is_beyond_branching, shake_large, 2},
    {"leave to prices", is_large_and_unlimited, leave_to_prices, 0},
    {"grow tree", NULL, grow_tree, 1},
    {"shake", is_small, shake_small, 2},
    {"prove by blocks", is_worth_blocks, prove_by_blocks, 1},
};

static const char *look(const void *state, const double before[2], double now[2])
{
    const sunder_i_group *g = ((const proving *)state)->g;
    const bool proved = sunder_i_group_is_optimal(g);
    now[0] = g->cost;
    now[1] = g->bound;
    if (g->cost < before[0]) return proved ? "cheaper, and proved to be the least" : "cheaper";
    return proved ? "proved to be the least" : "bound raised";
}

static const sunder_i_stage_table table = {"group", stages, sizeof stages / sizeof *stages, look};

static sunder_status prove_afresh(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *group_of,
                                  sunder_i_group *g, double known, uint64_t steps, sunder_error *err)
{
    proving x = {.run = {.log = sunder_i_is_traced(model) ? &g->log : NULL, .err = err},
                 .model = model,
                 .waived = waived,
                 .group_of = group_of,
                 .g = g,
                 .steps = steps,
                 .known = known};
    g->state = SUNDER_I_IS_PROVED;
    g->cost = cost_of(model, g->body, g->n, g->move);
    if (!isfinite(g->cost)) return SUNDER_OK;
    for (size_t k = 0; k < g->n; k++) x.movers += !model->body[g->body[k]].fixed;
    x.before = g->cost;
    x.asked = g->asked >= ASKED_SHARE * x.before;
    if (!x.asked) g->asked = x.movers > MOST_TOGETHER ? x.before : 0;
    x.conflicted = sunder_i_group_has_many_conflicts(model, waived, g);
    x.unlimited = sunder_i_group_is_unlimited(model, waived, g);
    return sunder_i_stages_run(&table, &x);
}

sunder_status sunder_i_group_prove(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *group_of,
                                   sunder_i_group *group, uint64_t steps, sunder_error *err)
{
    sunder_i_group known = {.bound = group->bound, .guests = group->guests, .trees = group->trees};
    group->bound = 0;
    group->guests = (sunder_i_list){0};
    group->trees = (sunder_i_bound_trees){0};
    const sunder_status status = prove_afresh(model, waived, group_of, group, known.bound, steps, err);
    if (!status && known.bound > group->bound) {
        const sunder_i_group less = {.guests = group->guests, .trees = group->trees};
        group->bound = known.bound;
        group->guests = known.guests;
        group->trees = known.trees;
        known = less;
    }
    sunder_i_group_free(&known);
    return status;
}
