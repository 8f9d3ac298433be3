/* barrier.h: barriers: features of other data sources (--barrier) that never move, and to which features keep a
 * distance; passed to the core as its barriers.
 *
 * DATASET[,layer=NAME][,width=LENGTH|,width-field=FIELD][,gap=LENGTH][,least=LENGTH][,side=yes|no]
 * [,as=area|boundary][,where=SQL] */
#ifndef GIS_BARRIER_H
#define GIS_BARRIER_H

#include "base/length.h"
#include "geometry/line_arrays.h"
#include "read/crs_units.h"
#include "read/source.h"
#include "read/validity.h"
#include "sunder.h"

/* The parsed value of one --barrier. */
typedef struct gis_barrier_request {
    char *text; /* owned; the other strings point into it, and are NULL if not given */
    const char *dataset, *layer, *width_field, *where;
    gis_optional_length width, gap, least;
    bool side, as_boundary;
} gis_barrier_request;

/* Parses the value of --barrier. An error is wrong usage; then nothing has to be cleared. */
bool gis_barrier_parse(const char *text, gis_barrier_request *out, gis_error *error);
void gis_barrier_request_clear(gis_barrier_request *request);

/* The boxes near which barriers matter. NULL: memory is out. */
typedef struct gis_barrier_targets gis_barrier_targets;
gis_barrier_targets *gis_barrier_targets_new(const double (*box)[4], size_t n);
/* Enlarges a feature's box. The side of a barrier on which a feature stands depends on all barriers within
 * sunder_side_reach() of the feature, whatever the limits are. Boxes are later enlarged by `reach`, the longest move;
 * if side_reach is larger, the box is enlarged by the difference. */
void gis_barrier_target_grow(double box[4], double side_reach, double reach);
/* Boxes that are stored elsewhere in cells, and read a cell at a time. */
typedef struct gis_box_cells {
    void *of; /* borrowed; passed to each function */
    size_t cells;
    double reach; /* the longest move; boxes are enlarged by gis_barrier_target_grow() for features of their size */
    const double *(*around)(void *of, size_t cell); /* the box around all boxes of a cell; [0] > [2]: the cell is
                                                     * empty */
    size_t (*boxes)(void *of, size_t cell);         /* the largest number of boxes that read() returns */
    bool (*read)(void *of, size_t cell, double (*box)[4], size_t *n, gis_error *error);
} gis_box_cells;
/* Targets with the boxes of all cells, which are read when they are needed. */
gis_barrier_targets *gis_barrier_targets_of_cells(const gis_box_cells *from);
/* Fails if reading a cell has failed. */
bool gis_barrier_targets_sound(const gis_barrier_targets *targets, gis_error *error);
void gis_barrier_targets_free(gis_barrier_targets *targets);

/* The layer to which barriers are read, and how. */
typedef struct gis_barrier_surroundings {
    OGRSpatialReferenceH crs; /* CRS of the layer; NULL: none */
    const gis_crs_units *units;
    const gis_barrier_targets *targets; /* boxes of all features that may conflict */
    double reach;                       /* the longest move of any feature; INFINITY: unlimited */
    double gap;                         /* gap of barriers without a gap of their own */
    double least_gap;                   /* likewise the least gap; negative: there is none */
    gis_invalid_policy invalid;
    const char *output; /* path of the output, which must not replace a barrier's dataset; NULL: none */
    bool update;        /* the output is updated, so it may be a barrier's dataset */
    bool without_box;   /* GDAL reads whole layers and does not compare features with a box */
} gis_barrier_surroundings;

/* One feature of a barrier layer. */
typedef struct gis_barrier_feature {
    sunder_shape *shape; /* NULL: it has no polygons */
    gis_lines lines;
    double width;
    size_t request; /* number of the --barrier that it comes from */
    GIntBig fid;
} gis_barrier_feature;

typedef struct gis_barriers {
    gis_barrier_feature *feature; /* [n] */
    sunder_barrier *barrier;      /* [n] they borrow from the features */
    char **layer;                 /* [requests] names of the barrier layers */
    size_t n, capacity, requests;
} gis_barriers;

/* Reads the barriers, transforms them to the layer's CRS, and keeps those within reach of the layer; others cannot be
 * in the way. Call gis_barriers_clear() also after a failure. */
bool gis_barriers_read(const gis_barrier_request *requests, size_t n, const gis_barrier_surroundings *around,
                       gis_barriers *out, gis_error *error);
void gis_barriers_clear(gis_barriers *barriers);

/* ---- barrier_read.c ---------------------------------------------------------------------------------------------- */

/* What all features of one --barrier have in common. The name is set before features are visited. */
typedef struct gis_barrier_common {
    char *layer;     /* name of the layer; owned */
    double distance; /* distance that features keep from the barrier's edges */
    double least;    /* distance that they have to keep at least, if it is another; else negative */
} gis_barrier_common;

/* Gets a feature, and must clear it in any case. */
typedef bool gis_barrier_take(void *user, const gis_barrier_common *common, gis_barrier_feature *feature,
                              gis_error *error);
/* Visits the features of one --barrier that are within reach, in their order. If GDAL fails to compare one with the
 * box around all that is within reach, error->in_a_box is set: the caller then discards what it got and visits again
 * without a box. batch: the largest number of the source's features held at once; 0: all. The caller frees
 * common->layer, which is NULL if the source was not opened. */
bool gis_barrier_visit(const gis_barrier_request *request, const gis_barrier_surroundings *around, size_t batch,
                       gis_barrier_take *take, void *user, gis_barrier_common *common, gis_error *error);
void gis_barrier_feature_clear(gis_barrier_feature *feature);
/* The core's barrier of the feature f, from which it borrows. A gap of -1 stands for the layer's, which the core
 * knows. */
sunder_barrier gis_barrier_demands(const gis_barrier_feature *f, const gis_barrier_request *request,
                                   const gis_barrier_common *common);

/* ---- barrier_reach.c --------------------------------------------------------------------------------------------- */

/* May a barrier in this box, from which features keep `distance`, be in the way of a feature? */
bool gis_barrier_is_near(const gis_barrier_surroundings *around, const double box[4], double distance);
/* Sets `box` to the area in which barriers with this distance may be in the way of a feature. False: it is
 * unbounded. */
bool gis_barrier_reach_box(const gis_barrier_surroundings *around, double distance, double box[4]);
/* Finds the greatest number in a field; null and values that are not positive count as 0. False: it cannot be
 * determined. */
bool gis_barrier_greatest(OGRLayerH layer, const char *field, double *greatest);

/* ---- barrier_transform.c ----------------------------------------------------------------------------------------- */

/* Makes the transformation from a barrier's CRS to the layer's. *out is NULL if both are the same, or if one is
 * unknown, which gives a warning. Fails if there is no transformation. */
bool gis_barrier_transformation(OGRSpatialReferenceH from, OGRSpatialReferenceH to, const char *who,
                                OGRCoordinateTransformationH *out, gis_error *error);
/* Sets `out` to a box in the CRS `other` that contains the image of `box`, which is in the layer's CRS. False: it
 * cannot be determined. */
bool gis_barrier_box(const double box[4], OGRSpatialReferenceH of_layer, OGRSpatialReferenceH other, double out[4]);

/* ---- barrier_corner.c -------------------------------------------------------------------------------------------- */

/* Finds the barrier's vertex that is nearest to `at`; a push on the barrier is drawn to it. */
void gis_barrier_corner(const sunder_obstacle *barrier, const double at[2], double nearest[2]);

#endif
