/* command_pair.c: sunder pair. The least translation of Q that takes its interior off P, as JSON, or Q moved as a layer. */
#include "commands.h"
#include "message.h"
#include "report.h"
#include "sum_layers.h"

#include <string.h>

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

int gis_command_pair(const gis_options *options)
{
    gis_error error;
    gis_operands operands = {0};
    sunder_separation answer = {0};
    sunder_error why;
    double gap = 0;
    const char *stats = gis_stats_path(options), *output = options->operand[2];
    bool taken, ok = gis_stdout_taken(options, output, &taken, &error) && gis_operands_read(options, &operands, &error);
    if (ok && options->given[OPT_GAP])
        ok = gis_length_in_layer_units(&options->length[OPT_GAP], &operands.rule, "--gap", &gap, &error);
    if (ok && sunder_pair_separate(operands.p, operands.q, gap, &answer, &why) != SUNDER_OK)
        ok = gis_fail(&error, "%s", why.message);
    if (ok && output)
        ok = gis_write_pair(options, &operands, &answer, &error);
    if (ok && stats)
        ok = print_pair(&answer, stats, "--stats", &error);
    if (ok && !output && !taken)
        ok = print_pair(&answer, "-", "the translation", &error);
    sunder_separation_clear(&answer);
    gis_operands_clear(&operands);
    return ok ? GIS_DONE : gis_say_failure(&error);
}
