/* trace_file.c: see trace_file.h. */
#include "layer/trace_file.h"

#include "layer/output.h"

#include <math.h>

static void put_features(gis_json *json, const gis_layer_input *input, const sunder_trace_event *event)
{
    gis_json_key(json, "features");
    gis_json_open(json, '[');
    for (size_t k = 0; k < event->things && event->thing[k] < input->n; k++) {
        const size_t feature = event->thing[k];
        const bool unique = !input->parts && gis_source_fids_unique(input->source);
        gis_json_signed(json, unique ? gis_source_fid(input->source, feature) : (int64_t)feature);
    }
    gis_json_close(json, ']');
}

/* Writes layer and FID of each barrier of the event; nothing if there is none. */
static void put_barriers(gis_json *json, const gis_layer_input *input, const sunder_trace_event *event)
{
    if (event->things == 0 || event->thing[event->things - 1] < input->n) return;
    gis_json_key(json, "barriers");
    gis_json_open(json, '[');
    for (size_t k = 0; k < event->things; k++) {
        if (event->thing[k] < input->n) continue;
        const gis_barrier_feature *barrier = gis_barrier_of(input, event->thing[k]);
        gis_json_open(json, '[');
        gis_json_string(json, gis_barrier_layer(input, barrier));
        gis_json_signed(json, barrier->fid);
        gis_json_close(json, ']');
    }
    gis_json_close(json, ']');
}

static void put_word(gis_json *json, const char *key, const char *word)
{
    if (word) gis_json_put_string(json, key, word);
}

static void put_cost(gis_json *json, const char *key, double cost)
{
    if (!isnan(cost)) gis_json_put_double(json, key, cost);
}

void gis_trace_event(const sunder_trace_event *event, void *user)
{
    gis_trace *trace = user;
    gis_json *json = &trace->json;
    gis_json_open(json, '{');
    put_word(json, "pass", event->pass);
    put_word(json, "stage", event->stage);
    if (event->round) gis_json_put_size(json, "round", (size_t)event->round);
    gis_json_put_string(json, "scope", event->scope);
    put_word(json, "table", event->table);
    put_word(json, "step", event->step);
    gis_json_put_string(json, "outcome", event->outcome);
    if (event->things) put_features(json, trace->input, event);
    put_barriers(json, trace->input, event);
    put_cost(json, "cost_before", event->cost_before);
    put_cost(json, "cost_after", event->cost_after);
    gis_json_close(json, '}');
    gis_text_add(&json->text, "\n");
    json->need_comma = false;
}

void gis_trace_clear(gis_trace *trace) { gis_json_clear(&trace->json); }
