/* result_view.h: a separated layer for drawing (result.h). Data about all features and barriers are filled in at once;
 * shapes, geometries and names are fetched one by one. */
#ifndef GIS_RESULT_VIEW_H
#define GIS_RESULT_VIEW_H

#include "layer/rungs.h"

#include <ogr_core.h>
#include <stdint.h>

/* Data about a feature for drawing. A box is xmin, ymin, xmax, ymax. */
typedef struct gis_view_feature {
    double box[4]; /* before the move */
    double move[2];
    uint64_t place;    /* where the view finds it */
    uint32_t vertices; /* 0: nothing to draw */
    uint8_t status;    /* a sunder_feature_status */
    bool involved;     /* it is in a remaining conflict, or blocks the solution of one */
    bool changed;      /* it became larger or smaller */
} gis_view_feature;

typedef struct gis_view_barrier {
    double box[4]; /* with its width */
    double width;
    uint64_t place;  /* where the view finds it; differs between implementations */
    size_t order;    /* its number among all barriers in reading order; set by the page's model */
    size_t vertices; /* of lines and polygons */
    bool area;       /* it has polygons */
} gis_view_barrier;

/* A hidden feature, and the set of features and barriers that cannot all stay as they are. */
typedef struct gis_hidden_row {
    size_t feature;
    sunder_hiding_cost cost;
    const size_t *thing; /* [things] ascending, as in sunder_clause */
    size_t things;
    bool proved, forced; /* it is proved; and the feature is the only one that may be hidden for it */
} gis_hidden_row;

/* What is hidden or has another shape in all, and what is proved of it; the classes are borrowed. */
typedef struct gis_hiding {
    sunder_hiding_summary sum;
    size_t enlarged, on_rung[GIS_RUNGS]; /* numbers of features: larger ones, and those on rungs of each kind */
    const sunder_hiding_class *class;
    size_t classes;
} gis_hiding;

/* Which shape of a feature: as it was read; before all moves and smaller shapes, larger perhaps; in the result. */
typedef enum gis_view_shape { GIS_VIEW_READ, GIS_VIEW_FIRST, GIS_VIEW_NOW } gis_view_shape;

typedef struct gis_result_view {
    void *of; /* passed to each function */
    size_t features, barriers;
    /* Fills `features` elements, which are zeroed. */
    bool (*fill)(void *of, gis_view_feature *feature, gis_error *error);
    /* Fills `barriers` elements. */
    bool (*fill_barriers)(void *of, gis_view_barrier *barrier, gis_error *error);
    /* Gets the remaining conflicts, in any order; they are valid until close(). */
    bool (*conflicts)(void *of, const sunder_conflict **conflict, size_t *n, gis_error *error);
    /* Lists the hidden features, in input order. The caller frees the list; the things are valid until close(). */
    bool (*hidden)(void *of, gis_hidden_row **hidden, size_t *n, gis_error *error);
    /* Gets the rows of neighbours; they are valid until close(). */
    bool (*rows)(void *of, const sunder_row **row, size_t *n, gis_error *error);
    /* Fetch a shape or geometry, only for an item that has something to draw. What is lent is valid until the next one
     * is fetched. */
    bool (*shape)(void *of, size_t feature, uint64_t place, gis_view_shape which, const sunder_shape **shape,
                  gis_error *error);
    bool (*geometry)(void *of, uint64_t place, sunder_obstacle *geometry, gis_error *error);
    /* Fetch FIDs (OGRNullFID: none) and texts: the value of --id-field (NULL: none), or for a barrier the name of its
     * layer. */
    bool (*name)(void *of, size_t feature, uint64_t place, GIntBig *fid, const char **id, gis_error *error);
    bool (*barrier_name)(void *of, size_t barrier, GIntBig *fid, const char **layer, gis_error *error);
    void (*close)(void *of);
} gis_result_view;

/* The data of a barrier, except its place. */
gis_view_barrier gis_view_barrier_of(const sunder_obstacle *geometry, double width);

#endif
