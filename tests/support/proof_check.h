/* Proofs that a conflict has no room, followed in rationals by code that shares nothing with src/. */
#ifndef SUNDER_TESTS_PROOF_CHECK_H
#define SUNDER_TESTS_PROOF_CHECK_H

#include "sunder.h"

/* A feature: a simple polygon, counter-clockwise, as it stood at the start. Or a barrier: the same, or a line (one of a
 * single corner is a point); it is fixed. */
typedef struct proof_feature {
    const double *xy;
    size_t corners;
    double max_shift;
    bool fixed;
    bool line;
    double owed; /* of a barrier: half its width, and its gap */
    bool sides;  /* of a barrier: it may not be crossed */
} proof_feature;

/* Follows the proof of conflict k of the report: its parts lie in their features, its ways leave nothing out, no
 * clearance is more than is owed, its leaves contradict the limits, and blocked_by names its features. NULL if all is
 * so, else what is not. thing: n features, and behind them the barriers. Features that lie in
 * each other must not be allowed to overlap; of a line that a listed feature overlapped it is asked whether it is
 * deeper only where it has one segment, and the feature is convex: else it is taken for wrong. */
const char *proof_check(const proof_feature *thing, size_t n, size_t things, double gap, const sunder_report *report,
                        size_t k);

#endif
