/* call.h: lists the options that a command was given, as text, for reports and for plans. */
#ifndef GIS_CALL_H
#define GIS_CALL_H

#include "options/options.h"
#include "page/page.h"

/* The given options, in the order of gis_option_table; an option with a list of values has an entry for each value.
 * Start zeroed; clear on failure, too. */
typedef struct gis_call {
    gis_page_option *option;
    size_t n, capacity;
} gis_call;

/* Appends the given options for which wanted() returns true. */
bool gis_call_list_of(const gis_options *options, bool (*wanted)(const gis_option *), gis_call *call, gis_error *error);
/* Appends all given options except those of the group GIS_GROUP_RUNNING, which change no result. */
bool gis_call_list(const gis_options *options, gis_call *call, gis_error *error);
void gis_call_clear(gis_call *call);

#endif
