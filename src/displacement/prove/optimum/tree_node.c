/* Nodes: their cuts, their programs, and how the state at a node is recomputed from its path. */
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* ---- The record -------------------------------------------------------------------------------------------------- */

static void touch_pair(sunder_i_tree *t, uint32_t pair)
{
    pair = t->pair[pair].shares;
    if (t->pair[pair].touched) return;
    t->pair[pair].touched = true;
    if (!sunder_i_list_push(&t->touched, pair)) t->failed = true;
}

/* Marks the cut's pair as touched, and clips its region by the cut, unless the region will be restored from a saved
 * copy (`kept`). */
static void apply_cut(sunder_i_tree *t, uint32_t cut, bool kept)
{
    const sunder_i_cut_note *note = &t->note[cut];
    if (note->kind == SUNDER_I_CUT_LIMIT || note->kind == SUNDER_I_CUT_SPRING) return;
    if (note->kind == SUNDER_I_CUT_PRICE) {
        if (!sunder_i_list_push(&t->priced, cut)) t->failed = true;
        return;
    }
    sunder_i_tree_pair *p = &t->pair[note->pair];
    touch_pair(t, note->pair);
    if (kept) return;
    sunder_i_region_clip(sunder_i_tree_region(t, note->pair), t->cut[cut].n, t->cut[cut].d, cut, p->forbidden.grain);
}

static uint32_t add_cut(sunder_i_tree *tree, sunder_i_cut_kind kind, uint32_t pair, const sunder_i_move_cut *made)
{
    const bool room = sunder_i_reserve(&tree->cut, &tree->cut_capacity, tree->cuts + 1, sizeof *tree->cut) &&
                      sunder_i_reserve(&tree->note, &tree->note_capacity, tree->cuts + 1, sizeof *tree->note);
    tree->program.cut = tree->cut; /* the array may have been moved even if the second reservation failed */
    if (!room) {
        tree->failed = true;
        return 0;
    }
    const uint32_t cut = (uint32_t)tree->cuts++;
    tree->cut[cut] = *made;
    tree->note[cut] = (sunder_i_cut_note){.kind = kind, .pair = pair};
    if (tree->nodes) tree->node[tree->nodes - 1].cuts++;
    apply_cut(tree, cut, false);
    return cut;
}

uint32_t sunder_i_tree_cut(sunder_i_tree *tree, sunder_i_cut_kind kind, uint32_t pair, const double n[2], double d)
{
    const bool ball = kind == SUNDER_I_CUT_LIMIT;
    const sunder_i_move_cut cut = {.i = ball ? pair : tree->pair[pair].i,
                                   .j = ball ? SUNDER_I_GROUND : tree->pair[pair].j,
                                   .n = {n[0], n[1]},
                                   .d = d};
    return add_cut(tree, kind, pair, &cut);
}

uint32_t sunder_i_tree_add_price_cut(sunder_i_tree *tree, uint32_t eased, const sunder_i_slope *slope)
{
    const sunder_i_tree_pair *p = &tree->pair[tree->eased[eased].pair];
    const sunder_i_move_cut cut = {
        .i = p->i, .j = p->j, .n = {slope->n[0], slope->n[1]}, .d = slope->d, .eased = eased, .share = slope->share};
    return add_cut(tree, SUNDER_I_CUT_PRICE, eased, &cut);
}

void sunder_i_tree_note_forces(sunder_i_tree *tree, uint32_t *first, uint32_t *count)
{
    const size_t n = tree->program.acting_n;
    if (!sunder_i_reserve(&tree->force, &tree->force_capacity, tree->forces + n, sizeof *tree->force)) {
        tree->failed = true;
        return;
    }
    *first = (uint32_t)tree->forces;
    *count = (uint32_t)n;
    if (n) memcpy(tree->force + tree->forces, tree->program.acting, n * sizeof *tree->force);
    tree->forces += n;
}

void sunder_i_tree_keep_forces(sunder_i_tree *tree, uint32_t node)
{
    sunder_i_tree_note_forces(tree, &tree->node[node].force, &tree->node[node].forces);
}

uint32_t sunder_i_tree_add_node(sunder_i_tree *tree, uint32_t parent, double value)
{
    if (!sunder_i_reserve(&tree->node, &tree->node_capacity, tree->nodes + 1, sizeof *tree->node)) {
        tree->failed = true;
        return 0;
    }
    tree->node[tree->nodes] = (sunder_i_tree_node){.parent = parent, .cut = (uint32_t)tree->cuts, .value = value};
    return (uint32_t)tree->nodes++;
}

