/* result_view.h: a separated layer to be drawn (result.h). What is known of each feature and each barrier is filled in
 * once; shapes, geometries and names are asked for one by one. */
#ifndef GIS_RESULT_VIEW_H
#define GIS_RESULT_VIEW_H

#include "base/gis_error.h"
#include "sunder.h"

#include <ogr_core.h>
#include <stdint.h>

/* A box is xmin, ymin, xmax, ymax. */
typedef struct gis_view_feature {
    double box[4]; /* where it stood */
    double move[2];
    uint64_t place;    /* where the view has it */
    uint32_t vertices; /* 0: there is nothing to draw */
    uint8_t status;    /* a sunder_feature_status */
    bool involved;     /* is in a conflict that remains, or in the way of one */
} gis_view_feature;

typedef struct gis_view_barrier {
    double box[4]; /* as it is drawn, with its width */
    double width;
    uint64_t place;  /* where the view has it: another in parts than of a whole layer */
    size_t order;    /* among all barriers, as they were read; set by the page's model */
    size_t vertices; /* of lines and of the shape */
    bool area;       /* it has a shape */
} gis_view_barrier;

typedef struct gis_result_view {
    void *of; /* handed to each function */
    size_t features, barriers;
    /* feature: [features] zeroed. */
    bool (*fill)(void *of, gis_view_feature *feature, gis_error *error);
    /* barrier: [barriers] */
    bool (*fill_barriers)(void *of, gis_view_barrier *barrier, gis_error *error);
    /* The conflicts that remain, in any order; they live as long as `of`. */
    bool (*conflicts)(void *of, const sunder_conflict **conflict, size_t *n, gis_error *error);
    /* Call these only for an item that has something to draw. The data that they lend is valid until the next item
     * is fetched. */
    bool (*shape)(void *of, size_t feature, uint64_t place, const sunder_shape **shape, gis_error *error);
    bool (*geometry)(void *of, uint64_t place, sunder_obstacle *geometry, gis_error *error);
    /* FIDs (OGRNullFID: none) and texts: the user's own id, NULL: none; of a barrier the name of its layer. */
    bool (*name)(void *of, size_t feature, uint64_t place, GIntBig *fid, const char **id, gis_error *error);
    bool (*barrier_name)(void *of, size_t barrier, GIntBig *fid, const char **layer, gis_error *error);
    void (*close)(void *of);
} gis_result_view;

/* What there is to know of a barrier but for its place. */
gis_view_barrier gis_view_barrier_of(const sunder_obstacle *geometry, double width);

#endif
