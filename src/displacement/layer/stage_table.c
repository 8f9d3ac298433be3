/* The stages of a table, one after the other; for the trace, what each of them changed. */
#include "displacement/layer/stage_table.h"

#include "base/stage_switch.h"

static bool is_over(const sunder_i_stage_run *run) { return run->status || run->over || (run->failed && *run->failed); }

static void run_traced(const sunder_i_stage_table *table, const sunder_i_stage *stage, void *state)
{
    sunder_i_stage_run *run = state;
    double before[2] = {0, 0}, now[2] = {0, 0};
    table->look(state, now, before);
    stage->run(state);
    if (run->status) return;
    const char *outcome = table->look(state, before, now);
    const sunder_i_trace_step step = {table->name, stage->name, outcome, before[0], now[0]};
    const bool changed = now[0] < before[0] || now[0] > before[0] || now[1] < before[1] || now[1] > before[1];
    if (changed && !sunder_i_trace_note(run->log, &step)) run->status = sunder_i_failure_cause(run->err);
}

sunder_status sunder_i_stages_run(const sunder_i_stage_table *table, void *state)
{
    sunder_i_stage_run *run = state;
    for (size_t k = 0; k < table->n && !is_over(run); k++) {
        const sunder_i_stage *stage = &table->stage[k];
        if (!sunder_i_stage_is_on(table->name, stage->name) || (stage->applies && !stage->applies(state))) continue;
        run->budget = stage->budget;
        if (run->log)
            run_traced(table, stage, state);
        else
            stage->run(state);
    }
    return run->status;
}
