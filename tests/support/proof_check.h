/* Proofs that a conflict has no room, followed in rationals by code that shares nothing with src/. */
#ifndef SUNDER_TESTS_PROOF_CHECK_H
#define SUNDER_TESTS_PROOF_CHECK_H

#include "sunder.h"

/* A simple polygon, counter-clockwise, as it stood at the start. */
typedef struct proof_feature {
    const double *xy;
    size_t corners;
    double max_shift;
    bool fixed;
} proof_feature;

/* Follows the proof of conflict k of the report: its parts lie in their features, its ways leave nothing out, no
 * clearance is more than is owed, its leaves contradict the limits, and blocked_by names its features. NULL if all is
 * so, else what is not. Features that lie in each other must not be allowed to overlap. */
const char *proof_check(const proof_feature *feature, size_t n, double gap, const sunder_report *report, size_t k);

#endif
