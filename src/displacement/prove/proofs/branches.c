/* The branches of a branch and bound: to which side does a pair separate, and which of its cases are infeasible?
 *
 * The search is depth first. A node whose program is infeasible is a leaf. Otherwise the candidate violates some
 * distances between pieces. One such pair is chosen, and each of its half-planes (half_planes.c) is a case: the
 * pair is beyond this line, and behind the lines of the earlier cases. If the proof of a case does not use the case's
 * own claim, it proves the node as well, and the other cases are skipped. So choices that are unrelated to a
 * contradiction do not multiply it [conflict-directed backjumping, Pro93]. */
#include "displacement/prove/proofs/branching.h"
#include "displacement/prove/proofs/tuning.h"

#include "base/extremes.h"
#include "base/invariant.h"

#include <math.h>
#include <string.h>

#define TURN 6.28318530717958647692

/* ---- The choice of the next pair --------------------------------------------------------------------------------- */

/* A convex polygon, counter-clockwise. */
typedef struct area {
    size_t n;
    double xy[2 * MOST_CORNERS];
} area;

/* Clips the polygon to n.u >= d. A cut that would make too many corners is not made. */
static void cut_area(area *p, const double n[2], double d)
{
    area out = {.n = 0};
    for (size_t k = 0; k < p->n; k++) {
        const double *u = p->xy + 2 * k, *v = p->xy + 2 * (k + 1 < p->n ? k + 1 : 0);
        const double su = n[0] * u[0] + n[1] * u[1] - d, sv = n[0] * v[0] + n[1] * v[1] - d;
        if (out.n + 2 > MOST_CORNERS) return;
        if (su >= 0) memcpy(out.xy + 2 * out.n++, u, 2 * sizeof *u);
        if ((su > 0 && sv < 0) || (su < 0 && sv > 0)) {
            const double s = su / (su - sv);
            out.xy[2 * out.n] = u[0] + s * (v[0] - u[0]);
            out.xy[2 * out.n++ + 1] = u[1] + s * (v[1] - u[1]);
        }
    }
    *p = out;
}

/* Returns an approximate polygon of the relative moves that limits and claims leave to a pair. */
static area room_of(const sunder_i_branching *c, const sunder_i_violation *o)
{
    area room = {.n = DISC_SIDES};
    const uint32_t i = sunder_i_branching_place(c, o->p),
                   j = o->slack ? sunder_i_branching_slack(c, o->slack) : sunder_i_branching_place(c, o->q);
    const double last = o->slack ? -o->slack->clearance : sunder_i_branching_limit(c, &c->model->body[o->q]),
                 reach = sunder_i_branching_limit(c, &c->model->body[o->p]) + last;
    const double r = reach / cos(TURN / (2 * DISC_SIDES));
    for (int k = 0; k < DISC_SIDES; k++) {
        room.xy[2 * k] = r * cos(TURN * k / DISC_SIDES);
        room.xy[2 * k + 1] = r * sin(TURN * k / DISC_SIDES);
    }
    const bool takes_part = j != SUNDER_I_GROUND || !(last > 0);
    for (size_t k = 0; k < c->claims && takes_part; k++) {
        const sunder_i_claim *s = &c->claim[k];
        const double behind[2] = {-s->n[0], -s->n[1]};
        if (s->i == i && s->j == j) cut_area(&room, s->n, s->d);
        if (s->i == j && s->j == i) cut_area(&room, behind, s->d);
    }
    return room;
}

/* Returns roughly how many of the half-planes in c->scratch, of which there are `half_planes`, contain relative moves
 * that limits and claims leave to the pair of `o` (open half-planes); stops counting at `most`. */
static size_t count_open(const sunder_i_branching *c, const sunder_i_violation *o, size_t half_planes, size_t most)
{
    const area room = room_of(c, o);
    size_t open = 0;
    for (size_t k = 0; k < half_planes && open < most; k++) {
        double best = -INFINITY;
        for (size_t v = 0; v < room.n; v++)
            best = sunder_i_max(best, c->scratch[k].n[0] * room.xy[2 * v] + c->scratch[k].n[1] * room.xy[2 * v + 1]);
        open += best >= c->scratch[k].d;
    }
    return open;
}

/* Chooses the violation with the fewest open half-planes (count_open()), among those that are at least the share DEEP
 * as deep as the first one and of which `known` is the same, and returns its index. Its half-planes are then in
 * c->scratch, and their number in *half_planes. */
