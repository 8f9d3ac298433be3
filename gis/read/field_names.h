/* field_names.h: lists the fields of a layer, for messages. */
#ifndef GIS_FIELD_NAMES_H
#define GIS_FIELD_NAMES_H

#include <ogr_api.h>
#include <stddef.h>

/* Writes "its fields are a, b, c"; if they do not fit, as many as fit. */
enum { GIS_FIELD_NAMES_SIZE = 320 };
void gis_field_names(OGRLayerH layer, char *text, size_t size);

#endif
