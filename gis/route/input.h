/* input.h: what sunder route reads: obstacles, each feature by itself, the robot, start and goal. */
#ifndef GIS_ROUTE_INPUT_H
#define GIS_ROUTE_INPUT_H

#include "read/operand.h"

/* The lines and points of one feature. */
typedef struct gis_lines {
    double *xy;
    size_t *end;
    size_t points, lines, xy_capacity, end_capacity;
} gis_lines;

typedef struct gis_route_input {
    const gis_options *options;
    gis_source *source;       /* of the obstacles; NULL: they are a text */
    gis_source *robot_source; /* likewise */
    gis_ruler rule;
    OGRSpatialReferenceH crs; /* borrowed, or NULL */
    size_t n;
    sunder_shape **shape;     /* [n] NULL: no polygons */
    gis_lines *lines;         /* [n] */
    sunder_obstacle *obstacle; /* [n] borrows the two */
    sunder_shape *robot;
    sunder_place from, to;
    double gap;
    char *text[4]; /* of from and to, where they are fractions */
} gis_route_input;

/* Reads everything. On failure what was read can be released all the same. */
bool gis_route_input_read(const gis_options *options, gis_route_input *out, gis_error *error);
void gis_route_input_clear(gis_route_input *input);

/* "layer buildings, FID 12", or "OBSTACLES" of a text. */
void gis_route_obstacle_name(const gis_route_input *input, size_t i, char *text, size_t size);

#endif
