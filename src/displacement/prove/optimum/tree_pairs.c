/* The pairs of a task: their forbidden sets, made at their first use, and the pairs in conflict at a node's
 * minimiser. */
#include "displacement/geometry/anchor_reach.h"
#include "displacement/prove/optimum/body_contact.h"
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>

/* Exceeds any relative rounding error in the computation of a length. */
#define ABOVE (1 + 0x1p-40)

static double slackness_of(const sunder_i_tree *t, uint32_t i, uint32_t j)
{
    return (1 / t->task.weight[i] + 1 / t->task.weight[j]) * ABOVE;
}

/* How far from its anchor a body may be within its limit. */
static double within_limits(const sunder_i_tree *t, uint32_t i)
{
    return t->mass[i] > 0 ? (t->limit[i] + fabs(t->anchor[2 * i]) + fabs(t->anchor[2 * i + 1])) * ABOVE : 0;
}

/* Sets the root region of a pair: a layout that costs less than the goal has |u - c| <= sqrt(goal (1 / w_i + 1 / w_j)),
 * where c is the difference of the anchors. Limits are left out, so that a limit that no body exceeds changes
 * nothing; but prices may be so great that they count. */
static void set_root(const sunder_i_tree *t, sunder_i_tree_pair *p)
{
    const double *a = t->task.anchor + 2 * p->i, *b = t->task.anchor + 2 * p->j;
    p->reach = sqrt(sunder_i_max(0, t->task.goal) * p->slackness) * ABOVE;
    for (int c = 0; c < 2; c++) p->centre[c] = b[c] - a[c];
    if (t->task.prices) p->reach = sunder_i_min(p->reach, within_limits(t, p->i) + within_limits(t, p->j));
    p->reach += 0x1p-50 * (fabs(a[0]) + fabs(a[1]) + fabs(b[0]) + fabs(b[1]));
}

static uint32_t *place_of(sunder_i_tree *t, uint32_t i, uint32_t j) { return &t->pair_at[(size_t)i * t->capacity + j]; }

/* Returns the pair whose region that of bodies i and j is. With prices, pairs of i with bodies that do not move share
 * one. */
static uint32_t sharing(const sunder_i_tree *t, uint32_t i, uint32_t j)
{
    for (uint32_t k = 0; k < t->pairs && t->task.prices && !(t->mass[j] > 0); k++)
        if (t->pair[k].i == i && !(t->mass[t->pair[k].j] > 0)) return k;
    return (uint32_t)t->pairs;
}

sunder_i_tree_pair *sunder_i_tree_find_pair(sunder_i_tree *tree, uint32_t i, uint32_t j)
{
    uint32_t *at = place_of(tree, i, j);
    if (*at != UINT32_MAX) return &tree->pair[*at];
    if (!sunder_i_reserve(&tree->pair, &tree->pair_capacity, tree->pairs + 1, sizeof *tree->pair)) {
        tree->failed = true;
        return NULL;
    }
    sunder_i_tree_pair *p = &tree->pair[tree->pairs];
    *p = (sunder_i_tree_pair){.i = i, .j = j, .slackness = slackness_of(tree, i, j), .shares = sharing(tree, i, j)};
    *at = (uint32_t)tree->pairs++;
    set_root(tree, p);
    const double far = sunder_i_tree_pair_reach(p);
    const bool listed = (tree->task.no_paths ? sunder_i_forbidden_without_paths : sunder_i_forbidden_init)(
        &p->forbidden, tree->task.model, tree->task.waived, tree->task.body[i], tree->task.body[j], far);
    if (!listed || !sunder_i_forbidden_index(&p->forbidden)) tree->failed = true;
    tree->steps += 8 * p->forbidden.edges;
    tree->pair_steps += 8 * p->forbidden.edges;
    sunder_i_region_init(&p->region, p->centre, p->reach);
    return p;
}

/* May an anchor of one body have passed the other on its path, or a side anchor a side? Decided by boxes: the box of
 * the relative path meets a possible shadow. */
static bool may_pass(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q, const double t[2],
                     const double v[2])
{
    const double offset[2] = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]},
                 u[2] = {v[0] - t[0], v[1] - t[1]};
    double path[4];
    sunder_i_shadow_path_box(u, 0, path);
    if (p->has->sides && sunder_i_shadow_may_reach(p->box, sunder_i_side_anchors(model, q), offset, path)) return true;
    if (q->has->sides && sunder_i_shadow_may_reach(sunder_i_side_anchors(model, p), q->box, offset, path)) return true;
    return !model->rules.jumps && (sunder_i_anchors_may_reach(model, p, q, false, offset, path) ||
                                   sunder_i_anchors_may_reach(model, p, q, true, offset, path));
}

/* Are the boxes of bodies i and j within the gap of each other at the node, or may an anchor of one have passed the
 * other? */
