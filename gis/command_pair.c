/* command_pair.c: sunder pair. The least translation of Q that takes its interior off P, as JSON, or as a layer
 * `pair`: the line from the anchor of Q to where it goes. */
#include "commands.h"
#include "message.h"
#include "report.h"

static void json_pair(gis_json *out, const sunder_separation *answer)
{
    gis_json_open(out, '{');
    gis_json_key(out, "command");
    gis_json_string(out, "pair");
    gis_json_key(out, "overlap");
    gis_json_bool(out, answer->overlap);
    gis_json_key(out, "dx");
    gis_json_string(out, answer->dx_text);
    gis_json_key(out, "dy");
    gis_json_string(out, answer->dy_text);
    gis_json_key(out, "distance_squared");
    gis_json_string(out, answer->distance_squared_text);
    gis_json_key(out, "distance");
    gis_json_double(out, answer->distance);
    gis_json_key(out, "contact");
    gis_json_string(out, sunder_contact_string(answer->contact));
    gis_json_key(out, "attained");
    gis_json_bool(out, answer->attained);
    gis_json_key(out, "rounded_is_free");
    gis_json_bool(out, answer->rounded_is_free);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

static bool print_pair(const sunder_separation *answer, const char *path, const char *what, gis_error *error)
{
    gis_json out = {0};
    json_pair(&out, answer);
    bool ok = (gis_json_text(&out) || gis_no_memory(error)) &&
              gis_write_text(path, gis_json_text(&out), out.length, what, error);
    gis_json_clear(&out);
    return ok;
}

static bool add_translation(gis_sink *sink, const gis_operands *operands, const sunder_separation *answer,
                            gis_error *error)
{
    static const gis_field fields[] = {{"overlap", OFTInteger64, 0},  {"dx", OFTReal, 0},
                                       {"dy", OFTReal, 0},            {"len", OFTReal, 0},
                                       {"contact", OFTString, 20},    {"attained", OFTInteger64, 0},
                                       {"free", OFTInteger64, 0}};
    const gis_layer_request request = {.suffix = "", .type = wkbLineString, .crs = operands->crs, .fields = fields,
                                       .n_fields = sizeof fields / sizeof *fields, .style = GIS_STYLE_DISPLACEMENT};
    const gis_value values[] = {
        {GIS_INTEGER, {.integer = answer->overlap}},
        {GIS_REAL, {.real = answer->dx}},
        {GIS_REAL, {.real = answer->dy}},
        {GIS_REAL, {.real = answer->distance}},
        {GIS_TEXT, {.text = sunder_contact_string(answer->contact)}},
        {GIS_INTEGER, {.integer = answer->attained}},
        {GIS_INTEGER, {.integer = answer->rounded_is_free}},
    };
    double from[2];
    sunder_shape_anchor(operands->q, from);
    const double to[2] = {from[0] + answer->dx, from[1] + answer->dy};
    OGRGeometryH line = gis_geometry_line(from, to);
    gis_sink_layer *layer;
    if (!line)
        return gis_no_memory(error);
    if (!gis_sink_add(sink, &request, &layer, error)) {
        OGR_G_DestroyGeometry(line);
        return false;
    }
    return gis_sink_write(layer, NULL, line, values, error);
}

static bool write_pair(const gis_options *options, const gis_operands *operands, const sunder_separation *answer,
                       gis_error *error)
{
    gis_sink_request request = gis_options_sink(options, options->operand[2], "pair");
    gis_sink *sink;
    gis_sink_result result;
    if (!gis_operands_spare(operands, options, options->operand[2], error) ||
        !gis_sink_open(&request, gis_operands_source(operands), &sink, error))
        return false;
    bool ok = add_translation(sink, operands, answer, error) && gis_output_finish(sink, &result, error);
    gis_sink_free(sink);
    return ok;
}

int gis_command_pair(const gis_options *options)
{
    gis_error error;
    gis_operands operands = {0};
    sunder_separation answer = {0};
    sunder_error why;
    double gap = 0;
    const char *stats = gis_stats_path(options), *output = options->operand[2];
    bool taken, ok = gis_stdout_taken(options, output, &taken, &error) && gis_stats_check(options, &error) &&
                     gis_operands_read(options, &operands, &error);
    if (ok && options->given[OPT_GAP])
        ok = gis_length_in_layer_units(&options->length[OPT_GAP], &operands.rule, "--gap", &gap, &error);
    if (ok && sunder_pair_separate(operands.p, operands.q, gap, &answer, &why) != SUNDER_OK)
        ok = gis_fail(&error, "%s", why.message);
    if (ok && output)
        ok = write_pair(options, &operands, &answer, &error);
    if (ok && stats)
        ok = print_pair(&answer, stats, "--stats", &error);
    if (ok && !output && !taken)
        ok = print_pair(&answer, "-", "the translation", &error);
    sunder_separation_clear(&answer);
    gis_operands_clear(&operands);
    return ok ? GIS_DONE : gis_say_failure(&error);
}
