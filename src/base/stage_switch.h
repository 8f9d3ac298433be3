/* May a stage run? In the library every stage may.
 *
 * The tables of stages ask this for each of their rows; so do methods of quadratic programming, and memos. The ablation
 * harness builds the library a second time with another header of this name (tests/bench/ablation/base/), which
 * switches stages off by name: the difference of the results is what a stage is worth. */
#ifndef SUNDER_I_STAGE_SWITCH_H
#define SUNDER_I_STAGE_SWITCH_H

#include <stdbool.h>

/* table: "layer", "search", "cluster" or "group", a table of stages; "program", a method of quadratic programming;
 * "memo", results kept for repeated use. stage: its name there. */
static inline bool sunder_i_stage_is_on(const char *table, const char *stage)
{
    (void)table;
    (void)stage;
    return true;
}

#endif
