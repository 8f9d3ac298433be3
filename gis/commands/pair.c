/* pair.c: the command sunder pair. It finds the shortest translation of Q that separates its interior from P, and
 * writes it as JSON, or as a layer `pair` with a line from the anchor of Q to its translated position. */
#include "base/core_error.h"
#include "base/message.h"
#include "commands/commands.h"
#include "commands/resolve.h"

#include <math.h>

static void json_pair(gis_json *out, const sunder_separation *answer)
{
    gis_json_open(out, '{');
    gis_json_put_string(out, "command", "pair");
    gis_json_put_bool(out, "overlap", answer->overlap);
    gis_json_put_string(out, "dx", answer->dx_text);
    gis_json_put_string(out, "dy", answer->dy_text);
    gis_json_put_string(out, "distance_squared", answer->distance_squared_text);
    gis_json_put_double(out, "distance", answer->distance);
    gis_json_put_string(out, "contact", sunder_contact_string(answer->contact));
    gis_json_put_bool(out, "attained", answer->attained);
    gis_json_put_bool(out, "rounded_is_free", answer->rounded_is_free);
    gis_json_close(out, '}');
    gis_json_raw(out, "\n");
}

static bool add_translation(gis_sink *sink, const gis_operands *operands, const sunder_separation *answer,
                            gis_error *error)
{
    static const gis_field fields[] = {{"overlap", OFTInteger64, 0}, {"dx", OFTReal, 0},
                                       {"dy", OFTReal, 0},           {"len", OFTReal, 0},
                                       {"contact", OFTString, 20},   {"attained", OFTInteger64, 0},
                                       {"free", OFTInteger64, 0}};
    const gis_sink_layer_request request = {.suffix = "",
                                            .type = wkbLineString,
                                            .crs = operands->crs,
                                            .fields = fields,
                                            .n_fields = sizeof fields / sizeof *fields,
                                            .style = GIS_STYLE_DISPLACEMENT};
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
    if (!isfinite(to[0]) || !isfinite(to[1]))
        return gis_fail(error, "the translation is beyond the range of doubles, so a layer cannot hold it; without "
                               "OUTPUT it is printed exactly");
    OGRGeometryH line = gis_geometry_line(from, to);
    gis_sink_layer *layer;
    if (!line) return gis_no_memory(error);
    if (!gis_sink_add(sink, &request, &layer, error)) {
        OGR_G_DestroyGeometry(line);
        return false;
    }
    return gis_sink_write(layer, NULL, line, values, error);
}

static bool open_sink(const gis_options *options, const gis_operands *operands, const char *output, gis_sink **sink,
                      gis_error *error)
{
    gis_sink_request request = gis_resolve_sink(options, output, "pair");
    return gis_operands_spare(operands, output, request.update, error) &&
           gis_sink_open(&request, gis_operands_source(operands), sink, error);
}

static bool deliver_pair(const gis_destinations *to, const gis_operands *operands, const sunder_separation *answer,
                         gis_sink *sink, bool taken, gis_error *error)
{
    gis_json text = {0};
    gis_sink_result result;
    json_pair(&text, answer);
    const gis_delivery delivery = {
        .to = to, .sink = sink, .stats = &text, .print = sink || taken ? NULL : gis_print_json, .run = &text};
    bool ok = (gis_json_text(&text) || gis_no_memory(error)) &&
              (!sink || (add_translation(sink, operands, answer, error) && gis_sink_finish(sink, &result, error))) &&
              gis_deliver(&delivery, error);
    gis_json_clear(&text);
    return ok;
}

int gis_command_pair(const gis_options *options)
{
    gis_error error;
    const gis_destinations to = gis_resolve_destinations(options);
    const gis_optional_length asked = gis_resolve_length(options, OPT_GAP);
    gis_operands_request request;
    gis_operands operands = {0};
    sunder_separation answer = {0};
    gis_sink *sink = NULL;
    sunder_error why;
    double gap = 0;
    bool taken, ok = gis_destinations_check(&to, &taken, &error) && gis_resolve_operands(options, &request, &error) &&
                     gis_operands_read(&request, &operands, &error) &&
                     gis_optional_length_in_layer_units(&asked, &operands.units, "--gap", &gap, &error);
    ok = ok && (!to.output || open_sink(options, &operands, to.output, &sink, &error));
    if (ok && sunder_pair_separate(operands.p, operands.q, gap, &answer, &why) != SUNDER_OK)
        ok = gis_core_failed(&error, NULL, &why);
    ok = ok && deliver_pair(&to, &operands, &answer, sink, taken, &error);
    gis_sink_free(sink);
    sunder_separation_clear(&answer);
    gis_operands_clear(&operands);
    return ok ? GIS_DONE : gis_say_failure(&error);
}