static size_t choose_violation(sunder_i_branching *c, const sunder_i_violation *deepest, size_t n, size_t *half_planes)
{
    size_t best = 0, fewest = SIZE_MAX;
    for (size_t k = 0;
         k < n && fewest && deepest[k].known == deepest[0].known && deepest[k].depth >= DEEP * deepest[0].depth; k++) {
        *half_planes = sunder_i_branching_half_planes(c, &deepest[k]);
        if (c->failed) return 0;
        const size_t open = count_open(c, &deepest[k], *half_planes, fewest);
        c->looked += *half_planes * 4;
        if (open >= fewest) continue;
        fewest = open;
        best = k;
    }
    *half_planes = sunder_i_branching_half_planes(c, &deepest[best]);
    return best;
}

/* ---- The tree ---------------------------------------------------------------------------------------------------- */

static sunder_i_node *add_node(sunder_i_branching *c)
{
    if (!sunder_i_reserve(&c->node, &c->node_capacity, c->nodes + 1, sizeof *c->node)) return NULL;
    sunder_i_node *node = &c->node[c->nodes++];
    *node = (sunder_i_node){.half_plane = c->half_planes, .force = c->forces, .chord = SIZE_MAX};
    return node;
}

bool sunder_i_branching_add_leaf(sunder_i_branching *branching, sunder_i_levels *levels, size_t *root)
{
    *root = branching->nodes;
    memset(levels, 0, sizeof *levels);
    sunder_i_node *node = add_node(branching);
    if (!node || !sunder_i_reserve(&branching->force, &branching->force_capacity, branching->forces + branching->claims,
                                   sizeof *branching->force))
        return false;
    bool still = false;
    for (size_t k = 0; k < branching->claims; k++) {
        const sunder_i_claim *s = &branching->claim[k];
        if (!(s->force > 0)) continue;
        sunder_i_levels_add(levels, s->level);
        branching->force[branching->forces++] = (sunder_proof_force){s->node, s->half_plane, s->behind, s->force};
        node->forces++;
        const uint32_t between =
            branching->still ? sunder_i_branching_place(branching, branching->between) : SUNDER_I_GROUND;
        still = still || (branching->still && (s->i == between || s->j == between));
    }
    node->still = still;
    for (unsigned k = 0; k < 2 && still; k++) {
        sunder_i_levels_add(levels, branching->claim[k].level);
        node->line_node[k] = branching->claim[k].node;
        node->line_way[k] = branching->claim[k].half_plane;
    }
    return true;
}

bool sunder_i_branching_add_branch(sunder_i_branching *branching, const sunder_i_violation *violation,
                                   size_t half_planes, size_t *root)
{
    *root = branching->nodes;
    sunder_i_node *node = add_node(branching);
    if (!node || !sunder_i_reserve(&branching->half_plane, &branching->half_plane_capacity,
                                   branching->half_planes + half_planes, sizeof *branching->half_plane))
        return false;
    if (violation->chord) {
        if (!sunder_i_reserve(&branching->chord, &branching->chord_capacity, branching->chords + 1,
                              sizeof *branching->chord))
            return false;
        node->chord = branching->chords;
        branching->chord[branching->chords++] = *violation->chord;
    }
    node->a = violation->a->feature;
    node->b = violation->b->feature;
    node->part_a = violation->a;
    node->part_b = violation->b;
    node->clearance = violation->clearance;
    node->shadow = violation->shadow;
    node->slack = violation->slack != NULL;
    node->held = violation->held;
    node->row = violation->row;
    node->half_planes = half_planes;
    memcpy(branching->half_plane + branching->half_planes, branching->scratch,
           half_planes * sizeof *branching->half_plane);
    branching->half_planes += half_planes;
    return true;
}

bool sunder_i_branching_push(sunder_i_branching *branching, uint32_t i, uint32_t j, size_t node, size_t half_plane,
                             bool behind, unsigned level)
{
    if (!sunder_i_reserve(&branching->claim, &branching->claim_capacity, branching->claims + 1,
                          sizeof *branching->claim))
        return false;
    const sunder_i_half_plane *w = &branching->half_plane[half_plane];
    const sunder_i_node *of = &branching->node[node];
    /* A side is closed: what is not in its shadow is strictly beyond a line. What is behind a line of anything else is
     * not on it. */
    const bool closed = of->shadow && sunder_i_is_barrier(branching->model, of->b);
    const double sign = behind ? -1 : 1;
    SUNDER_I_ASSERT(level < SUNDER_I_LEVELS && i < branching->bodies &&
                    (j < branching->bodies || j == SUNDER_I_GROUND) && i != j);
    branching->claim[branching->claims++] = (sunder_i_claim){.i = i,
                                                             .j = j,
                                                             .n = {sign * w->n[0], sign * w->n[1]},
                                                             .d = sign * w->d,
                                                             .node = node,
                                                             .half_plane = half_plane,
                                                             .behind = behind,
                                                             .strict = behind != closed,
                                                             .level = level};
    return true;
}

