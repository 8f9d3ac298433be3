/* call.h: lists the options that a command was given, as text for reports and for a plan. */
#ifndef GIS_CALL_H
#define GIS_CALL_H

#include "options/options.h"
#include "report/page.h"

/* The options that were given, in the order of the table; lists once a value. Start zeroed, clear in any case. */
typedef struct gis_call {
    gis_page_option *option;
    size_t n, capacity;
} gis_call;

/* All that are wanted. */
bool gis_call_list_of(const gis_options *options, bool (*wanted)(const gis_option *), gis_call *call, gis_error *error);
/* All but those of the section "Running", which change no result. */
bool gis_call_list(const gis_options *options, gis_call *call, gis_error *error);
void gis_call_clear(gis_call *call);

#endif
