/* planned.h: what a plan asks for, as a call of separate. */
#ifndef GIS_PLANNED_H
#define GIS_PLANNED_H

#include "options/options.h"
#include "shards/plan/plan.h"

/* Zeroed: nothing. */
typedef struct gis_planned {
    gis_plan plan;
    gis_options options; /* of separate */
    char **word;         /* [words] what these were parsed from; owned */
    size_t words;
} gis_planned;

/* The arguments of a plan: what options of `plan` say, in one spelling, with paths that hold from anywhere. */
bool gis_planned_arguments(const gis_options *options, gis_plan *plan, gis_error *error);
/* Parses the plan's arguments, as a call that writes `output`. Options of the section "Running" that are given now win
 * over those of the plan. */
bool gis_planned_parse(gis_planned *planned, const gis_options *now, const char *output, gis_error *error);
/* Reads the plan in a directory, and does that. */
bool gis_planned_open(const char *directory, const gis_options *now, const char *output, gis_planned *planned,
                      gis_error *error);
void gis_planned_clear(gis_planned *planned);

/* What shards are asked for besides what their options say: the same by the plan, each shard and the merge. */
bool gis_planned_rules(const gis_options *options, gis_layer_rules *rules, gis_error *error);

#endif
