/* route_input.h: the input of sunder route: the obstacles, one for each feature, and the robot. */
#ifndef GIS_ROUTE_INPUT_H
#define GIS_ROUTE_INPUT_H

#include "geometry/line_arrays.h"
#include "read/read_shape.h"
#include "route/coordinate.h"

/* The request of a route. Strings and lists are borrowed until the input is cleared. */
typedef struct gis_route_request {
    const char *obstacles;     /* the path of a data source, or a text */
    gis_source_request source; /* the selection from the data source, if obstacles is one; the members path and takes
                                * are set when it is read */
    gis_shape_request robot;
    gis_coordinate from, to; /* owned */
    gis_optional_length gap;
    double scale; /* N of the scale 1:N; 0: not given */
    gis_invalid_policy invalid;
    bool free_space; /* also write layers of the obstacles and the free space */
} gis_route_request;

void gis_route_request_clear(gis_route_request *request);

typedef struct gis_route_input {
    const gis_route_request *request;
    gis_source *source;       /* the source of the obstacles; NULL: they are a text */
    gis_source *robot_source; /* the source of the robot; NULL: it is a text */
    gis_crs_units units;
    OGRSpatialReferenceH crs; /* borrowed, or NULL */
    size_t n;
    sunder_shape **shape;      /* [n] the polygons of each obstacle; NULL: it has none */
    gis_lines *lines;          /* [n] the lines and points of each obstacle */
    sunder_obstacle *obstacle; /* [n] borrows from shape and lines */
    sunder_shape *robot;
    double gap;
} gis_route_input;

/* Reads everything. The caller clears *out on failure, too. */
bool gis_route_input_read(const gis_route_request *request, gis_route_input *out, gis_error *error);
void gis_route_input_clear(gis_route_input *input);

/* Writes the name of an obstacle: "layer buildings, FID 12", or "OBSTACLES" if they are a text. */
void gis_route_obstacle_name(const gis_route_input *input, size_t i, char *text, size_t size);

#endif
