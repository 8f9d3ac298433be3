/* check_page.h: the page of check --report: what was found, the worst first, each with a small picture. */
#ifndef GIS_CHECK_PAGE_H
#define GIS_CHECK_PAGE_H

#include "base/text.h"
#include "layer/moves.h"
#include "legible/legible.h"

/* What was found; everything is borrowed. */
typedef struct gis_findings {
    const gis_layer_input *input;
    const sunder_report *report;
    const gis_legible *legible;
    const gis_moves *moves; /* without a report: --before was not given */
} gis_findings;

/* Adds the whole page, one HTML file that loads no other. Its bytes depend only on what is given. */
bool gis_check_page_write(const gis_findings *found, gis_text *to, gis_error *error);

#endif
