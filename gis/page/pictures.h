/* pictures.h: the static pictures of the page, as SVG with the colours of the style sheet. They need no script and can
 * be printed. */
#ifndef GIS_PAGE_PICTURES_H
#define GIS_PAGE_PICTURES_H

#include "page/drawing.h"
#include "page/page_model.h"

/* Adds a picture of the whole layer, before or after the moves. */
bool gis_page_add_overview(const gis_page_model *model, bool after, gis_text *to, gis_error *error);
/* Adds a close-up of a place, before or after the moves. */
bool gis_page_add_close_up(const gis_page_model *model, const gis_page_place *place, bool after, gis_text *to,
                           gis_error *error);
/* Adds a histogram of the lengths of the moves. */
bool gis_page_add_histogram(const gis_page_model *model, gis_text *to, gis_error *error);

#endif
