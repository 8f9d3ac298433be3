/* pictures.h: the page's still pictures, as SVG in the page's own colours. They need no script, and print. */
#ifndef GIS_REPORT_PICTURES_H
#define GIS_REPORT_PICTURES_H

#include "report/drawing.h"
#include "report/page_model.h"

/* The whole layer, before or after. */
bool gis_page_add_overview(const gis_page_model *model, bool after, gis_text *to, gis_error *error);
/* A place, before or after. */
bool gis_page_add_close_up(const gis_page_model *model, const gis_page_place *place, bool after, gis_text *to,
                           gis_error *error);
/* How many features moved how far. */
bool gis_page_add_histogram(const gis_page_model *model, gis_text *to, gis_error *error);

#endif