void sunder_i_tree_load(sunder_i_tree *tree, uint32_t node)
{
    for (size_t k = 0; k < tree->touched.n; k++) {
        sunder_i_tree_pair *p = &tree->pair[tree->touched.item[k]];
        sunder_i_region_init(&p->region, p->centre, p->reach);
        p->touched = false;
    }
    tree->touched.n = tree->path.n = tree->priced.n = 0;
    for (uint32_t at = node; at != SUNDER_I_NO_NODE; at = tree->node[at].parent)
        if (!sunder_i_list_push(&tree->path, at)) tree->failed = true;
    const bool kept = tree->node[node].regions;
    for (size_t k = tree->path.n; k-- > 0 && !tree->failed;) {
        const sunder_i_tree_node *n = &tree->node[tree->path.item[k]];
        for (uint32_t c = n->cut; c < n->cut + n->cuts; c++) apply_cut(tree, c, kept);
        tree->steps += 2 * n->cuts;
    }
    if (kept && !tree->failed) sunder_i_tree_take_regions(tree, node);
    const sunder_i_tree_node *n = &tree->node[node];
    const sunder_i_cut_force *force = n->forces ? tree->force + n->force : NULL; /* the list of forces may be empty */
    if (!tree->failed && !sunder_i_dual_load(&tree->program, force, n->forces)) tree->failed = true;
}

void sunder_i_tree_keep_program(sunder_i_tree *tree)
{
    const sunder_i_dual_program *p = &tree->program;
    tree->kept_n = p->acting_n;
    if (!sunder_i_reserve(&tree->kept, &tree->kept_capacity, p->acting_n, sizeof *tree->kept) ||
        !sunder_i_reserve(&tree->kept_factor, &tree->kept_factor_capacity, p->acting_n * p->acting_n,
                          sizeof *tree->kept_factor)) {
        tree->failed = true;
        return;
    }
    for (size_t k = 0; k < p->acting_n; k++) {
        tree->kept[k] = p->acting[k];
        memcpy(tree->kept_factor + k * p->acting_n, p->factor + k * p->capacity, (k + 1) * sizeof *tree->kept_factor);
    }
}

void sunder_i_tree_restore_program(sunder_i_tree *tree)
{
    sunder_i_dual_program *p = &tree->program;
    if (tree->failed) return;
    p->acting_n = tree->kept_n;
    for (size_t k = 0; k < p->acting_n; k++) {
        p->acting[k] = tree->kept[k];
        memcpy(p->factor + k * p->capacity, tree->kept_factor + k * p->acting_n, (k + 1) * sizeof *p->factor);
    }
    sunder_i_dual_place(p);
}

/* ---- The program ------------------------------------------------------------------------------------------------- */

/* Returns the cut beyond which a pair's relative move lies farthest at program.t, among the cuts that are sides of the
 * touched pairs' regions; UINT32_MAX if all hold. Distances up to the share HOLDS of the pair's size do not count. */
static uint32_t find_missed(sunder_i_tree *t)
{
    const double *at = t->program.t;
    uint32_t worst = UINT32_MAX;
    double most = 0;
    for (size_t k = 0; k < t->touched.n; k++) {
        const sunder_i_tree_pair *p = &t->pair[t->touched.item[k]];
        const double u[2] = {at[2 * p->j] - at[2 * p->i], at[2 * p->j + 1] - at[2 * p->i + 1]};
        uint32_t cut = 0;
        const double beyond = sunder_i_region_beyond(&p->region, u, &cut);
        if (beyond <= sunder_i_max(most, HOLDS * p->forbidden.size) || beyond <= 2 * p->region.blur) continue;
        /* The stored side may be inaccurate, so the cut itself decides. */
        if (sunder_i_dual_missing(&t->program, &t->cut[cut]) <= HOLDS * p->forbidden.size) continue;
        most = beyond;
        worst = cut;
    }
    for (size_t k = 0; k < t->priced.n; k++) {
        const uint32_t c = t->priced.item[k];
        const double missing = sunder_i_dual_missing(&t->program, &t->cut[c]);
        if (missing <= sunder_i_max(most, HOLDS * t->eased[t->cut[c].eased].pieces.size)) continue;
        if (sunder_i_dual_is_acting(&t->program, c)) continue;
        most = missing;
        worst = c;
    }
    t->steps += 4 * t->touched.n + t->priced.n;
    return worst;
}

