/* proof_town.h: a layer whose proofs are checked: features, and barriers behind them, as the library has them and as
 * the checker does. */
#ifndef PROOF_TOWN_H
#define PROOF_TOWN_H

#include "proof_check.h"

#include "sunder.h"

enum { PROOF_TOWN_MOST = 100, PROOF_TOWN_CORNERS = 8, PROOF_TOWN_BARRIERS = 6 };

typedef struct proof_town {
    double xy[PROOF_TOWN_MOST][2 * PROOF_TOWN_CORNERS];
    proof_feature plain[PROOF_TOWN_MOST]; /* barriers behind the features */
    sunder_feature feature[PROOF_TOWN_MOST];
    size_t n;
    sunder_barrier barrier[PROOF_TOWN_BARRIERS];
    size_t corners[PROOF_TOWN_BARRIERS], barriers;
    double gap;
    bool blocks;
} proof_town;

/* A feature that is a ring of this many corners; 0: it is fixed. */
sunder_feature *proof_town_add(proof_town *t, const double *xy, size_t corners, double limit);
sunder_feature *proof_town_add_box(proof_town *t, double x, double y, double w, double h, double limit);
/* A line, a point or (four corners) an area, behind all features. width: a dyadic, like the gap. */
void proof_town_add_barrier(proof_town *t, const double *xy, size_t corners, double width, double gap, bool sides);
/* Separated, by the town's gap and blocks; contained ones, too. */
sunder_report *proof_town_separate(const proof_town *t);
/* How many conflicts have no room, or none on their side, all of them proved; the others have no proof. *open: the
 * number left without a reason. */
size_t proof_town_check(const proof_town *t, const sunder_report *report, size_t trial, size_t *open);
void proof_town_free(proof_town *t);

#endif
