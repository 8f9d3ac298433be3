/* A few bodies, their limits, and what they run into: is there no solution, or does this one do?
 *
 * The branch and bound starts from the bodies as they stand. A candidate (program.c) shows what is nearer than it
 * owes (violations.c), and for each there are ways out (ways.c), one of which any solution takes: a branch for each,
 * and each void in its turn (branches.c), or there is a candidate in which nothing meets. A body takes part once
 * something met it; who is never met stands where it was, and has no say. So a branch and bound is as large as the
 * conflict.
 *
 * What is asked is never more than what a solution owes: pairs that are held to less, pairs that may overlap (one
 * lies, or could come to lie, in the other, and the rules allow it) and bodies without a limit are left out, gaps
 * and limits are round where a line touches them and cut off inside elsewhere. So nothing that has a solution is
 * ever called infeasible; and every figure that a verdict stands on is rounded against it. */
#include "displacement/proofs/branching.h"

#include <math.h>
#include <string.h>

static void clear(sunder_i_branching *c)
{
    sunder_i_free(c->slack);
    sunder_i_free(c->limit);
    sunder_i_free(c->shift);
    sunder_i_free(c->net);
    sunder_i_free(c->weight);
    sunder_i_free(c->claim);
    sunder_i_free(c->program.constraint);
    sunder_i_nearest_free(&c->nearest);
    sunder_i_free(c->node);
    sunder_i_free(c->way);
    sunder_i_free(c->force);
    sunder_i_free(c->scratch);
    sunder_i_free(c->near.item);
}

/* The candidate, by ascending bodies; slacks, which come last then, are none of it. */
static sunder_i_solution take_solution(sunder_i_branching *c)
{
    for (size_t k = 1; k < c->bodies; k++) {
        const uint32_t body = c->body[k];
        const double t[2] = {c->t[2 * k], c->t[2 * k + 1]};
        size_t at = k;
        for (; at && c->body[at - 1] > body; at--) {
            c->body[at] = c->body[at - 1];
            memcpy(c->t + 2 * at, c->t + 2 * (at - 1), sizeof t);
        }
        c->body[at] = body;
        memcpy(c->t + 2 * at, t, sizeof t);
    }
    return (sunder_i_solution){c->body, c->t, c->bodies - c->slacks};
}

sunder_status sunder_i_decide(const sunder_i_subproblem *subproblem, sunder_i_decision *decision, sunder_error *err)
{
    *decision = (sunder_i_decision){.verdict = SUNDER_I_UNKNOWN};
    sunder_i_branching c = {.subproblem = subproblem, .model = subproblem->model};
    bool limited = subproblem->bodies <= subproblem->most;
    for (size_t k = 0; k < subproblem->bodies && limited; k++) {
        const sunder_i_body *b = &subproblem->model->body[subproblem->body[k]];
        limited = limited && (b->fixed || isfinite(b->limit) || subproblem->instead > 0);
        sunder_i_branching_join(&c, subproblem->body[k]);
    }
    sunder_status status = c.failed ? sunder_i_no_memory(err) : SUNDER_OK;
    sunder_i_levels levels;
    size_t root = 0;
    if (!status && limited && c.longest > 0)
        status = sunder_i_branching_search(&c, 0, &decision->verdict, &levels, &root, err);
    if (!status && decision->verdict == SUNDER_I_INFEASIBLE) {
        decision->proof = sunder_i_proof_of(&c, root);
        if (!decision->proof) status = sunder_i_no_memory(err);
    }
    decision->work = sunder_i_branching_work(&c);
    if (!status && decision->verdict == SUNDER_I_FEASIBLE) {
        decision->solution = take_solution(&c);
    } else {
        sunder_i_free(c.body);
        sunder_i_free(c.t);
    }
    clear(&c);
    return status;
}

void sunder_i_decision_clear(sunder_i_decision *decision)
{
    sunder_i_free(decision->solution.body);
    sunder_i_free(decision->solution.move);
    sunder_i_proof_free(decision->proof);
    memset(decision, 0, sizeof *decision);
}
