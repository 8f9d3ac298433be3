/* Earlier results about the same bodies, tried first for the next question.
 *
 * Two blocks of dozens of houses, one of them in a courtyard of the other, have a hundred conflicts, and each is
 * examined: does it have a solution if all others stay? The obstacle is nearly always the same few walls of the
 * courtyard. So the things that sufficed for the last proof, and the two in question, are tried first; the answer is a
 * proof for the whole, and a small one. If one conflict has a solution, the same relative move solves most others: a
 * place that was free before is tested before any search. The verdict is the same as without; only the proof, or the
 * solution, may differ. */
#include "displacement/prove/proofs/branching.h"

#include <string.h>

/* Moves the entry of these bodies to the front, evicting the least recently used one if needed. */
sunder_i_precedent *sunder_i_precedents_take(sunder_i_precedents *precedents, uint32_t p, uint32_t q)
{
    size_t at = 0;
    while (at + 1 < SUNDER_I_PRECEDENTS && precedents->of[at].p != precedents->of[at].q &&
           (precedents->of[at].p != p || precedents->of[at].q != q))
        at++;
    sunder_i_precedent found = precedents->of[at];
    if (found.p != p || found.q != q) found = (sunder_i_precedent){.p = p, .q = q};
    memmove(precedents->of + 1, precedents->of, at * sizeof precedents->of[0]);
    precedents->of[0] = found;
    return &precedents->of[0];
}

void sunder_i_precedent_note_place(sunder_i_precedent *precedent, const double u[2])
{
    size_t at = 0;
    while (at < precedent->places && memcmp(precedent->place[at], u, sizeof precedent->place[at])) at++;
    if (at == precedent->places) {
        if (precedent->places < SUNDER_I_PRECEDENT_PLACES) precedent->places++;
        at = precedent->places - 1;
    }
    const double place[2] = {u[0], u[1]};
    memmove(precedent->place + 1, precedent->place, at * sizeof precedent->place[0]);
    memcpy(precedent->place[0], place, sizeof place);
}

bool sunder_i_precedent_note_proof(sunder_i_precedent *precedent, const sunder_i_model *model,
                                   const sunder_proof *proof, bool fine)
{
    uint32_t *set = sunder_i_alloc(3 * proof->nodes, sizeof *set);
    if (!set) return false;
    const size_t n = sunder_i_proof_things(model, proof, set);
    precedent->things = 0;
    if (n <= SUNDER_I_PRECEDENT_THINGS) {
        memcpy(precedent->thing, set, n * sizeof *set);
        precedent->things = n;
        precedent->fine = fine;
    }
    sunder_i_free(set);
    return true;
}

size_t sunder_i_precedent_things(const sunder_i_precedent *precedent, const sunder_i_subproblem *asked,
                                 uint32_t set[SUNDER_I_PRECEDENT_THINGS + 2])
{
    size_t n = precedent->things;
    if (!n) return 0;
    memcpy(set, precedent->thing, n * sizeof *set);
    if (asked->a != SUNDER_I_NOBODY) set[n++] = asked->a;
    if (asked->b != SUNDER_I_NOBODY) set[n++] = asked->b;
    n = sunder_i_set_make(set, n);
    if (!asked->feature) return n;
    size_t out = 0;
    for (size_t k = 0; k < n; k++)
        if (sunder_i_set_has(asked->feature, asked->features, set[k])) set[out++] = set[k];
    return out < asked->features ? out : 0;
}
