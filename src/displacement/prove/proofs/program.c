/* The convex program of one node of a branch and bound, and the proof that it has no solution.
 *
 * The claims up to the node are n.(t_j - t_i) >= d, and the limits are |t| <= L. Forces f >= 0 on the claims, of any
 * size, prove that no t satisfies both if
 *
 *     sum of f d  >  sum over the bodies of L |sum of f n, with the sign of the body's side of the pair|,
 *
 * since for any t the left side would be at most the sum of f n.(t_j - t_i), which is at most the right side [Farkas;
 * BV04, section 5.8]. The program's own forces are tried, however inexact its arithmetic was. If one of the claims is
 * strict, equality is a proof, too. This is used only for two or three claims whose sums have no rounding error.
 *
 * Limits enter the program as tangents, added where a solution exceeds a limit. The program finds the solution nearest
 * to the last candidate (quadratic/nearest.c), which satisfied all except the last claim, and so is few steps away. It
 * demands slightly more than the claims (a hair). If it has a solution, but not with that hair, it is solved without
 * it, and then with half a hair less, since between two walls in one line there is room for rounding only. */
#include "displacement/prove/proofs/branching.h"
#include "displacement/prove/proofs/exact_line.h"
#include "displacement/prove/proofs/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>

/* ---- The sum of the forces --------------------------------------------------------------------------------------- */

/* Resets the sums of the bodies of a claim. */
static void begin_sums(sunder_i_branching *c, const sunder_i_claim *s)
{
    c->net[2 * s->i] = c->net[2 * s->i + 1] = c->weight[s->i] = 0;
    if (s->j != SUNDER_I_GROUND) c->net[2 * s->j] = c->net[2 * s->j + 1] = c->weight[s->j] = 0;
}

/* Returns what the limit of body b takes from the contradiction: the limit times the length of the net force on b, with
 * the share `share` of its weight for rounding. Resets the sums of b, so that it is counted once. */
static double take_lost(sunder_i_branching *c, uint32_t b, double share)
{
    const double *net = c->net + 2 * (size_t)b;
    const double lost = c->limit[b] * (sqrt(net[0] * net[0] + net[1] * net[1]) + share * c->weight[b]);
    begin_sums(c, &(sunder_i_claim){.i = b, .j = SUNDER_I_GROUND});
    return lost;
}

/* Rounding, with e = 2^-53 and N claims, |n| <= 1 + 4 e: a sum of N products has an error of (N + 1) e of the sum of
 * their magnitudes, which is computed with the same relative error. A body's net force has an error of 2 (N + 2) e of
 * its weight, the sum of the magnitudes of the forces on it, along each axis. The code takes four times that, and
 * 2^-1000 for underflow. */
bool sunder_i_branching_is_contradiction(sunder_i_branching *branching)
{
    const double share = (double)(branching->claims + branching->bodies + 8) * 0x1p-50;
    double won = 0, all = 0, lost = 0;
    for (size_t k = 0; k < branching->claims; k++) begin_sums(branching, &branching->claim[k]);
    for (size_t k = 0; k < branching->claims; k++) {
        const sunder_i_claim *s = &branching->claim[k];
        if (!(s->force > 0)) continue;
        won += s->force * s->d;
        all += s->force * fabs(s->d);
        for (size_t x = 0; x < 2; x++) branching->net[2 * s->i + x] -= s->force * s->n[x];
        branching->weight[s->i] += s->force;
        if (s->j == SUNDER_I_GROUND) continue;
        for (size_t x = 0; x < 2; x++) branching->net[2 * s->j + x] += s->force * s->n[x];
        branching->weight[s->j] += s->force;
    }
    for (size_t k = 0; k < branching->claims; k++) {
        const sunder_i_claim *s = &branching->claim[k];
        if (!(s->force > 0)) continue;
        lost += take_lost(branching, s->i, share);
        if (s->j != SUNDER_I_GROUND) lost += take_lost(branching, s->j, share);
    }
    return isfinite(all) && won - share * all - 0x1p-1000 > lost * (1 + share);
}