static bool are_near(const sunder_i_tree *t, uint32_t i, uint32_t j)
{
    const sunder_i_body *p = &t->task.model->body[t->task.body[i]], *q = &t->task.model->body[t->task.body[j]];
    const double *at = t->program.t, gap = t->task.model->rules.gap;
    if (may_pass(t->task.model, p, q, at + 2 * i, at + 2 * j)) return true;
    for (uint32_t c = 0; c < 2; c++) {
        const double v = q->origin[c] + at[2 * j + c] - p->origin[c] - at[2 * i + c];
        if (p->box[c] >= q->box[c + 2] + v + gap || q->box[c] + v >= p->box[c + 2] + gap) return false;
    }
    return true;
}

static void test_pair(sunder_i_tree *t, uint32_t i, uint32_t j)
{
    const double *at = t->program.t;
    if (!(t->mass[i] + t->mass[j] > 0) || !are_near(t, i, j)) return;
    const sunder_i_tree_pair *p = sunder_i_tree_find_pair(t, i, j);
    if (!p || p->forbidden.pieces == 0) return;
    const double u[2] = {at[2 * j] - at[2 * i], at[2 * j + 1] - at[2 * i + 1]};
    const double depth = sunder_i_forbidden_depth(&p->forbidden, u);
    t->steps +=
        4 + (sunder_i_forbidden_is_many(&p->forbidden) ? sunder_i_forbidden_look(&p->forbidden) : p->forbidden.pieces);
    if (depth <= IN_CONFLICT * p->forbidden.size) return;
    if (!sunder_i_reserve(&t->conflict, &t->conflict_capacity, t->conflicts + 1, sizeof *t->conflict))
        t->failed = true;
    else
        t->conflict[t->conflicts++] =
            (sunder_i_tree_conflict){(uint32_t)(p - t->pair), SUNDER_I_NOBODY, depth, {u[0], u[1]}};
}

void sunder_i_tree_find_conflicts(sunder_i_tree *tree)
{
    tree->conflicts = 0;
    for (uint32_t i = 0; i < tree->task.n && !tree->failed; i++) {
        if (!sunder_i_steps(1 + tree->task.n / 64)) tree->failed = true;
        for (uint32_t j = i + 1; j < tree->task.n && !tree->failed; j++) test_pair(tree, i, j);
    }
    tree->steps += tree->task.n * tree->task.n / 16;
}

/* ---- Bodies outside ---------------------------------------------------------------------------------------------- */

/* Is body i, at its place at the node, in conflict with body `other` outside, at its present position in the layer? */
static bool runs_into(sunder_i_tree *t, uint32_t i, uint32_t other)
{
    const sunder_i_model *model = t->task.model;
    const double *at = t->program.t + 2 * i, *to = model->move + 2 * (size_t)other;
    const double u[2] = {to[0] - at[0], to[1] - at[1]};
    sunder_i_forbidden f;
    if (!sunder_i_forbidden_init(&f, model, t->task.waived, t->body[i], other, 2 * (fabs(u[0]) + fabs(u[1]))))
        t->failed = true;
    const bool conflict = f.pieces && sunder_i_forbidden_depth(&f, u) > IN_CONFLICT * f.size;
    t->steps += 8 * f.edges;
    sunder_i_forbidden_free(&f);
    return conflict;
}

static bool takes_part(const sunder_i_tree *t, uint32_t body)
{
    for (size_t k = 0; k < t->task.n; k++)
        if (t->body[k] == body) return true;
    return false;
}

/* Sets t->near to the bodies, ascending, that body i might meet at its place at the node, or on its path there. */
static void find_near(sunder_i_tree *t, uint32_t i)
{
    const sunder_i_model *model = t->task.model;
    if (!sunder_i_bodies_about(model, t->body[i], t->program.t + 2 * i, model->rules.gap, &t->near)) t->failed = true;
    t->steps += 16 + t->near.n * t->task.n / 8;
}

void sunder_i_tree_find_outside_conflicts(sunder_i_tree *tree)
{
    const size_t n = tree->task.n;
    for (uint32_t i = 0; i < n && !tree->failed && tree->task.group_of; i++) {
        if (!(tree->mass[i] > 0)) continue;
        find_near(tree, i);
        for (size_t k = 0; k < tree->near.n && !tree->failed; k++) {
            const uint32_t other = tree->near.item[k];
            if (takes_part(tree, other) || !runs_into(tree, i, other)) continue;
            if (tree->task.group_of[other] == SUNDER_I_NOBODY && tree->task.n < tree->capacity) {
                sunder_i_tree_add_guest(tree, other);
                test_pair(tree, i, (uint32_t)tree->task.n - 1);
            } else if (!sunder_i_list_push(&tree->joins, other)) {
                tree->failed = true;
            }
        }
    }
}
