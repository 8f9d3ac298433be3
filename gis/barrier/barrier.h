/* barrier.h: what never moves, and keeps a distance of its own: the data sources of --barrier, as the core's barriers.
 *
 *   DATASET[,layer=NAME][,width=LENGTH|,width-field=FIELD][,gap=LENGTH][,side=yes|no][,as=area|boundary][,where=SQL]
 */
#ifndef GIS_BARRIER_H
#define GIS_BARRIER_H

#include "base/length.h"
#include "read/crs_units.h"
#include "read/lines.h"
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

/* The layer that barriers stand around. */
typedef struct gis_barrier_surroundings {
    OGRSpatialReferenceH crs; /* of the layer; NULL: none */
    const gis_crs_units *units;
    double box[4]; /* of all that conflicts with anything; empty (box[0] > box[2]): there is nothing */
    double reach;  /* no feature moves farther; INFINITY: some may go anywhere */
    double gap;    /* of barriers that have none of their own */
    gis_invalid_policy invalid;
    const char *output; /* which may not replace a barrier's dataset; NULL: there is none */
    bool update;        /* ... unless it adds to it */
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

/* ---- transform.c, for read.c ------------------------------------------------------------------------------------- */

/* From a barrier's CRS to the layer's; NULL where they are the same, or one of them is not known, which is warned of.
 * False if there is no way from one to the other. */
bool gis_barrier_transformation(OGRSpatialReferenceH from, OGRSpatialReferenceH to, const char *who,
                                OGRCoordinateTransformationH *out, gis_error *error);
/* A box around all that `box`, of the layer's CRS, holds, in the other CRS. False: there is no telling. */
bool gis_barrier_box(const double box[4], OGRSpatialReferenceH of_layer, OGRSpatialReferenceH other, double out[4]);

#endif