/* Returns the length of a claim's normal. */
static double length_of(const sunder_i_branching *c, const sunder_i_claim *s)
{
    return c->subproblem->exact ? hypot(s->n[0], s->n[1]) : 1;
}

/* Sets the forces of two claims of one pair so that they balance at the shortest relative move that satisfies both.
 * Returns false if one claim alone determines that move. */
static bool balance_claims(const sunder_i_branching *c, sunder_i_claim *p, sunder_i_claim *q)
{
    const double of_p = length_of(c, p), of_q = length_of(c, q), dp = p->d / of_p, dq = q->d / of_q;
    const double sign = p->i == q->i ? 1 : -1, cosine = sign * (p->n[0] * q->n[0] + p->n[1] * q->n[1]) / (of_p * of_q);
    const double square = sunder_i_max(1 - cosine * cosine, 0x1p-100);
    p->force = dp - cosine * dq;
    q->force = dq - cosine * dp;
    if (!(p->force > 0) || !(q->force > 0)) return false;
    p->force /= square * of_p;
    q->force /= square * of_q;
    return true;
}

bool sunder_i_branching_is_dead_end(sunder_i_branching *branching)
{
    sunder_i_claim *last = &branching->claim[branching->claims - 1];
    const double reach = branching->limit[last->i] + (last->j == SUNDER_I_GROUND ? 0 : branching->limit[last->j]);
    for (size_t k = 0; k < branching->claims; k++) branching->claim[k].force = 0;
    last->force = 1;
    if (last->d > reach && sunder_i_branching_is_contradiction(branching)) return true;
    for (size_t k = 0; k + 1 < branching->claims; k++) {
        sunder_i_claim *other = &branching->claim[k];
        if (!(other->i == last->i && other->j == last->j) && !(other->i == last->j && other->j == last->i)) continue;
        if (balance_claims(branching, last, other) && sunder_i_branching_is_contradiction(branching)) return true;
        other->force = 0;
    }
    return false;
}

/* Sets the forces of three claims so that their sum is zero. Returns false if that is impossible with positive
 * forces. */
static bool balance_three(sunder_i_claim *p, sunder_i_claim *q, sunder_i_claim *r)
{
    const double of_p = q->n[0] * r->n[1] - q->n[1] * r->n[0], of_q = r->n[0] * p->n[1] - r->n[1] * p->n[0],
                 of_r = p->n[0] * q->n[1] - p->n[1] * q->n[0], sign = of_p + of_q + of_r < 0 ? -1 : 1;
    p->force = sign * of_p;
    q->force = sign * of_q;
    r->force = sign * of_r;
    return p->force > 0 && q->force > 0 && r->force > 0;
}

bool sunder_i_branching_contradict(sunder_i_branching *branching, const uint32_t *claim, size_t n)
{
    bool is_set = n == 1;
    for (size_t k = 0; k < branching->claims; k++) branching->claim[k].force = 0;
    if (n == 1) branching->claim[claim[0]].force = 1;
    if (n == 2) is_set = balance_claims(branching, &branching->claim[claim[0]], &branching->claim[claim[1]]);
    if (n == 3)
        is_set = balance_three(&branching->claim[claim[0]], &branching->claim[claim[1]], &branching->claim[claim[2]]);
    return is_set && sunder_i_branching_is_contradiction(branching);
}

/* Adds force * d to *won. Returns false if doubles do not hold the product or the sum. */
static bool win_exactly(const sunder_i_claim *s, double *won)
{
    double of_s;
    return sunder_i_multiply_exactly(s->force, s->d, &of_s) && sunder_i_subtract_exactly(of_s, -*won, won);
}

/* Sets the forces of two claims with opposite directions so that their sum is zero, exactly. Returns false if the
 * directions are not opposite. */
