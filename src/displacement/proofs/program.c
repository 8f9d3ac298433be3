/* The convex program of one node of a branch and bound, and the proof that it has no solution.
 *
 * The claims to the node say n.(t_j - t_i) >= d, and limits |t| <= L. Forces f >= 0 on the claims, of any size, prove
 * that no t does both if
 *
 *     sum of f d  >  sum over the bodies of L |sum of f n, signed by the side of the pair|,
 *
 * for any t would make the left side at most the sum of f n.(t_j - t_i), which is at most the right [Farkas; BV04,
 * section 5.8]. The program's own forces are tried, whatever it restored with.
 *
 * Limits enter it as tangents, added where a solution oversteps one. The program pulls each body to a place, softly,
 * and asks a hair more of the claims than they say, so that its softness does not show. The place is the last solution,
 * and the program is solved again and again [proximal point method, Roc76]: so the pull vanishes, and with it what it
 * spoils of the forces' balance, where the claims contradict the limits by a millionth of them or less. Where that is
 * too slow (two claims that all but oppose each other, of which a solution lies far off, where their lines meet), the
 * program is made harder each time. */
#include "displacement/proofs/branching.h"
#include "displacement/proofs/tuning.h"

#include "base/watch.h"

#include <math.h>

#define TANGENT UINT64_MAX

/* ---- The sum ----------------------------------------------------------------------------------------------------- */

/* Rounding, with e = 2^-53 and N claims, |n| <= 1 + 4 e: a sum of N products is off by (N + 1) e of the sum of their
 * magnitudes, and that by as much of itself. A body's net force is so off by 2 (N + 2) e of its weight, the sum of the
 * forces on it, each way. What follows takes four times that, and 2^-1000 for what falls below the normal numbers. */
static bool is_contradiction(sunder_i_branching *c)
{
    const double share = (double)(c->claims + c->bodies + 8) * 0x1p-50;
    double won = 0, all = 0, lost = 0;
    for (size_t b = 0; b < c->bodies; b++) c->net[2 * b] = c->net[2 * b + 1] = c->weight[b] = 0;
    for (size_t k = 0; k < c->claims; k++) {
        const sunder_i_claim *s = &c->claim[k];
        if (!(s->force > 0)) continue;
        won += s->force * s->d;
        all += s->force * fabs(s->d);
        for (size_t x = 0; x < 2; x++) c->net[2 * s->i + x] -= s->force * s->n[x];
        c->weight[s->i] += s->force;
        if (s->j == SUNDER_I_GROUND) continue;
        for (size_t x = 0; x < 2; x++) c->net[2 * s->j + x] += s->force * s->n[x];
        c->weight[s->j] += s->force;
    }
    for (size_t b = 0; b < c->bodies; b++) {
        const double *net = c->net + 2 * b;
        lost += c->limit[b] * (sqrt(net[0] * net[0] + net[1] * net[1]) + share * c->weight[b]);
    }
    return isfinite(all) && won - share * all - 0x1p-1000 > lost * (1 + share);
}

bool sunder_i_branching_is_dead_end(sunder_i_branching *c)
{
    sunder_i_claim *last = &c->claim[c->claims - 1];
    if (!(last->d > c->limit[last->i] + (last->j == SUNDER_I_GROUND ? 0 : c->limit[last->j]))) return false;
    for (size_t k = 0; k < c->claims; k++) c->claim[k].force = 0;
    last->force = 1;
    return is_contradiction(c);
}

/* ---- The program ------------------------------------------------------------------------------------------------- */

static double at(const double n[2], const double *t) { return n[0] * t[0] + n[1] * t[1]; }

/* By how much the candidate misses what a claim says. */
static double missed_by(const sunder_i_branching *c, const sunder_i_claim *s)
{
    return s->d - (s->j == SUNDER_I_GROUND ? 0 : at(s->n, c->t + 2 * (size_t)s->j)) + at(s->n, c->t + 2 * (size_t)s->i);
}

