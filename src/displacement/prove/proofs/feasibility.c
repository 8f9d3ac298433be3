/* A few bodies, their limits, and the things they meet: is there no solution, or is this one?
 *
 * The branch and bound starts with all bodies at their original positions. A candidate (program.c) violates some
 * distances (violations.c). Each violation has several half-planes (half_planes.c), in one of which every solution
 * lies: each is a branch. Either every branch is infeasible (branches.c), or a candidate violates nothing. A body takes
 * part once another one meets it; a body that is never met stays in place and is irrelevant. So the size of a branch
 * and bound is that of the conflict.
 *
 * The question never demands more than a solution has to keep: pairs with reduced requirements keep those; pairs that
 * may overlap (one lies, or could come to lie, in the other, and the rules allow it) and bodies without a limit are
 * left out. Arcs of gaps and limits are replaced by lines that demand at most what the arcs do. So nothing that has a
 * solution is ever called infeasible; and every number that supports a verdict is rounded against it. */
#include "displacement/prove/proofs/branching.h"

#include <math.h>
#include <string.h>

static void clear_branching(sunder_i_branching *c)
{
    sunder_i_free_all(c->slack, c->limit, c->shift, c->net, c->weight, c->claim, c->program.constraint);
    sunder_i_nearest_free(&c->nearest);
    sunder_i_free_all(c->node, c->half_plane, c->chord, c->force, c->scratch);
    sunder_i_half_planes_forget(&c->kept);
    sunder_i_free(c->near.item);
}

/* Returns the candidate, sorted by bodies. Slacks, which are last then, are left out. */
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

/* Makes the solution from the answer about one relative move: that of one body among fixed things, or of two bodies. */
static sunder_status take_plane_solution(const sunder_i_branching *c, const sunder_i_plane_answer *found,
                                         sunder_i_solution *out, sunder_error *err)
{
    const bool two = found->q != SUNDER_I_GROUND;
    const uint32_t body[2] = {found->p, found->q};
    const double of_p = c->limit[0], share = two ? of_p / (of_p + c->limit[1]) : 1, part[2] = {-share, 1 - share};
    out->body = sunder_i_alloc(2, sizeof *out->body);
    out->move = sunder_i_alloc(4, sizeof *out->move);
    if (!out->body || !out->move) return sunder_i_failure_cause(err);
    out->bodies = two ? 2 : 1;
    for (size_t k = 0; k < out->bodies; k++) {
        const size_t from = two && found->p > found->q ? 1 - k : k;
        out->body[k] = body[from];
        for (size_t x = 0; x < 2; x++) out->move[2 * k + x] = part[from] * found->u[x];
    }
    return SUNDER_OK;
}

/* The result of a question about one relative move. */
typedef struct plane_answers {
    bool free;       /* there is a place where nothing is forbidden */
    bool seam;       /* as in sunder_i_plane_answer */
    double place[2]; /* if free: that place */
} plane_answers;

/* Decides the question in the plane of one relative move; the answer may remain unknown. places: NULL, or only these n
 * places are tested. */
static sunder_status decide_in_plane(const sunder_i_subproblem *subproblem, const double (*places)[2], size_t n,
                                     sunder_i_decision *decision, plane_answers *told, sunder_error *err)
{
    sunder_i_branching c = {.subproblem = subproblem, .model = subproblem->model};
    sunder_i_plane_answer answer;
    sunder_status status =
        places ? sunder_i_branching_plane_try(&c, places, n, &answer, err) : sunder_i_branching_plane(&c, &answer, err);
    decision->verdict = answer.verdict;
    told->free = answer.free;
    told->seam = answer.seam;
    memcpy(told->place, answer.u, sizeof told->place);
    if (!status && answer.verdict == SUNDER_I_INFEASIBLE) {
        decision->proof = sunder_i_proof_of(&c, answer.root);
        if (!decision->proof) status = sunder_i_failure_cause(err);
    }
    if (!status && answer.verdict == SUNDER_I_FEASIBLE)
        status = take_plane_solution(&c, &answer, &decision->solution, err);
    decision->work += sunder_i_branching_work(&c);
    sunder_i_free_all(c.body, c.t);
    clear_branching(&c);
    return status;
}

/* Looks for a proof by lines without a rounding error, where others left only a seam or the border of something closed.
 * Otherwise the answer does not change. */
static sunder_status ask_exactly(const sunder_i_subproblem *subproblem, sunder_i_decision *decision,
                                 plane_answers *told, sunder_error *err)
{
    sunder_i_subproblem exactly = *subproblem;
    sunder_i_decision sharper = {.fine_plane = true, .work = decision->work};
    plane_answers answers;
    exactly.coarse = 0;
    exactly.exact = true;
    exactly.planes = NULL;
    const sunder_status status = decide_in_plane(&exactly, NULL, 0, &sharper, &answers, err);
    const bool better = !status && sharper.verdict == SUNDER_I_INFEASIBLE;
    decision->work = sharper.work;
    if (better) *told = answers;
    sunder_i_decision_clear(better ? decision : &sharper);
    if (better) *decision = sharper;
    return status;
}

/* Decides with coarse half-planes first, if requested, and with fine ones if these leave a free place; and with lines
 * without a rounding error if no more than a seam is left. */
static sunder_status ask_all(const sunder_i_subproblem *subproblem, sunder_i_decision *decision, plane_answers *told,
                             sunder_error *err)
{
    sunder_i_subproblem closely = *subproblem;
    sunder_status status = SUNDER_OK;
    const bool coarsely = subproblem->coarse > 0 && !subproblem->fine_plane;
    decision->fine_plane = !coarsely;
    closely.coarse = 0;
    if (coarsely) status = decide_in_plane(subproblem, NULL, 0, decision, told, err);
    if (!status && coarsely && told->free) {
        sunder_i_free_all(decision->solution.body, decision->solution.move);
        decision->solution = (sunder_i_solution){0};
        decision->fine_plane = true;
    }
    if (!status && decision->fine_plane) status = decide_in_plane(&closely, NULL, 0, decision, told, err);
    if (status || decision->verdict == SUNDER_I_INFEASIBLE || !told->seam) return status;
    return ask_exactly(subproblem, decision, told, err);
}

