/* Events of the work on a layer, for developers (sunder_trace in sunder.h).
 *
 * A stage of a cluster or a group notes what it did in the log of that cluster or group, on any thread. The thread that
 * drives the rounds hands the logs on, in the order of clusters and groups. So the events and their order are the same
 * for every number of threads. Nothing is noted where the caller asked for no trace. */
#ifndef SUNDER_I_TRACE_H
#define SUNDER_I_TRACE_H

#include "displacement/layer/model.h"

/* What one stage did. Names and outcomes are constants. */
typedef struct sunder_i_trace_step {
    const char *step, *outcome;
    double before, after; /* costs; NAN: not measured */
} sunder_i_trace_step;

/* The steps of one cluster or group. Zeroed: none. */
typedef struct sunder_i_trace_log {
    sunder_i_trace_step *step;
    size_t n, capacity;
} sunder_i_trace_log;

static inline bool sunder_i_is_traced(const sunder_i_model *model) { return model->rules.trace != NULL; }

/* Appends. False if memory is out. */
bool sunder_i_trace_note(sunder_i_trace_log *log, const sunder_i_trace_step *step);
void sunder_i_trace_log_free(sunder_i_trace_log *log);

/* The sum of the costs of moves of n bodies: move of body[k] is at move + 2 * k, or at 2 * body[k] where move is NULL,
 * in the model's. */
double sunder_i_trace_cost(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move);

/* Events, of all steps of a log, which is empty then, and of one step. body: [n] bodies that they are about. */
sunder_status sunder_i_trace_log_emit(const sunder_i_model *model, const char *scope, sunder_i_trace_log *log,
                                      const uint32_t *body, size_t n, sunder_error *err);
sunder_status sunder_i_trace_emit(const sunder_i_model *model, const char *scope, const sunder_i_trace_step *step,
                                  const uint32_t *body, size_t n, sunder_error *err);
/* Of a pair of things, and of the layer. */
void sunder_i_trace_pair(const sunder_i_model *model, const char *step, const char *outcome, uint32_t a, uint32_t b);
void sunder_i_trace_layer(const sunder_i_model *model, const char *outcome);

#endif
