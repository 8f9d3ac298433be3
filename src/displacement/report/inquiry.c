/* The questions about one remaining conflict share a budget for failures and one small layer that is used for
 * proofs. */
#include "displacement/report/inquiry.h"
#include "displacement/report/tuning.h"

bool sunder_i_is_asked_about(const sunder_conflict *conflict)
{
    return !conflict->inside_block && conflict->reason != SUNDER_REASON_KEPT;
}

void sunder_i_inquiry_note_in_vain(const sunder_i_inquiry *inquiry)
{
    const uint64_t took = inquiry->about->feature.n + inquiry->about->part.n;
    inquiry->left->left -= took < inquiry->left->left ? took : inquiry->left->left;
}

sunder_status sunder_i_inquiry_ask(const sunder_i_inquiry *inquiry, const sunder_i_supposition *what, bool proofs,
                                   sunder_i_answer *answer, sunder_error *err)
{
    const sunder_status status = sunder_i_ask(inquiry->questions, inquiry->about, inquiry->conflict, what,
                                              proofs ? &inquiry->left->proof : NULL, answer, err);
    if (!status && !answer->yes) sunder_i_inquiry_note_in_vain(inquiry);
    return status;
}

void sunder_i_inquiry_end(sunder_i_inquiry *inquiry)
{
    if (inquiry->foresight) sunder_i_foresight_clear(inquiry->foresight);
    sunder_i_free(inquiry->foresight);
    inquiry->foresight = NULL;
}

sunder_status sunder_i_inquiry_look_ahead(sunder_i_inquiry *inquiry, double limit, sunder_error *err)
{
    if (inquiry->foresight) return SUNDER_OK;
    inquiry->foresight = sunder_i_calloc(1, sizeof *inquiry->foresight);
    if (!inquiry->foresight) return sunder_i_failure_cause(err);
    return sunder_i_foresight_init(inquiry->foresight, inquiry->questions, inquiry->about, inquiry->conflict, limit,
                                   err);
}

sunder_status sunder_i_inquiry_search(sunder_i_inquiry *inquiry, const sunder_i_supposition *what,
                                      sunder_i_answer *answer, sunder_error *err)
{
    sunder_i_inquiry *q = inquiry;
    const sunder_i_foresight *f = q->foresight;
    sunder_i_verdict verdict = SUNDER_I_UNKNOWN;
    double refuted;
    *answer = (sunder_i_answer){.refuted = what->gap, .layout = answer->layout};
    sunder_status status =
        f ? sunder_i_foresee(q->foresight, what, SUNDER_I_FORESEE_SEARCH, &verdict, &refuted, err) : SUNDER_OK;
    if (!status && verdict == SUNDER_I_INFEASIBLE) {
        answer->foreseen = true;
        answer->refuted = refuted;
        sunder_i_inquiry_note_in_vain(q);
        return status;
    }
    const bool proofs = !f || (f->n > 0 && f->n <= NEED_ALL);
    return status ? status : sunder_i_inquiry_ask(q, what, proofs, answer, err);
}