/* Steps and tangents, as they look from the candidate. */
static bool load(sunder_i_branching *c)
{
    sunder_i_quadratic *p = &c->program;
    if (!sunder_i_reserve(&p->constraint, &p->capacity, c->claims + c->tangents, sizeof *p->constraint)) return false;
    p->bodies = c->bodies;
    p->mass = c->mass;
    p->t = c->shift;
    p->n = 0;
    for (size_t k = 0; k < c->claims; k++) {
        const sunder_i_claim *s = &c->claim[k];
        const double d = missed_by(c, s) + c->hair;
        p->constraint[p->n++] = (sunder_i_constraint){s->i, s->j, {s->n[0], s->n[1]}, d, s->force, k};
    }
    for (size_t k = 0; k < c->tangents; k++) {
        const sunder_i_tangent *s = &c->tangent[k];
        const double d = -c->limit[s->body] - at(s->n, c->t + 2 * s->body);
        p->constraint[p->n++] =
            (sunder_i_constraint){SUNDER_I_GROUND, s->body, {s->n[0], s->n[1]}, d, s->force, TANGENT - k};
    }
    return true;
}

static void take_over(sunder_i_branching *c)
{
    const sunder_i_quadratic *p = &c->program;
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *e = &p->constraint[k];
        *(e->key < c->claims ? &c->claim[e->key].force : &c->tangent[TANGENT - e->key].force) = e->force;
    }
    for (size_t k = 0; k < 2 * c->bodies; k++) c->t[k] += c->shift[k];
}

/* By how much the candidate misses a claim at worst. */
static double worst_claim(const sunder_i_branching *c)
{
    double worst = 0;
    for (size_t k = 0; k < c->claims; k++) worst = fmax(worst, missed_by(c, &c->claim[k]));
    return worst;
}

/* Tangents where the candidate oversteps a limit; how many, and the longest overstep. */
static size_t add_tangents(sunder_i_branching *c, double *worst)
{
    size_t added = 0;
    *worst = 0;
    for (uint32_t b = 0; b < c->bodies; b++) {
        const double *t = c->t + 2 * b, length = sqrt(at(t, t)), over = length - c->limit[b];
        if (!(over > c->hair)) continue;
        *worst = fmax(*worst, over);
        const double n[2] = {-t[0] / length, -t[1] / length};
        bool known = false;
        for (size_t k = 0; k < c->tangents && !known; k++)
            known = c->tangent[k].body == b && at(n, c->tangent[k].n) > 1 - 0x1p-40;
        if (known) continue;
        if (!sunder_i_reserve(&c->tangent, &c->tangent_capacity, c->tangents + 1, sizeof *c->tangent)) {
            c->failed = true;
            return 0;
        }
        c->tangent[c->tangents++] = (sunder_i_tangent){b, {n[0], n[1]}, 0};
        added++;
    }
    return added;
}

static void drop_idle_tangents(sunder_i_branching *c)
{
    size_t out = 0;
    for (size_t k = 0; k < c->tangents; k++)
        if (c->tangent[k].force > 0) c->tangent[out++] = c->tangent[k];
    c->tangents = out;
}

sunder_status sunder_i_branching_solve(sunder_i_branching *c, sunder_i_node_outcome *outcome, sunder_error *err)
{
    double missed = INFINITY, over = INFINITY, softness = SOFTNESS;
    drop_idle_tangents(c);
    for (int round = 0; round < ROUNDS && !sunder_i_branching_is_over(c); round++) {
        if (round >= SOFT_ROUNDS) softness = fmax(softness / HARDER, LEAST_SOFTNESS);
        if (!load(c) || sunder_i_quadratic_solve(&c->program, softness, c->hair / SOLVED_TO, c->longest) < 0)
            return sunder_i_no_memory(err);
        if (!sunder_i_look()) return sunder_i_no_memory(err);
        take_over(c);
        *outcome = SUNDER_I_NODE_INFEASIBLE;
        if (is_contradiction(c)) return SUNDER_OK;
        missed = worst_claim(c);
        add_tangents(c, &over);
        if (c->failed) return sunder_i_no_memory(err);
        *outcome = SUNDER_I_NODE_CANDIDATE;
        if (missed <= c->hair && over <= c->hair) return SUNDER_OK;
    }
    *outcome = SUNDER_I_NODE_UNDECIDED;
    return SUNDER_OK;
}
