/* result_held.h: the result of a layer that is held in memory. */
#ifndef GIS_RESULT_HELD_H
#define GIS_RESULT_HELD_H

#include "layer/result.h"

/* The result of a layer that was read whole, from its report. */
gis_result gis_result_held(const gis_layer_input *input, sunder_report *report);

/* result_view_held.c */
bool gis_result_held_view(const gis_result *result, gis_result_view *out, gis_error *error);

#endif
