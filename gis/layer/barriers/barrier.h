/* barrier.h: what never moves, and keeps a distance of its own: the data sources of --barrier, as the core's barriers.
 *
 *   DATASET[,layer=NAME][,width=LENGTH|,width-field=FIELD][,gap=LENGTH][,side=yes|no][,as=area|boundary][,where=SQL]
 */
#ifndef GIS_BARRIER_H
#define GIS_BARRIER_H

#include "base/length.h"
#include "geometry/line_arrays.h"
#include "read/crs_units.h"
#include "read/source.h"
#include "read/validity.h"
#include "sunder.h"

/* One --barrier, taken apart. */
typedef struct gis_barrier_request {
    char *text; /* owned; what follows points into it, and is NULL where it was not given */
    const char *dataset, *layer, *width_field, *where;
    gis_optional_length width, gap;
    bool side, as_boundary;
} gis_barrier_request;

/* A failure is wrong usage, and nothing is to be cleared then. */
bool gis_barrier_parse(const char *text, gis_barrier_request *out, gis_error *error);
void gis_barrier_request_clear(gis_barrier_request *request);

/* Boxes of what barriers may be in the way of. NULL: memory is out. */
typedef struct gis_barrier_targets gis_barrier_targets;
gis_barrier_targets *gis_barrier_targets_new(const double (*box)[4], size_t n);
/* Barriers decide on which side of them a feature is as far about it as sunder_side_reach() says, and all of these are
 * needed, whatever the limits are. Grows the box by what a reach of moves lacks for a feature with that side reach. */
void gis_barrier_target_grow(double box[4], double side_reach, double reach);
/* Boxes that lie in cells somewhere else, and are read a cell at a time. */
typedef struct gis_box_cells {
    void *of; /* borrowed; handed to each function */
    size_t cells;
    double reach; /* of moves: boxes are grown as by gis_barrier_target_grow() for features of their size */
    const double *(*around)(void *of, size_t cell); /* a box around all of the cell; [0] > [2]: the cell is empty */
    size_t (*boxes)(void *of, size_t cell);         /* the most boxes that read() fills in */
    bool (*read)(void *of, size_t cell, double (*box)[4], size_t *n, gis_error *error);
} gis_box_cells;
/* The boxes of all cells, which are looked up there as long as the targets are used. */
gis_barrier_targets *gis_barrier_targets_of_cells(const gis_box_cells *from);
/* Could all be looked up so far? */
bool gis_barrier_targets_sound(const gis_barrier_targets *targets, gis_error *error);
void gis_barrier_targets_free(gis_barrier_targets *targets);

/* The layer that barriers stand around. */
typedef struct gis_barrier_surroundings {
    OGRSpatialReferenceH crs; /* of the layer; NULL: none */
    const gis_crs_units *units;
    const gis_barrier_targets *targets; /* of all that conflicts with anything */
    double reach;                       /* no feature moves farther; INFINITY: some may go anywhere */
    double gap;                         /* of barriers that have none of their own */
    gis_invalid_policy invalid;
    const char *output; /* which may not replace a barrier's dataset; NULL: there is none */
    bool update;        /* ... unless it adds to it */
    bool without_box;   /* GDAL is asked for all of a layer, and not for what meets a box */
} gis_barrier_surroundings;

/* One feature of a barrier layer. */
typedef struct gis_barrier_feature {
    sunder_shape *shape; /* NULL: no polygons */
    gis_lines lines;
    double width;
    size_t request; /* which one it comes of */
    GIntBig fid;
} gis_barrier_feature;

typedef struct gis_barriers {
    gis_barrier_feature *feature; /* [n] */
    sunder_barrier *barrier;      /* [n] borrows from the features */
    char **layer;                 /* [requests] names of the layers */
    size_t n, capacity, requests;
} gis_barriers;

/* Reads, transforms to the layer's CRS, and keeps what is within reach: nothing else can be in the way of anything. On
 * failure what was read can be released all the same. */
bool gis_barriers_read(const gis_barrier_request *requests, size_t n, const gis_barrier_surroundings *around,
                       gis_barriers *out, gis_error *error);
void gis_barriers_clear(gis_barriers *barriers);

/* ---- barrier_read.c ---------------------------------------------------------------------------------------------- */

/* What is known of all features of one request, but for its layer's name once all is read. */
typedef struct gis_barrier_common {
    char *layer;     /* its name */
    double distance; /* that is kept from its edges */
} gis_barrier_common;

/* The function that takes the feature clears it, in any case. */
typedef bool gis_barrier_take(void *user, const gis_barrier_common *common, gis_barrier_feature *feature,
                              gis_error *error);
/* The features of one request that are within reach, in their order. GDAL may fail to compare one with the box of all
 * that (error->in_a_box); then the caller forgets what it took, and visits once more without a box. batch: at most this
 * many features of the source are held at a time; 0: all. *common: its name is owned, and NULL if it was not opened. */
bool gis_barrier_visit(const gis_barrier_request *request, const gis_barrier_surroundings *around, size_t batch,
                       gis_barrier_take *take, void *user, gis_barrier_common *common, gis_error *error);
void gis_barrier_feature_clear(gis_barrier_feature *feature);

/* ---- barrier_reach.c --------------------------------------------------------------------------------------------- */

/* May what lies in the box be in the way, if it keeps so far off? */
bool gis_barrier_is_near(const gis_barrier_surroundings *around, const double box[4], double distance);
/* The box of all that such a barrier may be in the way of. False: there is none, it may be anywhere. */
bool gis_barrier_reach_box(const gis_barrier_surroundings *around, double distance, double box[4]);
/* The greatest number in a field, null and what is not positive being 0. False: there is no telling. */
bool gis_barrier_greatest(OGRLayerH layer, const char *field, double *greatest);

/* ---- barrier_transform.c ----------------------------------------------------------------------------------------- */

/* From a barrier's CRS to the layer's; NULL where they are the same, or one of them is not known, which is warned of.
 * False if there is no way from one to the other. */
bool gis_barrier_transformation(OGRSpatialReferenceH from, OGRSpatialReferenceH to, const char *who,
                                OGRCoordinateTransformationH *out, gis_error *error);
/* A box around all that `box`, of the layer's CRS, holds, in the other CRS. False: there is no telling. */
bool gis_barrier_box(const double box[4], OGRSpatialReferenceH of_layer, OGRSpatialReferenceH other, double out[4]);

/* ---- barrier_corner.c -------------------------------------------------------------------------------------------- */

/* The corner of a barrier that is nearest to a place: there a push on it ends. */
void gis_barrier_corner(const sunder_obstacle *barrier, const double at[2], double nearest[2]);

#endif
