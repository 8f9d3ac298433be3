/* Nodes: their cuts, their programs, and how the state at a node is made again from its path. */
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* ---- The record -------------------------------------------------------------------------------------------------- */

static void touch(sunder_i_tree *t, uint32_t pair)
{
    if (t->pair[pair].touched) return;
    t->pair[pair].touched = true;
    if (!sunder_i_list_push(&t->touched, pair)) t->failed = true;
}

/* kept: the region will be what was kept of it. */
static void apply(sunder_i_tree *t, uint32_t cut, bool kept)
{
    const sunder_i_cut_note *note = &t->note[cut];
    if (note->kind == SUNDER_I_CUT_LIMIT) return;
    sunder_i_tree_pair *p = &t->pair[note->pair];
    touch(t, note->pair);
    if (kept) return;
    sunder_i_region_clip(&p->region, t->cut[cut].n, t->cut[cut].d, cut, p->forbidden.grain);
}

uint32_t sunder_i_tree_cut(sunder_i_tree *t, sunder_i_cut_kind kind, uint32_t pair, const double n[2], double d)
{
    const bool room = sunder_i_reserve(&t->cut, &t->cut_capacity, t->cuts + 1, sizeof *t->cut) &&
                      sunder_i_reserve(&t->note, &t->note_capacity, t->cuts + 1, sizeof *t->note);
    t->program.cut = t->cut; /* they may have gone elsewhere where there was no room for the note, too */
    if (!room) {
        t->failed = true;
        return 0;
    }
    const uint32_t cut = (uint32_t)t->cuts++;
    const bool ball = kind == SUNDER_I_CUT_LIMIT;
    t->cut[cut] =
        (sunder_i_move_cut){ball ? pair : t->pair[pair].i, ball ? SUNDER_I_GROUND : t->pair[pair].j, {n[0], n[1]}, d};
    t->note[cut] = (sunder_i_cut_note){.kind = kind, .pair = pair};
    if (t->nodes) t->node[t->nodes - 1].cuts++;
    apply(t, cut, false);
    return cut;
}

void sunder_i_tree_note_forces(sunder_i_tree *t, uint32_t *first, uint32_t *count)
{
    const size_t n = t->program.acting_n;
    if (!sunder_i_reserve(&t->force, &t->force_capacity, t->forces + n, sizeof *t->force)) {
        t->failed = true;
        return;
    }
    *first = (uint32_t)t->forces;
    *count = (uint32_t)n;
    if (n) memcpy(t->force + t->forces, t->program.acting, n * sizeof *t->force);
    t->forces += n;
}

void sunder_i_tree_keep_forces(sunder_i_tree *t, uint32_t node)
{
    sunder_i_tree_note_forces(t, &t->node[node].force, &t->node[node].forces);
}

uint32_t sunder_i_tree_add_node(sunder_i_tree *t, uint32_t parent, double value)
{
    if (!sunder_i_reserve(&t->node, &t->node_capacity, t->nodes + 1, sizeof *t->node)) {
        t->failed = true;
        return 0;
    }
    t->node[t->nodes] = (sunder_i_tree_node){.parent = parent, .cut = (uint32_t)t->cuts, .value = value};
    return (uint32_t)t->nodes++;
}

void sunder_i_tree_load(sunder_i_tree *t, uint32_t node)
{
    for (size_t k = 0; k < t->touched.n; k++) {
        sunder_i_tree_pair *p = &t->pair[t->touched.item[k]];
        sunder_i_region_init(&p->region, p->centre, p->reach);
        p->touched = false;
    }
    t->touched.n = t->path.n = 0;
    for (uint32_t at = node; at != SUNDER_I_NO_NODE; at = t->node[at].parent)
        if (!sunder_i_list_push(&t->path, at)) t->failed = true;
    const bool kept = t->node[node].regions;
    for (size_t k = t->path.n; k-- > 0 && !t->failed;) {
        const sunder_i_tree_node *n = &t->node[t->path.item[k]];
        for (uint32_t c = n->cut; c < n->cut + n->cuts; c++) apply(t, c, kept);
        t->steps += 2 * n->cuts;
    }
    if (kept && !t->failed) sunder_i_tree_take_regions(t, node);
    const sunder_i_tree_node *n = &t->node[node];
    const sunder_i_cut_force *force = n->forces ? t->force + n->force : NULL; /* the list may be empty */
    if (!t->failed && !sunder_i_dual_load(&t->program, force, n->forces)) t->failed = true;
}

void sunder_i_tree_keep_program(sunder_i_tree *t)
{
    const sunder_i_dual_program *p = &t->program;
    t->kept_n = p->acting_n;
    if (!sunder_i_reserve(&t->kept, &t->kept_capacity, p->acting_n, sizeof *t->kept) ||
        !sunder_i_reserve(&t->kept_factor, &t->kept_factor_capacity, p->acting_n * p->acting_n,
                          sizeof *t->kept_factor)) {
        t->failed = true;
        return;
    }
    for (size_t k = 0; k < p->acting_n; k++) {
        t->kept[k] = p->acting[k];
        memcpy(t->kept_factor + k * p->acting_n, p->factor + k * p->capacity, (k + 1) * sizeof *t->kept_factor);
    }
}

void sunder_i_tree_restore_program(sunder_i_tree *t)
{
    sunder_i_dual_program *p = &t->program;
    if (t->failed) return;
    p->acting_n = t->kept_n;
    for (size_t k = 0; k < p->acting_n; k++) {
        p->acting[k] = t->kept[k];
        memcpy(p->factor + k * p->capacity, t->kept_factor + k * p->acting_n, (k + 1) * sizeof *p->factor);
    }
    sunder_i_dual_place(p);
}

/* ---- The program ------------------------------------------------------------------------------------------------- */

/* The cut that is missed most, as a share of the pair's size; UINT32_MAX: all hold. */
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
        /* Not the side as it is kept, which may be off: the cut itself. */
        if (sunder_i_dual_missing(&t->program, &t->cut[cut]) <= HOLDS * p->forbidden.size) continue;
        most = beyond;
        worst = cut;
    }
    t->steps += 4 * t->touched.n;
    return worst;
}

/* A tangent of the limit that a body oversteps most; UINT32_MAX: none does. */
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
    /* |n| is 1 up to 2^-50; the ground stands at 0, so this says n.t <= limit |n|, and a little more. */
    return sunder_i_tree_cut(t, SUNDER_I_CUT_LIMIT, worst, n, -t->limit[worst] * (1 + 0x1p-49));
}

double sunder_i_tree_solve(sunder_i_tree *t)
{
    double value = sunder_i_dual_value(&t->program);
    for (size_t round = 0; round < MOST_ADDED && !t->failed && value < t->task.goal; round++) {
        uint32_t cut = find_missed(t);
        if (cut == UINT32_MAX) cut = find_overstepped(t);
        if (cut == UINT32_MAX) break;
        bool failed;
        const uint64_t before = t->program.steps;
        const sunder_i_dual_outcome outcome = sunder_i_dual_add(&t->program, cut, t->task.goal, &failed);
        t->steps += t->program.steps - before;
        if (failed || !sunder_i_steps(1 + t->program.acting_n / 4)) t->failed = true;
        value = sunder_i_max(value, sunder_i_dual_value(&t->program));
        if (outcome == SUNDER_I_DUAL_STUCK) break;
    }
    /* The last value is that of the forces at hand: D never falls but by rounding. */
    return sunder_i_dual_value(&t->program);
}
