/* command_stats.h: parts of the statistics that several commands print. */
#ifndef GIS_COMMAND_STATS_H
#define GIS_COMMAND_STATS_H

#include "base/json.h"
#include "follow/follow.h"
#include "options/options.h"
#include "sunder.h"

/* Adds a time in seconds, rounded to nanoseconds. */
void gis_json_seconds(gis_json *out, const char *key, double seconds);
void gis_json_operations(gis_json *out, const sunder_counts *counts);
void gis_json_conflict_counts(gis_json *out, const sunder_conflict_counts *counts);
/* Adds the sheet of --spec, with the other options in it, if there is one. */
void gis_json_sheet(gis_json *out, const gis_options *options);
/* Adds how many features of a layer went along, and prints it. */
void gis_json_follow(gis_json *out, const gis_follow *follow);
void gis_print_follow(const gis_follow *follow);

/* Returns whether there is any conflict, not counting those within blocks. */
bool gis_any_conflict(const sunder_conflict_counts *counts);
/* Returns the exit status of a complete run: GIS_UNRESOLVED if `unresolved` (the goal was missed) and
 * OPT_ALLOW_CONFLICTS is not given. */
int gis_complete_status(const gis_options *options, bool unresolved);

#endif
