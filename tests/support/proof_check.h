/* Verifies proofs that a conflict has no room, in rationals, by code that shares nothing with src/. */
#ifndef SUNDER_TESTS_PROOF_CHECK_H
#define SUNDER_TESTS_PROOF_CHECK_H

#include "sunder.h"

/* A feature: a simple polygon, counter-clockwise, at its original place. Or a barrier, which is fixed: the same, or a
 * line (one with a single corner is a point). */
typedef struct proof_feature {
    const double *xy;
    size_t corners;
    double max_shift;
    bool fixed;
    bool line;
    double owed; /* of a barrier: half its width plus its gap */
    bool sides;  /* of a barrier: it may not be crossed */
} proof_feature;

/* Verifies the proof of conflict k of the report: its parts lie in their features, its ways cover all cases, no
 * clearance exceeds the required distance, its leaves contradict the limits, and blocked_by names its features. Returns
 * NULL if all this is true, otherwise the fault. thing: n features, followed by the barriers. Features that contain
 * each other must not be allowed to overlap. Whether a line that a listed feature overlapped is deeper is tested only
 * for a line of one segment and a convex feature; otherwise the proof counts as wrong. */
const char *proof_check(const proof_feature *thing, size_t n, size_t things, double gap, const sunder_report *report,
                        size_t k);

#endif
