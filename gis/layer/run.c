/* run.c: a layer handed to the core, by the rules. That a number is out of range the core says; whoever gave it as an
 * option has called the program wrongly. */
#include "layer/input.h"

static const double thin_metres = 0.01;

double gis_layer_thin(const gis_layer_input *input)
{
    if (!input->request->rules.count_thin || input->units.geographic) return 0;
    double thin = input->units.has_crs ? thin_metres / input->units.unit_metres : thin_metres;
    return input->gap == 0 || thin < input->gap ? thin : 0;
}

/* Symbols join by touch where a tolerance is asked for, and not else: they are meant to be told apart. */
static sunder_layer_options core_options(const gis_layer_input *input)
{
    const gis_layer_rules *rules = &input->request->rules;
    sunder_layer_options core;
    sunder_layer_options_init(&core);
    core.gap = input->gap;
    core.touch_tolerance = input->tolerance;
    core.no_blocks = rules->no_blocks;
    core.no_touch = input->points && !rules->touch_tolerance.text;
    core.thin = gis_layer_thin(input);
    core.list_inside = rules->list_inside;
    core.contained = rules->contained;
    core.threads = rules->threads;
    core.allow_jumps = input->points || rules->allow_jumps;
    return core;
}

bool gis_layer_run(const gis_layer_input *input, gis_layer_work *work, gis_progress *progress, sunder_report **report,
                   sunder_layer_summary *summary, gis_error *error)
{
    sunder_layer_options how = core_options(input);
    sunder_error why;
    how.progress = gis_progress_call;
    how.progress_user = progress;
    sunder_status status = work(input->layer, &how, report, &why);
    if (status == SUNDER_EARG) return gis_fail_usage(error, "%s", why.message);
    if (status != SUNDER_OK) return gis_fail(error, "layer %s: %s", gis_source_name(input->source), why.message);
    sunder_report_summary(*report, summary);
    return true;
}
