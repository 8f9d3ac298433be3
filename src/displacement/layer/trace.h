/* Trace events of the work on a layer, for developers (sunder_trace in sunder_layer.h).
 *
 * A stage of a cluster or a group records what it did in the log of that cluster or group, on any thread. The thread
 * that drives the rounds passes the logs to the caller, in the order of clusters and groups. So the events and their
 * order are the same for every number of threads. Nothing is recorded if the caller asked for no trace. */
#ifndef SUNDER_I_TRACE_H
#define SUNDER_I_TRACE_H

#include "displacement/layer/model.h"

/* What one stage did. The strings are constants. */
typedef struct sunder_i_trace_step {
    const char *table; /* the table that has the stage (stage_table.h); NULL: none has */
    const char *step, *outcome;
    double before, after; /* costs before and after; NAN: not measured */
} sunder_i_trace_step;

/* The steps of one cluster or group. Zeroed: none. */
typedef struct sunder_i_trace_log {
    sunder_i_trace_step *step;
    size_t n, capacity;
} sunder_i_trace_log;

/* Did the caller ask for a trace? */
static inline bool sunder_i_is_traced(const sunder_i_model *model) { return model->rules.trace != NULL; }

/* Appends a step. Returns false if memory is out. */
bool sunder_i_trace_note(sunder_i_trace_log *log, const sunder_i_trace_step *step);
void sunder_i_trace_log_free(sunder_i_trace_log *log);

/* Returns the sum of weight times squared move over n bodies. The move of body[k] is at move + 2 * k; if `move` is
 * NULL, it is that in the model. */
double sunder_i_trace_cost(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move);

/* Passes one event for each step of a log to the caller, and empties the log. body: the n bodies that the events are
 * about. */
sunder_status sunder_i_trace_log_emit(const sunder_i_model *model, const char *scope, sunder_i_trace_log *log,
                                      const uint32_t *body, size_t n, sunder_error *err);
/* Passes one event about the n bodies to the caller, if there is a trace. */
sunder_status sunder_i_trace_emit(const sunder_i_model *model, const char *scope, const sunder_i_trace_step *step,
                                  const uint32_t *body, size_t n, sunder_error *err);
/* Passes an event about the things a and b to the caller. */
void sunder_i_trace_pair(const sunder_i_model *model, const char *step, const char *outcome, uint32_t a, uint32_t b);
/* Returns the present cost of the whole layer; 0 if there is no trace. */
double sunder_i_trace_layer_cost(const sunder_i_model *model);
/* Passes an event about the whole layer to the caller, with its present cost in place of step->after. */
void sunder_i_trace_layer(const sunder_i_model *model, const sunder_i_trace_step *step);

#endif
