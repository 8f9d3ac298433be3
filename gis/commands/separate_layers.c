/* separate_layers.c: chooses the layers that separate writes, by --layers and by what the output supports, and writes
 * them and reads them back. */
#include "base/resources.h"
#include "commands/progress_shares.h"
#include "commands/resolve.h"
#include "commands/separate_run.h"

#include <string.h>

bool gis_separate_choose_layers(const char *list, const gis_layer_rules *rules, bool points, unsigned *chosen,
                                gis_error *error)
{
    static const char *const names[GIS_SEPARATE_LAYERS] = {"main", "displacement", "conflicts", "pushes",
                                                           "rows", "symbols",      "hidden"};
    const unsigned apply = GIS_SEPARATE_MAIN | GIS_SEPARATE_DISPLACEMENT | GIS_SEPARATE_CONFLICTS |
                           GIS_SEPARATE_PUSHES | (rules->core.rows ? GIS_SEPARATE_ROWS : 0u) |
                           (points ? GIS_SEPARATE_SYMBOLS : 0u) | (rules->hide ? GIS_SEPARATE_HIDDEN : 0u);
    *chosen = list ? 0 : apply;
    for (const char *rest = list; rest;) {
        size_t n = strcspn(rest, ","), k = 0;
        while (k < GIS_SEPARATE_LAYERS && (strlen(names[k]) != n || memcmp(names[k], rest, n) != 0)) k++;
        if (k == GIS_SEPARATE_LAYERS)
            return gis_fail_usage(
                error, "--layers: %.*s is none of main, displacement, conflicts, pushes, rows, symbols, hidden", (int)n,
                rest);
        *chosen |= 1u << k;
        rest = rest[n] ? rest + n + 1 : NULL;
    }
    *chosen &= apply;
    return *chosen || gis_fail_usage(error, "--layers %s: none of these applies to this input", list);
}

/* Names the main layer of each layer that moves, if there are several, and of each that goes along. */
static bool name_mains(gis_separate_run *run, gis_sink_request *request, gis_error *error)
{
    const gis_layer_input *input = &run->input;
    const size_t along = run->chosen & GIS_SEPARATE_MAIN ? run->along.n : 0;
    if (!input->parts && !along) return true;
    free(run->more);
    run->more = malloc((input->parts + along) * sizeof *run->more);
    if (!run->more) return gis_no_memory(error);
    for (size_t k = 1; k < input->parts; k++)
        run->more[request->n_more++] = (gis_sink_main){input->part[k].source, gis_layer_name(&input->part[k])};
    for (size_t k = 0; k < along; k++)
        run->more[request->n_more++] =
            (gis_sink_main){run->along.follow[k].input, gis_follow_name(&run->along.follow[k])};
    request->more = run->more;
    if (!input->parts) return true;
    request->main_layer = gis_layer_name(&input->part[0]);
    request->prefix = run->options->sheet_name;
    return true;
}

/* Is any of the layers a layer of points? */
static bool any_points(const gis_layer_input *input)
{
    bool any = input->points;
    for (size_t k = 0; k < input->parts; k++) any = any || input->part[k].points;
    return any;
}

/* With --update the sink keeps features for comparison, which packed ones are not. */
static bool unpack(const gis_layer_input *input, gis_error *error)
{
    if (!input->parts) return gis_source_unpack(input->source, error);
    for (size_t k = 0; k < input->parts; k++)
        if (!gis_source_unpack(input->part[k].source, error)) return false;
    return true;
}

bool gis_separate_open_sink(gis_separate_run *run, gis_error *error)
{
    size_t n = 0;
    const bool points = any_points(&run->input);
    if (!gis_separate_choose_layers(run->options->text[OPT_LAYERS], &run->request.rules, points, &run->chosen, error))
        return false;
    if (run->chosen & GIS_SEPARATE_DISPLACEMENT) run->suffixes[n++] = "displacement";
    if (run->chosen & GIS_SEPARATE_CONFLICTS) run->suffixes[n++] = "conflicts";
    if (run->chosen & GIS_SEPARATE_PUSHES) run->suffixes[n++] = "pushes";
    if (run->chosen & GIS_SEPARATE_ROWS) run->suffixes[n++] = "rows";
    /* Symbols of layers that move together have the names of these layers. */
    if (run->chosen & GIS_SEPARATE_SYMBOLS && !run->input.parts) run->suffixes[n++] = "symbols";
    if (run->chosen & GIS_SEPARATE_HIDDEN) run->suffixes[n++] = "hidden";
    gis_sink_request request = gis_resolve_sink(run->options, run->to.output, gis_layer_title(&run->input));
    if (!name_mains(run, &request, error)) return false;
    request.suffixes = run->suffixes;
    request.features = (run->chosen & GIS_SEPARATE_MAIN) != 0;
    request.polygons = run->chosen & (points ? GIS_SEPARATE_SYMBOLS : GIS_SEPARATE_MAIN);
    request.scratch = run->scratch;
    if (!gis_sink_open(&request, run->input.source, &run->sink, error)) return false;
    if (gis_sink_remembers(run->sink) && run->source_held && !unpack(&run->input, error)) return false;
    if (!gis_sink_takes_more(run->sink)) run->chosen = GIS_SEPARATE_MAIN;
    if (!run->to.proof) gis_layer_forget_demands(&run->input);
    run->request.rules.core.keep_pushes = (run->chosen & GIS_SEPARATE_PUSHES) != 0;
    return true;
}

bool gis_separate_write_layers(gis_separate_run *run, gis_error *error)
{
    gis_result_layers layers = {(run->chosen & GIS_SEPARATE_MAIN) != 0,
                                (run->chosen & GIS_SEPARATE_DISPLACEMENT) != 0,
                                (run->chosen & GIS_SEPARATE_CONFLICTS) != 0,
                                (run->chosen & GIS_SEPARATE_PUSHES) != 0,
                                (run->chosen & GIS_SEPARATE_ROWS) != 0,
                                (run->chosen & GIS_SEPARATE_SYMBOLS) != 0,
                                (run->chosen & GIS_SEPARATE_HIDDEN) != 0,
                                NULL,
                                NULL};
    gis_sink_result written;
    gis_progress_stage(&run->progress, GIS_SEPARATE_DONE, 1);
    const double begin = gis_clock();
    gis_separate_watch(run, &layers);
    if (!gis_result_write(&run->result, &layers, run->sink, error) || !gis_separate_write_along(run, error) ||
        !gis_sink_finish(run->sink, &written, error))
        return false;
    run->write = gis_clock() - begin;
    run->verified = run->summary.verified && written.exact;
    gis_progress_done(&run->progress);
    return true;
}
