/* page_model.h: what the page shows, before any of it is drawn or written: features, barriers and conflicts as the core
 * reports them, brought into the order in which a reader wants them. Shapes stay where they are
 * (layer/result_view.h). */
#ifndef GIS_PAGE_MODEL_H
#define GIS_PAGE_MODEL_H

#include "geometry/gis_box.h"
#include "report/number.h"
#include "report/page.h"

/* A piece of the map that deserves a closer look. */
typedef struct gis_page_place {
    double window[4];                /* of one aspect, so that pictures stand beside each other */
    const sunder_conflict *conflict; /* the worst one there; NULL: the place is there for a move */
    size_t feature;                  /* then whose */
    size_t others; /* conflicts, or moves, that are shown along with it and have no place of their own */
} gis_page_place;

enum { GIS_PAGE_PLACES = 12 };

typedef struct gis_page_model {
    const gis_page_request *request;
    gis_report_unit unit;
    size_t n;
    gis_view_feature *feature; /* [n] */
    double extent[4];          /* of all that is drawn, before and after; empty: all zero */
    bool empty;                /* nothing is drawn */
    gis_view_barrier *barrier; /* those that are seen beside the features; areas first, then by width */
    size_t n_barriers;
    const sunder_conflict **conflict; /* those between blocks, the worst first */
    size_t n_conflicts;
    size_t *moved; /* features, the longest move first */
    size_t n_moved;
    gis_page_place place[GIS_PAGE_PLACES]; /* conflicts, then moves */
    size_t n_places;
} gis_page_model;

/* Clear in any case. */
bool gis_page_model_make(const gis_page_request *request, gis_page_model *model, gis_error *error);
void gis_page_model_clear(gis_page_model *model);

/* A feature's shape, which there is; a barrier's geometry: until another of the kind is asked for. */
bool gis_page_shape(const gis_page_model *model, size_t feature, const sunder_shape **shape, gis_error *error);
bool gis_page_geometry(const gis_page_model *model, const gis_view_barrier *barrier, sunder_obstacle *geometry,
                       gis_error *error);
/* By which name a reader knows a feature: "FID 12", with the user's own id if there is one; or a barrier: "roads:12".
 * Plain text, not escaped. */
bool gis_page_name(const gis_page_model *model, size_t thing, gis_text *to, gis_error *error);

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

/* Sets `box` to the feature's box after the fraction `part` of its move: 0 before, 1 after. */
void gis_page_box(const gis_view_feature *feature, double part, double box[4]);
/* How long its move is. */
double gis_page_length(const gis_view_feature *feature);

#endif
