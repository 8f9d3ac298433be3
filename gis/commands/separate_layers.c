/* separate_layers.c: which layers separate writes: by --layers, and of those what the output takes. */
#include "commands/resolve.h"
#include "commands/separate_run.h"

#include "layer/output.h"

#include <string.h>

bool gis_separate_choose_layers(const char *list, bool points, unsigned *chosen, gis_error *error)
{
    static const char *const names[GIS_SEPARATE_LAYERS] = {"main", "displacement", "conflicts", "pushes", "symbols"};
    const unsigned apply = GIS_SEPARATE_MAIN | GIS_SEPARATE_DISPLACEMENT | GIS_SEPARATE_CONFLICTS |
                           GIS_SEPARATE_PUSHES | (points ? GIS_SEPARATE_SYMBOLS : 0u);
    *chosen = list ? 0 : apply;
    for (const char *rest = list; rest;) {
        size_t n = strcspn(rest, ","), k = 0;
        while (k < GIS_SEPARATE_LAYERS && (strlen(names[k]) != n || memcmp(names[k], rest, n) != 0)) k++;
        if (k == GIS_SEPARATE_LAYERS)
            return gis_fail_usage(error, "--layers: %.*s is none of main, displacement, conflicts, pushes, symbols",
                                  (int)n, rest);
        *chosen |= 1u << k;
        rest = rest[n] ? rest + n + 1 : NULL;
    }
    *chosen &= apply;
    return *chosen || gis_fail_usage(error, "--layers %s: nothing of that applies to this layer", list);
}

bool gis_separate_open_sink(gis_separate_run *run, gis_error *error)
{
    size_t n = 0;
    if (!gis_separate_choose_layers(run->options->text[OPT_LAYERS], run->input.points, &run->chosen, error))
        return false;
    if (run->chosen & GIS_SEPARATE_DISPLACEMENT) run->suffixes[n++] = "displacement";
    if (run->chosen & GIS_SEPARATE_CONFLICTS) run->suffixes[n++] = "conflicts";
    if (run->chosen & GIS_SEPARATE_PUSHES) run->suffixes[n++] = "pushes";
    if (run->chosen & GIS_SEPARATE_SYMBOLS) run->suffixes[n++] = "symbols";
    gis_sink_request request = gis_resolve_sink(run->options, run->to.output, gis_source_name(run->input.source));
    request.suffixes = run->suffixes;
    request.features = (run->chosen & GIS_SEPARATE_MAIN) != 0;
    request.polygons = run->chosen & (run->input.points ? GIS_SEPARATE_SYMBOLS : GIS_SEPARATE_MAIN);
    if (run->in_parts && !(request.scratch = gis_shard_run_scratch(&run->parts, error))) return false;
    if (!gis_sink_open(&request, run->input.source, &run->sink, error)) return false;
    if (gis_sink_remembers(run->sink) && (!run->in_parts || run->whole) && !gis_source_unpack(run->input.source, error))
        return false;
    if (!gis_sink_takes_more(run->sink)) run->chosen = GIS_SEPARATE_MAIN;
    if (!run->to.proof) gis_layer_forget_demands(&run->input);
    run->request.rules.core.keep_pushes = (run->chosen & GIS_SEPARATE_PUSHES) != 0;
    return true;
}

bool gis_separate_write_layers(const gis_separate_run *run, gis_error *error)
{
    unsigned chosen = run->chosen;
    gis_sink *sink = run->sink;
    const gis_layer_input *input = &run->input;
    if ((chosen & GIS_SEPARATE_MAIN) && !gis_write_main(sink, input, run->report, error)) return false;
    if ((chosen & GIS_SEPARATE_DISPLACEMENT) && !gis_write_displacement(sink, input, run->report, error)) return false;
    if ((chosen & GIS_SEPARATE_CONFLICTS) && !gis_write_conflicts(sink, input, run->report, error)) return false;
    if ((chosen & GIS_SEPARATE_PUSHES) && !gis_write_pushes(sink, input, run->report, error)) return false;
    return !(chosen & GIS_SEPARATE_SYMBOLS) || gis_write_symbols(sink, input, run->report, error);
}
