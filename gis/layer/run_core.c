/* run_core.c: calls the core by the rules. The core rejects numbers out of range; for numbers given as options that is
 * wrong usage. */
#include "base/resources.h"
#include "layer/trace_file.h"

static const double thin_metres = 0.01;

double gis_layer_thin(const gis_layer_input *input)
{
    if (!input->request->rules.count_thin || input->units.geographic) return 0;
    double thin = input->units.has_crs ? thin_metres / input->units.unit_metres : thin_metres;
    return input->gap == 0 || thin < input->gap ? thin : 0;
}

/* A tenth of a millimetre on the sheet is the least kink that an eye sees. */
double gis_layer_kink(const gis_layer_input *input)
{
    const gis_length least = {0.1, GIS_SHEET_MILLIMETRE};
    gis_error error;
    double kink;
    if (input->units.scale > 0 && gis_length_in_layer_units(&least, &input->units, "", &kink, &error)) return kink;
    return input->gap / 10;
}

/* The core's gaps are the greatest ones of any two classes; the default tolerance is that of the gap. */
static void take_class_gaps(const gis_layer_input *input, sunder_layer_options *core)
{
    const gis_class_tables *tables = &input->class_tables;
    core->gap = tables->most;
    core->full_gap = tables->slack ? tables->most_full : 0;
    if (core->touch_tolerance < 0) core->touch_tolerance = fmin(input->gap, tables->most_full) / 10;
}

/* Symbols join blocks by touching only if a tolerance is given, since symbols should stay distinct. */
sunder_layer_options gis_layer_core_options(const gis_layer_input *input)
{
    const gis_layer_rules *rules = &input->request->rules;
    sunder_layer_options core = rules->core;
    core.gap = rules->least_gap.text ? input->least_gap : input->gap;
    core.full_gap = rules->least_gap.text ? input->gap : 0;
    core.touch_tolerance = input->tolerance;
    if (rules->classes) take_class_gaps(input, &core);
    core.no_touch = input->points && !rules->touch_tolerance.text;
    core.thin = gis_layer_thin(input);
    core.no_blocks = core.no_blocks || input->blocks_given;
    core.drop_proofs = !core.keep_trees;
    core.barrier_reach = input->barrier_reach;
    core.kink = gis_layer_kink(input);
    core.allow_jumps = input->points || core.allow_jumps;
    return core;
}

/* Passes progress on. */
typedef struct watcher {
    gis_progress *progress;
    double next; /* the fraction at which memory is returned to the system next */
} watcher;

/* After each such fraction of the work, freed memory is returned to the system, so that the next stage does not add to
 * it. */
#define STRETCH 0.2

static bool go_on(double fraction, void *user)
{
    watcher *w = user;
    if (fraction >= w->next) {
        gis_memory_back();
        w->next = fraction + STRETCH;
    }
    return gis_progress_call(fraction, w->progress);
}

static sunder_layer_options watched_options(const gis_layer_input *input, watcher *w)
{
    sunder_layer_options how = gis_layer_core_options(input);
    how.progress = go_on;
    how.progress_user = w;
    return how;
}

/* number: NULL, or the index in `input` of each feature that the core knows. */
static bool check_status(const gis_layer_input *input, const size_t *number, sunder_status status,
                         const sunder_error *why, gis_error *error)
{
    char who[GIS_WHO_SIZE];
    if (status == SUNDER_EARG) return gis_fail_usage(error, "%s", why->message);
    if (status == SUNDER_EINVALID && why->polygon != SIZE_MAX) { /* a feature is in two rows */
        gis_feature_name(input, number ? number[why->polygon] : why->polygon, who, sizeof who);
        return gis_fail(error, "%s: --rows: %s", who, why->message);
    }
    if (status != SUNDER_OK) return gis_fail(error, "layer %s: %s", gis_source_name(input->source), why->message);
    return true;
}

bool gis_layer_run(const gis_layer_input *input, gis_layer_work *work, gis_progress *progress, gis_trace *trace,
                   sunder_report **report, sunder_layer_summary *summary, gis_error *error)
{
    watcher w = {progress, STRETCH};
    sunder_layer_options how = watched_options(input, &w);
    how.trace = trace ? gis_trace_event : NULL;
    how.trace_user = trace;
    sunder_error why;
    if (!check_status(input, NULL, work(input->layer, &how, report, &why), &why, error)) return false;
    sunder_report_summary(*report, summary);
    return true;
}

bool gis_layer_run_moves(const gis_layer_input *input, const sunder_layer *before, const sunder_layer *after,
                         const size_t *number, gis_progress *progress, sunder_report **report, gis_error *error)
{
    watcher w = {progress, STRETCH};
    sunder_layer_options how = watched_options(input, &w);
    sunder_error why;
    return check_status(input, number, sunder_layer_check_moves(before, after, &how, report, &why), &why, error);
}