static bool balance_opposite(sunder_i_claim *p, sunder_i_claim *q)
{
    const int x = fabs(p->n[0]) > fabs(p->n[1]) ? 0 : 1;
    p->force = fabs(q->n[x]);
    q->force = fabs(p->n[x]);
    return sunder_i_are_equal_products(p->n[0], q->n[1], p->n[1], q->n[0]) && p->n[x] * q->n[x] < 0;
}

/* The same for three claims, where doubles hold the forces. */
static bool balance_three_exactly(sunder_i_claim *p, sunder_i_claim *q, sunder_i_claim *r)
{
    sunder_i_claim *s[3] = {p, q, r};
    int positive = 0;
    for (int k = 0; k < 3; k++) {
        const double *m = s[(k + 1) % 3]->n, turned[2] = {s[(k + 2) % 3]->n[1], -s[(k + 2) % 3]->n[0]};
        if (!sunder_i_dot_exactly(turned, m, &s[k]->force) || s[k]->force == 0) return false;
        positive += s[k]->force > 0;
    }
    for (int k = 0; k < 3; k++) s[k]->force = fabs(s[k]->force);
    return positive == 0 || positive == 3;
}

/* Do two or three claims, with vectors force * n that add up to zero, contradict each other, exactly? r: NULL if there
 * are two. */
static bool win(const sunder_i_claim *p, const sunder_i_claim *q, const sunder_i_claim *r)
{
    double won = 0;
    return win_exactly(p, &won) && win_exactly(q, &won) && (!r || win_exactly(r, &won)) &&
           (won > 0 || (won == 0 && (p->strict || q->strict || (r && r->strict))));
}

bool sunder_i_branching_is_shut(sunder_i_branching *branching, uint32_t p)
{
    sunder_i_claim *last = &branching->claim[p];
    for (size_t k = 0; k < branching->claims; k++) branching->claim[k].force = 0;
    for (size_t k = 0; k < branching->claims; k++) {
        sunder_i_claim *s = &branching->claim[k];
        if (k == p || s->i != last->i || s->j != last->j) continue;
        if (balance_opposite(last, s) && win(last, s, NULL)) return true;
        for (size_t m = 0; m < k; m++) {
            sunder_i_claim *r = &branching->claim[m];
            if (m == p || r->i != last->i || r->j != last->j) continue;
            if (balance_three_exactly(last, s, r) && win(last, s, r)) return true;
            r->force = 0;
        }
        last->force = s->force = 0;
    }
    return false;
}

/* ---- The program ------------------------------------------------------------------------------------------------- */

static double dot_product(const double n[2], const double *t) { return n[0] * t[0] + n[1] * t[1]; }

/* Returns by how much the candidate violates a claim. */
static double missed_by(const sunder_i_branching *c, const sunder_i_claim *s)
{
    return s->d - (s->j == SUNDER_I_GROUND ? 0 : dot_product(s->n, c->t + 2 * (size_t)s->j)) +
           dot_product(s->n, c->t + 2 * (size_t)s->i);
}

/* Adds a constraint: body b may not go beyond its limit in the direction `to`. Returns false if there is nearly the
 * same tangent already. */
static bool add_tangent(sunder_i_branching *c, uint32_t b, const double to[2])
{
    sunder_i_quadratic *p = &c->program;
    const double length = sqrt(dot_product(to, to)), n[2] = {-to[0] / length, -to[1] / length};
    for (size_t k = c->claims; k < p->n; k++)
        if (p->constraint[k].j == b && dot_product(n, p->constraint[k].n) > SAME_TANGENT) return false;
    if (!sunder_i_reserve(&p->constraint, &p->capacity, p->n + 1, sizeof *p->constraint)) {
        c->failed = true;
        return false;
    }
    p->constraint[p->n++] = (sunder_i_constraint){
        .i = SUNDER_I_GROUND, .j = b, .n = {n[0], n[1]}, .d = -c->limit[b] - dot_product(n, c->t + 2 * (size_t)b)};
    return true;
}

