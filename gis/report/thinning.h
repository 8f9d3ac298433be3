/* thinning.h: which features of a large layer the page's map draws. */
#ifndef GIS_REPORT_THINNING_H
#define GIS_REPORT_THINNING_H

#include "report/drawing.h"
#include "report/page_model.h"

typedef enum gis_drawn {
    GIS_DRAWN_NOT,     /* nothing to draw, or too small to draw among so large a number */
    GIS_DRAWN_SIMPLER, /* without corners that lie within the tolerance */
    GIS_DRAWN_WHOLE
} gis_drawn;

typedef struct gis_thinning {
    unsigned char *drawn; /* [features] gis_drawn */
    double tolerance;     /* 0: nothing is simplified */
    size_t whole, simpler, left_out;
    double barrier_tolerance; /* of barriers, likewise */
} gis_thinning;

/* Clear in any case. */
bool gis_thinning_choose(const gis_page_model *model, gis_thinning *thinning, gis_error *error);
void gis_thinning_clear(gis_thinning *thinning);

#endif
