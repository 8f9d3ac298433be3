/* The rules that a layer is to keep: the caller's options, checked. */
#ifndef SUNDER_I_RULES_H
#define SUNDER_I_RULES_H

#include "sunder.h"
#include <stdbool.h>

/* The options with every default filled in. */
typedef struct sunder_i_rules {
    double gap, tolerance;
    bool joins, list_inside; /* joins: touch and containment make blocks */
    sunder_containment contained;
    unsigned threads;
    sunder_progress progress; /* NULL: nobody asks how far it is */
    void *progress_user;
} sunder_i_rules;

sunder_status sunder_i_rules_of(const sunder_layer_options *options, sunder_i_rules *rules, sunder_error *err);
/* Tells how far it is; false when the caller asked to stop. */
bool sunder_i_progress(const sunder_i_rules *rules, double fraction);

#endif
