/* proof_town.h: a layer whose proofs are verified: features followed by barriers, both for the library and for the
 * checker. */
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

/* A feature that is a ring with this many corners; limit 0: it is fixed. */
sunder_feature *proof_town_add(proof_town *t, const double *xy, size_t corners, double limit);
sunder_feature *proof_town_add_box(proof_town *t, double x, double y, double w, double h, double limit);
/* A line, a point or (four corners) an area, after all features. width: a dyadic fraction, like the gap. */
void proof_town_add_barrier(proof_town *t, const double *xy, size_t corners, double width, double gap, bool sides);
/* Separates with the town's gap and blocks; containment counts as a conflict. */
sunder_report *proof_town_separate(const proof_town *t);
/* Verifies all proofs. Returns the number of conflicts with the reason no_room or side, all of which have to be proved;
 * the others must have no proof. *open: the number of conflicts left without a reason. */
size_t proof_town_check(const proof_town *t, const sunder_report *report, size_t trial, size_t *open);
void proof_town_free(proof_town *t);

#endif
