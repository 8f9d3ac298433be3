/* command_stats.c: see command_stats.h. Scripts may rely on the JSON keys. */
#include "commands/command_stats.h"

#include "base/exit_status.h"

#include <math.h>
#include <stdio.h>

void gis_json_seconds(gis_json *out, const char *key, double seconds)
{
    gis_json_put_double(out, key, round(seconds * 1e9) / 1e9);
}

void gis_json_operations(gis_json *out, const sunder_counts *counts)
{
    gis_json_put_size(out, "comparisons", counts->comparisons);
    gis_json_put_size(out, "orientation_tests", counts->orientation_tests);
    gis_json_put_size(out, "segment_intersections", counts->segment_intersections);
    gis_json_put_size(out, "exact_fallbacks", counts->exact_fallbacks);
}

void gis_json_conflict_counts(gis_json *out, const sunder_conflict_counts *counts)
{
    gis_json_open(out, '{');
    const struct {
        sunder_conflict_kind kind;
        size_t n;
    } kinds[] = {
        {SUNDER_CONFLICT_OVERLAP, counts->overlap},           {SUNDER_CONFLICT_TOO_CLOSE, counts->too_close},
        {SUNDER_CONFLICT_BARRIER, counts->barrier},           {SUNDER_CONFLICT_BARRIER_DRAWN, counts->barrier_drawn},
        {SUNDER_CONFLICT_BARRIER_NEAR, counts->barrier_near}, {SUNDER_CONFLICT_CONTAINED, counts->contained},
        {SUNDER_CONFLICT_DUPLICATE, counts->duplicate}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        gis_json_put_size(out, sunder_conflict_kind_string(kinds[k].kind), kinds[k].n);
    gis_json_put_size(out, "inside_blocks", counts->inside_blocks);
    gis_json_close(out, '}');
}

void gis_json_sheet(gis_json *out, const gis_options *options)
{
    if (!options->sheet) return;
    gis_json_key(out, "spec");
    gis_json_raw(out, options->sheet);
}

void gis_json_follow(gis_json *out, const gis_follow *follow)
{
    gis_json_put_size(out, "features", gis_source_count(follow->input));
    for (gis_follow_status s = 0; s < GIS_FOLLOW_STATUSES; s++)
        gis_json_put_size(out, gis_follow_status_string(s), follow->count[s]);
    gis_json_put_size(out, "torn", follow->torn);
}

void gis_print_follow(const gis_follow *follow)
{
    printf("%s: %zu features", gis_follow_name(follow), gis_source_count(follow->input));
    for (gis_follow_status s = 0; s < GIS_FOLLOW_STATUSES; s++)
        printf("%s %s %zu", s ? "," : ":", gis_follow_status_string(s), follow->count[s]);
    printf("\n");
    if (follow->torn)
        printf("%zu vertices that features of %s shared are at several places now\n", follow->torn,
               gis_follow_name(follow));
}

bool gis_any_conflict(const sunder_conflict_counts *counts)
{
    return counts->overlap || counts->too_close || counts->barrier || counts->barrier_drawn || counts->barrier_near ||
           counts->contained || counts->duplicate;
}

int gis_complete_status(const gis_options *options, bool unresolved)
{
    return unresolved && !options->given[OPT_ALLOW_CONFLICTS] ? GIS_UNRESOLVED : GIS_DONE;
}
