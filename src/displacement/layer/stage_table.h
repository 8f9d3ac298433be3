/* Stages in the order of a table.
 *
 * Each sequence of methods in the search for a layout, and in its proof, is a table of stages. The rows of a table are
 * in the order in which its stages run. The stages of one table share a state, whose first member is a
 * sunder_i_stage_run. (solve/clusters/layer_stages.h has the tables of the whole layer.) */
#ifndef SUNDER_I_STAGE_TABLE_H
#define SUNDER_I_STAGE_TABLE_H

#include "displacement/layer/trace.h"

/* A row of a table. */
typedef struct sunder_i_stage {
    const char *name;
    bool (*applies)(const void *state); /* the precondition; NULL: none */
    void (*run)(void *state);
    uint64_t budget; /* what the stage may use, in a unit of its table; 0: nothing, or limits of its own (tuning.h) */
} sunder_i_stage;

/* The first member of the state that the stages of a table share. */
typedef struct sunder_i_stage_run {
    sunder_i_trace_log *log; /* receives what each stage did; NULL: the layer is not traced */
    const bool *failed;      /* no stage runs once it is set; NULL: there is none */
    sunder_error *err;
    sunder_status status; /* of the stages so far; after an error no stage runs */
    uint64_t budget;      /* of the present stage */
    bool over;            /* no stage runs any more */
} sunder_i_stage_run;

typedef struct sunder_i_stage_table {
    const char *name; /* in the trace, and for base/stage_switch.h */
    const sunder_i_stage *stage;
    size_t n;
    /* For the trace: sets now[0] to the present cost, and now[1] to another number that stages may change. Returns the
     * outcome of a stage that changed one of them; before: what they were. */
    const char *(*look)(const void *state, const double before[2], double now[2]);
} sunder_i_stage_table;

/* Runs the stages whose precondition is true, in order. state: begins with a sunder_i_stage_run. Returns its status. */
sunder_status sunder_i_stages_run(const sunder_i_stage_table *table, void *state);

#endif
