/* page_model.h: the content of the page before it is drawn or written: features, barriers and conflicts as the core
 * reports them, sorted for the reader. Shapes are not copied; they are read when needed (layer/result_view.h). */
#ifndef GIS_PAGE_MODEL_H
#define GIS_PAGE_MODEL_H

#include "geometry/gis_box.h"
#include "page/number.h"
#include "page/page.h"

/* A part of the map that is shown as a close-up. */
typedef struct gis_page_place {
    double window[4];                /* all windows have the same aspect */
    const sunder_conflict *conflict; /* the worst conflict in the window; NULL: the place shows a move or a row */
    const sunder_row *row;           /* the row that it shows; NULL: none */
    size_t feature;                  /* the feature that moved, or the first one of the conflict or row */
    size_t others; /* the number of further conflicts, or moves, in this window that have no place of their own */
} gis_page_place;

enum { GIS_PAGE_PLACES = 12 };

typedef struct gis_page_model {
    const gis_page_request *request;
    gis_page_unit unit;
    size_t n;
    gis_view_feature *feature; /* [n] */
    double extent[4];          /* the bounding box of all features before and after their moves; all zero if there is
                                * none */
    bool empty;                /* there is nothing to draw */
    bool changed;              /* a feature became larger or smaller */
    gis_view_barrier *barrier; /* the barriers near the features; areas first, then sorted by width */
    size_t n_barriers;
    const sunder_conflict **conflict; /* the conflicts between blocks, the worst first */
    size_t n_conflicts;
    size_t *moved; /* the features that moved, the longest move first */
    size_t n_moved;
    gis_page_place place[GIS_PAGE_PLACES]; /* conflicts, then moves */
    size_t n_places;
} gis_page_model;

/* The caller calls gis_page_model_clear() on failure, too. */
bool gis_page_model_make(const gis_page_request *request, gis_page_model *model, gis_error *error);
void gis_page_model_clear(gis_page_model *model);

/* The shape of a feature that has one, and the geometry of a barrier. Each result is valid until the next call of the
 * same function. */
bool gis_page_shape(const gis_page_model *model, size_t feature, gis_view_shape which, const sunder_shape **shape,
                    gis_error *error);
bool gis_page_geometry(const gis_page_model *model, const gis_view_barrier *barrier, sunder_obstacle *geometry,
                       gis_error *error);
/* Writes the name of a feature or a barrier for the reader: "FID 12", preceded by the value of --id-field if there is
 * one; a barrier is "roads:12". `thing` counts the features, then the barriers. The text is not escaped. */
bool gis_page_name(const gis_page_model *model, size_t thing, gis_text *to, gis_error *error);

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

/* Sets `box` to the feature's bounding box after the fraction `part` of its move: 0 before, 1 after. */
void gis_page_box(const gis_view_feature *feature, double part, double box[4]);
/* Returns the length of the feature's move. */
double gis_page_length(const gis_view_feature *feature);
/* Sets `window` to a close-up of `box` with a margin. */
void gis_page_frame(const double box[4], double window[4]);

#endif
