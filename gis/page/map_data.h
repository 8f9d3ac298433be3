/* map_data.h: the data of the interactive map of the page, read by its script. */
#ifndef GIS_PAGE_MAP_DATA_H
#define GIS_PAGE_MAP_DATA_H

#include "page/thinning.h"

/* Adds one JSON object; it is safe within a script element. */
bool gis_map_data_write(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error);

#endif
