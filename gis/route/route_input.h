/* route_input.h: what sunder route reads: obstacles, each feature by itself, and the robot. */
#ifndef GIS_ROUTE_INPUT_H
#define GIS_ROUTE_INPUT_H

#include "geometry/line_arrays.h"
#include "read/read_shape.h"
#include "route/coordinate.h"

/* What a route is asked of. Strings and lists are borrowed until the input is cleared. */
typedef struct gis_route_request {
    const char *obstacles;     /* a data source, or a text */
    gis_source_request source; /* what is selected from it, if it is one; path and what it takes are filled in */
    gis_shape_request robot;
    gis_coordinate from, to; /* owned */
    gis_optional_length gap;
    double scale; /* N of 1:N; 0: not given */
    gis_invalid_policy invalid;
    bool free_space; /* layers of obstacles and free space, too */
} gis_route_request;

void gis_route_request_clear(gis_route_request *request);

typedef struct gis_route_input {
    const gis_route_request *request;
    gis_source *source;       /* of the obstacles; NULL: they are a text */
    gis_source *robot_source; /* likewise */
    gis_crs_units units;
    OGRSpatialReferenceH crs; /* borrowed, or NULL */
    size_t n;
    sunder_shape **shape;      /* [n] NULL: no polygons */
    gis_lines *lines;          /* [n] */
    sunder_obstacle *obstacle; /* [n] borrows from shape and lines */
    sunder_shape *robot;
    double gap;
} gis_route_input;

/* Reads everything. On failure the caller clears it as well. */
bool gis_route_input_read(const gis_route_request *request, gis_route_input *out, gis_error *error);
void gis_route_input_clear(gis_route_input *input);

/* "layer buildings, FID 12", or "OBSTACLES" of a text. */
void gis_route_obstacle_name(const gis_route_input *input, size_t i, char *text, size_t size);

#endif
