/* check_page.h: the page of check --report: what was found, the worst first, each with a small picture. */
#ifndef GIS_CHECK_PAGE_H
#define GIS_CHECK_PAGE_H

#include "base/text.h"
#include "legible/legible.h"

/* Adds the whole page, one HTML file that loads no other. Its bytes depend only on what is given. */
bool gis_check_page_write(const gis_layer_input *input, const sunder_report *report, const gis_legible *legible,
                          gis_text *to, gis_error *error);

#endif