/* Are the claims exactly those of the two walls? Then the body between them stays where it is (corridor.c). */
static bool is_between(const sunder_i_branching *c, unsigned level)
{
    bool between = c->walls == 2 && level == 1 && c->claims == 2;
    for (size_t k = 0; k < 2 && between; k++)
        between = !c->claim[k].behind && c->claim[k].level == k &&
                  c->claim[k].half_plane == c->node[c->claim[k].node].half_plane;
    return between;
}

static void set_still(sunder_i_branching *c, bool still)
{
    const uint32_t at = sunder_i_branching_place(c, c->between);
    c->still = still;
    c->limit[at] = still ? 0 : sunder_i_branching_limit(c, &c->model->body[c->between]);
}

/* Searches the cases of a node one after the other, each from the present candidate. */
static sunder_status search_cases(sunder_i_branching *c, const sunder_i_violation *o, size_t node, unsigned level,
                                  sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root, sunder_error *err)
{
    const uint32_t i = sunder_i_branching_join(c, o->p),
                   j = o->slack ? sunder_i_branching_join_slack(c, o->slack) : sunder_i_branching_join(c, o->q);
    if (c->failed) return sunder_i_failure_cause(err);
    const size_t first = c->node[node].half_plane, end = first + c->node[node].half_planes, claims = c->claims,
                 bodies = c->bodies;
    double *t = sunder_i_alloc(2 * bodies, sizeof *t);
    if (!t) return sunder_i_failure_cause(err);
    memcpy(t, c->t, 2 * bodies * sizeof *t);
    sunder_status status = SUNDER_OK;
    memset(levels, 0, sizeof *levels);
    *root = node;
    *verdict = SUNDER_I_INFEASIBLE;
    for (size_t half_plane = first; half_plane < end && !status && *verdict == SUNDER_I_INFEASIBLE; half_plane++) {
        sunder_i_levels used;
        size_t below = 0;
        sunder_i_branching_begin(c, bodies);
        memcpy(c->t, t, 2 * bodies * sizeof *t);
        const size_t before = c->claims;
        bool ok = sunder_i_branching_push(c, i, j, node, half_plane, false, level);
        const bool between = ok && is_between(c, level);
        if (between) set_still(c, true);
        const bool dead = ok && sunder_i_branching_is_dead_end(c);
        if (dead)
            ok = sunder_i_branching_add_leaf(c, &used, &below);
        else if (ok)
            status = sunder_i_branching_search(c, level + 1, verdict, &used, &below, err);
        if (between) set_still(c, false);
        if (!ok) status = sunder_i_failure_cause(err);
        if (status || *verdict != SUNDER_I_INFEASIBLE) break;
        c->half_plane[half_plane].next = below;
        if (!sunder_i_levels_has(&used, level)) {
            *root = below;
            *levels = used;
            break;
        }
        for (size_t k = 0; k < sizeof used.bit / sizeof *used.bit; k++) levels->bit[k] |= used.bit[k];
        /* The next cases are searched behind this line. A line beyond all limits needs no such claim. */
        c->claims = before;
        if (!dead && !sunder_i_branching_push(c, i, j, node, half_plane, true, level))
            status = sunder_i_failure_cause(err);
    }
    sunder_i_levels_drop(levels, level);
    c->claims = claims;
    sunder_i_free(t);
    return status;
}

/* Finds the violations of the candidate. If there seem to be none, and an exact answer is wanted, half-planes made for
 * the candidate are used, and then a chord. Returns their number. */
static size_t find_violations(sunder_i_branching *c, sunder_i_violation deepest[SUNDER_I_CHOICES])
{
    size_t n = sunder_i_branching_violations(c, deepest);
    if (n || c->failed || c->subproblem->coarse > 0) return n;
    c->closely = true;
    n = sunder_i_branching_violations(c, deepest);
    c->closely = false;
    return n || c->failed ? n : sunder_i_branching_find_chord(c, &deepest[0]);
}

