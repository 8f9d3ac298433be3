/* field_names.h: which fields a layer has, for messages. */
#ifndef GIS_FIELD_NAMES_H
#define GIS_FIELD_NAMES_H

#include <ogr_api.h>
#include <stddef.h>

/* "its fields are a, b, c"; where they do not fit, the first of them. */
enum { GIS_FIELD_NAMES_SIZE = 320 };
void gis_field_names(OGRLayerH layer, char *text, size_t size);

#endif