/* Tries to answer by an earlier answer: its free places, then the things of its proof. */
static sunder_status ask_precedent(const sunder_i_subproblem *subproblem, const sunder_i_precedent *precedent,
                                   sunder_i_decision *decision, plane_answers *told, sunder_error *err)
{
    uint32_t set[SUNDER_I_PRECEDENT_THINGS + 2];
    sunder_i_subproblem some = *subproblem;
    sunder_status status = SUNDER_OK;
    some.coarse = 0;
    if (precedent->places) status = decide_in_plane(&some, precedent->place, precedent->places, decision, told, err);
    if (status || told->free) return status;
    some.features = sunder_i_precedent_things(precedent, subproblem, set);
    if (!some.features) return SUNDER_OK;
    some.feature = set;
    some.coarse = precedent->fine ? 0 : subproblem->coarse;
    status = decide_in_plane(&some, NULL, 0, decision, told, err);
    decision->fine_plane = precedent->fine;
    if (decision->verdict == SUNDER_I_INFEASIBLE) return status;
    sunder_i_free_all(decision->solution.body, decision->solution.move);
    decision->solution = (sunder_i_solution){0};
    decision->verdict = SUNDER_I_UNKNOWN;
    told->free = false;
    return status;
}

static sunder_status note_precedent(const sunder_i_subproblem *subproblem, const sunder_i_decision *decision,
                                    const plane_answers *told, sunder_i_precedent *precedent, sunder_error *err)
{
    if (told->free) sunder_i_precedent_note_place(precedent, told->place);
    if (!decision->proof ||
        sunder_i_precedent_note_proof(precedent, subproblem->model, decision->proof, decision->fine_plane))
        return SUNDER_OK;
    return sunder_i_failure_cause(err);
}

static sunder_status ask_plane(const sunder_i_branching *c, sunder_i_decision *decision, sunder_error *err)
{
    const sunder_i_subproblem *subproblem = c->subproblem;
    sunder_i_precedent *precedent = NULL;
    plane_answers told = {.free = false};
    uint32_t p, q;
    sunder_status status = SUNDER_OK;
    if (subproblem->precedents && sunder_i_branching_plane_bodies(c, &p, &q))
        precedent = sunder_i_precedents_take(subproblem->precedents, p, q);
    if (precedent) status = ask_precedent(subproblem, precedent, decision, &told, err);
    if (!status && decision->verdict == SUNDER_I_UNKNOWN && !told.free)
        status = ask_all(subproblem, decision, &told, err);
    if (!status && precedent) status = note_precedent(subproblem, decision, &told, precedent, err);
    decision->no_plane = decision->verdict == SUNDER_I_UNKNOWN;
    return status;
}

sunder_status sunder_i_decide(const sunder_i_subproblem *subproblem, sunder_i_decision *decision, sunder_error *err)
{
    *decision = (sunder_i_decision){.verdict = SUNDER_I_UNKNOWN};
    sunder_i_subproblem with_slack = *subproblem;
    sunder_i_branching c = {.subproblem = subproblem, .model = subproblem->model};
    bool limited = subproblem->bodies <= subproblem->most;
    for (size_t k = 0; k < subproblem->bodies && limited; k++) {
        const sunder_i_body *b = &subproblem->model->body[subproblem->body[k]];
        limited = limited && (b->fixed || isfinite(b->limit) || subproblem->instead > 0);
        sunder_i_branching_join(&c, subproblem->body[k]);
    }
    sunder_status status = c.failed ? sunder_i_failure_cause(err) : SUNDER_OK;
    sunder_i_levels levels;
    size_t root = 0;
    decision->no_plane = subproblem->no_plane;
    for (size_t k = 0; k < c.bodies && !status && limited && subproblem->still && !c.walls; k++)
        status = sunder_i_branching_find_corridor(&c, c.body[k], err);
    limited = limited && (!subproblem->still || c.walls);
    with_slack.slack = subproblem->slack || (c.walls && (c.wall[0].slack || c.wall[1].slack));
    c.subproblem = &with_slack;
    if (!status && limited && c.longest > 0 && !subproblem->slack && !subproblem->still && !subproblem->no_plane)
        status = ask_plane(&c, decision, err);
    if (status || decision->verdict != SUNDER_I_UNKNOWN || subproblem->effort == 0) {
        sunder_i_free_all(c.body, c.t);
        clear_branching(&c);
        return status;
    }
    if (!status && limited && c.longest > 0)
        status = sunder_i_branching_search(&c, 0, &decision->verdict, &levels, &root, err);
    if (!status && decision->verdict == SUNDER_I_INFEASIBLE) {
        decision->proof = sunder_i_proof_of(&c, root);
        if (!decision->proof) status = sunder_i_failure_cause(err);
    }
    decision->work += sunder_i_branching_work(&c);
    if (!status && decision->verdict == SUNDER_I_FEASIBLE) {
        decision->solution = take_solution(&c);
    } else {
        sunder_i_free_all(c.body, c.t);
    }
    clear_branching(&c);
    return status;
}

void sunder_i_decision_clear(sunder_i_decision *decision)
{
    sunder_i_free_all(decision->solution.body, decision->solution.move);
    sunder_i_proof_free(decision->proof);
    memset(decision, 0, sizeof *decision);
}