/* Searches the branches of a wall, with all bodies at their original positions. */
static sunder_status search_wall(sunder_i_branching *c, unsigned level, sunder_i_verdict *verdict,
                                 sunder_i_levels *levels, size_t *root, sunder_error *err)
{
    const sunder_i_corridor_wall *w = &c->wall[level];
    const sunder_i_violation o = {.p = c->between,
                                  .q = c->model->body_of[w->b->feature],
                                  .a = w->a,
                                  .b = w->b,
                                  .clearance = w->clearance,
                                  .slack = w->slack,
                                  .held = true};
    const size_t half_planes = sunder_i_branching_wall_half_planes(c, w);
    size_t node;
    if (!c->failed && half_planes == 0) return SUNDER_OK;
    if (c->failed || !sunder_i_branching_add_branch(c, &o, half_planes, &node)) return sunder_i_failure_cause(err);
    return search_cases(c, &o, node, level, verdict, levels, root, err);
}

/* A body that is not beyond the line of a wall that stands for an overlap may leave the overlap by its other side, or
 * its end, with all of its pieces. Sets *deepest to the violation of the two pieces, one of the body and one of a wall,
 * that are deepest in each other after the candidate's slack. Returns false if the slack separates all such pieces. */
static bool find_left(sunder_i_branching *c, sunder_i_violation *deepest)
{
    *deepest = (sunder_i_violation){.depth = 2 * c->hair};
    if (c->walls == 0) return false;
    const sunder_i_body *p = &c->model->body[c->between];
    const sunder_i_body_pieces *pieces = sunder_i_pieces_of(c->model, p);
    if (!pieces) c->failed = true;
    for (size_t k = 0; k < c->walls && !c->failed; k++)
        for (uint32_t l = 0; l < p->pieces && c->wall[k].slack && !c->failed; l++) {
            sunder_i_violation o = {.p = c->between,
                                    .q = c->model->body_of[c->wall[k].b->feature],
                                    .a = &pieces->piece[l],
                                    .b = c->wall[k].b,
                                    .clearance = c->wall[k].clearance,
                                    .slack = c->wall[k].slack,
                                    .known = true};
            if (o.a->feature != c->wall[k].a->feature || sunder_i_branching_half_planes(c, &o) == 0) continue;
            o.depth = -c->scratch[0].at;
            if (o.depth > deepest->depth) *deepest = o;
        }
    return deepest->a && !c->failed;
}

static sunder_status branch_on(sunder_i_branching *c, const sunder_i_violation *o, unsigned level,
                               sunder_i_verdict *verdict, sunder_i_levels *levels, size_t *root, sunder_error *err)
{
    const size_t half_planes = sunder_i_branching_half_planes(c, o);
    size_t node;
    if (level == SUNDER_I_LEVELS || sunder_i_branching_is_over(c))
        return c->failed ? sunder_i_failure_cause(err) : SUNDER_OK;
    if (c->failed || !sunder_i_branching_add_branch(c, o, half_planes, &node)) return sunder_i_failure_cause(err);
    return search_cases(c, o, node, level, verdict, levels, root, err);
}

sunder_status sunder_i_branching_search(sunder_i_branching *branching, unsigned level, sunder_i_verdict *verdict,
                                        sunder_i_levels *levels, size_t *root, sunder_error *err)
{
    sunder_i_node_outcome outcome;
    *verdict = SUNDER_I_UNKNOWN;
    if (level < branching->walls) return search_wall(branching, level, verdict, levels, root, err);
    sunder_status status = sunder_i_branching_solve(branching, &outcome, err);
    if (status || outcome == SUNDER_I_NODE_UNDECIDED) return status;
    if (outcome == SUNDER_I_NODE_INFEASIBLE) {
        *verdict = SUNDER_I_INFEASIBLE;
        return sunder_i_branching_add_leaf(branching, levels, root) ? SUNDER_OK : sunder_i_failure_cause(err);
    }
    sunder_i_violation deepest[SUNDER_I_CHOICES];
    if (!branching->still && find_left(branching, &deepest[0]))
        return branch_on(branching, &deepest[0], level, verdict, levels, root, err);
    if (branching->failed) return sunder_i_failure_cause(err);
    size_t n = find_violations(branching, deepest);
    while (n == 0 && !branching->failed && !sunder_i_branching_is_over(branching) &&
           sunder_i_branching_widen(branching))
        n = find_violations(branching, deepest);
    if (n == 0 && !branching->failed) *verdict = SUNDER_I_FEASIBLE;
    if (n == 0 || branching->failed || level == SUNDER_I_LEVELS || sunder_i_branching_is_over(branching))
        return branching->failed ? sunder_i_failure_cause(err) : SUNDER_OK;
    size_t half_planes, node;
    const size_t best = choose_violation(branching, deepest, n, &half_planes);
    if (branching->failed || !sunder_i_branching_add_branch(branching, &deepest[best], half_planes, &node))
        return sunder_i_failure_cause(err);
    return search_cases(branching, &deepest[best], node, level, verdict, levels, root, err);
}
