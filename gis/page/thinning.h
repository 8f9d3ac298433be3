/* thinning.h: chooses which features of a large layer the map of the page draws. */
#ifndef GIS_PAGE_THINNING_H
#define GIS_PAGE_THINNING_H

#include "page/drawing.h"
#include "page/page_model.h"

typedef enum gis_drawn {
    GIS_DRAWN_NOT,     /* without shape, or not larger than the tolerance */
    GIS_DRAWN_SIMPLER, /* simplified: without vertices that lie within the tolerance */
    GIS_DRAWN_WHOLE
} gis_drawn;

typedef struct gis_thinning {
    unsigned char *drawn; /* [features] gis_drawn */
    double tolerance;     /* the tolerance of simplification; 0: all features are drawn completely */
    size_t whole, simpler, left_out;
    double barrier_tolerance; /* the tolerance for barriers; 0: they are drawn completely */
} gis_thinning;

/* The caller calls gis_thinning_clear() on failure, too. */
bool gis_thinning_choose(const gis_page_model *model, gis_thinning *thinning, gis_error *error);
void gis_thinning_clear(gis_thinning *thinning);

#endif
