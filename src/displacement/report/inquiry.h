/* What the questions about one remaining conflict have in common: needs.c, need_gap.c. */
#ifndef SUNDER_I_INQUIRY_H
#define SUNDER_I_INQUIRY_H

#include "displacement/report/question.h"

/* The remaining budget of a cluster. `left`: the number of features that may still take part in failed questions, each
 * counted in every question. `shift`, `gap` and `gone`: whether the next question about a larger limit, a smaller gap,
 * or a removed feature is asked, depending on how many of that kind failed. `proof`: the same for attempts to prove
 * that a question has no solution, which are made only to save a search that would fail. */
typedef struct sunder_i_needs_budget {
    uint64_t left;
    sunder_i_patience shift, gap, gone, proof;
} sunder_i_needs_budget;

/* The questions about one conflict. */
typedef struct sunder_i_inquiry {
    const sunder_i_questions *questions;
    const sunder_i_surroundings *about;
    sunder_conflict *conflict;
    sunder_i_needs_budget *left;
    sunder_i_foresight *foresight; /* NULL: not made yet */
} sunder_i_inquiry;

/* Frees the small layer that is used for proofs, if it was made. */
void sunder_i_inquiry_end(sunder_i_inquiry *inquiry);

/* Returns whether needs are to be found for this conflict. */
bool sunder_i_is_asked_about(const sunder_conflict *conflict);
/* Asks whether `what` has a solution. If the answer is no, the budget is reduced. With `proofs`, a proof that there is
 * none is attempted first. */
sunder_status sunder_i_inquiry_ask(const sunder_i_inquiry *inquiry, const sunder_i_supposition *what, bool proofs,
                                   sunder_i_answer *answer, sunder_error *err);
/* Asks the same question. If inquiry->foresight was made and a proof about that small layer shows that a search would
 * fail, the answer is no, and no search is made. Otherwise it is answered by sunder_i_inquiry_ask(), with `proofs` set
 * only if no small layer was made, or if it contains other listed pairs, at most NEED_ALL, which have to be solved
 * too. */
sunder_status sunder_i_inquiry_search(sunder_i_inquiry *inquiry, const sunder_i_supposition *what,
                                      sunder_i_answer *answer, sunder_error *err);
/* Reduces the budget by the number of features and barrier parts in the small layer, as a failed question does. */
void sunder_i_inquiry_note_in_vain(const sunder_i_inquiry *inquiry);
/* Makes the small layer that is used for proofs, with this limit, unless it was already made. */
sunder_status sunder_i_inquiry_look_ahead(sunder_i_inquiry *inquiry, double limit, sunder_error *err);

#endif
