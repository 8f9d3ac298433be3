/* The trace: stores steps in logs, and passes events to the caller with the caller's numbers of features. */
#include "displacement/layer/trace.h"

#include "base/memory.h"

#include <math.h>

bool sunder_i_trace_note(sunder_i_trace_log *log, const sunder_i_trace_step *step)
{
    if (!sunder_i_reserve(&log->step, &log->capacity, log->n + 1, sizeof *log->step)) return false;
    log->step[log->n++] = *step;
    return true;
}

void sunder_i_trace_log_free(sunder_i_trace_log *log)
{
    sunder_i_free(log->step);
    *log = (sunder_i_trace_log){0};
}

double sunder_i_trace_cost(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move)
{
    double cost = 0;
    for (size_t k = 0; k < n; k++) {
        const double *t = move ? move + 2 * k : model->move + 2 * (size_t)body[k];
        cost += model->body[body[k]].weight * sunder_i_stray_square(model, body[k], t);
    }
    return cost;
}

static sunder_trace_event event_of(const sunder_i_model *model, const char *scope, const sunder_i_trace_step *step)
{
    return (sunder_trace_event){.pass = model->pass,
                                .stage = model->stage,
                                .round = model->round,
                                .scope = scope,
                                .step = step->step,
                                .outcome = step->outcome,
                                .cost_before = step->before,
                                .cost_after = step->after,
                                .table = step->table};
}

/* Returns the members of the n bodies by the caller's numbers, ascending and without duplicates; the caller frees it.
 * Returns NULL if memory is out. */
static uint32_t *list_things(const sunder_i_model *model, const uint32_t *body, size_t n, size_t *things)
{
    size_t most = 0, out = 0;
    for (size_t k = 0; k < n; k++) most += model->body[body[k]].members;
    uint32_t *thing = sunder_i_alloc(most, sizeof *thing);
    if (!thing) return NULL;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *b = &model->body[body[k]];
        for (uint32_t m = 0; m < b->members; m++) thing[out++] = model->layer->number[model->member[b->member + m]];
    }
    *things = sunder_i_set_make(thing, out);
    return thing;
}

static sunder_status emit_steps(const sunder_i_model *model, const char *scope, const sunder_i_trace_step *step,
                                size_t steps, const uint32_t *body, size_t n, sunder_error *err)
{
    size_t things;
    uint32_t *thing = list_things(model, body, n, &things);
    if (!thing) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < steps; k++) {
        sunder_trace_event event = event_of(model, scope, &step[k]);
        event.thing = thing;
        event.things = things;
        model->rules.trace(&event, model->rules.trace_user);
    }
    sunder_i_free(thing);
    return SUNDER_OK;
}

sunder_status sunder_i_trace_log_emit(const sunder_i_model *model, const char *scope, sunder_i_trace_log *log,
                                      const uint32_t *body, size_t n, sunder_error *err)
{
    if (log->n == 0) return SUNDER_OK;
    const sunder_status status = emit_steps(model, scope, log->step, log->n, body, n, err);
    log->n = 0;
    return status;
}

sunder_status sunder_i_trace_emit(const sunder_i_model *model, const char *scope, const sunder_i_trace_step *step,
                                  const uint32_t *body, size_t n, sunder_error *err)
{
    return sunder_i_is_traced(model) ? emit_steps(model, scope, step, 1, body, n, err) : SUNDER_OK;
}

void sunder_i_trace_pair(const sunder_i_model *model, const char *step, const char *outcome, uint32_t a, uint32_t b)
{
    if (!sunder_i_is_traced(model)) return;
    const uint32_t p = model->layer->number[a], q = model->layer->number[b];
    const uint32_t thing[2] = {p < q ? p : q, p < q ? q : p};
    const sunder_i_trace_step done = {NULL, step, outcome, NAN, NAN};
    sunder_trace_event event = event_of(model, "pair", &done);
    event.thing = thing;
    event.things = 2;
    model->rules.trace(&event, model->rules.trace_user);
}

double sunder_i_trace_layer_cost(const sunder_i_model *model)
{
    double cost = 0;
    for (uint32_t b = 0; b < model->bodies && sunder_i_is_traced(model); b++)
        cost += sunder_i_trace_cost(model, &b, 1, NULL);
    return cost;
}

void sunder_i_trace_layer(const sunder_i_model *model, const sunder_i_trace_step *step)
{
    if (!sunder_i_is_traced(model)) return;
    sunder_trace_event event = event_of(model, "layer", step);
    event.cost_after = sunder_i_trace_layer_cost(model);
    model->rules.trace(&event, model->rules.trace_user);
}
