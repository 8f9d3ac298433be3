/* Replaces src/base/stage_switch.h in a library whose stages can be switched off by name before a run (../tuning.h). */
#ifndef SUNDER_I_STAGE_SWITCH_H
#define SUNDER_I_STAGE_SWITCH_H

#include <stdbool.h>

bool sunder_i_stage_is_on(const char *table, const char *stage);

#endif
