/* Stages of the work on a layer, in the order of tables. (layer/stage_table.h has those of a cluster or group.) */
#ifndef SUNDER_I_LAYER_STAGES_H
#define SUNDER_I_LAYER_STAGES_H

#include "displacement/solve/clusters/solver.h"

/* A row of a table. The rows are in the order in which the stages run. */
typedef struct sunder_i_layer_stage {
    const char *name;
    /* The precondition of each round; NULL: none. s->failed: memory is out. */
    bool (*applies)(sunder_i_solver *s);
    /* Runs one round. Sets s->changed if clusters have to be settled and the stage may have another round. */
    sunder_status (*run)(sunder_i_solver *s, sunder_error *err);
    int rounds;      /* the largest number of rounds */
    double from, to; /* the range of the table's progress, from 0 to 1, that settling after this stage covers */
} sunder_i_layer_stage;

typedef enum sunder_i_layer_table_kind {
    SUNDER_I_TABLE_OF_PASSES, /* the whole work */
    SUNDER_I_TABLE_OF_STAGES, /* a pass */
    SUNDER_I_TABLE_OF_STEPS   /* a stage; only steps that change the cost of the layer are traced */
} sunder_i_layer_table_kind;

typedef struct sunder_i_layer_table {
    const char *name; /* in the trace, and for base/stage_switch.h */
    sunder_i_layer_table_kind kind;
    const sunder_i_layer_stage *stage;
    size_t n;
    /* Settles the clusters after a stage changed something. NULL: no stage does. */
    sunder_status (*settle)(sunder_i_solver *s, double from, double to, sunder_error *err);
} sunder_i_layer_table;

/* Runs the stages of a table, in order. Progress goes from `from` to `to`. */
sunder_status sunder_i_solver_run_stages(sunder_i_solver *solver, const sunder_i_layer_table *table, double from,
                                         double to, sunder_error *err);

#endif
