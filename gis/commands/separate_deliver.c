/* separate_deliver.c: delivers the results of a separation: the output, --stats, --report, --proof, --trace and the
 * summary. Either all of them are put in place, or none. */
#include "commands/call.h"
#include "commands/command_stats.h"
#include "commands/resolve.h"
#include "commands/separate_run.h"

bool gis_separate_is_summarised(const gis_separate_run *run) { return !run->taken && !run->options->given[OPT_QUIET]; }

static bool write_page(const gis_separate_run *run, gis_text *page, gis_error *error)
{
    gis_call call = {0};
    gis_result_view view = {0};
    gis_hiding hiding = {0};
    if (run->request.rules.hide) run->result.kind->hiding(&run->result, &hiding);
    bool ok = gis_call_list(run->options, &call, error) && run->result.kind->view(&run->result, &view, error);
    const gis_page_request request = {
        .input = &run->input,
        .view = &view,
        .hiding = run->request.rules.hide ? &hiding : NULL,
        .summary = &run->summary,
        .unit = gis_separate_unit(run),
        .output = run->to.output,
        .main_layer = gis_resolve_sink(run->options, NULL, gis_layer_title(&run->input)).main_layer,
        .verified = run->verified,
        .optimality_gap = gis_separate_optimality_gap(&run->summary),
        .losses = gis_sink_losses(run->sink),
        .options = call.option,
        .n_options = call.n,
        .seconds_read = run->read,
        .seconds_write = run->write,
    };
    ok = ok && gis_page_write(&request, page, error);
    if (view.close) view.close(view.of);
    gis_call_clear(&call);
    return ok;
}

static bool write_proof(const void *of, FILE *to, gis_error *error)
{
    const gis_separate_run *run = of;
    return run->result.kind->proof(&run->result, &run->summary, to, error);
}

bool gis_separate_deliver(const gis_separate_run *run, gis_error *error)
{
    gis_json stats = {0};
    gis_text page = {0};
    bool ok = !run->to.report || write_page(run, &page, error);
    if (run->to.stats) gis_separate_stats(&stats, run);
    const gis_delivery delivery = {.to = &run->to,
                                   .sink = run->sink,
                                   .stats = &stats,
                                   .report = &page,
                                   .trace = &run->trace.json.text,
                                   .proof = write_proof,
                                   .print = gis_separate_is_summarised(run) ? gis_separate_print : NULL,
                                   .run = run};
    ok = ok && gis_deliver(&delivery, error);
    gis_json_clear(&stats);
    gis_text_clear(&page);
    return ok;
}
