/* A layer separated or checked, as tests ask for it. What fails, fails the test. */
#ifndef SUNDER_TESTS_RUN_LAYER_H
#define SUNDER_TESTS_RUN_LAYER_H

#include "sunder.h"

/* The rule that nothing is made worse is asked of the report (upheld.h). Freed by the caller. */
sunder_report *run_separate(const sunder_feature *feature, size_t n, const sunder_layer_options *options);
sunder_report *run_check(const sunder_feature *feature, size_t n, const sunder_layer_options *options);

#endif
