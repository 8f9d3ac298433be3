/* stage_switch.h: whether a stage may run. In the library every stage may.
 *
 * The function is called for each row of the tables of stages, for methods of quadratic programming, and for memos. The
 * ablation harness builds the library a second time with another header of this name (tests/bench/ablation/base/),
 * which switches stages off by name: the difference of the results shows the effect of a stage. */
#ifndef SUNDER_I_STAGE_SWITCH_H
#define SUNDER_I_STAGE_SWITCH_H

#include <stdbool.h>

/* table: the name of a table of stages (docs/trace.md lists the tables); "program", a method of quadratic programming;
 * "memo", results that are stored for repeated use. stage: the name in the table. */
static inline bool sunder_i_stage_is_on(const char *table, const char *stage)
{
    (void)table;
    (void)stage;
    return true;
}

#endif
