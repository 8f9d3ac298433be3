/* commands.h: the functions that run the commands; each is in a file of its own. */
#ifndef GIS_COMMANDS_H
#define GIS_COMMANDS_H

#include "options/options.h"

int gis_command_separate(const gis_options *options);
int gis_command_check(const gis_options *options);
int gis_command_sum(const gis_options *options);
int gis_command_pair(const gis_options *options);
int gis_command_buffer(const gis_options *options);
int gis_command_route(const gis_options *options);
int gis_command_plan(const gis_options *options);
int gis_command_merge(const gis_options *options);
int gis_command_follow(const gis_options *options);
/* the command line separate --shard K PLAN */
int gis_command_shard(const gis_options *options);

#endif
