/* Separates or checks a layer for a test. Any failure fails the test. */
#ifndef SUNDER_TESTS_RUN_LAYER_H
#define SUNDER_TESTS_RUN_LAYER_H

#include "sunder.h"

/* Separates and checks the rule that nothing gets worse (upheld.h). The caller frees the report. */
sunder_report *run_separate(const sunder_feature *feature, size_t n, const sunder_layer_options *options);
sunder_report *run_check(const sunder_feature *feature, size_t n, const sunder_layer_options *options);

#endif
