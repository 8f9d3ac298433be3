/* follow_source.c: the layer that goes along, as it is read. */
#include "follow/follow_inner.h"

#include "base/message.h"
#include "read/crs_units.h"

#include <stdlib.h>
#include <string.h>

bool gis_follow_open(const gis_follow_request *request, gis_follow *out, gis_error *error)
{
    gis_source_request input = request->input;
    out->request = request;
    input.takes = GIS_TAKES_POLYGONS | GIS_TAKES_LINES | GIS_TAKES_POINTS;
    input.not_finite = gis_invalid_not_finite(request->invalid, GIS_NOT_FINITE_LEFT_OUT);
    if (!gis_source_open(&input, &out->input, error)) return false;
    gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(out->input));
    const gis_crs_units units = gis_crs_units_of(gis_source_crs(out->input), request->scale);
    return gis_optional_length_in_layer_units(&request->within, &units, "--by nearest", &out->within, error);
}

const char *gis_follow_name(const gis_follow *follow)
{
    return follow->request->name ? follow->request->name : gis_source_name(follow->input);
}

bool gis_follow_takes(const gis_follow *follow, size_t target)
{
    const char *of = follow->request->of, *layer = follow->targets->target[target].layer;
    return !of || !layer || strcmp(of, layer) == 0;
}

void gis_follow_clear(gis_follow *follow)
{
    for (size_t i = 0; i < follow->keys; i++) free(follow->key[i]);
    free(follow->key);
    free(follow->place);
    gis_source_close(follow->input);
    gis_source_close(follow->moved);
    *follow = (gis_follow){0};
}
