/* planned.h: a plan as the options of the command separate. */
#ifndef GIS_PLANNED_H
#define GIS_PLANNED_H

#include "options/options.h"
#include "shards/plan/plan.h"
#include "sheet/sheet.h"

/* A zeroed struct is empty. */
typedef struct gis_planned {
    gis_plan plan;
    gis_options options; /* the options of separate, parsed from `word` */
    gis_sheet sheet;     /* with the gaps by classes of the plan, which `options` borrows */
    char **word;         /* [words] the arguments that `options` was parsed from; owned */
    size_t words;
} gis_planned;

/* Stores the options of the command `plan` as arguments in the plan: each option in its long spelling, with absolute
 * paths; and the gaps by classes. */
bool gis_planned_arguments(const gis_options *options, gis_plan *plan, gis_error *error);
/* Parses the arguments of the plan as a call of separate that writes `output`. Options of the group GIS_GROUP_RUNNING
 * in `now` take precedence over those of the plan. */
bool gis_planned_parse(gis_planned *planned, const gis_options *now, const char *output, gis_error *error);
/* Reads the plan in `directory` and parses it with gis_planned_parse(). */
bool gis_planned_open(const char *directory, const gis_options *now, const char *output, gis_planned *planned,
                      gis_error *error);
void gis_planned_clear(gis_planned *planned);

/* Sets the rules that follow from --layers and --symbol. The plan, each shard and the merge call it, so that all have
 * the same rules. */
bool gis_planned_rules(const gis_options *options, gis_layer_rules *rules, gis_error *error);

#endif