/* Sets up the program: the claims, each increased by `margin`, and tangents for bodies at their limits. Returns false
 * if memory is out. */
static bool load_claims(sunder_i_branching *c, double margin)
{
    sunder_i_quadratic *p = &c->program;
    if (!sunder_i_reserve(&p->constraint, &p->capacity, c->claims, sizeof *p->constraint)) return false;
    p->bodies = c->bodies;
    p->t = c->shift;
    p->n = 0;
    for (size_t k = 0; k < c->claims; k++) {
        const sunder_i_claim *s = &c->claim[k];
        p->constraint[p->n++] =
            (sunder_i_constraint){.i = s->i, .j = s->j, .n = {s->n[0], s->n[1]}, .d = missed_by(c, s) + margin};
    }
    for (uint32_t b = 0; b < c->bodies; b++) {
        const double *t = c->t + 2 * (size_t)b;
        if (sqrt(dot_product(t, t)) > AT_LIMIT * c->limit[b]) add_tangent(c, b, t);
    }
    return !c->failed && sunder_i_nearest_begin(&c->nearest, p);
}

/* Adds tangents where the solution exceeds a limit. Returns false if there is none to add. */
static bool add_tangents(sunder_i_branching *c)
{
    bool added = false;
    for (uint32_t b = 0; b < c->bodies; b++) {
        const double t[2] = {c->t[2 * b] + c->shift[2 * b], c->t[2 * b + 1] + c->shift[2 * b + 1]};
        if (sqrt(dot_product(t, t)) > c->limit[b] + c->hair) added = add_tangent(c, b, t) || added;
    }
    return added;
}

/* Makes the solution the candidate. Does it satisfy limits and claims up to a hair? */
static bool is_candidate(sunder_i_branching *c)
{
    double worst = 0;
    for (size_t k = 0; k < 2 * c->bodies; k++) c->t[k] += c->shift[k];
    for (size_t k = 0; k < c->claims; k++) worst = sunder_i_max(worst, missed_by(c, &c->claim[k]));
    for (size_t b = 0; b < c->bodies; b++)
        worst = sunder_i_max(worst, sqrt(dot_product(c->t + 2 * b, c->t + 2 * b)) - c->limit[b]);
    return worst <= c->hair;
}

static sunder_i_node_outcome solve_program(sunder_i_branching *c)
{
    sunder_i_quadratic *p = &c->program;
    sunder_i_nearest_outcome outcome = SUNDER_I_NEAREST_FOUND;
    for (int round = 0; round < ROUNDS && outcome == SUNDER_I_NEAREST_FOUND; round++) {
        outcome = sunder_i_nearest_go_on(&c->nearest, p, c->t, c->limit, c->hair / SOLVED_TO);
        if (outcome != SUNDER_I_NEAREST_FOUND || !add_tangents(c)) break;
    }
    for (size_t k = 0; k < c->claims; k++) c->claim[k].force = p->constraint[k].force;
    if (outcome == SUNDER_I_NEAREST_NONE && sunder_i_branching_is_contradiction(c)) return SUNDER_I_NODE_INFEASIBLE;
    return outcome == SUNDER_I_NEAREST_FOUND && is_candidate(c) ? SUNDER_I_NODE_CANDIDATE : SUNDER_I_NODE_UNDECIDED;
}

sunder_status sunder_i_branching_solve(sunder_i_branching *branching, sunder_i_node_outcome *outcome, sunder_error *err)
{
    *outcome = SUNDER_I_NODE_UNDECIDED;
    static const double hairs[] = {1, 0, -0.5};
    for (size_t k = 0; k < sizeof hairs / sizeof *hairs && *outcome == SUNDER_I_NODE_UNDECIDED; k++) {
        if (!load_claims(branching, hairs[k] * branching->hair)) return sunder_i_failure_cause(err);
        *outcome = solve_program(branching);
        if (branching->failed || !sunder_i_look()) return sunder_i_failure_cause(err);
    }
    return SUNDER_OK;
}