/* Each eased pair has two cuts, for the least and for the most that it may lack. Returns the one of all these that
 * program.t violates most, by more than rounding; UINT32_MAX if there is none. */
static uint32_t find_beyond(sunder_i_tree *t)
{
    uint32_t worst = UINT32_MAX;
    double most = 0;
    for (uint32_t k = 0; k < 2 * t->task.prices; k++) {
        const uint32_t cut = (uint32_t)t->springs + k;
        const double missing = sunder_i_dual_missing(&t->program, &t->cut[cut]);
        if (!(missing > sunder_i_max(most, HOLDS * t->eased[k / 2].pieces.size))) continue;
        if (sunder_i_dual_is_acting(&t->program, cut)) continue;
        most = missing;
        worst = cut;
    }
    t->steps += t->task.prices;
    return worst;
}

/* Returns the spring that the bodies stretch or squeeze most while it has no force; UINT32_MAX if there is none beyond
 * the share HOLDS of what they move. */
static uint32_t find_stretched(sunder_i_tree *t)
{
    const sunder_i_dual_program *p = &t->program;
    uint32_t worst = UINT32_MAX;
    double most = 0;
    if (t->springs == 0) return worst;
    for (size_t b = 0; b < 2 * t->task.n; b++) most = sunder_i_max(most, HOLDS * fabs(p->t[b]));
    for (uint32_t c = 0; c < t->springs; c++) {
        const double missing = sunder_i_dual_missing(p, &t->cut[c]);
        if (!(missing > most) || sunder_i_dual_is_acting(p, c)) continue;
        most = missing;
        worst = c;
    }
    t->steps += t->springs;
    return worst;
}

/* Adds a tangent of the limit that a body exceeds most in proportion to the limit, and returns the cut; UINT32_MAX if
 * no limit is exceeded by more than the share OVERSTEPPED. */
static uint32_t find_overstepped(sunder_i_tree *t)
{
    const double *at = t->program.t;
    uint32_t worst = UINT32_MAX;
    double most = OVERSTEPPED;
    for (uint32_t b = 0; b < t->task.n; b++) {
        if (!(t->mass[b] > 0) || !(t->limit[b] < INFINITY)) continue;
        const double share = hypot(at[2 * b], at[2 * b + 1]) / t->limit[b] - 1;
        if (!(share > most)) continue;
        most = share;
        worst = b;
    }
    if (worst == UINT32_MAX) return worst;
    const double length = hypot(at[2 * worst], at[2 * worst + 1]);
    const double n[2] = {at[2 * worst] / length, at[2 * worst + 1] / length};
    /* |n| is 1 up to 2^-50, and the ground's move is 0, so this says n.t <= limit |n|, and allows slightly more. */
    return sunder_i_tree_cut(t, SUNDER_I_CUT_LIMIT, worst, n, -t->limit[worst] * (1 + 0x1p-49));
}

double sunder_i_tree_solve(sunder_i_tree *tree)
{
    double value = sunder_i_dual_value(&tree->program);
    for (size_t round = 0; round < MOST_ADDED && !tree->failed && value < tree->task.goal; round++) {
        uint32_t cut = find_missed(tree);
        if (cut == UINT32_MAX) cut = find_overstepped(tree);
        if (cut == UINT32_MAX) cut = find_stretched(tree);
        if (cut == UINT32_MAX) cut = find_beyond(tree);
        if (cut == UINT32_MAX) break;
        bool failed;
        const uint64_t before = tree->program.steps;
        const sunder_i_dual_outcome outcome = sunder_i_dual_add(&tree->program, cut, tree->task.goal, &failed);
        tree->steps += tree->program.steps - before;
        if (failed || !sunder_i_steps(1 + tree->program.acting_n / 4)) tree->failed = true;
        value = sunder_i_max(value, sunder_i_dual_value(&tree->program));
        if (outcome == SUNDER_I_DUAL_STUCK) break;
    }
    /* `value` is the greatest value of all rounds. The present forces prove the last one, which rounding may have made
     * smaller. */
    return sunder_i_dual_value(&tree->program);
}
