/* The stages of a table, one after the other, each in rounds as long as it changes something. */
#include "displacement/solve/clusters/layer_stages.h"

#include "base/invariant.h"
#include "base/stage_switch.h"

/* Runs the rounds of one stage. `from` and `to` are the progress at the beginning and the end of the table. */
static sunder_status run_rounds(sunder_i_solver *s, const sunder_i_layer_table *table, const sunder_i_layer_stage *x,
                                double from, double to, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    bool changed = true;
    for (int round = 0; round < x->rounds && changed && !status; round++) {
        if (x->applies && !x->applies(s)) break;
        if (s->failed) return sunder_i_failure_cause(err);
        s->changed = false;
        s->model.round = x->rounds > 1 ? round + 1 : 0;
        status = x->run(s, err);
        changed = s->changed && table->settle;
        if (!status && changed)
            status = table->settle(s, from + (to - from) * x->from, from + (to - from) * x->to, err);
        if (!status) SUNDER_I_CHECK(sunder_i_solver_check_states(s), s->model.bodies);
        const sunder_i_trace_step done = {table->name, NULL, changed ? "changed" : "done", NAN, NAN};
        if (!status) sunder_i_trace_layer(&s->model, &done);
    }
    return status;
}

static sunder_status run_step(sunder_i_solver *s, const sunder_i_layer_table *table, const sunder_i_layer_stage *x,
                              sunder_error *err)
{
    if (x->applies && !x->applies(s)) return SUNDER_OK;
    const double before = sunder_i_trace_layer_cost(&s->model);
    const sunder_status status = x->run(s, err);
    const double after = sunder_i_trace_layer_cost(&s->model);
    const sunder_i_trace_step done = {table->name, x->name, "changed", before, after};
    if (!status && (after < before || after > before)) sunder_i_trace_layer(&s->model, &done);
    return status;
}

sunder_status sunder_i_solver_run_stages(sunder_i_solver *solver, const sunder_i_layer_table *table, double from,
                                         double to, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < table->n && !status; k++) {
        const sunder_i_layer_stage *x = &table->stage[k];
        if (table->kind != SUNDER_I_TABLE_OF_STEPS)
            *(table->kind == SUNDER_I_TABLE_OF_STAGES ? &solver->model.stage : &solver->model.pass) = x->name;
        if (!sunder_i_stage_is_on(table->name, x->name)) continue;
        status = table->kind == SUNDER_I_TABLE_OF_STEPS ? run_step(solver, table, x, err)
                                                        : run_rounds(solver, table, x, from, to, err);
    }
    if (table->kind != SUNDER_I_TABLE_OF_STEPS) solver->model.stage = NULL;
    return status;
}
