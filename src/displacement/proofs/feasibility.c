/* A few bodies, their limits, and what they run into: is there no solution, or does this one do?
 *
 * The inquiry starts from the bodies as they stand. A candidate (program.c) shows what is nearer than it owes
 * (candidate.c), and for each there are ways out (ways.c), one of which any solution takes: a branch for each, and each
 * void in its turn (branches.c), or there is a candidate in which nothing meets. A body takes part once something met
 * it; who is never met stands where it was, and has no say. So an inquiry is as large as the conflict.
 *
 * What is asked is never more than what a solution owes: pairs held to less, pairs that may overlap (one lies, or could
 * come to lie, in the other, and the rules allow it) and bodies without a limit are left out, gaps and limits are round
 * where a line touches them and cut off inside elsewhere. So nothing that has a solution is ever called insoluble; and
 * every figure that a verdict stands on is rounded against it. */
#include "displacement/proofs/branching.h"

#include <math.h>
#include <string.h>

static void clear(sunder_i_inquiry *c)
{
    sunder_i_free(c->limit);
    sunder_i_free(c->mass);
    sunder_i_free(c->shift);
    sunder_i_free(c->net);
    sunder_i_free(c->weight);
    sunder_i_free(c->step);
    sunder_i_free(c->tangent);
    sunder_i_free(c->program.constraint);
    sunder_i_free(c->node);
    sunder_i_free(c->way);
    sunder_i_free(c->force);
    sunder_i_free(c->scratch);
    sunder_i_free(c->near.item);
}

sunder_status sunder_i_certify(const sunder_i_question *question, sunder_i_answer *answer, sunder_error *err)
{
    *answer = (sunder_i_answer){.verdict = SUNDER_I_UNKNOWN};
    sunder_i_inquiry c = {.question = question, .town = question->town};
    bool limited = question->bodies <= question->most;
    for (size_t k = 0; k < question->bodies && limited; k++) {
        const sunder_i_body *b = &question->town->body[question->body[k]];
        limited = limited && (b->fixed || isfinite(b->limit));
        sunder_i_inquiry_place(&c, question->body[k]);
    }
    sunder_status status = c.failed ? sunder_i_no_memory(err) : SUNDER_OK;
    sunder_i_levels levels;
    size_t root = 0;
    if (!status && limited && c.longest > 0)
        status = sunder_i_inquiry_search(&c, 0, &answer->verdict, &levels, &root, err);
    if (!status && answer->verdict == SUNDER_I_INSOLUBLE) {
        answer->proof = sunder_i_proof_of(&c, root);
        if (!answer->proof) status = sunder_i_no_memory(err);
    }
    answer->work = sunder_i_inquiry_work(&c);
    if (!status && answer->verdict == SUNDER_I_SOLVED) {
        answer->solution = (sunder_i_solution){c.body, c.t, c.bodies};
    } else {
        sunder_i_free(c.body);
        sunder_i_free(c.t);
    }
    clear(&c);
    return status;
}

void sunder_i_answer_clear(sunder_i_answer *answer)
{
    sunder_i_free(answer->solution.body);
    sunder_i_free(answer->solution.move);
    sunder_i_proof_free(answer->proof);
    memset(answer, 0, sizeof *answer);
}
